"""A parsed program as a model for rules; its extents are those that the views have collected already."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from robosmi.metamodels import ccode
from robosmi.model import Model
from robosmi.model.elements.driver import Node
from robosmi.model.elements.fragments import fragment_of, resolve
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents, root_of
from robosmi.transformations.queries.code import CodeView


class ProgramModel(Model):
    """A model over a code model that must not change any more.

    Args:
        views: a view of each of its units.
    """

    read_only = True

    def __init__(self, views: Sequence[CodeView]) -> None:
        super().__init__("code")
        self.program = views[0].program
        self._views = views
        self._kinds: dict[type, list[Element]] = {}
        self._outside = [element for external in self.program.externals for element in all_contents(external)]

    def types(self) -> Iterator[tuple[str, Any]]:
        """All types of the metamodel."""
        return ((f"ccode::{kind.name}", kind) for kind in ccode.eClass.eClassifiers)

    def all_contents(self) -> Iterator[Element]:
        """The program, its units with all their contents, and the externals that it uses."""
        yield self.program
        for view in self._views:
            yield from view.elements
        yield from self._outside

    def all_of_kind(self, kind: Any) -> Sequence[Element]:
        """The elements of a type and its subtypes."""
        wanted: type[Element] = self._class_of(kind)
        if wanted not in self._kinds:
            inside = [x for view in self._views for x in view.of_kind(wanted)]
            self._kinds[wanted] = [x for x in (self.program, *inside, *self._outside) if isinstance(x, wanted)]
        return self._kinds[wanted]

    def all_of_type(self, kind: Any) -> Sequence[Element]:
        """The elements of exactly a type."""
        wanted = self._class_of(kind)
        return [x for x in self.all_of_kind(wanted) if x.__class__ is wanted]

    def element(self, identity: str) -> Any:
        """The element with this fragment, or None."""
        return resolve(identity, [self.program])

    def id_of(self, element: Node) -> str:
        """The fragment of an element."""
        return fragment_of(element, [self.program])

    def owns(self, element: Any) -> bool:
        """Whether the element is in the program."""
        return root_of(element) is self.program
