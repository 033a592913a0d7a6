"""Pins of calls that come out of macro expansion: where each is written in the source, found through the expanded text.

`port_macros` reads the bodies of macros and finds the pins that they name plainly. This module finds the others: arguments for
`...`, arguments of functions whose name is pasted together, numbers behind such a name. A place in the source counts only if
everything that it expands to is a pin, so that no other argument is changed. A pin without such a place cannot be looked up:
its call stays without a pin.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Hashable, Iterator, Sequence
from functools import cached_property

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.api_facts import PinParameter
from robosmi.transformations.queries.argument_places import TokenText, bare
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expansion import Expanded, expanded_unit
from robosmi.transformations.queries.flow_reader import FlowReader, view_text
from robosmi.transformations.queries.macro_definitions import Path, TextPlace, macros_of
from robosmi.transformations.queries.port_macros import body_names, follow_argument
from robosmi.transformations.queries.value_flows import PinArgument


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


def follow_made(reader: FlowReader) -> None:
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
        argument = bare(one.text.tokens.tokens[one.first : one.behind])
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
        flows.keep(key, "macros pass it on", computed=not others)

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
        self.reader.flows.keep(key, f"no text of its own says which port '{function}' is given", computed=True)
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
