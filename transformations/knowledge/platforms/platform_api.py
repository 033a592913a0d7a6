"""The API of a source platform: which header declares a name, as what, and what it means.

`ApiIndex` is a view on the repository's facts (`platform_folder`) or on a stored platform model (`StoredFacts`), so that a stored
plan is checked with the facts of the time when it was made. No platform is known by name here, and no program is read; the
queries in `queries.code` combine both.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache, cached_property
from typing import TYPE_CHECKING, Protocol

from robosmi.metamodels import platform as pf
from robosmi.transformations.knowledge.api_data import FunctionMeaning, HeaderContent, PlatformSettings, SketchSettings
from robosmi.transformations.knowledge.api_facts import (
    COMPILER,
    DIRECTIONS,
    HEADER_KINDS,
    RELATIONS,
    ApiEntry,
    ApiFacts,
    Convention,
    PinFacts,
    PinParameter,
)
from robosmi.transformations.knowledge.platforms.board_pins import BoardPins, board_pins
from robosmi.transformations.knowledge.platforms.platform_folder import facts_of, forget_folders, platform_folder

if TYPE_CHECKING:
    from robosmi.metamodels import platform as pf
    from robosmi.transformations.knowledge.adapters.adapter_index import AdapterIndex


class DeclaredPins(Protocol):
    """The pins of functions that a platform's own data does not cover."""

    @property
    def index(self) -> AdapterIndex | None:
        """The adapter files that declare them; None if a stored plan does."""

    def of(self, function: str, header: str) -> PinFacts | None:
        """The pins of a function; None where none are declared.

        Args:
            function: its name.
            header: where it is declared; empty where nobody knows it.
        """


_PORTS = 32
"""Number of ports if the platform states none: the bits of a word."""


PREFIX = "P"
"""What stands in front of a port's number if the platform states nothing."""


