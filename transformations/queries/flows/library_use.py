"""Where a program touches a library, with which symbol and in which kind of element; the library is the user's to name.

A library is its headers, names, or a prefix of names. What a header that was read declares says so itself; where headers were
not read, a platform's repository may know them. Names that the program declares itself are never the library's.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.query import all_of_kind, ancestor_of_kind
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex


class LibraryUse(Struct, frozen=True):
    """A use of a library.

    Attributes:
        unit: the file.
        name: the symbol, as the program writes it.
        element: the Call, NameReference, MacroUse or Include; for a type the declaration or expression that has it.
        header: the header that declares it, empty where nobody knows.
    """

    unit: ccode.SourceUnit
    name: str
    element: ccode.Located
    header: str

    @property
    def kind(self) -> str:
        """The kind of element, as the metamodel names it."""
        return type(self.element).__name__


class LibraryNames(Struct, frozen=True):
    """What belongs to a library.

    Attributes:
        headers: as programs include them.
        names: of functions, macros, variables and types.
        prefix: what its names begin with, empty for nothing.
    """

    headers: Collection[str] = ()
    names: Collection[str] = ()
    prefix: str = ""

    def has(self, name: str, header: str) -> bool:
        """Whether a symbol is the library's."""
        return header in self.headers or name in self.names or bool(self.prefix and name.startswith(self.prefix))


def library_uses(program: ccode.Program, library: LibraryNames, api: ApiIndex | None = None) -> list[LibraryUse]:
    """Where a program uses a library, in text order.

    Args:
        program: the program, stored or on demand.
        library: what belongs to it.
        api: a platform whose repository knows headers that were not read.
    """
    found = []
    for unit in program.units:
        includes = [i.header for i in unit.includes]
        uses = []
        for name, element, header in _outside(unit):
            if not header and api is not None:
                entry = api.resolve(name, includes)
                header = entry.header if entry is not None else ""
            if library.has(name, header):
                uses.append(LibraryUse(unit, name, element, header))
        found += sorted(uses, key=lambda u: (int(u.element.startOffset), u.name))
    return found


def client_files(program: ccode.Program, library: LibraryNames, api: ApiIndex | None = None) -> list[ccode.SourceUnit]:
    """The files that use a library."""
    using = {id(u.unit) for u in library_uses(program, library, api)}
    return [unit for unit in program.units if id(unit) in using]


def _outside(unit: ccode.SourceUnit) -> Iterator[tuple[str, ccode.Located, str]]:
    """What a file uses and the program does not declare: name, element, header that declares it where that was read."""
    for include in unit.includes:
        yield include.header, include, include.header
    for use in unit.macroUses:
        if use.macro is None:
            yield use.name, use, use.header or ""
    for call in all_of_kind(unit, ccode.Call):
        callee = call.callee
        if callee is not None and not call.viaMacro and callee.linkage is not ccode.Linkage.defined:
            yield call.calleeName, call, callee.header or ""
    for reference in all_of_kind(unit, ccode.NameReference):
        target = reference.target
        if isinstance(target, (ccode.Function, ccode.ExternalSymbol)) and target.linkage is not ccode.Linkage.defined:
            yield reference.name, reference, target.header or ""
    for used in all_of_kind(unit, ccode.TypeUse):
        if isinstance(used.declaration, ccode.ExternalSymbol):
            yield used.declaration.name, _place(used), used.declaration.header or ""


def _place(use: ccode.TypeUse) -> ccode.Located:
    place = ancestor_of_kind(use, ccode.Located)
    assert place is not None
    return place
