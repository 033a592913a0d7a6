"""Pins of calls that macros make, held against the expanded text: each is looked up where it is written, or known not to be.

Bodies of macros are read by `port_macros`, which sees what stands there in plain words. What it cannot see has its place found
here: arguments for `...`, of functions whose name is pasted, numbers behind such a name. A place counts only where each of its
uses is a pin, so that no other function is given one. What has no such place is a pin that nobody looks up: it is never ready.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.api_facts import PinParameter
from robosmi.transformations.queries.argument_places import TokenText
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expansion import Expanded, TextPlace, expanded_unit, macros_of
from robosmi.transformations.queries.flow_reader import FlowReader, view_text
from robosmi.transformations.queries.port_macros import body_names, follow_argument
from robosmi.transformations.queries.value_flows import PinArgument


class _Text(NamedTuple):
    """A unit's text with its macros expanded, and the tokens of it."""

    view: CodeView
    expanded: Expanded
    tokens: TokenText


class _MadePin(NamedTuple):
    """A pin of a call that a macro makes.

    Attributes:
        text: where it is.
        first: index of its first token there.
        function, pin: what takes it.
        places: where it is written, the outermost first.
        use: where the macro is used that makes the call: start and end in the unit.
    """

    text: _Text
    first: int
    function: str
    pin: PinParameter
    places: tuple[TextPlace, ...]
    use: tuple[int, int]


def follow_made(reader: FlowReader) -> None:
    """Find the pins of made calls that the bodies of macros do not show; the bodies are read before.

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

    def follow(self, made: Sequence[tuple[CodeView, ccode.Call, PinParameter]]) -> None:
        """Give each pin of made calls that no body shows its place.

        Args:
            made: the calls, as the parser has them, with each of their pins.
        """
        shown = {(a.unit.path, a.start, a.end) for flow in self.reader.flows.all() for a in flow.arguments}
        seen = [one for one in self.pins if any((p.unit, p.start, p.end) in shown for p in one.places)]
        known = {id(one) for one in seen}
        found: dict[tuple[TextPlace, str, PinParameter], list[_MadePin]] = {}
        for one in self.pins:
            places = reversed(one.places) if id(one) not in known else ()
            place = next((p for p in places if self._is_pin_everywhere(p)), None)
            if place is not None:
                found.setdefault((place, one.function, one.pin), []).append(one)
        for (place, function, pin), here in found.items():
            calls = [c for view, c, _ in made if any(one.text.view is view and _makes(one, c, pin) for one in here)]
            self._reach(place, function, pin, calls)
            seen += here
        for view, call, pin in made:
            if not any(one.text.view is view and _makes(one, call, pin) for one in seen):
                self._keep(view, call, pin)

    def _found(self, text: _Text) -> Iterator[_MadePin]:
        """The pins of the calls in an expanded text whose function is named by a macro."""
        for index, token in enumerate(text.tokens.tokens):
            way = text.expanded.path(token[1]) if token[0] == "name" else ()
            pins = self.reader.pins(token[3], text.view) if len(way) > 1 else ()
            arguments = text.tokens.arguments(index) if pins else None
            for pin in pins if arguments is not None else ():
                if arguments is not None and pin.position < len(arguments) and arguments[pin.position]:
                    first, last = arguments[pin.position][0], arguments[pin.position][-1]
                    places = text.expanded.places(first[1], last[2])
                    yield _MadePin(text, text.tokens.at(first[1]), token[3], pin, places, (way[0].start, way[0].end))

    def _is_pin_everywhere(self, place: TextPlace) -> bool:
        """Whether all that a place stands for in the program is a pin that an adapter takes."""
        pins = {(id(one.text), one.first) for one in self.pins if place in one.places and _translated(one.pin)}
        return bool(pins) and all((id(text), index) in pins for text in self.texts for index in _uses(text, place))

    def _reach(self, place: TextPlace, function: str, pin: PinParameter, calls: Sequence[ccode.Call]) -> None:
        """A pin of calls is written at a place."""
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
        """No text can look up a pin of a call."""
        function, argument = str(call.calleeName), list(call.arguments)[pin.position]
        start, end = int(argument.startOffset), int(argument.endOffset)
        if view_text(self.reader.sources[view.unit.path], start, end) in pin.none:
            return
        key = ("unplaced", view.unit.path, int(call.startOffset), function, pin.position)
        self.reader.flows.keep(key, f"no text of its own says which port '{function}' is given", computed=True)
        self.reader.reach(key, PinArgument(view.unit, start, end, function, pin, call, argument, unplaced=True))


def _makes(one: _MadePin, call: ccode.Call, pin: PinParameter) -> bool:
    """Whether a pin of the expanded text is one of a call of the parser's."""
    at = one.use[0] <= int(call.startOffset) < one.use[1]
    return at and one.function == call.calleeName and one.pin.position == pin.position


def _translated(pin: PinParameter) -> bool:
    return pin.range_with is None and pin.span == 1


def _uses(text: _Text, place: TextPlace) -> Iterator[int]:
    """Index of each first token of what a place stands for in an expanded text."""
    before: tuple[object, ...] = ()
    for index, token in enumerate(text.tokens.tokens):
        way = text.expanded.path(token[1])
        for level, frame in enumerate(way):
            if frame.unit == place.unit and frame.body == place.body and place.start <= frame.start < place.end:
                at = (*way[:level], place)
                if before != at:
                    yield index
                before = at
                break
        else:
            before = ()
