"""The result of a validation: unsatisfied constraints with their fixes, and reports as text, JSON and findings.

A fix that raises is rolled back. Reports name elements by their places after all checks and before the first fix.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import RuleError, UsageError
from robosmi.model.elements.driver import Model
from robosmi.query.rules.rule_language import failed, option_value, place_in_model, technology
from robosmi.query.values import as_string
from robosmi.validate.constraint import Constraint, Fix

if TYPE_CHECKING:
    from robosmi.base.data_text import Json
    from robosmi.model.elements.driver import Item, ItemOrItems


class ApplicableFix:
    """A fix that applies to one finding.

    Attributes:
        title: what it would do.
        of: the finding.
    """

    def __init__(self, fix: Fix, of: Unsatisfied, models: list[Model]) -> None:
        self.of = of
        self._fix = fix
        self._models = models
        self.title: str = option_value(fix.title, of.element)

    def __repr__(self) -> str:
        return f"<fix: {self.title}>"

    def apply(self) -> None:
        """Perform the fix, completely or not at all.

        Raises:
            RuleError: it raises; the models are as they were before.
        """
        recordings = []
        with ExitStack() as open_recordings:
            for recorder in _recorders(self._models):
                recordings.append(open_recordings.enter_context(recorder()))
            try:
                option_value(self._fix.do, self.of.element)
            except BaseException as error:
                for recording in recordings:
                    recording.undo()
                if not isinstance(error, (Exception, SystemExit)):
                    raise  # the user interrupts
                what = f"the fix '{self.title}' of {self.of.constraint.name}"
                raise failed(error, what, self._fix.do, self.of.element, self._models) from error
        self.of.fixed = True


def _recorders(models: list[Model]) -> Iterator[Callable[[], Any]]:
    from robosmi.model.changes import Recording
    from robosmi.model.emf import EmfModel

    changed = [technology(m) for m in models]
    yield lambda: Recording([m for m in changed if isinstance(m, EmfModel)])
    for model in changed:
        if not isinstance(model, EmfModel) and (own := getattr(model.__class__, "recording", None)) is not None:
            yield lambda model=model, own=own: own(model)  # type: ignore[misc]


class Unsatisfied(Struct, eq=False):
    """A constraint that an element does not satisfy.

    Attributes:
        constraint: the constraint.
        element: the element, None for a constraint without context.
        message: what is wrong.
        default_message: whether nobody wrote a message for it.
        extras: values of the check.
        fixes: the fixes that apply.
        fixed: whether one of them was applied.
        advice: what to do, or None.
    """

    constraint: Constraint
    element: Item
    message: str
    default_message: bool = False
    extras: Mapping[str, ItemOrItems] = {}
    fixes: list[ApplicableFix] = []
    fixed: bool = False
    advice: str | None = None

    @property
    def name(self) -> str:
        """The constraint's name."""
        return self.constraint.name

    @property
    def severity(self) -> Severity:
        """How bad it is."""
        return self.constraint.severity

    def __repr__(self) -> str:
        return f"<{self.name} of {self.element!r}: {self.message}>"


class Applied(Struct, frozen=True):
    """A fix that was performed: of which finding, what, and the error if it failed and was rolled back."""

    of: Unsatisfied
    title: str
    error: RuleError | None = None


