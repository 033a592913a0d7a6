"""The verdict on each construct of a program: its disposition in terms of a user's work, with place, reason and effort.

A construct is what the partition judges (paper 3.1): an include, a macro, a declaration at file scope, a statement of main and
of its loop, a local that moves out of main, and what is used and declared elsewhere. Each has one disposition and so one
verdict, which follows from the adapters, findings and open ports of the plan (docs/method/verdicts.md). Nothing is decided
here.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from functools import cache
from typing import Any, NamedTuple

from msgspec import Struct

from robosmi.metamodels import ccode, migration
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.innermost import Innermost
from robosmi.transformations.queries.names import name_of
from robosmi.transformations.queries.plans.plan_adapters import limits
from robosmi.transformations.queries.plans.waiting_calls import open_conventions
from robosmi.transformations.queries.text_changes import CARRIED_OVER

RETAINED, ADAPTED, CARE, NEEDS_YOU, UNSUPPORTED = "retained", "adapted", "adapted_with_care", "needs_you", "not_supported"
VERDICTS = (RETAINED, ADAPTED, CARE, NEEDS_YOU, UNSUPPORTED)
"""All verdicts, from the one that asks nothing of the user to the one that no change of the text can mend."""
EFFORTS = ("small", "medium", "large")
"""Effort levels: up to half an hour; up to half a day; more than that, or another device or board."""

_Status = migration.AdapterStatus
_Action = migration.Action
_OF_STATUS = {_Status.filled: ADAPTED, _Status.care: CARE, _Status.todo: NEEDS_YOU, _Status.unsupported: UNSUPPORTED}
_OF_ACTION = {_Action.retain: RETAINED, _Action.unsupported: UNSUPPORTED}
_AS_IT_IS = (_Action.retain, _Action.rewrite)
"""Actions whose own reason is left out of a verdict if there is something left to do."""
_UNKNOWN_HEADER = "unknown-include"
_SHOWN = 48


class ReasonedVerdict(NamedTuple):
    """A verdict with its reason and effort."""

    verdict: str
    reason: str
    effort: str = ""


class Construct(Struct, frozen=True):
    """A construct and its verdict.

    Attributes:
        disposition: the plan's.
        element: the construct.
        unit: the file it is in, None for what is declared elsewhere.
        line: its line, of what is declared elsewhere that of the first use; 0 where nothing says it.
        title: what a report calls it: the text that names it, or how a statement begins.
        verdict: one of `VERDICTS`.
        reason: why, a sentence.
        effort: one of `EFFORTS`, empty where nothing is left to do.
    """

    disposition: migration.Disposition
    element: ccode.Located
    unit: ccode.SourceUnit | None
    line: int
    title: str
    verdict: str
    reason: str
    effort: str

    def to_json(self) -> dict[str, Any]:
        """The contract's form."""
        return {
            "path": self.unit.path if self.unit is not None else None, "line": self.line or None, "construct": self.title,
            "verdict": self.verdict, "action": self.disposition.action.name, "reason": self.reason, "effort": self.effort or None,
        }  # fmt: skip


def constructs(plan: migration.MigrationPlan, sources: Mapping[str, bytes] | None = None) -> list[Construct]:
    """Every construct of a plan's program once: file by file in text order, then what is declared elsewhere.

    Args:
        plan: the plan.
        sources: path of a unit -> its bytes, for how statements begin; without them they are called by their kind.
    """
    judge = _Judge(plan)
    externals = {id(e) for e in (plan.program.externals if plan.program is not None else ())}
    units = {id(u): number for number, u in enumerate(plan.program.units if plan.program is not None else ())}
    found: list[tuple[tuple[int, int], Construct]] = []
    for disposition in plan.dispositions:
        element = disposition.element
        if element is None:
            continue
        unit = None if id(element) in externals else ancestor_of_kind(element, ccode.SourceUnit)
        judged = judge.judged(disposition)
        data = (sources or {}).get(unit.path, b"") if unit is not None else b""
        made = Construct(disposition, element, unit, _line(element, unit), construct_title(element, data), *judged)
        found.append(((units.get(id(unit), len(units)), int(element.startOffset) if unit is not None else len(found)), made))
    return [construct for _, construct in sorted(found, key=lambda pair: pair[0])]


def verdict_counts(judged: Iterable[Construct]) -> dict[str, int]:
    """How many constructs have each verdict, every verdict named, and `total`, their sum."""
    counts = Counter(construct.verdict for construct in judged)
    return {"total": counts.total(), **{verdict: counts[verdict] for verdict in VERDICTS}}


def construct_title(element: ccode.Located, data: bytes = b"") -> str:
    """What a construct is called: by its name, or as the statement begins in the text.

    Args:
        element: the construct.
        data: the bytes of its file, empty where they are not at hand.
    """
    if isinstance(element, ccode.Include):
        return f"#include {'<' if element.system else chr(34)}{element.header}{'>' if element.system else chr(34)}"
    kind = _KINDS.get(type(element).__name__, "")
    if isinstance(element, (ccode.Declaration, ccode.Macro)):
        return f"{kind} {element.name}".strip() if element.name else kind or type(element).__name__
    text = " ".join(data[element.startOffset : element.endOffset].decode("utf-8", "replace").split())
    if not text:
        return type(element).__name__
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 4].rstrip()} ..."


