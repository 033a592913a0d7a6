"""What of an original has no meaning on this machine, and is stubbed on both sides: unknown functions and missing headers.

A function that no header of the platform declares, or that neither the host model nor an adapter file knows, does nothing on both
sides and returns zero. A header that was not found declares what the migrated program declares in its place, with the same
values. The rest of the program is compared; the verdict names what was not.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path

from msgspec import Struct

from robosmi import inputs
from robosmi.metamodels import migration
from robosmi.transformations.queries.reports.written_bodies import AS_BYTES, bodies

MISSING_HEADER = "RS103"
_INCLUDE = re.compile(r'#\s*include\s*[<"]([^>"]+)[>"]')
_PLAIN = {"void", "bool", "char", "short", "int", "long", "unsigned", "signed", "size_t"}
_SIZED = {f"{sign}int{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)}
_WHOLE = _PLAIN | _SIZED | {"const", "static", "extern", "inline", "volatile"}
_FRACTIONS = {"float", "double"}
_RECORD = re.compile(r"struct (\w+) \{")
_VALUE = r"\b{name}\s*=\s*([^;]+);"


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
        if finding.rule == MISSING_HEADER and finding.path in lines
        if (found := _INCLUDE.search(lines[finding.path][finding.line - 1])) is not None
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
