"""Compares the answers of every query about a program read on demand and about its stored model.

python -m tests.fuzz.two_views     all C programs of the tests and examples, and those below ROBOSMI_CORPUS
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from robosmi.diagnostics import Finding
from robosmi.errors import SourceError
from robosmi.metamodels import ccode
from robosmi.transform import Trace
from robosmi.transformations.constraints.code import code as constraints
from robosmi.transformations.knowledge.adapters.adapter_index import adapter_index
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.target_platform import target_facts
from robosmi.transformations.m2m.adapters.adapter_choice import AdapterChoice
from robosmi.transformations.m2m.language.cpp_incompatibilities import remarks
from robosmi.transformations.m2m.partition.platform_dependence import partition
from robosmi.transformations.queries import code
from robosmi.transformations.queries.adapter_signature import target_signature
from robosmi.transformations.queries.constants.ranges import Ranges
from robosmi.transformations.queries.flows import call_graph, library_use
from robosmi.transformations.queries.flows.cores import Cores
from robosmi.transformations.queries.numbers import Machine, Numbers
from robosmi.transformations.queries.programs import main_program
from robosmi.transformations.queries.reports.analysis import analysis
from robosmi.transformations.queries.values import Values
from robosmi.transformations.t2m.c_source import read_program
from robosmi.transformations.t2m.c_source.on_demand import open_program

ROOT = Path(__file__).resolve().parents[2]


def programs() -> list[Path]:
    """The programs of the tests and examples, and of the corpus if there is one."""
    folders = [ROOT / "docs" / "examples", ROOT / "tests"]
    found = [p for folder in folders for p in sorted(folder.rglob("*.c")) if p.stat().st_size < 40_000]
    corpus = os.environ.get("ROBOSMI_CORPUS")
    return found + (sorted(Path(corpus).rglob("*.c")) if corpus else [])


def both(path: Path) -> tuple[ccode.Program, ccode.Program] | None:
    """A program on demand and stored; None for a file that is no C."""
    try:
        stored, _ = read_program(path)
    except SourceError:
        return None
    return open_program(path).program, stored


def at(element: Any) -> tuple[Any, ...]:
    """An element as both views have it."""
    return (type(element).__name__, element.startOffset, element.endOffset, getattr(element, "name", ""))


def answers(program: ccode.Program, path: Path, api: ApiIndex) -> Iterator[tuple[str, Any]]:
    """The answers of every query, of the constraints and of the partition about a program."""
    findings: list[Finding] = []
    yield "analysis", analysis(program, findings, api)
    yield "its findings", [f.to_json() for f in findings]
    views = code.views(program, api)
    constructs = code.platform_dependent_constructs(program, api)
    yield "constructs", [(f.name, f.header, f.signature, f.lines) for f in (*constructs.functions, *constructs.unknown)]
    yield "libraries", [at(i) for i in code.platform_agnostic_libraries(program, api)]
    for view in views:
        main = main_program.main_structure(view.unit)
        yield "main", main and [at(s) for s in (*main.before, *main.after, *main.hoisted)]
    cores = Cores(views)
    yield "cores", (sorted(cores.blocking), [s.function for s in cores.starts.values()], cores.by_libraries)
    functions = [d for u in program.units for d in u.declarations if isinstance(d, ccode.Function)]
    yield "calls", [[f.name for f in q(f)] for f in functions for q in (call_graph.all_callees, call_graph.all_callers)]
    uses = library_use.library_uses(program, library_use.LibraryNames(headers=["simpletools.h"]), api)
    yield "uses of a library", [(u.name, at(u.element)) for u in uses]
    macros = {m.name: m.body or "" for u in program.units for m in u.macros}
    numbers = Numbers(Machine(16, 32, 16, True), {}, {}, macros)
    ranges = Ranges(numbers, Values(program, program.units[0]), program)
    for view in views:
        expressions = view.of_kind(ccode.Expression)
        yield "types", [numbers.of(e) for e in expressions]
        yield "ranges", [ranges.of(e) for e in expressions]
        yield "remarks", [r.to_json() for r in remarks(view, path.read_bytes(), "x.c")]
    choice = AdapterChoice(adapter_index("arduino", "propeller"), api, "atmega328p")
    made = partition(views, target_facts("uno"), choice, {program.units[0].path: path.read_bytes()}, Trace())
    yield "partition", [(*d.rules, d.action.name, *d.reasons, d.choice) for d in made.dispositions]
    yield "changes", [(c.startOffset, c.endOffset, c.replacement) for d in made.dispositions for c in d.changes]
    yield "adapters", [(a.signature, target_signature(a), [at(c) for c in a.calls]) for a in made.adapters]
    yield "placeholders", [(s.name, s.placeholder, [at(u) for u in s.uses]) for s in made.symbols]
    yield "constraints", [(u.constraint.id, u.message) for u in constraints.run(program).unsatisfied]


def differences(path: Path, api: ApiIndex) -> list[str] | None:
    """The queries whose answers differ; None for a file that is no C."""
    views = both(path)
    if views is None:
        return None
    on_demand, stored = (list(answers(program, path, api)) for program in views)
    return [what for (what, first), (_, second) in zip(on_demand, stored, strict=True) if first != second]


def main() -> int:
    """Print the programs with differences and how many were compared."""
    api = ApiIndex.load("propeller")
    found = {path: differences(path, api) for path in programs()}
    compared = {path: wrong for path, wrong in found.items() if wrong is not None}
    for path, wrong in compared.items():
        if wrong:
            print(f"{path}: {', '.join(wrong)}")
    print(f"{len(compared)} programs compared, {sum(map(bool, compared.values()))} with differences")
    return int(any(compared.values()) or not compared)


if __name__ == "__main__":
    sys.exit(main())
