"""What a command declares its options to, for type checkers: `argparse` with the arguments that the commands give.

`argparse` takes anything for a default and a constant. Nothing here exists when a command runs.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Protocol, TypeAlias

Value: TypeAlias = str | int | float | bool | Path | Sequence[str] | Sequence[Path] | None
"""What an option may hold."""


class Options(Protocol):
    """A parser of `argparse`, or a group of one."""

    def add_argument(
        self,
        *names: str,
        action: str = ...,
        nargs: int | str | None = ...,
        const: Value = ...,
        default: Value = ...,
        type: Callable[[str], Value] = ...,
        choices: Iterable[Value] | None = ...,
        required: bool = ...,
        help: str | None = ...,
        metavar: str | tuple[str, ...] | None = ...,
        dest: str | None = ...,
    ) -> argparse.Action:
        """Declare an option, or an argument without a name."""


class ActionOptions(Options, Protocol):
    """A parser of `argparse` whose command has actions."""

    def add_subparsers(self, *, dest: str | None = ..., metavar: str | None = ..., required: bool = ...) -> Actions:
        """Declare that the next word names an action with options of its own."""


class Actions(Protocol):
    """The actions of a command."""

    def add_parser(
        self, name: str, *, help: str | None = ..., description: str | None = ..., epilog: str | None = ...
    ) -> Options:
        """Declare an action; the result takes its options."""
