"""Builds elements of the platform metamodel from an `ApiIndex`, for the names that one program needs.

Only facts of the repository get in. Look-ups and the way back are in `platform_api`; decisions about the names
are the plan's.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from robosmi.metamodels import platform as pf
from robosmi.model.elements.strict import enum_literal
from robosmi.transformations.knowledge.api_facts import COMPILER, DIRECTIONS, RELATIONS, ApiEntry, PinParameter
from robosmi.transformations.knowledge.platforms.platform_api import PREFIX, ApiIndex

_FUNCTION = re.compile(r"\(\s*(\w+)\s*\)\s*\(")


def platform_part(
    api: ApiIndex,
    names: Iterable[str],
    includes: Sequence[str] = (),
    words: Iterable[str] = (),
    units: Sequence[tuple[str, ...]] = (),
) -> pf.Platform:
    """The headers, functions, symbols and types of a platform that have these names; names that nothing declares are left out.

    Args:
        api: the platform.
        names: each is there in the one header where it resolves.
        includes: the headers that the program includes; all that they bring in are there.
        words: further names, there in each header that the program brings in and where they resolve in a unit.
        units: the includes of each unit.
    """
    by_header: dict[str, dict[str, ApiEntry]] = {}
    brought = api.closure(includes) if units else ()
    for header in brought:
        by_header[header] = {}
    for header in {h for unit in units for h in unit if api.header_kind(h) is not None}:
        by_header.setdefault(header, {})
    for name in sorted({*names, *words}):
        entries = [entry for entry in api.entries(name) if entry.header in by_header] if units else []
        for found in (*entries, api.resolve(name, includes), *(api.resolve(name, unit) for unit in units)):
            if found is not None and (found.detail or found.kind != "function"):  # of others no header says what they are
                by_header.setdefault(found.header, {})[name] = found
    settings = api.settings
    return pf.Platform(
        name=api.name,
        title=settings.get("title", api.name),
        language=settings.get("language", "C"),
        intBits=settings["int_bits"],
        longBits=settings["long_bits"],
        pointerBits=settings["pointer_bits"],
        doubleBits=settings["double_bits"],
        charSigned=settings["char_signed"],
        hasCogs=settings["has_cogs"],
        portCount=int(settings.get("ports", {}).get("count", 0)),
        portPrefix=str(settings.get("ports", {}).get("prefix", PREFIX)),
        architecture=settings.get("architecture", ""),
        attributeMacros=list(settings["parser"].get("attribute_macros", [])),
        headers=[_header(api, header, entries) for header, entries in sorted(by_header.items())],
    )


def _header(api: ApiIndex, header: str, entries: dict[str, ApiEntry]) -> pf.Header:
    kind = api.header_kind(header) or "platform"
    others = [(name, entry) for name, entry in entries.items() if not entry.callable]
    return pf.Header(
        name=header or COMPILER,
        kind=enum_literal(pf.HeaderKind, kind),
        includes=list(api.includes(header)),
        functions=[_function(api, name, entry) for name, entry in entries.items() if entry.callable],
        symbols=[_symbol(api, name, entry) for name, entry in others if entry.kind != "type"],
        types=[pf.ApiType(name=name, form=entry.detail) for name, entry in others if entry.kind == "type"],
    )


def _function(api: ApiIndex, name: str, entry: ApiEntry) -> pf.ApiFunction:
    meaning = api.meaning(name)
    pins = api.pins(name, entry.header)
    meanings = list(meaning.get("parameters", []))
    ports = {pin.position: pin for pin in (pins.parameters if pins else ())}
    for position in ports:
        meanings += [""] * (position + 1 - len(meanings))
        meanings[position] = "pin"
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
                meaning=enum_literal(pf.Meaning, meanings[i] if i < len(meanings) and meanings[i] else "plain"),
                direction=enum_literal(pf.Direction, DIRECTIONS[ports[i].direction if i in ports else "unknown"]),
                **(_port(ports[i]) if i in ports else {}),
            )
        )
    return pf.ApiFunction(
        name=name,
        signature=api.signature(name, entry),
        parameterList=entry.parameters,
        returnType=entry.detail,
        variadic=variadic,
        functionLikeMacro=entry.kind == "function_macro",
        blocking=bool(meaning.get("blocking", False)),
        longestMicroseconds=int(meaning.get("longest_us", 0)),
        startsCog=api.starts_cog(name, entry.header),
        codeArgument=-1 if (code := api.code_argument(name)) is None else code,
        parameters=parameters,
        conventions=[
            pf.PinConvention(
                pin=c.pin,
                direction=enum_literal(pf.Direction, DIRECTIONS[c.direction]),
                what=c.what,
                setBy=c.set_by,
                conditions=[_condition(c.when)] if c.when else [],
            )
            for c in (pins.conventions if pins else ())
        ],
    )


def _port(pin: PinParameter) -> dict[str, Any]:
    return {
        "isPort": True,
        "rangeWith": -1 if pin.range_with is None else pin.range_with,
        "span": pin.span,
        "numberAt": -1 if pin.number is None else pin.number,
        "none": list(pin.none),
        "numbering": pin.numbering,
    }


def _condition(when: Mapping[str, int]) -> pf.ArgumentCondition:
    relation = next(word for word in RELATIONS if word in when)
    return pf.ArgumentCondition(
        position=when["index"], relation=enum_literal(pf.Relation, RELATIONS[relation]), value=when[relation]
    )


def _symbol(api: ApiIndex, name: str, entry: ApiEntry) -> pf.ApiSymbol:
    known = api.symbol_meaning(name)
    return pf.ApiSymbol(
        name=name,
        form=entry.kind,
        portDirection=api.settings.get("ports", {}).get("registers", {}).get(name, ""),
        symbolKind=enum_literal(pf.SymbolKind, known.get("kind") or api.symbol_kind(name, entry)),
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
        text = _FUNCTION.sub(r"(*\1)(", text)  # a parameter that is a function is a pointer to one
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
