"""What one scenario says: texts of cores that print together, and why an original did not run to its end."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.judgement.evidence import compared_outputs
from robosmi.transformations.verification.judgement.verdict import verdict_of, why_nothing_was_compared
from robosmi.transformations.verification.original_side import DRIVEN, SourceRuns, channel_events
from robosmi.transformations.verification.pause_comparison import PAUSES
from robosmi.verify.original import OriginalRun
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import ConsoleByte, PinChange, PinTrace
from robosmi.verify.traces.comparison import ChannelComparison
from robosmi.verify.traces.verdict import ScenarioVerdict, Verdict

SCENARIO = Scenario("s", 1000.0)


def printed(*lines: tuple[float, str]) -> PinTrace:
    """A run that prints these lines, one character per millisecond, each from its start time on."""
    letters = [
        ConsoleByte(1000 * (at_ms + number), ord(letter)) for at_ms, text in lines for number, letter in enumerate(text + "\n")
    ]
    return PinTrace("e", "running", 1e6, (), (), tuple(sorted(letters)), ())


def original(trace: PinTrace, mixed_us: tuple[float, ...] = (), status: str = "running", cause: str = "") -> SourceRuns:
    """The original's runs: the nominal one, and one that does the same."""
    run = OriginalRun(trace, status, cause, b"", mixed_text_us=mixed_us)
    events = channel_events(trace, [], target=False)
    return SourceRuns(run, (run,), {name: [[events[name][0]] * 2] for name in events})


@pytest.mark.parametrize(
    ("target", "verdict", "status"),
    [
        (((100, "left"), (110, "right")), "no-difference-found", "same"),
        (((110, "left"), (100, "right")), "not-decidable", "racy"),
        (((104, "left"), (102, "right")), "not-decidable", "racy"),
        (((100, "left"), (110, "night")), "different", "different"),
        (((100, "left"),), "different", "different"),
        (((100, "left"), (110, "right"), (400, "left")), "different", "different"),
    ],
    ids=["same", "other order", "between one another", "another letter", "missing", "more, later"],
)
def test_which_of_two_cores_prints_first_is_luck(
    target: tuple[tuple[float, str], ...], verdict: str, status: str
) -> None:  # fmt: skip
    runs = original(printed((100, "left"), (110, "right")), (110_000.0,))
    told = verdict_of(SCENARIO, runs, printed(*target), [], one_thread=False)
    assert (told.verdict, told.channels[0].status) == (verdict, status)


def test_one_core_prints_in_its_order() -> None:
    told = verdict_of(
        SCENARIO, original(printed((100, "left"), (110, "right"))), printed((110, "left"), (100, "right")), [], one_thread=True
    )
    assert told.verdict == "different"


@pytest.mark.parametrize(
    ("target", "verdict"),
    [
        (((100, "tl 0"), (200, "n 5")), "not-decidable"),
        (((100, "tl 9"), (200, "n 5")), "different"),
        (((100, "tl 0"), (200, "n 7"), (300, "tl 9")), "different"),
    ],
    ids=["same", "before", "after"],
)
def test_a_difference_beside_what_wobbles_is_found_and_the_place_told(
    target: tuple[tuple[float, str], ...], verdict: str
) -> None:
    runs = original(printed((100, "tl 0"), (200, "n 5"), (300, "tl 16")))
    other = channel_events(printed((100, "tl 0"), (200, "n 6"), (300, "tl 16")), [], target=False)
    runs = replace(runs, channels={name: [[seen[0][0], other[name][0]]] for name, seen in runs.channels.items()})
    told = verdict_of(SCENARIO, runs, printed(*target), [], one_thread=True)
    assert told.verdict == verdict
    said = "the original is not repeatable in 's' (console: 'n 5' at 203.0 ms, or 'n 6' at 203.0 ms); "
    assert told.reason.startswith(said) == (verdict == "not-decidable")


@pytest.mark.parametrize(
    ("status", "cause", "said"),
    [
        ("unmodelled", "wav_play", "it calls a function without a host model: wav_play; check it on the bench"),
        ("time limit", "", "it exceeds the time limit"),
        ("output limit", "", "too often to record"),
        ("crashed", "divides by zero", "crashed: divides by zero"),
    ],
)
def test_why_an_original_did_not_run_to_its_end(status: str, cause: str, said: str) -> None:
    trace = printed((100, "left"))
    told = verdict_of(SCENARIO, original(trace, status=status, cause=cause), trace, [], one_thread=True)
    assert told.verdict == "not-decidable"
    assert said in told.reason


@pytest.mark.parametrize(("status", "varied"), [("running", " with slightly changed timing"), ("time limit", "")])
def test_where_a_run_was_given_up_nothing_is_compared(status: str, varied: str) -> None:
    runs = replace(original(printed((100, "left")), status=status), given_up="time limit")
    told = verdict_of(SCENARIO, runs, printed((100, "night")), [], one_thread=True)
    assert (told.verdict, told.channels) == ("not-decidable", ())
    assert told.reason.startswith(f"the original did not finish{varied} (it exceeds the time limit")


