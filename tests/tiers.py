"""The tiers of tests, by what a test does (plug-in for conftest.py): `check` is quick, `test` all that a pull request needs.

A test that starts another program (a compiler, a simulator, a browser, a Python of its own) or kills one is not in `check`. It
shows in the code that the test can reach: `require_tools` and its kin, `subprocess`, the product's functions that build and run.
Where that code is out of sight, behind the command line for example, `@pytest.mark.processes` says so. A test that starts a
program all the same fails in every tier, so that no tier can rot. `@pytest.mark.measures` is for a test that measures how a cost
grows with large inputs; it is not in `check`, either. `@pytest.mark.exhaustive` is for a test that tries all of what
a sample in another test stands for; only `all` runs it.
"""

from __future__ import annotations

import gc
import inspect
import os
import sys
from collections.abc import Callable, Iterable, Iterator
from types import CodeType, FunctionType, ModuleType
from typing import Any, TypeVar

import pytest
from hypothesis import settings

from robosmi.verify.original_build import build_original, missing_tools
from robosmi.verify.original_run import run_original
from robosmi.verify.simulation import simulate
from robosmi.verify.toolchains.processes import ending_with_us
from robosmi.verify.toolchains.toolchain import compile_sketch
from robosmi.verify.toolchains.tools import run
from tests.processor_seconds import ProcessorSeconds

T = TypeVar("T")

MARKS = {
    "measures": "measures how a cost grows, by many runs with large inputs",
    "processes": "starts other programs, or kills one, in a way that its code does not show",
    "exhaustive": "tries all of what a sample in another test stands for",
}
TIERS = {"check": ("processes", "measures", "exhaustive"), "test": ("exhaustive",), "all": ()}
"""Name of a tier -> the marks of the tests that are not in it."""

EVENTS = frozenset(
    ["subprocess.Popen", "os.exec", "os.fork", "os.forkpty", "os.kill", "os.killpg", "os.posix_spawn", "os.spawn", "os.system"]
)
"""Audit events of Python that a process is started or killed."""
COLLECTED_AFTER = (200_000, 20, 20)
"""Thresholds of the garbage collection while tests run, as a command sets them. With Python's own it would look again and again
at what thousands of tests hold."""
_chosen = "all"  # the tier of this run
_MODULES = ("subprocess", "multiprocessing", "tests.tools")
_STARTING = (compile_sketch, simulate, build_original, missing_tools, run_original, run, ending_with_us)
"""Functions of the product that build or run programs."""
_OF_OS = frozenset(["execv", "execve", "fork", "forkpty", "kill", "killpg", "popen", "posix_spawn", "system"])


def one_of_each(values: Iterable[T], kind: Callable[[T], object]) -> list[Any]:
    """Values for `parametrize`: the first of each kind as it is, the others for the tier `all` alone.

    A tuple holds the values of several arguments.
    """
    kinds = set[object]()
    found: list[Any] = []
    for value in values:
        found.append(_param(value, exhaustive=kind(value) in kinds))
        kinds.add(kind(value))
    return found


