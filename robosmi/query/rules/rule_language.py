"""What the rule languages share (Epsilon's ERL): the types that rules are about, pre and post blocks, rules that raise.

A type is given as a type of a model (`m.Book`), as a class, or by name ("Book", "M!Book"), and is bound to the models of a run.
Whatever a rule raises becomes a `RuleError` that names the rule, the element, the line and the cause. Not here: when which rule
runs, which is the business of `robosmi.validate`, `robosmi.transform` and `robosmi.generate`.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from types import CodeType
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

from robosmi.base import foreign_code
from robosmi.diagnostics import Location
from robosmi.errors import InternalError, RobosmiError, RuleError, UsageError
from robosmi.model.elements.driver import Model, TypeHandle, class_of, is_element, name_of, type_of
from robosmi.model.elements.feature_errors import is_another_load
from robosmi.plugins import is_own
from robosmi.query.models import ModelView
from robosmi.query.problems import UnknownTypeError, unknown_type
from robosmi.query.run import Run, current_run
from robosmi.query.types import resolve, type_named
from robosmi.query.values import EolType, as_string

if TYPE_CHECKING:
    from robosmi.base.functions import Function
    from robosmi.model.elements.driver import DynamicNode, Item, Kind, Node, Type
    from robosmi.model.elements.ecore import EObject


F = TypeVar("F", bound="Function")
Given: TypeAlias = "Model | EObject | Sequence[EObject]"
"""What a module runs over: a model, or root elements."""
RuleKind: TypeAlias = "Kind | EolType"
"""How the type that a rule is about may be given."""


def as_model(given: Given) -> Model:
    """A model: the one given, or one around root elements."""
    return given if isinstance(given, Model) else ModelView(given)


def run_over(models: Sequence[Model]) -> AbstractContextManager[Run | None]:
    """The query run of a module's run: the open one if it knows the models, else one of its own (types by name, `ext`)."""
    known = current_run().models
    return nullcontext() if models and all(m in known for m in models) else Run(*models)


def technology(model: Model) -> Model:
    """The model of a technology below the views of it."""
    while isinstance(model, ModelView):
        model = model.model
    return model


def owner_of(element: Item, models: Iterable[Model]) -> Model | None:
    """The model that holds the element, or None."""
    return next((m for m in models if m.owns(element)), None)


def place_in_model(element: Item, models: Iterable[Model]) -> str | None:
    """An element as reports name it, `M!Book //@items.0`; None for no element, the text of a value that is no element."""
    if element is None:
        return None
    if not is_element(element):
        return as_string(element)
    model = owner_of(element, models)
    if model is not None:
        return f"{model.name}!{name_of(model.type_of(element))} {model.id_of(element)}"
    return f"{name_of(type_of(element))} (not in a resource)"


class RuleType:
    """The type that a rule is about, bound to the models of a run.

    Args:
        given: a type of a model (`m.Book`), a class, an EClass, a name, or a primitive type (`str`, "String").
        models: the models of the run. A class is looked for in all of them, a name is that of the first model that has it.

    Raises:
        UnknownTypeError: no model has a type of that name.
        UsageError: it is no type.
    """

    def __init__(self, given: RuleKind, models: Sequence[Model]) -> None:
        self.name = type_name(given)
        self.primitive: EolType | None = None
        self.models: Sequence[Model] = models
        if isinstance(given, TypeHandle):
            self.kind, self.models = given.kind, [given.model]
        elif isinstance(given, str) and (found := _named(given, models)) is not None:
            self.kind, self.models = found
        else:
            try:
                resolved = resolve(given)
            except TypeError as error:
                raise UsageError(f"{given!r} is no type", fix="give a type of a model (m.Book), a class or a name") from error
            if isinstance(resolved, EolType):
                self.primitive = resolved
            else:
                self.kind = resolved
        if self.primitive is None:
            self.cls = class_of(self.kind)

    def instances(self, exact: bool) -> list[Node]:
        """All elements of the type and its subtypes, or of exactly the type; a primitive type has none to enumerate."""
        if self.primitive is not None:
            return []
        if len(self.models) == 1:
            model = self.models[0]
            return list(model.all_of_type(self.kind) if exact else model.all_of_kind(self.kind))
        return [x for m in self.models for x in (m.all_of_type(self.kind) if exact else m.all_of_kind(self.kind))]

    def has(self, value: Item, exact: bool = False) -> bool:
        """Whether the value is of the type or a subtype, or of exactly the type."""
        if self.primitive is not None:
            return bool(self.primitive.is_type(value) if exact else self.primitive.is_kind(value))
        return value.__class__ is self.cls if exact else isinstance(value, self.cls)

    def maker(self, default: Model | None) -> Callable[[], DynamicNode]:
        """A function that makes an element of the type, in its model if it was given as that model's, else in the default one."""
        model = self.models[0] if len(self.models) == 1 else default
        if model is None:
            from robosmi.model.emf import new

            return lambda: new(self.kind)
        kind = self.kind
        return lambda: model.create(kind)


