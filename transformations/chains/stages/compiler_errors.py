"""Turns the compiler's errors on a generated program into findings for its plan, so that no report calls it ready."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Callable, Mapping, Sequence, Set
from functools import cache, cached_property

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.metamodels import ccode, migration
from robosmi.model.elements.ordering import post_order
from robosmi.transformations.chains.stages.pin_check import LOOK_UPS
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.target_platform import chip_macros
from robosmi.transformations.m2m.plan_tasks import plan_findings
from robosmi.transformations.m2t.program_text import file_name
from robosmi.transformations.queries.circuits.circuit import pin_literal
from robosmi.transformations.queries.expression_type import ARITHMETIC, of_use
from robosmi.transformations.queries.numbers import Machine
from robosmi.transformations.queries.plans.plan import target_of
from robosmi.transformations.queries.plans.retained_pins import move_facts, retains_platform
from robosmi.transformations.queries.source_text import HEADERS, codec_of, words_of
from robosmi.transformations.t2m.c_source.parsing.compiler_complaints import compiler_complaints
from robosmi.transformations.t2m.c_source.parsing.generated_program import GeneratedProgram

RULE = "RS337"
_CODE = (".ino", ".cpp", ".c", *HEADERS)
_MOST_MEMBERS = 100_000
"""Members of a structure, those of its members included, beyond which libclang is not asked: it takes memory for each.

No microcontroller has the memory for such a variable.
"""
_PLAIN_KINDS = frozenset({"function", "variable", "constant"})
"""Kinds of names that change no syntax where their header is missing."""
_MACROS = frozenset({"offsetof", "va_arg", "va_start", "va_end", "va_copy"})
"""Macros of the language's headers that take types."""
_MOST = 10
"""Limit on the reported lines of a program that changes its platform; of any other one, each line is a task."""
_TOLD_BEFORE = frozenset({"RS101", "RS312", "RS350"})


def parsed_program(plan: migration.MigrationPlan, texts: Mapping[str, str]) -> GeneratedProgram:
    """The finished program of a plan, parsed.

    Args:
        plan: the plan.
        texts: path in the output folder -> the text that was made.
    """
    folder, kept = f"{plan.name}/", retains_platform(plan)
    made = {
        name.removeprefix(folder): text.encode("utf-8", "surrogateescape")
        for name, text in texts.items()
        if name.startswith(folder) and name.endswith(_CODE) and (kept or "/" not in name.removeprefix(folder))
    }
    pins = {text for b in plan.portBindings if b.pin is not None and (text := pin_literal(b.pin)).isidentifier()}
    pins |= {text for c in plan.connections if c.pin is not None and (text := pin_literal(c.pin)).isidentifier()}
    header = str(plan.target.mainHeader) if plan.target is not None else ""
    vast = plan.program is not None and _most_members(plan.program, made) > _MOST_MEMBERS
    machine = Machine.of(plan.target) if plan.target is not None else Machine(16, 32, 16, char_signed=True)
    return GeneratedProgram(
        made, header, str(target_of(plan).language), pins=pins, vast=vast,
        int_bits=machine.int_bits, char_signed=machine.char_signed,
        api=_headers(plan) if kept else None,
        tabs=_tabs(plan) if kept else (), defines=_board_macros(plan) if kept else (),
    )  # fmt: skip


def _headers(plan: migration.MigrationPlan) -> Mapping[str, bytes] | None:
    """The headers of the platform, with the methods that only the cores of boards such as the target have."""
    if plan.target is None:
        return None
    headers = dict(ApiIndex.load(str(plan.target.name)).virtual_headers())
    for name, declared in move_facts(plan).methods.items():
        head = re.compile(rb"((?:struct|class)\s+%s\b[^;{]*\{)" % name.encode())
        text = rb"\1 public: " + declared.encode()
        headers = {header: head.sub(text, data) for header, data in headers.items()}
    return headers


def _tabs(plan: migration.MigrationPlan) -> list[str]:
    """The files that are one text, in their order."""
    suffix = target_of(plan).fileSuffix
    names = [file_name(unit, plan) for unit in (plan.program.units if plan.program is not None else ())]
    return [name for name in names if name.endswith(suffix)]


def _board_macros(plan: migration.MigrationPlan) -> list[str]:
    """The macros by which programs ask for the board and its processor."""
    chip = plan.board.microcontroller if plan.board is not None else None
    mappings = plan.target.boardMappings if plan.target is not None else ()
    boards = [f"ARDUINO_{mapping.define}" for mapping in mappings if mapping.board is plan.board and mapping.define]
    own = [f"ARDUINO_ARCH_{str(chip.architecture).upper()}", *chip_macros(chip)] if chip is not None else []
    return [*boards, *own, "ARDUINO=10819"]


