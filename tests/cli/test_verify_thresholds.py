"""`robosmi verify` seeks the borders between values at which a program goes another way, and tells one that is moved a little."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.running import run
from tests.tiers import sample
from tests.tools import require_verification

PROGRAM = """#include "simpletools.h"
#include "ping.h"
#include "abvolts.h"
int main() {
  pause(1000);
  while (1) {
    int d = ping_cm(15);
    float v = ad_volts(2);
    if (d > 90) {
      high(4);
    } else if (v > 3.0) {
      high(5);
    } else {
      low(4);
      low(5);
    }
    pause(100);
  }
}
"""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The migrated program, verified once, so that its scenarios are stored."""
    require_verification("simavr")
    folder = tmp_path_factory.mktemp("borders")
    (folder / "far.c").write_text(PROGRAM)
    bound = [word for pair in ("P15=D7", "P4=D4", "P5=D5", "AD2=A0") for word in ("--bind", pair)]
    assert run("migrate", folder / "far.c", "-o", folder / "out", *bound).code in (0, 1)
    right = run("verify", folder / "out", "--json")
    assert (right.code, right.result["source_coverage"]["branches_pct"]) == (0, 100.0)
    return folder


@pytest.mark.parametrize(
    ("old", "new"), sample([("d > 90", "d > 93"), ("d > 90", "d > 87"), ("v > 3.0", "v > 3.1"), ("v > 3.0", "v > 2.9")], 1)
)
def test_a_border_that_is_moved_a_little_is_noticed(old: str, new: str, made: Path, tmp_path: Path) -> None:
    shutil.copytree(made / "out", tmp_path / "out")
    sketch = tmp_path / "out" / "far" / "far.ino"
    text = sketch.read_text()
    assert old in text
    sketch.write_text(text.replace(old, new))
    outcome = run("verify", tmp_path / "out", "--json")
    assert (outcome.code, outcome.result["verdict"]) == (6, "different")


KEYS = """#include "simpletools.h"
#include "keypad.h"
int rows[4] = {7, 6, 5, 4};
int cols[4] = {3, 2, 1, 0};
int values[16] = {1, 2, 3, 10, 4, 5, 6, 11, 7, 8, 9, 12, 14, 0, 15, 13};
int main() {
  keypad_setup(4, 4, rows, cols, values);
  while (1) {
    if (keypad_read() == 1) high(12); else low(12);
    pause(50);
  }
}
"""


def test_what_shows_lists_has_no_borders_and_is_played(tmp_path: Path) -> None:
    """A keypad shows which of its keys are held, between two of which there is nothing."""
    require_verification("simavr")
    (tmp_path / "keys.c").write_text(KEYS)
    pins = {7: "D2", 6: "D3", 5: "D4", 4: "D5", 3: "D6", 2: "D7", 1: "D8", 0: "D9", 12: "D12"}
    bound = [word for port, pin in pins.items() for word in ("--bind", f"P{port}={pin}")]
    made = run("migrate", tmp_path / "keys.c", "-o", tmp_path / "out", *bound)
    assert made.code in (0, 1), made.err
    outcome = run("verify", tmp_path / "out", "--json")
    assert outcome.code == 0, outcome.err
    assert outcome.result["source_coverage"]["branches_pct"] == 100.0


VALUES = """#include "simpletools.h"
#include "ping.h"
int main() {
  while (1) {
    print("near %d\\n", ping_cm(15) < 42);
    pause(100);
  }
}
"""
DARK = """#include "simpletools.h"
int main() {
  while (1) {
    high(9);
    pause(1);
    if (rc_time(9, 1) > 1000) high(4); else low(4);
    pause(100);
  }
}
"""
PROGRAMS = {"values": (VALUES, ("P15=D7",)), "dark": (DARK, ("P9=D7", "P4=D4"))}


@pytest.fixture(scope="module", params=PROGRAMS)
def decides(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A program that decides by a value that no branch depends on, and one that measures a time exactly."""
    require_verification("simavr")
    name = str(request.param)
    folder = tmp_path_factory.mktemp(name) / name
    folder.mkdir()
    text, pins = PROGRAMS[name]
    (folder / f"{name}.c").write_text(text)
    assert run(
        "migrate", folder / f"{name}.c", "-o", folder / "out", *(word for pin in pins for word in ("--bind", pin))
    ).code in (0, 1)
    assert run("verify", folder / "out").code == 0
    return folder


EDITS = {"values": (("< 42", "< 45"), ("< 42", "< 39")), "dark": (("> 1000", "> 1200"), ("> 1000", "> 800"))}


@pytest.mark.exhaustive
@pytest.mark.parametrize("number", [0, 1])
def test_a_border_is_sought_near_by_and_where_it_is_no_branch(number: int, decides: Path, tmp_path: Path) -> None:
    name = decides.name
    old, new = EDITS[name][number]
    shutil.copytree(decides / "out", tmp_path / "out")
    sketch = tmp_path / "out" / name / f"{name}.ino"
    text = sketch.read_text()
    assert old in text
    sketch.write_text(text.replace(old, new))
    outcome = run("verify", tmp_path / "out", "--json")
    assert (outcome.code, outcome.result["verdict"]) == (6, "different")
