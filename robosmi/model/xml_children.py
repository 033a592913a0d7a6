"""The child elements of an XML element as a list whose changes are changes of the document.

`children` and `c_x` are read anew at each access, so a loop over one may change it. Which elements may be put where is the
document's business (`plain_xml`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, NoReturn, Self, SupportsIndex, TypeVar

from robosmi.errors import ModelError

E = TypeVar("E")


def _changes(method: Callable[..., Any]) -> Callable[..., Any]:
    """A method of lists that also changes the document: what is new is put in, what is gone is taken out."""

    def change(self: ChildList[Any], *arguments: Any, **named: Any) -> Any:
        wanted = list(self)
        result = method(wanted, *arguments, **named)
        self._become(wanted)
        return result

    change.__name__, change.__doc__ = method.__name__, method.__doc__
    return change


class ChildList(list[E]):
    """Child elements; `append`, `insert`, `remove`, `extend` and the other changes of a list are changes of the document.

    Args:
        children: they, in order.
        parent: the element that has them.
        put: makes an element a child of it, before another child or as the last (None).
        take: takes a child out.
    """

    __slots__ = ("_parent", "_put", "_take")

    def __init__(
        self, children: Iterable[E], parent: object, put: Callable[[E, E | None], None], take: Callable[[E], None]
    ) -> None:
        super().__init__(children)
        self._parent = parent
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
        super().__setitem__(slice(None), wanted)

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

    def __imul__(self, times: SupportsIndex) -> NoReturn:
        raise ModelError("an element cannot be in one place twice", fix="make new elements")

    def belongs_to(self, parent: object) -> bool:
        """Whether these are the children of that element."""
        return self._parent is parent
