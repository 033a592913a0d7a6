"""Values that flow through many calls: each chain is followed, calls in circles end in time, short circles are read exactly."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from robosmi.transformations.queries.values import DEEPEST, BoundedWalk
from tests.running import run


def pins(source: str, folder: Path) -> set[int | None]:
    """The pins that a program uses, None for unknown ones; computed in its own process, which a time limit can end."""
    path = folder / "robot.c"
    path.write_text(f'#include "simpletools.h"\n{source}int main(){{f0(1);}}\n')
    done = subprocess.run(
        [sys.executable, "-m", "robosmi", "analyse", "--json", str(path)], capture_output=True, text=True, check=False, timeout=60
    )
    assert done.returncode == 0, done.stdout
    return {use["pin"] for unit in json.loads(done.stdout)["result"]["units"] for use in unit["pin_uses"]}


def test_functions_that_depend_on_themselves_on_very_many_ways_end_in_time(tmp_path: Path) -> None:
    n = 60
    declared = "".join(f"void f{i}(int a);\n" for i in range(n))
    calls = "".join(f"void f{i}(int a){{ f{(i * 7 + 1) % n}(a+1); f{(i * 3 + 2) % n}(a*2); high(a); }}\n" for i in range(n))
    assert None in pins(declared + calls, tmp_path)


def test_a_long_chain_of_calls_is_followed_to_its_end(tmp_path: Path) -> None:
    n = 400
    calls = "".join(f"void f{i}(int a){{ f{i + 1}(1-a); }}\n" for i in range(n - 1, -1, -1))
    assert pins(f"void f{n}(int a){{ high(a+4); }}\n{calls}", tmp_path) == {5}


def test_a_chain_of_names_in_nested_expressions_is_followed_to_its_end(tmp_path: Path) -> None:
    names = "".join(f"int x{i} = {'(' * 20}x{i - 1}{' + 1)' * 20};\n" for i in range(1, 60))
    (tmp_path / "robot.c").write_text(f'#include "simpletools.h"\nint x0 = -1177;\n{names}int main() {{ high(x59); }}\n')
    [unit] = run("analyse", "--json", tmp_path / "robot.c").result["units"]
    assert [use["pin"] for use in unit["pin_uses"]] == [3]


def test_an_array_that_is_handed_on_on_very_many_ways_is_one(tmp_path: Path) -> None:
    n = 40
    hands = "".join(f"void g{i}(int *a){{ g{i + 1}(a); g{i + 1}(a); }}\n" for i in range(n - 1, -1, -1))
    assert pins(
        f"int led[] = {{3, 4}};\nvoid g{n}(int *a){{ high(a[1]); g{n}(a); }}\n{hands}void f0(int a){{ g0(led); }}\n", tmp_path
    ) == {4}


def test_numbers_that_grow_without_end_are_given_up(tmp_path: Path) -> None:
    n = 50
    calls = "".join(f"void f{i}(int a){{ f{i + 1}((a+2)*(a+2)); }}\n" for i in range(n - 1, -1, -1))
    assert pins(f"void f{n}(int a){{ high(a); }}\n{calls}", tmp_path) == {None}


def test_short_circles_keep_the_values_that_come_from_outside(tmp_path: Path) -> None:
    source = "void g(int a);\nvoid f0(int a){ g(a+1); high(a); }\nvoid g(int a){ f0(a+1); low(a); }\n"
    assert pins(source, tmp_path) == {None, 1, 2}


def reach(calls: dict[int, list[int]], walk: BoundedWalk[frozenset[int]], node: int) -> frozenset[int]:
    """The nodes of a graph that are reachable from one, found by a bounded walk."""

    def answer() -> frozenset[int]:
        return frozenset({node}).union(*(reach(calls, walk, other) for other in calls[node]))

    return walk.ask(lambda: walk.name(node, node, answer))


def test_a_graph_without_circles_is_walked_once_however_deep() -> None:
    n = 20 * DEEPEST
    calls = {i: [i + 1, i + 1] for i in range(n)} | {n: []}
    assert reach(calls, BoundedWalk(frozenset()), 0) == frozenset(range(n + 1))


def test_a_long_circle_ends() -> None:
    n = 5 * DEEPEST
    assert 0 in reach({i: [(i + 1) % n] for i in range(n)}, BoundedWalk(frozenset()), 0)


def test_an_error_in_an_answer_leaves_the_walk_usable() -> None:
    walk: BoundedWalk[int] = BoundedWalk(0)
    with pytest.raises(ZeroDivisionError):
        walk.ask(lambda: walk.name("a", "a", lambda: 1 // 0))
    assert walk.ask(lambda: walk.name("a", "a", lambda: 7)) == 7
