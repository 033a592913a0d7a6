"""Which calls of library functions a program makes: names, places and times, wherever in the library time passes."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.transformations.verification.originals import original_program
from robosmi.verify.host_model import load_host_model
from robosmi.verify.host_original import library_calls
from robosmi.verify.original_coverage import coverage
from robosmi.verify.original_run import run_original
from tests.host_model.bench import built
from tests.tools import require_tools

PROGRAM = """#include "simpletools.h"
void blink(int pin) {
  high(pin);
  pause(100);
  low(pin);
}
void other(void *unused) {
  pause(50);
  toggle(5);
}
int main() {
  pause(10);
  blink(4);
  cog_run(other, 40);
  waitcnt(CNT + CLKFREQ / 10);
  print("done\\n");
}
"""


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "objcopy", "addr2line")


def test_calls_are_told_with_name_line_and_time() -> None:
    with built(PROGRAM) as program:
        calls = library_calls(program, (), 0.0, 1e6)
    assert [(call.function.removeprefix("__builtin_propeller_"), call.line) for call in calls if call.function != "cog_run"] == [
        ("pause", 12), ("high", 3), ("pause", 4), ("low", 5), ("waitcnt", 15), ("pause", 8), ("toggle", 9), ("print", 16)
    ]  # fmt: skip
    assert {call.file.rpartition("/")[2] for call in calls} == {"program.c"}
    at_ms = {(call.function, call.line): round(call.at_us / 1000) for call in calls}
    assert (at_ms["high", 3], at_ms["low", 5], at_ms["toggle", 9]) == (10, 110, 160)


HEADERS = {
    "inner.h": '#include "simpletools.h"\n\n\n\nvoid inner(void) {\n  high(4);\n  if (input(3))\n    low(4);\n}\n',
    "outer.h": '#include "inner.h"\n\nvoid outer(void) {\n  inner();\n  pause(5);\n}\n',
    "second.h": '#include "inner.h"\nvoid second(void) { toggle(6); }\n',
}
"""Headers with functions, one of which the other includes."""

NESTED = {
    "outer first": ('#include "outer.h"\nint main() {\n  outer();\n  toggle(5);\n}\n', {"toggle": ("program.c", 4)}),
    "inner first": (
        '#include "simpletools.h"\n#include "inner.h"\n#include "outer.h"\nint main() {\n  outer();\n}\n', {}
    ),
    "both": (
        '#include "outer.h"\n#include "second.h"\nint main() {\n  outer();\n  second();\n}\n', {"toggle": ("second.h", 3)}
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", NESTED)
def test_calls_and_lines_in_headers_of_headers_are_told_where_they_stand(case: str, tmp_path: Path) -> None:
    for name, text in HEADERS.items():
        (tmp_path / name).write_text(f"#pragma once\n{text}")
    text, more = NESTED[case]
    (tmp_path / "program.c").write_text(text)
    (tmp_path / "place").mkdir()
    program = original_program([tmp_path / "program.c"], load_host_model("propeller"), tmp_path / "place")
    calls = library_calls(program, (), 0.0, 1e6)
    told = {call.function: (call.file.rpartition("/")[2], call.line) for call in calls}
    assert told == {"high": ("inner.h", 7), "input": ("inner.h", 8), "pause": ("outer.h", 6), **more}
    covered = coverage(program, [run_original(program, 1e6).counts])
    lines = {(Path(file).name, line): count for (file, line), count in covered.lines.items()}
    assert {place: count for place, count in lines.items() if place[0] == "inner.h"} == {
        ("inner.h", 6): 1, ("inner.h", 7): 1, ("inner.h", 8): 1, ("inner.h", 9): 0, ("inner.h", 10): 1
    }  # fmt: skip
    assert {line: count for (name, line), count in lines.items() if name == "outer.h"} == {4: 1, 5: 1, 6: 1, 7: 1}
    assert {(Path(file).name, line) for file, line, _ in covered.branches} == {("inner.h", 8)}


def test_only_the_part_that_is_asked_for_is_told() -> None:
    with built(PROGRAM) as program:
        assert next(call.function for call in library_calls(program, (), 50_000.0, 130_000.0)) == "low"
        assert library_calls(program, (), 1e6, 2e6) == []
