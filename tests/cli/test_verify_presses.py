"""`robosmi verify` presses a button until a mode comes round, holds it for as long as a program tells apart, presses all keys."""

from __future__ import annotations

import re
import shutil
from collections import Counter
from pathlib import Path

import pytest

from tests.running import run
from tests.tiers import sample
from tests.tools import require_verification

PROGRAMS = {
    "modes": """#include "simpletools.h"
int mode = 0;
int main() {
  int last = 1;
  while (1) {
    int b = input(5);
    if (b == 0 && last == 1) { mode = (mode + 1) % 4; print("mode %d\\n", mode); }
    last = b;
    pause(20);
  }
}
""",
    "held": """#include "simpletools.h"
int main() {
  while (1) {
    int t = 0;
    while (input(5) == 0) pause(5);
    while (input(5) == 1) { pause(10); t += 10; }
    if (t < 300) high(6);
    else if (t < 1200) high(7);
    else { low(6); low(7); }
  }
}
""",
    "keys": """#include "simpletools.h"
#include "keypad.h"
int rows[4] = {4, 5, 6, 7}, columns[3] = {8, 9, 10}, values[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 42, 0, 35};
int main() {
  keypad_setup(4, 3, rows, columns, values);
  int before = -1;
  while (1) {
    int key = keypad_read();
    if (key != before) print("key %d\\n", key);
    before = key;
    pause(50);
  }
}
""",
}
BINDINGS = {
    "modes": {"P5": "D5"},
    "held": {"P5": "D5", "P6": "D6", "P7": "D7"},
    "keys": {f"rows[{n}]": f"D{n + 4}" for n in range(4)} | {f"columns[{n}]": f"D{n + 8}" for n in range(3)},
}
EDITS = {"modes": ("% 4", "% 5"), "held": ("t < 1200", "t < 1260"), "keys": ("9, 42, 0, 35", "9, 0, 42, 35")}


@pytest.mark.parametrize("name", sample(PROGRAMS, 1))
def test_what_only_such_presses_show_is_noticed(name: str, tmp_path: Path) -> None:
    require_verification("simavr")
    (tmp_path / f"{name}.c").write_text(PROGRAMS[name])
    bound = [word for port, pin in BINDINGS[name].items() for word in ("--bind", f"{port}={pin}")]
    assert run("migrate", tmp_path / f"{name}.c", "-o", tmp_path / "out", *bound).code in (0, 1)
    assert run("verify", tmp_path / "out", "-o", tmp_path / "x.vcd").code == 0
    wires = re.findall(r"\$var wire 1 (\S+) \S+ \$end", (tmp_path / "x.vcd").read_text())
    changes = Counter(re.findall(r"^[01z](\S+)$", (tmp_path / "x.vcd").read_text(), re.MULTILINE))
    assert name != "keys" or min(changes[wire] for wire in wires) > 50, "the trace does not have all that the program drives"
    shutil.copytree(tmp_path / "out", tmp_path / "wrong")
    sketch = tmp_path / "wrong" / name / f"{name}.ino"
    text = sketch.read_text()
    old, new = EDITS[name]
    assert old in text
    sketch.write_text(text.replace(old, new))
    assert run("verify", tmp_path / "wrong").code == 6
