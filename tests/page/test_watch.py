"""Both programs side by side: the runs as the server makes them, and the live part of the page in a real browser."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.project import FILE_NAME
from robosmi.transformations.chains.page import PlanPage
from robosmi.transformations.chains.watch import WatchedFolder, printed, state_of, text_of
from robosmi.verify.scenario import read_scenario
from robosmi.verify.simulation import ConsoleByte
from robosmi.verify.traces.activity import BURST, LEVEL, PULSES, WAVE, ActivityEvent
from tests.page.browsers import Served
from tests.running import run
from tests.tools import require_tools, require_verification

PROGRAM = """#include "simpletools.h"
int main()
{
  print("ready\\n");
  while (1) {
    if (input(7) == 1)
      high(3);
    else
      low(3);
    pause(20);
  }
}
"""
PARTS = "pin;part;title;connector\nD5;LED;lamp;anode\nD7;Button;key;A\n"
BUILDS = 120.0
"""Seconds that both programs may take to be built and simulated, on a busy machine."""
Serve = Callable[[Path], Served]
PRESSED: list[dict[str, Any]] = [{"title": "key", "setting": "points", "points": [[400, 1], [800, 0]]}]


@pytest.fixture
def out(tmp_path: Path) -> Path:
    """A lamp that is on while a key is pressed."""
    require_tools("avr-gcc", "arduino-core-avr")
    require_verification("simavr")
    (tmp_path / "lamp.c").write_text(PROGRAM)
    (tmp_path / "parts.csv").write_text(PARTS)
    (tmp_path / FILE_NAME).write_text('[bind]\nP3 = "D5"\nP7 = "D7"\n')
    robosmi.migrate([tmp_path / "lamp.c"], tmp_path / "out", hardware=tmp_path / "parts.csv", target="uno")
    return tmp_path / "out"


def lamp(answer: dict[str, Any], side: str) -> list[tuple[str, float]]:
    """What the lamp does on a side: its states with their times."""
    (channel,) = [each for each in answer["channels"] if each["component"] == "lamp"]
    return [(event[1], event[0]) for event in channel["sides"][side]]


def test_both_programs_see_an_input_at_the_same_simulated_time(out: Path) -> None:
    watched = WatchedFolder(out)
    answer = watched.answer({"ms": 1200, "inputs": PRESSED})
    assert answer["state"] == "done", answer["message"]
    for side in ("original", "migrated"):
        states = lamp(answer, side)
        assert [state for state, _ in states][-2:] == ["on", "off"]
        (on, off) = [at for _, at in states[-2:]]
        assert 400 <= on <= 440
        assert 800 <= off <= 840
        assert "ready" in "".join(text for _, text in answer["console"][side])
    assert [each["sounds"] for each in answer["channels"] if each["component"] == "lamp"] == [False]
    (key,) = [each for each in answer["inputs"] if each["title"] == "key"]
    assert (key["control"], key["points"]) == ("button", [[400, 1], [800, 0]])
    watched.close()


def test_a_further_input_leaves_what_was_before_it(out: Path) -> None:
    watched = WatchedFolder(out)
    first = watched.answer({"ms": 1200, "inputs": PRESSED})
    more = [{**PRESSED[0], "points": [*PRESSED[0]["points"], [1000, 1]]}]
    second = watched.answer({"ms": 1200, "inputs": more})
    for side in ("original", "migrated"):
        assert lamp(second, side)[: len(lamp(first, side))] == lamp(first, side)
        assert len(lamp(second, side)) == len(lamp(first, side)) + 1
    watched.close()


def test_the_first_difference_is_that_of_verify_and_an_edit_is_seen_at_once(out: Path) -> None:
    watched = WatchedFolder(out)
    same = watched.answer({"ms": 1200, "inputs": PRESSED, "compare": True})
    assert (same["verdict"], same["difference"]) == ("no-difference-found", None)
    sketch = out / "lamp" / "lamp.ino"
    text = sketch.read_text()
    assert "high(" in text
    sketch.write_text(text.replace("high(", "low("))
    other = watched.answer({"ms": 1200, "inputs": PRESSED, "compare": True})
    assert other["verdict"] == "different"
    assert 380 <= other["difference"]["ms"] <= 840
    assert "lamp" in other["difference"]["channel"]
    watched.close()


def test_a_run_is_saved_as_a_test_case_that_can_be_replayed(out: Path) -> None:
    watched = WatchedFolder(out)
    saved = watched.answer({"ms": 1200, "inputs": PRESSED, "save": "key pressed"})
    assert (saved["state"], saved["cases"]) == ("done", ["key_pressed"])
    case = read_scenario(out / "models" / "scenarios" / "key_pressed.toml")
    assert (case.horizon_ms, case.signals["key"]["points"]) == (1200, ((400, 1), (800, 0)))
    again = watched.answer({"ms": 1200, "inputs": [], "save": "key pressed"})
    assert again["state"] == "refused"
    replayed = watched.answer({"scenario": "key_pressed"})
    assert [state for state, _ in lamp(replayed, "migrated")][-2:] == ["on", "off"]
    watched.close()


@pytest.mark.parametrize(
    "about",
    [
        {},
        {"ms": True},
        {"ms": 1e9},
        {"ms": float("nan")},
        {"ms": 1000, "inputs": "key"},
        {"ms": 1000, "inputs": [1]},
        {"ms": 1000, "inputs": [{"title": "key", "points": []}]},
        {"ms": 1000, "inputs": [{"title": "key", "points": [[5, 1], [1, 0]]}]},
        {"ms": 1000, "inputs": [{"title": "key", "points": [["x", 1]]}]},
        {"ms": 1000, "inputs": [{"title": "key", "points": [[1, 7]]}]},
        {"ms": 1000, "inputs": [{"title": "nobody", "points": [[1, 1]]}]},
        {"ms": 1000, "inputs": [], "save": "../../x"},
        {"ms": 1000, "inputs": [], "save": "x" * 99},
        {"scenario": "../lamp"},
    ],
)
def test_what_means_nothing_is_refused_and_nothing_is_written(about: dict[str, Any], out: Path) -> None:
    watched = WatchedFolder(out)
    answer = watched.answer(about)
    assert answer["state"] == "refused"
    assert not (out / "models" / "scenarios").exists()
    watched.close()


def test_a_sketch_that_crashes_is_told_with_its_time(out: Path) -> None:
    sketch = out / "lamp" / "lamp.ino"
    sketch.write_text(
        sketch.read_text().replace("void loop() {", "void loop() {\n  if (millis() > 300) ((void (*)(void))0x3f00)();")
    )
    watched = WatchedFolder(out)
    ended = watched.answer({"ms": 1200, "inputs": []})["ended"]
    watched.close()
    assert [*ended] == ["migrated"]
    assert ended["migrated"][0] == "crashed"
    assert 300 <= ended["migrated"][1] <= 330


@pytest.mark.parametrize(
    ("sent", "pieces"),
    [
        (b"a\nb", [[0.0, "a\n"], [0.2, "b"]]),
        (b"a\rb\r", [[0.0, "a\n"], [0.2, "b\n"]]),
        (b"a\r\nb", [[0.0, "a\n"], [0.3, "b"]]),
        (b"a\n\rb", [[0.0, "a\n"], [0.2, "\n"], [0.3, "b"]]),
        (b"", []),
    ],
)
def test_each_line_of_a_console_appears_at_its_own_time(sent: bytes, pieces: list[list[Any]]) -> None:
    assert printed([ConsoleByte(100.0 * n, byte) for n, byte in enumerate(sent)]) == pieces


def test_a_sketch_that_does_not_compile_is_said(out: Path) -> None:
    (out / "lamp" / "lamp.ino").write_text("no sketch\n")
    answer = WatchedFolder(out).answer({"ms": 1000})
    assert answer["state"] == "refused"
    assert "compile" in answer["message"]


def test_of_runs_that_wait_only_the_last_is_done(out: Path) -> None:
    watched = WatchedFolder(out)
    assert watched.answer({"ms": 200, "tab": "a", "number": 5})["state"] == "done"
    assert watched.answer({"ms": 200, "tab": "a", "number": 4})["state"] == "superseded"
    assert watched.answer({"ms": 200, "tab": "b", "number": 1})["state"] == "done"
    watched.close()


@pytest.mark.parametrize(
    ("event", "wheel", "state"),
    [
        (ActivityEvent(0, LEVEL, (1,)), 0, "on"),
        (ActivityEvent(0, LEVEL, (0,)), 0, "off"),
        (ActivityEvent(0, PULSES, (1500.0,)), 0, "90"),
        (ActivityEvent(0, PULSES, (1000.0,)), 0, "40"),
        (ActivityEvent(0, PULSES, (1600.0,)), 1, "50"),
        (ActivityEvent(0, PULSES, (1300.0,)), -1, "100"),
        (ActivityEvent(0, PULSES, (1500.0,)), -1, "0"),
        (ActivityEvent(0, WAVE, (440.0, 0.5)), 0, "440"),
        (ActivityEvent(0, WAVE, (0.0, 0.3)), 0, "on"),
        (ActivityEvent(0, BURST, (3,)), 0, "on"),
    ],
)
def test_the_state_of_a_part_is_that_of_the_contract(event: ActivityEvent, wheel: int, state: str) -> None:
    assert state_of(event, wheel) == state


@pytest.mark.parametrize(("hz", "text"), [(90.0831, "90.1 Hz"), (38012.5, "38000 Hz"), (0.25, "0.25 Hz")])
def test_a_frequency_has_three_digits(hz: float, text: str) -> None:
    event = ActivityEvent(0, WAVE, (hz, 0.5))
    assert text_of(event) == text
    assert state_of(event) == f"{hz:g}"  # the sound has the exact one


def test_the_live_part_runs_pauses_steps_takes_an_input_and_stops(out: Path, serve: Serve) -> None:
    page = serve(out)
    page.open()
    lamp_of = "document.querySelector('[data-component=lamp][data-side={}]').dataset.state"
    clock = "return Number(document.getElementById('clock').dataset.ms)"
    page.script("document.querySelector('[data-run]').click()")
    page.wait(lambda: page.script(clock) > 100, BUILDS)
    assert page.script(f"return {lamp_of.format('original')}") == "off"
    page.script("document.querySelector('[data-input=key]').click()")
    page.wait(
        lambda: page.script(f"return {lamp_of.format('migrated')} === 'on' && {lamp_of.format('original')} === 'on'"), BUILDS
    )
    page.script("document.getElementById('pause').click()")
    stood = page.script(clock)
    assert page.script(clock) == stood
    assert "ready" in page.script("return document.getElementById('console-migrated').textContent")
    assert page.script("return document.querySelectorAll('#timeline path').length") >= 2
    assert page.script("return [...document.querySelectorAll('#timeline .time')].map(e => e.textContent)")[:2] == ["0 s", "1 s"]
    said = "return document.getElementById('save-status').textContent"
    page.script("document.getElementById('save').click()")
    page.wait(lambda: "name" in page.script(said))
    page.script("document.getElementById('case-name').value = 'by hand'; document.getElementById('save').click()")
    page.wait(lambda: page.script("return [...document.getElementById('case').options].some(o => o.value === 'by_hand')"), BUILDS)
    assert "Saved" in page.script(said)
    ended = "return document.getElementById('pause').textContent === 'Simulate longer'"
    page.script("document.getElementById('speed').value = '10'; document.getElementById('pause').click()")
    page.wait(lambda: page.script(ended), BUILDS)
    page.script("document.querySelector('[data-input=key]').click()")
    page.wait(lambda: page.script("return 'playing' in document.getElementById('watch').dataset"), BUILDS)
    page.script("document.querySelector('[data-run]').click()")
    assert page.script("return document.querySelector('[data-run]').dataset.run") == "stopped"


LONG = "a sensor whose name has no end " * 8
MADE: dict[str, Any] = {
    "state": "done", "ms": 400, "seconds": 0.1, "engine": "simavr", "scenario": "", "cases": ["stored"], "ended": {},
    "inputs": [
        {"title": "eye", "setting": "points", "control": "range", "least": 2.2, "most": 299.6, "unit": "cm", "rest": 100.6,
         "points": []}
    ],
    "title": "", "why": "", "compared": True, "verdict": "no-difference-found", "difference": None,
    "console": {"original": [[0, "one\n"], [100, "two\n"]], "migrated": [[0, "one\n"], [300, "two\n"]]},
    "channels": [
        {"title": part, "component": part, "port": port, "pins": {"original": port, "migrated": "D4"}, "cut": False,
         "turns": False, "sounds": part == "piezo", "sides": {"original": events, "migrated": events}}
        for part, port, events in (
            ("piezo", "P4", [[0, "440", "440 Hz", "wave"], [100, "261.6", "261.6 Hz", "wave"], [200, "38000", "38 kHz", "wave"]]),
            (LONG, "P" * 60, [[0, "490", "490 Hz, 50 % high", "wave"]]),
        )
    ],
}  # fmt: skip
"""A run as a server answers it."""


def test_tones_show_as_notes_and_long_names_stay_in_their_place(tmp_path: Path, serve: Serve) -> None:
    (tmp_path / "lamp.c").write_text(PROGRAM)
    robosmi.migrate([tmp_path / "lamp.c"], tmp_path / "out", target="uno")
    page = serve(tmp_path / "out")
    page.open()
    page.script(
        "const made = arguments[0]; window.asked = [];"
        "window.fetch = async (path, about) => { if (about.body) asked.push(JSON.parse(about.body));"
        " return { json: async () => structuredClone(made) }; }",
        MADE,
    )
    page.script("document.querySelector('[data-run]').click()")
    page.wait(lambda: page.script("return document.getElementById('clock').dataset.ms") == "400.0")
    texts = "return [...document.querySelectorAll('#watched td')].map(cell => cell.textContent)"
    console = "return [...document.querySelectorAll('#watch pre')].map(box => box.textContent)"
    moved = "s.dispatchEvent(new Event('input', {bubbles: true}))"
    seen = []
    for ms in (50, 150, 350, 250):
        page.script(f"const s = document.getElementById('seek'); s.value = {ms}; {moved}")
        seen.append((page.script(texts)[0], page.script(console)))
    assert seen == [
        ("440 Hz (A4)", ["one\n", "one\n"]),
        ("261.6 Hz (C4)", ["one\ntwo\n", "one\n"]),
        ("38 kHz", ["one\ntwo\n", "one\ntwo\n"]),
        ("38 kHz", ["one\ntwo\n", "one\n"]),
    ]
    assert page.script(texts)[2] == "490 Hz, 50 % high", "a lamp that a wave dims makes no tone"
    assert page.script("return document.documentElement.scrollWidth <= innerWidth")
    cells = "[...document.querySelectorAll('#watched tr > *')].every(cell => cell.scrollWidth <= cell.clientWidth)"
    assert page.script(f"return {cells}"), "a name leaves its cell"
    assert page.script("return document.querySelector('#inputs label').textContent") == "eye  100.6 cm"
    page.script(
        "const c = document.getElementById('case'); c.value = 'stored'; c.dispatchEvent(new Event('change', {bubbles: true}))"
    )
    page.wait(lambda: page.script("return asked.some(about => about.scenario === 'stored')"))


def test_the_report_says_how_to_run_it(out: Path) -> None:
    text = PlanPage(out).document(live=False, nonce="n")
    assert "data-run" not in text.partition("<script")[0]
    assert f"robosmi open {out}" in text


def test_the_command_serves_the_live_part_alone(out: Path) -> None:
    assert run("simulate", out.parent / "nowhere", "--watch", "--no-browser").code == 3
    assert run("simulate", out, "--watch", "--seconds", "2").code == 2
    page = PlanPage(out, shown=["watch"])
    text = page.document(live=True, nonce="n")
    assert "data-run" in text
    assert 'id="decide"' not in text