class ApiIndex:
    """The API of one platform.

    Args:
        facts: the facts about it.
        adapters: the target's adapters, which declare the pins of functions that the facts do not cover.
        board: the pins of the board that the program runs on; None on a platform with one board.
    """

    def __init__(self, facts: ApiFacts, adapters: DeclaredPins | None = None, board: BoardPins | None = None) -> None:
        self._facts, self.adapters, self.board = facts, adapters, board
        self._headers, self._entries = facts.headers, facts.entries
        self._closures: dict[tuple[str, ...], tuple[str, ...]] = {}
        self._declared: dict[str, set[str]] = {}

    @staticmethod
    def load(name: str) -> ApiIndex:
        """The index of a platform of the repository, cached for the process.

        Raises:
            PlatformDataError: the repository has no such platform, or its data is damaged.
        """
        return _load(str(platform_folder(name)))

    @staticmethod
    def of(model: pf.Platform) -> ApiIndex:
        """The index of a stored platform model; it knows what the program of that plan uses, and no more."""

        return ApiIndex(StoredFacts(model), board=board_pins(model.boardMappings))

    def adapted(self, adapters: DeclaredPins) -> ApiIndex:
        """The same platform, extended by what a target's adapters declare about the pins of its functions."""
        return ApiIndex(self._facts, adapters, self.board)

    def on_board(self, board: BoardPins | None) -> ApiIndex:
        """The same platform for programs that run on a board."""
        return ApiIndex(self._facts, self.adapters, board)

    @property
    def name(self) -> str:
        """The platform's name."""
        return str(self.settings["name"])

    @property
    def origin(self) -> str:
        """Where the facts come from; two platforms have two origins."""
        return self._facts.origin

    @property
    def settings(self) -> PlatformSettings:
        """The platform's settings: widths of types, how programs are parsed."""
        return self._facts.settings

    @property
    def sketch(self) -> SketchSettings | None:
        """Which files the platform's tools join to one text; None if they join none."""
        return self.settings["parser"].get("sketch")

    @property
    def ports(self) -> int:
        """How many ports a board of the platform has; their numbers begin with 0."""
        return self.board.count if self.board is not None else int(self.settings.get("ports", {}).get("count", _PORTS))

    def port_name(self, number: int) -> str:
        """What a port is called by its number alone."""
        return self.board.labels.get(number, f"D{number}") if self.board is not None else f"{self._port_prefix}{number}"

    def port_number(self, name: str) -> int | None:
        """The number of a port that the user names by it; None for another name."""
        if self.board is not None:
            return self.board.names.get(name)
        digits = name.removeprefix(self._port_prefix)
        return int(digits) if name.startswith(self._port_prefix) and digits.isdecimal() else None

    @property
    def _port_prefix(self) -> str:
        """What stands in front of a port's number where no board names its pins."""
        return str(self.settings.get("ports", {}).get("prefix", PREFIX))

    @cached_property
    def pin_constants(self) -> Mapping[str, int]:
        """Constant of the platform that is a pin of the board -> its number."""
        names = self.board.names if self.board is not None else {}
        return {name: number for name, number in names.items() if name in self._entries}

    def header_kind(self, header: str) -> str | None:
        """platform, standard or posix; None for a header that the platform does not know."""
        content = self._headers.get(header)
        if content is not None:
            return HEADER_KINDS[content["kind"]]
        return "standard" if header in self.virtual_headers() else None

    def raw_kind(self, header: str) -> str | None:
        """The kind of a header as `api.json` writes it (also std-internal); None for an unknown one."""
        content = self._headers.get(header)
        return str(content["kind"]) if content is not None else self.header_kind(header)

    def includes(self, header: str) -> Sequence[str]:
        """The headers that a header includes itself."""
        content = self._headers.get(header)
        return list(content.get("includes", ())) if content is not None else []

    def closure(self, includes: Iterable[str]) -> tuple[str, ...]:
        """The headers that these includes bring in, an including header before the ones it includes."""
        key = tuple(includes)
        known = self._closures.get(key)
        if known is None:
            order: dict[str, None] = {}
            pending = list(reversed(key))
            while pending:
                header = pending.pop()
                if header in self._headers and header not in order:
                    order[header] = None
                    pending.extend(reversed(self._headers[header].get("includes", ())))
            known = self._closures[key] = tuple(order)
        return known

    def entries(self, name: str) -> Sequence[ApiEntry]:
        """All declarations of a name, in the order of their headers' names; empty for an unknown name."""
        return self._entries.get(name, ())

    def declared(self, header: str) -> dict[str, ApiEntry]:
        """What a header itself declares, by name."""
        return {name: entry for name, entries in self._entries.items() for entry in entries if entry.header == header}

    def functions_of(self, header: str) -> list[str]:
        """The names of the functions that a header declares."""
        return sorted(
            name for name, entries in self._entries.items() if any(e.header == header and e.kind == "function" for e in entries)
        )

    def resolve(self, name: str, includes: Iterable[str]) -> ApiEntry | None:
        """The declaration of a name that a program with these includes refers to; None if the platform does not know the name.

        Headers reached by the includes are searched first, in order of inclusion; a variable that both the platform and a
        standard header declare is the platform's. Then, for a program that lacks the include, other platform headers are
        searched before standard ones. A header that is an alternative to an included one, with functions of the same names, is
        skipped: the included header then has the name, and nothing is known about it.
        """
        found = self.entries(name)
        if not found:
            return None
        order = {header: i for i, header in enumerate(self.closure(includes))}
        outside = len(order)

        def rank(entry: ApiEntry) -> tuple[bool, bool, int, bool, str]:
            foreign, place = self.kind_of(entry) != "platform", order.get(entry.header, outside)
            return place == outside, foreign and entry.kind == "variable", place, foreign, entry.header

        best = min(found, key=rank)
        if best.header in order or best.kind != "function":
            return best
        meant = next((header for header in order if header in self._alternatives(best.header)), "")
        return best._replace(header=meant, detail="", parameters="") if meant else best

    def _alternatives(self, header: str) -> frozenset[str]:
        """The headers of the platform that declare functions of the same names as a header, and neither brings in the other."""
        if not self._declared:
            for name, entries in self._entries.items():
                for entry in entries:
                    if entry.kind == "function" and entry.header and self.kind_of(entry) == "platform":
                        self._declared.setdefault(entry.header, set()).add(name)
        own = self._declared.get(header, set())
        return frozenset(
            other
            for other, names in self._declared.items()
            if other != header and names & own and other not in self.closure([header]) and header not in self.closure([other])
        )

    def kind_of(self, entry: ApiEntry) -> str:
        """platform, standard or posix, as the entry's header is; builtins of the compiler are the platform's."""
        return self.header_kind(entry.header) or "platform" if entry.header else "platform"

    def signature(self, name: str, entry: ApiEntry) -> str:
        """Return type, name and parameters of a function; `name(...)` for a function-like macro; type and name of others."""
        if entry.kind == "function":
            return f"{entry.detail}{'' if entry.detail.endswith('*') else ' '}{name}{entry.parameters}"
        if entry.kind == "function_macro":
            return f"{name}(...)"
        return f"{entry.detail} {name}".strip()

    def pins(self, function: str, header: str) -> PinFacts | None:
        """The pins of a function: from its header, else from its adapter; None if neither declares any."""
        known = self._facts.pins.get((function, header))
        if known is None:
            return self.adapters.of(function, header) if self.adapters is not None else None
        if self.board is None or not any(parameter.numbering for parameter in known.parameters):
            return known
        return PinFacts(tuple(self._numbered(parameter) for parameter in known.parameters), known.conventions)

    def functions_with_pins(self) -> list[tuple[str, str]]:
        """Name and header of the functions, and of the classes whose constructors, take pins."""
        return sorted(self._facts.pins)

    def _numbered(self, parameter: PinParameter) -> PinParameter:
        assert self.board is not None
        numbers = self.board.numbers(parameter.numbering) if parameter.numbering else {}
        return parameter._replace(numbers=tuple(numbers.items()))

    def meaning(self, function: str) -> FunctionMeaning:
        """The known facts about a function: parameters, blocking, startsCog."""
        return self._facts.functions.get(function, {})

    def symbol_meaning(self, symbol: str) -> Mapping[str, str]:
        """The known facts about another name: kind, type, meaning."""
        return self._facts.symbols.get(symbol, {})

    def symbol_kind(self, name: str, entry: ApiEntry) -> str:
        """macro, constant, register or variable (contract: `platform_symbols[].kind`)."""
        if self.is_register(name):
            return "register"
        return {"macro": "macro", "function_macro": "macro", "constant": "constant"}.get(entry.kind, "variable")

    def is_register(self, name: str) -> bool:
        """Whether the platform has a register of that name."""
        return name in self._facts.registers

    def code_argument(self, function: str) -> int | None:
        """Which argument, from 0, is the code that a function starts on another core; None for a function that starts none."""
        position = self._facts.code_arguments.get(function)
        return None if position is None else int(position)

    def starts_cog(self, function: str, header: str) -> bool:
        """Whether a function, as the header declares it, starts code on another core, its own or that of its library."""
        if self.code_argument(function) is not None or function in self._facts.library_cores.get(header, ()):
            return True
        return bool(self.meaning(function).get("startsCog", False))

    def virtual_headers(self) -> Mapping[str, bytes]:
        """Our own text of the standard headers, by the name a program includes."""
        return self._facts.virtual_headers


def forget_platforms() -> None:
    """Clear the cache of platforms, because one was imported."""
    _load.cache_clear()
    forget_folders()


@cache
def _load(folder: str) -> ApiIndex:
    return ApiIndex(facts_of(folder))


# ---- stored platform models

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
        self.settings["ports"] = {"registers": bits, "prefix": str(model.portPrefix)}
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
        str(parameter.numbering or ""),
    )


def _convention(convention: pf.PinConvention) -> Convention:
    when = None
    for condition in convention.conditions:
        when = {"index": int(condition.position), _WORDS[condition.relation.name]: int(condition.value)}
    return Convention(
        int(convention.pin), _IN_DATA[convention.direction.name], str(convention.what), str(convention.setBy or "") or None, when
    )
