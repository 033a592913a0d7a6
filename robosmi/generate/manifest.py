"""The manifest: what the last run made, so that nothing a person changed is ever overwritten.

`.robosmi.json` in the output folder lists every generated file with the digest it had. A file whose digest is not that
one was edited; the run stops before anything is written. Files that no run made are never touched.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from robosmi.data_text import json_of
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError, StoppedError
from robosmi.generate.places import Places
from robosmi.generate.text_form import has_digest
from robosmi.inputs import RECORD, read_text
from robosmi.model.files import digest, within

NAME = ".robosmi.json"
SCHEMA = "robosmi-manifest/1"


@dataclass
class Guarded:
    """What a run finds in its output folder and may go on with.

    Attributes:
        obsolete: files of the last run that this one no longer makes and nobody changed.
        deleted: files of the last run that this one makes again.
        reformed: files whose line ends or byte order mark were changed, and nothing else; they are made anew as they were.
    """

    obsolete: set[str] = field(default_factory=set)
    deleted: list[str] = field(default_factory=list)
    reformed: list[str] = field(default_factory=list)


@dataclass
class Manifest:
    """What the last run made.

    Attributes:
        files: relative path (with slashes) -> SHA-256 of what was written there.
        choices: choices of persons that were already counted in the history, so that a second run does not count them again.
    """

    files: dict[str, str] = field(default_factory=dict)
    choices: list[str] = field(default_factory=list)

    @classmethod
    def load(cls, folder: Path) -> Manifest:
        """The manifest in an output folder; an empty one where there is none.

        Raises:
            SourceError: it is damaged, so that edits could not be told from generated text.
        """
        path = folder / NAME
        if not path.is_file():
            return cls()
        try:
            data = json_of(read_text(path, RECORD))
            files = {str(k): str(v) for k, v in data["files"].items()}
            choices = [str(c) for c in data.get("choices", ())]
            if outside := [name for name in files if not within(name)]:
                raise ValueError(f"'{outside[0]}' lies outside of the folder")
        except (OSError, ValueError, KeyError, AttributeError, TypeError) as error:
            raise SourceError(
                f"the record of the last run cannot be read: {error}",
                location=Location(str(path)),
                fix="remove it together with the generated files, or give another output folder",
            ) from error
        return cls(files, choices)

    @classmethod
    def of(cls, contents: Mapping[str, bytes], choices: Iterable[str] = ()) -> Manifest:
        """The manifest for new contents."""
        return cls({name: digest(data) for name, data in contents.items()}, sorted(choices))

    def to_bytes(self) -> bytes:
        """The file's bytes, the same for the same contents."""
        return (
            json.dumps({"schema": SCHEMA, "choices": self.choices, "files": self.files}, indent=1, sort_keys=True) + "\n"
        ).encode()

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


def reformed_file(path: Path) -> Finding:
    """Says that a file whose form was changed is made anew as it was."""
    message = "its line ends or byte order mark were changed; it is made anew with its own"
    return Finding("RS523", Severity.info, message, Location(str(path)))
