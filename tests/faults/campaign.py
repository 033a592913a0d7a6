"""A migrated case study that is changed and compared again: its sketch, the scenarios, and the original's runs, made once.

A changed sketch is compiled and run in the scenarios one after the other, first for a part of their time; the first difference
ends it. Scenarios that revealed more changes so far come first, which affects only the speed. `executed_lines` finds the lines
that the right program executes.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import tempfile
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from threading import Lock
from typing import Any

from msgspec.structs import replace

import robosmi
from robosmi.errors import RobosmiError
from robosmi.transformations.chains.stages.models import load_models
from robosmi.transformations.chains.verify import FOLDER, Verified, board_of, stored_original, verify
from robosmi.transformations.verification.bound_devices.played_devices import played
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort, bound_ports, resting_pins
from robosmi.transformations.verification.judgement.after_the_end import simulated_longer
from robosmi.transformations.verification.judgement.scenario_verdicts import Case, hangs_on_a_pass, looked_at_again
from robosmi.transformations.verification.judgement.verdict import verdict_of
from robosmi.transformations.verification.original_side import SourceRuns, run_further, run_source, run_varied
from robosmi.transformations.verification.target_side import LIMIT_S, TargetSide
from robosmi.verify.scenario import Scenario, read_scenario
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.faults.executed_lines import built_for_lines, lines_of, run_addresses

ROOT = Path(__file__).resolve().parents[2]
STUDIES = ("line_follower", "environmental_monitoring", "parking_aid")
FOLDERS = (ROOT / "docs" / "examples", Path(__file__).parent / "studies")
SKETCH_FILES = (".ino", ".h", ".cpp")
_PART = 0.35
"""The part of a scenario's time that is compared first."""
_LEAST_MS = 2_500.0
_FIRST_LOOKS = 4
"""How many scenarios are compared for that part first: what none of these reveals, others seldom do."""
_CORES = os.cpu_count() or 1
_VERIFIER = ("robosmi/verify", "transformations/verification", "platform_repo/simulation", "platform_repo/propeller/host")
_PARTS = (".py", ".cjs", ".toml", ".c", ".h")


@dataclass(frozen=True)
class Outcome:
    """The outcome of comparing a changed sketch.

    Attributes:
        verdict: `different`, `no-difference-found`, `not-decidable`, `not-compiled`, `same machine code`, or `error`.
        told: the first difference in words, or why there is no verdict.
        scenario, channel: where the difference was found.
        functions: the functions that the verdict names for that channel.
    """

    verdict: str
    told: str = ""
    scenario: str = ""
    channel: str = ""
    functions: tuple[str, ...] = ()


