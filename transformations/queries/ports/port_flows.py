"""Flows of port numbers: which constants, variables, parameters and calls of a program can exchange the number of a port.

A flow ends in the arguments that are pins for functions of the platform. Each flow tells whether its numbers may be changed
where they are written: not when something in it is printed, calculated with, compared, kept in a structure or in a table that
is filled at run time, comes from a function of the platform, is the end of a range, or is used in any other way that is not
followed here. Numbers of such a flow stay as they are: an assumption in the other direction could move a wrong wire. Names and
pins of ports are decided elsewhere.

Bodies of macros hold numbers, call functions of the platform and pass parameters on. They are no syntax, so their tokens are
read: a single number, name or parameter is followed, anything else is a calculation that keeps its numbers.

Some pins appear only in the expanded text: arguments for `...`, arguments of functions whose name is pasted together, numbers
behind such a name. A place in the source counts only if everything that it expands to is a pin, so that no other argument is
changed. A pin without such a place cannot be looked up: its call stays without a pin.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Hashable, Iterator, Mapping, Sequence
from functools import cached_property

from msgspec import Struct, structs

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.api_facts import PinParameter
from robosmi.transformations.knowledge.lexer import Token
from robosmi.transformations.knowledge.platforms.board_pins import INTERRUPT
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.flows.flow_reader import FlowReader, view_text
from robosmi.transformations.queries.flows.pin_uses import pin_number
from robosmi.transformations.queries.flows.value_flows import Flow, PinArgument
from robosmi.transformations.queries.flows.value_uses import ValueUses
from robosmi.transformations.queries.macros.argument_places import TokenText, without_parentheses
from robosmi.transformations.queries.macros.constant_text import c_integer
from robosmi.transformations.queries.macros.expansion import Expanded, expanded_unit
from robosmi.transformations.queries.macros.macro_definitions import REST, Path, TextPlace, macros_of
from robosmi.transformations.queries.macros.tokens import names_in


def port_flows(views: Sequence[CodeView], sources: Mapping[str, bytes]) -> list[Flow]:
    """The flows of a program that reach a pin of a platform function, in text order of their first call.

    Args:
        views: a view of each unit.
        sources: path of a unit -> its bytes.
    """
    reader = FlowReader(views, sources)
    for view in views:
        reader.follow(view)
    uses = ValueUses(reader)
    for view in views:
        uses.follow(view)
    follow_macros(reader)
    follow_expanded(reader)
    found = [flow for flow in reader.flows.all() if flow.arguments and _numbered_as_pins(flow)]
    count = next((view.api.ports for view in views), 0)
    for flow in found:
        beyond = sorted({place.value for place in flow.places if place.value >= count})
        flow.kept += [f"{number} is not a port of the source (0 to {count - 1})" for number in beyond]
        flow.places.sort(key=lambda p: (p.unit.path, p.start))
        flow.arguments.sort(key=lambda a: (a.unit.path, a.start))
    return sorted(found, key=lambda f: (f.arguments[0].unit.path, f.arguments[0].start))


def _numbered_as_pins(flow: Flow) -> bool:
    """Let the numbers of a flow be those of pins, where functions take those of channels or interrupts; whether it is of pins.

    A flow of numbers of interrupts that cannot be changed where they are written is none: nothing could look them up.
    """
    numbered = [argument.parameter for argument in flow.arguments if argument.parameter.numbering]
    kinds = {argument.parameter.numbering for argument in flow.arguments}
    if not numbered:
        return True
    if INTERRUPT in kinds and (len(kinds) > 1 or flow.kept or flow.computed or not flow.places):
        flow.arguments = [argument for argument in flow.arguments if argument.parameter.numbering != INTERRUPT]
        return bool(flow.arguments)
    meant = [numbered[0].pin_of(place.value) for place in flow.places]
    if INTERRUPT in kinds and None in meant:
        return False
    others = [
        argument
        for argument in flow.arguments
        if argument.parameter.numbering == "" and argument.parameter.direction != "unknown"
    ]
    places = zip(flow.places, meant, strict=True)
    if others and any(number not in (None, place.value) for place, number in places):
        flow.kept.append(f"{flow.places[0].value} is a channel for '{numbered[0].name}', and a pin for '{others[0].function}'")
        return True
    flow.places = [
        structs.replace(place, value=number) if number is not None else place
        for place, number in zip(flow.places, meant, strict=True)
    ]
    kind, numbers = numbered[0].numbering, numbered[0].numbers
    flow.arguments = [
        structs.replace(argument, parameter=argument.parameter._replace(numbering=kind, numbers=numbers))
        for argument in flow.arguments
    ]
    return True


# ---- pins in the expanded text


class _Text(Struct, frozen=True):
    """The text of a unit with its macros expanded, and its tokens."""

    view: CodeView
    expanded: Expanded
    tokens: TokenText


class _MadePin(Struct, frozen=True):
    """A pin argument of a call that a macro makes.

    Attributes:
        text: the expanded text that contains it.
        first, behind: index of its first token there, and of the token after its last.
        function, pin: the function and the parameter that take it.
        places: the source ranges that it is written in, the outermost first.
        use: start and end of the macro use in the unit that makes the call.
    """

    text: _Text
    first: int
    behind: int
    function: str
    pin: PinParameter
    places: tuple[TextPlace, ...]
    use: tuple[int, int]


def follow_expanded(reader: FlowReader) -> None:
    """Find the pins in expanded calls that the bodies of macros do not show; `follow_macros` has to run before.

    Args:
        reader: the program's flows.
    """
    made = [
        (view, call, pin)
        for view in reader.views
        for call in view.of_kind(ccode.Call)
        if call.viaMacro
        for pin in reader.pins(str(call.calleeName or ""), view)
        if pin.position < len(call.arguments)
    ]
    if made:
        _MadePins(reader).follow(made)


class _MadePins:
    def __init__(self, reader: FlowReader) -> None:
        self.reader = reader
        self.units = {view.unit.path: view.unit for view in reader.views}
        macros = macros_of(list(self.units.values()), reader.sources)
        self.texts = []
        for view in reader.views:
            expanded = expanded_unit(view.unit, reader.sources[view.unit.path], macros)
            self.texts.append(_Text(view, expanded, TokenText(expanded.data)))
        self.pins = [pin for text in self.texts for pin in self._found(text)]
        self.at: dict[TextPlace, set[tuple[int, int]]] = {}
        """Source range -> (`id` of the text, index of the first token) of each pin argument written there."""
        for one in self.pins:
            for place in one.places if _translated(one.pin) else ():
                self.at.setdefault(place, set()).add((id(one.text), one.first))

    def follow(self, made: Sequence[tuple[CodeView, ccode.Call, PinParameter]]) -> None:
        """Let the flows of the pins that no macro body shows end at their places in the source.

        Args:
            made: each pin argument of a call that comes out of a macro: the view, the parsed call, the parameter.
        """
        shown = {(a.unit.path, a.start, a.end) for flow in self.reader.flows.all() for a in flow.arguments}
        seen = [one for one in self.pins if any((p.unit, p.start, p.end) in shown for p in one.places)]
        known = {id(one) for one in seen}
        found: dict[tuple[TextPlace, str, PinParameter], list[_MadePin]] = {}
        for one in self.pins:
            places = reversed(one.places) if id(one) not in known else ()
            place = next((p for p in places if not _translated(one.pin) or self._is_pin_everywhere(p)), None)
            if place is not None:
                found.setdefault((place, one.function, one.pin), []).append(one)
        uses = _Uses(made)
        for (place, function, pin), here in found.items():
            self._reach(place, function, pin, [call for one in here for call in uses.calls(one)])
            seen += here
        sure = {(id(call), one.pin.position) for one in seen for call in uses.calls(one)}
        for view, call, pin in made:
            if (id(call), pin.position) not in sure:
                self._keep(view, call, pin)
        keys = self.reader.flows.keys()
        for one in seen:
            self._close(one, next(key for p in one.places if (key := keys.get((p.unit, p.start, p.end))) is not None))

    def _found(self, text: _Text) -> Iterator[_MadePin]:
        """The pin arguments in an expanded text of calls whose function name comes out of a macro."""
        for index, token in enumerate(text.tokens.tokens):
            way = text.expanded.path(token[1]) if token[0] == "name" else ()
            pins = self.reader.pins(token[3], text.view) if len(way) > 1 else ()
            closed = [t[3] for t in text.tokens.tokens[max(index - 1, 0) : index + 2]] == ["(", token[3], ")"]
            arguments = text.tokens.arguments(index + closed) if pins else None
            for pin in pins if arguments is not None else ():
                if arguments is not None and pin.position < len(arguments) and arguments[pin.position]:
                    first, last = arguments[pin.position][0], arguments[pin.position][-1]
                    places = text.expanded.places(first[1], last[2])
                    range_ = text.tokens.at(first[1]), text.tokens.at(last[2])
                    yield _MadePin(text, *range_, token[3], pin, places, (way[0].start, way[0].end))

    def _is_pin_everywhere(self, place: TextPlace) -> bool:
        """Whether everything that a source range expands to is a pin that an adapter takes."""
        return place in self.at and self.at[place] >= self._written.of(place)

    @cached_property
    def _written(self) -> _Written:
        return _Written(self.texts)

    def _close(self, one: _MadePin, key: Hashable) -> None:
        """Join the sources of a pin's value with the flow of the pin, by whatever macros they were passed on."""
        reader, flows = self.reader, self.reader.flows
        argument = without_parentheses(one.text.tokens.tokens[one.first : one.behind])
        way = one.text.expanded.path(argument[0][1])
        known = len(argument) == 1 and bool(way)
        others: list[Hashable] = []
        if known and argument[0][0] == "number":
            at = way[-1]
            if flows.has(key, at.unit, at.start):
                return
            macros = [m for m in self.units[at.unit].macros if at.body and m.startOffset <= at.start < m.endOffset]
            others = [("macro", str(m.name)) for m in macros if not m.functionLike]
            others += [("place", at.unit, at.start), *reader.given.get((at.unit, at.start, at.end), ())]
        elif known and argument[0][0] == "name":
            others = reader.named(argument[0][3])
            if others and all(flows.of(other) is flows.of(key) for other in others):
                return
        elif flows.of(key).kept:
            return
        for other in others:
            flows.join(key, other)
        flows.freeze(key, "macros pass it on", computed=not others)

    def _reach(self, place: TextPlace, function: str, pin: PinParameter, calls: Sequence[ccode.Call]) -> None:
        """Record that a source range is the pin argument of some calls."""
        reader, unit = self.reader, self.units[place.unit]
        key = ("made", place.unit, place.start)
        reader.reach(
            key, PinArgument(unit, place.start, place.end, function, pin, made=tuple({id(c): c for c in calls}.values()))
        )
        written = [list(call.arguments)[pin.position] for call in calls if not place.body]
        known = next((each for each in written if int(each.startOffset) == place.start), None)
        if known is not None:  # the parser has it where it stands
            reader.flows.join(key, reader.value(known))
        else:
            macro = next((m for m in unit.macros if m.startOffset <= place.start < m.endOffset), None) if place.body else None
            tokens = TokenText(reader.sources[place.unit][place.start : place.end], place.start).tokens
            name, own = (str(macro.name), body_names(macro)) if macro is not None else ("", [])
            follow_argument(reader, unit, tokens, key, own, name)
        for taker in reader.given.get((place.unit, place.start, place.end), ()):
            reader.flows.join(key, taker)

    def _keep(self, view: CodeView, call: ccode.Call, pin: PinParameter) -> None:
        """Record that a call's pin has no source range by which it could be looked up."""
        function, argument = str(call.calleeName), list(call.arguments)[pin.position]
        start, end = int(argument.startOffset), int(argument.endOffset)
        if view_text(self.reader.sources[view.unit.path], start, end) in pin.none:
            return
        key = ("unplaced", view.unit.path, int(call.startOffset), function, pin.position)
        self.reader.flows.freeze(key, f"no text in the program gives the port of '{function}'", computed=True)
        self.reader.reach(key, PinArgument(view.unit, start, end, function, pin, call, argument, unplaced=True))


