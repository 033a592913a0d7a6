"""`TraceRecorder` collects trace links while rules run, and turns them into a trace model at the end.

Links can be looked up both ways at once, so a rule can ask for the equivalent of a source that another rule made.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from robosmi.metamodels import trace


class TraceRecorder:
    """Trace links of one run, indexed both ways."""

    def __init__(self) -> None:
        self._links: list[tuple[str, str, list[Any], list[Any]]] = []
        self._targets: dict[int, list[Any]] = {}
        self._sources: dict[int, list[Any]] = {}

    def link(self, rule: str, step: str, sources: Iterable[Any], targets: Iterable[Any]) -> None:
        """Record that a rule made the targets from the sources.

        Args:
            rule: its name.
            step: the step of the method (code, hardware, libraries, generation).
            sources: what was read; sources that are None are left out.
            targets: what was made.
        """
        found = [s for s in sources if s is not None]
        made = list(targets)
        self._links.append((rule, step, found, made))
        for source in found:
            self._targets.setdefault(id(source), []).extend(made)
        for target in made:
            self._sources.setdefault(id(target), []).extend(found)

    def equivalents(self, source: Any) -> list[Any]:
        """Everything that was made from a source, in the order it was made."""
        return list(self._targets.get(id(source), ()))

    def origins(self, target: Any) -> list[Any]:
        """Everything that a target was made from."""
        return list(self._sources.get(id(target), ()))

    def to_model(self) -> trace.Trace:
        """The links as a trace model; texts are added by the generator."""
        return trace.Trace(links=[trace.TraceLink(rule=r, step=s, sources=a, targets=b) for r, s, a, b in self._links])
