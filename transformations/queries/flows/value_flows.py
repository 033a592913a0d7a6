"""Disjoint sets of things in a program that can exchange a value, with the numbers that enter and the reasons against change.

This is a union-find structure and nothing more: `queries.ports.port_flows` decides what is joined. Things are known by any
hashable key.
"""

from __future__ import annotations

from collections.abc import Hashable

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.api_facts import PinParameter


class PortPlace(Struct, frozen=True):
    """A number in the text that may be a port of the source.

    Attributes:
        unit: the file.
        start, end: its bytes; of an enumerator the whole of it.
        value: the number.
        element: the literal, or the macro or enumerator that has the number in its text.
        name: of the constant or variable that holds it, `rows[2]` for an element of an array, empty for a bare number.
        within: the function that the name belongs to, empty at file scope.
    """

    unit: ccode.SourceUnit
    start: int
    end: int
    value: int
    element: ccode.Located
    name: str = ""
    within: str = ""


class PinArgument(Struct, frozen=True):
    """An argument that is a pin for a function of the platform.

    Attributes:
        unit: the file.
        start, end: the bytes of the argument, in a call or in the body of a macro.
        function: the platform's function.
        parameter: what is known of the parameter.
        call: the call, None in the body of a macro.
        argument: the expression of the argument, None in the body of a macro.
        made: the calls that macros expand to with this argument, where they are known.
        unplaced: whether no place in the source stands for this argument alone, so that it cannot be looked up.
        construction: the construction of an object of the platform, where that takes the pin instead of a call.
        mixed: whether the call may reach functions, too, that take another number in the pin's place.
    """

    unit: ccode.SourceUnit
    start: int
    end: int
    function: str
    parameter: PinParameter
    call: ccode.Call | None = None
    argument: ccode.Expression | None = None
    made: tuple[ccode.Call, ...] = ()
    unplaced: bool = False
    construction: ccode.ConstructorCall | ccode.MemberInitializer | None = None
    mixed: bool = False

    @property
    def given(self) -> list[ccode.Expression] | None:
        """All arguments of the call or construction; None in the body of a macro."""
        made = self.call if self.call is not None else self.construction
        return list(made.arguments) if made is not None else None

    @property
    def translated(self) -> bool:
        """Whether an adapter takes the argument as a pin of the target, and a place in the source stands for it."""
        return self.taken and not self.unplaced

    @property
    def taken(self) -> bool:
        """Whether an adapter takes the parameter as a single pin of the target; ends of a range of pins stay source numbers."""
        return self.parameter.range_with is None and self.parameter.span == 1


class Flow:
    """A set of things that exchange values.

    Attributes:
        places: the numbers that come in.
        arguments: the pins that go out.
        kept: why its numbers have to stay as they are; empty where nothing speaks against change.
        computed: whether a value comes in that no number in the text shows.
        calculated: the expressions that compute values which come in, each with its file.
        given: the other expressions and macros whose values come in, each with its file.
    """

    def __init__(self) -> None:
        self.places: list[PortPlace] = []
        self.arguments: list[PinArgument] = []
        self.kept: list[str] = []
        self.computed = False
        self.calculated: list[tuple[ccode.SourceUnit, ccode.Located]] = []
        self.given: list[tuple[ccode.SourceUnit, ccode.Located]] = []


class Flows:
    """All flows of a program."""

    def __init__(self) -> None:
        self._above: dict[Hashable, Hashable] = {}
        self._flows: dict[Hashable, Flow] = {}
        self._put: dict[tuple[str, int], list[Hashable]] = {}
        """(path of the unit, start) of each number in the text -> the keys of the things that it enters."""

    def of(self, key: Hashable) -> Flow:
        """The flow of a thing, created if it is new."""
        root = self._root(key)
        return self._flows.setdefault(root, Flow())

    def put(self, key: Hashable, place: PortPlace) -> None:
        """Record that a number in the text enters the flow of a thing."""
        self.of(key).places.append(place)
        self._put.setdefault((str(place.unit.path), place.start), []).append(key)

    def has(self, key: Hashable, unit: str, start: int) -> bool:
        """Whether the number that begins at a place of the text is in the flow of a thing."""
        return any(self._root(known) == self._root(key) for known in self._put.get((unit, start), ()))

    def join(self, one: Hashable, other: Hashable) -> None:
        """Join the flows of two things that exchange values."""
        first, second = self._root(one), self._root(other)
        if first == second:
            return
        self._above[second] = first
        taken = self._flows.pop(second, None)
        if taken is not None:
            into = self.of(first)
            into.places += taken.places
            into.arguments += taken.arguments
            into.kept += taken.kept
            into.computed |= taken.computed
            into.calculated += taken.calculated
            into.given += taken.given

    def freeze(self, key: Hashable, why: str, *, computed: bool = False) -> None:
        """Record why the numbers of a flow must not be changed; with `computed`, a value enters that the text does not show."""
        flow = self.of(key)
        if why not in flow.kept:
            flow.kept.append(why)
        flow.computed |= computed

    def keys(self) -> dict[tuple[str, int, int], Hashable]:
        """(path of the unit, start, end) of each pin argument -> a key of its flow."""
        return {(str(a.unit.path), a.start, a.end): key for key, flow in self._flows.items() for a in flow.arguments}

    def all(self) -> list[Flow]:
        """Every flow, in the order of creation."""
        return list(self._flows.values())

    def _root(self, key: Hashable) -> Hashable:
        path = []
        while (above := self._above.get(key)) is not None:
            path.append(key)
            key = above
        for passed in path:
            self._above[passed] = key
        return key