class _Uses:
    """The parsed calls that macros make, found by the macro use.

    Args:
        made: each of their pin arguments: the view, the call, the parameter.
    """

    def __init__(self, made: Sequence[tuple[CodeView, ccode.Call, PinParameter]]) -> None:
        self._calls: dict[tuple[int, str, int], list[ccode.Call]] = {}
        for view, call, pin in sorted(made, key=lambda each: int(each[1].startOffset)):
            self._calls.setdefault((id(view), str(call.calleeName), pin.position), []).append(call)

    def calls(self, one: _MadePin) -> list[ccode.Call]:
        """The calls of a pin's function that the same macro use makes."""
        known = self._calls.get((id(one.text.view), one.function, one.pin.position), [])
        first, behind = (bisect_left(known, at, key=lambda call: int(call.startOffset)) for at in one.use)
        return known[first:behind]


class _Written:
    """Finds the copies of a source range in the expanded texts.

    Args:
        texts: the expanded texts.
    """

    def __init__(self, texts: Sequence[_Text]) -> None:
        self._starts: dict[tuple[str, bool], list[tuple[int, int, int, Path]]] = {}
        for text in texts:
            for index, token in enumerate(text.tokens.tokens):
                way = text.expanded.path(token[1])
                for level, frame in enumerate(way):
                    self._starts.setdefault((frame.unit, frame.body), []).append((frame.start, id(text), index, way[:level]))
        for found in self._starts.values():
            found.sort(key=lambda each: each[0])

    def of(self, place: TextPlace) -> set[tuple[int, int]]:
        """The copies of a source range in the expanded texts: (`id` of the text, index of the copy's first token)."""
        starts = self._starts.get((place.unit, place.body), [])
        first, behind = (bisect_left(starts, at, key=lambda each: each[0]) for at in (place.start, place.end))
        here = {(text, index): around for _, text, index, around in starts[first:behind]}
        return {(text, index) for (text, index), around in here.items() if here.get((text, index - 1)) != around}


