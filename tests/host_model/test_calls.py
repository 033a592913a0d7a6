"""Which calls of library functions a program makes: names, places and times, wherever in the library time passes."""

from __future__ import annotations

import pytest

from robosmi.verify.original_calls import library_calls
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


def test_only_the_part_that_is_asked_for_is_told() -> None:
    with built(PROGRAM) as program:
        assert next(call.function for call in library_calls(program, (), 50_000.0, 130_000.0)) == "low"
        assert library_calls(program, (), 1e6, 2e6) == []
