"""Whole programs of the source platform, one folder each in `programs`: moved, compiled and run, and what they show is read.

A folder has the program (`NAME.c`, or several files), its pin table (`pins.csv`), its project file (`robosmi.toml`), what its
inputs show over time (`scenario.toml`) and `expected.toml`: what comes out by the documentation of the source's library (see
`shown`), and under `wrong` how the program (`old`, `new`) or an adapter (`header/name`) is spoilt, which must be noticed. Nothing
that is expected was copied from a run.
"""

from __future__ import annotations

import shutil
import tempfile
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

from robosmi.base.data_text import toml_of
from robosmi.plugins import content
from robosmi.verify.simulation import PinTrace
from tests.adapters.bench import broken, pieces
from tests.families.shown import faults
from tests.running import run

PROGRAMS = Path(__file__).parent / "programs"
CASES = sorted(path for path in PROGRAMS.iterdir() if path.is_dir())
ADAPTERS = "adapters.h"


class NotMadeError(Exception):
    """A case cannot be migrated or compiled, so that nothing is judged."""


class Spoilt(NamedTuple):
    """A fault put into a case: its name, the file, the text that is replaced, and the new text."""

    why: str
    file: str
    old: str
    new: str


@dataclass(frozen=True)
class Case:
    """A program with its expected behaviour."""

    folder: Path

    @property
    def family(self) -> str:
        """The family of adapters that the program tests."""
        return self.folder.name.split("_")[0]

    @cached_property
    def expected(self) -> Any:
        """The contents of `expected.toml`."""
        return toml_of((self.folder / "expected.toml").read_bytes())

    def wrong(self) -> list[Spoilt]:
        """The faults of the case; an adapter is broken in each way that makes sense for it."""
        known = {f"{piece.header}/{piece.name}": piece for piece in pieces()}
        found: list[Spoilt] = []
        for each in self.expected["wrong"]:
            if "adapter" in each:
                piece = known[each["adapter"]]
                ways = broken(piece).items()
                found += [Spoilt(f"{each['adapter']} {way}", ADAPTERS, piece.text, text) for way, text in ways]
            else:
                found.append(Spoilt(each["why"], f"{self.folder.name}.c", each["old"], each["new"]))
        return found

    def faults(self, spoilt: Spoilt | None = None) -> list[str]:
        """The differences between a run and the expected behaviour; empty if there are none.

        Raises:
            NotMadeError: the program cannot be migrated or compiled, or the text to replace is not there.
        """
        return faults(self.expected, self._run(spoilt))

    def _run(self, spoilt: Spoilt | None) -> PinTrace:
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place) / self.folder.name
            shutil.copytree(self.folder, folder)
            sources = sorted(folder.glob("*.c"), key=lambda path: (path.stem != self.folder.name, path.name))
            if spoilt is not None and spoilt.file != ADAPTERS:
                _spoil(folder / spoilt.file, spoilt)
            moved = run("migrate", *sources, "-o", folder / "out", "--yes")
            if moved.code not in (0, 1):
                raise NotMadeError(moved.err)
            if spoilt is not None and spoilt.file == ADAPTERS:
                _spoil(folder / "out" / self.folder.name / ADAPTERS, spoilt)
            done = content("chain", "simulate")(folder / "out", scenario=folder / "scenario.toml")
            ours = [each for each in done.findings if each.location is not None and each.location.path.endswith(ADAPTERS)]
            if done.trace is None or (spoilt is None and ours):
                raise NotMadeError([f"{each.location}: {each.message}" for each in done.compiled.diagnostics][:5])
            trace: PinTrace = done.trace
            return trace


def _spoil(path: Path, spoilt: Spoilt) -> None:
    text, old = path.read_text(), spoilt.old.strip()
    if old not in text:
        raise NotMadeError(f"{path.name} has no such text: {old}")
    path.write_text(text.replace(old, spoilt.new, 1))
