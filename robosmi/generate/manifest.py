"""The manifest: what the last run made, so that nothing the user changed is ever overwritten.

`.robosmi.json` in the output folder lists every generated file with the digest it had. A file whose digest is not that one was
edited; the run stops before anything is written. Files that no run made are never touched. A manifest that came with its folder
from elsewhere (see `robosmi.files.run_lock`) serves to compare and merge; nothing is removed on its word.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path, PurePosixPath

from msgspec import Struct

from robosmi.base.data_text import Json, json_of, json_written
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError, StoppedError
from robosmi.files.files import digest, within
from robosmi.files.run_lock import is_noted, note
from robosmi.generate.output_paths import Places
from robosmi.generate.text_form import has_digest
from robosmi.inputs import RECORD, fix_of, read_bytes

NAME = ".robosmi.json"
SCHEMA = "robosmi-manifest/1"


class Guarded(Struct):
    """The result of checking an output folder, if a run may continue.

    Attributes:
        obsolete: files of the last run that this one no longer makes and nobody changed.
        deleted: files of the last run that were deleted and are made again.
        reformed: files of which only line ends or byte order mark were changed; they are made anew in their original form.
    """

    obsolete: set[str] = set()
    deleted: list[str] = []
    reformed: list[str] = []


def _check_folder(folder: Path) -> None:
    """Make sure that an output folder is one, or can be made.

    Raises:
        SourceError: a file, or links that lead to each other, stand where it or a folder above it is to be.
    """
    for path in (folder, *folder.parents):
        if not os.path.lexists(path):
            continue
        if not path.is_dir():
            what = "a broken link is" if path.is_symlink() and not path.exists() else "a file is"
            raise SourceError(
                f"{what} in the place of the output folder",
                location=Location(str(path)),
                fix="give another output folder with -o",
            )
        return


class Manifest(Struct):
    """What the last run made.

    Attributes:
        files: relative path (with slashes) -> SHA-256 of what was written there.
        choices: choices of persons that were already counted in the history, so that a second run does not count them again.
        found: its bytes as they were read; None if there was no file.
        own: whether a run of this user has written it, where it is now.
        beside_choices: SHA-256 of what the last run wrote into the plan without the choices in it; empty where none is recorded.
    """

    files: dict[str, str] = {}
    choices: list[str] = []
    found: bytes | None = None
    own: bool = True
    beside_choices: str = ""

    @classmethod
    def load(cls, folder: Path) -> Manifest:
        """The manifest in an output folder; an empty one where there is none.

        Raises:
            SourceError: it is damaged or no ordinary file, so that edits could not be told from generated text; or the output
                folder cannot be one.
        """
        _check_folder(folder)
        path = folder / NAME
        fix = "remove it together with the generated files, or give another output folder"
        try:
            found = read_bytes(path, RECORD, follow=False)
            data = json_of(found.decode())
            files, choices, beside_choices = _entries(data)
        except (FileNotFoundError, NotADirectoryError):
            return cls()
        except IsADirectoryError as error:
            message, fix = "a folder is in the place of a file", "move it away, or give another output folder"
            raise SourceError(message, location=Location(str(path)), fix=fix) from error
        except OSError as error:
            why = "it is a link" if path.is_symlink() else error.strerror
            fix = "replace the link with a copy of the file" if path.is_symlink() else fix_of(error, fix)
            raise SourceError(
                f"the record of the last run cannot be read: {why}", location=Location(str(path)), fix=fix
            ) from error
        except ValueError as error:
            raise SourceError(
                f"the record of the last run cannot be read: {error}", location=Location(str(path)), fix=fix
            ) from error
        return cls(files, choices, found, is_noted(path, found), beside_choices)

    def note(self, folder: Path, data: bytes) -> None:
        """Note that a run of this user is about to write these bytes in place of this manifest.

        Raises:
            SourceError: there is no place for the note.
        """
        if not self.own or data != self.found:
            note(folder / NAME, data, *([self.found] if self.own and self.found is not None else []))

    def may_remove(self, name: str) -> bool:
        """Whether a file goes because runs of this user have made it: this manifest is theirs, and says so."""
        return self.own and name in self.files

    @classmethod
    def of(cls, contents: Mapping[str, bytes], choices: Iterable[str] = ()) -> Manifest:
        """The manifest for new contents."""
        return cls({name: digest(data) for name, data in contents.items()}, sorted(choices))

    def to_bytes(self) -> bytes:
        """The file's bytes, the same for the same contents."""
        data: dict[str, Json] = {"schema": SCHEMA, "choices": self.choices, "files": self.files}
        if self.beside_choices:
            data["beside_choices"] = self.beside_choices
        return (json_written(data, indent=1, sort_keys=True) + "\n").encode()

    def guard(
        self, places: Places, contents: Mapping[str, bytes], *, inputs: Mapping[str, bytes | None] | None = None
    ) -> Guarded:
        """Make sure that writing these contents loses nothing.

        Args:
            places: the output folder.
            contents: what is about to be written, relative path -> bytes.
            inputs: files among them whose edits are already in what is written, with what the run has read there.

        Returns:
            What is there besides.

        Raises:
            StoppedError: a file was changed since the last run, or was never made by a run; all are named.
            SourceError: a link or a folder is where a file was made.
        """
        known = inputs or {}
        edited: list[str] = []
        foreign: list[str] = []
        guarded = Guarded()
        for name in sorted({*contents, *self.files}):
            if name in known:
                places.seen[name] = known[name]
                continue
            data = places.look(name)
            if data is None:
                if name in contents and name in self.files:
                    guarded.deleted.append(name)
            elif contents.get(name) == data:
                continue
            elif name not in self.files:
                foreign.append(name)
            elif digest(data) == self.files[name]:
                if name not in contents:
                    guarded.obsolete.add(name)
            elif name in contents:
                (guarded.reformed if has_digest(data, self.files[name]) else edited).append(name)
        if edited or foreign:
            why = [f"'{n}' was changed since the last run" for n in edited] + [f"'{n}' was not made by robosmi" for n in foreign]
            raise StoppedError(
                f"{'; '.join(why)}: writing would lose it, so nothing was written",
                location=Location(str(places.folder / (edited + foreign)[0])),
                fix="move the file away (or give another output folder with -o), run again, and put your changes back in",
            )
        return guarded


