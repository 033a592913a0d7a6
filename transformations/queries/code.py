"""Operations on code models together with a platform's API: what is agnostic, what depends on the platform, what is unknown.

The on-demand queries of the paper's static analysis (3.1), in EOL's style, reused by rules, constraints and templates. A
definition of the program's own always wins over a platform's name; locals shadow it, since the model's links say what a
name means. Structure of main is in `main_program`, values of pins in `pin_uses`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from typing import Any, TypeAlias, TypeVar

from msgspec import Struct
from msgspec.structs import replace

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import Q, all_contents
from robosmi.transformations.knowledge.api_facts import ApiEntry
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.macros.tokens import names_in
from robosmi.transformations.queries.names import name_or_text
from robosmi.transformations.queries.own_headers import all_includes, included, includes_of_units, is_member
from robosmi.transformations.queries.reached_values import ReachedValues
from robosmi.transformations.queries.values import Values

T = TypeVar("T")
_CALLED = re.compile(r"(?<![\w.#>])([A-Za-z_]\w*)\s*\(")
_LITERALS = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|/\*.*?(?:\*/|\Z)|//[^\n]*', re.DOTALL)


class CalledFunction(Struct):
    """A function that a unit calls and does not define, with all its calls.

    Attributes:
        name: as the user wrote it.
        calls: the call elements in text order, without those in bodies of the program's own macros.
        entry: how the repository knows it, None where it does not.
        header: where it resolves, empty for unknown functions and for builtins of the compiler.
        signature: the paper's raw signature: from the header that was read, the repository, or inferred.
        signature_source: header, repository or inferred.
        in_macro: it is also named in the body of a macro of the program's own.
        made: the calls that macros of the program make where they are used; of no unit's text, so that `calls` has none of them.
        callee: the model's function, None where it is named in macros only.
    """

    name: str
    calls: list[ccode.Call] = []
    entry: ApiEntry | None = None
    header: str = ""
    signature: str = ""
    signature_source: str = "inferred"
    in_macro: bool = False
    made: list[ccode.Call] = []
    callee: ccode.Function | None = None

    @property
    def header_macro(self) -> bool:
        """True for a function-like macro of a header that was read and that is not the platform's."""
        return self.signature_source == "header" and self.entry is None and self.signature == f"{self.name}(...)"

    @property
    def lines(self) -> list[int]:
        """Lines of the calls, sorted, one a call."""
        return sorted(int(call.line) for call in self.calls)


class UsedName(Struct):
    """A symbol or type of the platform that a unit uses: name, kind, header, lines (each once, sorted)."""

    name: str
    kind: str
    header: str
    lines: list[int] = []


class Constructs(Struct):
    """The platform-dependent constructs of a program or unit (paper 3.1), and unknown functions."""

    functions: list[CalledFunction]
    unknown: list[CalledFunction]

    def names(self) -> list[str]:
        """Names of the platform's functions, sorted."""
        return sorted(f.name for f in self.functions)