def _translated(pin: PinParameter) -> bool:
    """Whether an adapter takes this parameter as a pin of the target; the ends of a range of pins stay source numbers."""
    return pin.range_with is None and pin.span == 1


# ---- bodies of macros

_DIRECTIVE = re.compile(r"#\s*(define|if|elif)\b(.*)", re.DOTALL)
_INTEGER = re.compile(r"(0[xX][0-9a-fA-F]+|0[bB][01]+|[0-9]+)[uUlL]*\Z")
MOST_FOR_DOTS = 16
"""Number of arguments for a macro's `...` that are followed separately."""


def follow_macros(reader: FlowReader) -> None:
    """Add the exchanges of values in the bodies of all macros of a program to its flows."""
    bodies: dict[str, set[str]] = {}
    for view in reader.views:
        for macro in view.unit.macros:
            bodies.setdefault(str(macro.name), set()).add(str(macro.body).strip())
        for token in reader.texts[view.unit.path].tokens:
            if token[0] == "directive":
                _directive(token[3], reader, bodies)
        for use in view.unit.macroUses:
            _plain_arguments(reader, view, use)
    for view in reader.views:
        for macro in view.unit.macros:
            _MacroBody(reader, view, macro).follow()
    for name, different in bodies.items():
        if len(different) > 1:
            reader.flows.freeze(("macro", name), f"'{name}' is defined in more than one way")


