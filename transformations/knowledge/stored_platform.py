"""A stored platform model as `ApiFacts`, so that a stored plan is checked with the facts of the time when it was made."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from robosmi.metamodels import platform as pf
from robosmi.transformations.knowledge.api_data import FunctionMeaning, HeaderContent, PlatformSettings
from robosmi.transformations.knowledge.api_facts import (
    COMPILER,
    DIRECTIONS,
    RELATIONS,
    ApiEntry,
    Convention,
    PinFacts,
    PinParameter,
)

_IN_DATA = {literal: word for word, literal in DIRECTIONS.items()}
_WORDS = {literal: word for word, literal in RELATIONS.items()}


class StoredFacts:
    """The facts of a platform model; see `ApiFacts` for the attributes.

    Args:
        model: the platform, as a plan refers to it.
    """

    def __init__(self, model: pf.Platform) -> None:
        self.origin = f"stored model of {model.name}"
        self.settings: PlatformSettings = {
            "name": str(model.name),
            "language": str(model.language),
            "int_bits": model.intBits,
            "long_bits": model.longBits,
            "pointer_bits": model.pointerBits,
            "double_bits": model.doubleBits,
            "char_signed": model.charSigned,
            "has_cogs": model.hasCogs,
            "parser": {"attribute_macros": list(model.attributeMacros)},
        }
        self.headers: dict[str, HeaderContent] = {}
        self.entries: dict[str, list[ApiEntry]] = {}
        self.pins: dict[tuple[str, str], PinFacts] = {}
        self.functions: dict[str, FunctionMeaning] = {}
        self.symbols: dict[str, dict[str, str]] = {}
        self.code_arguments: dict[str, int] = {}
        self.library_cores: dict[str, Sequence[str]] = {}
        self.virtual_headers: Mapping[str, bytes] = {}
        registers: set[str] = set()
        bits: dict[str, str] = {}
        for header in model.headers:
            name = "" if header.name == COMPILER else str(header.name)
            if name:
                self.headers[name] = {"kind": header.kind.name, "includes": list(header.includes)}
            for function in header.functions:
                self._add_function(name, function)
            for symbol in header.symbols:
                self._add(str(symbol.name), ApiEntry(name, str(symbol.form), str(symbol.typeName)))
                if symbol.symbolKind is pf.SymbolKind.register:
                    registers.add(str(symbol.name))
                if symbol.portDirection:
                    bits[str(symbol.name)] = str(symbol.portDirection)
                if symbol.meaning:
                    self.symbols[str(symbol.name)] = {"meaning": str(symbol.meaning), "kind": symbol.symbolKind.name}
            for declared in header.types:
                self._add(str(declared.name), ApiEntry(name, "type", str(declared.form)))
        self.registers = frozenset(registers)
        self.settings["ports"] = {"registers": bits}
        if model.portCount:
            self.settings["ports"]["count"] = model.portCount

    def _add(self, name: str, entry: ApiEntry) -> None:
        self.entries.setdefault(name, []).append(entry)

    def _add_function(self, header: str, function: pf.ApiFunction) -> None:
        name = str(function.name)
        kind = "function_macro" if function.functionLikeMacro else "function"
        self._add(name, ApiEntry(header, kind, str(function.returnType), str(function.parameterList)))
        self.functions[name] = {
            "blocking": bool(function.blocking),
            "longest_us": int(function.longestMicroseconds),
            "parameters": ["" if p.meaning is pf.Meaning.plain else p.meaning.name for p in function.parameters],
        }
        if function.codeArgument >= 0:
            self.code_arguments[name] = int(function.codeArgument)
        if function.startsCog:
            self.library_cores[header] = [*self.library_cores.get(header, ()), name]
        pins = tuple(_pin(at, p) for at, p in enumerate(function.parameters) if p.meaning is pf.Meaning.pin and p.isPort)
        conventions = tuple(_convention(each) for each in function.conventions)
        if pins or conventions:
            self.pins[(name, header)] = PinFacts(pins, conventions)


def _pin(position: int, parameter: pf.ApiParameter) -> PinParameter:
    return PinParameter(
        position,
        str(parameter.name),
        _IN_DATA[parameter.direction.name],
        None if parameter.rangeWith < 0 else int(parameter.rangeWith),
        int(parameter.span),
        None if parameter.numberAt < 0 else int(parameter.numberAt),
        tuple(parameter.none),
    )


def _convention(convention: pf.PinConvention) -> Convention:
    when = None
    for condition in convention.conditions:
        when = {"index": int(condition.position), _WORDS[condition.relation.name]: int(condition.value)}
    return Convention(
        int(convention.pin), _IN_DATA[convention.direction.name], str(convention.what), str(convention.setBy or "") or None, when
    )
