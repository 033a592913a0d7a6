"""Driver for C programs as they lie on disk: a model over libclang that builds an element only when a query needs it.

Types, features and element classes are those of the metamodel `ccode`, built by the builders of `read_program`, so that
queries, constraints and templates cannot tell the difference. A file is parsed at the first question about its contents; a
function's body, a statement's parts and an expression's operands are built when they are accessed (`model.on_demand`), and
kept. Only links to names from outside the program, and those from declarations to their uses, need the whole program. The model
is a read-only view of its sources. The contents of a unit are in `on_demand_unit`.
"""

from __future__ import annotations

import os
import weakref
from collections.abc import Iterator, Sequence
from pathlib import Path

from robosmi.errors import SourceError, UsageError
from robosmi.metamodels import ccode
from robosmi.model.ecore.metamodel import Metamodel, TypedModel
from robosmi.model.elements.compact_slots import collector_at_rest
from robosmi.model.elements.driver import DynamicNode, Kind, ModelElement, Node
from robosmi.model.elements.ecore import EReference, EStructuralFeature, Scalar
from robosmi.model.elements.features import all_features
from robosmi.model.elements.fragments import fragment_of, resolve
from robosmi.model.elements.pyecore_internals import key_of, read
from robosmi.model.elements.strict import Element
from robosmi.model.elements.structure import root_of
from robosmi.model.on_demand import Promise, settle
from robosmi.project import default_text
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.t2m.c_source.linking import Linker, qualified
from robosmi.transformations.t2m.c_source.on_demand_unit import Linked, Unit, in_building_order
from robosmi.transformations.t2m.c_source.parsing import cursor_kinds
from robosmi.transformations.t2m.c_source.parsing.sources import is_cplusplus_program, source_files

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

    def id_of(self, element: Node) -> str:
        """The fragment of an element, the same as in the stored model."""
        return fragment_of(element, [self.program])

    def owns(self, element: Scalar | ModelElement) -> bool:
        """Whether the element is in this program."""
        return isinstance(element, Element) and root_of(element) is self.program

    # Links

    def _link(self, unit: Unit, element: Element, feature: EStructuralFeature) -> Linked:
        """The value of a cross reference."""
        found: Linked = self._near(unit, element, feature.name) if not feature.many else None
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
            in_building_order(unit)
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
