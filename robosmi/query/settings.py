"""Objects whose public attributes are settings: a misspelt one is refused, as nobody would read it."""

from __future__ import annotations

from inspect import getmembers_static
from typing import Any

from robosmi.errors import UsageError, did_you_mean
from robosmi.typed import class_name


class Settings:
    """Takes no public attribute beyond those that its class has or `__init__` has made.

    A class calls `settle` as the last thing in its `__init__`. Its subclasses may have attributes of their own.
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
                f"{class_name(self)} has no setting '{name}'{did_you_mean(name, known)}", fix=f"use one of: {', '.join(known)}"
            )
        super().__setattr__(name, value)


def _settable(cls: type) -> list[str]:
    return [name for name, member in getmembers_static(cls) if isinstance(member, property) and member.fset]
