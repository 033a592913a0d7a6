"""What the driver of plain XML gives for the features of an element: values of attributes, and lists of elements.

Texts of attributes become the values of the driver's prefixes (`i_x`, `b_x`), and back. The child elements, and those that an
element refers to, are lists whose changes are changes of the document. They are read anew at each access, so a loop over one may
change it. Which elements may be put where is the document's business (`plain_xml`).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import Any, NoReturn, Self, SupportsIndex, TypeVar

from robosmi.errors import ModelError
from robosmi.model.elements.driver import FeatureValue, ModelElement
from robosmi.model.elements.ecore import EEnumLiteral, EObject
from robosmi.model.elements.strict import FeatureValueError

E = TypeVar("E")

_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


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


def typed(kind: str, value: str | None, element: ModelElement, name: str) -> bool | int | float | str | None:
    """The value of an attribute as that prefix asks for it: text, Boolean, whole number or number."""
    if kind in "as":
        return value or ""
    if kind == "b":
        return (value or "").strip().lower() == "true"
    if value is None:
        return None
    try:
        return int(value) if kind == "i" else float(value)
    except ValueError:
        raise FeatureValueError(
            f"{element!r}.{name}: '{value}' is no {'whole ' if kind == 'i' else ''}number", fix="use a_..."
        ) from None


def written(kind: str, value: FeatureValue, element: ModelElement, name: str) -> str:
    """The text of a value that an attribute is given by that prefix; of another kind, and collections, are refused."""
    if isinstance(value, (ModelElement, EObject, Iterable)) and not isinstance(value, (str, EEnumLiteral)):
        raise FeatureValueError(f"{element!r}.{name} does not take {value!r}: it takes one value", fix="write its text: str(...)")
    wanted = {"b": (bool,), "i": (int,), "f": (int, float), "d": (int, float)}.get(kind)
    if wanted is not None and (not isinstance(value, wanted) or (kind != "b" and isinstance(value, bool))):
        raise FeatureValueError(f"{element!r}.{name} does not take {value!r}", fix="give a value of its kind, or use a_...")
    return str(value).lower() if isinstance(value, bool) else str(value)


def checked(text: str, element: ModelElement, name: str) -> str:
    """The text itself, if XML can hold it."""
    if bad := _FORBIDDEN.search(text):
        raise FeatureValueError(f"{element!r}.{name}: XML cannot hold U+{ord(bad.group()):04X}", fix="remove the character")
    return text
