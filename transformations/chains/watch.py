"""The chain `watch`: the migrated program on a simulator and the original on its host model, side by side, as JSON for a page.

A run is a scenario: the inputs that the user has moved so far, each with its instant. A run with a further input starts again
at reset, so that both sides see the same inputs at the same simulated time and their clocks cannot drift apart; what was shown
before the input stays as it was, since both runs repeat. Both programs are built once, and again when a file of the sketch has
changed. The comparison is that of `verify`.
"""

from __future__ import annotations

import re
import time
from collections.abc import Iterable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from threading import Lock
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.data_text import Json
from robosmi.diagnostics import Location
from robosmi.errors import RobosmiError, SourceError, StoppedError, UsageError, VerificationError
from robosmi.files.files import refuse_link, write_atomic
from robosmi.files.recovery import at_work
from robosmi.metamodels import migration, platform
from robosmi.transformations.chains.stages.models import FOLDER, stored_models
from robosmi.transformations.chains.verify import (
    FOLDER as SCENARIOS,
    board_of,
    sketch_files,
    sketch_texts,
    source_mv,
    stored_original,
    stored_scenarios,
    stored_sources,
)
from robosmi.transformations.queries.circuits.component_kinds import known_roles
from robosmi.transformations.queries.plans.motors import SERVO
from robosmi.transformations.queries.plans.plan_adapters import port_calls
from robosmi.transformations.verification.bound_devices.played_devices import CONSOLE, TYPING, devices_at, signals_of
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort, at_rest, bound_ports, resting_pins
from robosmi.transformations.verification.bound_devices.simulated_kinds import device_facts
from robosmi.transformations.verification.judgement.scenario_verdicts import compare_scenarios
from robosmi.transformations.verification.judgement.stored_verdict import sketch_digests
from robosmi.transformations.verification.original_side import channel_events, run_source, run_varied
from robosmi.transformations.verification.originals import stubs_of
from robosmi.transformations.verification.target_side import EMPTY_TRACE, LIMIT_S, TargetSide
from robosmi.verify.original import Original
from robosmi.verify.scenario import POINTS, Points, Scenario, read_scenario
from robosmi.verify.simulation import ConsoleByte, PinTrace
from robosmi.verify.toolchains.temporary import temporary_folder
from robosmi.verify.toolchains.toolchain import compile_sketch
from robosmi.verify.traces.activity import BURST, IDLE, LEVEL, PULSES, WAVE, ActivityEvent

LONGEST_MS = 60_000.0
"""The longest run that is watched: each further input simulates all of it again."""
SHORTEST_MS = 100.0
_MOST_POINTS, _MOST_INPUTS, _LONGEST_NAME = 500, 100, 60
MOST_EVENTS = 4_000
"""Events of a channel that are sent to a page; a channel with more of them says so."""
_ENDS = ("done", "crashed")
"""States of a trace whose program does not run on."""
_FEED, _RETURN = b"\n\r"
_NAME = re.compile(r"[\w][\w .-]*")


class Programs(Struct):
    """Both programs, ready to run.

    Attributes:
        side: the migrated program on its board.
        ports: the ports of both.
        original: the original; None where it cannot run here.
        why: the reason why it cannot.
        one_thread: whether a single thread of the original does all that is observed.
        at_rest: the pins that the migrated program holds so that the component there does nothing, with their levels.
        wheels: name of each port that turns a wheel -> 1, or -1 for a servo that is mounted the other way round.
    """

    side: TargetSide
    ports: list[BoundPort]
    original: Original | None
    why: str
    one_thread: bool
    at_rest: Mapping[str, int]
    wheels: Mapping[str, int]


