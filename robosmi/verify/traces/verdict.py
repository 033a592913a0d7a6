"""The result of a verification: the verdict, its basis, and where two programs differ first.

A verdict never says "equivalent", only that no difference was found, in which scenarios, for how long, and with how much of the
source covered. A difference outweighs an undecidable scenario, and this outweighs finding no difference.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from msgspec import Struct, field

from robosmi.base.quantities import quantity
from robosmi.verify.missed_lines import format_ranges
from robosmi.verify.original import LibraryCall
from robosmi.verify.scenario import Scenario
from robosmi.verify.traces.comparison import DIFFERENT, NOT_EXERCISED, RACY, SAME, ChannelComparison, FirstDifference

if TYPE_CHECKING:
    from robosmi.base.data_text import Json

NO_DIFFERENCE, DIFFERENT_VERDICT, NOT_DECIDABLE, NOT_COMPILED = (
    "no-difference-found", "different", "not-decidable", "not-compiled",
)  # fmt: skip
EXIT_CODES = {NO_DIFFERENCE: 0, DIFFERENT_VERDICT: 6, NOT_COMPILED: 6, NOT_DECIDABLE: 1}
"""The command's exit code for each verdict."""
PROGRAM = "program"
"""The channel of a crash, which concerns the program as a whole."""


class Judge(Struct, frozen=True):
    """Where programs are judged.

    Attributes:
        name: in JSON.
        said: the same in words, where every text of a verdict has to say it.
        not_seen: what nobody sees there.
    """

    name: str
    said: str = ""
    not_seen: tuple[str, ...] = ()


AT_THE_PINS = Judge("pins")
"""At the pins of a simulated board: what is worth most, and not said."""


class ScenarioVerdict(Struct, frozen=True):
    """What became of one scenario.

    Attributes:
        scenario: the scenario.
        verdict: no-difference-found, different, or not-decidable.
        channels: what became of each channel.
        simulated_ms: how long both sides ran.
        reason: why nothing could be decided; empty otherwise.
        crash: when the migrated program crashed though the original did not; None if it did not.
    """

    scenario: Scenario
    verdict: str
    channels: tuple[ChannelComparison, ...]
    simulated_ms: float
    reason: str = ""
    crash: FirstDifference | None = None

    @property
    def first(self) -> FirstDifference | None:
        """The first difference, by the source's time."""
        found = [each for each in (*(c.difference for c in self.channels), self.crash) if each is not None]
        return min(found, key=lambda difference: difference.at_ms, default=None)

    @property
    def until_ms(self) -> float | None:
        """When a side ended before the scenario did, so that nothing was compared from then on; None if both ran to its end."""
        return self.simulated_ms if self.simulated_ms < self.scenario.horizon_ms else None

    def to_json(self) -> dict[str, Any]:
        """The contract's form (`scenarios[]`)."""
        return {
            "name": self.scenario.name, "origin": self.scenario.origin, "verdict": self.verdict,
            "simulated_s": round(self.simulated_ms / 1000, 6), "reason": self.reason or None, "until_ms": _rounded(self.until_ms),
            "channels": [
                {
                    "name": c.channel, "status": c.status, "events": c.events,
                    "differs_from_itself": None if c.itself is None else c.itself.to_json(),
                }
                for c in self.channels
            ],
        }  # fmt: skip


class CallsAround(Struct, frozen=True):
    """The source's calls near a difference.

    Attributes:
        made: the last call of a function of that channel; not necessarily the cause, which may be a wait beside it.
        around: other calls near it, in order of time.
    """

    made: LibraryCall | None = None
    around: tuple[LibraryCall, ...] = ()


