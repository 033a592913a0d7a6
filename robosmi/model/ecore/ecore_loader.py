"""Read .ecore files into descriptions: several files, references between them resolved, all problems with their lines.

`load_metamodels` is the way in. pyecore's own resource stops at the first surprise and has no lines, so the files are read
here; XML is `ecore_xml`'s part, finding files `ecore_files`', and the values are those of `ecore_description`. What Python can
say of a metamodel is not asked here.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from copy import copy
from functools import partial
from pathlib import Path
from typing import Any

from msgspec import Struct

from robosmi.diagnostics import Location
from robosmi.errors import ModelError, RobosmiError
from robosmi.model.ecore.ecore_description import (
    E_JAVA_OBJECT,
    EOBJECT,
    Class,
    Classifier,
    DataType,
    DescribedElement,
    Enumeration,
    Feature,
    Literal,
    Operation,
    Package,
    Typed,
    TypeParameter,
    known,
)
from robosmi.model.ecore.ecore_files import EcoreFile, EcoreFiles, no_package
from robosmi.model.ecore.ecore_xml import EcoreNode

GENMODEL = "http://www.eclipse.org/emf/2002/GenModel"
_KIND_PREFIX = re.compile(r"[\w.-]*:E\w+\s+")
_SHOWN = 20


class Problem(Struct, frozen=True):
    """Why a metamodel cannot be used.

    Attributes:
        kind: a short name of the reason, the same for all problems of its sort.
        location: where.
        message: what is wrong.
        fix: what to do.
    """

    kind: str
    location: Location
    message: str
    fix: str


class MetamodelError(ModelError):
    """A metamodel that cannot be used; `problems` has all reasons."""

    def __init__(self, problems: list[Problem]) -> None:
        first = problems[0]
        self.problems = problems
        if len(problems) == 1:
            super().__init__(first.message, location=first.location, fix=first.fix)
            return
        shown = "\n".join(f"  {p.location}: {p.message}" for p in problems[:_SHOWN])
        more = f"\n  ... and {len(problems) - _SHOWN} more" if len(problems) > _SHOWN else ""
        super().__init__(
            f"the metamodel cannot be used, for {len(problems)} reasons:\n{shown}{more}", location=first.location, fix=first.fix
        )


def load_metamodels(
    paths: Iterable[Path],
    *,
    classifiers: bool = False,
    texts: Mapping[Path, bytes] | None = None,
    stand_ins: bool = False,
) -> list[Package]:
    """Read .ecore files and every file that they refer to.

    Args:
        paths: the files.
        classifiers: whether these files may have roots that are classifiers; they are in a package without a name.
        texts: the bytes of files that are not as they are stored, by absolute path.
        stand_ins: whether something stands for what lies in files that are not there (`Package.missing`), as EMF's proxies do.

    Returns:
        The outermost packages: those of the given files first, in the order given, then those of the files referred to.

    Raises:
        SourceError: a file cannot be read, is no XML or holds no EPackage.
        MetamodelError: references lead nowhere, names or types are missing; all problems together.
    """
    return MetamodelReader(texts, stand_ins).read(paths, classifiers=classifiers)


class MetamodelReader:
    """Reads .ecore files one after the other; files read before are reused, so that later files can refer to them.

    Args:
        texts, stand_ins: as for `load_metamodels`.
    """

    def __init__(self, texts: Mapping[Path, bytes] | None = None, stand_ins: bool = False) -> None:
        self.files = EcoreFiles(texts)
        self._stands_in = stand_ins
        self._stand_ins: dict[tuple[Path, str], DescribedElement] = {}
        self.problems: list[Problem] = []
        self.refused: dict[str, ModelError] = {}
        self._packages: dict[EcoreFile, list[Package]] = {}
        self._referred_to: dict[EcoreFile, dict[EcoreFile, None]] = {}
        self._built: dict[EcoreNode, DescribedElement] = {}
        self._pending: list[tuple[EcoreFile, EcoreNode, str, type, Callable[[Any], None]]] = []
        self._typed: list[Typed] = []

    def read(self, paths: Iterable[Path], *, classifiers: bool = False, named: Iterable[Path] | None = None) -> list[Package]:
        """The outermost packages of .ecore files and of those that they refer to; see `load_metamodels`.

        Args:
            paths, classifiers: as there.
            named: the files that the user names one by one, all if None; the others were found in folders. Of files with one
                namespace the named one counts. If none is named, all are left out, with all files that need them, and
                `refused` says for each of their namespaces why.

        Raises:
            SourceError, MetamodelError: as there; nothing of these files is kept.
        """
        before = [(owner, name, copy(value)) for owner in (self, self.files) for name, value in vars(owner).items()
                  if isinstance(value, (dict, list))]  # fmt: skip
        try:
            given = list(paths)
            chosen = set(given if named is None else named)
            preferred = {self.files.load(path) for path in given if path in chosen}  # first: their namespaces lead to them
            wanted = list(dict.fromkeys(self.files.load(path) for path in given))
            for file in wanted:
                if not classifiers and any(node.tag != "EPackage" for node in file.roots):
                    raise no_package(file.path, file.roots)
            shared = self._shared_namespaces(wanted, preferred)
            for file in wanted:
                self.build(file)
            self.link()
            if self.problems:
                raise MetamodelError(self.problems)
            wanted = self._without_shared(wanted, preferred, shared)
        except RobosmiError:
            for owner, name, value in before:
                setattr(owner, name, value)
            raise
        reached = dict.fromkeys(wanted)
        for file in (pending := list(reached)):
            for other in self._referred_to.get(file, ()):
                if other not in reached:
                    reached[other] = None
                    pending.append(other)
        return [package for file in reached for package in self._packages[file]]

    def _shared_namespaces(self, files: Iterable[EcoreFile], named: set[EcoreFile]) -> dict[str, list[EcoreFile]]:
        """The namespaces that several files have; that two named files share one is a problem: a model could be of either."""
        owners: dict[str, list[EcoreFile]] = {}
        for file in files:
            for uri in file.by_uri:
                owners.setdefault(uri, []).append(file)
        for uri, those in owners.items():
            first, *others = [file for file in those if file in named] or those[:1]
            for file in others:
                message = f"'{first.path}' has the namespace '{uri}', too"
                place = self._place(file, file.by_uri[uri])
                self.problem("two metamodels have one namespace", place, message, "give one of them")
        return {uri: those for uri, those in owners.items() if len(those) > 1}

    def _without_shared(
        self, files: list[EcoreFile], named: set[EcoreFile], shared: dict[str, list[EcoreFile]]
    ) -> list[EcoreFile]:
        """The files whose namespaces, and those of all that they need, lead to one file each."""
        reasons: dict[EcoreFile, ModelError] = {}
        for uri, those in shared.items():
            first, second = those[:2]
            more = f" and {len(those) - 2} more" if len(those) > 2 else ""
            reason = ModelError(
                f"the namespace '{uri}' is that of '{first.path}', '{second.path}'{more}",
                location=self._place(second, second.by_uri[uri]),
                fix="give the file that you mean besides its folder: a further --metamodel, metamodel=[FOLDER, FILE] in Python",
            )
            for file in those:
                if file not in named:
                    reasons.setdefault(file, reason)
        users: dict[EcoreFile, list[EcoreFile]] = {}
        for file, others in self._referred_to.items():
            for other in others:
                users.setdefault(other, []).append(file)
        for file in (pending := list(reasons)):
            for user in users.get(file, ()):
                if user not in reasons:
                    reasons[user] = reasons[file]
                    pending.append(user)
        left = [file for file in files if file not in reasons]
        known = {uri for file in left for uri in file.by_uri}
        self.refused = {uri: reason for file, reason in reasons.items() for uri in file.by_uri if uri not in known}
        return left

    def problem(self, kind: str, location: Location, message: str, fix: str) -> None:
        """Note a problem."""
        self.problems.append(Problem(kind, location, message, fix))

    def build(self, file: EcoreFile) -> None:
        """Make the descriptions of a file's elements; references come later."""
        if file in self._packages:
            return
        outermost = self._packages[file] = []
        packages = [node for node in file.roots if node.tag == "EPackage"]
        if len(packages) < len(file.roots):
            first = next(node for node in file.roots if node.tag != "EPackage")
            around = Package(
                "", self._place(file, first), "", "", "", file.path, None,
                node=EcoreNode("EPackage", "", first.line, None), find=partial(self._referred, file),
            )  # fmt: skip
            around.classifiers += [self._classifier(file, node, around) for node in file.roots if node.tag != "EPackage"]
            outermost.append(around)
        stack: list[tuple[EcoreNode, Package | None]] = [(node, None) for node in reversed(packages)]
        while stack:
            node, parent = stack.pop()
            package = Package(
                self._name(file, node, "package"), self._place(file, node), _documentation(node), node.get("nsURI"),
                node.get("nsPrefix", node.get("name")), file.path, parent, node=node, find=partial(self._referred, file),
            )  # fmt: skip
            self._built[node] = package
            (outermost if parent is None else parent.subpackages).append(package)
            for child in node.tagged("eClassifiers"):
                package.classifiers.append(self._classifier(file, child, package))
            stack.extend((child, package) for child in reversed(node.tagged("eSubpackages")))

    def _place(self, file: EcoreFile, node: EcoreNode) -> Location:
        return Location(str(file.path), node.line)

    def _name(self, file: EcoreFile, node: EcoreNode, what: str) -> str:
        name = node.get("name")
        if not name:
            place = self._place(file, node)
            self.problem("a name is missing", place, f"a {what} has no name", "give it a name in the .ecore file")
        return name

    def _classifier(self, file: EcoreFile, node: EcoreNode, package: Package) -> Classifier:
        place, text = self._place(file, node), _documentation(node)
        made: Classifier
        if node.kind == "EEnum":
            made = Enumeration(self._name(file, node, "enumeration"), place, text, package)
            for index, child in enumerate(node.tagged("eLiterals")):
                name = self._name(file, child, "literal")
                made.literals.append(
                    Literal(
                        name, self._place(file, child), _documentation(child),
                        self._integer(file, child, "value", 0), child.get("literal", name),
                    )
                )  # fmt: skip
                made.literals[index].node = child
                self._built[child] = made.literals[index]
        elif node.kind == "EDataType":
            java = node.get("instanceClassName") or node.get("instanceTypeName")
            made = DataType(self._name(file, node, "data type"), place, text, package, instance_class=java)
            self._type_parameters(file, node, made.type_parameters)
        else:
            made = self._class(file, node, package)
        made.node = node
        self._built[node] = made
        return made

    def _class(self, file: EcoreFile, node: EcoreNode, package: Package) -> Class:
        cls = Class(self._name(file, node, "class"), self._place(file, node), _documentation(node), package)
        cls.interface = node.flag("interface")
        cls.abstract = node.flag("abstract")
        self._type_parameters(file, node, cls.type_parameters)

        def add(base: Class) -> None:
            if base not in cls.supertypes:
                cls.supertypes.append(base)

        for text, line in _references(node, "eSuperTypes"):
            self._pending.append((file, line, text, Class, add))
        for generic in node.tagged("eGenericSuperTypes"):
            self._pending.append((file, generic, generic.get("eClassifier"), Class, add))
        for child in node.tagged("eStructuralFeatures"):
            feature = Feature(self._name(file, child, "feature"), self._place(file, child), _documentation(child), owner=cls)
            feature.node = child
            feature.is_reference = child.kind == "EReference"
            feature.containment = child.flag("containment")
            feature.is_id = child.flag("iD")
            feature.default = child.attributes.get("defaultValueLiteral")
            feature.changeable = child.flag("changeable", True)
            for flag in ("volatile", "transient", "derived", "unsettable"):
                setattr(feature, flag, child.flag(flag))
            self._typing(file, child, feature)
            for text, line in _references(child, "eOpposite"):
                self._pending.append((file, line, text, Feature, _setter(feature, "opposite")))
            cls.features.append(feature)
            self._built[child] = feature
        for child in node.tagged("eOperations"):
            operation = Operation(
                self._name(file, child, "operation"), self._place(file, child), _documentation(child), owner=cls
            )
            operation.node = child
            self._type_parameters(file, child, operation.type_parameters)
            self._typing(file, child, operation)
            for inner in child.tagged("eParameters"):
                parameter = Typed(inner.get("name"), self._place(file, inner), _documentation(inner), node=inner)
                self._typing(file, inner, parameter)
                operation.parameters.append(parameter)
            cls.operations.append(operation)
            self._built[child] = operation
        return cls

    def _type_parameters(self, file: EcoreFile, node: EcoreNode, found: list[TypeParameter]) -> None:
        for child in node.tagged("eTypeParameters"):
            parameter = TypeParameter(child.get("name"), self._place(file, child), node=child)
            for bound in child.tagged("eBounds"):
                self._generic(file, bound, parameter.bounds.append)
            found.append(parameter)
            self._built[child] = parameter

    def _typing(self, file: EcoreFile, node: EcoreNode, typed: Typed) -> None:
        typed.lower = self._integer(file, node, "lowerBound", 0)
        typed.upper = self._integer(file, node, "upperBound", 1)
        typed.ordered, typed.unique = node.flag("ordered", True), node.flag("unique", True)
        self._typed.append(typed)
        for text, line in _references(node, "eType"):
            self._pending.append((file, line, text, Classifier, _setter(typed, "type")))
        for generic in node.tagged("eGenericType"):
            self._generic(file, generic, _setter(typed, "type"))

    def _generic(self, file: EcoreFile, node: EcoreNode, put: Callable[[Any], None]) -> None:
        """A use of a generic type: its classifier or its type parameter; the arguments are left out."""
        for name, kind in (("eClassifier", Classifier), ("eTypeParameter", TypeParameter)):
            for text, line in _references(node, name):
                self._pending.append((file, line, text, kind, put))

    def _integer(self, file: EcoreFile, node: EcoreNode, name: str, default: int) -> int:
        text = node.attributes.get(name)
        try:
            return default if text is None else int(text)
        except ValueError:
            place = self._place(file, node)
            self.problem("a value is no number", place, f'{name}="{text}" is no whole number', "correct it in the .ecore file")
            return default

    def link(self) -> None:
        """Resolve all references, reading further files as they are met, and put bounds where type parameters are."""
        for file, node, text, kind, put in self._pending:  # which grows as further files are met
            found = self._target(file, node, text, kind)
            if found is None:
                continue
            if not isinstance(found, (Classifier, TypeParameter) if kind is Classifier else kind):
                place, wanted = (
                    self._place(file, node),
                    "class" if kind is Class else "feature" if kind is Feature else "classifier",
                )
                self.problem(
                    "a reference leads to the wrong kind",
                    place,
                    f"'{text}' is no {wanted}",
                    "correct the reference in the .ecore file",
                )
                continue
            put(found)
        for typed in self._typed:
            typed.type = _erased(typed)
        self._pending, self._typed = [], []

    def _referred(self, file: EcoreFile, node: EcoreNode, name: str) -> list[DescribedElement]:
        """What a node refers to by a feature that models do not need; nothing is a problem here, and no further file is read."""
        found: list[DescribedElement] = []
        for text, _ in _references(node, name):
            for word in [text] if name in ("eClassifier", "eTypeParameter") else text.split():
                uri, _, fragment = word.rpartition("#")
                where: Any = (file, None) if not uri else self.files.find(uri, file)
                if where is None and (stand_in := self._stand_ins.get((file.path.parent, word))) is not None:
                    found.append(stand_in)
                    continue
                if isinstance(where, Package):
                    target: DescribedElement | None = known(where, fragment.rpartition("/")[2])
                else:
                    there = where and where[0].find(fragment, where[1])
                    target = self._built.get(there) if there else None
                if target is not None:
                    found.append(target)
        return found

    def _target(self, file: EcoreFile, node: EcoreNode, text: str, kind: type) -> DescribedElement | None:
        uri, mark, fragment = text.rpartition("#")
        if not mark:
            uri, fragment = "", text
        place = self._place(file, node)
        where: Any = (file, None) if not uri else self.files.find(uri, file)
        if where is None and self._stands_in and kind is not TypeParameter:
            return self._stand_in(file, node, text, kind)
        if where is None:
            self.problem(
                "a file referred to is missing", place, f"'{text}' leads to a file that is not there",
                "put the .ecore file beside this one, give it as a further file, or leave this file out",
            )  # fmt: skip
            return None
        if isinstance(where, Package):
            found: DescribedElement | None = known(where, fragment.rpartition("/")[2])
        else:
            target, start = where
            if target is not file:
                self._referred_to.setdefault(file, {})[target] = None
            self.build(target)
            node_found = target.find(fragment, start)
            found = self._built.get(node_found) if node_found is not None else None
        if found is None:
            self.problem(
                "a reference leads to nothing", place, f"'{text}' leads to nothing", "correct the reference in the .ecore file"
            )
        return found

    def _stand_in(self, file: EcoreFile, node: EcoreNode, text: str, kind: type) -> DescribedElement:
        """What stands for an element of a file that is not there; the same for all references to it from one folder."""
        key = (file.path.parent, text)
        if key not in self._stand_ins:
            package = Package(text.partition("#")[0], self._place(file, node), source=file.path, missing=True)
            if kind is Feature:
                owner = Class(text.rpartition("/")[0], package.location, package=package, abstract=True)
                self._stand_ins[key] = Feature(text, package.location, owner=owner, is_reference=True)
            else:
                made = _kind_said(node, text) if kind is Classifier else Class
                self._stand_ins[key] = made(text, package.location, package=package)
        return self._stand_ins[key]


