"""Which tests execute which lines of the product (a plug-in for pytest): `python -m pytest -p tests.mutants.reached`.

The lines are measured by coverage.py with each test as a context. Each process of the run writes a file of its own; their names
begin with the path in `ROBOSMI_REACHED`.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import coverage
import pytest

REACHED = "ROBOSMI_REACHED"
"""The environment variable with the path."""
ROOT = Path(__file__).parents[2]
SOURCE = [str(ROOT / "robosmi"), str(ROOT / "transformations")]


def pytest_configure(config: pytest.Config) -> None:
    """Begin to measure."""
    measured = coverage.Coverage(os.environ[REACHED], data_suffix=True, config_file=False, source=SOURCE)
    config.pluginmanager.register(_Measuring(measured))


class _Measuring:
    def __init__(self, measured: coverage.Coverage) -> None:
        self.measured = measured
        measured.start()

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """Measure the lines of a test with its fixtures."""
        self.measured.switch_context(item.nodeid)
        try:
            return (yield)
        finally:
            self.measured.switch_context("")

    def pytest_unconfigure(self) -> None:
        """Write what was measured."""
        self.measured.stop()
        self.measured.save()


def lines_reached(begin: Path) -> dict[Path, dict[int, set[str]]]:
    """Module -> line -> the tests that execute it; `""` stands for its import.

    Args:
        begin: the path that the names of the files begin with.
    """
    found: dict[Path, dict[int, set[str]]] = {}
    for file in sorted(begin.parent.glob(f"{begin.name}.*")):
        data = coverage.CoverageData(str(file))
        data.read()
        for name in data.measured_files():
            lines = found.setdefault(Path(name), {})
            for line, tests in data.contexts_by_lineno(name).items():
                lines.setdefault(line, set()).update(tests)
    return found
