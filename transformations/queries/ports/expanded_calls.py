"""The calls of platform functions that come out of macro expansion, found by the macro whose body contains them.

A macro's body is not parsed, so a pin in it is known as a range of text only. Which numbers it receives is read from the calls
that the parser makes of the macro's uses, in the program's text or in bodies of further macros. `Macros` finds these bodies by
name.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property

from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.flows.value_flows import PinArgument
from robosmi.transformations.queries.macros.tokens import names_in

_Place = tuple[str, int]
"""Path of a unit and an offset in it."""


class ExpandedCalls:
    """The calls that the macros of a program make.

    Args:
        views: a view of each of its units.
    """

    def __init__(self, views: Sequence[CodeView]) -> None:
        self._macros = Macros(view.unit for view in views)
        self._uses: dict[str, list[tuple[int, ccode.MacroUse]]] = {}
        self._calls: dict[str, list[tuple[CodeView, ccode.Call]]] = {}
        self._reached: dict[_Place, frozenset[str]] = {}
        self._unread = [str(lost.name) for view in views for lost in view.unit.unresolved]
        self._views = {id(view.unit): view for view in views}
        for view in views:
            self._uses[view.unit.path] = sorted(((int(u.startOffset), u) for u in view.unit.macroUses), key=lambda each: each[0])
            for call in view.of_kind(ccode.Call):
                if call.viaMacro:
                    self._calls.setdefault(str(call.calleeName), []).append((view, call))

    def of(self, argument: PinArgument) -> list[tuple[CodeView, ccode.Call]]:
        """The calls that a pin argument in a macro's body expands to, each with the view of its unit, in the program's order.

        A call whose macro use is not known counts for every macro that calls the function.
        """
        if argument.made:
            return [(self._views[id(ancestor_of_kind(call, ccode.SourceUnit))], call) for call in argument.made]
        names = {
            str(m.name)
            for macros in self._macros.values()
            for m in macros
            if m.startOffset <= argument.start < m.endOffset and m.eContainer() is argument.unit
        }
        found = []
        for view, call in self._calls.get(argument.function, ()):
            place = (view.unit.path, int(call.startOffset))
            at = self._names_at(place)
            if not at or not names.isdisjoint(at):
                found.append((view, call))
        return found

    @cached_property
    def used(self) -> frozenset[str]:
        """The macros that the program uses, also in text that could not be parsed, and those that their bodies use."""
        names = {str(use.name) for uses in self._uses.values() for _, use in uses}
        return self._macros.with_bodies([*names, *self._unread])

    def _names_at(self, place: _Place) -> frozenset[str]:
        """The macros used at a place and in their arguments, and those that their bodies use; empty where none is known."""
        if place not in self._reached:
            uses = self._uses.get(place[0], [])
            first = bisect_left(uses, place[1], key=lambda each: each[0])
            end = max((int(use.endOffset) for start, use in uses[first : first + 1] if start == place[1]), default=place[1])
            pending = [str(use.name) for _, use in uses[first : bisect_left(uses, end, key=lambda each: each[0])]]
            self._reached[place] = self._macros.with_bodies(pending)
        return self._reached[place]


class Macros(Mapping[str, Sequence[ccode.Macro]]):
    """Name -> the macros that are defined by it, in the order of the units.

    Args:
        units: of the program.
    """

    def __init__(self, units: Iterable[ccode.SourceUnit]) -> None:
        self._found: dict[str, list[ccode.Macro]] = {}
        for unit in units:
            for macro in unit.macros:
                self._found.setdefault(str(macro.name), []).append(macro)

    def __getitem__(self, name: str) -> Sequence[ccode.Macro]:
        return self._found[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._found)

    def __len__(self) -> int:
        return len(self._found)

    def with_bodies(self, names: Iterable[str]) -> frozenset[str]:
        """Names, and all that is named in the bodies of the macros that they are, and in those of the macros there."""
        found: set[str] = set()
        pending = list(names)
        while pending:
            name = pending.pop()
            if name not in found:
                found.add(name)
                pending += [n for macro in self._found.get(name, ()) for n in names_in(str(macro.body or ""))]
        return frozenset(found)