class Validation:
    """The result of a run.

    Attributes:
        models: the models that were validated.
        unsatisfied: what was found, in the order found.
        fixed: the fixes performed, in order.
    """

    def __init__(self, models: list[Model]) -> None:
        self.models = models
        self.unsatisfied: list[Unsatisfied] = []
        self.fixed: list[Applied] = []
        self._places: dict[int, str | None] = {}

    def __bool__(self) -> bool:
        """Whether no constraint failed; critiques do not count."""
        return not any(u.severity is Severity.error for u in self.unsatisfied)

    def place(self, unsatisfied: Unsatisfied) -> str | None:
        """The element of a finding as reports name it, `M!Book //@items.0`: its place before the first fix."""
        key = id(unsatisfied)
        if key not in self._places:
            self._places[key] = place_in_model(unsatisfied.element, self.models)
        return self._places[key]

    def apply(self, choose: str | Callable[[Unsatisfied], ApplicableFix | None]) -> None:
        """Perform one fix of every finding, in order; one that raises is rolled back and reported, and the others go on.

        Args:
            choose: "first" or "last" of the fixes that apply, or a function that chooses one (None for none).

        Raises:
            UsageError: it says neither.
        """
        if not callable(choose) and choose not in ("first", "last"):
            raise UsageError(
                f"fix='{choose}' is no choice", fix="use 'first', 'last' or a function from a finding to one of its fixes"
            )
        for unsatisfied in self.unsatisfied:
            self.place(unsatisfied)
        for unsatisfied in list(self.unsatisfied):
            fixes = unsatisfied.fixes
            fix = choose(unsatisfied) if callable(choose) else (fixes[0 if choose == "first" else -1] if fixes else None)
            if fix is None:
                continue
            try:
                fix.apply()
                self.fixed.append(Applied(unsatisfied, fix.title))
            except RuleError as error:
                self.fixed.append(Applied(unsatisfied, fix.title, error))

    def findings(self) -> list[Finding]:
        """The validation's results as findings of the contract, one for each unsatisfied constraint."""
        found = []
        for u in self.unsatisfied:
            c = u.constraint
            located = self._located(c, u.element) if u.element is not None else None
            advice = u.advice or (u.fixes[0].title if u.fixes else None)
            evidence = {k: v if isinstance(v, (str, int, float, bool)) or v is None else str(v) for k, v in u.extras.items()}
            found.append(Finding(c.id, u.severity, u.message, located, self.place(u), advice, evidence))
        return found

    def _located(self, constraint: Constraint, element: Item) -> Location | None:
        if constraint.location is None:
            return None
        try:
            return constraint.location(element)
        except (Exception, SystemExit) as error:
            raise failed(error, f"the location of {constraint.name}", constraint.location, element, self.models) from error

    def to_json(self) -> dict[str, Json]:
        """The report as JSON values: `unsatisfied` and `fixed`, in order."""
        return {
            "unsatisfied": [self._entry(u) for u in self.unsatisfied],
            "fixed": [
                {"constraint": a.of.name, "title": a.title, **({"error": a.error.message} if a.error else {})} for a in self.fixed
            ],
        }

    def _entry(self, u: Unsatisfied) -> dict[str, Json]:
        c = u.constraint
        return {
            "constraint": c.name, "context": c.context.name, "kind": c.kind, "info": c.info, "severity": u.severity.name,
            "element": self.place(u), "message": u.message, "extras": {k: self._plain(v) for k, v in u.extras.items()},
            "fixes": [f.title for f in u.fixes],
        }  # fmt: skip

    def _plain(self, value: ItemOrItems) -> Json:
        if value is None or isinstance(value, (str, int, float, bool)):
            return value
        return as_string(value) if isinstance(value, Sequence) else place_in_model(value, self.models)

    def text(self) -> str:
        """The report for users: a line for each finding, below it the fixes that apply, then a summary."""
        lines = []
        for u in self.unsatisfied:
            place = self.place(u)
            lines.append(f"{f'{place}: ' if place else ''}{u.severity.name}: {u.message} [{u.constraint.id}]")
            lines.extend(f"  fix {n}: {fix.title}" for n, fix in enumerate(u.fixes, 1))
        for a in self.fixed:
            done, why = ("fixed", "") if a.error is None else ("not fixed", f": {a.error.message}")
            lines.append(f"{done} {a.of.name}: {a.title}{why}")
        counts = [(sum(u.severity is level for u in self.unsatisfied), level.name) for level in reversed(Severity)]
        summary = ", ".join(f"{count} {name}{'s' if count != 1 and name != 'info' else ''}" for count, name in counts if count)
        return "\n".join([*lines, summary or "all constraints are satisfied"])

    def __repr__(self) -> str:
        return f"<Validation: {len(self.unsatisfied)} unsatisfied, {len(self.fixed)} fixed>"