class CodeView:
    """A unit with its elements and calls, collected once for many queries; its code model must not change any more.

    Args:
        unit: the unit.
        program: its program.
        api: the source platform's API.
        includes: the headers that it includes, where they are known already.
    """

    def __init__(
        self, unit: ccode.SourceUnit, program: ccode.Program, api: ApiIndex, includes: tuple[str, ...] | None = None
    ) -> None:
        self.unit = unit
        self.program = program
        self.api = api
        self.includes = all_includes(unit) if includes is None else includes
        self.elements: list[Element] = list(all_contents(unit))
        self.calls: list[ccode.Call] = _distinct(e for e in self.elements if isinstance(e, ccode.Call) and not e.viaMacro)
        self.own_macros: dict[str, ccode.Macro] = {str(m.name): m for m in unit.macros}
        self._functions: dict[str, CalledFunction] | None = None
        self._kinds: dict[type, list[Any]] = {}

    def of_kind(self, kind: type[T]) -> Sequence[T]:
        """The unit's elements of a kind, a container before what it contains."""
        found = self._kinds.get(kind)
        if found is None:
            wanted = {cls for cls in {each.__class__ for each in self.elements} if issubclass(cls, kind)}
            found = self._kinds[kind] = [x for x in self.elements if x.__class__ in wanted]
        return found

    def resolve(self, name: str) -> ApiEntry | None:
        """The declaration that a name means in this unit, None where the repository does not know it."""
        return self.api.resolve(name, self.includes)

    def kind(self, name: str) -> str | None:
        """platform, standard or posix; None for a name that the repository does not know."""
        entry = self.resolve(name)
        return self.api.kind_of(entry) if entry else None

    def defined(self, name: str) -> bool:
        """Whether the program itself defines a function of that name.

        A macro of the name does not count: a call or a use in the model is what macros have made of the text, so that it means
        the function, as in `#define high(p) high(p)` or behind `#undef high`.
        """
        return name in self._defined

    @cached_property
    def _defined(self) -> set[str]:
        return _definitions(self.program, self.unit)

    @cached_property
    def values(self) -> Values:
        """The values that expressions of the unit have; what is once found is kept."""
        return Values(self.program, self.unit, self.api.pin_constants, self._takes_pins)

    def _takes_pins(self, function: str, position: int) -> bool:
        """Whether a parameter of a platform function is a pin or an array of pins, which it only reads."""
        entry = self.resolve(function) if not self.defined(function) else None
        facts = self.api.pins(function, entry.header) if entry is not None else None
        return facts is not None and any(parameter.position == position for parameter in facts.parameters)

    @cached_property
    def reached_values(self) -> ReachedValues:
        """The values that expressions of the unit may have while the program runs."""
        return ReachedValues(self.program, self.unit, self.api.pin_constants, self._takes_pins)

    def called(self) -> dict[str, CalledFunction]:
        """Every function that is called and not defined in the program, by name, without computed callees and pure methods."""
        if self._functions is None:
            found: dict[str, CalledFunction] = {}
            for call in self.calls:
                name, callee = str(call.calleeName or ""), call.callee
                if not name or (callee is not None and (callee.definition or callee.pure)):
                    continue
                found.setdefault(name, CalledFunction(name, callee=callee)).calls.append(call)
            for name in self._called_in_macros():
                found.setdefault(name, CalledFunction(name)).in_macro = True
            for name, made in self.macro_calls.items():
                if name in found or (not self.defined(name) and self.resolve(name) is not None):  # a body may not show the name
                    found.setdefault(name, CalledFunction(name, in_macro=True)).made = made
            for function in found.values():
                self._describe(function)
            self._functions = dict(sorted(found.items()))
        return self._functions

    @cached_property
    def macro_calls(self) -> dict[str, list[ccode.Call]]:
        """The calls that the program's macros make where they are used in the unit, by name of the function."""
        found: dict[str, list[ccode.Call]] = {}
        for call in self.of_kind(ccode.Call):
            if call.viaMacro and call.calleeName:
                found.setdefault(str(call.calleeName), []).append(call)
        return found

    def _called_in_macros(self) -> Iterator[str]:
        own = self._defined
        for macro in self.own_macros.values():
            parameters = set(macro.parameters)
            for name in _CALLED.findall(_LITERALS.sub(" ", str(macro.body or ""))):
                if name not in own and name not in parameters and (name == macro.name or name not in self.own_macros):
                    entry = self.resolve(name)
                    if entry is not None and entry.callable:
                        yield name

    def _describe(self, function: CalledFunction) -> None:
        callee = function.callee
        header = str(callee.header or "") if callee is not None else ""
        entry = self.resolve(function.name)
        if (
            entry is not None and not entry.callable and entry.kind != "macro"
        ):  # an object-like macro may be a function's other name
            entry = None
        if header and (entry is None or entry.header != header):
            known = [e for e in self.api.entries(function.name) if e.header == header and e.callable]
            if known:
                entry = known[0]
            elif (kind := self.api.header_kind(header)) is not None:
                entry = ApiEntry(header, "function", "", "") if kind else None
            else:
                entry = None  # a header of the user's own declares it
        function.entry = entry
        function.header = entry.header if entry else header
        if header and callee is not None:
            function.signature, function.signature_source = str(callee.signature), "header"
        elif entry is not None and (entry.detail or entry.kind == "function_macro"):
            function.signature, function.signature_source = self.api.signature(function.name, entry), "repository"
        elif callee is not None:
            function.signature = str(callee.signature or "")

    def functions_of(self, *kinds: str) -> list[CalledFunction]:
        """The called functions whose header is of one of the kinds."""
        return [f for f in self.called().values() if f.entry is not None and self.api.kind_of(f.entry) in kinds]

    def unknown(self) -> list[CalledFunction]:
        """The called functions that neither the program nor the repository declares."""
        return [f for f in self.called().values() if f.entry is None and f.calls and not f.header_macro]

    def header_macros(self) -> list[CalledFunction]:
        """The function-like macros of the user's own headers that are used."""
        return [f for f in self.called().values() if f.entry is None and f.calls and f.header_macro]

    def symbols(self) -> list[UsedName]:
        """Constants, registers, variables and macros of the platform that are used as values, in bodies of own macros too."""
        uses: dict[str, set[int]] = {}
        for element in self.elements:
            if isinstance(element, ccode.NameReference):
                target = element.target
                if target is None or isinstance(target, ccode.ExternalSymbol):
                    uses.setdefault(str(element.name), set()).add(int(element.line))
            elif isinstance(element, ccode.MacroUse) and element.macro is None:
                uses.setdefault(str(element.name), set()).add(int(element.line))
        for macro in self.own_macros.values():
            for name in names_in(str(macro.body or "")) - set(macro.parameters):
                if not self.defined(name) and name not in self._own_variables:
                    uses.setdefault(name, set()).add(int(macro.line))
        found: list[UsedName] = []
        for name, lines in sorted(uses.items()):
            entry = None if name in self.own_macros or name in self.called() else self.resolve(name)
            if entry is not None and entry.kind in ("macro", "variable", "constant") and self.api.kind_of(entry) == "platform":
                found.append(UsedName(name, self.api.symbol_kind(name, entry), entry.header, sorted(lines)))
        return found

    @cached_property
    def _own_variables(self) -> set[str]:
        return {str(d.name) for d in self.unit.declarations}

    def types(self) -> list[UsedName]:
        """Types of the platform that declarations, casts and sizes use."""
        uses: dict[str, set[int]] = {}
        for element in self.elements:
            if isinstance(element, ccode.TypeUse) and isinstance(element.declaration, ccode.ExternalSymbol):
                uses.setdefault(str(element.declaration.name), set()).add(_line(element))
        for macro in self.own_macros.values():
            for name in names_in(str(macro.body or "")):
                entry = self.resolve(name)
                if entry is not None and entry.kind == "type" and name in uses:
                    uses[name].add(int(macro.line))
        found: list[UsedName] = []
        for name, lines in sorted(uses.items()):
            entry = self.resolve(name)
            if entry is not None and entry.kind == "type" and self.api.kind_of(entry) == "platform":
                found.append(UsedName(name, "type", entry.header, sorted(lines)))
        return found