_KINDS = {
    "Function": "function", "Variable": "variable", "Macro": "macro", "Typedef": "type", "Record": "type", "Enumeration": "enum",
    "EnumerationLiteral": "constant", "ExternalSymbol": "name",
}  # fmt: skip


def _line(element: ccode.Located, unit: ccode.SourceUnit | None) -> int:
    if unit is not None:
        return int(element.line)
    uses: list[ccode.Located] = [*element.calls] if isinstance(element, ccode.Function) else []
    uses += element.references if isinstance(element, ccode.Declaration) else []
    return min((use.line for use in uses), default=0)


class _Judge:
    """Judges the constructs of one plan."""

    def __init__(self, plan: migration.MigrationPlan) -> None:
        self.plan = plan
        program = plan.program
        self.uses = {str(use.name): use for use in plan.adapterUses}
        self.symbols = {str(use.name): use for use in plan.symbolUses}
        self.unserved = unserved_headers(plan)
        self.externals = {id(e) for e in (program.externals if program is not None else ())}
        self.marks: dict[int, list[ReasonedVerdict]] = {}
        spans = _Spans(plan, self.externals)
        for element, judged in self._said():
            if (key := spans.around(*element)) is not None:
                self.marks.setdefault(key, []).append(judged)

    def _said(self) -> Iterable[tuple[tuple[str, int, int], ReasonedVerdict]]:
        """The verdicts that findings and open ports imply for places (path, line, byte offset or negated column)."""
        for finding in self.plan.findings:
            if finding.path and finding.line and finding.severity is not migration.SeverityLevel.info:
                broken = finding.severity is migration.SeverityLevel.error or finding.rule in _TO_DO
                verdict = ReasonedVerdict(NEEDS_YOU if broken else CARE, str(finding.message), "small")
                places = [e for e in finding.elements if isinstance(e, ccode.Located)]
                if not places:
                    yield (str(finding.path), int(finding.line), -int(finding.column or 0)), verdict
                for place in places:
                    yield (str(finding.path), int(place.line), int(place.startOffset)), verdict
        for binding in self.plan.portBindings:
            element = binding.element
            unit = ancestor_of_kind(element, ccode.SourceUnit) if element is not None else None
            if binding.open and binding.conventionalPort is None and element is not None and unit is not None:
                reason = f"port '{binding.name}' has no pin"
                yield (str(unit.path), int(element.line), int(element.startOffset)), ReasonedVerdict(NEEDS_YOU, reason, "small")

    def judged(self, disposition: migration.Disposition) -> ReasonedVerdict:
        """The verdict on the element of a disposition: the one of all that apply which asks most of the user."""
        first = self._elsewhere(disposition) if id(disposition.element) in self.externals else self._own(disposition)
        marks = self.marks.get(id(disposition.element), [])
        worst = max([first, *marks], key=lambda judged: VERDICTS.index(judged.verdict))
        said = [mark.reason for mark in marks if mark.verdict == worst.verdict]
        reasons = said if said and disposition.action in _AS_IT_IS else [first.reason, *said]
        return ReasonedVerdict(worst.verdict, "; ".join(dict.fromkeys(filter(None, reasons))), worst.effort)

    def _own(self, disposition: migration.Disposition) -> ReasonedVerdict:
        reasons = [str(reason) for reason in disposition.reasons if reason]
        if disposition.action is _Action.rewrite and CARRIED_OVER.issuperset(disposition.rules):
            reasons.append("a port in it has another pin on the target")
        use = self.uses.get(name_of(disposition.element)) if IN_PLACE in disposition.rules else None
        if use is not None and use.status in (_Status.todo, _Status.unsupported):
            return ReasonedVerdict(NEEDS_YOU, "; ".join(reasons), body_effort(use))
        verdict = _OF_ACTION.get(disposition.action, ADAPTED)
        if _UNKNOWN_HEADER in disposition.rules or not UNDEFINED.isdisjoint(disposition.rules):
            verdict = NEEDS_YOU
        effort = {UNSUPPORTED: "medium", NEEDS_YOU: "small"}.get(verdict, "")
        return ReasonedVerdict(verdict, "; ".join(reasons), effort)

    def _elsewhere(self, disposition: migration.Disposition) -> ReasonedVerdict:
        """The verdict on an element that is declared outside the program: that of its adapter or symbol."""
        name = name_of(disposition.element)
        if isinstance(disposition.element, ccode.Function) and name in self.uses:
            return self._use(self.uses[name])
        if name in self.symbols:
            return self._symbol(self.symbols[name])
        return self._own(disposition)

    def _use(self, use: migration.AdapterUse) -> ReasonedVerdict:
        if use.status is _Status.unsupported:
            return ReasonedVerdict(UNSUPPORTED, str(use.reason), "large")
        if use.status is _Status.todo:
            return ReasonedVerdict(NEEDS_YOU, str(use.reason) or "its adapter has no body yet", body_effort(use))
        if waiting := open_conventions(self.plan, use):
            return ReasonedVerdict(NEEDS_YOU, f"it uses {_listed(b.name for b in waiting)}, which has no pin", "small")
        if use.adapter is None:
            return ReasonedVerdict(ADAPTED, "you wrote its adapter")
        if said := limits(use):
            return ReasonedVerdict(CARE, "; ".join(said), "small")
        return ReasonedVerdict(ADAPTED, str(use.adapter.fidelity) or "an adapter replaces it")

    def _symbol(self, use: migration.SymbolUse) -> ReasonedVerdict:
        header = use.symbol.header if use.symbol is not None else None
        if use.status is _Status.todo and header is not None and header.name in self.unserved:
            return ReasonedVerdict(UNSUPPORTED, self.unserved[str(header.name)], "large")
        if use.status is _Status.unsupported:
            return ReasonedVerdict(UNSUPPORTED, "the target does not have it", "large")
        if use.status is _Status.todo:
            return ReasonedVerdict(NEEDS_YOU, "a placeholder without effect replaces it", "small")
        said = use.adapter.limits if use.adapter is not None else ()
        verdict = CARE if use.status is _Status.care else ADAPTED
        fidelity = str(use.adapter.fidelity) if use.adapter is not None else ""
        return ReasonedVerdict(
            verdict,
            "; ".join(str(each) for each in said) or fidelity or "declared with the adapters",
            "small" * (verdict == CARE),
        )