def _directive(text: str, reader: FlowReader, bodies: dict[str, set[str]]) -> None:
    """Read other definitions of a macro, also in text that is not compiled, and keep the flows of macros that `#if` tests."""
    match = _DIRECTIVE.match(text)
    if match is None:
        return
    if match[1] == "define":
        found = re.match(r"\s*(\w+)(.*)", match[2], re.DOTALL)
        if found is not None and found[1] in reader.macros and not found[2].startswith("("):
            body = TokenText(found[2].encode("latin-1"))
            known = TokenText(str(reader.macros[found[1]].body).encode("latin-1", errors="replace"))
            if [t[3] for t in body.tokens] != [t[3] for t in known.tokens]:
                bodies.setdefault(found[1], set()).add(found[2])
        return
    for name in sorted(names_in(re.sub(r"\bdefined\s*+\(?\s*+\w+\s*+\)?", " ", match[2]))):
        if name in reader.macros:
            reader.flows.freeze(("macro", name), f"'{name}' is tested by #{match[1]}")


def _plain_arguments(reader: FlowReader, view: CodeView, use: ccode.MacroUse) -> None:
    """Follow the arguments of a macro use that the code model has no expressions for."""
    macro = use.macro or reader.macros.get(str(use.name))
    if macro is None or not macro.functionLike:
        return
    text = reader.texts[view.unit.path]
    for i, argument in enumerate(text.arguments(text.at(int(use.startOffset))) or []):
        tokens = without_parentheses(argument)
        known = argument and (view.unit.path, argument[0][1], argument[-1][2]) in reader.followed
        if not known and tokens:
            follow_argument(reader, view.unit, argument, ("macro parameter", str(macro.name), i), [])


