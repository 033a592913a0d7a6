"""A plug-in for tests: what it offers in the place of other content is not called as ours is, or gives something else."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from robosmi.model.elements.driver import Model, Type
from robosmi.plugins import Registry

KIND, NAME, WRONG = os.environ["WRONG_PLUGIN"].split("=")
"""What is offered, under which name, and the name of what is offered here."""
text = "no function at all"


def register(registry: Registry) -> None:
    """The value of the entry point."""
    registry.add(KIND, NAME, f"wrong_plugin:{WRONG}")


def takes_one(first: object) -> None:
    """A function of one argument alone."""


def gives_nothing(*arguments: object, **options: object) -> None:
    """A function that forgets to return what it made."""


def gives_a_text(*arguments: object, **options: object) -> str:
    """A function that returns something else."""
    return text


def raises(*arguments: object, **options: object) -> int:
    """A function that takes what it is given, and calls another one wrongly."""
    return int.from_bytes()  # type: ignore[call-arg]


class HasNoTypes(Model):
    """A driver that leaves out what a model must have."""

    def __init__(self, path: Path, name: str | None = None) -> None:
        self.path = path


class TakesNoName(Model):
    """A driver that cannot be told what its model is called."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def types(self) -> Iterator[tuple[str, Type]]:
        """No types."""
        return iter(())
