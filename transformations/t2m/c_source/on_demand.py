"""Driver for C programs as they lie on disk: a model over libclang that builds an element only when a query needs it.

Types, features and element classes are those of the metamodel `ccode`, built by the builders of `read_program`, so that
queries, constraints and templates cannot tell the difference. A file is parsed at the first question about its contents; a
function's body, a statement's parts and an expression's operands are built when they are accessed (`model.on_demand`), and
kept. Only links to names from outside the program, and those from declarations to their uses, need the whole program. The model
is a read-only view of its sources.

`Unit` is one source file. It has the element, whose slots are promises, and what linking needs of the parser. The builders are
given a context that puts stand-ins in the place of parts. Links between units are the program's.
"""

from __future__ import annotations

import os
import weakref
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import Concatenate, ParamSpec, TypeAlias, TypeVar

from robosmi.diagnostics import Location
from robosmi.errors import ModelError, SourceError, UsageError
from robosmi.metamodels import ccode
from robosmi.model.ecore.metamodel import Metamodel, TypedModel
from robosmi.model.elements.compact_slots import collector_at_rest
from robosmi.model.elements.driver import DynamicNode, Kind, ModelElement, Node as ModelNode
from robosmi.model.elements.ecore import EObject, EReference, EStructuralFeature, Scalar
from robosmi.model.elements.features import all_features
from robosmi.model.elements.fragments import fragment_of, resolve
from robosmi.model.elements.ordering import post_order
from robosmi.model.elements.pyecore_internals import key_of, read
from robosmi.model.elements.strict import Element
from robosmi.model.elements.structure import contents, root_of
from robosmi.model.on_demand import Promise, settle, stand_in
from robosmi.project import default_text
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.t2m.c_source import coverage, declarations, macros, preprocessor
from robosmi.transformations.t2m.c_source.context import UnitContext
from robosmi.transformations.t2m.c_source.grammar import BUILDERS
from robosmi.transformations.t2m.c_source.linking import Linker, qualified
from robosmi.transformations.t2m.c_source.parsing import checks, cursor_kinds
from robosmi.transformations.t2m.c_source.parsing.clang import Cursor
from robosmi.transformations.t2m.c_source.parsing.source import read_source
from robosmi.transformations.t2m.c_source.parsing.sources import is_cplusplus_program, source_files
from robosmi.transformations.t2m.c_source.parsing.translation_unit import Parsed, parse
from robosmi.transformations.t2m.c_source.parsing.tree import Node

LEAVES = {
    cursor_kinds.DECL_REF_EXPR: ccode.NameReference,
    cursor_kinds.INTEGER_LITERAL: ccode.IntegerLiteral,
    cursor_kinds.FLOATING_LITERAL: ccode.FloatingLiteral,
    cursor_kinds.STRING_LITERAL: ccode.StringLiteral,
    cursor_kinds.CHARACTER_LITERAL: ccode.CharacterLiteral,
}
"""CXCursorKind -> the class of its element, for leaves outside of macros."""
LONGEST = 100
"""Length above which an integer literal stands for text that was cut (`bounds`) and becomes another element."""
IN_EXTERNALS = (ccode.Function, ccode.ExternalSymbol, ccode.Parameter, ccode.TypeUse)
"""The classes of elements in and below `Program.externals`; functions from outside have no bodies."""

_P = ParamSpec("_P")
_R = TypeVar("_R", bound=Element)
_T = TypeVar("_T", bound=Element)
_Linked: TypeAlias = "Element | Sequence[Element] | None"
"""The value of a cross reference."""


