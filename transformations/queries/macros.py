"""The macros of a program by name, and the names in their bodies; macros are expanded by the parser."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.transformations.queries.tokens import names_in


class Macros(Mapping[str, Sequence[ccode.Macro]]):
    """Name -> the macros that are defined by it, in the order of the units.

    Args:
        units: of the program.
    """

    def __init__(self, units: Iterable[ccode.SourceUnit]) -> None:
        self._found: dict[str, list[ccode.Macro]] = {}
        for unit in units:
            for macro in unit.macros:
                self._found.setdefault(str(macro.name), []).append(macro)

    def __getitem__(self, name: str) -> Sequence[ccode.Macro]:
        return self._found[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._found)

    def __len__(self) -> int:
        return len(self._found)

    def with_bodies(self, names: Iterable[str]) -> frozenset[str]:
        """Names, and all that is named in the bodies of the macros that they are, and in those of the macros there."""
        found: set[str] = set()
        pending = list(names)
        while pending:
            name = pending.pop()
            if name not in found:
                found.add(name)
                pending += [n for macro in self._found.get(name, ()) for n in names_in(str(macro.body or ""))]
        return frozenset(found)