class WatchedFolder:
    """The two programs of an output folder, as a page asks for them; runs are done one after the other.

    Args:
        output: the output folder of a migration.
        engine: name of the simulator; the first that is installed if None.
    """

    def __init__(self, output: Path, engine: str | None = None) -> None:
        self.output, self.engine = output, engine
        self._turn, self._held = Lock(), ExitStack()
        self._programs: Programs | None = None
        self._digests: Mapping[str, str] = {}
        self._latest: dict[str, int] = {}

    def close(self) -> None:
        """Remove the files of both programs."""
        self._held.close()
        self._programs = None

    def answer(self, about: Mapping[str, Json]) -> dict[str, Any]:
        """What a page asks for: a run, or to store one as a test case.

        Args:
            about: `list`, if only the names of the stored test cases are asked for; `scenario`, the name of a stored test case,
                or empty; `ms`, how long the run is; `inputs`, a list of `title`, `setting` and `points`; `compare`, whether to
                find the first difference; `save`, the name of the test case to store, if it is to be stored; `tab` and `number`,
                the page and how many runs it has asked for: of those that wait, only the last is done.

        Returns:
            `state` (done, refused or superseded) with a `message`, and of a run what `_shown` says.
        """
        try:
            return self._answer(about)
        except RobosmiError as error:
            place = f" (in {error.location})" if error.location is not None else ""
            advice = f" What to do: {error.fix}." if error.fix else ""
            return {"state": "refused", "message": f"Not done: {error.message}{place}.{advice}"}

    def _answer(self, about: Mapping[str, Json]) -> dict[str, Any]:
        if about.get("list") is True:
            return {"state": "done", "cases": self.cases()}
        tab, number = str(about.get("tab", ""))[:_LONGEST_NAME], about.get("number")
        if isinstance(number, int):
            self._latest[tab] = max(number, self._latest.get(tab, number))
        with self._turn:
            if isinstance(number, int) and number < self._latest[tab]:
                return {"state": "superseded", "message": "Another input was moved meanwhile."}
            scenario = self._scenario(about)
            if name := str(about.get("save", "")):
                path = self._store(scenario, name)
                return {"state": "done", "message": f"Saved {path}. verify uses it, too.", "cases": self.cases()}
            return {"state": "done", **self._run(scenario, compare=about.get("compare") is True)}

    def cases(self) -> list[str]:
        """The names of the stored test cases."""
        return [path.stem for path in stored_scenarios(self.output)]

    # ---- what is asked

    def _scenario(self, about: Mapping[str, Json]) -> Scenario:
        """The asked scenario: a stored one, with the inputs of the page in its place if there are any.

        Raises:
            UsageError: it has a value that means nothing.
            SourceError: there is no such test case.
        """
        name, inputs, ms = str(about.get("scenario", "")), about.get("inputs", []), about.get("ms")
        stored: Scenario | None = None
        if name:
            if name not in self.cases():
                raise SourceError(f"no test case is called '{name[:_LONGEST_NAME]}'", fix="load the page again")
            path = self.output / FOLDER / SCENARIOS / f"{name}.toml"
            refuse_link(path)
            stored = read_scenario(path, "stored")
        if ms is None and stored is not None:
            ms = stored.horizon_ms
        if isinstance(ms, bool) or not isinstance(ms, (int, float)) or not SHORTEST_MS <= ms <= LONGEST_MS:
            raise UsageError(f"a run of {ms} ms cannot be watched", fix=f"ask for {SHORTEST_MS:g} to {LONGEST_MS:g} ms")
        if not isinstance(inputs, list) or len(inputs) > _MOST_INPUTS:
            raise _malformed()
        signals: dict[str, dict[str, Points]] = {}
        for each in inputs:
            if not isinstance(each, dict):
                raise _malformed()
            title, setting = str(each.get("title", "")), str(each.get("setting", POINTS))
            signals.setdefault(title, {})[setting] = _points(each.get("points"), float(ms))
        known = stored.signals if stored is not None and not signals else signals
        return Scenario(name or "watched", float(ms), known, "stored" if stored is not None else "given")

    def _store(self, scenario: Scenario, name: str) -> Path:
        """Store a scenario as a test case beside the models.

        Raises:
            UsageError: its name is none, or its signals are of nothing.
            StoppedError: there is one of that name.
        """
        if not _NAME.fullmatch(name) or len(name) > _LONGEST_NAME or name.endswith((".", " ")):
            raise UsageError("this is no name for a test case", fix=f"use up to {_LONGEST_NAME} letters, digits, '-' and '_'")
        models = stored_models(self.output)
        signals_of(bound_ports(models.plan, self.output / FOLDER), scenario)
        folder = self.output / FOLDER / SCENARIOS
        path = folder / f"{name.replace(' ', '_')}.toml"
        with at_work(self.output):
            refuse_link(folder)
            if path.exists() or path.is_symlink():
                raise StoppedError("a test case has this name", location=Location(str(path)), fix="give another name")
            folder.mkdir(exist_ok=True)
            write_atomic(path, Scenario(name, scenario.horizon_ms, scenario.signals).text().encode())
        return path

    # ---- what is run

    def _run(self, scenario: Scenario, *, compare: bool) -> dict[str, Any]:
        """Run both programs; with `compare` as often as a verdict takes, else once each."""
        start = time.monotonic()
        programs = self._built()
        signals_of(programs.ports, scenario)
        built = time.monotonic()
        if compare and programs.original is not None:
            ran = _compared(programs, programs.original, scenario)
        else:
            ran = _ran(programs, scenario)
        return {
            **ran, "ms": scenario.horizon_ms, "scenario": scenario.name if scenario.origin == "stored" else "",
            "inputs": _inputs(programs.ports, scenario), "cases": self.cases(), "engine": programs.side.engine,
            "title": programs.original.title if programs.original is not None else "", "why": programs.why,
            "seconds": round(time.monotonic() - built, 3), "build_seconds": round(built - start, 3),
        }  # fmt: skip

    def _built(self) -> Programs:
        """Both programs as they are now.

        Raises:
            SourceError, MissingToolError, VerificationError: the migrated program cannot be compiled or simulated here.
        """
        digests = sketch_digests(self.output)
        if self._programs is not None and digests == self._digests:
            return self._programs
        self.close()
        models = stored_models(self.output)
        plan = models.plan
        ports = bound_ports(plan, self.output / FOLDER)
        folder = Path(self._held.enter_context(temporary_folder("watch")))
        for name in ("target", "source"):
            (folder / name).mkdir()
        report = compile_sketch(self.output, keep=folder / "target")
        if not report.ok or report.elf is None:
            why = "does not compile" if not report.ok else f"is too big for {report.board}"
            raise VerificationError(f"the sketch {why}", fix="see: robosmi compile")
        side = TargetSide(board_of(models, report), report, ports, self.engine, source_mv=source_mv(plan))
        original, why = None, ""
        try:
            stubs = stubs_of(plan, stored_sources(models), sketch_texts(sketch_files(self.output)))
            original = stored_original(models, folder / "source", stubs=stubs)
        except RobosmiError as error:
            advice = f" ({error.fix})" if error.fix else ""
            why = f"The original cannot run here: {error.message}{advice}"
        self._programs = Programs(side, ports, original, why, plan.concurrency is None, resting_pins(plan), _wheels(plan))
        self._digests = digests
        return self._programs


