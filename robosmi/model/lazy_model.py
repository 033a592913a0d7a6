"""`open_model(..., lazy=True)`: an XMI file of which only a skeleton is read, until something needs its elements.

The skeleton is one pass over the file: the class, the id and the position of every element. It answers how many elements of a
type there are, which they are, and which one has an id. An element that it gives reads its own attributes from its start tag.
All else (references, containers, contents, changes, saving) loads the file. The elements that were given before are then
elements of the model, and the model is an `EmfModel`. A file that is not plain is loaded at once: one in JSON, with parts in
other files, or with anything that its metamodel does not have.
"""

from __future__ import annotations

import hashlib
import os
from array import array
from bisect import bisect_left
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn
from xml.parsers import expat

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import ModelError, RobosmiError
from robosmi.model.ecore.metamodel import Metamodel, Packages, TypedModel
from robosmi.model.ecore.metamodels import OWN_NAMESPACES, built_in
from robosmi.model.ecore.xmi_document import XMI_NAMESPACES
from robosmi.model.elements.compact_slots import collector_at_rest
from robosmi.model.elements.datatypes import ECORE_URI
from robosmi.model.elements.ecore import DynamicEObject, EAttribute, EClass
from robosmi.model.elements.features import class_in
from robosmi.model.elements.fragments import own_id
from robosmi.model.elements.pyecore_internals import IDENTITY
from robosmi.model.elements.xmi_plan import CHILD, CHILDREN, REFERENCE, VALUE, VALUES, XSI, ClassPlan, Plans
from robosmi.model.emf import EmfModel, outermost
from robosmi.model.xmi.text_forms import is_json, is_yaml
from robosmi.model.xmi.xml_characters import may_contain_escapes

if TYPE_CHECKING:
    from robosmi.model.xmi.open_files import OpenFiles

_READ_ALONE = 1000
"""So many start tags are read one by one; the next one loads the file."""
_UNKNOWN: Any = object()


class NotPlainError(Exception):
    """The file has something that only a full load understands, or reports."""


def _not_plain(*_: object) -> NoReturn:
    raise NotPlainError


class _Kind:
    """What the skeleton has of one class.

    Args:
        plan: how the reader treats the class.

    Attributes:
        plan: the same.
        members: the numbers of its elements.
        ids: the names of the attributes that identify its elements.
        children: the tag of a contained element, or the tag and its xsi:type -> its class; None for a text.
        texts: the tags of values that are elements of their own.
    """

    __slots__ = ("children", "ids", "members", "plan", "texts")

    def __init__(self, plan: ClassPlan) -> None:
        identifying = {name: entry for name, entry in plan.entries.items() if entry.is_id}
        if plan.abstract or plan.refused or any(e.convert or e.feature.defaultValueLiteral for e in identifying.values()):
            raise NotPlainError
        self.plan = plan
        self.members = array("L")
        self.ids = [*identifying]
        self.children: dict[str, _Kind | None] = {}
        self.texts: set[str] = set()