def follow_argument(
    reader: FlowReader, unit: ccode.SourceUnit, argument: Sequence[Token], taker: Hashable, own: Sequence[str], macro: str = ""
) -> None:
    """Join the flow of an argument, given as tokens, with that of what it is passed to.

    Args:
        reader: the program's flows.
        unit: the unit that contains the tokens.
        argument: the tokens.
        taker: the key of what the argument is passed to.
        own: parameters of the macro whose body contains the tokens, `__VA_ARGS__` last if it is variadic.
        macro: the name of that macro; empty for tokens in the program's text.
    """
    tokens = without_parentheses(argument)
    if len(tokens) == 1 and tokens[0][0] == "number" and (number := _INTEGER.match(tokens[0][3])):
        place = ("place", unit.path, tokens[0][1])
        if not reader.flows.has(taker, str(unit.path), tokens[0][1]):
            reader.put(
                place, unit, tokens[0][1], tokens[0][2], pin_number(c_integer(number[1])), _element(reader, unit, tokens[0]), ""
            )
            reader.flows.join(taker, place)
        return
    if len(tokens) == 1 and tokens[0][0] == "name":
        keys = keys_of(reader, tokens[0][3], own, macro)
        for key in keys:
            reader.flows.join(taker, key)
        if not keys and tokens[0][3] in reader.constants:
            place = ("place", unit.path, tokens[0][1])
            if not reader.flows.has(taker, str(unit.path), tokens[0][1]):
                value = reader.constants[tokens[0][3]]
                reader.put(place, unit, tokens[0][1], tokens[0][2], value, _element(reader, unit, tokens[0]), "")
                reader.flows.join(taker, place)
        elif not keys:  # declared in the body itself, or nowhere
            reader.flows.freeze(taker, f"'{tokens[0][3]}' is not the program's own", computed=True)
        return
    for token in tokens:
        if token[0] == "name":
            for key in keys_of(reader, token[3], own, macro):
                reader.flows.freeze(key, f"'{token[3]}' is calculated with")
    if tokens:
        reader.flows.freeze(taker, "a macro calculates it", computed=True)


def _element(reader: FlowReader, unit: ccode.SourceUnit, token: Token) -> ccode.Located:
    """The element of the code model that contains a number in a macro: the macro's definition or a use of it."""
    return reader.holders[unit.path].at(token[1]) or unit.macroUses[0]


def body_names(macro: ccode.Macro) -> list[str]:
    """The names of a macro's parameters in its body; the last one stands for all arguments passed for `...`."""
    return [str(p).removesuffix("...").strip() or REST for p in macro.parameters]


def keys_of(reader: FlowReader, name: str, own: Sequence[str], macro: str) -> list[Hashable]:
    """The keys of what a name in a macro's body denotes: a parameter of the macro, another macro, any declaration."""
    return [("macro parameter", macro, list(own).index(name))] if name in own else reader.named(name)


