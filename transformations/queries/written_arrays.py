"""Whether a program may write an array after its definition: by index, through a pointer, or in a function that gets it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind

_MOVED = ("+", "-")
_COUNTS = ("++", "--")
Declared: TypeAlias = "ccode.Variable | ccode.Parameter"
"""An array, or a pointer to one."""


class WrittenArrays:
    """Answers for one program, each once.

    Args:
        reads: (function of the platform, position) -> whether it surely only reads an array that it gets there.
    """

    def __init__(self, reads: Callable[[str, int], bool] | None = None) -> None:
        self._reads = reads
        self._found: dict[int, bool] = {}
        self._referring: dict[int, bool] = {}

    def is_written(self, declaration: Declared) -> bool:
        """Whether the program may write elements of an array, or what a pointer leads to.

        Args:
            declaration: the array or pointer.
        """
        pending, seen = [declaration], {id(declaration)}
        while pending:
            one = pending.pop()
            if self._found.get(id(one)) is False or _is_read_only(one):
                continue
            takers = [] if id(one) in self._found else list(map(self._writes, one.references))
            if id(one) in self._found or True in takers:
                self._found[id(declaration)] = True
                return True
            for taker in takers:
                if not isinstance(taker, bool) and id(taker) not in seen:
                    seen.add(id(taker))
                    pending.append(taker)
        self._found.update(dict.fromkeys(seen, False))  # all that they lead to was looked at, too
        return False

    def is_referred(self, reference: ccode.NameReference) -> bool:
        """Whether a use of a variable lets a reference of C++ lead to it, by which it may be written."""
        element: Element = reference
        around = element.eContainer()
        while _chooses(around, element):
            assert around is not None
            element, around = around, around.eContainer()
        if isinstance(around, ccode.Variable):
            return _is_reference(around)
        if isinstance(around, ccode.Assignment):
            return around.left is element is not reference
        if isinstance(around, ccode.Return):
            function = ancestor_of_kind(around, ccode.Function)
            return function is None or "&" in str(function.returnType.spelling if function.returnType is not None else "")
        if isinstance(around, ccode.Call) and element is not around.calleeExpression:
            place = list(around.arguments).index(element)  # type: ignore[arg-type]
            given = isinstance(around.callee, ccode.Function) and self._given(around, place, inside=True)
            return given if isinstance(given, bool) else self.is_written(given)
        if isinstance(around, (ccode.InitializerList, ccode.ConstructorCall, ccode.MemberInitializer)):
            return self._has_referring_members(reference)
        return False

    def _has_referring_members(self, reference: ccode.NameReference) -> bool:
        """Whether the file of a name declares a class with a reference as a member."""
        unit = ancestor_of_kind(reference, ccode.SourceUnit)
        if unit is not None and id(unit) not in self._referring:
            fields = (each for each in unit.eAllContents() if isinstance(each, ccode.Field))
            self._referring[id(unit)] = any("&" in str(f.valueType.spelling) for f in fields if f.valueType is not None)
        return unit is not None and self._referring[id(unit)]

    def _writes(self, reference: ccode.NameReference) -> bool | Declared:
        """Whether a use of an array or a pointer may write what it leads to, or the pointer by which it may."""
        target = reference.target
        refers = isinstance(target, (ccode.Variable, ccode.Parameter)) and _is_reference(target)
        element, inside = _accessed(reference, inside=refers)
        around = element.eContainer()
        if isinstance(around, ccode.Assignment):
            return inside == (around.left is element)
        if isinstance(around, ccode.Unary) and str(around.operator) in _COUNTS:
            return inside
        if isinstance(around, ccode.Variable):
            return True if _is_reference(around) else not inside and around
        if isinstance(around, ccode.Call) and element is not around.calleeExpression:
            return self._given(around, list(around.arguments).index(element), inside=inside)  # type: ignore[arg-type]
        return not inside and isinstance(around, (ccode.Return, ccode.InitializerList, ccode.ConstructorCall, ccode.For))

    def _given(self, call: ccode.Call, place: int, *, inside: bool) -> bool | Declared:
        """Whether a function may write what a call gives it: an element (`inside`), or the array; or its parameter for it."""
        function = call.callee
        own = isinstance(function, ccode.Function) and function.definition
        if not own and self._reads is not None and self._reads(str(call.calleeName), place):
            return False
        parameters = list(function.parameters) if isinstance(function, ccode.Function) else []
        if place >= len(parameters):
            return not inside  # of a function that nobody declares
        taker = parameters[place]
        if inside and not _is_reference(taker):
            return False
        return taker if own else not _is_read_only(taker)


def _accessed(reference: ccode.NameReference, *, inside: bool) -> tuple[Element, bool]:
    """The outermost expression that names the same memory, and whether it is an element and no pointer."""
    element: Element = reference
    while True:
        around = element.eContainer()
        operator = str(around.operator) if isinstance(around, (ccode.Unary, ccode.Binary)) else ""
        indexed = isinstance(around, ccode.Index) and around.array is element
        if indexed or (isinstance(around, ccode.Unary) and operator == "*"):
            inside = True
        elif isinstance(around, ccode.Unary) and operator == "&":
            inside = False
        elif inside or not (isinstance(around, ccode.Cast) or operator in (*_MOVED, *_COUNTS, ",") or _chooses(around, element)):
            return element, inside
        assert around is not None
        element = around


def _chooses(around: Element | None, element: Element) -> bool:
    return isinstance(around, ccode.ConditionalExpression) and around.condition is not element


def _is_read_only(declaration: ccode.Variable | ccode.Parameter) -> bool:
    """Whether the type forbids to write the elements."""
    use = declaration.valueType
    if use is None:
        return False
    return "const" in str(use.spelling).partition("*")[0].split() or (bool(use.constant) and not use.pointerDepth)


def _is_reference(declaration: ccode.Variable | ccode.Parameter) -> bool:
    """Whether a declaration is a reference of C++ through which another variable can be written."""
    return declaration.valueType is not None and "&" in str(declaration.valueType.spelling) and not _is_read_only(declaration)
