"""`robosmi verify` of programs that measure: what is measured may be off by a little, every other number in a text may not."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.running import run
from tests.tiers import sample
from tests.tools import require_verification

PROGRAM = """#include "simpletools.h"
#include "ping.h"
int main() {
  int n = 0;
  print("pin 15\\n");
  while (1) {
    int d = ping_cm(15);
    print("go 7: n=%d d=%d\\n", n, d);
    n++;
    pause(200);
  }
}
"""
SCENARIO = "horizon_ms = 1500\n[signals]\nP15 = [[0, 4.2], [700, 80.5], [1100, 12.4]]\n"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The migrated program, made once, with a scenario."""
    require_verification("simavr")
    folder = tmp_path_factory.mktemp("numbers")
    (folder / "far.c").write_text(PROGRAM)
    (folder / "s.toml").write_text(SCENARIO)
    assert run("migrate", folder / "far.c", "-o", folder / "out", "--bind", "P15=D7").code in (0, 1)
    return folder


CHANGES = {
    "as it is": ("", "", ""),
    "a number in a text": ("go 7", "go 8", "go 8: n=0"),
    "before anything is measured": ("pin 15", "pin 16", "'pin 16'"),
    "where a counter begins": ("n = 0", "n = 1", "n=1 "),
    "a counter of another step": ("n++", "n += 2", "n=2 "),
    "zeros before a measured number": ("d=%d", "d=%02d", "d=04"),
    "always one more than is measured": ("n, d)", "n, d + 1)", "d=5"),
    "always one less than is measured": ("n, d)", "n, d - 1)", "d=11"),
    "a measured number within what may be off": ("ping_cm(7)", "ping_cm(7) * 200 / 199", ""),
}


@pytest.mark.parametrize("change", sample(CHANGES, 4))
def test_a_number_that_is_not_measured_is_compared_to_the_letter(change: str, made: Path, tmp_path: Path) -> None:
    old, new, told = CHANGES[change]
    shutil.copytree(made / "out", tmp_path / "out")
    sketch = tmp_path / "out" / "far" / "far.ino"
    text = sketch.read_text()
    assert old in text
    sketch.write_text(text.replace(old, new, 1))
    outcome = run("verify", tmp_path / "out", "--scenario", made / "s.toml", "--json")
    expected = (6, "different") if told else (0, "no-difference-found")
    assert (outcome.code, outcome.result["verdict"]) == expected, outcome.result["first_difference"]
    if told:
        first = outcome.result["first_difference"]
        assert first["channel"] == "console"
        assert told in first["message"]


TYPED = """#include "simpletools.h"
int main() {
  int num;
  while (1) {
    if (getChar() == 'n') {
      num = getDec();
      print("n=%d\\n", num * 10);
    }
  }
}
"""


@pytest.mark.parametrize(("type_name", "verdict"), [("int32_t", "no-difference-found"), ("int16_t", "different")])
def test_numbers_behind_commands_go_beyond_16_bits(type_name: str, verdict: str, tmp_path: Path) -> None:
    require_verification("simavr")
    (tmp_path / "typed.c").write_text(TYPED)
    assert run("migrate", tmp_path / "typed.c", "-o", tmp_path / "out").code in (0, 1)
    sketch = tmp_path / "out" / "typed" / "typed.ino"
    text = sketch.read_text()
    assert "getDec()" in text
    sketch.write_text(text.replace("getDec()", f"({type_name})getDec()"))
    assert run("verify", tmp_path / "out", "--json").result["verdict"] == verdict