class Skeleton:
    """The class, the id and the position of every element of a file; elements are numbered in the order of the file.

    Args:
        data: the bytes of the file.
        package: finds a package by its namespace.

    Raises:
        NotPlainError: a full load has to read it.
    """

    def __init__(self, data: bytes, package: Callable[[str], Any]) -> None:
        if data[:1] != b"<" or may_contain_escapes(data):  # else it is UTF-8, and positions are those of its bytes
            raise NotPlainError
        self.data = data
        self.positions = array("L")
        self.hashes = array("q")
        """The hash of each element's id, 0 for none."""
        self.kinds: dict[type, _Kind] = {}
        self.roots: list[EClass] = []
        self.prefix = ""
        """The prefix of XMI's own names."""
        self._package = package
        self._plans = Plans()
        self._prefixes: dict[str, str] = {}
        self._numbers: dict[int, int] | None = None
        try:
            self._read()
        except (expat.ExpatError, ValueError):
            raise NotPlainError from None

    def _read(self) -> None:
        parser = expat.ParserCreate(namespace_separator="}")
        parser.StartNamespaceDeclHandler = self._declare
        parser.StartDoctypeDeclHandler = _not_plain
        note, identify, kind_of = self.positions.append, self.hashes.append, self._kind_of
        stack: list[_Kind | None] = []
        push, pop = stack.append, stack.pop
        kind: _Kind | None = None
        xsi_type, xmi_type, xmi_id = f"{XSI}}}type", "", ""
        number = 0

        def start(tag: str, attributes: dict[str, str]) -> None:
            nonlocal kind, number, xmi_type, xmi_id
            if kind is not None and tag in kind.children and xsi_type not in attributes and xmi_type not in attributes:
                found = kind.children[tag]
            else:  # a root, a type that the file names, or a tag that is met for the first time
                if not stack:
                    space = self._prefixes.get(self.prefix, "")
                    xmi_type, xmi_id = f"{space}}}type", f"{space}}}id"
                found = kind_of(kind, tag, attributes.get(xsi_type) or attributes.get(xmi_type), len(stack))
            push(kind)
            kind = found
            if found is None:  # the element around all roots, or a text
                return
            if "href" in attributes:
                raise NotPlainError
            note(parser.CurrentByteIndex)
            found.members.append(number)
            number += 1
            identity = attributes.get(xmi_id)
            for name in found.ids:
                identity = identity or attributes.get(name)
            identify(hash(identity) if identity else 0)

        def end(_: str) -> None:
            nonlocal kind
            kind = pop()

        parser.StartElementHandler, parser.EndElementHandler = start, end
        parser.Parse(self.data, True)
        if not number:
            raise NotPlainError

    def _declare(self, prefix: str | None, uri: str | None) -> None:
        if self._prefixes.setdefault(prefix or "", uri or "") != (uri or ""):
            raise NotPlainError
        if XMI_NAMESPACES.fullmatch(uri or ""):
            if self.prefix not in ("", prefix):
                raise NotPlainError
            self.prefix = prefix or ""

    def _kind_of(self, owner: _Kind | None, tag: str, named: str | None, depth: int) -> _Kind | None:
        """The class of an element; None for the element around all roots, and for a text."""
        if owner is None:
            return self._root(tag, depth)
        key = tag if named is None else f"{tag} {named}"
        if key not in owner.children:
            owner.children[key] = self._child(owner, tag, named)
        return owner.children[key]

    def _root(self, tag: str, depth: int) -> _Kind | None:
        uri, _, name = tag.rpartition("}")
        if XMI_NAMESPACES.fullmatch(uri) and name == "XMI" and not depth:
            return None
        eclass = class_in(self._package(uri), name)
        if depth > 1 or eclass is None or uri == ECORE_URI:
            raise NotPlainError
        self.roots.append(eclass)
        return self._known(eclass)

    def _child(self, owner: _Kind, tag: str, named: str | None) -> _Kind | None:
        entry = owner.plan.entries.get(tag)
        if entry is None or entry.is_id:
            raise NotPlainError
        if entry.kind in (REFERENCE, VALUE, VALUES):
            owner.texts.add(tag)
            return None
        if entry.kind not in (CHILD, CHILDREN):
            raise NotPlainError
        eclass: EClass | None = entry.declared
        if named is not None:
            prefix, _, name = named.rpartition(":")
            eclass = class_in(self._package(self._prefixes.get(prefix, "")), name)
        if eclass is None or not entry.takes(self._plans.of(eclass).cls):
            raise NotPlainError
        return self._known(eclass)

    def _known(self, eclass: EClass) -> _Kind:
        plan = self._plans.of(eclass)
        if plan.cls not in self.kinds:
            self.kinds[plan.cls] = _Kind(plan)
        return self.kinds[plan.cls]

    def kinds_of(self, cls: type, exact: bool) -> list[_Kind]:
        """What there is of a class, and of its subclasses unless exact."""
        return [kind for own, kind in self.kinds.items() if own is cls or (not exact and issubclass(own, cls))]

    def class_at(self, number: int) -> type:
        """The class of an element."""
        for cls, kind in self.kinds.items():
            place = bisect_left(kind.members, number)
            if place < len(kind.members) and kind.members[place] == number:
                return cls
        raise IndexError(number)

    def number_of(self, identity: str) -> int | None:
        """The number of the element whose id probably is this, or None.

        Raises:
            NotPlainError: two elements have one id.
        """
        if self._numbers is None:
            self._numbers = {own: number for number, own in enumerate(self.hashes) if own}
            if len(self._numbers) + self.hashes.count(0) != len(self.hashes):
                raise NotPlainError
        return self._numbers.get(hash(identity))

    def attributes(self, number: int) -> dict[str, str]:
        """The attributes of an element, by their names in the file."""
        begin = self.positions[number]
        end = self.positions[number + 1] if number + 1 < len(self.positions) else len(self.data)
        found: list[dict[str, str]] = []
        parser = expat.ParserCreate("UTF-8")
        parser.StartElementHandler = lambda _, attributes: found.append(attributes)
        with suppress(expat.ExpatError):  # at what follows the start tag
            parser.Parse(self.data[begin:end], True)
        return found[0]