@dataclass
class Study:
    """A migrated and verified case study.

    Attributes:
        name: its name.
        out: the output folder of its migration.
        right: the verification of the unchanged sketch.
        cases: the scenarios with the original's runs.
        files: name of each file of the sketch -> its text.
    """

    name: str
    out: Path
    place: Path
    right: Verified
    ports: list[BoundPort]
    cases: list[Case]
    files: Mapping[str, str]
    machine_code: bytes = b""
    _models: Any = field(default=None, repr=False)
    _program: Any = field(default=None, repr=False)
    _more: dict[str, SourceRuns] = field(default_factory=dict, repr=False)
    _lock: Lock = field(default_factory=Lock, repr=False)
    _noticed: Counter[str] = field(default_factory=Counter, repr=False)

    @classmethod
    def made(cls, name: str, place: Path, seed: int = 1, scenarios: Sequence[Path] = ()) -> Study:
        """Migrate a case study and verify it.

        Args:
            name: one of `STUDIES`.
            place: an empty folder.
            seed: of the search for scenarios.
            scenarios: files with scenarios to take instead.
        """
        shutil.copytree(next(folder / name for folder in FOLDERS if (folder / name).is_dir()), place / "input")
        out = place / "out"
        robosmi.migrate([place / "input" / f"{name}.c"], out, history=str(place / "history.sqlite"))
        return cls.of(name, out, place, seed, scenarios)

    @classmethod
    def of(cls, name: str, out: Path, place: Path, seed: int = 1, scenarios: Sequence[Path] = ()) -> Study:
        """A study of a program that was migrated already."""
        right = verify(out, seed=seed, scenarios=scenarios)
        models = load_models(out / "models" / "plan.xmi")
        ports = bound_ports(models.plan, out / "models")
        (place / "source").mkdir()
        program = stored_original(models, place / "source")

        def case(path: Path) -> Case:
            scenario = read_scenario(path, "stored")
            return scenario, run_varied(program, ports, scenario, run_source(program, ports, scenario))

        with ThreadPoolExecutor(_CORES) as pool:
            cases = list(pool.map(case, scenarios or sorted((out / "models" / FOLDER).glob("*.toml"))))
        files = {path.name: path.read_text() for path in sorted((out / name).iterdir()) if path.suffix in SKETCH_FILES}
        study = cls(name, out, place, right, ports, cases, files, _models=models, _program=program)
        with tempfile.TemporaryDirectory() as built:
            report = compile_sketch(out, keep=Path(built))
            assert report.hex is not None
            study.machine_code = report.hex.read_bytes()
        return study

    @property
    def digest(self) -> str:
        """A digest of the program, the scenarios, and the files of `verify`, by which stored results are recognised."""
        told = [*self.files.items(), *((scenario.name, scenario.text()) for scenario, _ in self.cases)]
        verifier = sorted(path for folder in _VERIFIER for path in (ROOT / folder).rglob("*") if path.suffix in _PARTS)
        told += [(path.name, hashlib.sha256(path.read_bytes()).hexdigest()) for path in verifier]
        return hashlib.sha256(repr(told).encode()).hexdigest()[:16]

    def reached(self) -> dict[str, set[int]]:
        """The executed lines: file of the sketch -> lines with an instruction that runs in some scenario."""
        board = board_of(self._models, self.right.compiled)
        with tempfile.TemporaryDirectory(dir=self.place) as place, ThreadPoolExecutor(_CORES) as pool:
            report = built_for_lines(self.out, Path(place))
            devices = [(scenario, played(self.ports, scenario, True)) for scenario, _ in self.cases]
            runs = pool.map(lambda case: run_addresses(report, board, case[0].horizon_ms, case[1]), devices)
            return lines_of(report, set().union(*runs), self.files)

    def judge(self, files: Mapping[str, str], early: bool = True) -> Outcome:
        """Compile the sketch with changed files, and compare it with the original.

        Args:
            files: name of each changed file -> its text.
            early: whether to compare a part of each scenario first, which is faster where a difference is likely.
        """
        with tempfile.TemporaryDirectory(dir=self.place) as place:
            out = Path(place) / "out"
            (out / self.name).mkdir(parents=True)
            shutil.copytree(self.out / "models", out / "models")
            for path in (self.out / self.name).iterdir():
                (out / self.name / path.name).write_text(files.get(path.name, path.read_text()))
            (Path(place) / "built").mkdir()
            report = compile_sketch(out, keep=Path(place) / "built")
            if not report.ok or report.hex is None:
                return Outcome("not-compiled")
            if report.hex.read_bytes() == self.machine_code:
                return Outcome("same machine code")
            side = TargetSide(board_of(self._models, report), report, self.ports)
            try:
                return self._compared(side, early)
            except RobosmiError as error:
                return Outcome("error", error.message)

    def _further(self, scenario: Scenario, runs: SourceRuns) -> SourceRuns:
        """The original's runs of a scenario with the further ones for a second look; made once, for its whole time."""
        with self._lock:
            if scenario.name not in self._more:
                whole = next(each for each, _ in self.cases if each.name == scenario.name)
                self._more[scenario.name] = run_further(self._program, self.ports, whole, runs)
            return self._more[scenario.name]

    def _hangs_on_a_pass(self, scenario: Scenario, runs: SourceRuns, differs_at: Callable[[SourceRuns], float | None]) -> bool:
        return hangs_on_a_pass(self._program, self.ports, scenario, runs, LIMIT_S, differs_at)

    def _compared(self, side: TargetSide, early: bool) -> Outcome:
        doubt = ""
        inorder = sorted(self.cases, key=lambda case: -self._noticed[case[0].name])
        cases = [(replace(s, horizon_ms=max(_LEAST_MS, _PART * s.horizon_ms)), s, runs) for s, runs in inorder]
        for part in (True, False) if early else (False,):
            for short, scenario, runs in cases[:_FIRST_LOOKS] if part else cases:
                if part and short.horizon_ms >= scenario.horizon_ms:
                    continue
                asked = short if part else scenario
                (trace,) = side.run([asked if part else simulated_longer(scenario, runs)])
                if isinstance(trace, RobosmiError):
                    raise trace
                one_thread, at_rest = self._models.plan.concurrency is None, resting_pins(self._models.plan)
                result = verdict_of(asked, runs, trace, self.ports, one_thread, at_rest)
                result = looked_at_again(
                    result, asked, trace, self.ports, one_thread, runs, self._further, at_rest, self._hangs_on_a_pass
                )
                if result.first is not None:
                    first = result.first
                    functions = next((port.functions for port in self.ports if port.title == first.channel), ())
                    told = f"{first.at_ms:.1f} ms, {first.channel}: {first.message}"
                    self._noticed[scenario.name] += 1
                    return Outcome("different", told, scenario.name, first.channel, functions)
                doubt = doubt or ("" if part else result.reason)
        return Outcome("not-decidable", doubt) if doubt else Outcome("no-difference-found")


def executed(lines: Sequence[int], text: str, reached: Mapping[str, set[int]], file: str, files: Mapping[str, str]) -> bool:
    """Whether one of some lines is executed in a scenario; a line of a constant or macro is, if an executed line names it.

    Args:
        lines: the lines.
        text: the file's text.
        reached: file -> its executed lines.
        file: the file's name.
        files: the texts of all files.
    """
    if any(line in reached[file] for line in lines):
        return True
    rows = text.splitlines()
    names = {
        name
        for line in lines
        for name in re.findall(r"^(?:#define (\w+)|(?:static |const |volatile )*\w+ (\w+)(?:\[\w*\])? *[=;])", rows[line - 1])
        for name in name
        if name
    }
    known = {row for name, shown in reached.items() for line in shown for row in files[name].splitlines()[line - 1 : line]}
    for _ in range(3):  # a constant may be named by another
        for other in files.values():
            for row in other.splitlines():
                if found := re.match(r"(?:#define (\w+)|(?:static |const |volatile )*\w+ (\w+)(?:\[\w*\])? *[=;])", row):
                    name = found[1] or found[2]
                    if any(re.search(rf"\b{name}\b", each) for each in known):
                        known.add(row)
    return any(re.search(rf"\b{name}\b", row) for name in names for row in known)