def sample(values: Iterable[T], most: int) -> list[Any]:
    """Values for `parametrize`: so many of them, from all over, as they are, the others for the tier `all` alone.

    A tuple holds the values of several arguments.
    """
    every = list(values)
    chosen = {number * len(every) // most for number in range(most)}
    return [_param(value, exhaustive=number not in chosen) for number, value in enumerate(every)]


def _param(value: object, *, exhaustive: bool) -> Any:
    return pytest.param(*(value if type(value) is tuple else (value,)), marks=[pytest.mark.exhaustive] * exhaustive)


def examples(most: int, **more: Any) -> settings:
    """Settings of hypothesis: so many examples in the tier `all`, an eighth of them in the others."""
    return settings(max_examples=most if _chosen == "all" else max(10, most // 8), deadline=None, **more)


def add_option(parser: pytest.Parser) -> None:
    """Add the option that chooses the tier."""
    parser.addoption("--tier", choices=list(TIERS), default="all", help="run the tests of this tier alone (tests/tiers.py)")


def workers(tier: str) -> int:
    """How many processes share out the tests of a tier: where tests wait for compilers and simulators, three for two cores."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return cores if tier == "check" else cores + cores // 2


def join(config: pytest.Config) -> None:
    """Let the tests be chosen by tier, and watch that they start nothing unannounced."""
    global _chosen
    _chosen = config.getoption("tier")
    gc.set_threshold(*COLLECTED_AFTER)
    for mark, meaning in MARKS.items():
        config.addinivalue_line("markers", f"{mark}: {meaning}")
    config.pluginmanager.register(Tiers(_chosen), "tiers")
    config.pluginmanager.register(ProcessorSeconds(_chosen), "processor seconds")


class Tiers:
    """The plug-in.

    Attributes:
        tier: one of `TIERS`.
        running: the test that runs and may not start a process, if there is one.
        started: what it has started all the same.
    """

    def __init__(self, tier: str) -> None:
        self.tier = tier
        self.running: str | None = None
        self.started: str | None = None
        self.reach = Reach()
        sys.addaudithook(self.audit)

    def audit(self, event: str, arguments: tuple[Any, ...]) -> None:
        """Fail the test that starts a process without a mark."""
        if event not in EVENTS or self.running is None or (event == "os.kill" and arguments[1] == 0):
            return
        what = arguments[1] if event == "subprocess.Popen" else arguments
        self.started = (
            f"the test starts or kills a process ({event}: {str(what)[:200]}), which nothing in it shows: "
            "let it call require_tools or require_engine, or mark it with pytest.mark.processes (tests/tiers.py)"
        )
        pytest.fail(self.started, pytrace=True)

    def pytest_collection_modifyitems(self, config: pytest.Config, items: list[pytest.Item]) -> None:
        """Mark the tests that start processes, and leave out those that are not of the tier."""
        for item in items:
            if isinstance(item, pytest.Function) and self.reach.starts_processes(functions_of(item)):
                item.add_marker("processes")
        out = {item for item in items if any(item.get_closest_marker(mark) for mark in TIERS[self.tier])}
        config.hook.pytest_deselected(items=[item for item in items if item in out])
        items[:] = [item for item in items if item not in out]

    def pytest_collection_finish(self) -> None:
        """Take what was collected out of the garbage collector's sight: it would look at all of it again in every tenth test."""
        gc.collect()
        gc.freeze()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """Watch a test that may not start a process, and its fixtures."""
        self.started = None
        self.running = None if item.get_closest_marker("processes") else item.nodeid
        try:
            return (yield)
        finally:
            self.running = None

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_teardown(self) -> None:
        """Stop watching: here fixtures of a whole module or session may end, with a program that another test needed."""
        self.running = None

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_call(self) -> Iterator[None]:
        """Fail a test whose code has caught the failure, or has met it in another thread."""
        yield
        if self.started is not None:
            pytest.fail(self.started, pytrace=False)


def functions_of(item: pytest.Function) -> list[FunctionType]:
    """The functions of a test, of its fixtures and of what it is parametrised with."""
    fixtures = [definition.func for definitions in item._fixtureinfo.name2fixturedefs.values() for definition in definitions]
    given = item.callspec.params.values() if hasattr(item, "callspec") else ()
    return [plain for each in [item.function, *fixtures, *given] for plain in _inside(each, _package(item.module))]


class Reach:
    """What functions of the tests can reach, through other functions and classes of the tests."""

    def __init__(self) -> None:
        self.quiet = set[CodeType]()  # code that starts no process

    def starts_processes(self, functions: Iterable[FunctionType]) -> bool:
        """Whether functions can reach code that starts or kills a process."""
        pending, seen = list(functions), set[CodeType]()
        while pending:
            function = pending.pop()
            if function.__code__ in seen or function.__code__ in self.quiet:
                continue
            seen.add(function.__code__)
            used = _used(function)
            if used is None:
                return True
            pending += used
        self.quiet |= seen
        return False


def _used(function: FunctionType) -> list[FunctionType] | None:
    """The functions of the tests that a function names; None if it starts a process itself."""
    names = set(_names(function.__code__))
    if "os" in names and names & _OF_OS:
        return None
    found = []
    for value in (function.__globals__[name] for name in names if name in function.__globals__):
        parts = [value]
        if isinstance(value, ModuleType):
            if value.__name__ in _MODULES:
                return None
            there = names & ({*vars(value)} | {*getattr(value, "__all__", ())})  # functions of the interface are loaded when used
            parts = [getattr(value, name) for name in there]
        if any(map(_starts, parts)):
            return None
        found += [plain for part in parts for plain in _inside(part, function.__module__.partition(".")[0])]
    return found


def _starts(value: object) -> bool:
    """Whether it is a part of a module that starts processes, or a function of the product that builds or runs programs."""
    return any(value is each for each in _STARTING) or getattr(value, "__module__", None) in _MODULES


def _package(module: ModuleType) -> str:
    return module.__name__.partition(".")[0]


def _inside(value: Any, package: str) -> Iterator[FunctionType]:
    """The functions of the tests, or of this package, that a function, class or object is or has."""
    value = inspect.unwrap(value) if callable(value) else value
    value = getattr(value, "__func__", value)
    kind = value if isinstance(value, type) else type(value)
    if isinstance(value, FunctionType):
        if value.__module__.partition(".")[0] in ("tests", package):
            yield value
    elif kind.__module__.partition(".")[0] in ("tests", package):
        for each in vars(kind).values():
            plain = getattr(each, "__func__", None) or getattr(each, "fget", None) or getattr(each, "func", None) or each
            if isinstance(plain, FunctionType):
                yield plain


def _names(code: CodeType) -> Iterator[str]:
    """The global names and attributes in code, and in the functions within it."""
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _names(constant)