def _ran(programs: Programs, scenario: Scenario) -> dict[str, Any]:
    """Run each program once.

    Raises:
        VerificationError: the simulator crashed or did not end.
    """
    outcome = next(programs.side.run([scenario]))
    if isinstance(outcome, VerificationError):
        raise outcome
    traces = {"migrated": outcome}
    sides = {"migrated": _first_sight(channel_events(outcome, programs.ports, target=True))}
    if programs.original is not None:
        own = run_source(programs.original, programs.ports, scenario, LIMIT_S).trace
        traces = {"original": own, **traces}
        sides = {"original": _first_sight(channel_events(own, programs.ports, target=False)), **sides}
    return {**_shown(programs, sides, traces), "compared": False}


def _compared(programs: Programs, original: Original, scenario: Scenario) -> dict[str, Any]:
    """Run the original as often as a verdict takes, and the migrated program once, and compare them as `verify` does.

    Raises:
        VerificationError: the simulator crashed or did not end.
    """
    nominal = run_source(original, programs.ports, scenario, LIMIT_S)
    runs = run_varied(original, programs.ports, scenario, nominal, LIMIT_S)
    found = compare_scenarios(
        original, programs.ports, [(scenario, runs)], programs.side, programs.one_thread, programs.at_rest, whole=True
    )
    if found.undecided:
        raise found.undecided[0]
    (case,) = found.kept
    sides = {"original": _first_sight({name: seen[0] for name, seen in runs.channels.items()}), "migrated": case.target}
    first = case.told.first
    return {
        **_shown(programs, sides, {"original": nominal.trace, "migrated": case.trace or EMPTY_TRACE}),
        "compared": True, "verdict": case.told.verdict, "reason": case.told.reason,
        "difference": {"ms": first.at_ms, "channel": first.channel, "message": first.message} if first is not None else None,
    }  # fmt: skip


