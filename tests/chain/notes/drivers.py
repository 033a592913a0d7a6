"""Drivers of a chain's own, good and bad ones."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from robosmi.generate import Gen
from robosmi.model.elements.driver import Model, ModelElement, Type


class Note(ModelElement):
    """A line of the text."""

    def __init__(self, number: int, text: str) -> None:
        object.__setattr__(self, "number", number)
        object.__setattr__(self, "text", text)

    def eContainer(self) -> None:
        """Nothing contains a line."""

    def _features(self) -> list[str]:
        return ["number", "text"]

    def _contents(self) -> list[Any]:
        return []


class Notes(Model):
    """A text, each line of which is a note."""

    read_only = True

    def __init__(self, path: Path, name: str | None = None) -> None:
        super().__init__(name or path.stem, path)
        lines = path.read_text(encoding="utf-8").splitlines()
        self.notes = [Note(number, line.strip()) for number, line in enumerate(lines, 1)]

    def types(self) -> Iterator[tuple[str, Type]]:
        """One type."""
        return iter([("Note", Note)])

    def all_contents(self) -> Iterator[Any]:
        """All notes."""
        return iter(self.notes)

    def element(self, identity: str) -> Any:
        """The note of a number."""
        return next((note for note in self.notes if str(note.number) == identity), None)

    def id_of(self, element: Any) -> str:
        """The note's number."""
        return str(element.number)

    def owns(self, element: object) -> bool:
        """Whether it is a note of this text."""
        return element in self.notes


class Unfinished(Model):
    """A driver without what a model must have."""

    def __init__(self, path: Path, name: str) -> None:
        super().__init__(name, path)


def read(path: Path, name: str) -> Model:
    """A driver that is a function."""
    return Notes(path, name)


def gives_nothing(path: Path, name: str) -> None:
    """A driver that forgets to return what it made."""


def takes_one(path: Path) -> None:
    """A driver that cannot be told the model's name."""


def raises(path: Path, name: str) -> Model:
    """A driver that does not understand the text."""
    raise ValueError("not a number")


def pages(g: Gen, notes: Any) -> None:
    """One file with all notes."""

    g.give(values={"all": notes.Note.all})

    @g.rule(template="all.txt", target="all.txt")
    def All() -> None: ...
