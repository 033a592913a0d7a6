"""`robosmi verify` types numbers that a program compares, with one less and one more: a border that is moved is noticed."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.running import run
from tests.tools import require_verification

PROGRAMS = {
    "menu": """#include "simpletools.h"
int main() {
  int speed = 100, n;
  while (1) {
    char c = getChar();
    if (c == 's') {
      scan("%d\\n", &n);
      if (n >= 20 && n <= 1000) { speed = n; print("ok %d\\n", speed); }
      else print("out of range\\n");
    }
    else if (c == 'q') break;
    else print("?\\n");
  }
  high(5);
}
""",
    "guess": """#include "simpletools.h"
#define SECRET 613
int judge(int guess) { return guess == SECRET ? 0 : guess < SECRET ? -1 : 1; }
int main() {
  while (1) {
    print("guess? ");
    int found = judge(getDec());
    if (found < 0) print("more\\n");
    else if (found > 0) print("less\\n");
    else high(5);
  }
}
""",
}


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The migrated programs, each verified once, so that its scenarios are stored."""
    require_verification("simavr")
    folder = tmp_path_factory.mktemp("typed")
    for name, text in PROGRAMS.items():
        (folder / f"{name}.c").write_text(text)
        assert run("migrate", folder / f"{name}.c", "-o", folder / name, "--bind", "P5=D5").code in (0, 1)
        assert run("verify", folder / name).code == 0
    return folder


@pytest.mark.exhaustive
@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("menu", "n >= 20", "n > 20"),
        ("menu", "n >= 20", "n >= 19"),
        ("menu", "n <= 1000", "n <= 1001"),
        ("menu", "n <= 1000", "n < 1000"),
        ("guess", "SECRET 613", "SECRET 614"),
        ("guess", "guess < SECRET", "guess < SECRET + 2"),
    ],
)
def test_a_moved_border_of_a_typed_number_is_noticed(name: str, old: str, new: str, made: Path, tmp_path: Path) -> None:
    shutil.copytree(made / name, tmp_path / "out")
    sketch = tmp_path / "out" / name / f"{name}.ino"
    text = sketch.read_text()
    assert old in text
    sketch.write_text(text.replace(old, new))
    outcome = run("verify", tmp_path / "out", "--json")
    assert (outcome.code, outcome.result["verdict"]) == (6, "different")
