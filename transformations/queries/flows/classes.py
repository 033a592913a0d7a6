"""The functions and classes that a program defines, with constructors: who makes objects, and with what, is in the text.

Limits: constructors that differ in types alone are not told apart; conversions that nobody writes are not seen.
"""

from __future__ import annotations

import re
from collections.abc import Hashable, Iterable, Sequence
from functools import cached_property

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.member_records import record_key
from robosmi.transformations.queries.own_headers import is_member

_OF_CLASS = re.compile(r"(\w+)::~?\w+\s*\(")


class Classes:
    """The classes of one program.

    Args:
        views: a view of each of its units.
    """

    def __init__(self, views: Sequence[CodeView]) -> None:
        self._views = views

    @cached_property
    def _records(self) -> dict[str, ccode.Record]:
        found = (record for view in self._views for record in view.of_kind(ccode.Record) if record.name)
        return {str(record.name): record for record in found}

    @cached_property
    def _constructors(self) -> dict[str, list[ccode.Function]]:
        found: dict[str, list[ccode.Function]] = {}
        for function in (f for view in self._views for f in view.of_kind(ccode.Function)):
            record = self._class_of(function)
            if function.definition and record is not None and function.name.rpartition("::")[2] == record.name:
                found.setdefault(str(record.name), []).append(function)
        return found

    @cached_property
    def _made(self) -> frozenset[str]:
        """The classes of which the text makes objects with arguments."""
        made = {str(call.className) for view in self._views for call in view.of_kind(ccode.ConstructorCall)}
        initials = (initial for view in self._views for initial in view.of_kind(ccode.MemberInitializer))
        fields = {str(field.name): member_type(field.valueType) for view in self._views for field in view.of_kind(ccode.Field)}
        return frozenset(made | {fields.get(str(initial.name), str(initial.name)) for initial in initials})

    @cached_property
    def constructed(self) -> frozenset[Hashable]:
        """The keys of the classes whose members get their values in constructors."""
        keys: Iterable[Hashable | None] = (record_key(self._records[name]) for name in self._constructors)
        return frozenset(key for key in keys if key is not None)

    def is_own(self, name: str) -> bool:
        """Whether the program declares a class."""
        return name in self._records

    def named(self, name: str) -> ccode.Record | None:
        """The class or structure of a name that the program declares."""
        return self._records.get(name)

    def is_visible(self, name: str) -> bool:
        """Whether the text makes objects of a class of the program with arguments."""
        return name in self._constructors and name in self._made

    def constructors(self, name: str, count: int) -> list[ccode.Function]:
        """The constructors of a class that may be given a number of arguments."""
        return [function for function in self._constructors.get(name, ()) if count <= len(function.parameters)]

    @cached_property
    def _members(self) -> dict[str, list[ccode.Function]]:
        """Name -> the functions of that name that classes and namespaces define."""
        found: dict[str, list[ccode.Function]] = {}
        for function in (f for view in self._views for f in view.of_kind(ccode.Function) if f.definition and is_member(f)):
            found.setdefault(str(function.name).rpartition("::")[2], []).append(function)
        return found

    @cached_property
    def _virtual(self) -> frozenset[str]:
        return frozenset(str(f.name) for view in self._views for f in view.of_kind(ccode.Function) if f.virtual)

    def called(self, callee: ccode.Function) -> list[ccode.Function]:
        """The definitions that a call of a member function may run: of a virtual one all, since a pointer may be to any class."""
        name, record = str(callee.name).rpartition("::")[2], self._class_of(callee)
        every = self._members.get(name, [])
        return every if record is None or name in self._virtual else [f for f in every if self._class_of(f) is record]

    def definitions(self, declared: ccode.Function) -> list[ccode.Function]:
        """The definitions of a member function that a class declares, those of its overloads with as many parameters."""
        record, name = self._class_of(declared), str(declared.name).rpartition("::")[2]
        return [
            function
            for view in self._views
            for function in view.of_kind(ccode.Function)
            if function.definition
            and record is not None
            and str(function.name).rpartition("::")[2] == name
            and self._class_of(function) is record
            and len(function.parameters) == len(declared.parameters)
        ]

    def around(self, element: Element) -> ccode.Record | None:
        """The class whose member function contains an element, or is it; None outside of such a function."""
        function = element if isinstance(element, ccode.Function) else ancestor_of_kind(element, ccode.Function)
        return self._class_of(function) if function is not None else None

    def initialised(self, initial: ccode.MemberInitializer) -> ccode.Field | None:
        """The member that a constructor initialises; None for a base class."""
        record = self.around(initial)
        return next((f for f in record.fields if f.name == initial.name), None) if record is not None else None

    def with_member(self, record: ccode.Record, name: str) -> ccode.Record | None:
        """The class that declares a member of a class: itself or the only one of its base classes; None where none is known."""
        seen, waiting = {id(record)}, [record]
        found: list[ccode.Record] = []
        for each in waiting:
            if any(field.name == name for field in each.fields):
                found.append(each)
                continue
            bases = [self._records.get(type_name(base)) for base in each.bases]
            if None in bases:
                return None  # a base class that the program does not declare may have it
            waiting += [base for base in bases if base is not None and id(base) not in seen]
            seen |= {id(base) for base in bases}
        return found[0] if len(found) == 1 else None

    def _class_of(self, function: ccode.Function) -> ccode.Record | None:
        around = function.eContainer()
        if isinstance(around, ccode.Record):
            return around
        match = _OF_CLASS.search(str(function.signature or ""))
        return self._records.get(match[1]) if match is not None else None


