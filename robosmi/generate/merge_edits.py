"""Keeps the user's edits outside of regions, too: merges the new text, the previously generated one, and the file.

`merge_edits` decides for one file and does not access the disk; `record` knows the previous texts, `staging` the files. In
addition to EGL's merge, an edit anywhere survives or becomes a marked conflict, and a region whose element is gone stays in its
place. What cannot be resolved (a foreign file, a duplicate id, open conflicts) stops the run.

`MergedTexts` does so for texts that `Gen.make` gave, or that were made some other way, and for the files that are there. The
caller writes them, with whatever else it makes, in one commit. The record of last texts is a folder of its output.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import StoppedError
from robosmi.files.files import digest, free_name
from robosmi.generate.output_paths import Places, before_conflicts
from robosmi.generate.record import Record, lost_record, restored_copy
from robosmi.generate.regions import CONTROLLED, PROTECTED, CommentStyle, Parts, Region, partition, styles_in
from robosmi.generate.text_form import FileText, read, same_text

if TYPE_CHECKING:
    from robosmi.generate.three_way import Chunk

CONFLICT = "RS511"
"""The rule for edits of lines that the generated text changes, too."""
YOURS, BASE, MIDDLE, GENERATED = "<<<<<<< yours\n", "||||||| last generated\n", "=======\n", ">>>>>>> generated\n"

_AS_BYTES = "surrogateescape"
"""Bytes that are no UTF-8, in a comment of another encoding perhaps, go through a merge unchanged."""


_MergeView = Callable[[str, str, str, str, Path], tuple[str, str]]
"""A function that adapts texts for the merge, so that changes the user is entitled to make are no conflicts.