def rule_type(given: RuleKind, models: Sequence[Model], what: str, function: Function | None) -> RuleType:
    """The type of a rule's elements; if there is none, the error names the rule and its place.

    Args:
        given: the type, as for `RuleType`.
        models: the models of the run.
        what: the rule, "the rule Book2Node".
        function: the function that is the rule, or one of those that belong to it; None if there is none.

    Raises:
        UnknownTypeError: no model has a type of that name.
        UsageError: it is no type.
    """
    try:
        return RuleType(given, models)
    except (UnknownTypeError, UsageError) as error:
        raise with_place(error, what, function) from None


def other_load(kind: RuleType, models: Iterable[Model]) -> Model | None:
    """The model whose metamodel has another load of a type, where no model has the type itself; else None."""
    if kind.primitive is not None:
        return None
    found = [(m, class_of(t)) for m in models if (t := m.find_type(name_of(kind.kind))) is not None]
    if any(cls is kind.cls for _, cls in found):
        return None
    requested = getattr(kind.cls, "eClass", None)
    return next((m for m, cls in found if is_another_load(requested, getattr(cls, "eClass", None))), None)


def with_place(error: RobosmiError, what: str, function: Function | None) -> RobosmiError:
    """An error that has no place, with that of the function that raised it and the name of what it belongs to.

    Args:
        error: the error; one that has a place already stays as it is.
        what: the rule or step, "the rule Book2Node".
        function: whose code raised it, or is about it; None if that is not known.
    """
    if error.location is None:
        error.message = f"{what}: {error.message}"
        error.location = _place(error, function) if function is not None else None
    return error


def _named(name: str, models: Sequence[Model]) -> tuple[Type, list[Model]] | None:
    requested, _, plain = name.rpartition("!")
    for model in models:
        if requested in ("", model.name) and (kind := model.find_type(plain)) is not None:
            return kind, [model]
    try:
        type_named(name)
    except RobosmiError:
        raise unknown_type(name, [n for m in models if requested in ("", m.name) for n in m.type_names()]) from None
    return None


def type_name(given: RuleKind) -> str:
    """A type as reports name it: a name as it was written, else its simple name."""
    if isinstance(given, str):
        return given
    try:
        return given.name if isinstance(given, (TypeHandle, EolType)) else name_of(given)
    except AttributeError:
        return repr(given)


class RuleBlocks(list[Callable[[], None]]):
    """The pre or post blocks of a module in order; also a decorator that adds one."""

    def __call__(self, block: F) -> F:
        """Add a block; the function stays what it is."""
        self.append(block)
        return block

    def run(self, what: str) -> None:
        """Run all blocks.

        Args:
            what: "pre" or "post", for messages.

        Raises:
            RuleError: one of them raises.
        """
        for block in self:
            try:
                block()
            except (Exception, SystemExit) as error:
                raise failed(error, f"the {what} block", block) from error


