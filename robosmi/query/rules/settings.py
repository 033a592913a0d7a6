"""Objects whose public attributes are settings: a misspelt one is refused instead of being ignored."""

from __future__ import annotations

from inspect import getmembers_static
from typing import Any

from robosmi.errors import UsageError, did_you_mean


class Settings:
    """Base class of objects that refuse public attributes other than those set by the class or its `__init__`.

    A class calls `settle` as the last statement of its `__init__`. Its subclasses may have further attributes.
    """

    _settled: type | None = None

    def settle(self, cls: type) -> None:
        """Take no further public attribute, if this is an object of exactly that class."""
        self._settled = cls

    def __setattr__(self, name: str, value: Any) -> None:
        """Set an attribute.

        Raises:
            UsageError: there is no such setting.
        """
        if (
            self.__class__ is self._settled
            and name[:1] != "_"
            and name not in self.__dict__
            and not hasattr(self.__class__, name)
        ):
            known = sorted({n for n in (*self.__dict__, *_settable(self.__class__)) if n[:1] != "_"})
            raise UsageError(
                f"{type(self).__name__} has no setting '{name}'{did_you_mean(name, known)}", fix=f"use one of: {', '.join(known)}"
            )
        super().__setattr__(name, value)


def _settable(cls: type) -> list[str]:
    return [name for name, member in getmembers_static(cls) if isinstance(member, property) and member.fset]