def views(program: ccode.Program, api: ApiIndex) -> list[CodeView]:
    """A view for each unit of a program."""
    includes = includes_of_units(program)
    return [CodeView(unit, program, api, includes[id(unit)]) for unit in program.units]


def platform_agnostic_libraries(program: ccode.Program, api: ApiIndex) -> Q[ccode.Include]:
    """The include directives of standard headers, which stay as they are (paper 3.1).

    POSIX headers count as standard here; `api.header_kind` tells them apart, since a target may not have them.
    """
    return Q(i for unit in program.units for i in unit.includes if api.header_kind(str(i.header)) in ("standard", "posix"))


def platform_dependent_libraries(program: ccode.Program, api: ApiIndex) -> Q[ccode.Include]:
    """The include directives of the platform's headers, which are not carried over (paper 3.1)."""
    return Q(i for unit in program.units for i in unit.includes if api.header_kind(str(i.header)) == "platform")


def platform_dependent_constructs(program: ccode.Program, api: ApiIndex) -> Constructs:
    """The functions of the platform that a program calls, with signature, header and calls; unknown ones apart (paper 3.1)."""
    platform: dict[str, CalledFunction] = {}
    unknown: dict[str, CalledFunction] = {}
    for view in views(program, api):
        _merge(platform, view.functions_of("platform"))
        _merge(unknown, view.unknown())
    return Constructs(list(platform.values()), list(unknown.values()))


