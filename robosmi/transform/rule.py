"""Transformation rules as declared, and bound to the models of a run.

A rule is a function: its name is the rule's, its first parameter the source, the others the targets. Their types are given by
annotations or in the decorator. `etl` decides when rules run.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from functools import cache
from types import CodeType, FunctionType
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from robosmi.base.quantities import quantity
from robosmi.errors import InternalError, RuleError, did_you_mean
from robosmi.model.elements.driver import Model, TypeHandle, class_of
from robosmi.model.elements.feature_errors import ONE_LOAD
from robosmi.model.elements.ordering import post_order
from robosmi.query.rules.options import check_options
from robosmi.query.rules.rule_language import RuleType, arity, called, failed, other_load, place_of, rule_type, type_name
from robosmi.query.rules.verdicts import guarded

if TYPE_CHECKING:
    from robosmi.base.functions import Function, NamedFunction
    from robosmi.model.elements.driver import DynamicNode, Item, Node
    from robosmi.query.rules.rule_language import RuleKind


class Rule(Struct, frozen=True, eq=False):
    """A rule.

    Attributes:
        name: its name.
        body: its function, of the source and the targets.
        source: type of the source, in any of the forms of `RuleType`.
        targets: types of the targets.
        names: names of the targets, its parameters.
        guard: for which sources it applies, or None for all.
        extends: the rules it extends, names or functions.
        lazy: whether it runs only on demand.
        greedy: whether it applies to subtypes of its source type.
        abstract: whether it only serves others.
        primary: whether its targets come first among the equivalents.
        init: target name -> function of the source that gives the object to use as target.
    """

    name: str
    body: NamedFunction
    source: RuleKind
    targets: Sequence[RuleKind]
    names: Sequence[str]
    guard: Function | None = None
    extends: Sequence[Function | str] = ()
    lazy: bool = False
    greedy: bool = False
    abstract: bool = False
    primary: bool = False
    init: Mapping[str, Function] | None = None

    def wrong(self, message: str, fix: str) -> RuleError:
        """An error about the rule itself."""
        return RuleError(f"the rule {self.name} {message}", location=place_of(self.body), fix=fix)


def declare(body: NamedFunction, transform: Any, to: Any, name: str | None, **options: Any) -> Rule:
    """A rule from its function and the options of its decorator.

    Raises:
        RuleError: its types are not given, do not fit its parameters, or an initial value is for no target.
        UsageError: there is no such option.
    """
    parameters = _parameters(body)
    names = parameters[1:]
    check_options("a rule", options, ("to", "name", *_OPTIONS), place_of(body))
    extends = options.pop("extends", ())
    extends = [extends] if isinstance(extends, str) or callable(extends) else list(extends)
    targets: list[Any] | None = None
    if to is not None:
        targets = list(to) if isinstance(to, (list, tuple)) else [to]
    title = name or body.__name__

    def wrong(message: str, fix: str) -> RuleError:
        return Rule(title, body, "", [], names).wrong(message, fix)

    if not parameters:
        raise wrong("has no source", "give its function a parameter for the source and one for each target")
    source = transform if transform is not None else _annotation(body, parameters[0])
    if targets is None:
        targets = [_annotation(body, name) for name in names]
    if len(targets) != len(names):
        raise wrong(
            f"has {quantity(len(targets), 'target type')} and {quantity(len(names), 'parameter')} for targets",
            "give each target a parameter and a type",
        )
    for parameter, kind in zip(parameters, [source, *targets], strict=True):
        if kind is None:
            raise wrong(
                f"does not say of which type '{parameter}' is",
                f"write {parameter}: M.Type, or the types in the decorator: rule(L.Book, to=[G.Node])",
            )
    for target in options.get("init") or {}:
        if target not in names:
            raise wrong(f"has an initial value for '{target}', which is no target{did_you_mean(target, names)}", "name a target")
    return Rule(title, body, source, targets, names, extends=extends, **options)


def _parameters(body: NamedFunction) -> list[str]:
    """The names of the parameters that have no default; of a plain function without `inspect`, which is slow."""
    if isinstance(body, FunctionType) and not hasattr(body, "__wrapped__") and not body.__code__.co_flags & _MORE:
        code = body.__code__
        return list(code.co_varnames[: code.co_argcount - len(body.__defaults__ or ())])
    return [p.name for p in inspect.signature(body).parameters.values() if p.default is inspect.Parameter.empty]


_OPTIONS = ("guard", "extends", "lazy", "greedy", "abstract", "primary", "init")
_MORE = inspect.CO_VARARGS | inspect.CO_VARKEYWORDS


@cache
def _compiled(annotation: str) -> CodeType:
    code: CodeType = compile(annotation, "<annotation>", "eval")
    return code


def _annotation(body: NamedFunction, parameter: str) -> Any:
    function = inspect.unwrap(body) if hasattr(body, "__wrapped__") else body
    kind = getattr(function, "__annotations__", {}).get(parameter)
    if kind is None or kind is Any or kind == "Any":
        return None
    if not isinstance(kind, str):
        return kind
    try:  # what `from __future__ import annotations` left as text
        return eval(_compiled(kind), body.__globals__, _nonlocals(body))
    except (NameError, AttributeError, SyntaxError):
        return _AsWritten(kind)


def _nonlocals(body: NamedFunction) -> dict[str, Any]:
    """The variables of enclosing functions that a function uses (`inspect.getclosurevars` looks at more, and is slow)."""
    found = {}
    for name, cell in zip(body.__code__.co_freevars, body.__closure__ or (), strict=True):
        with suppress(ValueError):  # not set yet
            found[name] = cell.cell_contents
    return found


class _AsWritten(str):
    """The text of an annotation with names that are undefined in its module; models of the run may define them (`L.Book`)."""

    __slots__ = ()


class BoundRule:
    """A rule in one run: its types in the models, and its state."""

    __slots__ = (
        "body", "chain", "done", "guard", "init", "kind", "lazy", "makers", "models", "name", "own_bases", "rejected", "rule",
        "width",
    )  # fmt: skip

    def __init__(self, rule: Rule, models: list[Model], makers: dict[RuleKind, Callable[[], DynamicNode]]) -> None:
        self.rule = rule
        self.models = models
        self.name = rule.name
        self.body = rule.body
        self.guard = rule.guard
        self.kind = rule_type(self._resolved(rule.source), models, f"the rule {rule.name}", rule.body)
        if self.kind.primitive is None and len(self.kind.models) > 1:
            self.kind.models = self._having(models)[:1]
        self._refuse_another_load(self.kind, models)
        self.lazy = rule.lazy or (self.kind.primitive is not None and not rule.abstract)
        self.width = len(rule.targets)
        for name, given in zip(rule.names, rule.targets, strict=True):
            if given not in makers:
                makers[given] = self._maker(name, given)
        self.makers = [makers[given] for given in rule.targets]
        self.init = [(rule.init or {}).get(n) for n in rule.names]
        self.own_bases: list[BoundRule] = []
        self.chain: list[BoundRule] = [self]
        self.done: set[Item] = set()
        self.rejected: set[Item] = set()

    def _resolved(self, given: RuleKind) -> RuleKind:
        if not isinstance(given, _AsWritten):
            return given
        if found := re.fullmatch(r"(\w+)[.!](\w+)", given):
            return f"{found[1]}!{found[2]}"
        return str(given)

    def _having(self, models: Iterable[Model]) -> list[Model]:
        name, cls = type_name(self.kind.kind), self.kind.cls
        return [m for m in models if (found := m.find_type(name)) is not None and class_of(found) is cls]

    def _maker(self, name: str, given: RuleKind) -> Callable[[], DynamicNode]:
        kind = rule_type(
            self._resolved(given), list(reversed(self.models)), f"the target '{name}' of the rule {self.name}", self.body
        )
        if kind.primitive is not None:
            raise self.rule.wrong(f"cannot make '{name}': {kind.name} is no type of a model", "give a type of a model")
        if isinstance(given, (TypeHandle, str)):
            return kind.maker(None)
        kind.models = [m for m in kind.models if (t := m.find_type(kind.name)) is not None and class_of(t) is kind.cls][:1]
        self._refuse_another_load(kind, self.models)
        return kind.maker(None)

    def _refuse_another_load(self, kind: RuleType, models: Iterable[Model]) -> None:
        """Refuse a class that no model has, where one has a class of the same name and namespace: no element would ever be met.

        Raises:
            RuleError: it is a class of another load of a model's metamodel.
        """
        if (model := other_load(kind, models)) is not None:
            raise self.rule.wrong(
                f"is about {kind.name} of another load of the metamodel that the model {model.name} has", ONE_LOAD
            )

    def applies(self, source: Item, exact: bool, check_type: bool = True) -> bool:
        """Whether the rule is for a source: its type, its guard and those of the rules it extends; a refusal is remembered.

        Raises:
            RuleError: a guard raises.
        """
        if source in self.done:
            return True
        if source in self.rejected or (check_type and not self.kind.has(source, exact)):
            return False
        if self.guard is None and not self.own_bases:
            return True
        try:
            satisfied = self.guard is None or guarded(self.guard(source))
        except (RuleError, InternalError):
            raise
        except (Exception, SystemExit) as error:
            assert self.guard is not None
            raise failed(error, f"the guard of the rule {self.name}", self.guard, source, self.models) from error
        for base in self.own_bases:
            if not base.applies(source, exact=False):
                satisfied = False
                break
        if not satisfied:
            self.rejected.add(source)
        return satisfied

    def targets_for(self, source: Item) -> list[Node]:
        """New targets for a source, or the objects that initial values give.

        Raises:
            RuleError: they cannot be made.
        """
        if self.rule.init is None:
            try:
                return [make() for make in self.makers]
            except (Exception, SystemExit) as error:
                raise failed(error, f"making the targets of the rule {self.name}", self.body, source, self.models) from error
        made = []
        for make, init in zip(self.makers, self.init, strict=True):
            try:
                made.append(make() if init is None else init(source) if arity(init) else init())
            except (Exception, SystemExit) as error:
                raise failed(error, f"a target of the rule {self.name}", init or self.body, source, self.models) from error
        return made

    def run(self, source: Item, targets: Sequence[Node]) -> None:
        """The bodies of the rules it extends, then its own.

        Raises:
            RuleError: one of them raises.
        """
        rule = self
        try:
            for rule in self.chain:
                rule.done.add(source)
                rule.body(source, *(targets if rule.width == len(targets) else targets[: rule.width]))
        except (RuleError, InternalError):
            raise  # of a rule that ran inside this one
        except (Exception, SystemExit) as error:
            raise failed(error, f"the rule {rule.name}", rule.body, source, self.models) from error


def bind(rules: Sequence[Rule], models: list[Model]) -> list[BoundRule]:
    """Rules with their types in the models and the rules they extend.

    Raises:
        RuleError: two have one name, one extends itself or a rule that there is not, or one that has more targets.
        UnknownTypeError: a type is in none of the models.
    """
    bound: dict[str, BoundRule] = {}
    makers: dict[RuleKind, Callable[[], DynamicNode]] = {}  # most rules of a module make the same
    for rule in rules:
        if rule.name in bound:
            raise rule.wrong("is there twice", "give one of them another name: rule(name=...)")
        bound[rule.name] = BoundRule(rule, models, makers)
    names = {id(rule.body): rule.name for rule in rules}
    for one in bound.values():
        for given in one.rule.extends:
            name = names.get(id(given), called(given))
            if name not in bound:
                raise one.rule.wrong(
                    f"extends '{name}', which is no rule{did_you_mean(name, bound)}", f"use one of: {', '.join(bound)}"
                )
            one.own_bases.append(bound[name])
    for one in bound.values():
        one.chain = _chain(one)
        for base in one.chain:
            if base.width > one.width:
                raise one.rule.wrong(
                    f"extends {base.name}, which has {base.width} targets, but has {one.width} itself",
                    "give it the same targets first",
                )
    return list(bound.values())


def _chain(rule: BoundRule) -> list[BoundRule]:
    """All rules that a rule extends, directly or not, each once before those that extend it, and the rule itself."""

    def refuse(circle: list[BoundRule]) -> None:
        raise circle[-1].rule.wrong(f"extends itself: {' extends '.join(r.name for r in circle)}", "remove one of these")

    return list(post_order([rule], lambda one: one.own_bases, refuse))
