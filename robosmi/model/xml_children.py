"""The child elements of an XML element, and those it refers to, as lists whose changes are changes of the document.

They are read anew at each access, so a loop over one may change it. Which elements may be put where is the document's business
(`plain_xml`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, NoReturn, Self, SupportsIndex, TypeVar

from robosmi.errors import ModelError

E = TypeVar("E")


def _changes(method: Callable[..., Any]) -> Callable[..., Any]:
    """A method of lists that also changes the document: what is new is put in, what is gone is taken out."""

    def change(self: LiveList[Any], *arguments: Any, **named: Any) -> Any:
        wanted = list(self)
        result = method(wanted, *arguments, **named)
        self._become(wanted)
        return result

    change.__name__, change.__doc__ = method.__name__, method.__doc__
    return change


class LiveList(list[E]):
    """A list of an element; `append`, `insert`, `remove`, `extend` and the other changes of a list are changes of the document.

    Args:
        items: they, in order.
        owner: the element that has them.
    """

    __slots__ = ("_owner",)

    def __init__(self, items: Iterable[E], owner: object) -> None:
        super().__init__(items)
        self._owner = owner

    def _become(self, wanted: list[E]) -> None:
        """Make the document's what a list has, in its order."""
        raise NotImplementedError

    append = _changes(list.append)
    extend = _changes(list.extend)
    insert = _changes(list.insert)
    remove = _changes(list.remove)
    pop = _changes(list.pop)
    clear = _changes(list.clear)
    reverse = _changes(list.reverse)
    sort = _changes(list.sort)
    __setitem__ = _changes(list.__setitem__)
    __delitem__ = _changes(list.__delitem__)

    def __iadd__(self, more: Iterable[E]) -> Self:  # type: ignore[misc, override]
        self.extend(more)
        return self

    def belongs_to(self, element: object) -> bool:
        """Whether these are that element's."""
        return self._owner is element


class ChildList(LiveList[E]):
    """Child elements.

    Args:
        children: they, in order.
        parent: the element that has them.
        put: makes an element a child of it, before another child or as the last (None).
        take: takes a child out.
    """

    __slots__ = ("_put", "_take")

    def __init__(
        self, children: Iterable[E], parent: object, put: Callable[[E, E | None], None], take: Callable[[E], None]
    ) -> None:
        super().__init__(children, parent)
        self._put = put
        self._take = take

    def _become(self, wanted: list[E]) -> None:
        """Make the document's elements those of a list, in its order.

        Raises:
            ModelError: one is in it twice, or cannot be put here.
        """
        if len({id(each) for each in wanted}) < len(wanted):
            raise ModelError("an element cannot be in one place twice", fix="make a new element for the second place")
        own = {id(each) for each in self}
        kept = {id(each) for each in wanted}
        staying = [each for each in self if id(each) in kept]
        moved = [each for each in wanted if id(each) in own] != staying
        following: E | None = None
        for child in reversed(wanted):  # from the last on, so that each is put before one that is in its place already
            if moved or id(child) not in own:
                self._put(child, following)
            following = child
        for child in self:
            if id(child) not in kept:
                self._take(child)
        list.__setitem__(self, slice(None), wanted)

    def __imul__(self, times: SupportsIndex) -> NoReturn:
        raise ModelError("an element cannot be in one place twice", fix="make new elements")


class ReferredList(LiveList[E]):
    """The elements that an attribute refers to.

    Args:
        targets: they, in order.
        element: the element with the attribute.
        refer: writes what the attribute refers to.
    """

    __slots__ = ("_refer",)

    def __init__(self, targets: Iterable[E], element: object, refer: Callable[[list[E]], None]) -> None:
        super().__init__(targets, element)
        self._refer = refer

    def _become(self, wanted: list[E]) -> None:
        """Write the identities of the elements of a list.

        Raises:
            ModelError: one has none, or is of another tag.
        """
        self._refer(wanted)
        list.__setitem__(self, slice(None), wanted)
