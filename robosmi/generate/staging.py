"""The files of a run before any is written: what is there, what was made, and what becomes of it.

By default as EGL's engine does: protected regions that are on are kept, all else is made anew. With a record (`keep`) edits
elsewhere are kept too. Everything is decided here and handed over to be written at once; a run that fails leaves no trace.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import overload

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError, StoppedError
from robosmi.generate.keep import keep
from robosmi.generate.output import Text, text_of
from robosmi.generate.places import Places
from robosmi.generate.record import Record
from robosmi.generate.regions import merge
from robosmi.generate.result import FileChange, Generation, Write
from robosmi.model.commit import commit, recover


@dataclass(slots=True, eq=False, repr=False)
class Pending:
    """A file of a run.

    Attributes:
        before: its bytes when the run began, None if it was not there.
        text: its text as it stands now, None if there is none, or if nobody asked yet.
        made: what templates made for it in this run, None if nothing was (it was preserved, or appended to).
        touched: whether a text was put there in this run.
        same: whether its text is that of the file, byte for byte.
        origins: what was written into it.
    """

    name: str
    before: bytes | None
    text: str | None = None
    made: str | None = None
    touched: bool = False
    same: bool = False
    origins: tuple[Write, ...] = ()

    def change(self) -> FileChange:
        """What happens to the file."""
        before = self.text if self.same else None if self.before is None else self.before.decode().replace("\r\n", "\n")
        return FileChange(self.name, before, self.text, self.origins)


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

    def ignore_folder(self) -> None:
        """Go on as if the folder were empty and no run had been there; it is not looked at any more."""
        self._unread, self._record = True, None

    def write(self, one: Write) -> None:
        """Put a text into a file, as EGL's `generate` and `append` do. It happens when somebody asks for the outcome.

        Reading many files in a row is much faster than reading one between two templates.
        """
        self._queue.append(one)

    @property
    def messages(self) -> list[str]:
        """What EGL's engine says of the files so far."""
        self._flush()
        return self._messages

    def _flush(self) -> None:
        """Do what was asked for.

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
        there, text, name = self.text(file), one.text, file.name
        if there is None:
            self._done(file, text, f"Successfully {'appended to' if one.append else 'wrote to'} {name}", text, one)
        elif one.append:
            one.line = there.count("\n") + 1
            self._done(file, f"{there}\n{text}", f"Successfully appended to {name}", None, one)
        elif not one.overwrite:
            self._messages.append(f"Existing contents of {name} were preserved.")
        elif self._record is not None:
            made = merge(text, file.made, one.styles).text if file.made is not None and one.merging else text
            self._done(file, made, f"Successfully wrote to {name}", made, one)
        elif one.merging:
            merged = merge(text, there, one.styles)
            for lost in merged.lost:
                self._lost(name, lost)
            self._done(file, merged.text, f"Protected regions preserved in {name}", text, one)
        else:
            self._done(file, text, f"Successfully wrote to {name}", text, one)

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
                    recover(self.folder)
                self._places = Places(self.folder)
            if self._record is not None and f"{name}/".startswith(f"{self._record.place}/"):
                raise SourceError(f"the target '{name}' is where the last texts are kept", fix="give the file another name")
            if self._unread:
                self._places.check_name(name)
            found = self._files[name] = Pending(name, None if self._unread else self._places.read(name))
        return found

    def text(self, file: Pending) -> str | None:
        """The text of a file as it stands now."""
        if file.text is None and file.before is not None:
            file.text = self._decoded(file.name, file.before)
        return file.text

    def _decoded(self, name: str, data: bytes) -> str:
        try:
            return data.decode("utf-8").replace("\r\n", "\n")
        except UnicodeDecodeError as error:
            raise SourceError(
                f"the file that is there is no text in UTF-8 ({error.reason} at byte {error.start}), so it cannot be merged",
                location=Location(f"{self.folder}/{name}"),
                fix="move it away, or give another target",
            ) from error

    def _done(self, file: Pending, text: str, message: str, made: str | None, one: Write) -> None:
        if file.text == text:
            message = f"Content unchanged for {file.name}"
        self._messages.append(message)
        file.origins = (*file.origins, one) if one.append else (one,)
        file.text, file.made, file.touched = text, made, True

    def _lost(self, name: str, identity: str) -> None:
        self._messages.append(f"The protected region '{identity}' was not preserved in {name}")
        message = f"the text of the region '{identity}' is lost: the template no longer makes it"
        place = Location(f"{self.folder}/{name}")
        self.findings.append(
            Finding("RS515", Severity.warning, message, place, fix="generate with keep, which keeps such regions")
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
                    contents[file.name] = file.text.encode()
        if not dry_run:
            commit(self.folder, contents, removed)
        changes = Changes(files)
        return Generation(self.folder, changes, self._messages, self.findings, sorted(contents), sorted(removed), not dry_run)

    def _there(self, file: Pending) -> str | None:
        """The text of a file when the run began."""
        return None if file.before is None else self._decoded(file.name, file.before)

    def _kept(self, record: Record, files: list[Pending]) -> tuple[dict[str, bytes], list[str]]:
        """What a run with a record writes and removes: the files, their last texts, old files beside conflicts."""
        contents: dict[str, bytes] = {}
        refused: list[Finding] = []
        for file in files:
            if file.made is not None:
                self._merge(record, file, file.made, contents, refused)
            elif file.text is not None and file.text != self._there(file):
                contents[file.name] = file.text.encode()
        if refused:
            several = len(refused) > 1
            told = "; ".join(f"{self._named(f.location)}: {f.message}" if several else f.message for f in refused)
            raise StoppedError(f"{told}; nothing was written", location=refused[0].location, fix=refused[0].fix)
        removed: list[str] = []
        for name in record.names():
            if name not in self._files:
                self._obsolete(record, name, removed)
        return contents, removed

    def _merge(self, record: Record, file: Pending, made: str, contents: dict[str, bytes], refused: list[Finding]) -> None:
        last, new = record.read(file.name), made.encode()
        if last != new:
            contents[record.path(file.name)] = new
        if file.same:
            return
        base = self._decoded(record.path(file.name), last) if last is not None else None
        there = self._there(file)
        kept = keep(f"{self.folder}/{file.name}", base, there, made, file.origins[-1].styles)
        if kept.refused is not None:
            refused.append(kept.refused)
            return
        self.findings += kept.findings
        file.text = kept.text
        if kept.text != there:
            contents[file.name] = kept.text.encode()
        if kept.save_old and there is not None:
            contents[self._free(f"{file.name}.orig")] = there.encode()

    def _named(self, place: Location | None) -> str:
        """A place with its path relative to the output folder."""
        return str(place).removeprefix(f"{self.folder}/")

    def _free(self, name: str) -> str:
        """The name, or with a number behind it where there is such a file."""
        number, found = 1, name
        while (self.folder / found).exists():
            number += 1
            found = f"{name}.{number}"
        return found

    def _obsolete(self, record: Record, name: str, removed: list[str]) -> None:
        """A file that an earlier run made and this one does not: removed, unless a person changed it."""
        there, last = self.file(name).before, record.read(name)
        if there is None or there == last:
            removed += [record.path(name)] if there is None else [name, record.path(name)]
            return
        message = "it is no longer made, and was changed since it was; it is kept"
        place = Location(f"{self.folder}/{name}")
        self.findings.append(Finding("RS514", Severity.warning, message, place, fix="remove it when you do not need it"))


class Changes(Sequence[FileChange]):
    """The changes of files, each made when it is asked for: most runs change little and nobody looks at the rest."""

    def __init__(self, files: list[Pending]) -> None:
        self._files = files

    @overload
    def __getitem__(self, index: int) -> FileChange: ...
    @overload
    def __getitem__(self, index: slice) -> list[FileChange]: ...
    def __getitem__(self, index: int | slice) -> FileChange | list[FileChange]:
        if isinstance(index, slice):
            return [file.change() for file in self._files[index]]
        return self._files[index].change()

    def __len__(self) -> int:
        return len(self._files)


def as_text(text: str) -> Text:
    """A text of unknown origin as `Text`."""
    return text if isinstance(text, Text) else text_of(text)
