"""Real EMF judges every model that any test wrote, in Java processes on all cores when the tests are done (for conftest.py).

Recorded by `recording/written_models.py`. A model must load with 0 diagnostics, and EMF must write the same bytes for it. The
outcome is one more test of the run, `every written model::real EMF`: failed with the names of the tests that wrote what EMF
does not take, skipped with the reason where EMF is not installed. A run that wrote no model has no such outcome. Processes among
which pytest-xdist shares out the tests record into the folder of the one that started them, which judges.
"""

from __future__ import annotations

import json
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

import pytest

from tests import emf_judge
from tests.recording import written_models

MARKS = {
    "emf_writes_otherwise": "EMF takes the models that the test writes, but writes them differently",
    "emf_objects": "EMF objects to the models that the test writes, which are so on purpose",
}
"""Marks of tests, whose argument is the reason, and what they mean."""
TEST = "every written model::real EMF"


@dataclass(frozen=True)
class Objection:
    """An objection of EMF to a model.

    Attributes:
        model: the file's name.
        tests: the tests that wrote it.
        text: EMF's message, or where the bytes differ.
        place: the folder that contains it.
    """

    model: str
    tests: list[str]
    text: str
    place: Path

    def __str__(self) -> str:
        names = "\n".join(f"  written by {name}" for name in self.tests)
        return f"{self.model} ({self.place})\n{names}\n{self.text}"


def join(config: pytest.Config) -> None:
    """Let the run record and judge; a process of pytest-xdist only records, into the folder that it was given."""
    if hasattr(config, "workerinput"):
        written_models.start()
    else:
        config.pluginmanager.register(Judge(), "written models")


class Judge:
    """The plug-in: records during the run, judges at its end."""

    def __init__(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="robosmi-written-"))
        self.environment = {name: os.environ.get(name) for name in (written_models.FOLDER, "PYTHONPATH")}
        os.environ[written_models.FOLDER] = str(self.folder)
        paths = [str(Path(written_models.__file__).parent), *filter(None, [os.environ.get("PYTHONPATH")])]
        os.environ["PYTHONPATH"] = os.pathsep.join(paths)
        written_models.start()
        self.summary = ""
        self.marked: dict[str, set[str]] = {mark: set() for mark in MARKS}

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Note the tests whose models EMF is known to see otherwise; those that run in other processes, too."""
        for mark, tests in self.marked.items():
            if mark in report.keywords:
                tests.add(report.nodeid)

    @pytest.hookimpl(tryfirst=True)
    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Judge, and report the outcome as that of a test."""
        sets = sorted(self.folder.glob("*/written.json"))
        if not sets:
            return
        start = time.perf_counter()
        outcome, text = "passed", ""
        try:
            emf_judge.require_emf()
            objections = list(judged(self.folder, self.marked))
        except (pytest.skip.Exception, pytest.fail.Exception) as reason:
            outcome, text = "skipped" if isinstance(reason, pytest.skip.Exception) else "failed", str(reason)
        else:
            if objections:
                outcome, text = "failed", "\n\n".join(map(str, objections))
        seconds = time.perf_counter() - start
        told: Any = (__file__, 0, f"Skipped: {text}") if outcome == "skipped" else text
        report = pytest.TestReport(TEST, (TEST, 0, TEST), {}, outcome, told, "call", duration=seconds)  # type: ignore[arg-type]
        session.config.hook.pytest_runtest_logreport(report=report)
        if outcome == "failed":
            session.exitstatus = pytest.ExitCode.TESTS_FAILED
        of_processor = emf_judge.stop()
        self.summary = f"{len(sets)} sets of written models judged by EMF in {seconds:.1f} s"
        self.summary += f" ({of_processor:.0f} s of the processor): {outcome}"

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """Say how many models there were."""
        if self.summary:
            terminalreporter.write_line(self.summary)

    def pytest_unconfigure(self) -> None:
        """Leave nothing behind but what has to be looked at."""
        for name, value in self.environment.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
        if "failed" not in self.summary:
            shutil.rmtree(self.folder)


def judged(folder: Path, marked: Mapping[str, set[str]] = MappingProxyType({})) -> Iterator[Objection]:
    """What EMF has against the models that were recorded in a folder.

    Args:
        folder: where they lie.
        marked: one of `MARKS` -> the tests with it. It holds for a model if all tests that wrote it have it.
    """
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for found in pool.map(partial(_judged_set, folder, marked), sorted(folder.glob("*/written.json"))):
            yield from found


def _judged_set(folder: Path, marked: Mapping[str, set[str]], file: Path) -> list[Objection]:
    """What EMF has against the models that were written together."""
    place = file.parent
    written = json.loads(file.read_text(encoding="utf-8"))
    tests = set((place / "tests.txt").read_text(encoding="utf-8").splitlines())
    apart, refused = (tests <= marked.get(mark, set()) for mark in MARKS)
    if refused:
        return []
    arguments: list[str | Path] = [folder / written["metamodels"] / name for name in written["names"]]
    with tempfile.TemporaryDirectory() as elsewhere:
        for number, (uri, text) in enumerate(written["elsewhere"].items()):
            lies = Path(elsewhere) / f"{number}.ecore"
            lies.write_text(text, encoding="utf-8")
            arguments += ["--map", uri, lies]
        texts = {name: objection(arguments, place / name, apart) for name in written["models"]}
    return [Objection(name, sorted(tests), text, place) for name, text in texts.items() if text]


def objection(arguments: list[str | Path], model: Path, is_apart: bool) -> str:
    """What EMF has against a model; nothing if it takes it and, unless it is apart, writes the same bytes."""
    saved = model.with_name(f".{model.name}.saved")
    text, ok = emf_judge.ask(*arguments, model, "--resave", saved, "-q", "--keep")
    if not ok:
        return text
    ours, emfs = model.read_bytes(), saved.read_bytes()
    if ours == emfs or is_apart:
        return ""
    pairs = zip(ours.split(b"\n"), emfs.split(b"\n"), strict=False)
    number, (our, emf) = next(((n, p) for n, p in enumerate(pairs, 1) if p[0] != p[1]), (0, (b"", b"")))
    return f"EMF writes line {number} differently:\n  ours {our.decode()}\n  EMF  {emf.decode(errors='replace')}"


def main() -> int:
    """`python -m tests.written_models_judge FOLDER`: judge what was recorded, again."""
    found = list(judged(Path(sys.argv[1])))
    print("\n\n".join(map(str, found)) or "nothing")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