class OnDemandProgram(TypedModel):
    """The source files of one program, read on demand.

    Args:
        paths: the files, as they are to be called in the model; folders and `compile_commands.json` as for `read_program`.
        platform: the platform it was written for.
        include_dirs: folders with headers.
        defines: macros from outside, `NAME` or `NAME=VALUE`.
        name: what `M!Call` calls it.

    Raises:
        SourceError: a file is not there, or is no text. One that is no C is refused when it is parsed.
        PlatformDataError: nothing is known of the platform.
        MissingToolError: libclang is not installed.
    """

    read_only = True

    def __init__(
        self,
        paths: Sequence[str | os.PathLike[str]],
        platform: str,
        include_dirs: Sequence[str | os.PathLike[str]] = (),
        defines: Sequence[str] = (),
        name: str = "M",
    ) -> None:
        if not paths:
            raise UsageError("no source file is given", fix="name at least one C file")
        super().__init__(Metamodel([ccode]), name, Path(paths[0]))
        self._extents: dict[tuple[type, bool], list[Element]] = {}
        self._linked = False
        folders = [os.fspath(d) for d in include_dirs]
        api = ApiIndex.load(platform)
        files = source_files(paths, folders, defines)
        self.program = ccode.Program(
            name=os.path.splitext(os.path.basename(files[0].path))[0],
            includeFolders=list(dict.fromkeys(folder for file in files for folder in file.include_dirs)) or folders,
            defines=list(dict.fromkeys(define for file in files for define in file.defines)) or list(defines),
        )
        self._units: list[Unit] = []
        for file in files:
            try:
                cplusplus = is_cplusplus_program(files)
                self._units.append(Unit(file.path, api, file.include_dirs, file.defines, self._link, self.program, cplusplus))
            except SourceError:  # of a folder what is no text is left out
                if file.given or (file is files[-1] and not self._units):
                    raise
        self.program.languages.extend(dict.fromkeys(str(u.element.language) for u in self._units))
        features = {f.name: f for f in all_features(ccode.Program.eClass)}
        Promise(self.program, features["units"], lambda: [unit.element for unit in self._units])
        Promise(self.program, features["externals"], self._externals)
        settle(self.program)
        self.close = weakref.finalize(self, _close, self._units)
        """Frees the parser's memory; what was not built by then cannot be built any more."""

    # Extents

    def all_contents(self) -> Iterator[Element]:
        """All elements in containment pre-order; each is built when the loop comes to it."""
        return self._walk(object)

    def all_of_kind(self, kind: Kind) -> list[Element]:
        """The elements of a type and its subtypes; only what can hold such elements is built on the way.

        Raises:
            UnknownTypeError: a name that there is not.
        """
        return list(self._extent(self._class_of(kind), False))

    def all_of_type(self, kind: Kind) -> list[Element]:
        """The elements of exactly a type; only what can hold such elements is built on the way.

        Raises:
            UnknownTypeError: a name that there is not.
        """
        return list(self._extent(self._class_of(kind), True))

    def _extent(self, cls: type, exact: bool) -> list[Element]:
        found = self._extents.get((cls, exact))
        if found is None:
            with collector_at_rest():
                found = [x for x in self._walk(cls) if (x.__class__ is cls if exact else isinstance(x, cls))]
            self._extents[cls, exact] = found
        return found

    def _walk(self, wanted: type, start: Element | None = None) -> Iterator[Element]:
        """Elements in pre-order; subtrees that cannot contain an element of the wanted class are skipped."""
        pending: list[Element] = [start if start is not None else self.program]
        while pending:
            element = pending.pop()
            yield element
            slots = element.__dict__
            parts: list[Element] = []
            for name, many in _ways(element.__class__, wanted):
                slot = slots[name]
                if slot.__class__ is Promise and _holds_only_others(slot, wanted):
                    continue
                value = read(slot)
                if many:
                    parts += value
                elif value is not None:
                    parts.append(value)
            if parts:
                parts.reverse()
                pending += parts

    # Identity

    def element(self, identity: str) -> DynamicNode | None:
        """The element at a fragment (`//@units.0/@declarations.3`), or None; only the way to it is built.

        Raises:
            ModelError: the fragment names a feature that is none.
        """
        return resolve(identity, [self.program]) if identity.startswith("/") else None

    def id_of(self, element: ModelNode) -> str:
        """The fragment of an element, the same as in the stored model."""
        return fragment_of(element, [self.program])

    def owns(self, element: Scalar | ModelElement) -> bool:
        """Whether the element is in this program."""
        return isinstance(element, Element) and root_of(element) is self.program

    # Links

    def _link(self, unit: Unit, element: Element, feature: EStructuralFeature) -> _Linked:
        """The value of a cross reference."""
        found: _Linked = self._near(unit, element, feature.name) if not feature.many else None
        if found is None:
            self._link_all()
            slot = element.__dict__[feature.name]  # what was built after all was linked has no link
            found = (() if feature.many else None) if isinstance(slot, Promise) else read(slot)
        return found

    def _near(self, unit: Unit, element: Element, name: str) -> Element | None:
        """The program's own declaration that a use refers to, if it can be found without linking the whole program."""
        cursor = unit.cursors.get(id(element))
        if isinstance(element, ccode.MacroUse) and name == "macro":
            return unit.macro(str(element.name))
        if cursor is None:
            return None
        if isinstance(element, ccode.Call) and name == "callee":
            name = qualified(unit.context.lib, cursor, str(element.calleeName))
            return self._function(unit, name, unit.declared(cursor))
        if not isinstance(element, ccode.NameReference) or name != "target":
            return None
        top: Element | None = element
        while not isinstance(top, ccode.Declaration) or not isinstance(top.eContainer(), ccode.SourceUnit):
            if top is None:
                return None
            top = top.eContainer()
        found = unit.declared(cursor)
        if found is None and isinstance(top, ccode.Function):
            for _ in self._walk(ccode.Declaration, top):  # it may be declared in this function
                pass
            found = unit.declared(cursor)
        return self._function(unit, str(element.name), found) if found is None or isinstance(found, ccode.Function) else found

    def _function(self, unit: Unit, name: str, declared: ccode.Declaration | None) -> ccode.Function | None:
        function = declared if isinstance(declared, ccode.Function) else None
        if function is None or not function.definition:
            declarations = [list(u.element.declarations) for u in self._units]
            function = Linker([u.context for u in self._units], declarations)._own(self._units.index(unit), name) or function
        return function

    def _externals(self) -> list[ccode.Declaration]:
        self._link_all()
        return self._made_externals

    def _link_all(self) -> None:
        """Build what is left and link everything, as `read_program` does."""
        if self._linked:
            return
        self._linked = True
        with collector_at_rest():
            self._link_everything()

    def _link_everything(self) -> None:
        elements = [x for unit in self._units for x in self._walk(object, unit.element)]
        for element in elements:
            for feature in _links(element.__class__):
                element.__dict__.pop(key_of(feature), None)
        contexts = [unit.context for unit in self._units]
        for unit in self._units:
            _in_building_order(unit)
            unit.link_macros()
        self._made_externals = Linker(list(contexts), [list(unit.element.declarations) for unit in self._units]).run()
        for element in (*(unit.element for unit in self._units), *self._made_externals):
            settle(element)


