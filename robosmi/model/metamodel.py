"""`Metamodel`: one or several .ecore files, or existing packages, for looking up types and making elements.

`Metamodel.load("library.ecore")` makes dynamic classes that are as strict as generated ones; loading twice makes two
independent metamodels. `ecore_loader` reads .ecore files, and `metamodels` has the built-in ones.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any, TypeAlias

from robosmi.errors import UsageError
from robosmi.model.driver import Model, TypeHandle, unknown_type
from robosmi.model.ecore import EClass, EClassifier, EEnum, EEnumLiteral, EPackage, Package
from robosmi.model.metamodels import Metamodels
from robosmi.model.pyecore_internals import is_element
from robosmi.model.strict_dynamic import make_strict

Packages: TypeAlias = "Metamodels | Package | Iterable[Package]"
"""What a metamodel may be given as."""


class Metamodel(Metamodels):
    """Packages with their sub-packages.

    Args:
        packages: pyecore EPackages, or Python packages as `robosmi metamodels generate` makes them.

    Classes that were made in pyecore become as strict as loaded ones: what is no feature of theirs is refused.

    `mm.Book` is the Python class of an EClass, `mm.Genre` an EEnum: `mm.Book(name="x", genre=mm.Genre.fiction)`.
    """

    def __init__(self, packages: Iterable[Package] = ()) -> None:
        if isinstance(packages, (str, Path)):
            raise UsageError("a metamodel is made of packages, and this is a path", fix="read the file: Metamodel.load(PATH)")
        if not isinstance(packages, Iterable):
            raise UsageError("a metamodel is made of packages, given as a list", fix="write: Metamodel([PACKAGE])")
        super().__init__(packages)
        for package in self.packages:
            if is_element(package):  # made in pyecore itself, and not a package of generated code
                make_strict(package)
        self.epackages = [p if is_element(p) else _generated(p) for p in self.packages]
        self._index: dict[str, EClassifier] = {}

    @classmethod
    def load(cls, *paths: str | Path) -> Metamodel:
        """Read .ecore files, and those that they refer to.

        Args:
            paths: the files; their packages come first, in this order.

        Raises:
            SourceError: a file cannot be read as XML.
            ModelError: it is no metamodel, or contradicts Ecore; all problems in one message.
        """
        from robosmi.model.ecore_classes import make_packages
        from robosmi.model.ecore_loader import load_metamodels

        return cls(make_packages(load_metamodels([Path(path) for path in paths])))

    @classmethod
    def ecore(cls) -> Metamodel:
        """Ecore itself, the metamodel of models that are metamodels: `EmfModel((), Metamodel.ecore(), "E")` is an empty one."""
        from robosmi.model import ecore

        return cls([ecore.eClass])

    @staticmethod
    def packages_of(path: Path) -> list[EPackage]:
        """The outermost packages of one .ecore file, without those of the files that it refers to.

        Raises:
            SourceError, ModelError: as `load`.
        """
        from robosmi.model.ecore_classes import make_packages
        from robosmi.model.ecore_loader import load_metamodels

        described = load_metamodels([path])
        own = zip(described, make_packages(described), strict=True)
        return [package for one, package in own if one.source == path]

    @classmethod
    def of(cls, packages: Packages) -> Metamodel:
        """Make a metamodel of the argument: a `Metamodel` (returned as it is), `Metamodels`, packages, or one package."""
        if isinstance(packages, Metamodel):
            return packages
        if isinstance(packages, Metamodels):
            return cls(packages.packages)
        return cls([packages] if isinstance(packages, (EPackage, ModuleType)) else packages)

    def classifiers(self) -> Iterator[tuple[str, EClassifier]]:
        """All classifiers of the packages and their sub-packages, with the packages' names before theirs (`library::Book`)."""
        pending = [(str(p.name), p) for p in reversed(self.epackages)]
        while pending:
            path, package = pending.pop()
            for classifier in package.eClassifiers:
                yield f"{path}::{classifier.name}", classifier
            pending.extend((f"{path}::{p.name}", p) for p in reversed(list(package.eSubpackages)))

    def names(self) -> list[str]:
        """The simple names of all classes and enumerations."""
        return [str(c.name) for _, c in self.classifiers() if hasattr(c, "eSuperTypes") or hasattr(c, "eLiterals")]

    def find(self, name: str) -> EClassifier | None:
        """The classifier of that name, simple or with packages, or None; of several with a simple name the first."""
        if name not in self._index:
            self._index = {}
            for path, classifier in self.classifiers():
                parts = path.split("::")
                for start in range(len(parts)):
                    self._index.setdefault("::".join(parts[start:]), classifier)
        return self._index.get(name)

    def literal(self, name: str) -> EEnumLiteral:
        """An enumeration literal, `Genre#fiction` or `library::Genre#fiction`; by its name, else by its literal text.

        Raises:
            UnknownTypeError: there is no such enumeration, or it has no such literal.
        """
        wanted, _, label = name.rpartition("#")
        known = [(path, c) for path, c in self.classifiers() if isinstance(c, EEnum)]
        for path, candidate in known:
            if wanted in ("", candidate.name, path) and (found := find_literal(candidate, label)) is not None:
                return found
        raise unknown_type(name, [f"{c.name}#{literal.name}" for _, c in known for literal in c.eLiterals])

    def __getattr__(self, name: str) -> Any:
        if name[:1] == "_":
            raise AttributeError(name)
        found = self.find(name)
        if found is None:
            raise unknown_type(name, self.names())
        return getattr(found, "python_class", found)

    def __repr__(self) -> str:
        return f"<Metamodel {', '.join(str(p.name) for p in self.epackages)}: {len(self.names())} types>"

    def _repr_html_(self) -> str:
        from robosmi.model.show import classifiers_html  # for notebooks only

        return classifiers_html(self.classifiers())


