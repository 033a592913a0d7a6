"""`ETL`: a module of transformation rules, corresponding to an ETL file.

It contains rules, pre and post blocks and included modules, runs them on models, and looks up the equivalents of elements.
Targets are made in the target models; nothing is written to a file here.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, TypeGuard, TypeVar, cast, overload

from robosmi.errors import UsageError, did_you_mean
from robosmi.model.driver import Model, TypeHandle
from robosmi.model.ordering import post_order
from robosmi.query.collections import Q
from robosmi.query.erl import Given, RuleBlocks, as_model, called, run_over
from robosmi.query.settings import Settings
from robosmi.query.values import collection_kind
from robosmi.transform.assignment import assign
from robosmi.transform.rule import Rule, bind, declare
from robosmi.transform.schedule import Demand, Match, Schedule
from robosmi.transform.trace import Trace

if TYPE_CHECKING:
    from robosmi.functions import Function, NamedFunction
    from robosmi.model.driver import Item, Node
    from robosmi.model.dynamic import Dynamic
    from robosmi.query.decorating import Decorator
    from robosmi.query.erl import RuleKind

F = TypeVar("F", bound="NamedFunction")
T = TypeVar("T")
Sources: TypeAlias = "Item | Iterable[Item]"
"""What something may be made from: an element or value, or several."""
SCHEDULES = ("auto", "match", "demand")


class ETL(Settings):
    """A transformation.

    Args:
        models: handles or root elements, sources and targets; a type that is given as a class or a name is as a source that of
            the first model that has it, as a target that of the last; a target of a class that none has is made in no model.
        schedule: `match`, `demand`, or `auto`: demand if a rule is lazy or over a primitive type, else match, as the engine.
        step: step of a method that its rules belong to, for the trace.

    Attributes:
        pre: blocks that run before all rules; `@t.pre` adds one.
        post: blocks that run after all rules.
        rules: the rules declared here, in order.
        trace: what was made from what, of the last run.
        warnings: what is odd though no error, of the last run.

    Raises:
        UsageError: there is no such schedule.
    """

    def __init__(self, *models: Given, schedule: str = "auto", step: str = "") -> None:
        self.step = step
        self.models: list[Model] = [as_model(m) for m in models]
        self.schedule = schedule
        self.pre = RuleBlocks()
        self.post = RuleBlocks()
        self.rules: list[Rule] = []
        self.trace = Trace()
        self.warnings: list[str] = []
        self._included: list[ETL] = []
        self._running: Schedule | None = None
        self.settle(ETL)

    @property
    def schedule(self) -> str:
        """`match`, `demand` or `auto`; may be set until the run.

        Raises:
            UsageError: there is no such schedule.
        """
        return self._chosen

    @schedule.setter
    def schedule(self, chosen: str) -> None:
        """Choose it."""
        if chosen not in SCHEDULES:
            raise UsageError(
                f"there is no schedule '{chosen}'{did_you_mean(chosen, SCHEDULES)}", fix=f"use one of: {', '.join(SCHEDULES)}"
            )
        self._chosen = chosen

    @overload
    def rule(self, body: F, /) -> F: ...
    @overload
    def rule(
        self,
        transform: RuleKind | None = None,
        /,
        to: type | str | TypeHandle | Sequence[type | str | TypeHandle] | None = None,
        *,
        name: str | None = None,
        guard: Function | None = None,
        extends: Function | str | Sequence[Function | str] = (),
        lazy: bool = False,
        greedy: bool = False,
        abstract: bool = False,
        primary: bool = False,
        init: Mapping[str, Function] | None = None,
    ) -> Decorator: ...
    def rule(self, transform: Any = None, /, to: Any = None, *, name: str | None = None, **options: Any) -> Any:
        """Add a rule: `@t.rule` with the types as annotations, or `@t.rule(L.Book, to=[G.Node], lazy=True)`.

        Args:
            transform: type of the source; the annotation of the first parameter if None.
            to: types of the targets, one or a list; the annotations of the other parameters if None.
            name: its name; the function's if None.
            options: guard, extends, lazy, greedy, abstract, primary, init: see `Rule`.

        Raises:
            RuleError: its types are not given or do not fit its parameters.
        """

        def add(body: Any, kind: Any) -> Any:
            self.rules.append(declare(body, kind, to, name, **options))
            return body

        if callable(transform) and not isinstance(transform, type) and hasattr(transform, "__code__"):
            return add(transform, None)
        return lambda body: add(body, transform)

    def include(self, other: ETL) -> None:
        """Import another module: its pre blocks, rules and post blocks come before those of this one."""
        self._included.append(other)

    def modules(self) -> list[ETL]:
        """The included modules, those that they include before them, and this one last; each once."""
        return list(post_order([self], lambda module: module._included))

    def run(self, *models: Given) -> Trace:
        """Transform: pre blocks, rules, post blocks.

        Args:
            models: handles or root elements; those of the constructor if none.

        Raises:
            RuleError: a block or a rule raises, or rules do not fit together; the target models may hold a part.
            UnknownTypeError: a type is in none of the models.
        """
        modules = self.modules()
        used = [as_model(m) for m in models] or list(dict.fromkeys(m for module in reversed(modules) for m in module.models))
        trace, warnings = Trace(self.step), list[str]()
        bound = bind([rule for module in modules for rule in module.rules], used)
        lazy = next((rule for rule in bound if rule.lazy), None)
        if self.schedule == "match" and lazy is not None:
            raise lazy.rule.wrong("is lazy, and the schedule 'match' runs no lazy rule", "use the schedule 'auto' or 'demand'")
        demand = self.schedule == "demand" or (self.schedule == "auto" and lazy is not None)
        running = Demand(bound, trace) if demand else Match(bound, trace)
        for module in modules:
            module.trace, module.warnings, module._running = trace, warnings, running
        with run_over(used):
            for module in modules:
                module.pre.run("pre")
            running.run()
            for module in modules:
                module.post.run("post")
        return trace

    def _schedule(self) -> Schedule:
        if self._running is None:
            raise UsageError(
                "nothing is equivalent before the transformation runs", fix="ask in a rule, a post block or after run()"
            )
        return self._running

    def _names(self, rules: Sequence[Function | str]) -> list[str]:
        running = self._schedule()
        given = [called(rule) for rule in rules]
        for name in given:
            said = f"equivalents of the rule '{name}' were asked for, which is no rule{did_you_mean(name, running.by_name)}"
            if name not in running.by_name and said not in self.warnings:
                self.warnings.append(said)
        return given

    @overload
    def equivalent(self, source: Sources, *rules: Function | str) -> Dynamic: ...
    @overload
    def equivalent(self, source: Item, *rules: Function | str, kind: type[T]) -> T | None: ...
    def equivalent(self, source: Sources, *rules: Function | str, kind: type[T] | None = None) -> Dynamic | T | None:
        """What was made from a source (ETL `s.equivalent()`, `s.equivalent("R")`).

        Args:
            source: an element, a value, or a collection of them.
            rules: names of rules, or their functions; all if none. A name that is no rule gives nothing, and a warning.
            kind: the class of what is wanted; all classes if None. Of one source, no collection.

        Returns:
            The first target, or None; of a collection all targets of all members, in a flat list.

        Raises:
            RuleError: a rule that runs for it raises.
        """
        if source is None:
            return None
        running, names = self._schedule(), self._names(rules) if rules else ()
        if _is_collection(source):
            return cast("Dynamic", Q([t for targets in self._of_all(source, running, names) for t in targets]))
        found = running.equivalents(cast("Item", source), names)
        if kind is not None:
            return next((target for target in found or () if isinstance(target, kind)), None)
        return cast("Dynamic", found[0]) if found else None

    def equivalents(self, source: Sources, *rules: Function | str) -> Dynamic:
        """All that was made from a source (ETL `s.equivalents()`), in the order of the rules, primary ones first.

        Returns:
            A list; of a collection a list of lists, equal ones once. In the schedule `match` None for a source without rule.

        Raises:
            RuleError: a rule that runs for it raises.
        """
        made: Q[Node] | Q[Q[Node]] | None = None
        if source is not None:
            running, names = self._schedule(), self._names(rules) if rules else ()
            if _is_collection(source):
                made = self._of_all(source, running, names)
            elif (found := running.equivalents(cast("Item", source), names)) is not None:
                made = Q(found)
        return cast("Dynamic", made)

    def _of_all(self, sources: Iterable[Item], running: Schedule, names: Sequence[str]) -> Q[Q[Node]]:
        """The targets of each of several sources, without duplicate lists."""
        distinct: dict[tuple[int, ...], Q[Node]] = {}
        for member in sources:
            found = running.equivalents(member, names) if member is not None else None
            if found is not None:
                distinct.setdefault(tuple(id(x) for x in found), Q(found))
        return Q(distinct.values())

    def set(self, target: Node, /, **features: Sources) -> None:
        """Set features to the equivalents of values (ETL `target.feature ::= value`).

        Args:
            target: an element.
            features: feature name -> a source, or a collection of sources for a many-valued feature; what has no equivalent gives
                None, in a collection nothing.

        Raises:
            ModelError: there is no such feature, or one value is given for many, or a collection for one.
        """
        for name, value in features.items():
            assign(target, name, self.equivalent(value), value)


_COLLECTIONS: dict[type, bool] = {}


def _is_collection(value: Sources) -> TypeGuard[Iterable[Item]]:
    """Whether the value is a collection; that is asked at every equivalent, and its class decides."""
    cls = value.__class__
    known = _COLLECTIONS.get(cls)
    if known is None:
        known = _COLLECTIONS[cls] = collection_kind(value) is not None
    return known
