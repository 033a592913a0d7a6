"""Migrate every program of a corpus without a drawing, generate it again from its plan, compile it, print what became of them.

The figures of adapters are over calls of functions that the platform has and whose header the target can serve.

Usage: python -m tests.corpus.migrate_corpus FOLDER [--keep OUT] [--only TEXT] [--target NAME] [--part K/N] [--workers N]. A
program is a .c file with a main; the .c files beside it without one belong to it only if its folder has no other program.
`--part 2/8` takes the second of eight parts. Run by hand, and by `test_corpus.py` where ROBOSMI_CORPUS names such a folder.
A traceback, ModelError or InternalError here is a fault of ours.
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import tempfile
import traceback
from collections import Counter
from collections.abc import Iterable, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from robosmi.api import MigratedSketch
from robosmi.diagnostics import Severity
from robosmi.errors import InternalError, ModelError, RobosmiError
from robosmi.metamodels import ccode
from robosmi.transformations.t2m.c_source.side_file import adjacent_project, read_side

_MAIN = re.compile(rb"^[^\S\n]*(?:[A-Za-z_]\w*\s+)*(?:int|void)\s+main\s*\(", re.MULTILINE)
_QUOTED = re.compile(r"['‘][^'’]*['’]")


@dataclass(frozen=True)
class Outcome:
    """The result for one program.

    Attributes:
        path: its source file, relative to the corpus.
        state: compiled, not-compiled, refused (a message of ours that names the user's fault) or crashed.
        errors, warnings: messages of the compiler about the sketch, each once.
        message: why it was refused or crashed.
        lost: elements without a disposition, or with more than one.
        calls: `header/function` of the platform that the target can serve -> number of calls.
        bodies: the same for calls that reach an adapter with a body.
        reasons: `header/function` -> why it has none.
        missing: functions of the program that no file of the sketch has.
        fits_on: where the sketch is too big for the board, one that it fits, or `none`.
        untrue: sums of the report, its JSON and the plan that do not add up, and a first screen that is too long.
        valid: whether gcc takes the source with the platform's real headers, and there is a main; None where these or gcc are
            not there.
        refusal: gcc's first error for a source that it refuses.
        told: the rules of the plan that predict that a compiler refuses it.
    """

    path: str
    state: str
    errors: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    message: str = ""
    lost: int = 0
    calls: Mapping[str, int] = field(default_factory=dict)
    bodies: Mapping[str, int] = field(default_factory=dict)
    reasons: Mapping[str, str] = field(default_factory=dict)
    missing: tuple[str, ...] = ()
    fits_on: str = ""
    untrue: tuple[str, ...] = ()
    valid: bool | None = None
    refusal: str = ""
    told: tuple[str, ...] = ()

    @property
    def of_adapters(self) -> list[str]:
        """The compiler's messages about the adapters' text."""
        return [said for said in (*self.errors, *self.warnings) if said.startswith("adapters.h:")]


@dataclass
class Table:
    """The outcomes of a run."""

    outcomes: list[Outcome] = field(default_factory=list)

    def count(self, state: str) -> int:
        """How many programs ended in a state."""
        return sum(o.state == state for o in self.outcomes)

    def crashed(self) -> list[Outcome]:
        """The programs that showed a fault of ours."""
        return [o for o in self.outcomes if o.state == "crashed"]

    @property
    def share(self) -> float:
        """How many of the calls that the target can serve reach a body."""
        return sum(sum(o.bodies.values()) for o in self.outcomes) / max(sum(sum(o.calls.values()) for o in self.outcomes), 1)

    def _adapters(self) -> list[str]:
        calls, missing, reasons = Counter[str](), Counter[str](), dict[str, str]()
        for outcome in self.outcomes:
            calls.update(outcome.calls)
            missing.update({key: count - outcome.bodies.get(key, 0) for key, count in outcome.calls.items()})
            reasons.update(outcome.reasons)
        of_adapters = [said for o in self.outcomes for said in o.of_adapters]
        bodies = calls.total() - missing.total()
        return [
            f"calls that the target can serve: {calls.total()}, {bodies} with a body ({self.share:.1%}); "
            f"messages located in adapters: {len(of_adapters)}",
            *(f"  {said}" for said in sorted(set(of_adapters))),
            *(f"  {n:4} without a body: {key}: {reasons.get(key, '')}" for key, n in missing.most_common() if n),
        ]

    def _valid(self) -> list[str]:
        """How many of the programs that gcc accepts with the platform's headers become a sketch that compiles."""
        valid = [o for o in self.outcomes if o.valid]
        if not valid:
            return []
        compiled = sum(o.state == "compiled" for o in valid)
        return [
            f"of {len(valid)} programs that gcc -m32 takes, {compiled} compile ({100 * compiled / len(valid):.1f}%)",
            *(f"  not taken by gcc, {o.state}: {o.path}: {o.refusal}" for o in self.outcomes if o.valid is False),
        ]

    def _told(self) -> list[str]:
        """How often the plan predicted a refusal of sketches that a compiler refuses, and of others."""
        refused = [o for o in self.outcomes if o.state == "not-compiled"]
        untold = [o for o in refused if not o.told]
        false = [o for o in self.outcomes if o.state == "compiled" and "RS337" in o.told]
        return [
            f"sketches that do not compile: {len(refused)}, told before by a task {len(refused) - len(untold)}; "
            f"sketches that compile and of which RS337 says that they do not: {len(false)}",
            *(f"  not told: {o.path}" for o in untold),
            *(f"  told and compiles: {o.path}" for o in false),
        ]

    def lines(self) -> list[str]:
        """The table as text."""
        migrated = self.count("compiled") + self.count("not-compiled")
        total = len(self.outcomes)
        lines = [
            f"programs {total}: migrated {migrated}, compiled {self.count('compiled')}, "
            f"refused {self.count('refused')}, crashed {self.count('crashed')}",
            f"warnings in the sketch: {sum(len(o.warnings) for o in self.outcomes)} "
            f"in {sum(bool(o.warnings) for o in self.outcomes)} programs; "
            f"elements without exactly one verdict: {sum(o.lost for o in self.outcomes)}",
            *self._adapters(),
            *self._valid(),
            *self._told(),
            f"functions of programs that are not in their sketch: {sum(len(o.missing) for o in self.outcomes)}",
            *(f"  too big for the board, fits on {o.fits_on}: {o.path}" for o in self.outcomes if o.fits_on),
        ]
        for title, kinds in (("errors", [o.errors for o in self.outcomes]), ("warnings", [o.warnings for o in self.outcomes])):
            counts = Counter(_QUOTED.sub("'...'", m.partition(": ")[2]) for messages in kinds for m in messages)
            lines += [f"{title} by kind:", *(f"  {count:4} {kind}" for kind, count in counts.most_common(40))] if counts else []
        for outcome in sorted(self.outcomes, key=lambda o: o.path):
            if outcome.state != "compiled":
                lines.append(f"{outcome.state}: {outcome.path} {outcome.message}".rstrip())
                lines += [f"    {error}" for error in outcome.errors[:6]]
        return lines


def programs(folder: Path) -> list[tuple[Path, ...]]:
    """The programs of a folder: the file with main first, then the units that belong to it."""
    mains: dict[Path, list[Path]] = {}
    others: dict[Path, list[Path]] = {}
    for path in sorted(folder.rglob("*.c")):
        (mains if _MAIN.search(path.read_bytes()) else others).setdefault(path.parent, []).append(path)
    return [
        (path, *(others.get(parent, []) if len(paths) == 1 and not path.with_suffix(".side").is_file() else []))
        for parent, paths in mains.items()
        for path in paths
    ]


@cache
def _gcc(corpus: Path) -> list[str] | None:
    """The gcc command for a program with the platform's headers; None if these or gcc are missing."""
    own = next((path.parent for path in sorted(corpus.rglob("lib/include/stdio.h"))), None)
    if own is None or shutil.which("gcc") is None:
        return None
    libraries = sorted({path.parent for path in corpus.rglob("Simple Libraries/**/*.h")})
    names = ("__propeller__", "__PROPELLER__", "__PROPELLER_CMM__", "__PROPELLER_32BIT_DOUBLES__")
    flags = ["-m32", "-std=gnu99", "-fsyntax-only", "-w", "-nostdinc", *(f"-D{name}" for name in names)]
    return ["gcc", *flags, f"-I{own}", *(f"-I{folder}" for folder in libraries)]


def refusal(files: tuple[Path, ...], corpus: Path) -> str | None:
    """gcc's first error for a program, empty if it accepts it; None if gcc cannot be run or the text has no main.

    A `.side` file gives the folders of a program's own headers.
    """
    call = _gcc(corpus)
    if call is None:
        return None
    side = adjacent_project(str(files[0]))
    more = [f"-I{folder}" for folder in read_side(side).include_dirs] if side else []
    said = subprocess.run([*call, *more, *map(str, files)], capture_output=True, text=True, check=False, errors="replace")
    if said.returncode:
        return next((line for line in said.stderr.splitlines() if "error" in line), "error").partition("error: ")[2]
    plain = [option for option in call if option != "-fsyntax-only"]
    text = subprocess.run([*plain, *more, "-E", "-P", str(files[0])], capture_output=True, check=False).stdout
    return "" if re.search(rb"\bmain\s*\([^;]*?\)\s*\{", text) else "there is no main"


def outcome(files: tuple[Path, ...], corpus: Path, output: Path, target: str | None = None) -> Outcome:
    """Migrate and compile one program, for the default target if none is given."""
    import robosmi
    from robosmi.metamodels import migration
    from robosmi.transformations.queries.plans.plan import header_name
    from tests.transformations.m2t.truth import verdict_faults

    path = str(files[0].relative_to(corpus))
    reason = refusal(files, corpus)
    taken: dict[str, Any] = {"valid": None if reason is None else not reason, "refusal": reason or ""}
    try:
        made = robosmi.migrate(list(files), output, target=target)
        again = robosmi.generate_sketch(output / "models" / "plan.xmi", output.with_name(f"{output.name}-again"))
        if again.contents != made.contents:
            return Outcome(path, "crashed", message="the stored plan gives another sketch", **taken)
        if robosmi.migrate(list(files), output, target=target).contents != made.contents:
            return Outcome(path, "crashed", message="a second run gives another sketch", **taken)
    except (InternalError, ModelError) as error:
        return Outcome(path, "crashed", message=str(error), **taken)
    except RobosmiError as error:
        return Outcome(path, "refused", message=str(error), **taken)
    except Exception:
        return Outcome(path, "crashed", message=traceback.format_exc(), **taken)
    report = robosmi.compile_sketch(output)
    said: dict[Severity, list[str]] = {s: [] for s in Severity}
    for finding in report.diagnostics:
        place = f"{Path(finding.location.path).name}:{finding.location.line}: " if finding.location else "?: "
        if finding.rule in ("RS801", "RS802", "RS803", "RS804"):
            said[finding.severity].append(place + finding.message)
    errors, warnings = tuple(dict.fromkeys(said[Severity.error])), tuple(dict.fromkeys(said[Severity.warning]))
    plan = made.models.plan
    served = {
        f"{header_name(use)}/{use.name}": use
        for use in plan.adapterUses
        if use.function is not None and use.status is not migration.AdapterStatus.unsupported
    }
    return Outcome(
        path,
        "compiled" if report.ok else "not-compiled",
        errors,
        warnings,
        lost=len(verdict_faults(plan)),
        calls={key: len(use.calls) for key, use in served.items()},
        bodies={key: len(use.calls) for key, use in served.items() if use.adapter is not None},
        reasons={key: str(use.reason) for key, use in served.items() if use.reason},
        missing=_missing(made),
        fits_on=(report.fits_on or "none") if report.ok and not report.fits else "",
        untrue=_untrue(made),
        told=tuple(sorted({str(f.rule) for f in plan.findings if f.rule in ("RS101", "RS312", "RS337")})),
        **taken,
    )


def _untrue(made: MigratedSketch) -> tuple[str, ...]:
    """The sums of a report that do not add up, and whether its first screen is longer than one."""
    from robosmi.transformations.m2t.first_screen import LINES
    from tests.transformations.m2t.truth import report_faults

    report = made.contents[f"{made.models.plan.name}/MIGRATION.md"].decode()
    first = re.split(r"^## (?:Findings|[\w ]+, continued)$", report, maxsplit=1, flags=re.MULTILINE)[0].rstrip().splitlines()
    said = made.result()["plan"]
    assert isinstance(said, dict)
    faults = report_faults(made.models.plan, said, report)
    return (*faults, *([f"first screen: {len(first)} lines"] if len(first) > LINES else []))


def _missing(made: MigratedSketch) -> tuple[str, ...]:
    """The functions of a program that no file of its sketch defines, under their old or new name."""
    plan = made.models.plan
    text = "".join(data.decode("utf-8", "replace") for name, data in made.contents.items() if name.startswith(f"{plan.name}/"))
    renamed = {d.element.name: d for d in plan.dispositions if isinstance(d.element, ccode.Function) and "rename" in d.rules}
    found = []
    units = plan.program.units if plan.program is not None else ()
    for function in (d for unit in units for d in unit.declarations if isinstance(d, ccode.Function)):
        changes = renamed[function.name].changes if function.name in renamed else ()
        names = {str(function.name), *(str(change.replacement) for change in changes)}
        if function.definition and function.name != "main" and not any(re.search(rf"\b{n}\s*\(", text) for n in names):
            found.append(str(function.name))
    return tuple(found)


def run(
    corpus: Path, keep: Path | None = None, only: str = "", workers: int = 2, target: str | None = None, part: str = "1/1"
) -> Table:
    """Migrate and compile all programs of a corpus.

    Args:
        corpus: the folder.
        keep: where sketches are kept; a temporary folder if None.
        only: programs whose path contains this.
        workers: processes.
        target: the target; the default one if None.
        part: `K/N` is the K-th of N parts of these programs.
    """
    first, _, step = part.partition("/")
    with tempfile.TemporaryDirectory() as scratch:
        chosen: Iterable[tuple[Path, ...]] = [p for p in programs(corpus) if only in str(p[0])][int(first) - 1 :: int(step)]
        base = keep or Path(scratch)
        with ProcessPoolExecutor(workers) as pool:
            jobs = [pool.submit(outcome, files, corpus, base / f"{number:03}", target) for number, files in enumerate(chosen)]
            return Table([job.result() for job in jobs])


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("corpus", type=Path)
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--target")
    parser.add_argument("--part", default="1/1", help="K/N: the K-th of N parts")
    parser.add_argument("--workers", type=int, default=2)
    asked = parser.parse_args()
    print("\n".join(run(asked.corpus, asked.keep, asked.only, asked.workers, asked.target, asked.part).lines()))


if __name__ == "__main__":
    main()
