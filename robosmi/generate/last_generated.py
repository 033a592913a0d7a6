"""`merge_edits` for texts that `Gen.make` gave, or that were made some other way: they are merged with the files that are there.

The caller writes them, with whatever else it makes, in one commit. The record of last texts is a folder of its output.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import StoppedError
from robosmi.files.files import digest, free_name
from robosmi.generate.merge_edits import merge_edits
from robosmi.generate.output_paths import Places, before_conflicts
from robosmi.generate.record import Record, lost_record, restored_copy
from robosmi.generate.regions import styles_in
from robosmi.generate.text_form import FileText, read, same_text

_AS_BYTES = "surrogateescape"
"""Bytes that are no UTF-8, in a comment of another encoding perhaps, go through a merge unchanged."""


MergeView = Callable[[str, str, str, str, Path], tuple[str, str]]
"""A function that adapts texts for the merge, so that changes the user is entitled to make are no conflicts.

It maps (relative path, previously generated text, existing text, new text, path) to the adapted first two texts.
"""


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

    def add(self, made: Mapping[str, str], seen: MergeView | None = None) -> None:
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
    seen: MergeView | None,
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