It maps (relative path, previously generated text, existing text, new text, path) to the adapted first two texts.
"""


class MergedText(Struct):
    """The result of merging a newly generated text with the existing file.

    Attributes:
        text: its new text.
        findings: what was kept, and what the user has to look at.
        save_old: whether the old file is to be kept beside it.
        refused: why the run must stop instead; None if it need not.
    """

    text: str
    findings: list[Finding] = []
    save_old: bool = False
    refused: Finding | None = None


def merge_edits(
    path: str,
    base: str | None,
    existing: str | None,
    generated: str,
    styles: Sequence[CommentStyle],
    before_conflicts: Sequence[str] = (),
) -> MergedText:
    """Merge a newly made text with the file that is there.

    Args:
        path: of the file, for findings.
        base: the text that was made last, None if no run with this option made it.
        existing: the text in the file, with line feeds; None if there is no file.
        generated: the newly made text.
        styles: the comments that markers may be.
        before_conflicts: what the file held before each conflict that was marked in it, as far as that is still there.
    """
    if existing is None:
        gone = Finding("RS517", Severity.info, "the file was deleted; it is generated again", Location(path))
        return MergedText(generated, [gone] if base is not None else [])
    if existing == generated:
        return MergedText(existing)
    all_styles = list(dict.fromkeys([*styles, *styles_in(base or "")]))
    merge = _Merge(path, _ended(base) if base is not None else None, _ended(existing), _ended(generated), all_styles)
    kept = merge.result(before_conflicts)
    if not _ends_with_a_break(base, existing, generated):
        kept.text = kept.text.removesuffix("\n")
    return kept


def _ended(text: str) -> str:
    """The text with a line break at its end."""
    return text if not text or text.endswith("\n") else f"{text}\n"


def _ends_with_a_break(base: str | None, existing: str, generated: str) -> bool:
    """Whether the merged text ends with a line break: as in the file if the user changed that, else as generated."""
    there = existing in ("", _ended(existing))
    changed = base is None or there != (base == _ended(base))
    return there if changed else generated == _ended(generated)


class _Merge:
    def __init__(self, path: str, base: str | None, existing: str, generated: str, styles: Sequence[CommentStyle]) -> None:
        self.path, self.base, self.existing, self.generated = path, base, existing, generated
        self.theirs, self.ours = partition(generated, styles), partition(existing, styles)
        self.before = partition(base, styles) if base is not None else None
        self.findings: list[Finding] = []
        self.save_old = False
        self.styles = styles

    def say(self, rule: str, severity: Severity, message: str, line: int | None = None, fix: str | None = None) -> Finding:
        finding = Finding(rule, severity, message, Location(self.path, line), fix=fix)
        self.findings.append(finding)
        return finding

    def stop(self, message: str, line: int | None, fix: str) -> MergedText:
        return MergedText(self.existing, refused=Finding("RS905", Severity.error, message, Location(self.path, line), fix=fix))

    def result(self, before_conflicts: Sequence[str] = ()) -> MergedText:
        """The new text with the edits of the existing file, or the reason why the run must stop."""
        new, old = self.theirs.by_id(), self.ours.by_id()
        for broken in self.ours.broken:
            message = f"the marker of the region '{broken.identity}' is broken: {broken.what}; its text is merged like other text"
            self.say("RS513", Severity.warning, message, broken.line, "correct the markers")
        for twice in self.ours.twice():
            message = f"the region '{twice.identity}' occurs twice in the file (first in line {old[twice.identity].line})"
            return self.stop(message, twice.line, "remove one of them, or give it a unique id")
        line, said = _open_conflict(self.existing, self.base or "", self.generated), "a conflict of an earlier run is still open"
        fix = "decide which lines stay and remove its markers"
        if line is None and before_conflicts:
            line = _divider_left(self.existing, [self.base or "", self.generated, *before_conflicts])
            said = "only the middle marker of a conflict is left"
            fix = "remove it; if the line is yours, make it longer or remove the old file (.orig)"
        if line is not None:
            if self.base is not None and self.generated == self.base:
                self.say("RS516", Severity.error, said, line, fix)
                return MergedText(self.existing, self.findings)
            return self.stop(said, line, f"{fix}, then run again")
        if self.before is None and not set(new) & set(old):
            return self.stop("the file was not made by a run that keeps edits", None, "move it away, run again, put your text in")
        return self.merged(new, old)

    def merged(self, new: dict[str, Region], old: dict[str, Region]) -> MergedText:
        """The three-way merge, once it is clear that it can be done."""
        before = self.before.by_id() if self.before is not None else {i: r for i, r in old.items() if i in new}
        gone = {i for i in old if i not in new}
        returning = {i for i in old if i in new and i not in before}
        theirs = Parts([self._their(piece, old, before) for piece in self.theirs.pieces])
        behind = _behind(self.before) if self.before is not None else {}
        blank = {i for i, text in behind.items() if not text.strip()}
        own = {i for i, text in _behind(self.ours).items() if i in gone and (not text.strip() or text != behind.get(i))}
        ahead = _ahead(self.before) if self.before is not None else {}
        led = {i for i, text in _ahead(self.ours).items() if i in gone and text.strip() and text != ahead.get(i)}
        ours, orphans = _without(self.ours, gone | returning, own, led)
        ours_lines, theirs_lines = _lines(ours), _lines(theirs.text())
        if self.before is not None:
            base = Parts([self._base(piece, old) for piece in self.before.pieces])
            base_lines = _lines(_without(base, {i for i in before if i not in new}, blank)[0])
        else:
            base_lines = [
                ours_lines[c.ours[0] + k] for c in _common(ours_lines, theirs_lines) for k in range(c.ours[1] - c.ours[0])
            ]
            message = "no record of the last generated text: lines that only the file has stay, removed lines are back"
            self.say("RS520", Severity.info, message)
        for identity in before:
            if identity in new and identity not in old and self.before is not None:
                self.say("RS519", Severity.info, f"the region '{identity}' was removed from the file and is not generated again")
        if base_lines == ours_lines and not orphans:
            lines = [_Line(line) for line in theirs_lines]  # most files have no edit, and comparing takes long
        else:
            lines = self._assembled(base_lines, ours_lines, theirs_lines)
        text = self._with_orphans(lines, [orphan for orphan in orphans if orphan[1].identity in gone])
        if twice := partition(text, self.styles).twice():
            message = f"the file cannot be merged: the region '{twice[0].identity}' would occur twice"
            return self.stop(message, old[twice[0].identity].line if twice[0].identity in old else None, "move it back")
        return MergedText(text, self.findings, self.save_old)

    def _their(self, piece: str | Region, old: dict[str, Region], before: dict[str, Region]) -> str | Region:
        """A generated piece with the text that the file has in its place."""
        if isinstance(piece, str) or piece.identity not in old:
            return piece
        there, was = old[piece.identity], before.get(piece.identity)
        if there.kind == PROTECTED and there.enabled:
            return piece.as_in(there)
        lost = there.contents not in (was.contents if was is not None else piece.contents, piece.contents)
        if there.kind == PROTECTED and (was is None or was.enabled):
            message = f"the region '{piece.identity}' was turned off in the file and has its default text again"
            self.say("RS518", Severity.info, message + ("; the old file is saved" if lost else ""), there.line)
            self.save_old |= lost
        elif there.kind == CONTROLLED and there.enabled and lost:
            message = (
                f"the controlled region '{piece.identity}' was changed in the file and is generated again; the old file is saved"
            )
            self.say("RS518", Severity.info, message, there.line, "turn it off in the file to keep what you write there")
            self.save_old = True
        return piece

    def _base(self, piece: str | Region, old: dict[str, Region]) -> str | Region:
        """A piece of the previous text with the contents of the user's regions, so that these do not count as changes."""
        if isinstance(piece, str) or piece.identity not in old:
            return piece
        there = old[piece.identity]
        return piece.as_in(there) if there.enabled or piece.enabled else piece

    def _assembled(self, base: list[str], ours: list[str], theirs: list[str]) -> list[_Line]:
        """The merged lines."""
        from robosmi.generate.three_way import by_words, chunks, stretch  # most files have no edit

        lines: list[_Line] = []
        found = chunks(base, ours, theirs)
        edits = [chunk for chunk in found if chunk.kind == "ours"]
        told = (
            f"your {len(edits)} edits of the generated text are kept"
            if len(edits) > 1
            else "your edit of the generated text is kept"
        )
        for chunk in found:
            mine = stretch(ours, chunk.ours)
            if chunk.kind == "theirs":
                lines += [_Line(line) for line in stretch(theirs, chunk.theirs)]
            elif chunk.kind != "conflict":
                lines += [_Line(line, chunk.ours[0] + k + 1) for k, line in enumerate(mine)]
                if edits and chunk is edits[0] and mine:
                    lines[-len(mine)].notes.append(("RS512", Severity.info, told, None))
            elif (
                merged := by_words(_whole(stretch(base, chunk.base)), _whole(mine), _whole(stretch(theirs, chunk.theirs)))
            ) is not None:
                lines += [_Line(line, chunk.ours[0] + k + 1) for k, line in enumerate(merged)]
                both = "your edit and the new text change different words of the same lines; both are kept"
                lines[-1].notes.append(("RS512", Severity.info, both, "check that they fit together"))
            else:
                begin = _Line(YOURS)
                begin.notes.append(
                    (
                        CONFLICT,
                        Severity.error,
                        "your edit and the new text change the same lines: a conflict is marked",
                        "decide which lines stay and remove the markers; the old file is next to this one",
                    )
                )
                block = [*_whole(mine), BASE, *_whole(stretch(base, chunk.base)), MIDDLE, *_whole(stretch(theirs, chunk.theirs))]
                lines += [begin, *(_Line(piece) for piece in block), _Line(GENERATED, chunk.ours[1])]
                self.save_old = True
        return lines

    def _with_orphans(self, lines: list[_Line], orphans: list[tuple[int, Region, str]]) -> str:
        """The text with regions that are no longer generated, each after the lines it followed before."""
        for at, region, text in reversed(orphans):
            place = max((n for n, line in enumerate(lines, 1) if 0 < line.upto <= at), default=0)
            if place and not lines[place - 1].text.endswith("\n"):
                lines[place - 1].text += "\n"
            lines.insert(place, _Line(text))
            message = f"the region '{region.identity}' is no longer generated; it stays"
            fix = "move its text where it belongs and remove it; a renamed element has a new region"
            lines[place].notes.append(("RS510", Severity.warning, message, fix))
        number = 1
        for line in lines:
            for rule, severity, message, advice in line.notes:
                self.say(rule, severity, message, number, advice)
            number += line.text.count("\n")
        return "".join(line.text for line in lines)