class _MacroBody:
    """Follows the values that pass through the body of one macro.

    Args:
        reader: the program's flows.
        view: of the unit.
        macro: the macro.
    """

    def __init__(self, reader: FlowReader, view: CodeView, macro: ccode.Macro) -> None:
        self.reader, self.view, self.macro, self.name = reader, view, macro, str(macro.name)
        start = int(macro.startOffset) + 1
        self.text = TokenText(reader.sources[view.unit.path][start : int(macro.endOffset)], start)
        self.own = body_names(macro)
        self.rest = self.own[-1] if self.own and str(macro.parameters[-1]).endswith("...") else ""
        self.begin = self._begin()
        self.done: set[int] = set()

    def _begin(self) -> int:
        """Index of the first token of the body: behind `define`, the name and its parameters."""
        index = next((i for i, t in enumerate(self.text.tokens) if t[3] == self.name), len(self.text.tokens)) + 1
        if not self.macro.functionLike:
            return index
        closing = (i for i in range(index, len(self.text.tokens)) if self.text.tokens[i][3] == ")")
        return next(closing, len(self.text.tokens)) + 1

    def follow(self) -> None:
        """Join the flows of what the body passes on; keep the numbers of what it uses in any other way."""
        flows, key = self.reader.flows, ("macro", self.name)
        body = without_parentheses(self.text.tokens[self.begin :])
        if not self.macro.functionLike and len(body) == 1 and body[0][0] in ("number", "name"):
            self._single(body[0], key)
            return
        if not self.macro.functionLike:
            listed = bool(body) and body[0][3] == "{" and all(t[0] == "number" or t[3] in ("{", ",", "}") for t in body)
            flows.freeze(key, f"'{self.name}' is {'a list' if listed else 'calculated'}", computed=not listed)
            flows.of(key).given.append((self.view.unit, self.macro))
            for token in body if body and body[0][3] == "{" else ():
                if token[0] == "number" and (number := _INTEGER.match(token[3])):
                    value = pin_number(c_integer(number[1]))
                    self.reader.put(key, self.view.unit, token[1], token[2], value, self.macro, self.name)
        for index in range(self.begin, len(self.text.tokens)):
            pasted = self.text.tokens[index - 1][3] == "##"  # its name is another one
            if self.text.tokens[index][0] == "name" and not pasted and (arguments := self.text.arguments(index)) is not None:
                self._call(self.text.tokens[index][3], arguments)
        for index in range(self.begin, len(self.text.tokens)):
            token = self.text.tokens[index]
            if token[0] == "name" and token[1] not in self.done:
                for other in keys_of(self.reader, token[3], self.own, self.name):
                    flows.freeze(other, f"'{token[3]}' is used in the macro '{self.name}'")

    def _single(self, token: Token, key: Hashable) -> None:
        if token[0] == "name" and token[3] in self.reader.constants:
            value = self.reader.constants[token[3]]
            self.reader.put(key, self.view.unit, token[1], token[2], value, self.macro, self.name)
        elif token[0] == "name":
            for other in self.reader.named(token[3]) or [("name", token[3])]:
                if other[:1] == ("name",):  # type: ignore[index]
                    self.reader.flows.freeze(other, f"'{token[3]}' is not the program's own", computed=True)
                self.reader.flows.join(key, other)
        elif number := _INTEGER.match(token[3]):
            value = pin_number(c_integer(number[1]))
            self.reader.put(key, self.view.unit, token[1], token[2], value, self.macro, self.name)
        else:
            self.reader.flows.freeze(key, f"'{self.name}' is not a whole number", computed=True)

    def _call(self, name: str, arguments: list[list[Token]]) -> None:
        """Follow the arguments of a call in the body."""
        reader = self.reader
        takers: dict[int, Hashable] = {}
        other = reader.macros.get(name)
        function = reader.functions.defined(name, self.view.unit)
        if other is not None and other.functionLike:
            takers = {i: ("macro parameter", name, i) for i in range(max(len(arguments), MOST_FOR_DOTS))}
        elif function is not None:
            takers = {i: reader.key(p) for i, p in enumerate(function.parameters)}
        else:
            listed = next((i for i, a in enumerate(arguments) if self._is_rest(a)), len(arguments))
            for parameter in reader.pins(name, self.view):
                if parameter.position < min(listed, len(arguments)) and arguments[parameter.position]:
                    first, last = arguments[parameter.position][0], arguments[parameter.position][-1]
                    key: Hashable = ("pin", self.view.unit.path, first[1])
                    takers[parameter.position] = key
                    reader.reach(key, PinArgument(self.view.unit, first[1], last[2], name, parameter))
                elif listed < len(arguments):  # its place is found where the macro is used (`port_flows`)
                    takers[parameter.position] = ("pin for dots", self.name, listed, name, parameter.position)
        for position, argument in enumerate(arguments):
            if self._is_rest(argument):
                self._pass_on(position, takers, name)
                self.done.add(argument[-1][1])
            elif position in takers:
                tokens = without_parentheses(argument)
                if len(tokens) == 1:
                    self.done.add(tokens[0][1])
                follow_argument(reader, self.view.unit, argument, takers[position], self.own, self.name)

    def _is_rest(self, argument: Sequence[Token]) -> bool:
        """Whether an argument is `__VA_ARGS__`, which stands for any number of arguments."""
        return bool(self.rest) and [token[3] for token in argument if token[3] != "##"] == [self.rest]

    def _pass_on(self, position: int, takers: Mapping[int, Hashable], name: str) -> None:
        """Join each argument passed for `...` with the parameter that takes it, from `position` on."""
        for behind in range(MOST_FOR_DOTS):
            given = ("macro parameter", self.name, len(self.own) - 1 + behind)
            if position + behind in takers:
                self.reader.flows.join(takers[position + behind], given)
            else:
                self.reader.flows.freeze(given, f"it goes to '{name}' in the macro '{self.name}'")