def _first_sight(channels: Mapping[str, Sequence[Sequence[ActivityEvent]]]) -> dict[str, list[ActivityEvent]]:
    """Channel -> its events at the first resolution."""
    return {name: list(events[0]) for name, events in channels.items()}


def _wheels(plan: migration.MigrationPlan) -> dict[str, int]:
    """The ports that turn a wheel: those of a drive, and those at which functions set a speed."""
    turning = {
        str(use.name)
        for use in plan.adapterUses
        if use.function is not None and any(p.meaning is platform.Meaning.speed for p in use.function.parameters)
    }
    return {
        str(b.name): -1 if b.mirrored else 1
        for b in plan.portBindings
        if b.role == SERVO
        and (b.conventionalPort is not None or any(str(call.calleeName) in turning for call in port_calls(plan, b)))
    }


def _malformed() -> UsageError:
    return UsageError("the request is malformed", fix="load the page again")


def _points(given: Json, horizon_ms: float) -> Points:
    """The points of a signal from a page, in order of time and before the end of the run."""
    points: list[tuple[float, Any]] = []
    for point in given if isinstance(given, list) and len(given) <= _MOST_POINTS else ():
        at = point[0] if isinstance(point, list) and len(point) == 2 else None
        if isinstance(at, bool) or not isinstance(at, (int, float)) or at < (points[-1][0] if points else 0):
            raise _malformed()
        if at <= horizon_ms:
            points.append((float(at), point[1]))
    if not points:
        raise _malformed()
    return tuple(points)


# ---- what is shown


def _shown(
    programs: Programs, sides: Mapping[str, Mapping[str, Sequence[ActivityEvent]]], traces: Mapping[str, PinTrace]
) -> dict[str, Any]:
    """`channels` with the events of both sides, and `console` with the printed bytes of both as pieces of text.

    `ended` has each side that does not run to the end of the scenario: whether it is done or crashed, and when in ms.

    A channel has `title`, `component`, `port`, `pins` and for each side a list of [ms, state, text, kind of event]; `turns` says
    that it is a wheel, `sounds` that a wave there may be heard (a dimmed LED is silent), `cut` that there are more events.
    """
    by_title = {port.title: port for port in programs.ports}
    names = dict.fromkeys(name for side in sides.values() for name in side)
    channels = []
    for name in names:
        port = by_title.get(name)
        seen = {side: [event for event in events.get(name, ()) if event != IDLE] for side, events in sides.items()}
        if port is None:
            continue
        wheel = programs.wheels.get(port.name, 0)
        rows = {
            side: [[round(e.at_us / 1000, 3), state_of(e, wheel), text_of(e), e.kind] for e in events[:MOST_EVENTS]]
            for side, events in seen.items()
        }
        channels.append(
            {
                "title": name, "component": port.component or port.name, "port": port.name,
                "pins": {"original": port.source, "migrated": port.target}, "sides": rows, "turns": bool(wheel),
                "sounds": not port.kinds or not port.kinds.isdisjoint(known_roles().audible),
                "cut": any(len(events) > MOST_EVENTS for events in seen.values()),
            }
        )  # fmt: skip
    console = {side: printed(trace.console) for side, trace in traces.items()}
    ended = {side: [trace.state, round(trace.simulated_us / 1000, 1)] for side, trace in traces.items() if trace.state in _ENDS}
    return {"channels": channels, "console": console, "ended": ended}


