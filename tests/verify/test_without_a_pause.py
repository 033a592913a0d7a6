"""Programs that never wait: consoles that are always full, and tones without a gap, are the same after a migration."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi.transformations.chains.verify import verify
from robosmi.transformations.verification.original_side import is_always_full
from robosmi.verify.simulation import ConsoleByte, PinTrace
from robosmi.verify.traces.activity import LEVEL, WAVE, ActivityEvent
from robosmi.verify.traces.comparison import compare
from tests.tiers import one_of_each
from tests.tools import require_verification

PROGRAMS = Path(__file__).parent / "without_a_pause"


@pytest.mark.parametrize(
    ("program", "pins", "right", "wrong"),
    one_of_each(
        [
            ("spam", {"P3": "D9"}, "n++", "n += 2"),
            ("spam", {"P3": "D9"}, "1023", "2047"),
            ("tones", {"P4": "D7"}, "100, 262", "85, 262"),
        ],
        lambda case: case[0],
    ),
)
def test_what_migrate_makes_is_the_same_and_a_fault_in_it_is_seen(
    program: str, pins: dict[str, str], right: str, wrong: str, tmp_path: Path
) -> None:
    require_verification()
    robosmi.migrate([PROGRAMS / f"{program}.c"], tmp_path / "out", bind=pins)
    assert verify(tmp_path / "out", scenarios=[PROGRAMS / "run.toml"]).verdict.verdict == "no-difference-found"
    sketch = tmp_path / "out" / program / f"{program}.ino"
    assert right in sketch.read_text()
    sketch.write_text(sketch.read_text().replace(right, wrong))
    assert verify(tmp_path / "out", scenarios=[PROGRAMS / "run.toml"]).verdict.verdict == "different"


@pytest.mark.parametrize(("every_us", "pause_us", "full"), [(87.0, 0.0, True), (87.0, 900.0, False), (5000.0, 0.0, False)])
def test_a_console_is_full_if_its_line_never_rests(every_us: float, pause_us: float, full: bool) -> None:
    console = [ConsoleByte(at * every_us + at // 10 * pause_us, 65) for at in range(1000)]
    trace = PinTrace("", "running", console[-1].at_us, (), (), tuple(console), ())
    assert is_always_full(trace) is full


@pytest.mark.parametrize(("lasts_ms", "status"), [(50.0, "same"), (49.0, "same"), (48.0, "different"), (52.0, "different")])
def test_a_tone_next_to_another_one_may_lack_a_period(lasts_ms: float, status: str) -> None:
    def tones(ms: float) -> list[ActivityEvent]:
        ends = (100.0 + ms) * 1000
        first, second = ActivityEvent(1000.0, WAVE, (294.0, 0.5)), ActivityEvent(100_000.0, WAVE, (1000.0, 0.5))
        return [ActivityEvent(0.0, LEVEL, (0,)), first, second, ActivityEvent(ends, LEVEL, (0,))]

    assert compare("piezo", tones(50.0), tones(lasts_ms), [tones(50.0)], 3000.0).status == status