IN_PLACE = "adapter-in-place"
"""The rule by which a function that the program declares and no file defines gets its body where it is declared."""
UNDEFINED = frozenset(
    {"define-extern", "define-without-extern", "define-local", "define-in-list", "define-behind", "left-undefined"}
)
"""Rules about variables that are declared but defined in no file: the declaration becomes a definition, or is left alone."""
_TO_DO = frozenset({"RS312", "RS321", "RS337", "RS342", "RS350", "RS351"})
"""Rules of warnings that leave something to be written: C that C++ refuses, code that needs a core of its own, names that are
defined twice, addresses of registers and those written as numbers."""


def unserved_headers(plan: migration.MigrationPlan) -> dict[str, str]:
    """The headers of the source platform that the target cannot serve, with the reason."""
    headers = plan.target.unsupportedHeaders if plan.target is not None else ()
    return {str(header.name): str(header.reason) for header in headers}


def body_effort(use: migration.AdapterUse) -> str:
    """The effort of writing the body of an adapter that has none.

    A function that no header of the platform declares is the program's own, whose file was not given: small. One of a library of
    the source platform is to be read there and written for the target: medium. Where the target lacks what it needs, or code for
    another core is to be written anew: large.
    """
    if use.status is _Status.unsupported or (use.function is not None and use.function.codeArgument >= 0):
        return "large"
    return "small" if use.function is None else "medium"


def _listed(names: Iterable[str]) -> str:
    """Names in a sentence."""
    all_names = [f"'{name}'" for name in names]
    return " and ".join([", ".join(all_names[:-1]), all_names[-1]]) if len(all_names) > 1 else "".join(all_names)


class _Spans:
    """Finds the innermost construct at a place of the text."""

    def __init__(self, plan: migration.MigrationPlan, externals: set[int]) -> None:
        self._of_unit: dict[str, list[ccode.Located]] = {}
        for disposition in plan.dispositions:
            element = disposition.element
            unit = ancestor_of_kind(element, ccode.SourceUnit) if element is not None and id(element) not in externals else None
            if element is not None and unit is not None:
                self._of_unit.setdefault(str(unit.path), []).append(element)
        self._offsets = cache(lambda path: Innermost(map(_bytes_of, self._of_unit.get(path, ()))))
        self._lines = cache(lambda path: Innermost(map(_lines_of, self._of_unit.get(path, ()))))
        self._columns = cache(lambda path: Innermost(map(_columns_of, self._of_unit.get(path, ()))))

    def around(self, path: str, line: int, offset: int) -> int | None:
        """The `id` of the smallest construct that contains the offset, or the line and column if it is not positive."""
        if offset > 0:
            return self._offsets(path).at(offset)
        return self._columns(path).at((line, -offset)) if offset else self._lines(path).at(line)


def _size(element: ccode.Located) -> int:
    return int(element.endOffset) - int(element.startOffset)


def _bytes_of(element: ccode.Located) -> tuple[int, int, int, int]:
    start = int(element.startOffset)
    return start, max(int(element.endOffset), start + 1), _size(element), id(element)


def _lines_of(element: ccode.Located) -> tuple[int, int, int, int]:
    return int(element.line), int(element.endLine or element.line) + 1, _size(element), id(element)


def _columns_of(element: ccode.Located) -> tuple[tuple[int, int], tuple[int, int], int, int]:
    line, column = int(element.line), int(element.column)
    return (line, column), (int(element.endLine or line), int(element.endColumn or column + 1)), _size(element), id(element)