def compiler_errors(
    plan: migration.MigrationPlan, program: GeneratedProgram, sources: Mapping[str, bytes]
) -> list[migration.PlanFinding]:
    """RS337: the lines of the generated texts that a C++ compiler refuses and no other finding of the plan reports, and the texts
    that cannot be checked.

    Args:
        plan: the plan, which stays as it is.
        program: its finished program, parsed.
        sources: path of a unit -> its bytes.
    """
    if plan.program is None:
        return []
    units = {file_name(unit, plan): str(unit.path) for unit in plan.program.units}
    found = [
        Finding(
            RULE, Severity.warning, f"{name} is not checked: the C parser gave up on it", Location(units[name], 1),
            fix="make its initialisers and structures smaller, or compare the sketch with the source yourself",
        )
        for name in program.unread if name in units
    ]  # fmt: skip
    place = source_place(plan, program, sources)
    known = {(str(f.path), int(f.line)) for f in plan.findings if f.rule in _TOLD_BEFORE}
    for each in compiler_complaints(program, _KnownWords(plan, sources)) if target_of(plan).language != "C" else ():
        at = place(each.file, each.line)
        if at is None or (at.path, at.line) not in known:
            message = f"line {each.line} of {each.file}: {each.message}"
            fix = "write it in C++ in the sketch, or otherwise in the source"
            found.append(Finding(RULE, Severity.warning, message, at, fix=fix))
    if len(found) > _MOST and not retains_platform(plan):
        first = found[_MOST - 1]
        more = f"{first.message}; and {len(found) - _MOST} more lines"
        found = [*(f for number, f in enumerate(found) if number < _MOST - 1)]
        found.append(Finding(RULE, Severity.warning, more, first.location, fix=first.fix))
    return plan_findings(plan, found, {str(unit.path): str(unit.path) for unit in plan.program.units})


class _KnownWords:
    """Tells of words of the program whether all are the source's or the plan's own, and no macro or type of a header.

    No word is known where the source itself has an error, which is told there.
    """

    def __init__(self, plan: migration.MigrationPlan, sources: Mapping[str, bytes]) -> None:
        self._plan, self._sources = plan, sources

    @cached_property
    def _own(self) -> set[str]:
        return {"setup", "loop", *LOOK_UPS, *ARITHMETIC, *(str(connection.name) for connection in self._plan.connections)}

    @cached_property
    def _written(self) -> set[str]:
        """The words of the source; none if it has an error."""
        broken = any(finding.rule == "RS101" for finding in self._plan.findings)
        return set() if broken else words_of(self._sources.values())

    @cached_property
    def _api(self) -> ApiIndex | None:
        return ApiIndex.of(self._plan.source) if self._plan.source is not None else None

    def __call__(self, words: Set[str]) -> bool:
        """Whether all of some words are known."""
        others = words - self._own
        if not self._written or any(word.rstrip("_") not in self._written or word in _MACROS for word in others):
            return False  # a rule that renames adds an underscore
        return self._api is not None and all(entry.kind in _PLAIN_KINDS for word in others for entry in self._api.entries(word))


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
    read = cache(lambda file: _Origins(shown(file), units[file], sources))

    def place(file: str, line: int) -> Location | None:
        return read(file).of(line) if file in units else None

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


class _Origins:
    """Where the lines of a generated file come from in its source.

    Args:
        shown: the lines of the generated file.
        unit: the source file.
        sources: path of a unit -> its bytes.
    """

    def __init__(self, shown: Sequence[str], unit: ccode.SourceUnit, sources: Mapping[str, bytes]) -> None:
        self._path = str(unit.path)
        self._shown = shown
        lines = sources[unit.path].decode(codec_of(unit), "replace").splitlines()
        self._count = len(lines)
        self._rows: dict[str, list[int]] = {}
        for row, line in enumerate(lines):
            self._rows.setdefault(line.strip(), []).append(row)
        self._shifts: list[int] = []
        """Of each line the distance to the source of the nearest one above that the source has once."""
        for at, line in enumerate(shown):
            rows = self._rows.get(line, ()) if line else ()
            self._shifts.append(rows[0] - at if len(rows) == 1 else self._shifts[-1] if self._shifts else 0)

    def of(self, number: int) -> Location:
        """The place of a line: the one with the same text that is nearest to where the lines above come from.

        Args:
            number: of the line.
        """
        if number > len(self._shown):
            return Location(self._path)
        at = number - 1
        line = nearest(self._rows.get(self._shown[at], ()), at + self._shifts[at])
        return Location(self._path, line + 1) if line < self._count else Location(self._path)


def nearest(rows: Sequence[int], guess: int) -> int:
    """The row nearest to a guess, the first of two; the guess itself if there is none.

    Args:
        rows: in order.
        guess: where it is expected.
    """
    behind = bisect_left(rows, guess)
    around = rows[max(behind - 1, 0) : behind + 1]
    return min(around, key=lambda row: abs(row - guess), default=guess)