class LazyModel(EmfModel):
    """A model of which only the skeleton is read; it turns into an `EmfModel` when it is loaded.

    Args:
        skeleton: of its file.
        metamodel: of its elements.
        name: what `M!Book` calls it.
        path: the file.
        load: loads the model, given what makes the elements of a class.
        open_files: the files of a session.
    """

    def __init__(
        self,
        skeleton: Skeleton,
        metamodel: Metamodel,
        name: str,
        path: Path,
        load: Callable[[Callable[[type], Any]], EmfModel],
        open_files: OpenFiles | None,
    ) -> None:
        TypedModel.__init__(self, metamodel, name, path)
        self._skeleton = skeleton
        self._load = load
        self._open_files = open_files
        self._place = Path(os.path.realpath(path))
        self._given: list[Any] = [None] * len(skeleton.positions)
        self._classes: dict[type, type] = {}
        self._last: tuple[int, dict[str, str]] = (-1, {})
        self._reads = 0
        if open_files is not None:
            open_files.add(self._place, self, {})

    def __getattr__(self, name: str) -> Any:
        if name == "findings" or (name[:1] == "_" and name[:2] != "__"):  # what a loaded model has
            self.load_whole()
            return getattr(self, name)
        return super().__getattr__(name)

    def _extent(self, cls: type, exact: bool) -> list[DynamicEObject]:
        kinds = self._skeleton.kinds_of(cls, exact)
        given = self._given
        with collector_at_rest(makes_models=True):
            for kind in kinds:
                unread = self._unread(kind.plan.cls)
                for number in kind.members:
                    if given[number] is None:
                        given[number] = _new(unread, number)
        numbers = kinds[0].members if len(kinds) == 1 else sorted(number for kind in kinds for number in kind.members)
        return [given[number] for number in numbers]

    def _classes_met(self) -> set[type]:
        return set(self._skeleton.kinds)

    def all_contents(self) -> Iterator[DynamicEObject]:
        """All elements in containment pre-order."""
        return iter(self._extent(object, False))

    def element(self, identity: str) -> DynamicEObject | None:
        """The element of an id or fragment, or None; a fragment loads the file."""
        with suppress(NotPlainError):
            number = self._skeleton.number_of(identity)
            if number is None and identity[:1] != "/":
                return None
            if number is not None and own_id(found := self._element(number)) == identity:
                return found
        if type(self) is LazyModel:
            self.load_whole()
        return EmfModel.element(self, identity)

    def _element(self, number: int) -> DynamicEObject:
        if self._given[number] is None:
            self._given[number] = _new(self._unread(self._skeleton.class_at(number)), number)
        return self._given[number]  # type: ignore[no-any-return]

    def _unread(self, cls: type) -> type:
        """The class of elements that are not read yet; as a subclass, its elements are accepted wherever those of `cls` are."""
        if cls not in self._classes:
            quiet: Any = type("Quiet", (cls.__class__,), {"__init__": type.__init__})  # it becomes part of no metamodel
            members = {"__getattribute__": _read, "__setattr__": _change, "__delattr__": _remove, "_unread": (self, cls)}
            self._classes[cls] = quiet(cls.__name__, (cls,), members)
        return self._classes[cls]

    def value_at(self, number: int, cls: type, name: str) -> Any:
        """The value of an attribute, as far as the start tag of the element tells it."""
        kind = self._skeleton.kinds[cls]
        feature: Any = getattr(cls, name, None)
        entry = kind.plan.entries.get(str(feature.name)) if isinstance(feature, EAttribute) else None
        if name != IDENTITY and (entry is None or entry.kind != VALUE or not entry.bare or feature.name in kind.texts):
            return _UNKNOWN
        if self._last[0] != number:
            self._reads += 1
            if self._reads > _READ_ALONE:
                return _UNKNOWN
            self._last = number, self._skeleton.attributes(number)
        if entry is None:
            return self._last[1].get(f"{self._skeleton.prefix}:id")
        text = self._last[1].get(entry.feature.name)
        try:
            return entry.feature.get_default_value() if text is None else entry.convert(text) if entry.convert else text
        except ValueError:
            return _UNKNOWN  # the load says what is wrong

    def load_whole(self) -> None:
        """Load the file; from now on this is an ordinary model.

        Raises:
            ModelError: the file has changed since it was opened, or contradicts its metamodel.
            SourceError: it cannot be read any more.
        """
        given, files = iter(self._given), self._open_files

        def made(cls: type) -> Any:
            element = next(given, None)
            if element is None:
                return object.__new__(cls)
            slots = object.__getattribute__(element, "__dict__")
            slots.clear()
            object.__setattr__(element, "__class__", cls)
            return element

        latest = files.forget(self._place) if files is not None else None  # of a file that is read, the last model counts
        try:
            loaded = self._load(made)
        except RobosmiError:
            self._unread_again()
            raise
        finally:
            if files is not None and latest is not None:
                files.add(self._place, latest, {})
        loaded.name, loaded.path = self.name, self.path
        self.__dict__.clear()
        self.__dict__.update(loaded.__dict__)
        self.__class__ = EmfModel  # type: ignore[assignment]

    def _unread_again(self) -> None:
        """Take back what a load that failed made of the elements."""
        for number, element in enumerate(self._given):
            if element is not None and type(element) in self._classes:
                element.__dict__.clear()
                element.__dict__["_number"] = number
                object.__setattr__(element, "__class__", self._classes[type(element)])