def _generated(module: Any) -> EPackage:
    """The EPackage of a Python package that was generated."""
    made: EPackage = module.eClass
    return made


class TypedModel(Model):
    """A model whose types are those of a metamodel.

    Args:
        metamodel: of its elements.
        name: what `M!Book` calls it.
        path: the file it was read from.
    """

    def __init__(self, metamodel: Metamodel, name: str = "M", path: Path | None = None) -> None:
        super().__init__(name, path)
        self.metamodel = metamodel

    def types(self) -> Iterator[tuple[str, EClass]]:
        """All EClasses of the packages and their sub-packages."""
        return ((path, kind) for path, kind in self.metamodel.classifiers() if isinstance(kind, EClass))

    def find_type(self, name: str) -> EClass | None:
        """The EClass of that name, simple or with packages, or None."""
        found = self.metamodel.find(name)
        return found if isinstance(found, EClass) else None

    def literal(self, name: str) -> EEnumLiteral:
        """An enumeration literal, `Genre#fiction` or `library::Genre#fiction`; by its name, else by its literal text.

        Raises:
            UnknownTypeError: there is no such enumeration, or it has no such literal.
        """
        return self.metamodel.literal(name)

    def __getitem__(self, name: str) -> TypeHandle:
        """A type or an enumeration to query: `m["library::Book"].all`, `m.Genre.fiction`.

        Raises:
            UnknownTypeError: there is neither.
        """
        model, _, plain = name.rpartition("!")
        found = self.metamodel.find(plain) if model in ("", self.name) else None
        if found is None:
            raise unknown_type(name, self.metamodel.names())
        return TypeHandle(self, found)


def find_literal(enumeration: EEnum, label: str) -> EEnumLiteral | None:
    """A literal of an EEnum by its name, else by its literal text, or None."""
    literals = list(enumeration.eLiterals)
    by_name = next((x for x in literals if x.name == label), None)
    return by_name if by_name is not None else next((x for x in literals if x.literal == label), None)
