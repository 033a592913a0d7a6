"""Records which tests run which lines of the product (a plug-in of pytest, for `python -m tests.mutants`).

Only a test that runs a changed line can notice the change, but for what the product computes once in a process and then holds:
the line runs in the first test alone there, and others of the same module see what came of it.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from coverage import Coverage, CoverageData

RECORDED = "ROBOSMI_REACHED"
"""The environment variable that names the recording's folder: `modules.json` lists the modules, and each process adds data."""
DATA = "reached"


def start(folder: Path, paths: list[Path]) -> None:
    """Prepare a folder for the recording of some modules."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "modules.json").write_text(json.dumps([os.path.realpath(path) for path in paths]), encoding="utf-8")


def pytest_configure(config: pytest.Config) -> None:
    """Record what runs in this process."""
    folder = Path(os.environ[RECORDED])
    included = json.loads((folder / "modules.json").read_text(encoding="utf-8"))
    recorder = Coverage(data_file=str(folder / DATA), data_suffix=True, include=included, config_file=False)
    recorder.start()
    config.pluginmanager.register(_Recorder(recorder), "reached")


class _Recorder:
    def __init__(self, coverage: Coverage) -> None:
        self.coverage = coverage

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """Name the lines that run after the test that runs them."""
        self.coverage.switch_context(item.nodeid)
        try:
            return (yield)
        finally:
            self.coverage.switch_context("")

    def pytest_unconfigure(self) -> None:
        """Store what this process has recorded."""
        self.coverage.stop()
        self.coverage.save()


def tests_of_lines(folder: Path, module: Path) -> dict[int, set[str]]:
    """Line of a module -> the tests that ran it, in a recording that has ended."""
    found: dict[int, set[str]] = {}
    for file in folder.glob(f"{DATA}.*"):
        data = CoverageData(str(file))
        data.read()
        for line, tests in data.contexts_by_lineno(os.path.realpath(module)).items():
            found.setdefault(line, set()).update(test for test in tests if test)
    return found
