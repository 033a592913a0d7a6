"""Follows the pins through a finished program: which values reach the parameters that are pins of the target.

This is a check of the text that was generated, by a parse of its own. It shares nothing with the analysis of the source that
decided on the changes of the text, so that a fault there is seen here. Each value goes back over variables, members, parameters,
default arguments and results to where it is written. It has to be a pin there: a constant of the hardware, a pin that a decision
of the plan has put into the text, or the result of a look-up. All places that write a variable count, whenever they do.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from msgspec import Struct

from robosmi.transformations.t2m.c_source.parsing import clang, cursor_kinds as kinds
from robosmi.transformations.t2m.c_source.parsing.clang import Cursor
from robosmi.transformations.t2m.c_source.parsing.generated_names import (
    ADD,
    ADDRESS,
    ASSIGN,
    CASTS,
    COMMA,
    DEREFERENCE,
    FUNCTIONS,
    MINUS,
    PLUS,
    POINTERS,
    SUBTRACT,
    Key,
    Origin,
    plain,
    unwrapped,
)  # fmt: skip
from robosmi.transformations.t2m.c_source.parsing.generated_program import SKETCH, GeneratedProgram
from robosmi.transformations.t2m.c_source.parsing.generated_tree import GeneratedNode, own_nodes
from robosmi.transformations.t2m.c_source.parsing.generated_values import GeneratedValues

_COUNTED = frozenset((b"__LINE__", b"__COUNTER__"))
"""Macros whose value follows from where the text stands, so that it differs from the source's."""
_NAME = re.compile(rb"[A-Za-z_]\w*")
_MACRO = re.compile(rb"^[ \t]*#[ \t]*define[ \t]+(\w+)((?:[^\n\\]|\\\n?)*)", re.MULTILINE)
OF_PLACE = "a number that the preprocessor counts (__LINE__, __COUNTER__) and that may differ from the source's"


class PinPlace(NamedTuple):
    """A parameter that is a pin.

    Attributes:
        position: which argument, from 0.
        looked_up: whether the function takes a number of the source there, as the helpers that look up pins do.
        none: texts of arguments that mean no pin.
    """

    position: int
    looked_up: bool = False
    none: tuple[str, ...] = ()


class PinNames(Struct, frozen=True):
    """What counts as a pin in a finished program.

    Attributes:
        functions: function -> its parameters that are pins.
        look_ups: functions whose result is a pin.
        constants: constant of the hardware -> how the program writes its pin.
        literals: how the program writes a pin that has no constant -> how often the plan puts it into the text.
        unbound: the number that is no pin of any target.
        named: constants of the platform that are pins, in a program whose platform stays: each place of one has to be by the
            plan, too, and a number that is looked up may be that of a pin of either board.
    """

    functions: Mapping[str, Sequence[PinPlace]]
    look_ups: frozenset[str]
    constants: Mapping[str, str]
    literals: Mapping[str, int]
    unbound: int
    named: frozenset[str] = frozenset()


class WrongPin(NamedTuple):
    """A value that reaches a pin's parameter of a finished program and is no pin by the plan.

    Attributes:
        file, line: the call.
        function: what is called.
        what: what the value is.
        at: file and line of where it is written.
    """

    file: str
    line: int
    function: str
    what: str
    at: tuple[str, int]


class PinCheck(NamedTuple):
    """The result of following the pins of a finished program.

    Attributes:
        wrong: the values that are no pins, each once for a call.
        functions: the functions with pins.
        seen: function with a pin -> how many calls of it were seen.
        pointed: how many calls through pointers were seen.
    """

    wrong: list[WrongPin]
    functions: frozenset[str]
    seen: Counter[str]
    pointed: int


class _Sink(NamedTuple):
    call: GeneratedNode
    function: str
    place: PinPlace
    argument: GeneratedNode


