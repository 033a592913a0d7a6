"""What every engine has to show of a program at its pins: the conformance suite of engines."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from threading import Timer
from time import monotonic, sleep

import pytest
from msgspec.structs import replace

from robosmi.errors import MissingToolError, UsageError, VerificationError
from robosmi.metamodels import platform
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import DeviceUse, engine_names, simulate, usual_limit_s
from tests.tools import require_engine
from tests.transformations.verification.conftest import Run

AVR_ENGINES = ["simavr", "avr8js"]


def test_the_engines_are_known_in_the_order_in_which_they_are_tried() -> None:
    assert engine_names() == [*AVR_ENGINES, "rp2040js", "api"]


def test_how_pins_are_driven_is_seen_with_its_times(job_of: Run, engine: str) -> None:
    trace = simulate(job_of("pins", 50, ()), engine)
    levels = trace.levels("D8")
    assert [level for _, level in levels] == [0, 1, "p", "z", "p", "z", 0] or [level for _, level in levels] == [
        0,
        1,
        "z",
        "p",
        "z",
        0,
    ]
    times = {level: at_us for at_us, level in levels}
    begun = next(at_us for at_us, level in levels if level == 1)
    assert times[0] - begun == pytest.approx(30_000, rel=0.01)
    assert trace.state == "running"
    assert trace.simulated_us == 50_000


def test_inputs_pull_ups_and_voltages_are_read(job_of: Run, engine: str) -> None:
    devices = [
        DeviceUse("levels", {"pin": "D2"}, {"points": [[0, 0], [40, 1], [60, 0]]}),
        DeviceUse("levels", {"pin": "D4"}, {"points": [[0, None], [50, 0], [70, None]]}),
        DeviceUse("voltages", {"pin": "A1"}, {"points": [[0, 0], [45, 4000], [65, 1000]]}),
    ]
    trace = simulate(job_of("pins", 100, devices), engine)
    assert seen(trace.levels("D13")) == [(40, 1), (60, 0)]
    assert seen(trace.levels("D12")) == [(50, 0), (70, 1)]
    assert seen(trace.levels("D11")) == [(45, 1), (65, 0)]


def seen(levels: Sequence[tuple[float, int | str]]) -> list[tuple[int, int | str]]:
    """The changes after 35 ms, in whole milliseconds."""
    return [(round(at_us / 1000), level) for at_us, level in levels if at_us > 35_000]


def test_the_waves_of_timers_are_seen(job_of: Run, engine: str) -> None:
    trace = simulate(job_of("waves", 60, ()), engine)
    first = {wave.pin: (round(wave.hz, 1), round(wave.duty, 2)) for wave in trace.waves if wave.at_us < 10_000}
    assert first == {"D5": (976.6, 0.25), "D9": (490.2, 0.5), "D3": (490.2, 0.78)}
    assert {wave.pin: wave.hz for wave in trace.waves if wave.at_us > 10_000} == {"D9": 0.0, "D3": 0.0}
    rises = [begun for begun, _ in trace.pulses("D8")]
    assert (rises[-1] - rises[0]) / (len(rises) - 1) == pytest.approx(1000, rel=0.01)


def test_the_console_is_read_and_typed_on(job_of: Run, engine: str) -> None:
    trace = simulate(job_of("console", 60, [DeviceUse("typing", {}, {"points": [[20, "abc"], [40, "x"]]})]), engine)
    assert trace.text == "ready\r\nbcdy"
    assert trace.console[-1].at_us == pytest.approx(40_000, abs=500)


def test_writing_to_its_own_memory_takes_a_microcontroller_its_time(job_of: Run, engine: str) -> None:
    trace = simulate(job_of("own_memory", 60, ()), engine)
    assert trace.text == "55AA"
    [written, there] = [end - begun for begun, end in trace.pulses("D8")]
    assert written == pytest.approx(2 * 3_500, rel=0.06)
    assert there < 100


def test_a_run_can_be_repeated_to_the_byte(job_of: Run, engine: str) -> None:
    asked = job_of("rangers", 300, [DeviceUse("ranger", {"signal": "D7"}, {"points": [[0, 20], [150, 35]]})])
    assert simulate(asked, engine) == simulate(asked, engine)


def test_the_engines_agree_on_what_is_printed_and_driven(job_of: Run) -> None:
    for name in AVR_ENGINES:
        require_engine(name)
    asked = job_of("rangers", 300, [DeviceUse("ranger", {"signal": "D7"}, {"points": [[0, 20], [150, 35]]})])
    one, other = (simulate(asked, name) for name in AVR_ENGINES)
    assert one.text == other.text
    driven = [[(change.pin, change.level) for change in trace.changes[:20]] for trace in (one, other)]
    assert driven[0] == driven[1]


@pytest.mark.parametrize(
    ("use", "said"),
    [
        (DeviceUse("robot"), "unknown device 'robot'"),
        (DeviceUse("levels", {"pin": "D99"}, {"points": []}), "the board has no pin 'D99'"),
        (DeviceUse("levels", {}, {"points": []}), "Levels needs 'pin'"),
        (DeviceUse("levels", {"pin": "D2"}, {}), "Levels needs 'points'"),
        (DeviceUse("levels", {"pin": "D2"}, {"points": [], "colour": 1}), "Levels has no setting 'colour'"),
        (DeviceUse("levels", {"pin": "D2"}, {"points": [[5, 1], [4, 0]]}), "goes back in time, from 5 to 4 ms"),
    ],
)
def test_a_device_that_is_used_wrongly_is_refused(use: DeviceUse, said: str, job_of: Run, engine: str) -> None:
    with pytest.raises(UsageError, match=said):
        simulate(job_of("pins", 1, [use]), engine)


def test_two_devices_of_one_address_are_refused(job_of: Run, engine: str) -> None:
    with pytest.raises(UsageError, match="two devices have the address 0x50"):
        simulate(job_of("bus", 1, [DeviceUse("eeprom"), DeviceUse("eeprom")]), engine)


@pytest.mark.skipif(not Path("/proc/self/environ").exists(), reason="this system does not show the environment of processes")
def test_a_run_that_takes_too_long_is_ended_with_everything_that_it_started(
    job_of: Run, engine: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    job = job_of("pins", 1e7, ())
    monkeypatch.setenv("ROBOSMI_STARTED_BY", str(tmp_path))
    with pytest.raises(VerificationError, match=r"exceeded 1\.5 s of processor time"):
        simulate(job, engine, limit_s=1.5)
    until = monotonic() + 5  # the system takes a moment to take down what was killed
    while (left := started_by(tmp_path)) and monotonic() < until:
        sleep(0.05)
    assert left == []


def test_other_work_on_the_machine_ends_no_run(job_of: Run, engine: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The worker stands still for longer than its limit of processor time, as if others had the cores."""

    class Paused(subprocess.Popen[str]):
        def communicate(self, *args: object, **options: object) -> tuple[str, str]:
            os.kill(self.pid, signal.SIGSTOP)
            Timer(2.2, os.kill, (self.pid, signal.SIGCONT)).start()
            return super().communicate(*args, **options)  # type: ignore[arg-type]

    monkeypatch.setattr("robosmi.verify.simulation.subprocess.Popen", Paused)
    assert simulate(job_of("pins", 50, ()), engine, limit_s=2.0).state == "running"


