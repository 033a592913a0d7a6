"""`robosmi verify` seeks the borders between values at which a program goes another way, and tells one that is moved a little."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.running import run
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
    ("old", "new"), [("d > 90", "d > 93"), ("d > 90", "d > 87"), ("v > 3.0", "v > 3.1"), ("v > 3.0", "v > 2.9")]
)
def test_a_border_that_is_moved_a_little_is_noticed(old: str, new: str, made: Path, tmp_path: Path) -> None:
    shutil.copytree(made / "out", tmp_path / "out")
    sketch = tmp_path / "out" / "far" / "far.ino"
    text = sketch.read_text()
    assert old in text
    sketch.write_text(text.replace(old, new))
    outcome = run("verify", tmp_path / "out", "--json")
    assert (outcome.code, outcome.result["verdict"]) == (6, "different")