def follow_pins(program: GeneratedProgram, names: PinNames) -> PinCheck:
    """Follow the values of all pin parameters of a finished program to their origins.

    Args:
        program: the program.
        names: what counts as a pin.
    """
    flows = _Flows(program, names)
    for _, unit in program.units:
        for node in own_nodes(program, unit):
            flows.read(node)
    return flows.check()


class _Flows(GeneratedValues):
    def __init__(self, program: GeneratedProgram, names: PinNames) -> None:
        super().__init__(program, names.functions.keys())
        self.names = names
        self._known: dict[Key, frozenset[Origin]] = {}
        self._counted = _counted_names(list(program.files.values()))

    def check(self) -> PinCheck:
        """Follow each value that reaches a pin."""
        self.pass_arguments()
        found: dict[tuple[str, int, str], WrongPin] = {}
        raw: dict[str, set[tuple[str, int, int]]] = {}
        at_raw: dict[str, list[_Sink]] = {}
        for sink in self._sinks():
            if sink.place.none and self.text(sink.argument) in sink.place.none:
                continue
            for leaf in sorted(self._leaves(sink.argument), key=lambda each: (each.place, each.what)):
                if leaf.what == OF_PLACE:
                    self._report(found, sink, OF_PLACE, leaf.place[:2])
                    continue
                if leaf.text and sink.place.looked_up and self.names.named:
                    continue
                if leaf.text:
                    raw.setdefault(leaf.text, set()).add(leaf.place)
                    at_raw.setdefault(leaf.text, []).append(sink)
                wrong = "a pin of the target, which is looked up as a port of the source" if not leaf.what else ""
                what = wrong if sink.place.looked_up else leaf.what
                if what:
                    self._report(found, sink, what, leaf.place[:2])
        for text, places in raw.items():
            if len(places) > self.names.literals.get(text, 0):
                for sink in at_raw[text]:
                    self._report(found, sink, f"the number {text}, which no port of the plan has put there", ("", 0))
        seen = Counter(name for _, name, _ in self.calls)
        return PinCheck(list(found.values()), frozenset(self.names.functions), seen, len(self.indirect))

    def _sinks(self) -> Iterator[_Sink]:
        """The arguments that are pins; in calls through pointers those that may be."""
        called = [*self.calls, *((call, name, arguments) for call, arguments in self.indirect for name in self.taken)]
        for call, function, arguments in called:
            for place in self.names.functions[function]:
                if place.position < len(arguments):
                    yield _Sink(call, function, place, arguments[place.position])

    def _report(self, found: dict[tuple[str, int, str], WrongPin], sink: _Sink, what: str, at: tuple[str, int]) -> None:
        file, line = clang.line_of(self.library.getCursorLocation(sink.call.cursor))
        name = clang.file_name(file).removeprefix(f"{SKETCH}/")
        found.setdefault((name, line, sink.function), WrongPin(name, line, sink.function, what, at))

    def origin(self, what: str, node: GeneratedNode, text: str = "") -> Origin:
        """The origin of a value; of a number that the preprocessor counts, or that is calculated with one, `OF_PLACE`."""
        if self._counted and node.kind != kinds.CALL_EXPR and self._is_counted(node):  # of a look-up, the argument is followed
            return super().origin(OF_PLACE, node)
        return super().origin(what, node, text)

    def _is_counted(self, node: GeneratedNode) -> bool:
        """Whether a number in an expression comes out of a macro that counts."""
        for each in node.below():
            if each.kind == kinds.INTEGER_LITERAL:
                file, offset = clang.file_offset(self.library.getCursorLocation(each.cursor))
                name = _NAME.match(self.program.texts.get(clang.file_name(file), b""), offset)
                if name is not None and name[0] in self._counted:
                    return True
        return False

    def _leaves(self, argument: GeneratedNode) -> Iterable[Origin]:
        """The origins of an argument's value; those of a thing are found once."""
        first = self._step(unwrapped(argument))
        if len(first) == 1 and not isinstance(first[0], (GeneratedNode, Origin)):
            key = first[0]
            if key not in self._known:
                self._known[key] = frozenset(self._origins([key]))
            return self._known[key]
        return self._origins(first)

    def _origins(self, waiting: list[GeneratedNode | Key | Origin]) -> set[Origin]:
        found: set[Origin] = set()
        seen: set[Key] = set()
        while waiting:
            each = waiting.pop()
            if isinstance(each, Origin):
                found.add(each)
            elif isinstance(each, GeneratedNode):
                waiting += self._step(each)
            elif each in self._known:
                found |= self._known[each]
            elif each not in seen:
                seen.add(each)
                waiting += self.given.get(each, ())
                if each in self.elsewhere and each not in self.given:
                    found.add(self.origin("defined elsewhere", self.elsewhere[each]))
        return found

    def _step(self, node: GeneratedNode) -> list[GeneratedNode | Key | Origin]:
        """Where the value of an expression comes from: other expressions, things, or origins."""
        kind, inner = node.kind, node.expressions
        if kind == kinds.INTEGER_LITERAL:
            return self._number(node)
        if kind == kinds.DECL_REF_EXPR:
            return self._value_of(node)
        if kind == kinds.MEMBER_REF_EXPR:
            found = self.library.getCursorReferenced(node.cursor)
            known = found.kind in (kinds.FIELD_DECL, kinds.VAR_DECL, kinds.ENUM_CONSTANT_DECL)
            return [self.key(found)] if known else [self.origin("what cannot be followed", node)]
        if kind == kinds.CALL_EXPR:
            return self._result(node)
        if kind in (kinds.PAREN_EXPR, kinds.BINARY_OPERATOR) and (pin := self._written_pin(node)) is not None:
            return [pin]
        if kind == kinds.PAREN_EXPR or kind in CASTS or (kind == kinds.UNEXPOSED_EXPR and len(inner) == 1):
            return [inner[-1]] if inner else [self.origin("what cannot be followed", node)]
        if kind == kinds.INIT_LIST_EXPR:
            return [*inner]
        if kind == kinds.CONDITIONAL_OPERATOR:
            return [*inner[1:]]
        if kind == kinds.ARRAY_SUBSCRIPT_EXPR:
            return [*self.arrays(inner)]
        if kind == kinds.UNARY_OPERATOR:
            return self._unary(node)
        if kind == kinds.BINARY_OPERATOR:
            operator = self.library.getCursorBinaryOperatorKind(node.cursor)
            if operator == COMMA:
                return [inner[-1]]
            if operator == ASSIGN:
                return [*inner]
            type_ = self.library.getCanonicalType(self.library.getCursorType(node.cursor))
            if operator in (ADD, SUBTRACT) and type_.kind in POINTERS:
                return [*self.arrays(inner)]
            return [self.origin("a calculation", node)]
        if kind in (kinds.CHARACTER_LITERAL, kinds.FLOATING_LITERAL, kinds.CXX_BOOL_LITERAL_EXPR):
            return [self.origin("a number of the source", node)]
        if kind in (kinds.COMPOUND_ASSIGNMENT_OPERATOR, kinds.CXX_UNARY_EXPR):
            return [self.origin("a calculation", node)]
        return [self.origin("what cannot be followed", node)]

    def _number(self, node: GeneratedNode) -> list[GeneratedNode | Key | Origin]:
        value = self._evaluated(node)
        if value == self.names.unbound and not (self._counted and self._is_counted(node)):
            return []
        if str(value) in self.names.literals:
            return [self.origin("", node, str(value))]
        return [self.origin(f"the number {value} of the source", node)]

    def _evaluated(self, node: GeneratedNode) -> int:
        result = self.library.Cursor_Evaluate(node.cursor)
        try:
            return int(self.library.EvalResult_getAsLongLong(result))
        finally:
            self.library.EvalResult_dispose(result)

    def _value_of(self, node: GeneratedNode) -> list[GeneratedNode | Key | Origin]:
        found = self.library.getCursorReferenced(node.cursor)
        if found.kind in FUNCTIONS:
            return []
        if found.kind not in (kinds.VAR_DECL, kinds.PARM_DECL, kinds.ENUM_CONSTANT_DECL):
            return [self.origin("what cannot be followed", node)]
        name = self.spelling(found)
        if found.kind != kinds.PARM_DECL and name in self.names.constants and self._is_constant(found, name):
            return [self.origin("", node)]
        if name in self.names.literals and found.kind == kinds.VAR_DECL and self._of_target(found):
            return [self.origin("", node, name)]
        if name in self.names.named and self._of_target(found):
            return [self.origin(f"{name} of the source board", node)]
        return [self.key(found)]

    def _is_constant(self, declared: Cursor, name: str) -> bool:
        """Whether a constant of the hardware has the pin that the plan gives it."""
        known = [each for each in self.given.get(self.key(declared), ()) if isinstance(each, GeneratedNode)]
        return all(self.text(each) == self.names.constants[name] for each in known)

    def _of_target(self, declared: Cursor) -> bool:
        file, _ = clang.file_offset(self.library.getCursorLocation(declared))
        return not clang.file_name(file).startswith(SKETCH)

    def _written_pin(self, node: GeneratedNode) -> Origin | None:
        """The pin that a macro of the target makes where the text has it."""
        if not any("(" in text for text in self.names.literals):
            return None
        extent = self.library.getCursorExtent(node.cursor)
        start = clang.SourceLocation()
        start.ptr_data, start.int_data = extent.ptr_data, extent.begin
        file, offset = clang.file_offset(start)
        data = self.program.texts.get(clang.file_name(file), b"")
        text = next((t for t in self.names.literals if "(" in t and data.startswith(t.encode(), offset)), None)
        return self.origin("", node, text) if text is not None else None

    def _result(self, node: GeneratedNode) -> list[GeneratedNode | Key | Origin]:
        called = self.library.getCursorReferenced(node.cursor)
        inner = node.expressions
        if (
            inner
            and called.kind in FUNCTIONS
            and unwrapped(inner[0]).kind == kinds.CALL_EXPR
            and called.kind != kinds.CONSTRUCTOR
        ):
            return [self.origin("what a function returns through a pointer", node)]
        name = self.spelling(called) if called.kind in FUNCTIONS else ""
        if not name and inner:
            overloaded = next((n for n in inner[0].below() if n.kind == kinds.OVERLOADED_DECL_REF), None)
            name = self.spelling(overloaded.cursor) if overloaded is not None else ""
        if name in self.names.look_ups:
            return [self.origin("", node)]
        if called.kind in FUNCTIONS and self.unique_name(called) in self.defined and called.kind != kinds.CONSTRUCTOR:
            return [("result", "function", self.unique_name(called))]
        what = f"what '{name}' returns" if name else "what a function returns through a pointer"
        return [self.origin(what, node)]

    def _unary(self, node: GeneratedNode) -> list[GeneratedNode | Key | Origin]:
        operator, inner = self.library.getCursorUnaryOperatorKind(node.cursor), node.expressions
        if operator == MINUS and inner and plain(inner[0]).kind == kinds.INTEGER_LITERAL:
            return []
        if operator in (ADDRESS, DEREFERENCE, PLUS) and inner:
            return [inner[0]]
        return [self.origin("a calculation", node)]


def _counted_names(texts: Sequence[bytes]) -> frozenset[bytes]:
    """The macros that count, and the program's own whose text names one of them; none where the program uses none."""
    used = any(name in text for text in texts for name in _COUNTED)
    if not used:
        return frozenset()
    users: dict[bytes, list[bytes]] = {}
    for found in (each for text in texts for each in _MACRO.finditer(text)):
        for word in set(_NAME.findall(found[2])):
            users.setdefault(word, []).append(found[1])
    counted, waiting = set(_COUNTED), [*_COUNTED]
    while waiting:
        new = {name for name in users.get(waiting.pop(), ()) if name not in counted}
        counted |= new
        waiting += new
    return frozenset(counted)