def test_a_worker_that_hangs_is_ended_by_the_clock(job_of: Run, engine: str, monkeypatch: pytest.MonkeyPatch) -> None:
    class Stopped(subprocess.Popen[str]):
        def communicate(self, *args: object, **options: object) -> tuple[str, str]:
            os.kill(self.pid, signal.SIGSTOP)
            return super().communicate(*args, **options)  # type: ignore[arg-type]

    monkeypatch.setattr("robosmi.verify.simulation.subprocess.Popen", Stopped)
    with pytest.raises(VerificationError, match=r"exceeded 1 s, by the clock"):
        simulate(job_of("pins", 50, ()), engine, limit_s=0.1)


def started_by(folder: Path) -> list[str]:
    """The processes that have the folder's mark in their environment."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            if f"ROBOSMI_STARTED_BY={folder}".encode() in (process / "environ").read_bytes():
                found.append(process.name)
    return found


def test_a_program_that_is_missing_is_an_error(job_of: Run, engine: str) -> None:
    gone = replace(job_of("pins", 1, ()), elf="gone.elf", hex="gone.hex")
    with pytest.raises(VerificationError, match=r"gone\.(elf|hex)"):
        simulate(gone, engine)


def test_what_no_engine_knows_is_refused(job_of: Run) -> None:
    with pytest.raises(UsageError, match="no engine is called 'spice'"):
        simulate(job_of("pins", 1, ()), "spice")
    with pytest.raises(UsageError, match="does not know the microcontroller 'atmega2560'"):
        simulate(replace(job_of("pins", 1, ()), mcu="atmega2560"), "avr8js")
    with pytest.raises(UsageError, match="no engine knows the microcontroller 'esp8266'"):
        simulate(replace(job_of("pins", 1, ()), mcu="esp8266"))
    with pytest.raises(UsageError, match="no simulator data for the microcontroller 'esp8266'"):
        job(Path("a.elf"), Path("a.hex"), platform.Board(microcontroller=platform.Microcontroller(name="esp8266")), 1)


def test_an_engine_that_is_not_installed_says_how_to_install_it(job_of: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(MissingToolError) as caught:
        simulate(job_of("pins", 1, ()), "avr8js")
    assert "install" in str(caught.value.fix)


def test_a_worker_that_is_killed_is_an_error(job_of: Run, engine: str, monkeypatch: pytest.MonkeyPatch) -> None:
    begun: list[subprocess.Popen[str]] = []

    class Killed(subprocess.Popen[str]):
        def communicate(self, *args: object, **options: object) -> tuple[str, str]:
            begun.append(self)
            os.kill(self.pid, signal.SIGKILL)
            return super().communicate(*args, **options)  # type: ignore[arg-type]

    monkeypatch.setattr("robosmi.verify.simulation.subprocess.Popen", Killed)
    with pytest.raises(VerificationError, match="crashed"):
        simulate(job_of("pins", 1, ()), engine)
    assert [each.returncode for each in begun] == [-signal.SIGKILL]


def test_a_program_that_leaves_its_memory_has_crashed_and_its_time_is_told(job_of: Run, engine: str) -> None:
    trace = simulate(job_of("lost", 200, ()), engine)
    assert trace.state == "crashed"
    assert trace.simulated_us == pytest.approx(20_000, rel=0.05)
    assert trace.levels("D8")[-1][1] == 1


def test_a_run_of_a_slow_program_may_take_as_long_as_it_needs() -> None:
    """48 s of a program that polls a line take 150 s of processor time on rp2040js; a short one that hangs ends after 60 s."""
    assert usual_limit_s(48e6) > 150
    assert usual_limit_s(1e6) == 60