def failed(
    error: BaseException,
    what: str,
    function: Function,
    element: Item = None,
    models: Iterable[Model] = (),
    owner: Function | None = None,
) -> RobosmiError:
    """The error of a rule that raises: which one, for which element, at which line, why.

    Of a user's rule it is a `RuleError`; of a rule of this package, unless that raised an error of ours on purpose, an
    `InternalError`: no user can correct it. Where a user's rule called code of ours that raised what it never raises on purpose,
    the advice says that.

    Args:
        error: what it raised; a `RuleError` of a rule called inside is passed on unchanged.
        what: the rule, "the check of Known".
        function: the function that is the rule.
        element: the element it was run for, None for none.
        models: the models of the run.
        owner: whose fault it is, where that is another function than the rule.
    """
    if isinstance(error, (RuleError, InternalError)):
        return error
    about = "" if element is None else f" for {_shown(element, models)}"
    place = _place(error, function)
    if isinstance(error, RobosmiError):
        return RuleError(f"{what} fails{about}: {error.message}", location=place, fix=error.fix or _CORRECT)
    if isinstance(error, RecursionError) and (found := foreign_code.endless(error)) is not None:
        message = f"{what} fails{about}: the function '{found[0]}' calls itself without end"
        return RuleError(message, location=found[1], fix=foreign_code.END)
    message = f"{what} fails{about}: {type(error).__name__}: {error}"
    world = isinstance(error, (OSError, MemoryError, RecursionError))  # a full disk or a deep input is no bug of a rule
    if is_own(_module_of(owner or function)) and not world:
        return InternalError(message, location=place, fix="this is a bug of robosmi: please report it with this place")
    if (inside := _raised_inside(error)) is not None:
        fix = f"look at what this line gives to robosmi, where it was raised ({inside}); if that is right, it is a bug to report"
        return RuleError(message, location=place, fix=fix)
    return RuleError(message, location=place, fix=_CORRECT)


_CORRECT = "correct the function at this line, or guard it"


def _raised_inside(error: BaseException) -> str | None:
    """The place in this package that raised an exception, `robosmi.query.maps:31`; None if other code raised it."""
    step = error.__traceback__
    while step is not None and step.tb_next is not None:
        step = step.tb_next
    module = str(step.tb_frame.f_globals.get("__name__", "")) if step is not None else ""
    return f"{module}:{step.tb_lineno}" if step is not None and is_own(module) else None


def _shown(element: Item, models: Iterable[Model]) -> str:
    text = repr(element)
    try:
        model = owner_of(element, models)
        return f"{text} at {model.id_of(element)} of {model.name}" if model is not None and is_element(element) else text
    except Exception:  # a model that is half changed may not know the place
        return text


def code_of(function: Function) -> CodeType | None:
    """The code object of a function, below its decorators; None if it has no Python source."""
    code = getattr(inspect.unwrap(function), "__code__", None)
    return code if isinstance(code, CodeType) else None


def _module_of(function: Function) -> str:
    return inspect.unwrap(function).__module__ or ""


def called(function: Function | str) -> str:
    """The name of a rule, given by it or as its function."""
    return function if isinstance(function, str) else getattr(function, "__name__", None) or str(function)


def place_of(function: Function) -> Location | None:
    """The place of a function's definition; None if it has no Python source."""
    code = code_of(function)
    return Location(_relative(code.co_filename), code.co_firstlineno) if code is not None else None


def _place(error: BaseException, function: Function) -> Location | None:
    """The line of the function's file where the error left it."""
    code = code_of(function)
    found, step = place_of(function), error.__traceback__
    while step is not None:
        if code is not None and step.tb_frame.f_code.co_filename == code.co_filename:
            found = Location(_relative(code.co_filename), step.tb_lineno)
        step = step.tb_next
    return found


def _relative(path: str) -> str:
    try:
        return str(Path(path).relative_to(Path.cwd()))
    except ValueError:
        return path


def arity(function: Function) -> int:
    """The number of parameters without a default; 0 if it cannot be determined."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return 0
    positional = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    return sum(p.kind in positional and p.default is inspect.Parameter.empty for p in parameters)


def option_value(given: Any, element: Item) -> Any:
    """The value of an option for an element: the option itself, or its result if it is a function (of the element or nothing)."""
    if not callable(given):
        return given
    return given(element) if arity(given) else given()