def _close(units: list[Unit]) -> None:
    for unit in units:
        unit.close()


_HOLDS: dict[tuple[EReference, type], bool] = {}
_CONTAINS: dict[type[Element], list[EReference]] = {}
_WAYS: dict[tuple[type[Element], type], list[tuple[str, bool]]] = {}
_CROSS: dict[type[Element], list[EReference]] = {}


def _containments(cls: type[Element]) -> list[EReference]:
    if cls not in _CONTAINS:
        _CONTAINS[cls] = [f for f in all_features(cls.eClass) if isinstance(f, EReference) and f.containment]
    return _CONTAINS[cls]


def _ways(cls: type[Element], wanted: type) -> list[tuple[str, bool]]:
    """The containment slots of a class below which elements of a wanted class may be, each with whether it is many-valued."""
    if (cls, wanted) not in _WAYS:
        _WAYS[cls, wanted] = [(key_of(feature), feature.many) for feature in _containments(cls) if _can_hold(feature, wanted)]
    return _WAYS[cls, wanted]


def _links(cls: type[Element]) -> list[EReference]:
    if cls not in _CROSS:
        references = [f for f in all_features(cls.eClass) if isinstance(f, EReference) and not f.containment]
        _CROSS[cls] = [f for f in references if not (f.eOpposite and f.eOpposite.containment)]
    return _CROSS[cls]


