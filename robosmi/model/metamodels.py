"""Which metamodels a model may use: generated packages by namespace URI.

A `Metamodels` is a value of its own; there is no global registry that two loads could share by accident. The built-in
ones are imported when first asked for, since that costs more than all else of this room.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterable
from functools import cache
from typing import Any

BUILT_IN = ("ccode", "hardware", "platform", "trace", "migration")
"""The names of the built-in metamodels, each a package of `robosmi.metamodels`."""


class Metamodels:
    """Generated packages by namespace URI.

    Args:
        packages: Python packages as `robosmi metamodels generate` makes them.
    """

    def __init__(self, packages: Iterable[Any] = ()) -> None:
        self._packages = {package.nsURI: package for package in packages}

    def get(self, uri: str) -> Any:
        """The package of that namespace, or None."""
        return self._packages.get(uri)

    def uris(self) -> list[str]:
        """The namespaces known here, sorted."""
        return sorted(self._packages)


@cache
def built_in() -> Metamodels:
    """The five metamodels of this package."""
    return Metamodels(importlib.import_module(f"robosmi.metamodels.{name}") for name in BUILT_IN)
