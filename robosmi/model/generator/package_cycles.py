"""Finds import cycles among the packages of a run, which decide what packages have to wait for.

A module imports its supertypes and data types while its classes are defined, and the types of its references afterwards. In a
cycle of packages, references are linked when the last package is defined; in a cycle of inheritance, supertypes are set then,
too. `strict_package` implements the waiting.
"""

from __future__ import annotations

from collections.abc import Sequence

from robosmi.model.ecore.ecore_description import Class, Package, is_known


class Cycles:
    """The import cycles among the packages.

    Args:
        packages: the outermost packages of the run.
    """

    def __init__(self, packages: Sequence[Package]) -> None:
        everything = [package for root in packages for package in root.walk()]
        early = {package: _inherits(package) | _parent(package) for package in everything}
        defining = {package: early[package] | _data_types(package) for package in everything}
        linking = {package: defining[package] | _references(package) | set(package.subpackages) for package in everything}
        self._inheritance = _components(everything, early)
        self._definition = _components(everything, defining)
        self._all = _components(everything, linking)

    def waits_for(self, package: Package) -> list[Package]:
        """The other packages of a package's cycle, sorted by name; empty if it is in no cycle."""
        return sorted((p for p in self._all[package] if p is not package), key=lambda p: p.path)

    def supertype_is_late(self, package: Package, of: Package) -> bool:
        """Whether a supertype in another package may be undefined when the package's classes are defined."""
        return of is not package and of in self._inheritance[package]

    def data_type_is_late(self, package: Package, of: Package) -> bool:
        """Whether a data type in another package may be undefined when the package's classes are defined."""
        return of is not package and of in self._definition[package]


def _classes(package: Package) -> list[Class]:
    return [c for c in package.classifiers if isinstance(c, Class)]


def _inherits(package: Package) -> set[Package]:
    return {b.package for c in _classes(package) for b in c.supertypes if not is_known(b)}


def _parent(package: Package) -> set[Package]:
    return set() if package.parent is None else {package.parent}


def _types(package: Package, references: bool) -> set[Package]:
    return {
        f.classifier.package
        for c in _classes(package)
        for f in c.features
        if f.is_reference == references and f.classifier is not None and not is_known(f.classifier)
    }


def _data_types(package: Package) -> set[Package]:
    return _types(package, False)


def _references(package: Package) -> set[Package]:
    operations = {
        t.classifier.package
        for c in _classes(package)
        for o in c.operations
        for t in (o, *o.parameters)
        if t.classifier is not None and not is_known(t.classifier)
    }
    return _types(package, True) | operations


def _components(nodes: list[Package], edges: dict[Package, set[Package]]) -> dict[Package, list[Package]]:
    """Strongly connected components (Tarjan, with a stack of its own): node -> its component."""
    index: dict[Package, int] = {}
    low: dict[Package, int] = {}
    path: list[Package] = []
    found: dict[Package, list[Package]] = {}
    for start in nodes:
        if start in index:
            continue
        stack = [(start, iter(sorted(edges[start], key=lambda p: p.path)))]
        index[start] = low[start] = len(index)
        path.append(start)
        while stack:
            node, targets = stack[-1]
            for target in targets:
                if target not in index:
                    index[target] = low[target] = len(index)
                    path.append(target)
                    stack.append((target, iter(sorted(edges[target], key=lambda p: p.path))))
                    break
                if target not in found:
                    low[node] = min(low[node], index[target])
            else:
                stack.pop()
                if stack:
                    low[stack[-1][0]] = min(low[stack[-1][0]], low[node])
                if low[node] == index[node]:
                    component = []
                    while True:
                        component.append(path.pop())
                        if component[-1] is node:
                            break
                    found.update(dict.fromkeys(component, component))
    return found
