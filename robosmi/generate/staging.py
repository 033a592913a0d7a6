"""Collects the files of a run before any is written: their existing content, the new text, and the result.

By default it follows EGL's engine: enabled protected regions are preserved, everything else is regenerated. With a record
(`merge_edits`) edits elsewhere are preserved, too. All decisions are made before all files are written at once; a run that fails
changes nothing.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import overload

from msgspec import Struct

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError, StoppedError
from robosmi.files.commit import commit
from robosmi.files.files import free_name
from robosmi.files.recovery import look_only
from robosmi.files.run_lock import is_noted, note
from robosmi.generate.manifest import hidden, retained_file
from robosmi.generate.merge_edits import merge_edits
from robosmi.generate.output import Text, text_of
from robosmi.generate.output_paths import Places, before_conflicts
from robosmi.generate.record import Record, lost_record, restored_copy
from robosmi.generate.regions import BrokenMarker, merge
from robosmi.generate.result import FileChange, Generation, Write
from robosmi.generate.text_form import FileText, read, same_text


class Pending(Struct, eq=False):
    """A file of a run.

    Attributes:
        before: its bytes at the start of the run, None if it did not exist.
        there: these bytes decoded as text, None until requested.
        text: its current text, None if there is none, or until requested.
        made: the text that templates generated for it in this run, None if none (it was preserved, or appended to).
        touched: whether a text was written to it in this run.
        same: whether its text is that of the file, byte for byte.
        formed: whether it keeps its line ends and byte order mark.
        origins: the texts that were written to it.
    """

    name: str
    before: bytes | None
    there: FileText | None = None
    text: str | None = None
    made: str | None = None
    touched: bool = False
    same: bool = False
    formed: bool = False
    origins: tuple[Write, ...] = ()

    def change(self) -> FileChange:
        """What happens to the file."""
        if self.there is None and self.before is not None and not self.same:
            self.there = read(self.before)
        before = self.text if self.same else self.there.text if self.there is not None else None
        return FileChange(self.name, before, self.text, self.origins)

    def written(self) -> bytes:
        """The bytes of its text."""
        text = self.text or ""
        return self.there.written(text) if self.formed and self.there is not None else text.encode()


class Staging:
    """The files of one run.

    Args:
        folder: the output folder.
        record: where the last texts are; None for the engine's behaviour.
    """

    def __init__(self, folder: Path, record: Record | None) -> None:
        self.folder = folder
        self.findings: list[Finding] = []
        self._messages: list[str] = []
        self._record = record
        self._unread = False
        self._queue: list[Write] = []
        self._files: dict[str, Pending] = {}
        self._places: Places | None = None
        self._replaced: set[str] = set()

    def ignore_folder(self) -> None:
        """Go on as if the folder were empty and no run had been there; it is not looked at any more."""
        self._unread, self._record = True, None

    def write(self, one: Write) -> None:
        """Put a text into a file, as EGL's `generate` and `append` do. Existing files are read and merged later.

        Reading many files in a row is much faster than reading one between two templates.
        """
        self._queue.append(one)

    @property
    def messages(self) -> list[str]:
        """What EGL's engine says of the files so far."""
        self._flush()
        return self._messages

    def _flush(self) -> None:
        """Perform the requested writes.

        Raises:
            SourceError: a path leads out of the folder, or a file that is there is no text in UTF-8.
        """
        queue, self._queue = self._queue, []
        files = [self.file(one.name) for one in queue]
        for one, file in zip(queue, files, strict=True):
            text, name = one.text, file.name
            if not file.touched and file.text is None and one.overwrite and not one.append and file.before == text.encode():
                file.text = file.made = text  # the common case of a second run
                file.touched = file.same = True
                file.origins = (one,)
                self._messages.append(f"Content unchanged for {name}")
            else:
                self._put(one, file)

    def _put(self, one: Write, file: Pending) -> None:
        text, name = one.text, file.name
        self._tell_replaced(one, file)
        there = self.text(file, as_it_is="\r" in text)
        if there is None:
            self._done(file, text, f"Successfully {'appended to' if one.append else 'wrote to'} {name}", text, one)
        elif one.append:
            one.line, file.formed = there.count("\n") + 1, True
            self._done(file, f"{there}\n{text}", f"Successfully appended to {name}", None, one)
        elif not one.overwrite:
            self._messages.append(f"Existing contents of {name} were preserved.")
        elif self._record is not None:
            made = merge(text, file.made, one.styles).text if file.made is not None and one.merging else text
            self._done(file, made, f"Successfully wrote to {name}", made, one)
        elif one.merging:
            merged = merge(text, there, one.styles)
            file.formed = merged.owned
            for broken in merged.broken if merged.text != there else ():
                self._broken(name, broken)
            for lost in merged.lost:
                self._messages.append(f"The protected region '{lost}' was not preserved in {name}")
                self._lost(name, lost, "the template no longer makes it", "generate with keep, which keeps such regions")
            self._done(file, merged.text, f"Protected regions preserved in {name}", text, one)
        else:
            self._done(file, text, f"Successfully wrote to {name}", text, one)

    def _tell_replaced(self, one: Write, file: Pending) -> None:
        """Say of a file, once, that a second text of the same run takes the place of the first."""
        if one.append or not one.overwrite or not file.origins or file.text == one.text or file.name in self._replaced:
            return
        self._replaced.add(file.name)
        rules = " and ".join(dict.fromkeys(f"'{rule}'" for rule in (file.origins[-1].rule, one.rule) if rule)) or "the run"
        self.findings.append(
            Finding(
                "RS534", Severity.warning, f"{rules} made the file '{file.name}' more than once: only the last text is in it",
                Location(f"{self.folder}/{file.name}"), fix="let the target name the element, or append=True",
            )
        )  # fmt: skip

    def preserved(self, name: str) -> bool:
        """Whether there is a file, so that a rule that does not overwrite leaves it alone."""
        self._flush()
        if self.text(self.file(name)) is None:
            return False
        self._messages.append(f"Existing contents of {name} were preserved.")
        return True

    def file(self, name: str) -> Pending:
        """The file of that name, read when it is first asked for.

        Raises:
            SourceError: the path leads out of the folder.
        """
        found = self._files.get(name)
        if found is None:
            if self._places is None:
                if not self._unread:
                    look_only(self.folder)
                self._places = Places(self.folder)
            if self._record is not None and f"{name}/".startswith(f"{self._record.place}/"):
                raise SourceError(f"the target '{name}' is where the last texts are kept", fix="give the file another name")
            if self._unread:
                self._places.check_name(name)
            found = self._files[name] = Pending(name, None if self._unread else self._places.read(name))
        return found

    def text(self, file: Pending, *, as_it_is: bool = False) -> str | None:
        """The current text of a file; with `as_it_is` including carriage returns, for templates that write some."""
        if file.text is None and file.before is not None:
            file.there = self._decoded(file.name, file.before, as_it_is=as_it_is)
            file.text = file.there.text
        return file.text

    def _decoded(self, name: str, data: bytes, *, as_it_is: bool = False) -> FileText:
        try:
            return read(data, as_it_is=as_it_is)
        except UnicodeDecodeError as error:
            raise SourceError(
                f"the existing file is not UTF-8 text ({error.reason} at byte {error.start}), so it cannot be merged",
                location=Location(f"{self.folder}/{name}"),
                fix="move it away, or give another target",
            ) from error

    def _done(self, file: Pending, text: str, message: str, made: str | None, one: Write) -> None:
        if file.text == text:
            message = f"Content unchanged for {file.name}"
        self._messages.append(message)
        file.origins = (*file.origins, one) if one.append else (one,)
        file.text, file.made, file.touched = text, made, True

    def _broken(self, name: str, broken: BrokenMarker) -> None:
        """Handle a region whose markers the user has damaged.

        Raises:
            StoppedError: the person still sees a region there, but the engine does not.
        """
        if broken.crowded:
            raise StoppedError(
                f"the marker of the region '{broken.identity}' is broken: {broken.what}; what was written there would be lost, "
                "so nothing was written",
                location=Location(f"{self.folder}/{name}", broken.line),
                fix="put each marker into its own line, or generate with keep, which keeps the text",
            )
        self._lost(name, broken.identity, f"its marker is broken ({broken.what})", "correct its markers, or generate with keep")

    def _lost(self, name: str, identity: str, why: str, fix: str) -> None:
        place = Location(f"{self.folder}/{name}")
        self.findings.append(
            Finding("RS515", Severity.warning, f"the text of the region '{identity}' is lost: {why}", place, fix=fix)
        )

    def finish(self, *, dry_run: bool) -> Generation:
        """Decide on all files and write what changed, all or nothing.

        Args:
            dry_run: write nothing.

        Raises:
            StoppedError: with a record, an edit would be lost; all such files are named.
            SourceError: the folder cannot be written.
        """
        self._flush()
        files = [file for file in self._files.values() if file.touched]
        contents: dict[str, bytes] = {}
        removed: list[str] = []
        if self._record is not None:
            contents, removed = self._kept(self._record, files)
        else:
            for file in files:
                if not file.same and file.text is not None and file.text != self._there(file):
                    contents[file.name] = file.written()
                    self._reformed(file)
        if not dry_run:
            if self._record is not None:
                self._note(self._record, contents)
            commit(self.folder, contents, removed, {name: file.before for name, file in self._files.items()})
        changes = Changes(files)
        return Generation(self.folder, changes, self._messages, self.findings, sorted(contents), sorted(removed), not dry_run)

    def _reformed(self, file: Pending) -> None:
        """Says that a file loses its line ends or byte order mark, as with EGL's engine."""
        if not file.formed and file.there is not None and (file.there.marked or {*(file.there.ends or ())} - {"\n"}):
            message = "the file is generated again with line feeds and without a byte order mark; it had others"
            place = Location(f"{self.folder}/{file.name}")
            self.findings.append(Finding("RS523", Severity.info, message, place, fix="generate with keep, which keeps them"))

    def _there(self, file: Pending) -> str | None:
        """The text of a file when the run began."""
        if file.before is not None and file.there is None:
            file.there = self._decoded(file.name, file.before, as_it_is="\r" in (file.made or ""))
        return file.there.text if file.there is not None else None

    def _kept(self, record: Record, files: list[Pending]) -> tuple[dict[str, bytes], list[str]]:
        """What a run with a record writes and removes: the files, their last texts, old files beside conflicts."""
        contents: dict[str, bytes] = {}
        refused: list[Finding] = []
        for file in files:
            file.formed = True
            if file.made is not None:
                self._merge(record, file, file.made, contents, refused)
            elif file.text is not None and file.text != self._there(file):
                contents[file.name] = file.written()
        if refused:
            several = len(refused) > 1
            told = "; ".join(f"{self._named(f.location)}: {f.message}" if several else f.message for f in refused)
            raise StoppedError(f"{told}; nothing was written", location=refused[0].location, fix=refused[0].fix)
        removed: list[str] = []
        own, foreign = self._is_own(record), set()
        for name in record.names():
            if name not in self._files:
                if not (own and record.is_listed(name)):
                    foreign.add(record.path(name))
                self._obsolete(record, name, removed, mine=record.path(name) not in foreign and not hidden(name))
        listed = record.listed(contents, {*removed, *foreign})
        if listed != self.file(record.list).before:
            contents[record.list] = listed
        return contents, removed

    def _merge(self, record: Record, file: Pending, made: str, contents: dict[str, bytes], refused: list[Finding]) -> None:
        copy, new, path = record.path(file.name), made.encode(), f"{self.folder}/{file.name}"
        if record.read(file.name) != new:
            contents[copy] = new
        if file.same:
            return
        last, lost = record.last(file.name, file.before)
        if lost and (last is not None or file.before is None):
            self.findings.append(restored_copy(path, copy))
        elif lost:
            refused.append(lost_record(path, copy))
            return
        base = self._decoded(copy, last, as_it_is="\r" in made).text if last is not None else None
        there = self._there(file)
        kept = merge_edits(path, base, there, made, file.origins[-1].styles, before_conflicts(self.folder, file.name))
        if kept.refused is not None:
            refused.append(kept.refused)
            return
        self.findings += kept.findings
        file.text = kept.text
        if kept.text != there:
            contents[file.name] = file.written()
        if kept.save_old and file.before is not None:
            contents[free_name(self.folder, f"{file.name}.orig")] = file.before

    def _named(self, place: Location | None) -> str:
        """A place with its path relative to the output folder."""
        return str(place).removeprefix(f"{self.folder}/")

    def _is_own(self, record: Record) -> bool:
        """Whether a run of this user has written the list of the last texts, where it is now."""
        before = self.file(record.list).before
        return before is not None and is_noted(self.folder / record.list, before)

    def _note(self, record: Record, contents: Mapping[str, bytes]) -> None:
        """Note that the list of the last texts is written by a run of this user."""
        path, before = self.folder / record.list, self.file(record.list).before
        own, data = self._is_own(record), contents.get(record.list, before)
        if data is not None and not (own and data == before):
            note(path, data, *([before] if own and before is not None else []))

    def _obsolete(self, record: Record, name: str, removed: list[str], *, mine: bool) -> None:
        """A file that an earlier run made and this one does not: removed if it was this user's, unless the user changed it."""
        there, (last, _) = self.file(name).before, record.last(name, None)
        if not mine and (there is None or same_text(there, last)):
            self.findings += [retained_file(self.folder / name)] if there is not None else []
            return
        if there is None or same_text(there, last):
            removed += [record.path(name)] if there is None else [name, record.path(name)]
            return
        message = "the file is no longer generated, but was edited; it stays"
        place = Location(f"{self.folder}/{name}")
        self.findings.append(Finding("RS514", Severity.warning, message, place, fix="remove it if you do not need it"))


class Changes(Sequence[FileChange]):
    """The changes of files, computed on demand: most runs change little, and nobody looks at the rest."""

    def __init__(self, files: list[Pending]) -> None:
        self._files = files

    @overload
    def __getitem__(self, index: int) -> FileChange: ...
    @overload
    def __getitem__(self, index: slice) -> list[FileChange]: ...
    def __getitem__(self, index: int | slice) -> FileChange | list[FileChange]:
        if isinstance(index, int):
            return self._files[index].change()
        return [file.change() for file in self._files[index]]

    def __len__(self) -> int:
        return len(self._files)


def as_text(text: str) -> Text:
    """A text of unknown origin as `Text`."""
    return text if isinstance(text, Text) else text_of(text)
