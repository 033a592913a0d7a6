"""The metamodels that a model may use: packages by namespace URI.

A `Metamodels` is an ordinary value; there is no global registry that two loads could share by accident. The built-in ones are
imported on demand, since that takes longer than the rest of this package. `metamodel` makes packages from .ecore files.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterable, Iterator, Mapping
from functools import cache

from robosmi.errors import ModelError
from robosmi.model.elements.ecore import Package
from robosmi.model.elements.pyecore_internals import is_element

BUILT_IN = ("ccode", "hardware", "platform", "trace", "migration")
"""The names of the built-in metamodels, each a package of `robosmi.metamodels`."""
OWN_NAMESPACES = "http://robosmi.org/"
"""How the namespaces of all built-in metamodels begin."""


class Metamodels:
    """Packages by namespace URI, sub-packages included.

    Args:
        packages: Python packages as `robosmi metamodels generate` makes them, or pyecore EPackages.
    """

    def __init__(self, packages: Iterable[Package] = ()) -> None:
        self.packages: list[Package] = list(packages)
        self._packages = {package.nsURI: package for package in _with_subpackages(self.packages)}
        self.refused: Mapping[str, ModelError] = {}
        """Namespaces that lead to several files, or need one that does -> why they are not known here."""

    def get(self, uri: str | None) -> Package | None:
        """The package of that namespace, or None; its `getEClassifier(name)` gives classes and EClasses.

        Raises:
            ModelError: the namespace is one of `refused`.
        """
        if uri is not None and uri in self.refused:
            raise self.refused[uri]
        return self._packages.get(uri)

    def uris(self) -> list[str]:
        """The namespaces known here, sorted."""
        return sorted(uri for uri in self._packages if uri)


def _with_subpackages(packages: Iterable[Package]) -> Iterator[Package]:
    """The packages and all below them, outer ones first."""
    pending = list(reversed(list(packages)))
    while pending:
        package = pending.pop()
        yield package
        epackage = package if is_element(package) else getattr(package, "eClass", package)
        pending.extend(reversed(list(epackage.eSubpackages)))


@cache
def built_in() -> Metamodels:
    """The five metamodels of this package."""
    return Metamodels(importlib.import_module(f"robosmi.metamodels.{name}") for name in BUILT_IN)
