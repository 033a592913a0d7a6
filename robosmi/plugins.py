"""The registry: how the framework finds content (readers, transformations, generators, chains) without knowing its name.

Content is offered by ONE kind of entry point, group `robosmi.transformations`, whose value is a function that fills a
`Registry`. The built-in content registers the same way; a source checkout that is not installed is found by the module
name alone. Nothing is imported before it is asked for: a registry holds `module:attribute` texts.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from robosmi.errors import InternalError, UsageError, did_you_mean

ENTRY_POINTS = "robosmi.transformations"
BUILT_IN = "robosmi.transformations:registry"


@dataclass
class Registry:
    """Named content by kind, and folders of data.

    Kinds are `program reader`, `drawing reader`, `driver`, `generator`, `chain`, `constraints`, `query`, `ranker` and
    `model migration`.

    Attributes:
        entries: kind -> name -> `module:attribute`.
        data: folders that hold data as a project's folder `.robosmi` does (`platform_repo/...`): a plug-in's boards, targets,
            parts, and its `defaults.toml`, which says which endings its readers take.
    """

    entries: dict[str, dict[str, str]] = field(default_factory=dict)
    data: list[str] = field(default_factory=list)

    def add(self, kind: str, name: str, target: str) -> None:
        """Offer content. A later entry of the same kind and name replaces an earlier one.

        Args:
            kind: what it is.
            name: how it is asked for.
            target: `module:attribute`, imported only when asked for.
        """
        self.entries.setdefault(kind, {})[name] = target

    def add_data(self, folder: str) -> None:
        """Offer a folder of data; it counts before the built-in data and behind the user's own.

        Args:
            folder: absolute path; what is not there is passed over.
        """
        self.data.append(folder)

    def names(self, kind: str) -> list[str]:
        """The names of a kind, sorted."""
        return sorted(self.entries.get(kind, {}))

    def get(self, kind: str, name: str) -> Any:
        """Import and return the content of that kind and name.

        Raises:
            UsageError: nothing of that name is registered.
            InternalError: it is registered but cannot be imported.
        """
        known = self.entries.get(kind, {})
        if name not in known:
            raise UsageError(
                f"no {kind} is called '{name}'{did_you_mean(name, known)}",
                fix=f"use one of: {', '.join(sorted(known)) or 'none is installed'}",
            )
        return load(known[name])


def load(target: str) -> Any:
    """The object behind `module:attribute`.

    Raises:
        InternalError: the module or the attribute does not exist.
    """
    module, _, attribute = target.partition(":")
    try:
        return getattr(importlib.import_module(module), attribute)
    except (ImportError, AttributeError) as error:
        raise InternalError(f"'{target}' is registered but cannot be loaded: {error}") from error


@cache
def registry() -> Registry:
    """The registry of this process, filled from the entry points at the first call."""
    from importlib.metadata import entry_points

    result = Registry()
    targets = {BUILT_IN: None} | {point.value: None for point in entry_points(group=ENTRY_POINTS)}
    for target in targets:
        fill: Callable[[Registry], None] = load(target)
        fill(result)
    return result


def content(kind: str, name: str) -> Any:
    """Shorthand for `registry().get(kind, name)`."""
    return registry().get(kind, name)