class _Line(Struct):
    """One or more lines of the merged text, the number of the person's lines up to their end (0: none), and messages."""

    text: str
    upto: int = 0
    notes: list[tuple[str, Severity, str, str | None]] = []


def _lines(text: str) -> list[str]:
    return re.findall(r"[^\n]*\n|[^\n]+", text)


def _whole(lines: Sequence[str]) -> list[str]:
    """The lines, each with its line break."""
    return [line if line.endswith("\n") else line + "\n" for line in lines]


def _common(ours: list[str], theirs: list[str]) -> list[Chunk]:
    from robosmi.generate.three_way import chunks

    return [chunk for chunk in chunks(ours, ours, theirs) if chunk.kind == "same"]


def _open_conflict(text: str, *made: str) -> int | None:
    """The line of the first conflict mark that is in the file and in no generated text, or None.

    A single mark suffices, wherever an editor has moved it: the conflict is not resolved yet.
    """
    if not any(mark.strip() in text for mark in (YOURS, BASE, GENERATED)):
        return None
    marks = {mark.strip() for mark in (YOURS, BASE, GENERATED)}
    marks -= {line.strip() for one in made for line in one.split("\n")}
    return next((number for number, line in enumerate(text.split("\n"), 1) if line.strip() in marks), None)


_BLOCK_COMMENT = re.compile(r"/\*.*?(?:\*/|\Z)|<!--.*?(?:-->|\Z)", re.DOTALL)


