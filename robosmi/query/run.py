"""A run: the models that a query sees, the extended properties, and the results of cached operations.

`with Run(model):` opens one; all of its data is dropped with it, and none is written to a file. Outside of any run there is a
default one, whose data about a model's element is stored with the element.
"""

from __future__ import annotations

import weakref
from collections.abc import Hashable, Set
from contextvars import ContextVar, Token
from typing import TYPE_CHECKING, Any, TypeVar

from robosmi.model.elements.driver import Model, ModelElement
from robosmi.model.elements.ecore import EObject
from robosmi.query.values import key

if TYPE_CHECKING:
    from robosmi.base.functions import Function
    from robosmi.query.values import Answer

V = TypeVar("V")


class Run:
    """What one execution of queries shares.

    Args:
        models: handles of the models it may name types of (`ModelView`), in the order in which unqualified names are looked up.
        closed: built-in operations, named in Python's way, that the run may not use, however it comes to their names.
    """

    def __init__(self, *models: Model, closed: Set[str] = frozenset()) -> None:
        self.models = models
        self.closed = closed
        self._kept: dict[int, tuple[Function, dict[Hashable, Answer]]] = {}
        self._of_values: dict[Hashable, dict[Hashable, Answer]] = {}
        self._tokens: list[Token[Run]] = []

    def notes_of(self, target: V) -> dict[Hashable, Answer]:
        """The run's own dictionary about one object, empty at first; for values (numbers, texts) one per value."""
        if self is _DEFAULT and isinstance(target, (EObject, ModelElement)) and hasattr(target, "__dict__"):
            # notes may refer to the element: a table in the default run would keep both alive forever
            found: dict[Hashable, Answer] = target.__dict__.setdefault(_NOTES, {})
            return found
        try:
            place = id(target)
            entry = self._kept.get(place)
            if entry is None or entry[0]() is not target:
                cached = self._kept
                entry = cached[place] = (weakref.ref(target, lambda _, p=place: cached.pop(p, None)), {})  # type: ignore[misc]
        except TypeError:  # no weak reference to numbers and texts
            return self._of_values.setdefault(key(target), {})
        return entry[1]

    def __enter__(self) -> Run:
        self._tokens.append(_current.set(self))
        return self

    def __exit__(self, *_: object) -> None:
        _current.reset(self._tokens.pop())


_NOTES = "_~notes"
_DEFAULT = Run()
_current: ContextVar[Run] = ContextVar("robosmi_query_run", default=_DEFAULT)


def current_run() -> Run:
    """The innermost open run, or the default one."""
    return _current.get()


class Extended:
    """The extended properties of one object in the current run; made by `ext`."""

    __slots__ = ("_notes",)

    def __init__(self, target: V) -> None:
        object.__setattr__(self, "_notes", current_run().notes_of(target).setdefault("~", {}))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return self._notes.get(name)

    def __setattr__(self, name: str, value: Any) -> None:
        self._notes[name] = value


def noted(target: V, name: str) -> Any:
    """An extended property by its name, None until it is set."""
    notes: Any = current_run().notes_of(target).setdefault("~", {})
    return notes.get(name)


def ext(target: V) -> Extended:
    """Extended properties (EOL `x.~mark`): attributes of any object for this run only, None until set, never in the XMI.

    >>> class Node: pass
    >>> node = Node()
    >>> ext(node).mark is None
    True
    >>> ext(node).mark = 3
    >>> ext(node).mark
    3
    """
    return Extended(target)
