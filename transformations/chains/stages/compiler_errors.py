"""Turns the compiler's errors on a generated program into findings for its plan, so that no report calls it ready."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.metamodels import ccode, migration
from robosmi.model.elements.ordering import post_order
from robosmi.transformations.m2m.plan_tasks import plan_findings
from robosmi.transformations.m2t.program_text import file_name
from robosmi.transformations.queries.circuits.circuit import pin_literal
from robosmi.transformations.queries.expression_type import of_use
from robosmi.transformations.queries.plans.plan import target_of
from robosmi.transformations.queries.source_text import HEADERS
from robosmi.transformations.t2m.c_source.parsing.compiler_complaints import compiler_complaints
from robosmi.transformations.t2m.c_source.parsing.generated_program import GeneratedProgram

RULE = "RS337"
_CODE = (".ino", ".cpp", ".c", *HEADERS)
_MOST_MEMBERS = 100_000
"""Members of a structure, those of its members included, beyond which libclang is not asked: it takes memory for each.

No microcontroller has the memory for such a variable.
"""
_MOST = 10
"""Limit on the reported lines."""
_TOLD_BEFORE = frozenset({"RS101", "RS312"})


def parsed_program(plan: migration.MigrationPlan, texts: Mapping[str, str]) -> GeneratedProgram:
    """The finished program of a plan, parsed.

    Args:
        plan: the plan.
        texts: path in the output folder -> the text that was made.
    """
    folder = f"{plan.name}/"
    made = {
        name.removeprefix(folder): text.encode("utf-8", "surrogateescape")
        for name, text in texts.items()
        if name.startswith(folder) and name.endswith(_CODE) and "/" not in name.removeprefix(folder)
    }
    pins = {text for b in plan.portBindings if b.pin is not None and (text := pin_literal(b.pin)).isidentifier()}
    pins |= {text for c in plan.connections if c.pin is not None and (text := pin_literal(c.pin)).isidentifier()}
    header = str(plan.target.mainHeader) if plan.target is not None else ""
    vast = plan.program is not None and _most_members(plan.program, made) > _MOST_MEMBERS
    return GeneratedProgram(made, header, str(target_of(plan).language), pins=pins, vast=vast)


def compiler_errors(
    plan: migration.MigrationPlan, program: GeneratedProgram, sources: Mapping[str, bytes]
) -> list[migration.PlanFinding]:
    """RS337: the lines of the generated texts that a C++ compiler refuses and no other finding of the plan reports.

    Args:
        plan: the plan, which stays as it is.
        program: its finished program, parsed.
        sources: path of a unit -> its bytes.
    """
    if target_of(plan).language == "C" or plan.program is None:
        return []
    refused = compiler_complaints(program)
    place = source_place(plan, program, sources)
    known = {(str(f.path), int(f.line)) for f in plan.findings if f.rule in _TOLD_BEFORE}
    found: list[Finding] = []
    for each in refused:
        at = place(each.file, each.line)
        if at is None or (at.path, at.line) not in known:
            message = f"line {each.line} of {each.file}: {each.message}"
            fix = "write it in C++ in the sketch, or otherwise in the source"
            found.append(Finding(RULE, Severity.warning, message, at, fix=fix))
    if len(found) > _MOST:
        first = found[_MOST - 1]
        more = f"{first.message}; and {len(found) - _MOST} more lines"
        found = [*(f for number, f in enumerate(found) if number < _MOST - 1)]
        found.append(Finding(RULE, Severity.warning, more, first.location, fix=first.fix))
    return plan_findings(plan, found, {str(unit.path): str(unit.path) for unit in plan.program.units})


def source_place(
    plan: migration.MigrationPlan, program: GeneratedProgram, sources: Mapping[str, bytes]
) -> Callable[[str, int], Location | None]:
    """The function from a file and a line of a finished program to the place in the source.

    Args:
        plan: the plan.
        program: its finished program.
        sources: path of a unit -> its bytes.
    """
    units = {file_name(unit, plan): unit for unit in (plan.program.units if plan.program is not None else ())}
    shown = cache(lambda file: [line.strip() for line in program.files[file].decode("utf-8", "replace").splitlines()])

    def place(file: str, line: int) -> Location | None:
        unit = units.get(file)
        return _place(line, shown(file), unit, sources) if unit is not None else None

    return place


def _most_members(program: ccode.Program, texts: Mapping[str, bytes]) -> int:
    """The number of numbers and pointers in the largest structure of a program."""
    if not any(b"struct" in data or b"union" in data for data in texts.values()):
        return 0
    counts: dict[ccode.Record, int] = {}

    def parts(record: ccode.Record) -> list[ccode.Record]:
        kinds = [of_use(field.valueType) for field in record.fields]
        found = [kind.declaration for kind in kinds if kind is not None and not kind.depth]
        return [each for each in found if isinstance(each, ccode.Record)]

    records = [each for unit in program.units for each in unit.eAllContents() if isinstance(each, ccode.Record)]
    for record in post_order(records, parts):
        inner = parts(record)
        counts[record] = sum(counts.get(each, 0) for each in inner) + len(record.fields) - len(inner)
    return max(counts.values(), default=0)


def _place(number: int, shown: Sequence[str], unit: ccode.SourceUnit, sources: Mapping[str, bytes]) -> Location:
    """The source line of a line: the one with the same text nearest to the origin of a line above it."""
    text = sources[unit.path].decode(unit.encoding or "utf-8", "replace")
    lines = [line.strip() for line in text.splitlines()]
    at = number - 1
    if at >= len(shown):
        return Location(str(unit.path))
    guess = at
    for above in range(at, -1, -1):
        if shown[above] and lines.count(shown[above]) == 1:
            guess = lines.index(shown[above]) + at - above
            break
    same = [row for row, line in enumerate(lines) if line == shown[at]]
    best = sorted(same, key=lambda row: abs(row - guess))
    line = best[0] if best else guess
    return Location(str(unit.path), line + 1) if line < len(lines) else Location(str(unit.path))