def _divider_left(text: str, others: Sequence[str]) -> int | None:
    """The line of a conflict's divider if only that is left, or None.

    Seven equality signs may also underline a title. So they count only if the text has more of them than each of the texts it
    came from, and not in a block comment.
    """
    mark = MIDDLE.strip()
    if mark not in text:
        return None
    outside = _BLOCK_COMMENT.sub(lambda comment: "\n" * comment[0].count("\n"), text).split("\n")
    found = [number for number, line in enumerate(outside, 1) if line.strip() == mark]
    known = max(sum(line.strip() == mark for line in other.split("\n")) for other in others)
    return found[0] if len(found) > known else None


def _behind(parts: Parts) -> dict[str, str]:
    """Id of a region -> the text after its last marker on the same line."""
    pairs = pairwise(parts.pieces)
    return {one.identity: next_.partition("\n")[0] for one, next_ in pairs if isinstance(one, Region) and isinstance(next_, str)}


def _ahead(parts: Parts) -> dict[str, str]:
    """Id of a region -> the text before its first marker on the same line, if no other region is there."""
    found: dict[str, str] = {}
    text = "\n"
    for piece in parts.pieces:
        if isinstance(piece, str):
            text += piece
            continue
        if "\n" in text:
            found[piece.identity] = text.rpartition("\n")[2]
        text = ""
    return found


def _without(
    parts: Parts, identities: set[str], with_line: Collection[str] = (), with_lead: Collection[str] = ()
) -> tuple[str, list[tuple[int, Region, str]]]:
    """Remove some regions from a text; returns the rest, and for each region the number of lines before it and its text.

    Args:
        parts: the text.
        identities: the ids of these regions.
        with_line: those of them that take along what stands behind their last marker in the same line.
        with_lead: those of them that take along what stands before their first marker in the same line; blanks always go along.
    """
    kept = ""
    taken: list[tuple[int, Region, str]] = []
    behind = _behind(parts) if with_line else {}
    rest = ""  # what a region that was taken out takes along of the text behind it
    swallow = False  # the line break of a marker that was taken out
    for piece in parts.pieces:
        text = piece if isinstance(piece, str) else piece.text()
        text, rest = text.removeprefix(rest), ""
        if isinstance(piece, Region) and piece.identity in identities:
            margin = kept[kept.rfind("\n") + 1 :]
            alone = not margin.strip(" \t") or piece.identity in with_lead
            if alone:
                kept = kept.removesuffix(margin)
            rest = behind[piece.identity] if alone and piece.identity in with_line else ""
            taken.append((kept.count("\n"), piece, f"{margin if alone else ''}{text}{rest}\n"))
            swallow = alone
        else:
            kept += text.removeprefix("\n") if swallow else text
            swallow = False
    return kept, taken