class SearchEnd(Struct, frozen=True):
    """How a search for scenarios ended.

    Attributes:
        budget_s: its budget in seconds: of a typical machine, or by the clock if the user has set it.
        tried: how many scenarios it tried.
        seconds: how long it took; 0 where it is a stored one.
        cut: whether the budget ended it though it had more to try.
    """

    budget_s: float = 0.0
    tried: int = 0
    seconds: float = 0.0
    cut: bool = False

    def to_json(self) -> dict[str, Json]:
        """The contract's form (`search`)."""
        return {
            "budget_s": self.budget_s, "tried": self.tried, "seconds": round(self.seconds, 1), "ended_by_budget": self.cut,
        }  # fmt: skip


class Verdict(Struct):
    """What a verification says.

    Attributes:
        scenarios: what became of each scenario.
        reasons: why nothing can be decided, beyond what the scenarios say.
        compiled: whether the migrated program compiles.
        engine, compiler, original: the simulator, the target's compiler and core, the source's model and compiler.
        counted: how many scenarios count for that: those that were decided, but for crashes, if anything was compared at all.
        lines_pct, branches_pct: how much of the source these reach; branches that only racy ones reach are not counted. 0 where
            no scenario counts.
        racy: how many generated scenarios were dropped because the source differs from itself.
        racy_branches: branches that only those reach, `file:line`.
        missed_lines: lines that no scenario reaches, `file:line` or `file:first-last`.
        missed_branches: branches that no scenario reaches, `file:line`.
        untaken: those of them that stand on lines which are reached.
        outputs: each output that is wired on both boards -> whether it was compared in a scenario that counts.
        unreachable: functions that nothing reaches from main, `file:first-last name`; their lines are not counted.
        binding: the ports with their pins and devices on both sides.
        functions: channel -> the platform's functions that use it.
        not_compared: ports that are not compared: lines of buses, what is not wired on the target, and what is one pin of the
            source and several of the target.
        why_not_compared: name of one of them -> why, where that is not seen in the binding.
        calls: those of the source around the first difference.
        little_room: what the compile report says of a stack for which there is little room; empty where there is enough.
        stand_ins: libraries that are not installed here, so that stand-ins of the repository were simulated.
        stubbed: what does nothing on both sides: functions without a model, missing headers and what they declare.
        search: how the search for scenarios ended, in this run or the one that stored them; None without one.
        judged_at: where; all others are worth less than `AT_THE_PINS`.
        not_compiled: why no compiler of the board has compiled the program that was judged elsewhere; empty if one has.
    """

    scenarios: list[ScenarioVerdict] = []
    reasons: list[str] = []
    compiled: bool = True
    engine: str = ""
    compiler: str = ""
    original: str = ""
    counted: int = 0
    lines_pct: float = 0.0
    branches_pct: float = 0.0
    racy: int = 0
    racy_branches: list[str] = []
    missed_lines: list[str] = []
    missed_branches: list[str] = []
    untaken: list[str] = []
    outputs: dict[str, bool] = {}
    unreachable: list[str] = []
    binding: list[dict[str, Json]] = []
    functions: dict[str, tuple[str, ...]] = {}
    not_compared: list[str] = []
    why_not_compared: dict[str, str] = {}
    calls: CallsAround = field(default_factory=CallsAround)
    little_room: str = ""
    stand_ins: list[str] = []
    stubbed: list[str] = []
    search: SearchEnd | None = None
    judged_at: Judge = AT_THE_PINS
    not_compiled: str = ""

    @property
    def verdict(self) -> str:
        """The verdict of all scenarios together."""
        if not self.compiled:
            return NOT_COMPILED
        if any(s.verdict == DIFFERENT_VERDICT for s in self.scenarios):
            return DIFFERENT_VERDICT
        decided = [s for s in self.scenarios if s.verdict == NO_DIFFERENCE]
        if self.reasons or len(decided) < len(self.scenarios) or not decided or self.nothing_compared:
            return NOT_DECIDABLE
        return NO_DIFFERENCE

    @property
    def nothing_compared(self) -> bool:
        """Whether no scenario exercises any channel, though all could be decided: finding no difference then means nothing."""
        if not self.scenarios or any(s.verdict != NO_DIFFERENCE for s in self.scenarios):
            return False
        return all(c.status == NOT_EXERCISED for s in self.scenarios for c in s.channels)

    @property
    def partial(self) -> bool:
        """Whether an output that is wired was not compared, a line that main can reach was not reached, or a name is stubbed."""
        return not self.counted or bool(self.missed_lines) or bool(self.stubbed) or not all(self.outputs.values())

    def covers(self, percent: float) -> bool:
        """Whether all wired outputs and at least that share of the lines that main can reach were compared, with no stub."""
        return bool(self.counted) and not self.stubbed and all(self.outputs.values()) and self.lines_pct >= percent

    @property
    def exit_code(self) -> int:
        """The exit code of the contract."""
        return EXIT_CODES[self.verdict]

    @property
    def simulated_s(self) -> float:
        """The total simulated time, in seconds, that was compared in all scenarios."""
        return sum(s.simulated_ms for s in self.scenarios) / 1000

    @property
    def first_difference(self) -> tuple[ScenarioVerdict, FirstDifference] | None:
        """The first scenario with a difference, and its first difference."""
        return next(((s, s.first) for s in self.scenarios if s.first is not None), None)

    def channels(self) -> list[dict[str, Any]]:
        """What became of each channel in all scenarios: different where one differs, not exercised where none uses it.

        `until_ms` is the earliest time at which a side of a scenario ended before the scenario, or None.
        """
        found: dict[str, list[ChannelComparison]] = {}
        for scenario in self.scenarios:
            for channel in scenario.channels:
                found.setdefault(channel.channel, []).append(channel)
        until_ms = _rounded(min((s.until_ms for s in self.scenarios if s.channels and s.until_ms is not None), default=None))
        return [
            {"name": name, "status": _worst(each), "events": sum(c.events for c in each), "until_ms": until_ms}
            for name, each in found.items()
        ]

    def to_json(self) -> dict[str, Any]:
        """The contract's form."""
        first = self.first_difference
        return {
            "verdict": self.verdict,
            "reasons": self.all_reasons(),
            "scenarios": [s.to_json() for s in self.scenarios],
            "simulated_s": round(self.simulated_s, 6),
            "source_coverage": {
                "lines_pct": round(self.lines_pct, 1), "branches_pct": round(self.branches_pct, 1),
                "missed": self.missed_branches, "missed_lines": self.missed_lines, "only_in_racy": self.racy_branches,
                "scenarios": self.counted, "unreachable": self.unreachable,
            },
            "partial": self.partial,
            "compared": {
                "outputs": sum(self.outputs.values()), "of": len(self.outputs), "lines_pct": round(self.lines_pct, 1),
            },
            "racy_scenarios": self.racy,
            "search": None if self.search is None else self.search.to_json(),
            "channels": self.channels(),
            "not_compared": self.not_compared,
            "not_compared_because": dict(self.why_not_compared),
            "first_difference": None if first is None else self._difference_json(*first),
            "engine": self.engine,
            "judged_at": self.judged_at.name,
            "not_seen": list(self.judged_at.not_seen),
            "not_compiled": self.not_compiled or None,
            "compiler": self.compiler,
            "stand_ins": self.stand_ins,
            "stubbed": self.stubbed,
            "original": self.original,
            "binding": self.binding,
        }  # fmt: skip

    def _difference_json(self, scenario: ScenarioVerdict, difference: FirstDifference) -> dict[str, Json]:
        return {
            "scenario": scenario.scenario.name,
            **difference.to_json(),
            "functions": list(self.functions.get(difference.channel, ())),
            "call": None if self.calls.made is None else self.calls.made.to_json(),
            "calls_around": [call.to_json() for call in self.calls.around],
            "inputs": inputs_until(scenario.scenario, difference.at_ms),
            "likely_cause": self._likely_cause(difference),
        }

    def _likely_cause(self, difference: FirstDifference) -> str | None:
        """The part of the compile report that may explain a crash; None if there is none."""
        return f"the stack may have run out: {self.little_room}" if self.little_room and difference.channel == PROGRAM else None

    def sentence(self) -> str:
        """The verdict in one sentence, for lists of findings."""
        if self.verdict == NOT_COMPILED:
            return "the migrated program does not compile, so it was not compared"
        said = {
            NO_DIFFERENCE: "no difference found between the original and the migrated program",
            DIFFERENT_VERDICT: "the migrated program differs from the original",
            NOT_DECIDABLE: "the comparison is undecided",
        }[self.verdict]
        if self.verdict == NO_DIFFERENCE:
            said = f"partly compared ({self._outputs()}): {said}" if self.partial else f"{said} in everything compared"
        said += f" in {self._many()}, {self.simulated_s:.1f} s simulated"
        said += "; ".join(["", self._reached(), *self._missed()])
        if (first := self.first_difference) is not None:
            said += f"; first in '{first[0].scenario.name}' at {first[1].at_ms:.1f} ms, {first[1].channel}: {first[1].message}"
        return "; ".join([said, *self._judged(), *self._stood_in(), *self.all_reasons()])

    def _judged(self) -> list[str]:
        return judge_lines(self.judged_at, self.not_compiled)

    def _many(self) -> str:
        return quantity(len(self.scenarios), "test case")

    def _outputs(self) -> str:
        """How many of the wired outputs were compared, in words."""
        return f"{sum(self.outputs.values())} of {quantity(len(self.outputs), 'output')}"

    def _headline(self) -> str:
        """The verdict with what it rests on, in one line."""
        basis = f"in {self._many()}, {self.simulated_s:.1f} s simulated"
        where = f", {self.judged_at.said}," if self.judged_at.said else ""
        if self.verdict != NO_DIFFERENCE:
            return f"{self.verdict.replace('-', ' ').upper()}{where} {basis}; {self._reached()}"
        if self.partial:
            return f"PARTLY COMPARED{where.rstrip(',')}: {self._outputs()}, {self._reached()}; no difference found {basis}"
        return f"NO DIFFERENCE FOUND{where} in everything compared: {self._outputs()}, {self._reached()}; {basis}"

    def _stood_in(self) -> list[str]:
        """The libraries that were replaced by stand-ins, in words."""
        names = ", ".join(f"'{name}'" for name in self.stand_ins)
        told = [f"simulated with stand-ins for missing libraries: {names}"] if names else []
        stubs = ", ".join(self.stubbed)
        return [*told, f"unknown, so stubbed on both sides and not compared: {stubs}"] if stubs else told

    def _reached(self) -> str:
        """The coverage of the source, in words."""
        if not self.counted:
            return "no source line counts as reached, since no test case was decided"
        return f"source lines {self.lines_pct:.1f} %, branches {self.branches_pct:.1f} %"

    def _missed(self, whole: bool = False) -> list[str]:
        """What of the source was not reached, in words: nothing of it was compared."""
        if self.verdict == NO_DIFFERENCE and (idle := [name for name, compared in self.outputs.items() if not compared]):
            outputs = [f"outputs not compared: {', '.join(idle)}"]
        else:
            outputs = []
        told = {
            "lines not reached": self.missed_lines,
            "branches not taken": self.untaken,
            "branches not compared, since the original is not repeatable there": self.racy_branches,
        }
        missed = [f"{what}: {format_ranges(places, whole)}" for what, places in told.items() if places and self.counted]
        dead = [f"not reachable from main, not counted: {', '.join(self.unreachable)}"] if self.unreachable else []
        return [*outputs, *missed, *dead]

    def all_reasons(self) -> list[str]:
        """The reasons, without duplicates, why scenarios could not be decided."""
        return list(dict.fromkeys([*self.reasons, *(s.reason for s in self.scenarios if s.reason)]))

    def lines(self, verbose: bool = False) -> list[str]:
        """The lines of the report for the user.

        Args:
            verbose: whether to tell all places of the source that were not reached, however many there are.
        """
        if self.verdict == NOT_COMPILED:
            return ["NOT COMPILED: the migrated program does not compile"]
        lines = [self._headline(), f"  {self.engine}; {self.compiler}; {self.original}"]
        lines += [f"  {told}" for told in (*self._judged(), *self._missed(verbose), *self._stood_in())]
        if (first := self.first_difference) is not None:
            scenario, difference = first
            lines.append(f"  first difference: '{scenario.scenario.name}' at {difference.at_ms:.1f} ms, {difference.channel}:")
            lines.append(f"    {difference.message}")
            if (cause := self._likely_cause(difference)) is not None:
                lines.append(f"    likely cause: {cause}")
            functions = self.functions.get(difference.channel, ())
            if self.calls.made is not None:
                lines.append(f"    call in the original: {self.calls.made}")
            elif functions:
                lines.append(f"    functions that drive it: {', '.join(functions)}")
            if self.calls.around:
                lines.append(f"    calls around it: {', '.join(str(call) for call in self.calls.around)}")
            if self.calls.made is not None or functions:
                lines.append("    (any of these may be the cause; the trace does not show which)")
            lines += [f"    {name}: {value}" for name, value in inputs_until(scenario.scenario, difference.at_ms).items()]
        lines += [f"  {reason}" for reason in self.all_reasons()]
        if self.racy:
            many, them = (f"{self.racy} test cases", "them") if self.racy != 1 else ("1 test case", "it")
            lines.append(f"  {many} discarded: the original is not repeatable in {them}")
        if self.search is not None and self.search.cut:
            lines.append(
                f"  the search for test cases was ended by its budget of {self.search.budget_s:g} s, "
                f"with {self.search.tried} tried: a larger one may find more (--budget SECONDS)"
            )
        lines += ["", "channels:"]
        lines += [
            f"  {c['status']:14} {c['name']}{_counted(c['events'], c['status'])}{_ended(c['until_ms'])}" for c in self.channels()
        ]
        because = {name: f" ({why})" for name, why in self.why_not_compared.items()}
        lines += [f"  not compared   {name}{because.get(name, '')}" for name in self.not_compared]
        lines += ["", "pin assignment used here - please check:"]
        for each in self.binding:
            device = f", simulated as {each['device']}" if each["device"] else ""
            where = each["target"] or ("the console (no pin)" if each.get("console") else "not connected")
            lines.append(f"  {each['port']}: {each['source']} -> {where} {each['component'] or ''}".rstrip() + device)
        return lines


