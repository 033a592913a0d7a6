"""Several models side by side, of any technology: types by qualified names (`M!Book`, `library::Book`), owners, literals.

A repository only refers to its models; it is made where it is needed and costs nothing.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from robosmi.errors import ModelError, did_you_mean
from robosmi.model.elements.driver import Model, TypeHandle, unknown_type

if TYPE_CHECKING:
    from robosmi.model.elements.driver import Item
    from robosmi.model.elements.ecore import EEnumLiteral


class Repository:
    """Models by name.

    Args:
        models: in the order in which unqualified type names are looked up.

    `r.M.Book.all`, `r["M!Book"].all`, `r["Book"]` for the first model that has a Book.
    """

    def __init__(self, models: Iterable[Model]) -> None:
        self.models = list(models)

    def model(self, name: str) -> Model:
        """The model of that name.

        Raises:
            ModelError: there is none.
        """
        for model in self.models:
            if model.name == name:
                return model
        known = [m.name for m in self.models]
        raise ModelError(f"there is no model '{name}'{did_you_mean(name, known)}", fix="name it in `with Run(...)`")

    def having(self, name: str) -> list[Model]:
        """The models that have the type `Book`, `library::Book`; of `M!Book` at most that model."""
        wanted, _, plain = name.rpartition("!")
        return [m for m in self.models if (not wanted or m.name == wanted) and m.find_type(plain) is not None]

    def type_names(self) -> list[str]:
        """The simple names of all types."""
        return [name for model in self.models for name in model.type_names()]

    def __getitem__(self, name: str) -> TypeHandle:
        """A type of the first model that has it: `Book`, `library::Book`, `M!Book`.

        Raises:
            UnknownTypeError: no model has it.
        """
        having = self.having(name)
        if not having:
            raise unknown_type(name, self.type_names())
        return having[0][name.rpartition("!")[2]]

    def literal(self, name: str) -> EEnumLiteral:
        """The enumeration literal `Genre#fiction` or `M!Genre#fiction`.

        Raises:
            UnknownTypeError: no model has it.
        """
        wanted, _, plain = name.rpartition("!")
        refused: list[ModelError] = []
        for model in self.models:
            if not wanted or model.name == wanted:
                try:
                    return model.literal(plain)
                except ModelError as error:
                    refused.append(error)
        raise refused[0] if len(refused) == 1 else unknown_type(name, [])

    def owning(self, element: Item) -> Model | None:
        """The model that holds the element, or None."""
        return next((m for m in self.models if m.owns(element)), None)

    def __getattr__(self, name: str) -> Model:
        if name[:1] == "_":
            raise AttributeError(name)
        return self.model(name)

    def __iter__(self) -> Iterator[Model]:
        return iter(self.models)

    def __len__(self) -> int:
        return len(self.models)

    def __repr__(self) -> str:
        return f"<Repository of {', '.join(m.name for m in self.models) or 'nothing'}>"
