"""`Recording`: undoes the changes made to EMF models while it is open.

Before a value is first changed, it is saved together with the container and back links of the elements concerned; undoing
restores all of them in the old order. The cost is proportional to the changes, not to the size of the models. pyecore's
notifications come too late to know the old order, so its changing methods are wrapped while a recording is open, for the thread
that opened it. Models of other technologies have their own `recording()`, or cannot be undone.
"""

from __future__ import annotations

import threading
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from robosmi.model.elements.construct import RECORDINGS
from robosmi.model.elements.ecore import EAbstractSet, ECollection, EList, EObject, EOrderedSet, EValue, Scalar
from robosmi.model.elements.pyecore_internals import (
    ASSIGN,
    contain,
    container_of,
    containing_feature_of,
    fill_silently,
    inverse_references_of,
    is_element,
    own_resource_of,
    set_features_of,
    set_own_resource,
    set_slot,
    value_in,
)
from robosmi.model.emf import EmfModel

if TYPE_CHECKING:
    from robosmi.base.functions import Function


_CHANGING: tuple[tuple[type, tuple[str, ...]], ...] = (
    (EValue, (ASSIGN,)),
    (ECollection, ("remove", "insert", "pop", "clear")),
    (EList, ("append", "extend", "update", "__setitem__", "__delitem__", "__imul__", "sort", "reverse")),
    (EAbstractSet, ("add", "append", "update", "extend")),
    (
        EOrderedSet,
        ("discard", "difference_update", "intersection_update", "symmetric_difference_update", "__delitem__", "__ior__"),
    ),
)
"""pyecore's methods that change a value or a collection."""
_OWN = {ASSIGN, "append", "add", "insert", "remove", "discard"}
"""Those that affect only their argument and the value that it replaces."""


class Recording:
    """Undo for what happens inside `with Recording(models) as recording:`.

    Args:
        models: the models whose roots are kept too; changes of other elements are recorded all the same.
    """

    def __init__(self, models: Iterable[EmfModel] = ()) -> None:
        self._models = [(m, dict(m._roots)) for m in models]
        self._values: dict[int, tuple[Any, Any]] = {}
        self._elements: dict[int, tuple[Any, Any, Any, Any, Any, Any]] = {}
        self._wrapped: list[tuple[type, str, Any]] = []
        self._thread = threading.get_ident()

    def __enter__(self) -> Recording:
        from robosmi.model.elements.strict import Element

        places = [(cls, name) for cls, names in _CHANGING for name in names if hasattr(cls, name)]
        for cls, name in [*places, (Element, "__init__")]:
            self._wrapped.append((cls, name, cls.__dict__.get(name)))
            setattr(cls, name, self._wrapper(getattr(cls, name), name in _OWN))
        RECORDINGS.add(self)
        return self

    def __exit__(self, *_: object) -> None:
        RECORDINGS.discard(self)
        for cls, name, original in reversed(self._wrapped):
            if original is None:
                delattr(cls, name)
            else:
                setattr(cls, name, original)
        self._wrapped.clear()

    def _wrapper(self, original: Function, only_given: bool) -> Function:
        def changing(holder: Any, /, *given: Any, **features: Any) -> Any:
            if threading.get_ident() == self._thread:
                given = tuple(list(x) if isinstance(x, Iterator) else x for x in given)
                self._keep_holder(holder, only_given)
                for value in (*given, *features.values()):
                    for one in (value,) if isinstance(value, EObject) else value if isinstance(value, Iterable) else ():
                        self._keep_element(one)
            return original(holder, *given, **features)

        return changing

    def _keep_holder(self, holder: Any, only_given: bool) -> None:
        if not isinstance(holder, (EValue, ECollection)):
            return  # an element that is being made
        if isinstance(holder, EValue):
            self._values.setdefault(id(holder), (holder, value_in(holder)))
            self._keep_element(value_in(holder))
        else:
            if id(holder) not in self._values:
                self._values[id(holder)] = (holder, list(holder))
            if not only_given:
                for one in list(holder):
                    self._keep_element(one)
        self._keep_element(holder.owner)

    def _keep_element(self, element: Scalar) -> None:
        if not isinstance(element, EObject) or id(element) in self._elements or not is_element(element):
            return
        self._elements[id(element)] = (
            element, container_of(element), containing_feature_of(element), set(inverse_references_of(element)),
            dict(set_features_of(element)), own_resource_of(element),
        )  # fmt: skip
        for holder in list(element.__dict__.values()):  # a constructor may put itself into collections without a word
            if isinstance(holder, ECollection) and id(holder) not in self._values:
                self._values[id(holder)] = (holder, list(holder))

    def undo(self) -> None:
        """Restore the state at the time when the recording was opened; elements made since then are in no model any more."""
        self.__exit__()
        for holder, value in self._values.values():
            if isinstance(holder, EValue):
                set_slot(holder, value)
            else:
                fill_silently(holder, value)
        for element, container, feature, links, isset, resource in self._elements.values():
            contain(element, container, feature)
            set_own_resource(element, resource)
            for kept, before in ((inverse_references_of(element), links), (set_features_of(element), isset)):
                kept.clear()
                kept.update(before)
        for model, roots in self._models:
            for key, root in model._roots.items():
                if key not in roots:
                    set_own_resource(root, None)
            model._roots = roots
            model.refresh()
