"""Programs whose runs are given up: how long scenarios last then, what the search keeps, and that traces are bounded."""

from __future__ import annotations

import random

import pytest

from robosmi.errors import VerificationError
from robosmi.transformations.verification import original_side
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.bound_devices.varied_devices import moved_devices
from robosmi.transformations.verification.original_side import run_source, run_varied
from robosmi.transformations.verification.search.scenario_search import _HORIZON_ALONE_MS, _HORIZONS_MS, _horizon, search
from robosmi.transformations.verification.search.search_effort import SearchEffort
from robosmi.verify import bench, host_original, original_run
from robosmi.verify.original import OriginalRun
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.original_run import run_original
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import DeviceUse
from tests.host_model.bench import original, run
from tests.tools import require_tools

BLINK = (
    "#include <simpletools.h>\nint n;\n"
    "int main() { while (1) { if (n++ > 2000) n = 0; high(3); pause(1); low(3); pause(1); } }"
)  # fmt: skip
PORTS = [BoundPort("P3", "P3", "D3")]


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "gcov", "objcopy")


def test_scenarios_are_no_longer_than_can_be_recorded(monkeypatch: pytest.MonkeyPatch) -> None:
    with original(BLINK) as program:
        assert _horizon(program, PORTS, SearchEffort(240.0)) > 3000.0
        monkeypatch.setattr(original_run, "_MOST_RECORDS", 4_000)
        assert _horizon(program, PORTS, SearchEffort(240.0)) == 3000.0


@pytest.mark.parametrize(
    ("begin", "loop", "horizon"),
    [
        ("pause(15000);", "high(3); pause(1000); low(3); pause(1000);", 48_000.0),  # nothing is done for long, then something
        ("pause(9000); high(3); pause(30000); low(3);", "pause(100);", 48_000.0),
        ("for (int n = 0; n < 5; n++) { high(3); pause(1700); low(3); pause(1700); } high(4);", "pause(100);", 48_000.0),
        ("while (!input(3));", "high(4);", 6_000.0),  # it asks again and again
        ("pause(500);", "pause(100);", 6_000.0),
        ("getchar();", "high(3);", 6_000.0),  # nothing comes, however long it is waited for
    ],
)
def test_scenarios_are_long_enough_for_what_waits(begin: str, loop: str, horizon: float) -> None:
    with original(
        f"#include <simpletools.h>\nint main() {{\n{begin}\nwhile (1) {{\n{loop}\n}} }}".replace("; ", ";\n")
    ) as program:
        assert _horizon(program, PORTS, SearchEffort(240.0), (*_HORIZONS_MS, _HORIZON_ALONE_MS)) == horizon


def test_wheels_of_varied_runs_stand_anywhere_between_two_ticks() -> None:
    wheel = DeviceUse("wheel", {"servo": "P12", "encoder": "P14"}, {})
    places = {moved_devices([wheel], random.Random(seed))[0].settings["starts_at"] for seed in range(20)}
    assert len(places) == 20
    assert all(isinstance(place, float) and 0 <= place < 1 for place in places)


def test_each_varied_run_puts_wheels_down_somewhere_else(monkeypatch: pytest.MonkeyPatch) -> None:
    wheel = DeviceUse("wheel", {"servo": "P12", "encoder": "P14"}, {})
    places = []

    def noted(program: OriginalProgram, until_us: float, devices: list[DeviceUse], *more: object, **rest: object) -> OriginalRun:
        places.append(devices[0].settings["starts_at"])
        return run_original(program, until_us)

    monkeypatch.setattr(original_side, "played", lambda ports, scenario, target: [wheel])
    with original(BLINK) as program:
        nominal = program.run(20_000.0)
        monkeypatch.setattr(host_original, "run_original", noted)
        run_varied(program, PORTS, Scenario("rest", 20.0), nominal)
    assert len(set(places)) == 5


def test_the_search_keeps_what_tells_why_and_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(original_run, "_MOST_RECORDS", 100)
    with original(BLINK) as program:
        found = search(program, PORTS, [], False, 1)
    assert [runs.given_up for _, runs in found.scenarios] == ["output limit"]
    assert (found.tried, found.racy) == (1, 0)


def test_varied_runs_share_their_time(monkeypatch: pytest.MonkeyPatch) -> None:
    scenario = Scenario("s", 300.0)
    with original(BLINK) as program:
        nominal = run_source(program, PORTS, scenario)
        whole = run_varied(program, PORTS, scenario, nominal)
        assert (whole.given_up, len(whole.varied)) == ("", 5)
        assert not any(each.trace.changes for each in whole.varied)
        times = iter([0.0, 1.0, 2.0, 3.0, 99.0, 99.0])
        monkeypatch.setattr(original_side, "used_s", lambda: next(times))
        part = run_varied(program, PORTS, scenario, nominal, limit_s=60.0)
    assert (part.given_up, len(part.varied)) == ("time limit", 3)


def test_changes_of_pins_are_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bench, "MOST_CHANGES", 50)
    with pytest.raises(VerificationError, match="changes its pins more than 50 times"):
        run(BLINK, 1000)
