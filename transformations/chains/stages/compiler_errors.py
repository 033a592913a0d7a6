"""Turns the compiler's errors on a generated program into findings for its plan, so that no report calls it ready.

They are found by parsing the finished program with libclang before anybody compiles it. The target's own headers may be missing
(`generated_program`). So only errors count that these headers cannot cause, of undeclared names only functions that the program
itself defines, and errors of syntax only in lines of which each word is known. The checks made while reading
(`m2m.language.cpp_incompatibilities`) are more exact; this one finds what nobody foresaw.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from functools import cache, cached_property
from typing import NamedTuple

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.metamodels import ccode, migration
from robosmi.model.elements.ordering import post_order
from robosmi.transformations.chains.stages.pin_check import LOOK_UPS
from robosmi.transformations.knowledge.lexer import KEYWORDS, tokens
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
from robosmi.transformations.t2m.c_source.parsing import clang
from robosmi.transformations.t2m.c_source.parsing.generated_program import SKETCH, GeneratedProgram

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

_NAMED = r"'[^']*'(?:\ \(aka\ '[^']*'\))?"
"""A name or type in a message."""
_SURE = re.compile(
    rf"""redefinition\ of\ '|definition\ of\ type\ {_NAMED}\ conflicts\ with\ typedef
    |functions\ that\ differ\ only\ in\ their\ return
    |excess\ elements\ in|too\ (?:many|few)\ arguments\ to\ function\ call|no\ matching\ function\ for\ call\ to\ '
    |expression\ is\ not\ assignable|cannot\ assign\ to\ (?:variable|non-static\ data\ member|return\ value)
    |function\ definition\ is\ not\ allowed\ here|comparison\ (?:of\ distinct\ pointer\ types|between\ pointer\ and\ integer)
    |cannot\ initialize\ an?\ (?:parameter|variable|member\ subobject|array\ element|return\ object)
    |assigning\ to\ {_NAMED}\ from\ (?:incompatible\ type\ )?{_NAMED}$|cannot\ cast\ from\ type
    |cast\ from\ pointer\ to\ smaller\ type
    |indirection\ requires\ pointer\ operand|member\ reference\ base\ type\ {_NAMED}\ is\ not\ a\ structure
    |cannot\ jump\ from|default\ initialization\ of\ an\ object\ of\ const|static\ declaration\ of\ {_NAMED}\ follows\ non-static
    |conflicting\ types\ for|variable-sized\ object\ may\ not\ be\ initialized|array\ is\ too\ small\ to\ include
    |initializer-string\ for\ char\ array\ is\ too\ long|use\ of\ undeclared\ label|redeclaration\ of\ '
    |cannot\ increment\ value\ of\ type|array\ type\ {_NAMED}\ is\ not\ assignable|array\ has\ incomplete\ element
    |invalid\ operands\ to\ binary\ expression|void\ function\ {_NAMED}\ should\ not\ return
    |non-void\ function\ {_NAMED}\ should\ return
    |called\ object\ type\ {_NAMED}\ is\ not\ a\ function|subscripted\ value\ is\ not|incompatible\ (?:pointer|integer|operand)
    |.*\ (?:is|are)\ (?:a\ )?C\+\+17\ extensions?
    |conversion\ from\ {_NAMED}\ to\ {_NAMED}\ is\ not\ allowed
    |extraneous\ (?:'\)'|closing\ brace)
    |overload\ resolution\ selected\ deleted\ operator|unterminated\ function-like\ macro\ invocation
    |(?:non-const|volatile)\ lvalue\ reference\ to\ type\ {_NAMED}\ cannot\ bind\ to\ a\ value\ of\ unrelated\ type""",
    re.VERBOSE,
)
"""Matches errors that are about the program itself, not about a missing header."""
_SURE_IN_CPP11 = re.compile(
    r"""'auto'\ return\ without\ trailing|deduced\ return\ types\ are|'auto'\ not\ allowed\ in\ lambda\ parameter
    |statement\ not\ allowed\ in\ constexpr|constexpr\ function's\ return\ type\ 'void'
    |(?:variable\ declaration|use\ of\ this\ statement|multiple\ return\ statements)\ in\ (?:a\ )?constexpr""",
    re.VERBOSE,
)
"""Matches errors of C++11 that later standards have not; avr-gcc only warns of the other forms of C++14."""
_UNKNOWN = re.compile(r"use of undeclared identifier '(\w+)'")
_EXPECTED = re.compile(r"expected |unexpected |.*: expected ")
"""Matches errors of syntax, which a macro or a type of a missing header causes, too."""
_ERROR = re.compile(rb"[ \t]*#[ \t]*error\b")
_DEFINED = re.compile(rb"\b(\w+)[ \t]*\([^;{}()]*\)\s*\{")
"""Functions that a text defines, and statements with a condition, whose names no identifier has."""


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


class CompilerComplaint(NamedTuple):
    """A place of a program that a compiler refuses.

    Attributes:
        file: its name in the program's folder.
        line: the line.
        message: what the parser says.
    """

    file: str
    line: int
    message: str


def compiler_complaints(
    program: GeneratedProgram, are_known: Callable[[Set[str]], bool] = lambda words: not words
) -> list[CompilerComplaint]:
    """The lines of a program's files that a compiler refuses, each once, in the order of the files.

    None are reported of a program that nests too deep for libclang; reading it has reported that.

    Args:
        program: the program, in C++.
        are_known: whether all of some words, which are no keywords, are the program's own, and no macro or type of a header.
    """
    own = (
        set[str]()
        if program.complete
        else {"main"}
        | {n.decode() for path, text in program.texts.items() if path.startswith(SKETCH) for n in _DEFINED.findall(text)}
    )
    told: dict[tuple[str, int], CompilerComplaint] = {}
    for _, unit in program.units:
        for each in _complaints(unit, program, own, are_known):
            if each.file != program.adapters:
                told.setdefault((each.file, each.line), each)
    return list(told.values())


def _complaints(
    unit: int, program: GeneratedProgram, own: Set[str], are_known: Callable[[Set[str]], bool]
) -> Iterator[CompilerComplaint]:
    """The errors of a unit; if the board's macros are there, `#error` is the program's answer to it."""
    texts, board = program.texts, program.complete
    library = clang.library()
    plain: dict[tuple[str, int], bool] = {}
    for number in range(library.getNumDiagnostics(unit)):
        handle = library.getDiagnostic(unit, number)
        if library.getDiagnosticSeverity(handle) >= clang.ERROR:
            message = library.text(library.getDiagnosticSpelling(handle))
            unknown = _UNKNOWN.match(message)
            file, offset = clang.file_offset(library.getDiagnosticLocation(handle))
            name = clang.file_name(file)
            if name.startswith(SKETCH):
                by_program = board and _ERROR.match(texts[name], texts[name].rfind(b"\n", 0, offset) + 1) is not None
                sure = bool(_SURE.match(message)) or (unknown is not None and unknown[1] in own) or by_program
                sure |= program.old_standard and bool(_SURE_IN_CPP11.match(message))
                if not sure and not board and _EXPECTED.match(message):
                    at = (name, texts[name].rfind(b"\n", 0, offset) + 1)
                    if at not in plain:  # a line may have many errors
                        plain[at] = are_known(_words(texts[name], at[1]))
                    sure = plain[at]
                if sure:
                    line = texts[name].count(b"\n", 0, offset) + 1
                    yield CompilerComplaint(name.removeprefix(f"{SKETCH}/"), line, f"#error {message}" if by_program else message)
        library.disposeDiagnostic(handle)


def _words(text: bytes, start: int) -> set[str]:
    """The words but for keywords of the line that starts at an offset, and of the one before that has any."""
    end = text.find(b"\n", start)
    before = text.rfind(b"\n", 0, len(text[:start].rstrip()) if start else 0) + 1
    line = text[before : end if end >= 0 else len(text)]
    return {word for kind, _, _, word in tokens(line) if kind == "name" and word not in KEYWORDS}