def _can_hold(feature: EReference, wanted: type) -> bool:
    """Whether the metamodel allows elements of the class in or below a containment reference."""
    known = _HOLDS.get((feature, wanted))
    if known is None and feature.eContainingClass is ccode.Program.eClass and feature.name == "externals":
        known = _HOLDS[feature, wanted] = any(issubclass(cls, wanted) for cls in IN_EXTERNALS)
    if known is None:
        seen: set[type] = set()
        pending = [feature]
        while pending and not known:
            kind = pending.pop().eType
            for cls in _CLASSES:
                if isinstance(kind, type) and issubclass(cls, kind) and cls not in seen:
                    seen.add(cls)
                    known = known or issubclass(cls, wanted)
                    pending.extend(_containments(cls))
        known = _HOLDS[feature, wanted] = bool(known)
    return known


_CLASSES = [c for c in ccode.eClassifiers.values() if isinstance(c, type) and issubclass(c, Element) and not c.eClass.abstract]


def _holds_only_others(promise: Promise, wanted: type) -> bool:
    """Whether everything still unbuilt in a slot is a leaf of a class other than the wanted one."""
    if not promise.hint:
        return False
    for node in promise.hint:
        while (
            node is not None
            and not node.from_macro
            and node.kind in (cursor_kinds.UNEXPOSED_EXPR, cursor_kinds.PAREN_EXPR)
            and len(node.children) == 1
        ):
            node = node.children[0]
        leaf = LEAVES.get(node.kind) if node is not None and not node.from_macro else None
        if leaf is ccode.IntegerLiteral and node.end - node.start > LONGEST:
            leaf = None
        if leaf is None or issubclass(leaf, wanted):
            return False
    return True


def open_program(
    path: str | Path | Sequence[str | Path],
    name: str | None = None,
    platform: str | None = None,
    include_dirs: Sequence[str | Path] = (),
    defines: Sequence[str] = (),
) -> OnDemandProgram:
    """Open a program's source file, or all that are compiled together; see `OnDemandProgram`."""
    paths = [path] if isinstance(path, (str, Path)) else list(path)
    source_platform = platform or default_text("migrate", "source_platform")
    return OnDemandProgram(paths, source_platform, include_dirs, defines, name or Path(paths[0]).stem)


class WaitingContext(UnitContext):
    """A context whose builders leave parts for later; the contents of function-like macros are built at once, in order."""

    def __init__(self, unit: Unit, parsed: Parsed, api: ApiIndex, folders: Sequence[str]) -> None:
        super().__init__(parsed, api, BUILDERS, folders)
        self._unit = unit
        self._now = False

    def later(
        self, kind: type, build: Callable[Concatenate[UnitContext, _P], _R], *arguments: _P.args, **named: _P.kwargs
    ) -> _R | None:
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
        made: _R = stand_in(
            kind, lambda: self._build(lambda: build(self, *arguments, **named), around), node if isinstance(node, Node) else None
        )
        return made

    def _build(self, build: Callable[[], _R], around: tuple[int, int | None]) -> _R:
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
        link: Callable[[Unit, Element, EStructuralFeature], _Linked],
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

    def settled(self, element: _T) -> _T:
        """Make a newly built element read-only, with promises for its cross references."""
        settle(element, self._linked)
        return element

    def _linked(self, owner: Element, feature: EStructuralFeature) -> _Linked:
        return self._link_of(self, owner, feature)

    def _settled_all(self, elements: Iterable[_T]) -> list[_T]:
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


def _in_building_order(unit: Unit) -> None:
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
