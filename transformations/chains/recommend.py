"""The chain `recommend`: ranks libraries for the components of a drawing or a list."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from msgspec import Struct

from robosmi.diagnostics import Finding
from robosmi.errors import UsageError
from robosmi.plugins import content
from robosmi.project import default_text
from robosmi.query import Q
from robosmi.recommend.component import ComponentQuery, read_components
from robosmi.recommend.ranking import Recommendation
from robosmi.resources import project_of_input
from robosmi.transformations.chains.library_steps import history_findings, previous_choices
from robosmi.transformations.chains.stages.reading import read_drawing
from robosmi.transformations.knowledge.platforms.target_platform import target_facts
from robosmi.transformations.m2m.choices.library_choice import component_query
from robosmi.transformations.queries.circuits.circuit import boards, the_board


class Recommendations(Struct, frozen=True):
    """The recommendations for some components, in their order."""

    queries: list[ComponentQuery]
    answers: list[Recommendation]
    findings: list[Finding] = []

    @property
    def result(self) -> dict[str, Any]:
        """The contract's result."""
        return {"recommendations": [answer.to_json() for answer in self.answers]}

    def _repr_html_(self) -> str:
        from robosmi.report.notebook import bar, quoted, table  # for notebooks only

        rows = []
        for query, answer in zip(self.queries, self.answers, strict=True):
            best = max((c.score for c in answer.candidates), default=0.0)
            shown = answer.candidates[: 5 if answer.decision != "none" else 0]
            named = [f"{quoted(c.library)}{bar(c.score / best if best > 0 else 0)}{quoted('; '.join(c.reasons))}" for c in shown]
            decided = f"{quoted(answer.decision)}{bar(answer.confidence)}{quoted('; '.join(answer.reasons))}"
            rows.append([f"{quoted(query.label or query.title)}<br/>{quoted(query.title)}", decided, "<br/>".join(named)])
        return table(("component", "needs a library", "libraries, best first"), rows)

    def lines(self) -> list[str]:
        """What the user reads: the decision with its reason, and where a library is of use the best five, each with a reason."""
        lines: list[str] = []
        for query, answer in zip(self.queries, self.answers, strict=True):
            sure = f" ({answer.confidence:.0%} sure)" if answer.confidence else ""
            why = f": {answer.reasons[0]}" if answer.reasons else ""
            lines.append(f"{query.label or query.title} ({query.title}): {answer.decision}{sure}{why}")
            for candidate in answer.candidates[: 5 if answer.decision != "none" else 0]:
                lines.append(
                    f"  {candidate.score:6.3f}  {candidate.library} <{candidate.header}>  {next(iter(candidate.reasons), '')}"
                )
        return lines


def recommend(
    sketch: Path | None = None,
    *,
    components: Path | None = None,
    ranker: str | None = None,
    target: str | None = None,
    roles: Mapping[str, str] | None = None,
    history: str | None = None,
) -> Recommendations:
    """Rank libraries for the components that a board pin reaches, or for listed ones.

    Args:
        sketch: a drawing.
        components: a JSON file with components instead.
        ranker: name of the ranker.
        target: the target board.
        roles: COMPONENT -> role, as the project file says.
        history: place of earlier choices, a file or a URL; the user's own if None.

    Raises:
        SourceError: the input cannot be read, or is a drawing without a board.
        UsageError: there is no such ranker or target.
    """
    with project_of_input(components or sketch or "."):
        return _ranked(sketch, components, ranker, target, roles or {}, history)


def _ranked(
    sketch: Path | None, components: Path | None, ranker: str | None, target: str | None, roles: Mapping[str, str],
    history: str | None,
) -> Recommendations:  # fmt: skip
    findings: list[Finding] = []
    if components is not None:
        queries = list(read_components(components))
    else:
        assert sketch is not None
        drawing = read_drawing(sketch, roles)
        if not boards(drawing.circuit):
            the_board(drawing.circuit)  # says what is missing
        findings = drawing.findings
        reached = Q(drawing.connections).collect(lambda c: c.component).select(lambda c: c is not None).distinct()
        queries = [component_query(c) for c in reached if c is not None]
    facts = target_facts(target or default_text("migrate", "target"))
    if not facts.libraries:
        raise UsageError(f"the target '{facts.target}' has no libraries", fix="give another --target")
    rank = content("ranker", ranker or default_text("rank", "ranker"))(facts.libraries, architecture=facts.architecture)
    earlier = previous_choices(history, facts)
    answers = [rank.rank(query, earlier) for query in queries]
    return Recommendations(queries, answers, [*findings, *history_findings(earlier)])
