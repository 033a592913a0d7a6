"""Operations of one's own: `@operation(Book)` above a function, and which of them a call finds.

As in EOL they belong to the module that declares them: a call sees those of its own Python module, in the order of their
declaration, then those that this module imports (`import helpers` all of them and those of its imports, `from helpers import f`
that one). Of these the first whose context is exactly the type of the target counts, else the first that the target is a kind of.
They lie in the module that declares them and go with it. How a name finds a built-in operation is `operations`' business.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable
from functools import wraps
from types import FrameType, ModuleType
from typing import TYPE_CHECKING, Any, TypeVar

from robosmi.query import types
from robosmi.query.naming import snake
from robosmi.query.problems import describe, unknown_operation
from robosmi.query.run import current_run
from robosmi.query.values import key

if TYPE_CHECKING:
    from robosmi.base.functions import Function, NamedFunction
    from robosmi.query.values import Answer


F = TypeVar("F", bound="NamedFunction")
R = TypeVar("R")
Scope = dict[str, Any]
"""The global names of a Python module."""

DECLARED = "__eol_operations__"
"""The global name under which a module has its operations, by name."""
_CONTENT = "robosmi.transformations"
_known: set[str] = set()
"""All names that were ever declared, so that a call of any other name looks no further."""


class OwnOperation:
    """A user-defined operation: its context type, its function, whether it is cached."""

    def __init__(self, context: types.AnyKind, function: Function, cached: bool) -> None:
        self.context = context
        self.function = function
        self.cached = cached
        parameters = inspect.signature(function).parameters.values()
        self.most = len(parameters) - 1
        self.least = sum(1 for p in parameters if p.default is p.empty) - 1

    def run(self, target: Any, *arguments: Any) -> Any:
        """The result of the function, or its cached result of this run."""
        if not self.cached:
            return self.function(target, *arguments)
        notes = current_run().notes_of(target)
        place = (self, tuple(key(x) for x in arguments))
        if place not in notes:
            notes[place] = self.function(target, *arguments)
        return notes[place]


def operation(context: types.AnyKind, *, name: str | None = None) -> Callable[[F], F]:
    """Declare a function as an operation of all objects of a type (EOL `operation Book isOld() : Boolean`), for its module.

    Args:
        context: the type: a class, an EClass, an EOL type or its name.
        name: the operation's name; the function's if None.

    The decorated function, called itself, is dispatched too, among the operations of its name that its module sees.
    A second declaration for the same type in the same module replaces the first, so that notebooks may repeat it.

    >>> from robosmi.query import call
    >>> @operation(int)
    ... def doubled(self): return 2 * self
    >>> call(21, "doubled"), doubled(4)
    (42, 8)
    """

    def declare(function: F) -> F:
        plain = snake(name or function.__name__)
        scope = function.__globals__
        made = OwnOperation(context, function, getattr(function, "_eol_cached", False))
        listed: list[OwnOperation] = scope.setdefault(DECLARED, {}).setdefault(plain, [])
        same = [n for n, other in enumerate(listed) if other.context is context or other.context == context]
        if same:
            listed[same[0]] = made
        else:
            listed.append(made)
        _known.add(plain)

        @wraps(function)
        def dispatched(target: Any, *arguments: Any) -> Any:
            own = _chosen(_visible(scope, plain), target, len(arguments))
            if own is None:
                raise unknown_operation("nothing" if target is None else describe(target), plain, _names(scope))
            return own.run(target, *arguments)

        dispatched._eol_declared = (scope, plain)  # type: ignore[attr-defined]
        return dispatched  # type: ignore[return-value]

    return declare


def cached(function: F) -> F:
    """Keep an operation's result per object and arguments for the run (EOL `@cached`); written under `@operation`."""
    function._eol_cached = True  # type: ignore[attr-defined]
    return function


def called_for(function: Function, body: Callable[..., R], *arguments: Any) -> R:
    """Call code that is in no Python module (a template), so that it sees what the module of a function sees.

    Args:
        function: the rule that it belongs to.
        body: what is called.
        arguments: its arguments.
    """
    scope = globals_of(function)  # noqa: F841, which `_calling` reads off this frame
    return body(*arguments)


def globals_of(function: Function) -> Scope | None:
    """The global names of the module of a function, below its decorators; None if it has no Python source."""
    return getattr(inspect.unwrap(function), "__globals__", None)


def own_operation(target: Any, name: str, arguments: int) -> Function | None:
    """The operation that the calling module sees for a target, or None.

    Args:
        target: anything.
        name: in Python's way.
        arguments: how many there are besides the target.
    """
    if name not in _known:
        return None
    found = _chosen(_visible(_calling(), name), target, arguments)
    return found.run if found is not None else None


def own_names(target: Any) -> list[str]:
    """The names of the operations that the calling module sees for a target."""
    scope = _calling()
    return [n for n in _names(scope) if any(types.is_kind_of(target, o.context) for o in _visible(scope, n))]


def _chosen(candidates: list[OwnOperation], target: Answer, arguments: int) -> OwnOperation | None:
    fitting = [c for c in candidates if c.least <= arguments <= c.most]
    exact = (c for c in fitting if types.is_type_of(target, c.context))
    return next(exact, None) or next((c for c in fitting if types.is_kind_of(target, c.context)), None)


def _visible(scope: Scope | None, name: str) -> list[OwnOperation]:
    """The operations of a name that a module sees: its own, then those of the modules that it imports, and so on."""
    found: list[OwnOperation] = []
    pending, seen = [scope] if scope is not None else [], set()
    while pending:
        one = pending.pop(0)
        if id(one) in seen:
            continue
        seen.add(id(one))
        found += [o for o in one.get(DECLARED, {}).get(name, ()) if o not in found]
        for value in list(one.values()):
            if isinstance(value, ModuleType):
                if DECLARED in value.__dict__:
                    pending.append(value.__dict__)
            elif (declared := getattr(value, "_eol_declared", None)) is not None and declared[1] == name:
                pending.append(declared[0])
    return found


def _names(scope: Scope | None) -> list[str]:
    return sorted(name for name in _known if _visible(scope, name))


def _calling() -> Scope | None:
    """The global names of the calling module: the nearest one on the stack that is not part of this framework."""
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        if frame.f_code is called_for.__code__:
            return frame.f_locals["scope"]  # type: ignore[no-any-return]
        name = frame.f_globals.get("__name__")
        if isinstance(name, str) and not _is_framework(name, frame.f_globals):
            return frame.f_globals
        frame = frame.f_back
    return None


def _is_framework(name: str, scope: Scope) -> bool:
    root = name.partition(".")[0]
    if root not in ("robosmi", "jinja2", "pyecore", "functools", "contextlib", "threading", "inspect"):
        return False
    content = name == _CONTENT or name.startswith(f"{_CONTENT}.")
    module = sys.modules.get(name)
    return not content and module is not None and module.__dict__ is scope