class MergedTexts:
    """The merge of a run's new texts with the existing files; texts are added as they are made.

    Args:
        places: the output folder.
        place: the folder of the last texts, relative to it.
        known: relative path -> digest, of the files as the last run wrote them.

    Attributes:
        made: the texts as generated, relative path -> text.
        files: the texts to write, relative path -> bytes.
        records: the texts as generated, under their paths in the record.
        old: old files that are kept beside conflicts.
        merged: the files whose edits, if any, are in `files`, and their records; any other existing file must be guarded.
        obsolete: files (and their records) that an earlier run made, this one does not, and nobody changed.
        orphans: the same, but changed: they stay, with their records.
        findings: what was kept, and what the user has to look at.
    """

    def __init__(self, places: Places, place: str, known: Mapping[str, str]) -> None:
        self.made: dict[str, str] = {}
        self.files: dict[str, bytes] = {}
        self.records: dict[str, bytes] = {}
        self.old: dict[str, bytes] = {}
        self.merged: set[str] = set()
        self.obsolete: set[str] = set()
        self.orphans: set[str] = set()
        self.findings: list[Finding] = []
        self._places, self._known, self._record = places, known, Record(places.folder, place, known)
        self._refused: list[Finding] = []

    def add(self, made: Mapping[str, str], seen: _MergeView | None = None) -> None:
        """Merge newly made texts with the files that are there.

        Args:
            made: relative path -> text.
            seen: how the merge is to see the texts; as they are if None.

        Raises:
            SourceError: a link or a folder is where a file was made.
        """
        for name, text in made.items():
            self.made[name] = text
            self.files[name] = self.records[self._record.path(name)] = text.encode()
            _merge(self._places, self._record, name, text, self._known, self, self._refused, seen)

    def finish(self) -> None:
        """End the merge: files of the last run that were not added are made no longer.

        Raises:
            StoppedError: an edit would be lost; all such files are named.
        """
        if refused := self._refused:
            told = "; ".join(f"{f.location}: {f.message}" if len(refused) > 1 else f.message for f in refused)
            raise StoppedError(f"{told}; nothing was written", location=refused[0].location, fix=refused[0].fix)
        for name in self._record.names():
            if name not in self.made:
                _no_longer_made(self._places, self._record, name, self)


def _merge(
    places: Places,
    record: Record,
    name: str,
    text: str,
    known: Mapping[str, str],
    kept: MergedTexts,
    refused: list[Finding],
    seen: _MergeView | None,
) -> None:
    path, copy = str(places.folder / name), record.path(name)
    there = places.look(name)
    last, lost = record.last(name, there)
    if lost:
        if last is None and there is not None and not same_text(there, kept.files[name]):
            refused.append(lost_record(path, copy))
            return
        kept.findings.append(restored_copy(path, copy))
    elif last is None and there is not None:
        if digest(there) != known.get(name):
            return
        last = there  # made before there was a record, and nobody has changed it
    elif there is not None and there == last == kept.files[name]:
        kept.merged |= {name, copy}  # nobody has changed it, and it is made as it was
        return
    exact = "\r" in text
    base = read(last, as_it_is=exact, errors=_AS_BYTES).text if last is not None else None
    form = read(there, as_it_is=exact, errors=_AS_BYTES) if there is not None else FileText("")
    if base is not None and form.text != base and b"\0" in (there or b""):
        if text == base:
            kept.files[name] = there or b""
            kept.merged |= {name, copy}
            message = "the file is not UTF-8 text; it stays unchanged"
            kept.findings.append(Finding("RS522", Severity.warning, message, Location(path), fix="save it as UTF-8"))
            return
        message = "the file is not UTF-8 text, so your edits cannot be merged with the new text"
        refused.append(Finding("RS905", Severity.error, message, Location(path), fix="save it as UTF-8, then run again"))
        return
    existing = form.text if there is not None else None
    if seen is not None and base is not None and existing is not None:
        base, existing = seen(name, base, existing, text, places.folder / name)
    result = merge_edits(path, base, existing, text, styles_in(text), before_conflicts(places.folder, name))
    if result.refused is not None:
        refused.append(result.refused)
        return
    kept.merged |= {name, copy}
    kept.findings += result.findings
    same = there is not None and result.text == form.text
    kept.files[name] = there if there is not None and same else form.written(result.text)
    if result.save_old and there is not None:
        kept.old[free_name(places.folder, f"{name}.orig")] = there


def _no_longer_made(places: Places, record: Record, name: str, kept: MergedTexts) -> None:
    path = places.folder / name
    there, (last, _) = places.look(name), record.last(name, None)
    if there is None or same_text(there, last):
        kept.obsolete |= {record.path(name)} | ({name} if there is not None else set())
        return
    kept.orphans |= {name, record.path(name)}
    message = "the file is no longer generated, but was edited; it stays"
    kept.findings.append(Finding("RS514", Severity.warning, message, Location(str(path)), fix="remove it if you do not need it"))
