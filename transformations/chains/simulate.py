"""The chain `simulate`: compiles a generated program, runs it alone on a simulator, and reports what it does at its pins.

With the models beside the program its components are connected to its pins, and a scenario sets their values; without models a
scenario names pins. Nothing is written except a requested trace.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any

from msgspec import Struct

from robosmi.base.progress_events import announce
from robosmi.diagnostics import Finding, Severity
from robosmi.errors import SourceError, UsageError, VerificationError
from robosmi.files.files import write_atomic
from robosmi.metamodels import platform
from robosmi.transformations.chains.stages.models import stored_models
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.api_build import compile_to_run
from robosmi.transformations.verification.bound_devices.played_devices import devices_at, played
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort, bound_ports
from robosmi.transformations.verification.jobs import job
from robosmi.verify.scenario import Scenario, read_scenario
from robosmi.verify.simulation import PinTrace, simulate as run_job
from robosmi.verify.toolchains.compile_report import CompileReport
from robosmi.verify.toolchains.libraries import STAND_IN
from robosmi.verify.toolchains.temporary import temporary_folder
from robosmi.verify.traces.activity import activity
from robosmi.verify.traces.vcd import vcd_text
from robosmi.verify.traces.verdict import AT_THE_PINS, Judge, judge_lines

CRASHED = "RS854"
"""The rule for a program that crashed."""
SECONDS = 5.0
"""Default simulated time in seconds."""
MOST_EVENTS = 10_000
"""Limit on the reported events; the VCD has all of them."""


class Simulated(Struct):
    """What a program did on a simulator.

    Attributes:
        compiled: how it was compiled.
        trace: what it did; None where it does not compile.
        ports: its ports, where its models are known.
        written: the VCD file, or None.
        judged_at, not_compiled: see `Verdict`.
    """

    compiled: CompileReport
    trace: PinTrace | None = None
    ports: list[BoundPort] = []
    written: Path | None = None
    judged_at: Judge = AT_THE_PINS
    not_compiled: str = ""

    @property
    def findings(self) -> list[Finding]:
        """What the compiler found, but for mere information, and that the program crashed."""
        found = [f for f in self.compiled.diagnostics if f.severity is not Severity.info]
        if self.trace is not None and self.trace.state == "crashed":
            found.append(
                Finding(
                    CRASHED, Severity.error, f"the program crashed on the simulator at {self.trace.simulated_us / 1000:.1f} ms",
                    fix="look for calls through invalid pointers, writes outside arrays, and too little RAM",
                )
            )  # fmt: skip
        return found

    @property
    def result(self) -> dict[str, Any]:
        """The contract's part of the document."""
        trace = self.trace
        if trace is None:
            nothing: dict[str, Any] = {"engine": None, "simulated_s": 0.0, "console": "", "events": [], "events_total": 0}
            return {**nothing, "released": [], "device_events": []}
        events = _events(trace)
        return {
            "engine": trace.engine,
            "judged_at": self.judged_at.name,
            "not_seen": list(self.judged_at.not_seen),
            "state": trace.state,
            "simulated_s": round(trace.simulated_us / 1e6, 6),
            "console": trace.text,
            "events": events[:MOST_EVENTS],
            "events_total": len(events),
            "released": _released(trace)[:MOST_EVENTS],
            "device_events": [
                {"t_us": round(e.at_us, 3), "device": e.device, "what": e.what, "value": e.value}
                for e in trace.device_events[:MOST_EVENTS]
            ],
        }

    def lines(self) -> list[str]:
        """The text for the user: the console, and each pin with its number of changes."""
        trace = self.trace
        if trace is None:
            return [f"{'is too big' if self.compiled.ok else 'does not compile'} for {self.compiled.board}"]
        lines = [f"{trace.simulated_us / 1e6:g} s on {trace.engine} ({self.compiled.board})"]
        names = [f"'{each.name}'" for each in self.compiled.libraries if each.source == STAND_IN]
        lines += [f"  {said}" for said in judge_lines(self.judged_at, self.not_compiled)]
        if self.compiled.stand_in_core:
            lines.append(f"  with a stand-in for the missing core {self.compiled.stand_in_core}")
        elif names:
            lines.append(f"  with stand-ins for missing libraries: {', '.join(names)}")
        if trace.state != "running":
            lines.append("  the program ended" if trace.state == "done" else "  the program crashed")
        if trace.text:
            lines += ["", "console:", *(f"  {_shown(line)}" for line in trace.text.splitlines())]
        titles = {port.target: port.title for port in self.ports if port.target}
        changes = Counter(e["pin"] for e in _events(trace))
        if changes:
            lines += ["", "pins:"]
        for pin, count in changes.items():
            many = f"{count:6} event{'s' * (count != 1)}, at the end {activity(trace, pin)[-1]}"
            lines.append(f"  {pin:4} {many}{f'  ({titles[pin]})' if pin in titles else ''}")
        told = _told_by_devices(trace, self.ports)
        lines += ["", "devices:", *told] if told else []
        if not trace.text and not changes:
            lines.append("  no output and no driven pin")
        return lines


