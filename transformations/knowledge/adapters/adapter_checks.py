"""Checks that the text of an adapter piece agrees with its markers: names, parameters, interrupts, brackets.

Only tokens are examined, so a file is checked without the target's headers and compiler. Whether a text compiles with the
pieces it needs is checked by the tests and by `robosmi adapters`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, did_you_mean
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterPiece
from robosmi.transformations.knowledge.lexer import Token, closing, tokens

_SIGNATURE = re.compile(r"[\w\s*&:<>,]*?[\s*&](?P<name>\w+)\s*\((?P<parameters>.*)\)\s*;?", re.DOTALL)
_WORD = re.compile(r"\w+")
_NOTHING = re.compile(r"(?:extern\s+|static\s+|inline\s+)*void\s+\w+\s*\(")
_CLOSES = {")": "(", "]": "[", "}": "{"}
Lines = Mapping[tuple[str, str], int]
"""(key, value) of each marker of a piece -> its line."""


def check_piece(piece: AdapterPiece, lines: Lines, text_line: int) -> None:
    """Check a piece's markers against its text.

    Args:
        piece: the piece as it was read.
        lines: the lines of its markers.
        text_line: the first line of its text.

    Raises:
        PlatformDataError: they contradict each other, or a bracket of the text is not closed.
    """
    found = tokens(piece.text.encode())

    def wrong(key: str, value: str, message: str, fix: str) -> PlatformDataError:
        line = lines.get((key, value)) or next(
            (at for (k, v), at in lines.items() if k == key and value in _WORD.findall(v)), None
        )
        return PlatformDataError(message, location=Location(piece.location.path, line or piece.location.line), fix=fix)

    _brackets(piece, found, text_line)
    words = {word for kind, *_, text in found if kind in ("name", "directive") for word in _WORD.findall(text)}
    name = piece.target_name or piece.name
    if piece.kind != "helper" and name not in words:
        raise wrong("name", piece.target_name, f"the text of '{piece.name}' has no '{name}'", "write it, or correct the name")
    for port in piece.ports:
        if port.constant not in words:
            raise wrong(
                "port", port.constant, f"the text does not use the port '{port.constant}'", "use it, or remove the marker"
            )
    for table in piece.tables:
        if table.name not in words:
            raise wrong("table", table.name, f"the text does not use the table '{table.name}'", "use it, or remove the marker")
    _vectors(piece, found, wrong)
    if piece.kind == "adapter":
        _parameters(piece, found, name, wrong)


def _brackets(piece: AdapterPiece, found: list[Token], text_line: int) -> None:
    """Refuse a text with unbalanced brackets. Texts with preprocessor conditions are not checked: branches may open one twice."""
    if any(kind == "directive" and re.match(r"#\s*if", text) for kind, *_, text in found):
        return

    def broken(at: int, what: str) -> PlatformDataError:
        line = text_line + piece.text.encode()[:at].count(b"\n")
        message = f"the text of '{piece.name}' does not compile: {what}"
        return PlatformDataError(message, location=Location(piece.location.path, line), fix="close each bracket where it belongs")

    opened: list[tuple[str, int]] = []
    for kind, start, _, text in found:
        if kind != "punct":
            continue
        if text in "([{":
            opened.append((text, start))
        elif text in _CLOSES:
            if not opened:
                raise broken(start, f"'{text}' has no opening bracket")
            before, at = opened.pop()
            if before != _CLOSES[text]:
                raise broken(at, f"'{before}' is never closed")
    if opened:
        raise broken(opened[-1][1], f"'{opened[-1][0]}' is never closed")


_Wrong = Callable[[str, str, str, str], PlatformDataError]


def _vectors(piece: AdapterPiece, found: list[Token], wrong: _Wrong) -> None:
    handled = {found[at + 2][3] for at, token in enumerate(found[:-2]) if token[3] == "ISR" and found[at + 1][3] == "("}
    for vector in piece.vectors:
        if vector not in handled:
            raise wrong("vector", vector, f"the text has no ISR({vector})", "write it, or remove it from `vector`")
    for vector in sorted(handled - set(piece.vectors)):
        message = f"'{piece.name}' handles {vector}, but its head does not list it"
        raise wrong("", "", message, f"add `vector: {vector}`; only one piece can handle an interrupt")


def _parameters(piece: AdapterPiece, found: list[Token], name: str, wrong: _Wrong) -> None:
    definitions = list(_defined(found, name))
    if not definitions:
        message = f"the text of the adapter '{piece.name}' does not define a function '{name}'"
        raise wrong("name", name, message, "write the function, or give its name with `name`")
    known = {parameter for names in definitions for parameter in names}
    for key, values in (("pin", [pin.name for pin in piece.pins]), ("symmetric", piece.symmetric)):
        for value in values:
            if value not in known:
                hint = did_you_mean(value, sorted(known - {""}))
                raise wrong(key, value, f"'{name}' has no parameter '{value}'{hint}", f"correct the name in `{key}`")
    for signature in piece.signatures:
        said = _SIGNATURE.fullmatch(signature.strip())
        if said is None or said["name"] != piece.name:
            message = f"'{signature}' is not a signature of '{piece.name}'"
            raise wrong("for", signature, message, f"write it as the source's header does: RESULT {piece.name}(PARAMETERS)")
        count = len(split_arguments(said["parameters"]))
        if "..." not in said["parameters"] and all(len(names) != count for names in definitions):
            message = f"the function '{name}' takes {quantity(len(definitions[0]), 'parameter')}, '{signature}' has {count}"
            raise wrong("for", signature, message, "use the same number of parameters in both")
        nothing = _returns_nothing(found, name)
        if nothing is not None and nothing is not bool(_NOTHING.match(signature.strip())):
            gives = "returns nothing" if nothing else "returns a value"
            message = f"the function '{name}' {gives}, but '{signature}' differs"
            raise wrong("for", signature, message, "use the same return type in both")


def _returns_nothing(found: list[Token], name: str) -> bool | None:
    """Whether the first definition of a function returns `void`; None if there is no definition, or it is a macro."""
    for at in range(1, len(found) - 1):
        if found[at][3] == name and found[at + 1][3] == "(":
            end = closing(found, at + 1) + 1
            if end < len(found) and found[end][3] == "{":
                return found[at - 1][3] == "void"
    return None


def parameters_of(text: str, name: str) -> list[str]:
    """The names of the parameters of a function that a text defines; empty texts for unnamed ones.

    Args:
        text: the text.
        name: the function's name; if it is not defined, the result is empty.
    """
    return next(_defined(tokens(text.encode()), name), [])


def split_arguments(parameters: str) -> list[str]:
    """Split a parameter list into its parameters; empty for `void` or an empty list."""
    depth, parts = 0, [""]
    for character in parameters:
        depth += (character in "(<[{") - (character in ")>]}")
        if character == "," and not depth:
            parts.append("")
        else:
            parts[-1] += character
    parts = [part.strip() for part in parts]
    return [] if parts in ([""], ["void"]) else parts


def _defined(found: list[Token], name: str) -> Iterator[list[str]]:
    """The parameter names of each definition of a function or macro; empty texts for unnamed ones."""
    for at, (kind, _, _, text) in enumerate(found):
        if kind == "directive" and (macro := re.match(rf"#\s*define\s+{re.escape(name)}\(([^)]*)\)", text)):
            yield split_arguments(macro[1])
        if text != name or at + 1 == len(found) or found[at + 1][3] != "(":
            continue
        end = closing(found, at + 1)
        if found[end + 1 : end + 2] and found[end + 1][3] == "{":
            yield _names(found[at + 2 : end])


def _names(inside: list[Token]) -> list[str]:
    """The name of each parameter: its last word, or the one in the first parentheses of a function pointer."""
    parts: list[list[Token]] = [[]]
    depth = 0
    for token in (each for each in inside if each[0] != "comment"):
        depth += (token[3] in "(<[{") - (token[3] in ")>]}")
        if token[3] == "," and not depth:
            parts.append([])
        else:
            parts[-1].append(token)
    if len(parts) == 1 and [text for *_, text in parts[0]] in ([], ["void"]):
        return []
    return [_name(part) for part in parts]


def _name(part: list[Token]) -> str:
    texts = [text for *_, text in part]
    for stop in ("=", "["):
        if stop in texts:
            texts = texts[: texts.index(stop)]
    if "(" in texts:
        texts = texts[: texts.index(")")]
    return texts[-1] if len(texts) > 1 and _WORD.fullmatch(texts[-1]) else ""
