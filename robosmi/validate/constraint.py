"""The declarations of EVL: contexts with their constraints and critiques, the result of a failed check, fixes.

A constraint is a function whose name is the constraint's. Declarations are independent of models; `evl` runs them on
some.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from inspect import CO_VARARGS
from typing import TYPE_CHECKING, Any, Generic, Protocol, TypeVar, overload

from msgspec import Struct

from robosmi.diagnostics import Location, Severity
from robosmi.errors import RuleError, UsageError
from robosmi.query.rules.options import check_options
from robosmi.query.rules.rule_language import code_of, place_of, type_name

if TYPE_CHECKING:
    from robosmi.base.functions import Function
    from robosmi.model.elements.driver import ItemOrItems, TypeHandle
    from robosmi.query.rules.decorating import Decorator
    from robosmi.query.rules.rule_language import RuleKind

R = TypeVar("R")
E = TypeVar("E")
_GIVEN = frozenset({"check", "context", "critique"})
"""What a declaration defines of a constraint itself, not by an option."""
GLOBAL = "<Global>"
"""The name, as in EVL, of the context of constraints that are declared without a context."""


class Fix(Struct, frozen=True):
    """A way to repair an unsatisfied constraint.

    Attributes:
        title: its description, a text or a function.
        do: performs it; a function of the element, or of nothing.
        guard: whether it is offered, a truth value or a function.
    """

    title: str | Callable[..., str]
    do: Function
    guard: bool | Function = True


_FIX = 'write Fail("message", Fix("what it does", function)), each fix after the message'


class Fail:
    """The result of a failed check: it is false, and has a message.

    Args:
        message: what is wrong; the constraint's own message if None.
        fixes: ways to repair it.
        extras: values for the finding.

    Raises:
        UsageError: an argument after the message is no fix, or a fix has a name, which would make it an extra value.

    >>> bool(Fail("too short"))
    False
    """

    __slots__ = ("extras", "fixes", "message")

    def __init__(self, message: str | None = None, /, *fixes: Fix, **extras: ItemOrItems) -> None:
        for fix in fixes:
            if not isinstance(fix, Fix):
                raise UsageError(f"a Fail needs a message and fixes, not a {type(fix).__name__}", fix=_FIX)
        for name, value in extras.items():
            if any(isinstance(x, Fix) for x in (value if isinstance(value, (list, tuple)) else [value])):
                raise UsageError(f"'{name}=' of a Fail is an extra value of the finding, and no fix", fix=_FIX)
        self.message = message
        self.fixes = fixes
        self.extras = extras

    def __bool__(self) -> bool:
        return False


class Constrained(Protocol):
    """The protocol of a context, independent of the class of its elements."""

    name: str
    constraints: list[Constraint]

    @property
    def kind(self) -> RuleKind | None:
        """The type of its elements; None if the constraints are about the models as a whole."""

    @property
    def guard(self) -> Function | None:
        """The predicate that selects the elements on which its constraints are evaluated; None for all elements."""

    @property
    def lazy(self) -> bool:
        """Whether its constraints are evaluated only where `satisfies` asks for them."""


class Constraint(Struct, frozen=True, eq=False):
    """A condition that must hold (a constraint), or should hold (a critique), for every element of a context.

    Attributes:
        name: its name, by which `satisfies` refers to it.
        check: returns a true value if an element satisfies it, else a false one, preferably a `Fail`.
        context: its context.
        critique: whether it is a critique.
        info: whether a violated critique is information only.
        guard: the predicate for the elements on which it is evaluated, or None for all.
        lazy: whether it is evaluated only if `satisfies` asks for it.
        message: the message about an element, a text or a function; used if `Fail` has none.
        fixes: ways to repair a violation.
        severity: the severity of a violation.
        id: stable id of the rule in findings; the name if None was given.
        advice: what to do, a text or a function; used if there is no fix.
        location: a function from an element to its location, or None.
        terminate: whether it is no longer evaluated once an element has violated it.
    """

    name: str
    check: Function
    context: Constrained
    critique: bool = False
    info: bool = False
    guard: Function | None = None
    lazy: bool = False
    message: str | Callable[..., str] | None = None
    fixes: Sequence[Fix] = ()
    severity: Severity = Severity.error
    id: str = ""
    advice: str | Callable[..., str] | None = None
    location: Callable[..., Location | None] | None = None
    terminate: bool = False

    @property
    def kind(self) -> str:
        """`error` for constraints, `critique` for critiques."""
        return "critique" if self.critique else "error"

    def __repr__(self) -> str:
        return f"<{'critique' if self.critique else 'constraint'} {self.name} of {self.context.name}>"


class Context(Generic[E]):
    """Constraints on the elements of a type and its subtypes, or (kind None) on the models as a whole.

    Args:
        kind: a type of a model (`m.Book`), a class, or a name.
        guard: for which elements its constraints are evaluated, or None for all.
        lazy: whether its constraints are evaluated only where `satisfies` asks.
        name: how reports name it; the type's name if None.
    """

    def __init__(
        self,
        kind: type[E] | str | TypeHandle | None,
        guard: Callable[[E], bool] | None = None,
        lazy: bool = False,
        name: str | None = None,
    ) -> None:
        self.kind = kind
        self.guard = guard
        self.name = name or (GLOBAL if kind is None else type_name(kind))
        self.constraints: list[Constraint] = []
        self._lazy = lazy
        self._beside: Sequence[Constrained] = ()

    def lies_among(self, contexts: Sequence[Constrained]) -> None:
        """Set the contexts of the module of this one, so that two constraints of one name on one type can be refused."""
        self._beside = contexts

    @property
    def lazy(self) -> bool:
        """Whether its constraints are evaluated only where `satisfies` asks for them."""
        return self._lazy or (bool(self.constraints) and all(c.lazy for c in self.constraints))

    def __repr__(self) -> str:
        return f"<context {self.name}: {', '.join(c.name for c in self.constraints)}>"

    @overload
    def constraint(self, check: Callable[[E], R], /) -> Callable[[E], R]: ...
    @overload
    def constraint(
        self,
        /,
        *,
        name: str | None = None,
        guard: Callable[[E], bool] | None = None,
        lazy: bool = False,
        message: str | Callable[[E], str] | Callable[[], str] | None = None,
        fixes: Sequence[Fix] = (),
        severity: Severity | None = None,
        id: str | None = None,
        advice: str | Callable[[E], str] | Callable[[], str] | None = None,
        location: Callable[[E], Location | None] | None = None,
        terminate: bool = False,
    ) -> Decorator: ...
    def constraint(self, check: Any = None, /, **options: Any) -> Any:
        """Add a constraint: `@context.constraint`, or `@context.constraint(guard=..., lazy=True)`.

        Args:
            check: the function; it is given the element (without a context nothing), and stays what it is.
            options: name, guard, lazy, message, fixes, severity, id, advice, location, terminate: see `Constraint`.
        """
        return self._add(check, options, critique=False)

    @overload
    def critique(self, check: Callable[[E], R], /) -> Callable[[E], R]: ...
    @overload
    def critique(
        self,
        /,
        *,
        name: str | None = None,
        guard: Callable[[E], bool] | None = None,
        lazy: bool = False,
        message: str | Callable[[E], str] | Callable[[], str] | None = None,
        fixes: Sequence[Fix] = (),
        severity: Severity | None = None,
        id: str | None = None,
        advice: str | Callable[[E], str] | Callable[[], str] | None = None,
        location: Callable[[E], Location | None] | None = None,
        terminate: bool = False,
        info: bool = False,
    ) -> Decorator: ...
    def critique(self, check: Any = None, /, **options: Any) -> Any:
        """Add a critique: as `constraint`, but a warning; with `info=True` only worth knowing."""
        return self._add(check, options, critique=True)

    def _add(self, check: Any, options: dict[str, Any], critique: bool) -> Any:
        known = [name for name in Constraint.__struct_fields__ if name not in _GIVEN]
        check_options(
            "a critique" if critique else "a constraint", options, known if critique else [n for n in known if n != "info"]
        )

        def add(function: Any) -> Any:
            given = dict(options)
            name = given.pop("name", None) or function.__name__
            mild = Severity.info if given.get("info") else Severity.warning
            given.setdefault("severity", mild if critique else Severity.error)
            given.setdefault("id", name)
            self._check_name(name, function)
            self._check_parameters(name, function)
            self.constraints.append(Constraint(name, function, self, critique, **given))
            return function

        return add if check is None else add(check)

    def _check_parameters(self, name: str, function: Function) -> None:
        """Reject a function of a context without a parameter for the element."""
        code = code_of(function)
        if self.kind is not None and code is not None and not code.co_argcount and not code.co_flags & CO_VARARGS:
            raise RuleError(
                f"the constraint {name} of {self.name} has no parameter",
                location=place_of(function), fix="give its function a parameter: it is called with the element",
            )  # fmt: skip

    def _check_name(self, name: str, function: Function) -> None:
        """Refuse a second constraint of the same name on the same type, since `satisfies` and reports could not tell them
        apart.

        Contexts with guards may each have one, since the guards can separate their elements.
        """
        unguarded = [c for c in self._beside if c.guard is None and self.guard is None and c.kind == self.kind]
        for context in (self, *(c for c in unguarded if c is not self)):
            earlier = next((c for c in context.constraints if c.name == name), None)
            if earlier is not None:
                there = place_of(earlier.check)
                raise RuleError(
                    f"there are two constraints '{name}' of {self.name}{f', the other one at {there}' if there else ''}",
                    location=place_of(function),
                    fix="rename one of them, or give it another name with name=",
                )