def _merge(into: dict[str, CalledFunction], functions: Iterable[CalledFunction]) -> None:
    for function in functions:
        known = into.get(function.name)
        if known is None:
            into[function.name] = replace(function, calls=list(function.calls), made=list(function.made))  # the views keep theirs
        else:
            known.calls += function.calls
            known.made += function.made
            known.in_macro = known.in_macro or function.in_macro


def user_calls(program: ccode.Program) -> dict[str, list[ccode.Call]]:
    """The calls of functions that the program defines, by name."""
    found: dict[str, list[ccode.Call]] = {}
    for unit in program.units:
        for call in _distinct(e for e in all_contents(unit) if isinstance(e, ccode.Call) and not e.viaMacro):
            if call.callee is not None and call.callee.definition and call.calleeName:
                found.setdefault(str(call.calleeName), []).append(call)
    return dict(sorted(found.items()))


class CogStart(Struct):
    """Code that a program starts on another core: the call, the function that starts it, and the name of the code."""

    call: ccode.Call
    via: str
    function: str


def cogs_of(view: CodeView) -> list[CogStart]:
    """The cores that a unit starts, in text order."""
    found = []
    for function in view.called().values():
        position = view.api.code_argument(function.name)
        if position is None or function.entry is None:
            continue
        for call in function.calls:
            arguments = list(call.arguments)
            found.append(CogStart(call, function.name, _code_name(arguments[position]) if position < len(arguments) else ""))
    return sorted(found, key=_start_of_call)


def _start_of_call(start: CogStart) -> int:
    return int(start.call.startOffset)


def _code_name(argument: ccode.Expression) -> str:
    while True:
        if isinstance(argument, (ccode.Cast, ccode.Unary)) and argument.operand is not None:
            argument = argument.operand
        elif isinstance(argument, ccode.Call) and argument.calleeExpression is None and len(argument.arguments) == 1:
            argument = argument.arguments[0]
        else:
            break
    return name_or_text(argument)


def unit_of(element: Element | None) -> ccode.SourceUnit | None:
    """The unit that contains an element, None for externals."""
    while element is not None and not isinstance(element, ccode.SourceUnit):
        element = element.eContainer()
    return element


ValuesOf: TypeAlias = Callable[[ccode.SourceUnit], Values]
"""The values of expressions in a unit; it remembers what it has found."""


def argument_numbers(call: ccode.Expression, place: int, values: ValuesOf) -> set[int | None]:
    """The numbers that an argument of a call may be, with None for those that only the running program knows."""
    unit = unit_of(call)
    if unit is None or unit.program is None:
        return {None}
    given = list(call.arguments)[place : place + 1] if isinstance(call, ccode.Call) else []
    return {value.number for each in given for value in values(unit).of(each)}


def _definitions(program: ccode.Program, unit: ccode.SourceUnit) -> set[str]:
    """The names of functions that a program defines for a unit: its static ones, those of its headers, and all that are shared.

    Methods do not take the place of other functions of their names.
    """
    shared = [d for other in program.units for d in other.declarations if isinstance(d, ccode.Function) and d.definition]
    static = ccode.Storage.staticStorage
    names = {str(function.name) for function in shared if function.storage is not static and not is_member(function)}
    own = {id(each) for each in (unit, *included(unit))}
    return names | {str(f.name) for f in shared if f.storage is static and id(f.eContainer()) in own}


def _distinct(calls: Iterable[ccode.Call]) -> list[ccode.Call]:
    """Calls in text order; the argument of a macro that is expanded twice is one call."""
    found: dict[tuple[int, int, str], ccode.Call] = {}
    for call in calls:
        found.setdefault((int(call.startOffset), int(call.endOffset), str(call.calleeName)), call)
    return sorted(found.values(), key=_start)


def _start(call: ccode.Call) -> int:
    return int(call.startOffset)


def _line(element: Element | None) -> int:
    while element is not None and not isinstance(element, ccode.Located):
        element = element.eContainer()
    return int(element.line) if element is not None else 0
