"""The string literals of a plan's program and adapters that occupy data memory, and the initial values of local arrays.

On a processor with separate memories, a string that is read like a variable is copied into data memory before main begins.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache

from robosmi.metamodels import ccode, migration, platform
from robosmi.query import all_contents
from robosmi.transformations.knowledge.lexer import Token, tokens
from robosmi.transformations.queries.compiled_code import CompiledCode, is_ignored, way
from robosmi.transformations.queries.lasting_variables import lasting
from robosmi.transformations.queries.type_sizes import TypeSizes, text_of, unescaped

_COPIED = 3
"""Initial values of a local array with more bytes than this are copied from data memory; fewer are in the code."""
_IN_FLASH = (["PSTR"], ["F"])
_COMPILER = frozenset(["asm", "__asm__", "volatile", "__attribute__", "alignas", "static_assert", "section"])


def bytes_of_texts(code: CompiledCode, pieces: Sequence[platform.Adapter]) -> int:
    """Bytes of the strings in data memory; equal strings, and one that another ends with, are stored once."""
    said = {text for piece in pieces for text in kept_texts(str(piece.text))}
    for element in code.elements:
        if isinstance(element, ccode.StringLiteral) and not _elsewhere(element, code.ignored):
            said.add(text_of(element))
    ends = sorted(each[::-1] for each in said)
    pairs = zip(ends, [*ends[1:], None], strict=False)
    kept = [each for each, following in pairs if following is None or not following.startswith(each)]
    return sum(len(each) + 1 for each in kept)


def _elsewhere(literal: ccode.StringLiteral, ignored: set[int]) -> bool:
    """Whether a string literal is not stored as a string: it initialises an array, is in a sizeof, or is ignored."""
    container = literal.eContainer()
    if isinstance(container, ccode.InitializerList) and len(container.elements) == 1:
        container = container.eContainer()
    if isinstance(container, ccode.Variable):
        return bool(container.valueType is not None and container.valueType.arrayDims and not container.valueType.pointerDepth)
    return isinstance(container, ccode.SizeOf) or is_ignored(literal, ignored)


def bytes_of_initial_values(plan: migration.MigrationPlan, code: CompiledCode, sizes: TypeSizes) -> int:
    """Bytes of the initial values of local arrays, which are copied out of data memory whenever their block is entered."""
    others = {id(each) for each in lasting(plan, code.elements)}
    total = 0
    for element in code.elements:
        if not isinstance(element, ccode.Variable) or id(element) in others or element.initializer is None:
            continue
        if isinstance(element.initializer, (ccode.InitializerList, ccode.StringLiteral)) and _copied(element, code.ignored):
            size = sizes.of(element.valueType) if element.valueType is not None and element.valueType.arrayDims else 0
            total += size if size and size > _COPIED and _constant(element.initializer) else 0
    return total


def _copied(variable: ccode.Variable, ignored: set[int]) -> bool:
    """Whether a local array is used otherwise than by elements with literal indices, so that a compiler has to store it."""
    return any(way(each) not in ("read", "written", "size") and not is_ignored(each, ignored) for each in variable.references)


def _constant(initializer: ccode.Expression) -> bool:
    return not any(isinstance(each, (ccode.NameReference, ccode.Call)) for each in all_contents(initializer))


@lru_cache(maxsize=512)  # each report asks it of the same pieces
def kept_texts(text: str) -> tuple[str, ...]:
    """The string literals of a piece that occupy data memory: not those placed in flash or read only by the compiler."""
    return tuple(_kept_texts(text)) if '"' in text else ()


def _kept_texts(text: str) -> Iterator[str]:
    found = [each for each in tokens(text.encode()) if each[0] not in ("comment", "directive")]
    for number, (kind, _, _, said) in enumerate(found):
        before = [each[3] for each in found[max(0, number - 2) : number]]
        if kind == "string" and before[-1:] != ["extern"] and before[:1] not in _IN_FLASH and not _for_compiler(found[:number]):
            yield unescaped(said)


def _for_compiler(before: Sequence[Token]) -> bool:
    """Whether the next token is inside an `asm` statement or an attribute."""
    depth = 0
    for *_, word in reversed(before):
        depth += (word == ")") - (word == "(")
        if word in (";", "{", "}"):
            return False
        if depth < 0 and word in _COMPILER:
            return True
    return False
