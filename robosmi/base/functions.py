"""The type of functions passed in by users: rules, guards, blocks, operations, with any parameters.

For type checkers only; import it under `TYPE_CHECKING`.
"""

from __future__ import annotations

from types import CellType, CodeType
from typing import Any, Protocol


class Function(Protocol):
    """A function of which only the module that wrote it knows the parameters and the result."""

    def __call__(self, *arguments: Any, **options: Any) -> Any:
        """Call it."""


class NamedFunction(Function, Protocol):
    """A function that is written with `def` or `lambda`: it has a name, code and a module."""

    __name__: str
    __qualname__: str
    __code__: CodeType

    @property
    def __globals__(self) -> dict[str, Any]:
        """The names of its module."""

    @property
    def __closure__(self) -> tuple[CellType, ...] | None:
        """The variables of enclosing functions that it uses."""
