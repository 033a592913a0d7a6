"""The tiers of tests: what decides where a test belongs, and that a test which starts a process unannounced fails."""

from __future__ import annotations

import os
import re
import resource
import subprocess
import sys
from collections.abc import Callable
from functools import cached_property, partial
from pathlib import Path
from types import FunctionType
from typing import ClassVar

import pytest

import robosmi
from robosmi.verify import simulation
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests import emf_judge, running, tools
from tests.processor_seconds import ProcessorSeconds
from tests.tiers import Reach, one_of_each, sample

ROOT = Path(__file__).parents[1]


class Bench:
    @cached_property
    def engine(self) -> object:
        return subprocess.run(["true"], check=True)

    @staticmethod
    def named() -> str:
        return "bench"


class Quiet:
    def text(self) -> str:
        return "quiet"


def through_a_helper() -> None:
    needs_a_compiler()


def needs_a_compiler() -> None:
    tools.require_tools("gcc")


def judged_by_emf() -> None:
    emf_judge.look([], ROOT)


def of_the_product() -> None:
    compile_sketch(ROOT)


def of_the_interface() -> None:
    robosmi.compile_sketch(ROOT)


def of_a_module_of_the_product() -> None:
    partial(simulation.simulate)


def within_a_function() -> Callable[[], int]:
    return lambda: os.fork()


def with_an_object() -> str:
    return Bench.named()


def of_the_command_line() -> None:
    running.run("--version")


def with_a_quiet_object() -> str:
    return Quiet().text() + os.fspath(ROOT)


@pytest.mark.parametrize(
    "function",
    [
        through_a_helper, needs_a_compiler, judged_by_emf, of_the_product, of_the_interface, of_a_module_of_the_product,
        within_a_function, with_an_object,
    ],
)  # fmt: skip
def test_what_can_reach_a_process_is_found(function: FunctionType) -> None:
    assert Reach().starts_processes([function])


@pytest.mark.parametrize("function", [of_the_command_line, with_a_quiet_object])
def test_what_reaches_no_process_is_left(function: FunctionType) -> None:
    assert not Reach().starts_processes([function])


CONFTEST = """
from tests import tiers

pytest_addoption = tiers.add_option
pytest_configure = tiers.join
"""
TESTS = """
import os, subprocess, threading

import pytest

run = vars(subprocess)["run"]
call = [lambda: run(["true"], check=True)]  # nothing shows that it starts a process


@pytest.fixture
def started():
    subprocess.run(["true"], check=True)


@pytest.fixture(scope="session")
def browser():
    process = subprocess.Popen(["sleep", "60"])
    yield
    process.terminate()
    process.wait()


def test_with_a_browser(browser): pass
def test_shown(): subprocess.run(["true"], check=True)
def test_of_a_fixture(started): pass
@pytest.mark.processes
def test_marked(): call[0]()
@pytest.mark.exhaustive
def test_exhaustive(): pass
def test_unannounced(): call[0]()
def test_caught():
    try: call[0]()
    except BaseException: pass
def test_kill_of_nothing(): getattr(os, "kill")(os.getpid(), 0)
def test_plain(): pass  # the last one, after which the browser ends
"""


@pytest.mark.parametrize(
    ("tier", "run"),
    [
        ("check", {"plain", "kill_of_nothing", "unannounced", "caught"}),
        ("test", {"plain", "kill_of_nothing", "unannounced", "caught", "shown", "with_a_browser", "of_a_fixture", "marked"}),
        (
            "all",
            {
                "plain",
                "kill_of_nothing",
                "unannounced",
                "caught",
                "shown",
                "with_a_browser",
                "of_a_fixture",
                "marked",
                "exhaustive",
            },
        ),
    ],
)
def test_a_tier_has_its_tests_and_fails_those_that_start_processes_unannounced(tier: str, run: set[str], tmp_path: Path) -> None:
    (tmp_path / "tests").mkdir()
    (tmp_path / "conftest.py").write_text(CONFTEST)
    (tmp_path / "tests" / "test_them.py").write_text(TESTS)
    command = [sys.executable, "-m", "pytest", "--import-mode=importlib", "--strict-markers", "-rA", "--tier", tier, "tests"]
    done = subprocess.run(
        command, cwd=tmp_path, env=os.environ | {"PYTHONPATH": str(ROOT)}, capture_output=True, text=True, check=False
    )
    outcomes = {
        line.split("::test_")[1].split()[0]: line.split()[0] for line in done.stdout.splitlines() if line.startswith(STATES)
    }
    assert {name for name, state in outcomes.items() if state != "PASSED"} == {"unannounced", "caught"}
    assert outcomes.keys() == run
    assert "starts or kills a process (subprocess.Popen: ['true'])" in done.stdout


STATES = ("PASSED ", "FAILED ", "ERROR ")


def test_a_sample_comes_from_all_over_and_the_others_are_exhaustive() -> None:
    chosen = sample([("uno", number) for number in range(6)], 2)
    assert [each.values for each in chosen if not each.marks] == [("uno", 0), ("uno", 3)]
    assert [each.values for each in chosen] == [("uno", number) for number in range(6)]
    assert {mark.name for each in chosen for mark in each.marks} == {"exhaustive"}


def test_one_of_each_kind_is_a_sample_and_the_others_are_exhaustive() -> None:
    chosen = one_of_each([("uno", 1), ("mega", 2), ("nano", 3)], lambda pair: pair[0] == "mega")
    assert [each.values for each in chosen] == [("uno", 1), ("mega", 2), ("nano", 3)]
    assert [[mark.name for mark in each.marks] for each in chosen] == [[], [], ["exhaustive"]]


@pytest.mark.parametrize("processes", [(), ("-n", "2")])
def test_a_run_tells_no_more_processor_seconds_than_it_took(processes: tuple[str, ...], tmp_path: Path) -> None:
    (tmp_path / "tests").mkdir()
    (tmp_path / "conftest.py").write_text(CONFTEST)
    (tmp_path / "tests" / "test_it.py").write_text("def test_sum(): assert sum(range(30_000_000))\n")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "pytest", "--import-mode=importlib", "--strict-markers", *processes, "tests"]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    took = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    told = re.search(r"^(\d+) processor seconds for 1 tests", done.stdout, re.MULTILINE)
    assert told is not None
    assert took / 2 - 1 < int(told[1]) < took + 1


def test_a_run_tells_the_processor_seconds_of_its_tests_and_of_those_in_other_processes() -> None:
    class Node:
        workeroutput: ClassVar = {"processor_seconds": {"seconds": {"test_a": 3.0, "test_b": 0.5}, "total": 4.5, "tests": 7}}

    class Reporter:
        def __init__(self) -> None:
            self.lines: list[str] = []

        def write_line(self, line: str) -> None:
            self.lines.append(line)

    seconds, reporter = ProcessorSeconds("check"), Reporter()
    for node in (Node(), Node(), object()):  # the last one has crashed
        seconds.pytest_testnodedown(node)
    seconds.pytest_terminal_summary(reporter)  # type: ignore[arg-type]
    assert reporter.lines == ["9 processor seconds for 14 tests of the tier check", "     6.0 test_a"]