def _entries(data: object) -> tuple[dict[str, str], list[str], str]:
    """The files and choices of a manifest, and the digest of the plan beside its choices.

    Raises:
        ValueError: it has another form, or names a file outside of its folder.
    """
    files = data.get("files") if isinstance(data, dict) else None
    choices = data.get("choices", []) if isinstance(data, dict) else None
    if not isinstance(files, dict) or not all(isinstance(value, str) for value in files.values()):
        raise ValueError("'files' must say for each path its SHA-256")
    if not isinstance(choices, list) or not all(isinstance(choice, str) for choice in choices):
        raise ValueError("'choices' must be a list of texts")
    if outside := [name for name in files if not within(name)]:
        raise ValueError(f"'{outside[0]}' is outside the folder")
    beside = data.get("beside_choices", "") if isinstance(data, dict) else ""
    if not isinstance(beside, str):
        raise ValueError("'beside_choices' must be a text")
    return files, choices, beside


def hidden(name: str) -> bool:
    """Whether a relative path has a part with a dot in front, as `.git`: such files are never removed."""
    return any(part.startswith(".") for part in PurePosixPath(name).parts)


def retained_file(path: Path) -> Finding:
    """Says that a file which is no longer made stays, since nothing of this user's own says that a run made it."""
    message = "the file is no longer generated, but its record is not from your own runs in this place; it stays"
    return Finding("RS525", Severity.warning, message, Location(str(path)), fix="remove it if you do not need it")


def reformed_file(path: Path) -> Finding:
    """Says that a file whose form was changed is made anew as it was."""
    message = "its line ends or byte order mark were changed; it is generated again with its own"
    return Finding("RS523", Severity.info, message, Location(str(path)))
