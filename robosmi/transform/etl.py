"""`ETL`: a module of transformation rules, corresponding to an ETL file.

It contains rules, pre and post blocks and included modules, runs them on models, and looks up the equivalents of elements.
Targets are made in the target models; nothing is written to a file here.

ETL has two schedules: `Match` makes all targets first, then runs the bodies; `Demand` makes each target with its body. Both
follow Epsilon's engine as measured; docs/reference/etl.md lists the differences.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias, TypeGuard, TypeVar, cast, overload

from robosmi.errors import UsageError, did_you_mean
from robosmi.model.elements.compact_slots import collector_at_rest
from robosmi.model.elements.driver import Model, TypeHandle
from robosmi.model.elements.ordering import post_order
from robosmi.query.collections import Q
from robosmi.query.rules.deep_recursion import LEVELS, in_thread
from robosmi.query.rules.rule_language import Given, RuleBlocks, as_model, called, run_over
from robosmi.query.rules.settings import Settings
from robosmi.query.values import collection_kind
from robosmi.transform.assignment import assign
from robosmi.transform.rule import BoundRule, Rule, bind, declare
from robosmi.transform.trace import Link, Trace

if TYPE_CHECKING:
    from robosmi.base.functions import Function, NamedFunction
    from robosmi.model.elements.driver import Item, Node
    from robosmi.model.elements.dynamic import Dynamic
    from robosmi.query.rules.decorating import Decorator
    from robosmi.query.rules.rule_language import RuleKind


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
        with run_over(used), collector_at_rest(makes_models=True):
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
            message = f"equivalents are requested of '{name}', which is no rule{did_you_mean(name, running.by_name)}"
            if name not in running.by_name and message not in self.warnings:
                self.warnings.append(message)
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
            kind: the class of the equivalents; all classes if None. Of one source, no collection.

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
    """Whether the value is a collection, by its class alone, since every equivalent needs this."""
    cls = value.__class__
    known = _COLLECTIONS.get(cls)
    if known is None:
        known = _COLLECTIONS[cls] = collection_kind(value) is not None
    return known


# ---- schedules


class Schedule(ABC):
    """The order in which rules run, and the equivalents of a source at a given time.

    Args:
        rules: bound rules in order.
        trace: where what is made is recorded.
    """

    def __init__(self, rules: Sequence[BoundRule], trace: Trace) -> None:
        self.rules = rules
        self.by_name = {rule.name: rule for rule in rules}
        self.trace = trace
        self._nested = 0

    @abstractmethod
    def run(self) -> None:
        """Transform the models.

        Raises:
            RuleError: a rule raises.
        """

    @abstractmethod
    def equivalents(self, source: Item, names: Sequence[str]) -> list[Node] | None:
        """The targets of a source, of the named rules or of all.

        Raises:
            RuleError: a rule that runs for it raises.
        """

    def _run_nested(self, rule: BoundRule, source: Item, targets: Sequence[Node]) -> None:
        """Run a rule inside another; chains of them may be as long as the model."""
        self._nested += 1
        try:
            if self._nested % LEVELS:
                rule.run(source, targets)
            else:
                in_thread(rule.run, source, targets)
        finally:
            self._nested -= 1

    def _to_run(self) -> list[BoundRule]:
        return [rule for rule in self.rules if not rule.lazy and not rule.rule.abstract]


class Match(Schedule):
    """Guards and targets of all rules first, rule by rule; then the bodies, element by element in the order of first mention."""

    def __init__(self, rules: Sequence[BoundRule], trace: Trace) -> None:
        super().__init__(rules, trace)
        self._flat: dict[Item, list[Node]] | None = None
        self._asked: set[Item] = set()

    def run(self) -> None:
        """Transform the models.

        Raises:
            RuleError: a rule raises.
        """
        add = self.trace.add
        for rule in self._to_run():
            free = rule.guard is None and not rule.own_bases
            name = rule.name
            for source in rule.kind.instances(exact=not rule.rule.greedy):
                if free or rule.applies(source, exact=False, check_type=False):
                    add(name, source, rule.targets_for(source))
        self._flat = {}
        by_name = self.by_name
        for link in list(self.trace):
            rule = by_name[link.rule]
            if (read := link.sources[0]) not in rule.done:
                rule.run(read, link.targets)

    def equivalents(self, source: Item, names: Sequence[str]) -> list[Node] | None:
        """The targets of a source in the order of the rules, primary ones in front; None if there are none, or not yet.

        Raises:
            RuleError: a body that was still to run for it raises.
        """
        links = self.trace.links_from(source)
        if self._flat is not None and links and source not in self._asked:
            self._asked.add(source)
            for link in links:
                if source not in (rule := self.by_name[link.rule]).done:
                    self._run_nested(rule, source, link.targets)
        if names:
            return [t for link in links if link.rule in names for t in link.targets]
        if self._flat is None or not links:
            return None
        flat = self._flat.get(source)
        if flat is None:
            flat = self._flat[source] = _flattened(links, self.by_name)
        return flat


def _flattened(links: list[Link], rules: dict[str, BoundRule]) -> list[Node]:
    flat: list[Node] = []
    for link in links:
        flat = [*link.targets, *flat] if rules[link.rule].rule.primary else [*flat, *link.targets]
    return flat


class Demand(Schedule):
    """Rule by rule, for each element guard, target and body at once; lazy rules run on demand."""

    def run(self) -> None:
        """Transform the models.

        Raises:
            RuleError: a rule raises.
        """
        for rule in self._to_run():
            exact = not rule.rule.greedy
            for source in rule.kind.instances(exact):
                if rule.applies(source, exact, check_type=False):
                    self._transform(rule, source)

    def _transform(self, rule: BoundRule, source: Item) -> list[Node]:
        if source in rule.done:
            return [t for link in self.trace.links_from(source) if link.rule == rule.name for t in link.targets]
        rule.done.add(source)
        targets = rule.targets_for(source)
        self.trace.add(rule.name, source, targets)
        self._run_nested(rule, source, targets)
        return targets

    def equivalents(self, source: Item, names: Sequence[str]) -> list[Node] | None:
        """The targets of a source; rules that apply run first, all of them or the named ones. Empty if there are none.

        Raises:
            RuleError: a rule raises.
        """
        fitting = [r for r in self.rules if not r.rule.abstract and r.applies(source, exact=not r.rule.greedy)]
        targets: list[Node] = []
        for rule in fitting:
            if not names or rule.name in names:
                made = self._transform(rule, source)
                targets = [*made, *targets] if rule.rule.primary else [*targets, *made]
        return targets