def _new(unread: type, number: int) -> Any:
    made: Any = object.__new__(unread)
    object.__setattr__(made, "_number", number)
    return made


def _read(element: Any, name: str) -> Any:
    """An attribute of an element that is not read yet."""
    model, cls = type(element)._unread
    if name == "__class__":
        return cls
    if name == "eClass":
        return object.__getattribute__(element, name)
    value = model.value_at(object.__getattribute__(element, "_number"), cls, name)
    if value is not _UNKNOWN:
        return value
    model.load_whole()
    return getattr(element, name)


def _change(element: Any, name: str, value: object) -> None:
    type(element)._unread[0].load_whole()
    setattr(element, name, value)


def _remove(element: Any, name: str) -> None:
    type(element)._unread[0].load_whole()
    delattr(element, name)


def open_lazily(
    path: Path, name: str | None, metamodel: Packages | str | Path | None, strict: bool, open_files: OpenFiles | None
) -> EmfModel:
    """Open an XMI file by its skeleton, or load it if it is not plain.

    Args:
        path, name, metamodel, strict, open_files: as for `EmfModel.load`.

    Raises:
        SourceError, ModelError: as `EmfModel.load`.
    """
    if metamodel is None:
        metamodel = open_files.packages() if open_files is not None else built_in()
    used = Metamodel.load(metamodel) if isinstance(metamodel, (str, Path)) else Metamodel.of(metamodel)

    def package(uri: str) -> Any:
        found = used.get(uri)
        return built_in().get(uri) if found is None and uri.startswith(OWN_NAMESPACES) else found

    def load(made: Callable[[type], Any]) -> EmfModel:
        if hashlib.sha256(inputs.read_bytes(path, inputs.MODEL)).digest() != digest:
            raise ModelError("the model has changed since it was opened", location=Location(str(path)), fix="open it again")
        return EmfModel.read(path, used, name, strict=strict, open_files=open_files, made=made)

    try:
        if is_json(path) or is_yaml(path):
            raise NotPlainError
        skeleton = Skeleton(data := inputs.read_bytes(path, inputs.MODEL), package)
    except (NotPlainError, OSError):
        return EmfModel.read(path, used, name, strict=strict, open_files=open_files)
    digest = hashlib.sha256(data).digest()
    del data
    packages = [*dict.fromkeys(outermost(root.ePackage) for root in skeleton.roots), *used.epackages]
    return LazyModel(skeleton, Metamodel(dict.fromkeys(packages)), name or path.stem, path, load, open_files)