def test_only_an_open_port_is_advised_to_be_bound() -> None:
    ports = [BoundPort("P3", "P3", ""), BoundPort("P21", "P21", "", given_up=True)]
    said = why_nothing_was_compared(Verdict([]), ports)
    assert "--bind P3=PIN" in said
    assert "--bind P21" not in said
    assert "P21: not connected, by the plan" in said


def test_the_console_is_not_called_unconnected() -> None:
    port = BoundPort("P31", "P31", "", given_up=True, console=True)
    assert "P31: the console (no pin)" in (said := why_nothing_was_compared(Verdict([]), [port]))
    lines = "\n".join(Verdict([], binding=[port.to_json()]).lines())
    assert "P31: P31 -> the console (no pin)" in lines
    assert "not connected" not in said + lines


def test_a_sensor_that_the_program_asks_is_no_output() -> None:
    ports = [BoundPort("P8", "P8", "D7", device="ranger", pin="signal"), BoundPort("P26", "P26", "D13")]
    channels = (ChannelComparison("P26", "same", events=2), ChannelComparison(f"P8{PAUSES}", "same", events=1))
    verdict = Verdict([ScenarioVerdict(SCENARIO, "no-difference-found", channels, 1000.0)])
    assert compared_outputs(verdict, ports) == {"P26": True}


def test_an_input_that_the_program_also_drives_is_an_output() -> None:
    ports = [BoundPort("D5", "D5", "D5", device="levels", pin="pin"), BoundPort("D6", "D6", "D6", device="levels", pin="pin")]
    channels = (ChannelComparison(f"D5{DRIVEN}", "same", events=60), ChannelComparison(f"D6{DRIVEN}", "not-exercised"))
    verdict = Verdict([ScenarioVerdict(SCENARIO, "no-difference-found", channels, 1000.0)])
    assert compared_outputs(verdict, ports) == {"D5": True}


@pytest.mark.parametrize(
    ("racy", "said"), [(0, "in any test case (give one"), (1, "in 1 other the original"), (26, "in 26 others the original")]
)
def test_where_racy_scenarios_were_dropped_nobody_is_told_that_nothing_happens_in_any(racy: int, said: str) -> None:
    idle = ScenarioVerdict(SCENARIO, "no-difference-found", (ChannelComparison("P5", "not-exercised"),), 1000.0)
    reason = why_nothing_was_compared(Verdict([idle], racy=racy), [])
    assert said in reason
    assert ("in any test case" in reason) == (racy == 0)
    assert "--scenario FILE" in reason


def at_pins(**levels: tuple[tuple[float, int | str], ...]) -> PinTrace:
    """A run with changes at pins: milliseconds and levels."""
    changes = [PinChange(1000 * at_ms, pin, level) for pin, listed in levels.items() for at_ms, level in listed]
    return PinTrace("e", "running", 1e6, tuple(sorted(changes)), (), (), ())


def of_ports(trace: PinTrace, ports: list[BoundPort]) -> SourceRuns:
    """The original's runs with ports: the nominal one, and one that does the same."""
    run = OriginalRun(trace, "running", "", b"")
    return SourceRuns(run, (run,), {n: [[each] * 2 for each in seen] for n, seen in channel_events(trace, ports, False).items()})


@pytest.mark.parametrize(
    ("device", "line", "told"), [("levels", False, True), ("", False, True), ("", True, False), ("dht22", False, False)]
)
def test_a_pull_up_that_the_source_does_not_have_is_told(device: str, line: bool, told: bool) -> None:
    ports = [BoundPort("button", "P3", "D3", device=device, line=line, pin="data" if device == "dht22" else "")]
    source = at_pins(P3=((0, "z"),))
    for levels, seen in ((((0, "z"), (10, "p")), told), (((0, "z"), (10, "p"), (10.5, "z")), False)):
        result = verdict_of(SCENARIO, of_ports(source, ports), at_pins(D3=levels), ports, one_thread=True)
        said = [] if result.first is None else [result.first.message]
        assert any("pull-up of D3" in each for each in said) == seen


def test_a_wave_that_lacks_is_told_before_how_its_line_rests() -> None:
    ports = [BoundPort("horn", "P3", "D3")]
    blinks = tuple((at_ms, (at_ms // 100 + 1) % 2) for at_ms in range(200, 900, 100))
    source = at_pins(P3=blinks)
    target = at_pins(D3=((0.1, 0), (5, "z"), (700, "z")))
    first = verdict_of(SCENARIO, of_ports(source, ports), target, ports, one_thread=True).first
    assert first is not None
    assert (first.channel, first.at_ms) == ("horn", 200.0)


def test_what_a_program_does_beyond_the_end_is_not_looked_at() -> None:
    ports = [BoundPort("horn", "P3", "D3")]
    source = at_pins(P3=((0, "z"), (100, 0)))
    target = at_pins(D3=((0, "z"), (100, 0), (1500, "z"), (1600, 0), (1700, "z"), (1800, 1)))
    later = replace(target, simulated_us=2e6)
    assert later.until(1e6) == at_pins(D3=((0, "z"), (100, 0)))
    assert verdict_of(SCENARIO, of_ports(source, ports), later, ports, one_thread=True).first is None
