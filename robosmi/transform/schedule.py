"""The two schedules of ETL: `Match` (all targets first, then the bodies) and `Demand` (each target with its body).

`etl` selects one of them. Both follow Epsilon's engine as measured; docs/reference/etl.md lists the differences.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING

from robosmi.query.deep import LEVELS, in_thread
from robosmi.transform.rule import BoundRule
from robosmi.transform.trace import Link, Trace

if TYPE_CHECKING:
    from robosmi.model.driver import Item, Node


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
    """Rule by rule, for each element guard, target and body at once; what is asked for is made when it is asked for."""

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
