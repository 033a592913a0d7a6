"""`robosmi verify` where a simulator itself crashes: another is asked, and what one side alone decides is told all the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.verify import simulation
from tests.running import run
from tests.tools import require_engine, require_verification

WORKER = """
import io, json, os, runpy, signal, sys
asked = sys.stdin.read()
if json.loads(asked)["engine"] in {crashing!r}:
    os.kill(os.getpid(), signal.SIGSEGV)
for name in [name for name in sys.modules if name.partition(".")[0] == "robosmi"]:
    del sys.modules[name]
sys.path[:] = [{root!r}, *(path for path in sys.path if path != {stand_in!r})]
sys.stdin = io.StringIO(asked)
runpy.run_module("robosmi.verify.worker", run_name="__main__")
"""
"""A worker process that ends by a signal, as if libsimavr accessed invalid memory, and otherwise is the real one."""

BLINK = "int main() { high(26); pause(100); low(26); while (1) pause(5); }"
ENDLESS = "int f(int n) { return f(n + 1) + 1; }\nint main() { high(26); return f(1); }"
LARGE = "int f(int n) { volatile char b[20000]; b[0] = n; return f(n + 1) + b[0]; }\nint main() { high(26); return f(1); }"


@pytest.fixture
def out(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """A migrated program."""
    require_verification("simavr")
    (tmp_path / "p.c").write_text(f'#include "simpletools.h"\n{request.param}\n')
    assert run("migrate", tmp_path / "p.c", "-o", tmp_path / "out", "--bind", "P26=D13").code in (0, 1)
    return tmp_path / "out"


@pytest.fixture
def scenario(tmp_path: Path) -> Path:
    """A scenario without inputs."""
    (tmp_path / "s.toml").write_text("horizon_ms = 300\n")
    return tmp_path / "s.toml"


def crash(engines: tuple[str, ...], folder: Path, patch: pytest.MonkeyPatch) -> None:
    """Make the workers of these engines crash."""
    place = folder / "stand_in"
    (place / "robosmi" / "verify").mkdir(parents=True)
    text = WORKER.format(crashing=engines, root=simulation._root(), stand_in=str(place))
    for name, content in {"": "", "verify/": "", "verify/worker": text}.items():
        path = place / "robosmi" / (f"{name}__init__.py" if not name or name.endswith("/") else f"{name}.py")
        path.write_text(content)
    patch.setattr(simulation, "_root", lambda: str(place))


@pytest.mark.parametrize("out", [BLINK], indirect=True)
def test_another_engine_runs_what_one_crashes_at(
    out: Path, scenario: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    require_engine("avr8js")
    crash(("simavr",), tmp_path, monkeypatch)
    outcome = run("verify", out, "--scenario", scenario, "--json")
    assert (outcome.code, outcome.result["verdict"]) == (0, "no-difference-found"), outcome.result
    assert outcome.result["engine"] == "simavr (avr8js where simavr crashed)"
    named = run("verify", out, "--scenario", scenario, "--engine", "simavr")
    assert named.code == 6
    assert "the engine 'simavr' crashed: signal 11 ended its process" in named.err
    assert "--engine NAME" in named.err


@pytest.mark.parametrize("out", [BLINK], indirect=True)
def test_without_any_engine_that_runs_it_there_is_no_verdict(
    out: Path, scenario: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    crash(("simavr", "avr8js"), tmp_path, monkeypatch)
    outcome = run("verify", out, "--scenario", scenario)
    assert (outcome.code, "the engine 'simavr' crashed" in outcome.err) == (6, True)


@pytest.mark.parametrize("out", [ENDLESS, LARGE], indirect=True, ids=["endless", "large frames"])
def test_an_original_that_decides_alone_does_so(
    out: Path, scenario: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    crash(("simavr", "avr8js"), tmp_path, monkeypatch)
    outcome = run("verify", out, "--scenario", scenario, "--json")
    assert (outcome.code, outcome.result["verdict"]) == (1, "not-decidable"), outcome.out + outcome.err
    (reason,) = outcome.result["reasons"]
    assert "its calls exhaust the stack" in reason
    assert "the engine 'simavr' crashed" in reason


@pytest.mark.parametrize("out", [BLINK], indirect=True)
def test_a_difference_in_another_scenario_is_told(
    out: Path, scenario: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The engine crashes in runs of 300 ms only; in the longer scenario the light goes out too late."""
    sketch = out / "p" / "p.ino"
    assert "pause(100)" in sketch.read_text()
    sketch.write_text(sketch.read_text().replace("pause(100)", "pause(150)"))
    crash(("simavr", "avr8js"), tmp_path, monkeypatch)
    worker = tmp_path / "stand_in" / "robosmi" / "verify" / "worker.py"
    worker.write_text(worker.read_text().replace('["engine"] in', '["job"]["horizon_us"] == 300_000 and "simavr" in'))
    (tmp_path / "longer.toml").write_text("horizon_ms = 400\n")
    outcome = run("verify", out, "--scenario", scenario, "--scenario", tmp_path / "longer.toml", "--json")
    assert (outcome.code, outcome.result["verdict"]) == (6, "different"), outcome.out + outcome.err
    assert outcome.result["first_difference"]["scenario"] == "longer"
    assert [s["verdict"] for s in outcome.result["scenarios"]] == ["not-decidable", "different"]