def _kind_said(node: EcoreNode, text: str) -> type[Class | DataType | Enumeration]:
    """The kind of classifier that a reference says it leads to; without that, the one that can stand there."""
    said = next((value for value in node.attributes.values() if value.endswith(f" {text}")), node.kind)
    if "EEnum" in said:
        return Enumeration
    return DataType if "EDataType" in said or node.kind == "EAttribute" else Class


def _setter(element: DescribedElement, name: str) -> Callable[[Any], None]:
    return lambda found: setattr(element, name, found)


def _references(node: EcoreNode, name: str) -> list[tuple[str, EcoreNode]]:
    """The references of a feature of Ecore: as an attribute (`#//A other.ecore#//B`) or as elements with `href`."""
    text = _KIND_PREFIX.sub("", node.get(name)).strip()
    if name == "eSuperTypes":
        words: list[str] = []
        for word in text.split():
            if "#" in word or "/" in word or not words or not words[-1].rpartition("#")[1]:
                words.append(word)
            else:
                words[-1] += f" {word}"  # a name with a space in it
        found = [(word, node) for word in words]
    else:
        found = [(text, node)] if text else []
    return found + [(child.get("href"), child) for child in node.tagged(name) if child.get("href")]


def _documentation(node: EcoreNode) -> str:
    """The GenModel documentation of a node, or an empty text."""
    for annotation in node.tagged("eAnnotations"):
        if annotation.get("source") == GENMODEL:
            for detail in annotation.tagged("details"):
                if detail.get("key") == "documentation":
                    return detail.get("value") or "".join(child.text for child in detail.tagged("value"))
    return ""


def _erased(typed: Typed) -> Classifier | None:
    """The type, or the first bound where it is a type parameter (Ecore's own rule of erasure)."""
    kind, seen = typed.type, set[TypeParameter]()
    while isinstance(kind, TypeParameter):
        if kind in seen or not kind.bounds:
            return EOBJECT if isinstance(typed, Feature) and typed.is_reference else E_JAVA_OBJECT
        seen.add(kind)
        kind = kind.bounds[0]
    return kind
