"""EMF models as `Model`: root elements, the packages of their classes, extents in EMF's pre-order that are never out of date.

An extent is built at the first question and thrown away when pyecore reports a change of containment anywhere in the model; so
asking again costs nothing and no answer is old. Roots that belong to no resource get one of ours (`home`), through which
pyecore's own notifications reach the model; nothing is shared between two models. XMI itself is read and written by `xmi_reader`
and `xmi_writer`, ids are `fragments`'.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Never, cast

from robosmi import inputs
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import ModelError
from robosmi.model.ecore.metamodel import Metamodel, Packages, TypedModel
from robosmi.model.elements.compact_slots import collector_at_rest
from robosmi.model.elements.driver import FeatureValue, Kind, ModelElement, Node, refuse_unknown_attribute
from robosmi.model.elements.ecore import DynamicEObject, EObject, EPackage, Scalar
from robosmi.model.elements.element_factory import as_data, new as new, refuse_unnamed, unlink
from robosmi.model.elements.fragments import fragment_of, own_id, resolve
from robosmi.model.elements.home import FileWatch, Home, Watch, home_of
from robosmi.model.elements.pyecore_internals import container_of, own_resource_of
from robosmi.model.elements.structure import contents, resource_of, root_of, walk

if TYPE_CHECKING:
    from robosmi.model.ecore.xmi_document import Document
    from robosmi.model.xmi.open_files import OpenFiles
    from robosmi.model.xmi.xmi_layout import Root


FOREIGN, ELSEWHERE, LEFT_OUT = "RS610", "RS611", "RS612"


class EmfModel(TypedModel):
    """Elements of EMF: a strict handle on root elements and all they contain.

    Args:
        roots: its root element, or several.
        metamodel: a `Metamodel`, EPackages, generated packages, or .ecore files; the packages of the roots' classes if None.
        name: what `M!Book` calls it.
        path: the file it was read from.

    Elements are what they were before, pyecore EObjects; a root may be in one model only, as in EMF.
    """

    _met: set[type] | None = None
    """The classes of its elements, once they were asked for."""

    def __init__(
        self,
        roots: EObject | Iterable[EObject] = (),
        metamodel: Packages | str | Path | None = None,
        name: str = "M",
        path: Path | None = None,
    ) -> None:
        given = _elements(roots)
        if isinstance(metamodel, (str, Path)):
            metamodel = Metamodel.load(metamodel)
        if metamodel is None:
            metamodel = dict.fromkeys(outermost(root.eClass.ePackage) for root in given)
        super().__init__(Metamodel.of(metamodel), name, path)
        self.findings: list[Finding] = []
        self._digest = ""
        self._watch = Watch()
        self._edits = FileWatch()
        """The files with changes since they were read or saved; only of a model that other files were read with."""
        self._home = Home(self._watch, path)
        self._roots: dict[int, DynamicEObject] = {}
        self._all: list[DynamicEObject] = []
        self._extents: dict[tuple[type, bool], list[DynamicEObject]] = {}
        self._ids: dict[str, DynamicEObject] | None = None
        self._read_with: dict[Path, list[DynamicEObject]] = {}
        self._open_files: OpenFiles | None = None
        self._schema_locations: list[tuple[str, str]] = []
        self._file_has_more = False
        for root in given:
            self.add(root)

    @classmethod
    def load(
        cls,
        path: str | Path,
        metamodel: Packages | str | Path | None = None,
        name: str | None = None,
        *,
        strict: bool = False,
        lenient: bool = True,
        open_files: OpenFiles | None = None,
    ) -> EmfModel:
        """Read an XMI file, or one in JSON (`.json`) or YAML (`.yaml`, `.yml`).

        What it refers to in other files is read with it, and belongs to models of their own.

        Args:
            path: the file; an .ecore file is a model whose types are Ecore's (`EClass`, `EReference`).
            metamodel: a `Metamodel`, packages, or .ecore files; the built-in metamodels if None, which are known beside others.
            name: what `M!Book` calls it; the file's name without its ending if None.
            strict: whether an element that lacks a required value or has too many, or a reference leading nowhere, is an error.
                If not they are `findings` of the model, for `check` and constraints, and proxies stand for what is not there.
            lenient: False is the same as `strict`.
            open_files: the files of a session, whose elements are referred to as they are; the model becomes one of them.

        Raises:
            SourceError: a file cannot be read as XMI.
            ModelError: it contradicts its metamodel.
        """
        return cls.read(path, metamodel, name, strict=strict or not lenient, open_files=open_files)

    @classmethod
    def read(
        cls,
        path: str | Path,
        metamodel: Packages | str | Path | None,
        name: str | None,
        *,
        strict: bool,
        open_files: OpenFiles | None,
        made: Callable[[type], object] = object.__new__,
    ) -> EmfModel:
        """The same; `made` makes the elements of a class, in the order of the file."""
        from robosmi.model.ecore.metamodels import built_in
        from robosmi.model.versions import migrated
        from robosmi.model.xmi.xmi_reader import UnreadableModelError, read_documents

        file = Path(path)
        if isinstance(metamodel, (str, Path)):
            used = Metamodel.load(metamodel)
        else:
            known = open_files.packages() if open_files is not None else built_in()
            used = Metamodel.of(known if metamodel is None else metamodel)
        place = Path(os.path.realpath(file))
        document = open_files.read_before(place, used) if open_files is not None else None
        roots = document.roots if document is not None else None
        documents: dict[Path, Document] = {}
        opened = None
        if roots is None:
            opened = open_files.documents(place) if open_files is not None else None
            try:
                documents = read_documents(file, used, strict=strict, opened=opened, made=made)
            except UnreadableModelError as error:
                roots = [migrated(file, used, error)]
        if roots is None and not documents:  # the file is a metamodel
            packages = Metamodel.packages_of(file)
            for element in (one for package in packages for one in walk(package)):
                as_data(element)
            model = cls(_without_unnamed(packages), Metamodel.ecore(), name or file.stem, file)
            model._digest = hashlib.sha256(inputs.read_bytes(file, inputs.MODEL)).hexdigest()
            if open_files is not None:
                open_files.add(place, model, documents)
            return model
        if roots is None:
            document = next(iter(documents.values()))
            roots = document.roots
        for root in roots:  # a part of an element in a file that it refers to is a root of its own file all the same
            if container_of(root) is not None and home_of(root) is None:
                Home(None, place).add(root)
        packages = [*dict.fromkeys(outermost(root.eClass.ePackage) for root in roots), *used.epackages]
        model = cls(roots, Metamodel(dict.fromkeys(packages)), name or file.stem, file)
        model._open_files = open_files
        model._read_with = {other: document.roots for other, document in documents.items() if other != place}
        for other, others in model._read_with.items():
            home = Home(None, other)
            home.shared_ids = documents[other].shared_ids
            for root in others:
                if home_of(root) is None:
                    home.add(root)
            home.listeners.append(model._edits)
        if model._read_with:
            model._home.listeners.append(model._edits)
        if document is not None:
            model.findings = document.findings
            model._digest = document.digest
            model._home.shared_ids = document.shared_ids
            model._schema_locations = document.schema_locations
            model._file_has_more = document.has_more
        if open_files is not None:
            open_files.add(place, model, documents, opened)
        return model

    def save(
        self, path: str | Path | None = None, others: Mapping[str, Root] | None = None, *, keep_layout: bool = False
    ) -> None:
        """Write the model as XMI, or as JSON or YAML by the name of the file (`.json`, `.yaml`, `.yml`), whole or not at all.

        References into other files lead there again, seen from the new place: into files that were read with the model, and into
        all models that have a path. So does xsi:schemaLocation, where the file had one. Other files are not written, even where
        their elements have changed (`Session.save_all`). What did not change keeps its layout, with comments and parts of other
        namespaces; where comments cannot stay, the old file is kept as NAME.orig. Saved elsewhere, a model whose file has
        neither is as EMF writes it.

        Args:
            path: the file; the one it was read from if None.
            others: models in the same folder that it refers to, file name -> root or roots; they are not written.
            keep_layout: whether the layout of the file it was read from is kept in another file in any case.

        Raises:
            ModelError: there is no path, or a reference leads to an element of a model without one, or of none.
            SourceError: the file cannot be written.
        """
        from robosmi.files.files import write_atomic
        from robosmi.model.xmi.saved_places import back_up_comments

        target = self._target(path)
        text = self.to_bytes(target, others, keep_layout=keep_layout)
        self._tell_what_stays(target)
        if self.path is not None and target == self.path:
            back_up_comments(target, text)
        write_atomic(target, text)
        if self.path is None:
            self.path = target
        if self._digest and os.path.realpath(target) == os.path.realpath(self.path):
            self._digest = hashlib.sha256(text).hexdigest()

    def others_are_saved(self) -> None:
        """Note that the files that were read with this one have been written as they are now."""
        self._edits.files.clear()

    def _tell_what_stays(self, target: Path) -> None:
        """Add findings about what a save does not write: edits of other files' elements, and parts that are not in the model."""
        from robosmi.model.xmi.text_forms import is_json, is_yaml

        self.findings[:] = [each for each in self.findings if each.rule not in (ELSEWHERE, LEFT_OUT)]
        where = Location(str(target))
        if edited := sorted(path.name for path in self._edits.files & self._read_with.keys()):
            said = f"edits of files that were read with '{target.name}' are not saved: {', '.join(edited)}"
            self.findings.append(Finding(ELSEWHERE, Severity.warning, said, where, fix="save all files: Session.save_all()"))
        apart = next((each for each in self.findings if each.rule == FOREIGN), None)
        forms = [is_json(place) or is_yaml(place) for place in (self.path or target, target)]
        if apart is not None and forms[0] != forms[1]:
            said = f"'{target.name}' lacks what is not in the model: {apart.message}"
            fix = "save in the form of the file that was read, which keeps it"
            self.findings.append(Finding(LEFT_OUT, Severity.warning, said, where, fix=fix))

    def to_bytes(
        self, path: str | Path | None = None, others: Mapping[str, Root] | None = None, *, keep_layout: bool = False
    ) -> bytes:
        """The model as it would be saved.

        Raises:
            ModelError: as for `save`.
        """
        from robosmi.model.xmi.saved_places import in_its_layout, text_of

        target = self._target(path)
        read = self._read_with | (self._open_files.places() if self._open_files is not None else {})
        text = text_of(target, self.roots, read, self.path, self._schema_locations, others or {})
        if self.path is None or not self._digest:
            return text
        return in_its_layout(text, self.path, self._digest, self.packages, target, keep_layout, self._file_has_more)

    def __setattr__(self, name: str, value: object) -> None:
        refuse_unknown_attribute(self, name)
        super().__setattr__(name, value)
        if name == "path" and "_home" in self.__dict__:
            self._home.place = self.path

    def touched(self) -> bool:
        """Whether an element of it was changed since this was asked last; of a new model, yes."""
        before, self._watch.touched = self._watch.touched, False
        return before

    @property
    def read_with(self) -> dict[Path, list[DynamicEObject]]:
        """The files that were read with it, as it refers to them -> their root elements."""
        return dict(self._read_with)

    @property
    def packages(self) -> list[EPackage]:
        """The outermost EPackages."""
        return self.metamodel.epackages

    # Extents

    @property
    def roots(self) -> list[DynamicEObject]:
        """The root elements, in order."""
        self._check_roots()
        return list(self._roots.values())

    def _check_roots(self) -> None:
        """Forget roots that were put into a container, and follow those that were put into another resource."""
        home, watch = self._home, self._watch
        for key, root in list(self._roots.items()):
            resource = own_resource_of(root)
            contained = root.eContainer() is not None
            if resource is home and not contained:
                continue
            if resource is home:  # a root that another file contains: the outermost element's file receives changes in it
                resource = resource_of(root)
                if resource is None:
                    continue
            if resource is None or (contained and home_of(root) is not home):
                del self._roots[key]
                watch.changed = True
            elif watch not in resource.listeners:
                resource.listeners.append(watch)
                watch.changed = True

    def _everything(self) -> list[DynamicEObject]:
        self._check_roots()
        if self._watch.changed:
            with collector_at_rest():
                self._all = [element for root in self._roots.values() for element in walk(root)]
            self._extents.clear()
            self._ids = None
            if self._met is not None:
                self._met = None
            self._watch.changed = False
        return self._all

    def _classes_met(self) -> set[type]:
        everything = self._everything()
        if self._met is None:
            self._met = {element.__class__ for element in everything}
        return self._met

    def refresh(self) -> None:
        """Forget the extents; only needed after a change that pyecore does not report (`discard` on a feature's collection)."""
        self._watch.changed = True

    def all_contents(self) -> Iterator[DynamicEObject]:
        """All elements in containment pre-order."""
        return iter(list(self._everything()))

    def all_of_kind(self, kind: Kind) -> list[DynamicEObject]:
        """The instances of a type and its subtypes, in pre-order.

        Raises:
            UnknownTypeError: a name that the packages do not have.
        """
        return list(self._extent(self._class_of(kind), False))

    def all_of_type(self, kind: Kind) -> list[DynamicEObject]:
        """The instances of exactly a type, in pre-order.

        Raises:
            UnknownTypeError: a name that the packages do not have.
        """
        return list(self._extent(self._class_of(kind), True))

    def _extent(self, cls: type, exact: bool) -> list[DynamicEObject]:
        everything = self._everything()
        found = self._extents.get((cls, exact))
        if found is None:
            wanted = {cls} if exact else {c for c in {x.__class__ for x in everything} if issubclass(c, cls)}
            found = self._extents[cls, exact] = [x for x in everything if x.__class__ in wanted]
        return found

    # Identity

    def element(self, identity: str) -> DynamicEObject | None:
        """The element of an id or fragment (`//@sections.0/@items.1`), or None.

        Raises:
            ModelError: the fragment names a feature that is none.
        """
        if identity.startswith("/"):
            resolved: DynamicEObject | None = resolve(identity, self.roots)
            return resolved
        everything = self._everything()
        if self._ids is None:
            self._ids = {}
            for x in everything:
                if (own := own_id(x)) is not None:
                    self._ids.setdefault(own, x)
        found = self._ids.get(identity)
        if found is not None and own_id(found) == identity:
            return found
        self._ids = None  # ids are attributes and may have changed since
        return next((x for x in everything if own_id(x) == identity), None)

    def id_of(self, element: Node) -> str:
        """The id or fragment of an element, as EMF writes it."""
        return fragment_of(element, self.roots)

    def owns(self, element: Scalar | ModelElement) -> bool:
        """Whether the element is in this model."""
        if not isinstance(element, EObject):
            return False
        root = root_of(element)
        return id(root) in self._roots and own_resource_of(root) is not None

    # Change

    def add(self, root: EObject) -> None:
        """Make an element that is in no container a root of this model.

        Raises:
            ModelError: it is contained in another element.
        """
        home = home_of(root)
        if home is not None and not home.is_model:  # of a file that was read with another one, and is a model from now on
            home.remove(root)
            self._home.add(root)
        elif isinstance(root.eContainer(), EObject):
            raise ModelError(
                f"{root!r} is contained in {root.eContainer()!r}", fix="add its root, or take it out of its container"
            )
        elif (resource := own_resource_of(root)) is None:
            self._home.add(root)
        elif self._watch not in resource.listeners:
            resource.listeners.append(self._watch)
        self._roots[id(root)] = cast(DynamicEObject, root)
        self._watch.changed = True

    def order_roots(self, roots: Iterable[EObject]) -> None:
        """Put root elements into an order; others stay before them."""
        for root in roots:
            if id(root) in self._roots:
                self._roots[id(root)] = self._roots.pop(id(root))
                if home_of(root) is self._home:
                    self._home.contents.remove(root)
                    self._home.contents.append(root)
        self._watch.changed = True

    def create(self, kind: Kind, /, *values: Never, **features: FeatureValue) -> DynamicEObject:
        """A new element, a root of this model until it is put somewhere (EOL `new T(name = "x")`).

        With the value of a container reference it is put there at once (`M.Node(group=g)`).

        Raises:
            UnknownTypeError: there is no such type.
            ModelError: it is abstract, or has no such feature.
        """
        wanted = self.type_named(kind) if isinstance(kind, str) else kind
        refuse_unnamed(wanted, values)
        made: DynamicEObject = new(wanted, **features)
        if isinstance(made.eContainer(), EObject):
            return made
        current = not self._watch.changed
        self.add(made)
        if current and not contents(made):  # the common case: extents grow by one at the end
            self._watch.changed = False
            self._all.append(made)
            for (cls, exact), extent in self._extents.items():
                if made.__class__ is cls if exact else isinstance(made, cls):
                    extent.append(made)
        return made

    def delete(self, element: Node) -> None:
        """Take an element with all it contains out of this model and out of all references to it (EOL `delete`).

        Raises:
            ModelError: it is not in this model.
        """
        self._check_owned(element)
        current = not self._watch.changed
        doomed = {id(x) for x in unlink(element)}
        self._roots.pop(id(element), None)
        if current:  # nothing else has changed: the extents shrink
            self._watch.changed = False
            self._all = [x for x in self._all if id(x) not in doomed]
            self._extents = {key: [x for x in extent if id(x) not in doomed] for key, extent in self._extents.items()}
            self._ids = None


def _elements(roots: object) -> list[EObject]:
    """The root elements that a model was given.

    Raises:
        ModelError: it was given something else, such as a metamodel or a path.
    """
    given = [roots] if isinstance(roots, (EObject, str)) or not isinstance(roots, Iterable) else list(roots)
    found = [each for each in given if isinstance(each, EObject)]
    for each in given:
        if not isinstance(each, EObject):
            raise ModelError(
                f"a model is made of root elements, not of {each!r}",
                fix="write EmfModel.load(path, metamodel) to read a file, EmfModel((), metamodel) for an empty model",
            )
    return found


def _without_unnamed(packages: Iterable[EPackage]) -> list[EObject]:
    """The root elements of an .ecore file: its packages, and the classifiers that are in none."""
    found: list[EObject] = []
    for package in packages:
        if package.name:
            found.append(package)
            continue
        found += (classifiers := list(package.eClassifiers))
        for classifier in classifiers:
            package.eClassifiers.remove(classifier)
    return found


def outermost(package: EPackage) -> EPackage:
    """The package that a package is in, or itself if it is in none."""
    while package.eSuperPackage is not None:
        package = package.eSuperPackage
    return package
