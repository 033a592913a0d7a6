"""Builds elements of the platform metamodel from an `ApiIndex`, for the names that one program needs.

Only facts of the repository get in. Look-ups are in `platform_api`; decisions about the names are the plan's.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from robosmi.metamodels import platform as pf

if TYPE_CHECKING:
    from robosmi.transformations.t2m.platform_api import ApiIndex, Entry

DIRECTIONS = {"in": "input", "out": "output", "both": "both", "unknown": "unknown"}


def build(api: ApiIndex, names: Iterable[str], includes: tuple[str, ...]) -> pf.Platform:
    """The platform with the headers, functions and symbols of these names; names that nothing declares are left out."""
    by_header: dict[str, dict[str, Entry]] = {}
    for name in sorted(set(names)):
        entry = api.resolve(name, includes)
        if entry is not None:
            by_header.setdefault(entry.header, {})[name] = entry
    settings = api.settings
    return pf.Platform(
        name=api.name,
        language=settings.get("language", "C"),
        intBits=settings["int_bits"],
        longBits=settings["long_bits"],
        pointerBits=settings["pointer_bits"],
        doubleBits=settings["double_bits"],
        charSigned=settings["char_signed"],
        hasCogs=settings["has_cogs"],
        architecture=settings.get("architecture", ""),
        headers=[_header(api, header, entries) for header, entries in sorted(by_header.items())],
    )


def _header(api: ApiIndex, header: str, entries: dict[str, Entry]) -> pf.Header:
    kind = api.header_kind(header) or "platform"
    return pf.Header(
        name=header or "(compiler)",
        kind=getattr(pf.HeaderKind, kind),
        functions=[_function(api, name, entry) for name, entry in entries.items() if entry.callable],
        symbols=[_symbol(api, name, entry) for name, entry in entries.items() if not entry.callable],
    )


def _function(api: ApiIndex, name: str, entry: Entry) -> pf.ApiFunction:
    meaning = api.meaning(name)
    pins = api.pins(name, entry.header)
    meanings = list(meaning.get("parameters", ()))
    directions: dict[int, str] = {}
    for pin in pins.parameters if pins else ():
        meanings += [""] * (pin.position + 1 - len(meanings))
        meanings[pin.position] = "pin"
        directions[pin.position] = pin.direction
    declared = split_parameters(entry.parameters)
    variadic = "..." in declared
    declared = [p for p in declared if p not in ("...", "void")]
    parameters = []
    for i in range(max(len(declared), len(meanings))):
        spelling, own = _parameter(declared[i] if i < len(declared) else "")
        parameters.append(
            pf.ApiParameter(
                name=own,
                spelling=spelling,
                meaning=getattr(pf.Meaning, meanings[i] if i < len(meanings) and meanings[i] else "plain"),
                direction=getattr(pf.Direction, DIRECTIONS[directions.get(i, "unknown")]),
            )
        )
    return pf.ApiFunction(
        name=name,
        signature=api.signature(name, entry),
        returnType=entry.detail,
        variadic=variadic,
        functionLikeMacro=entry.kind == "function_macro",
        blocking=bool(meaning.get("blocking", False)),
        startsCog=api.starts_cog(name, entry.header),
        parameters=parameters,
        conventions=[
            pf.PinConvention(pin=c.pin, direction=getattr(pf.Direction, DIRECTIONS[c.direction]), what=c.what, setBy=c.set_by)
            for c in (pins.conventions if pins else ())
        ],
    )


def _symbol(api: ApiIndex, name: str, entry: Entry) -> pf.ApiSymbol:
    known: dict[str, Any] = api.symbol_meaning(name)
    return pf.ApiSymbol(
        name=name,
        symbolKind=getattr(pf.SymbolKind, known.get("kind") or api.symbol_kind(name, entry)),
        typeName=known.get("type") or entry.detail,
        meaning=known.get("meaning", ""),
    )


def split_parameters(text: str) -> list[str]:
    """The parameters of `(int a, void (*f)(int, int))`, split at the outer commas."""
    parts: list[str] = []
    depth, current = 0, ""
    for character in text.strip()[1:-1]:
        depth += (character == "(") - (character == ")")
        if character == "," and depth == 0:
            parts.append(current.strip())
            current = ""
        else:
            current += character
    return [*parts, current.strip()] if current.strip() else parts


def _parameter(text: str) -> tuple[str, str]:
    """Type and name of a parameter as declared; the name is empty where none is given."""
    if "(" in text:
        inner = text.partition("(*")[2].partition(")")[0].strip()
        return (text.replace(f"(*{inner})", "(*)", 1), inner) if inner.isidentifier() else (text, "")
    head, array = (text[: text.index("[")], text[text.index("[") :]) if "[" in text else (text, "")
    head = head.rstrip()
    cut = len(head)
    while cut and (head[cut - 1].isalnum() or head[cut - 1] == "_"):
        cut -= 1
    name, spelling = head[cut:], head[:cut].strip()
    if not spelling or name in ("int", "char", "long", "short", "unsigned", "float", "double", "void"):
        return text, ""
    return spelling + array, name