def _shown(line: str) -> str:
    """A line with control characters replaced by escapes."""
    return "".join(each if each.isprintable() else each.encode("unicode_escape").decode("ascii") for each in line)


def _told_by_devices(trace: PinTrace, ports: list[BoundPort]) -> list[str]:
    """A line for each kind of device note: the last one, and the count."""
    devices = devices_at(ports, target=True)
    last = {(event.device, event.what): event for event in trace.device_events}
    many = Counter((event.device, event.what) for event in trace.device_events)
    lines = []
    for (number, what), event in last.items():
        title = ports[devices[number].ports[0]].title if number < len(devices) else f"device {number}"
        lines.append(f"  {title}: {many[number, what]} x {what}, last {event.value} at {event.at_us / 1000:.1f} ms")
    return lines


def _events(trace: PinTrace) -> list[dict[str, Any]]:
    """The levels that the program drives and the timers' waves, in order of time."""
    found: list[tuple[float, dict[str, Any]]] = [
        (c.at_us, {"t_us": round(c.at_us, 3), "pin": c.pin, "level": c.level}) for c in trace.changes if c.level in (0, 1)
    ]
    found += [
        (w.at_us, {"t_us": round(w.at_us, 3), "pin": w.pin, "pwm": {"hz": round(w.hz, 6), "duty": round(w.duty, 6)}})
        for w in trace.waves
    ]
    return [event for _, event in sorted(found, key=lambda each: each[0])]


def _released(trace: PinTrace) -> list[dict[str, Any]]:
    """Where the program stops driving a pin or changes its pull-up then, in order of time; for pins that it drove before."""
    driven: set[str] = set()
    found = []
    for change in trace.changes:
        if change.level in (0, 1):
            driven.add(change.pin)
        elif change.pin in driven:
            found.append({"t_us": round(change.at_us, 3), "pin": change.pin, "pull_up": change.level == "p"})
    return found


def simulate(
    output: Path,
    *,
    scenario: Path | None = None,
    seconds: float | None = None,
    engine: str | None = None,
    vcd: Path | None = None,
) -> Simulated:
    """Run a generated program alone.

    Args:
        output: the output folder of a migration, or the program's own folder.
        scenario: file with what its components show over time.
        seconds: simulated seconds; the scenario's, else five, if None.
        engine: name of the simulator.
        vcd: file for the trace.

    Raises:
        SourceError: there is no program, or a file cannot be read or written.
        UsageError: the scenario names what is not there, or no simulator knows the board.
        MissingToolError: compiler or simulator are not installed.
        VerificationError: the simulator crashed or did not end.
    """
    asked = read_scenario(scenario) if scenario is not None else None
    if seconds is not None and not 0 < seconds <= 600:
        raise UsageError(f"{seconds:g} s cannot be simulated", fix="give more than 0 s and at most 600 s")
    horizon_us = 1e6 * seconds if seconds is not None else 1e3 * asked.horizon_ms if asked is not None else 1e6 * SECONDS
    plan_file = adjacent_plan(output)
    models = stored_models(plan_file.parent.parent) if plan_file is not None else None
    ports = bound_ports(models.plan, plan_file.parent) if models is not None and plan_file is not None else []
    with temporary_folder("simulate") as folder:
        made_for = compile_to_run(output, Path(folder))
        report = made_for.report
        if made_for.lacking:
            raise VerificationError(made_for.lacking, fix="test it on the board: nothing is known of it here")
        if not report.ok or report.elf is None:
            return Simulated(report)
        stored = models.plan.board if models is not None else None
        board = stored if stored is not None and stored.name == report.board else load_board(report.board)
        devices = played(ports if models is not None else _bare(board, asked), asked, target=True)
        announce(f"simulate {horizon_us / 1e6:g} s")
        trace = run_job(job(report.elf, report.hex, board, horizon_us, devices), engine)
    if vcd is not None:
        try:
            write_atomic(vcd, vcd_text({str(board.name): trace}, f"{output} on {trace.engine}").encode())
        except OSError as error:
            raise SourceError(f"the trace cannot be written: {error.strerror or error}", fix="give another file") from error
    return Simulated(report, trace, ports, vcd, made_for.judge, made_for.not_compiled)


def adjacent_plan(output: Path) -> Path | None:
    """The stored plan of a program, given its output folder or the program's own folder."""
    for folder in (output, output.parent, output.parent.parent):
        if (path := folder / "models" / "plan.xmi").is_file():
            return path
    return None


def _bare(board: platform.Board, scenario: Scenario | None) -> list[BoundPort]:
    """Devices for the pins that a scenario names: a voltage source where the values are more than levels."""
    found = []
    labels = {str(pin.label): pin for pin in board.pins}
    for name, settings in (scenario.signals if scenario is not None else {}).items():
        if name in labels:
            values = {value for points in settings.values() for _, value in points}
            kind = "levels" if values <= {0, 1, None} else "voltages"
            found.append(BoundPort(name, name, name, device=kind, pin="pin"))
    return found
