"""One source file of a program that is read on demand: parsed at the first question, its parts built one by one.

`Unit` has the element, whose slots are promises, and what linking needs of the parser. The builders are those of `read_program`,
given a context that puts stand-ins in the place of parts. Links between units are `on_demand`'s.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from typing import Concatenate, ParamSpec, TypeAlias, TypeVar

from robosmi.diagnostics import Location
from robosmi.errors import ModelError, SourceError
from robosmi.metamodels import ccode
from robosmi.model.elements.ecore import EObject, EStructuralFeature
from robosmi.model.elements.features import all_features
from robosmi.model.elements.ordering import post_order
from robosmi.model.elements.strict import Element
from robosmi.model.elements.structure import contents
from robosmi.model.on_demand import Promise, settle, stand_in
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.t2m.c_source import coverage, declarations, macros, preprocessor
from robosmi.transformations.t2m.c_source.context import UnitContext
from robosmi.transformations.t2m.c_source.grammar import BUILDERS
from robosmi.transformations.t2m.c_source.parsing import checks
from robosmi.transformations.t2m.c_source.parsing.clang import Cursor
from robosmi.transformations.t2m.c_source.parsing.source import read_source
from robosmi.transformations.t2m.c_source.parsing.translation_unit import Parsed, parse
from robosmi.transformations.t2m.c_source.parsing.tree import Node

P = ParamSpec("P")
R = TypeVar("R", bound=Element)
T = TypeVar("T", bound=Element)
Linked: TypeAlias = "Element | Sequence[Element] | None"
"""The value of a cross reference."""


class WaitingContext(UnitContext):
    """A context whose builders leave parts for later; the contents of function-like macros are built at once, in order."""

    def __init__(self, unit: Unit, parsed: Parsed, api: ApiIndex, folders: Sequence[str]) -> None:
        super().__init__(parsed, api, BUILDERS, folders)
        self._unit = unit
        self._now = False

    def later(
        self, kind: type, build: Callable[Concatenate[UnitContext, P], R], *arguments: P.args, **named: P.kwargs
    ) -> R | None:
        """A stand-in for the element; None if the stand-in is just being resolved."""
        if self._now:
            self._now = False
            return None
        node = arguments[0]
        if isinstance(node, Node) and node.from_macro:
            use = self.enclosing(node.start)
            if use is None or self.function_like(use):
                return None
        around = self.depth, self.making
        made: R = stand_in(
            kind, lambda: self._build(lambda: build(self, *arguments, **named), around), node if isinstance(node, Node) else None
        )
        return made

    def _build(self, build: Callable[[], R], around: tuple[int, int | None]) -> R:
        if not self.parsed.unit:
            raise ModelError("the program was closed before this part was parsed", fix="close it later")
        before = self.depth, self.making
        (self.depth, self.making), self._now = around, True
        try:
            made = build()
        finally:
            (self.depth, self.making), self._now = before, False
        while (make := made.__dict__.get("_make")) is not None:
            made = make()
        return self._unit.settled(made)


class Unit:
    """A source file.

    Args:
        path: as it is to be called in the model.
        api: the platform's.
        folders: with headers.
        defines: macros from outside.
        link: finds the value of a cross reference of an element.
        program: the program's element.
        cplusplus: whether the program's headers are C++.

    Raises:
        SourceError: the file is not there, or is no text.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        api: ApiIndex,
        folders: Sequence[str],
        defines: Sequence[str],
        link: Callable[[Unit, Element, EStructuralFeature], Linked],
        program: ccode.Program,
        cplusplus: bool = False,
    ) -> None:
        self._api, self._folders, self._defines, self._link_of = api, list(folders), list(defines), link
        self._source = source = read_source(path, cplusplus)
        self._parsed: Parsed | None = None
        self._cursors: dict[int, Cursor | None] = {}
        self._counted = -1
        self.element = ccode.SourceUnit(
            path=source.path, encoding=source.encoding, digest=source.digest, language=source.language, size=source.size
        )
        waiting: dict[str, Callable[[], Element | Sequence[Element] | int]] = {
            "program": lambda: program,
            "includes": lambda: self._settled_all(preprocessor.read(self.context)[0]),
            "macros": lambda: self._settled_all(preprocessor.read(self.context)[1]),
            "conditionals": lambda: self._settled_all(preprocessor.read(self.context)[2]),
            "comments": lambda: self._settled_all(preprocessor.read(self.context)[3]),
            "macroUses": lambda: self._settled_all(macros.uses(self.context)),
            "declarations": lambda: self._settled_all(declarations.group(self.context, self.context.parsed.nodes)),
            "problems": lambda: self._settled_all(coverage.problems(self.context)),
            "unresolved": lambda: self._settled_all(self._covered.unresolved),
            "callsInText": lambda: self._covered.in_text,
            "callsInModel": lambda: self._covered.in_model,
        }
        for feature in all_features(ccode.SourceUnit.eClass):
            if feature.name in waiting:
                Promise(self.element, feature, waiting[feature.name])
        settle(self.element)

    @cached_property
    def context(self) -> WaitingContext:
        """The parsed file.

        Raises:
            SourceError: it is no C.
        """
        parsed = parse(self._source, self._api, self._folders, self._defines)
        if parsed is None:
            place = Location(self._source.path)
            raise SourceError("the C parser gave up on this file", location=place, fix="check that it is C source text")
        self._parsed = parsed
        context = WaitingContext(self, parsed, self._api, self._folders)
        checks.refuse_other_languages(parsed)
        preprocessor.read(context)  # so that the context knows the file's own macros
        return context

    @cached_property
    def _covered(self) -> coverage.Coverage:
        pending: list[EObject] = [*self.element.declarations, *self.element.macroUses]
        while pending:  # all of it must be built for this
            pending += contents(pending.pop())
        return coverage.calls(self.context)

    def settled(self, element: T) -> T:
        """Make a newly built element read-only, with promises for its cross references."""
        settle(element, self._linked)
        return element

    def _linked(self, owner: Element, feature: EStructuralFeature) -> Linked:
        return self._link_of(self, owner, feature)

    def _settled_all(self, elements: Iterable[T]) -> list[T]:
        return [self.settled(element) for element in elements]

    @property
    def cursors(self) -> dict[int, Cursor | None]:
        """The `id` of each call and name -> the cursor of the declaration that libclang resolved it to."""
        known = self._cursors
        context = self.context
        total = len(context.calls) + len(context.references)
        if self._counted != total:
            known.update({id(call): cursor for call, cursor in context.calls})
            known.update({id(name): cursor for name, cursor in context.references})
            self._counted = total
        return known

    def declared(self, cursor: Cursor) -> ccode.Declaration | None:
        """The element built for a declaration's cursor, or None; this builds the declarations at file scope."""
        len(self.element.declarations)
        return self.context.declared.get(self.context.pointer(cursor))

    def macro(self, name: str) -> ccode.Macro | None:
        """The file's own macro of that name, the last one, or None."""
        return {str(macro.name): macro for macro in self.element.macros}.get(name)

    def link_macros(self) -> None:
        """Link the uses of the file's own macros."""
        by_name = {str(macro.name): macro for macro in self.element.macros}
        for use in self.element.macroUses:
            if str(use.name) in by_name:
                use.macro = by_name[str(use.name)]

    def close(self) -> None:
        """Free the parser's memory."""
        if self._parsed is not None:
            self._parsed.close()


def in_building_order(unit: Unit) -> None:
    """Sort what is to be linked in the order in which `read_program` builds it: parts before wholes, features in order.

    In three classes that is not the metamodel's order: the parts of `do` and `for` are built in text order, and in an
    initialiser list the value is built before its designator.
    """
    start: list[EObject] = [unit.element]
    rank = {id(element): place for place, element in enumerate(post_order(start, _parts))}
    context = unit.context
    context.calls.sort(key=lambda entry: rank.get(id(entry[0]), -1))
    context.references.sort(key=lambda entry: rank.get(id(entry[0]), -1))


def _parts(element: EObject) -> list[EObject]:
    """The direct contents of an element, in the order in which they are built."""
    parts: Sequence[EObject | None] = contents(element)
    if isinstance(element, ccode.DoWhile):
        parts = [element.body, element.condition]
    elif isinstance(element, ccode.For):
        parts = [element.initial, element.declaration, element.range, element.condition, element.step, element.body]
    elif isinstance(element, ccode.Assignment) and isinstance(element.eContainer(), ccode.InitializerList):
        parts = [element.right, element.left]
    return [part for part in parts if part is not None]
