"""Build a program to run on this machine, with stand-ins for headers of its platform that have no host model.

A function that a stand-in declares ends the run, with the function's name, when it is called. So a program that includes such a
header runs as long as it does not call one.

What has no meaning on this machine is stubbed on both sides (`Stubs`): unknown functions and missing headers. A function that
no header of the platform declares, or that neither the host model nor an adapter file knows, does nothing on both sides and
returns zero. A header that was not found declares what the migrated program declares in its place, with the same values. The
rest of the program is compared; the verdict names what was not.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path

from msgspec import Struct

from robosmi import inputs
from robosmi.metamodels import ccode, migration
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.reports.written_bodies import AS_BYTES, bodies
from robosmi.verify.host_model import HostModel
from robosmi.verify.original_build import VARIANT, OriginalProgram, build_original

_INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"\n]+)[>"]', re.MULTILINE)

_CALLED = re.compile(r"\b(\w+)\s*\(")

_MISSING_HEADER = "RS103"
_ANY_INCLUDE = re.compile(r'#\s*include\s*[<"]([^>"]+)[>"]')
_PLAIN = {"void", "bool", "char", "short", "int", "long", "unsigned", "signed", "size_t"}
_SIZED = {f"{sign}int{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)}
_WHOLE = _PLAIN | _SIZED | {"const", "static", "extern", "inline", "volatile"}
_FRACTIONS = {"float", "double"}
_RECORD = re.compile(r"struct (\w+) \{")
_VALUE = r"\b{name}\s*=\s*([^;]+);"


def original_program(
    sources: Sequence[Path],
    model: HostModel,
    folder: Path,
    include_folders: Sequence[Path] = (),
    limit_s: float = 60.0,
    *,
    only: Collection[Path] | None = None,
    trusted: bool = False,
    stubs: Stubs | None = None,
) -> OriginalProgram:
    """Compile and link a program (see `build_original`), with headers of its platform that have no model.

    Args:
        sources: the user's C files.
        model: the host model of their platform.
        folder: an empty folder, in which everything is made.
        include_folders: where headers of the program are looked for.
        limit_s: seconds of this machine's time for all of it.
        only, trusted: as for `build_original`.
        stubs: functions and missing headers that may be stubbed.

    Raises:
        MissingToolError: the host's compiler is not installed, or cannot make programs of the platform's word size; or the
            system has no sandbox.
        VerificationError: the program does not compile or link, or that takes too long.
    """
    stubs = stubs or Stubs()
    headers = {**stubs.headers, **stand_in_headers(sources, model, include_folders)}
    return build_original(
        sources, model, folder, include_folders, headers, limit_s, only=only, trusted=trusted, stubs=stubs.functions
    )


def written_sources(units: Iterable[ccode.SourceUnit], files: Mapping[str, bytes], place: Path) -> list[Path]:
    """Write a program's stored files into a folder that holds nothing else, so that a compiler finds no other file beside them.

    The files include each other by the names that they are stored under: those of a migration lie side by side, wherever they
    came from, so that `#include "lib/util.h"` would lead nowhere. Only the name of such a directive is another, so that all lines
    keep their numbers.

    Args:
        units: the units of the program, with the paths of their files.
        files: path -> content as the plan has recorded it.
        place: an empty folder.

    Returns:
        The files that were written.
    """
    texts = dict(files)
    for unit in units:
        lines = texts[unit.path].split(b"\n")
        for include in unit.includes:
            name = Path(include.resolvedPath).name
            if include.resolvedPath in texts and name != include.header and include.line <= len(lines):
                pattern = rb"""(["<])\s*""" + re.escape(include.header.encode()) + rb"""\s*[">]"""
                lines[include.line - 1] = re.sub(pattern, b'"' + name.encode() + b'"', lines[include.line - 1], count=1)
        texts[unit.path] = b"\n".join(lines)
    for path, text in texts.items():
        (place / path).parent.mkdir(parents=True, exist_ok=True)
        (place / path).write_bytes(text)
    return [place / path for path in texts]


def stand_in_headers(sources: Sequence[Path], model: HostModel, include_folders: Sequence[Path] = ()) -> dict[str, str]:
    """Stand-ins for headers of the platform that a program includes and the host model lacks: name -> text."""
    index = ApiIndex.load(model.platform)
    wanted = index.closure(sorted(_included(sources, include_folders)))
    own = {path.relative_to(folder).as_posix(): path for folder in model.headers for path in folder.rglob("*.h")}
    lacking = [name for name in wanted if name not in own]
    if not lacking:
        return {}
    declared = {header: set(_CALLED.findall(inputs.read_text(path, inputs.DATA))) for header, path in own.items()}
    return {name: _stand_in(name, index, declared, [header for header in wanted if header in own]) for name in lacking}


def _included(sources: Iterable[Path], include_folders: Sequence[Path]) -> set[str]:
    """The names of headers that a program includes, directly or through its own headers, and that are no files of its own."""
    pending, seen, found = [path.resolve() for path in sources], set[Path](), set[str]()
    while pending:
        path = pending.pop()
        if path in seen:
            continue
        seen.add(path)
        for name in _INCLUDE.findall(inputs.read_text(path, inputs.SOURCE, errors="replace")):
            own = next((place for folder in (path.parent, *include_folders) if (place := folder / name).is_file()), None)
            if own is None:
                found.add(name)
            else:
                pending.append(own.resolve())
    return found


def _stand_in(header: str, index: ApiIndex, declared: Mapping[str, Collection[str]], wanted: Collection[str]) -> str:
    """The text of a stand-in.

    Args:
        header: its name.
        index: what the platform declares.
        declared: header of the model -> what it declares: a function of that name there is another one.
        wanted: the headers of the model that the program includes; what they declare has its own name if they come first.
    """
    taken = set().union(*declared.values())
    own = index.declared(header).keys()
    first = [name for name in wanted if not own.isdisjoint(declared[name])]
    lines = ['#include "host.h"', *(f"#include <{name}>" for name in dict.fromkeys((*index.includes(header), *first)))]
    for name, entry in index.declared(header).items():
        if entry.kind == "function":  # the call declares it; the macro tells it from another header's
            if name in taken or len({each.header for each in index.entries(name)}) > 1:
                lines.append(f"#define {name} {name}{VARIANT}{_word(header)}")
            continue
        if entry.kind == "type":
            lines.append(f"typedef struct {name} {{ int unknown[64]; }} {name};")
            continue
        ends = f'(host_unmodelled("{name}"), 0)'
        text = f"(*(int *){ends})" if entry.kind == "variable" else ends
        lines.append(f"#ifndef {name}\n#define {name}{'(...)' if entry.kind == 'function_macro' else ''} {text}\n#endif")
    guard = f"ROBOSMI_STAND_IN_{_word(header).upper()}"
    return "\n".join([f"#ifndef {guard}", f"#define {guard}", *lines, "#endif", ""])


def _word(header: str) -> str:
    return re.sub(r"\W", "_", header.removesuffix(".h"))


class Stubs(Struct, frozen=True):
    """What may be stubbed.

    Attributes:
        functions: name of a function -> whether it returns a fraction.
        headers: name of a missing header -> its text.
        symbols: what the headers declare, with the values of constants.
    """

    functions: dict[str, bool] = {}
    headers: dict[str, str] = {}
    symbols: tuple[str, ...] = ()


def stubs_of(plan: migration.MigrationPlan, sources: Mapping[str, bytes], sketch: Iterable[str]) -> Stubs:
    """What of a program may be stubbed.

    Not the functions that the target cannot support: without them the program does something else there.

    Args:
        plan: the plan.
        sources: path -> content of the program's files.
        sketch: the texts of the migrated program as it is now.
    """
    functions = {
        str(use.name): fraction
        for use in plan.adapterUses
        if use.adapter is None and use.status is not migration.AdapterStatus.unsupported
        if (fraction := _returns_fraction(str(use.name), str(use.signature))) is not None
    }
    lines = {path: text.decode("latin-1").split("\n") for path, text in sources.items()}
    missing = [
        found[1]
        for finding in plan.findings
        if finding.rule == _MISSING_HEADER and finding.path in lines
        if (found := _ANY_INCLUDE.search(lines[finding.path][finding.line - 1])) is not None
    ]
    if not missing:
        return Stubs(functions)
    told, texts = [], list(sketch)
    declared = ["#include <stdint.h>"]
    for use in plan.symbolUses:
        if use.symbol is None and use.adapter is None:
            line, what = _declaration(str(use.name), str(use.placeholder), texts)
            declared.append(line)
            told.append(what)
    guard = "STUBS_OF_MISSING_HEADERS"
    text = "\n".join([f"#ifndef {guard}", f"#define {guard}", *declared, "#endif", ""])
    return Stubs(functions, dict.fromkeys(missing, text), tuple(told))


def _returns_fraction(name: str, signature: str) -> bool | None:
    """Whether a function returns a fraction rather than a whole number, a pointer or nothing; None for anything else."""
    head = signature.partition("(")[0].strip()
    if not head.endswith(name):
        return None
    head = head.removesuffix(name)
    words = set(re.findall(r"\w+", head))
    if "*" in head or words <= _WHOLE:
        return False
    return True if words <= _WHOLE | _FRACTIONS else None


def _declaration(name: str, placeholder: str, texts: Iterable[str]) -> tuple[str, str]:
    """The declaration of a symbol for the original, and the symbol in words: with its value, if it is a constant."""
    if (record := _RECORD.match(placeholder)) is not None:
        return f"typedef struct {record[1]} {{ int unknown[64]; }} {record[1]};", name
    pattern = _VALUE.format(name=re.escape(name))
    values = (found[1].strip() for text in (*texts, placeholder) if (found := re.search(pattern, text)) is not None)
    if (value := next(values, None)) is not None and placeholder.startswith("const "):
        return f"#define {name} ({value})", f"{name} = {value}"
    return f"{'static ' if '=' in placeholder else ''}{placeholder}", name


def with_stubs(text: str, names: Collection[str]) -> str:
    """A text of the migrated program in which some functions do nothing and return zero."""
    lines = text.split("\n")
    for body in sorted(bodies(text).values(), key=lambda each: -each.first):
        if body.name in names:
            head = body.code[: body.code.index("{")]
            before = head[: head.index(body.name)]
            nothing = "void" in before and "*" not in before
            lines[body.first : body.last] = [f"{' '.join(head)} {{ {'' if nothing else 'return {}; '}}}"]
    return "\n".join(lines)


def written_in(files: Iterable[Path], names: Collection[str]) -> set[str]:
    """Those of some functions that the files of a sketch define with a body."""
    texts = (inputs.read_text(path, inputs.SOURCE, errors=AS_BYTES) for path in files)
    return {name for text in texts for name, body in bodies(text).items() if name in names and not body.open}