class OwnFunctions:
    """The functions of one program.

    Args:
        views: a view of each of its units.
        classes: its classes.
    """

    def __init__(self, views: Sequence[CodeView], classes: Classes) -> None:
        self._classes = classes
        self._named: dict[str, ccode.Function] = {}
        """Name -> the function of that name, of several static ones any, and the one that all files share before them."""
        self._static: dict[tuple[int, str], ccode.Function] = {}
        """(`id` of the unit, name) -> its static function."""
        for function in (d for v in views for d in v.unit.declarations if isinstance(d, ccode.Function) and d.definition):
            if not is_member(function):
                static, name = function.storage is ccode.Storage.staticStorage, str(function.name)
                if static:
                    self._static[(id(function.eContainer()), name)] = function
                if not static or name not in self._named:
                    self._named[name] = function

    def defined(self, name: str, unit: ccode.SourceUnit) -> ccode.Function | None:
        """The function that a name means in a unit, if the program defines it."""
        return self._static.get((id(unit), name)) or self._named.get(name)

    def called(self, call: ccode.Call) -> list[ccode.Function]:
        """The functions that a call may run."""
        callee = call.callee
        unit = ancestor_of_kind(callee, ccode.SourceUnit) if callee is not None else None
        if callee is None or unit is None:
            return []
        if is_member(callee):
            return self._classes.called(callee)
        own = callee if callee.definition else self.defined(str(call.calleeName or ""), unit)
        return [own] if own is not None else []


def member_type(use: ccode.TypeUse | None) -> str:
    """The name of the type of a member that is made with its object; empty for a pointer or reference."""
    apart = use is None or bool(use.pointerDepth) or "&" in str(use.spelling) or "*" in str(use.spelling)
    return "" if apart else type_name(use)


def type_name(use: ccode.TypeUse | None) -> str:
    """The name of a type without qualifiers, pointers and references; empty for none."""
    words = str(use.spelling).replace("*", " ").replace("&", " ").split() if use is not None else []
    return " ".join(word for word in words if word not in ("const", "volatile", "struct", "class"))


def statics(views: Sequence[CodeView]) -> dict[tuple[int, str], ccode.Declaration]:
    """(`id` of a unit, name) -> its static variable of that name, the first of several."""
    found: dict[tuple[int, str], ccode.Declaration] = {}
    for view, declaration in ((v, d) for v in views for d in v.unit.declarations):
        if isinstance(declaration, ccode.Variable) and declaration.storage is ccode.Storage.staticStorage:
            found.setdefault((id(view.unit), str(declaration.name)), declaration)
    return found


def shared_names(views: Sequence[CodeView]) -> dict[str, ccode.Declaration]:
    """Name -> the variable or enumerator that all files of a program mean by it."""
    found: dict[str, ccode.Declaration] = {}
    for declaration in (d for view in views for d in view.unit.declarations):
        if isinstance(declaration, ccode.Variable) and declaration.storage is not ccode.Storage.staticStorage:
            found.setdefault(str(declaration.name), declaration)
        elif isinstance(declaration, ccode.Enumeration):
            found.update({str(literal.name): literal for literal in declaration.literals})
    return found
