"""How far apart the two sides of each comparison in a program were: runs tell the least and the most of it."""

from __future__ import annotations

import pytest

from robosmi.verify.original import OriginalRun
from robosmi.verify.original_run import run_original
from robosmi.verify.simulation import DeviceUse
from tests.host_model.bench import built, run

MAIN = "#include <simpletools.h>\nint main() {{ {} }}"


def told(run: OriginalRun) -> set[tuple[float, float]]:
    return set(run.compared.values())


@pytest.mark.parametrize(
    ("body", "distances"),
    [
        ("int t = 5; if (t > 12) high(3);", {(-7, -7)}),
        ("for (int i = 0; i < 10; i++) pause(1);", {(-9, 1)}),  # the compiler asks for i <= 9
        ("int a = -3, b = 4; if (a < b) high(3);", {(7, 7)}),
        ("float v = 1.5; if (v > 2.25) high(3);", {(0.75, 0.75)}),
        ('char c = 200; if (c == 210) print("x");', {(-10, -10)}),
        ("short s = -5; if (s == 3) high(3);", {(-8, -8)}),
        ("long long big = 3000000000LL; if (big == 3000000004LL) high(3);", {(-4, -4)}),
        ("int n = 4; int more = n > 1; high(more);", {(3, 3)}),  # a value that no branch depends on
        (
            "int n = 2; switch (n) { case 1: high(3); break; case 7: low(3); break; case 30: low(4); }",
            {(1, 1), (-5, -5), (-28, -28)},
        ),
        ("pause(1);", set()),
    ],
)
def test_a_run_tells_how_far_its_comparisons_were_from_the_other_way(body: str, distances: set[tuple[float, float]]) -> None:
    assert told(run(MAIN.format(body))) == distances


def test_the_places_of_comparisons_are_the_same_in_each_run() -> None:
    """What is typed is the only thing that moves the distance of the one comparison that depends on it."""
    with built(MAIN.format("int n = getDec(); int x = n * 3 + 7; if (x > 100) high(3); if (CLKFREQ < 5) low(3);")) as program:
        runs = [run_original(program, 1e6, [DeviceUse("typing", {}, {"points": [[100, f"{number}\r"]]})]) for number in (10, 20)]
    first, second = (each.compared for each in runs)
    assert first.keys() == second.keys()
    moved = {place: (first[place], second[place]) for place in first if first[place] != second[place]}
    assert list(moved.values()) == [((-63, -63), (-33, -33))]
