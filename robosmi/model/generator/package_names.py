"""The Python names of everything in a run of the generator: packages, classifiers, features, operations, literals.

`PackageNames` is for the whole run, `Scope` for one generated module: it chooses local names for imports, so that a class
called `Element` or a feature called `str` hides nothing. The escape rule itself is in `python_names`.
"""

from __future__ import annotations

import builtins
from collections.abc import Collection, Sequence

from robosmi.model.ecore.ecore_description import Class, Classifier, DescribedElement, Enumeration, Package
from robosmi.model.ecore.linearise import topological
from robosmi.model.elements.python_names import LITERAL, MEMBER, MODULE, python_name


class PackageNames:
    """The Python names of all packages of a run.

    Args:
        packages: the outermost packages.
    """

    def __init__(self, packages: Sequence[Package]) -> None:
        self._names: dict[DescribedElement, str] = {}
        self._give(packages, ())
        for package in (p for root in packages for p in root.walk()):
            self._give([*package.classifiers, *package.subpackages], MODULE)
            for classifier in package.classifiers:
                if isinstance(classifier, Enumeration):
                    self._give(classifier.literals, LITERAL)
        classes = [c for root in packages for p in root.walk() for c in p.classifiers if isinstance(c, Class)]
        for cls in topological(classes)[0]:
            self._members(cls)

    def __getitem__(self, element: DescribedElement) -> str:
        return self._names.get(element, element.name)

    def module(self, package: Package) -> list[str]:
        """The names of the modules from the output folder on."""
        names: list[str] = []
        current: Package | None = package
        while current is not None:
            names.append(self[current])
            current = current.parent
        return names[::-1]

    def _give(self, elements: Sequence[DescribedElement], reserved: Collection[str], taken: Collection[str] = ()) -> None:
        """Assign a name to each element; those that can keep their own are handled first."""
        used = set(taken)
        for keep in (True, False):
            for element in elements:
                name = python_name(element.name, reserved, used)
                if element not in self._names and (name == element.name or not keep):
                    self._names[element] = name
                    used.add(name)

    def _members(self, cls: Class) -> None:
        """Name features, then operations; a redefined member has the name of the inherited one."""
        features = {f.name: self[f] for base in cls.ancestors() for f in base.features}
        operations = {o.name: self[o] for base in cls.ancestors() for o in base.operations}
        self._names |= {f: features[f.name] for f in cls.features if f.name in features}
        self._give(cls.features, MEMBER, features.values())
        taken = {*features.values(), *(self[f] for f in cls.features)}
        for operation in cls.operations:
            inherited = operations.get(operation.name)
            free = inherited is not None and inherited not in taken
            self._names[operation] = inherited if inherited and free else python_name(operation.name, MEMBER, taken)


class Scope:
    """The names of one generated module.

    Args:
        package: the package that becomes the module.
        names: the names of the run.
    """

    def __init__(self, package: Package, names: PackageNames) -> None:
        self.package = package
        self.names = names
        self._members = {names[m] for c in package.classifiers for m in _inner(c)}
        self._taken = {names[e] for e in (*package.classifiers, *package.subpackages)} | set(MODULE) | self._members
        self._local: dict[tuple[str, str], str] = {}
        self.aliases: dict[Classifier, str] = {}
        self._used: dict[str, dict[str, set[tuple[str, str]]]] = {"run": {}, "typing": {}, "link": {}}

    def symbol(self, module: str, name: str, when: str = "run") -> str:
        """The local name of something that the module imports.

        Args:
            module: where it comes from.
            name: its name there.
            when: "run" (at the top), "typing" (for type checkers alone), "link" (when all classes are defined).
        """
        local = self._local.get((module, name))
        if local is None:
            local = name
            while local in self._taken or local in self._local.values():
                local = _another(local)
            self._local[module, name] = local
        if (module, name) != ("builtins", local):
            self._used[when].setdefault(module, set()).add((name, local))
        return local

    def classifier(self, classifier: Classifier, when: str = "run", inside: bool = True) -> str:
        """The local name of a classifier of this run.

        Args:
            classifier: one of this package or of another.
            when: see `symbol`. What links is outside of all classes.
            inside: whether it is used in the body of a class, where a member of that name would hide it.
        """
        own = self.names[classifier]
        if classifier.package is not self.package:
            return self.symbol(self.relative(classifier.package), own, when)
        if not inside or when == "link" or (own not in self._members and not hasattr(builtins, own)):
            return own  # mypy takes a name of Python's own for that, where the class comes later in the module
        if classifier not in self.aliases:
            alias = _another(own)
            while alias in self._taken or alias in self._local.values():
                alias = _another(alias)
            self.aliases[classifier] = alias
            self._taken.add(alias)
        return self.aliases[classifier]

    def relative(self, package: Package) -> str:
        """The relative module of another package of the run."""
        here, there = self.names.module(self.package), self.names.module(package)
        common = 0
        while common < min(len(here), len(there)) and here[common] == there[common]:
            common += 1
        return "." * (len(here) - common + 1) + ".".join(there[common:])

    def used(self, when: str) -> dict[str, set[tuple[str, str]]]:
        """Module -> (name, local name) of what is imported at that time."""
        return self._used[when]


def _another(name: str) -> str:
    """A name to try instead; none begins with two underscores, which Python would take for private ones of a class."""
    return f"{name}_" if name.startswith("_") else f"_{name}"


def _inner(classifier: Classifier) -> Sequence[DescribedElement]:
    if isinstance(classifier, Class):
        return [*classifier.features, *classifier.operations]
    return classifier.literals if isinstance(classifier, Enumeration) else []