def judge_lines(judge: Judge, not_compiled: str) -> list[str]:
    """What a result is worth, in words; nothing for one at the pins.

    Args:
        judge: where it was judged.
        not_compiled: see `Verdict`.
    """
    if not judge.said:
        return []
    own = [f"not compiled for the board: {not_compiled}"] if not_compiled else []
    return [f"{judge.said}, not on a simulated board: not seen are {', '.join(judge.not_seen)}", *own]


def _counted(events: int, status: str) -> str:
    """How many events were compared: where there were none, a channel that is the same says little."""
    return f" ({quantity(events, 'event')})" if events or status == SAME else ""


def _ended(until_ms: float | None) -> str:
    return f", compared until {until_ms:.1f} ms" if until_ms is not None else ""


def _rounded(at_ms: float | None) -> float | None:
    return None if at_ms is None else round(at_ms, 3)


def _worst(channels: Sequence[ChannelComparison]) -> str:
    status = [channel.status for channel in channels]
    return next((s for s in (DIFFERENT, RACY, SAME) if s in status), NOT_EXERCISED)


def inputs_until(scenario: Scenario, at_ms: float) -> dict[str, str]:
    """The values of the inputs up to a time: input -> its points."""
    told = {}
    for name, settings in scenario.signals.items():
        for setting, points in settings.items():
            past = [f"{value} at {at:g} ms" for at, value in points if at <= at_ms]
            if past:
                told[name if setting == "points" else f"{name} {setting}"] = ", ".join(past[-6:])
    return told