_FULL_US, _REST_US = 200.0, 1500.0
"""A continuous servo stands still at pulses of the second width; this much more or less is its full speed."""
_US_PER_DEGREE = 10.0
"""By how much the pulse of a positional servo changes for each degree; it is in the middle, at 90, with `_REST_US`."""


def state_of(event: ActivityEvent, wheel: int = 0) -> str:
    """What a part shows during an event: on, off, degrees of a servo, a speed from -100 to 100, a frequency in Hz.

    Args:
        event: the event.
        wheel: 1 for a wheel, -1 for one whose servo is mounted the other way round, 0 for any other part.
    """
    value = event.value[0]
    if event.kind == LEVEL:
        return "on" if value == 1 else "off"
    if event.kind == PULSES:
        width = float(value) - _REST_US
        if wheel:
            return f"{wheel * max(-100.0, min(100.0, 100 * width / _FULL_US)) + 0.0:.0f}"
        return f"{max(0.0, min(180.0, 90 + width / _US_PER_DEGREE)):.0f}"
    if event.kind == WAVE and value:
        return f"{float(value):.6g}"
    return "on" if event.kind in (WAVE, BURST) else str(event)


def text_of(event: ActivityEvent) -> str:
    """An event in words, with three significant digits of a frequency, which are more than one hears or sees."""
    frequency, *others = event.value
    if event.kind == WAVE and frequency:
        event = replace(event, value=(float(f"{float(frequency):.3g}"), *others))
    return str(event)


def printed(console: Iterable[ConsoleByte]) -> list[list[Json]]:
    """What was printed, as pieces [ms, text] that begin with a line each; what is no UTF-8 is shown as U+FFFD.

    A line ends with a line feed, a carriage return or both: serial monitors of the source platforms take each for an end.
    """
    pieces: list[tuple[float, bytearray]] = []
    for at_us, byte in console:
        last = pieces[-1][1][-1] if pieces else _FEED
        if last == _FEED or (last == _RETURN and byte != _FEED):
            pieces.append((at_us, bytearray()))
        pieces[-1][1].append(byte)
    texts = [(at_us, bytes(text).decode("utf-8", "replace")) for at_us, text in pieces[:MOST_EVENTS]]
    return [[round(at_us / 1000, 3), text.replace("\r\n", "\n").replace("\r", "\n")] for at_us, text in texts]


_CONTROLS = {"level": "button", "number": "range", "whole number": "range", "text": "text"}
"""Kind of a value that a device takes -> the control that sets it."""


def _inputs(ports: Sequence[BoundPort], scenario: Scenario) -> list[dict[str, Json]]:
    """The inputs that the user can move: each with its control, its limits, its value at rest, and its points so far."""
    found: list[dict[str, Json]] = []
    for device in devices_at(ports, target=True):
        port = ports[device.ports[0]]
        facts = device_facts().get(port.device, {})
        kinds = frozenset().union(*(ports[n].kinds for n in device.ports))
        rest = at_rest(port.device, kinds)
        for setting, takes in facts.get("takes", {}).items():
            control = next((_CONTROLS[kind] for kind in takes if kind in _CONTROLS), None)
            if control is None:
                continue
            least, most = facts.get("limits", {}).get(setting, (0, 1))
            ends = facts.get("ends", {}).get(setting, (least, most))
            name = port.component or port.name
            own = sum((ports[d.ports[0]].component or "") == port.component for d in devices_at(ports, target=True)) == 1
            title = name if own else port.name
            found.append({
                "title": title, "setting": setting, "control": control, "least": ends[0], "most": ends[1],
                "unit": facts.get("units", {}).get(setting, ""),
                "rest": rest.get(setting), "points": [list(p) for p in scenario.signals.get(title, {}).get(setting, ())],
            })  # fmt: skip
    typed = scenario.signals.get(CONSOLE, {}).get(POINTS, ())
    facts = device_facts().get(TYPING, {})
    if facts:
        found.append({
            "title": CONSOLE, "setting": POINTS, "control": "text", "least": 0, "most": 0, "unit": "", "rest": "",
            "points": [list(point) for point in typed],
        })  # fmt: skip
    return found
