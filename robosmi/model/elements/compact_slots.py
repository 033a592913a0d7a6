"""Compact elements: how feature values are stored inside a pyecore EObject, and how to store them without its setters.

pyecore keeps a holder for every value and four containers for every element, most of them empty. Here, attributes store plain
values without a holder until they are changed, holders share their constant fields in their class, and descriptors create the
four containers on demand. Elements remain pyecore EObjects: its own setters, collections and `delete` work on them. Only the
XMI reader and writer, `construct`, `on_demand` and `strict` use this module.
"""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from robosmi.model.elements import datatypes
from robosmi.model.elements.ecore import (
    EAttribute,
    ECollection,
    EDataType,
    EEnum,
    EEnumLiteral,
    EObject,
    EProxy,
    EReference,
    EStructuralFeature,
    EValue,
)
from robosmi.model.elements.feature_errors import REFUSAL, not_computed
from robosmi.model.elements.feature_values import FeatureBag, FeatureCollection, FeatureList, FeatureOrderedSet, kind_of
from robosmi.model.elements.pyecore_internals import (
    CONTAINER,
    CONTAINING_FEATURE,
    FIRST_LISTENERS,
    IDENTITY,
    INVERSE_REFERENCES,
    IS_STATIC,
    RESOURCE,
    SET_FEATURES,
    FeatureSet,
    empty_ordered_set,
    inverse_references_of,
    key_of,
    set_slot,
    target_in,
    value_in,
)
from robosmi.model.elements.structure import refuse_circle, resource_of

if TYPE_CHECKING:
    from robosmi.model.elements.ecore import Value


def _holder_class(name: str, is_ref: bool, is_cont: bool) -> type[EValue]:
    shared = {
        "is_ref": is_ref,
        "is_cont": is_cont,
        "generic_type": None,
        "__doc__": "An EValue with what all share in its class.",
    }
    return type(name, (EValue,), shared)


AttributeValue = _holder_class("AttributeValue", False, False)
"""Holder of one attribute value; `owner`, `feature` and the value are its own, as in EValue."""
ReferenceValue = _holder_class("ReferenceValue", True, False)
"""Holder of one reference."""
ContainedValue = _holder_class("ContainedValue", True, True)
"""Holder of one contained element."""
HOLDERS = (AttributeValue, ReferenceValue, ContainedValue)

_new = object.__new__
_NOTHING: Any = object()

UNBOXED_TYPES: frozenset[type[int | str | float | EEnumLiteral]] = frozenset([int, str, bool, float, EEnumLiteral])
"""Exact classes of the values that are stored in an element without a holder."""


_HOLDS_ONE = frozenset({EValue, AttributeValue, ReferenceValue, ContainedValue})
"""Exact classes of holders whose value can be read without side effects."""
_HOLDS_MANY = frozenset({FeatureOrderedSet, FeatureList})
"""Exact classes of collections that are returned as they are when a feature is read."""


def _value_of(self: EAttribute, instance: EObject, owner: type | None = None) -> Any:
    if instance is None:
        return self
    value = instance.__dict__.get(key_of(self), _NOTHING)
    if value.__class__ in UNBOXED_TYPES:
        return value
    if value.__class__ in _HOLDS_ONE:
        return value_in(value)
    if value is _NOTHING and REFUSAL in instance.__dict__:
        return self.get_default_value()  # an element that nobody can change needs no holder for what it has not
    return EAttribute.__get__(self, instance, owner)


def _change(self: EAttribute, instance: EObject, value: Any) -> None:
    slots = instance.__dict__
    if REFUSAL in slots:
        raise slots[REFUSAL](instance, key_of(self))
    present = slots.get(key_of(self), _NOTHING)
    if present.__class__ in UNBOXED_TYPES:
        slots[key_of(self)] = new_slot(AttributeValue, instance, self, present)
    EAttribute.__set__(self, instance, value)


_Quiet: Any = type("_Quiet", (type(EAttribute),), {"__init__": type.__init__})  # what it makes becomes part of no metamodel
_BareAttribute: Any = _Quiet(EAttribute.__name__, (EAttribute,), {"__get__": _value_of, "__set__": _change})
"""An attribute of one value that may lie bare in the element: without a holder, which is made when it is changed."""


def _target_of(self: EReference, instance: EObject, owner: type | None = None) -> object:
    if instance is None:
        return self
    slot: object = instance.__dict__.get(key_of(self))
    if slot.__class__ in _HOLDS_MANY:
        return slot
    if slot.__class__ in _HOLDS_ONE:
        return target_in(slot)  # type: ignore[arg-type]
    found: object = EReference.__get__(self, instance, owner)  # type: ignore[attr-defined]
    return found


def _computed_value(self: EAttribute, instance: EObject, owner: type | None = None) -> object:
    if instance is not None and key_of(self) not in instance.__dict__ and self.defaultValueLiteral is None:
        raise not_computed(instance, str(self.name))
    found: object = EAttribute.__get__(self, instance, owner)
    return found


def _computed_target(self: EReference, instance: EObject, owner: type | None = None) -> object:
    if instance is not None and key_of(self) not in instance.__dict__:
        raise not_computed(instance, str(self.name))
    found: object = EReference.__get__(self, instance, owner)  # type: ignore[attr-defined]
    return found


_COMPUTED: Mapping[type, type] = {
    EAttribute: _Quiet(EAttribute.__name__, (EAttribute,), {"__get__": _computed_value}),
    EReference: _Quiet(EReference.__name__, (EReference,), {"__get__": _computed_target}),
}
"""Features of one value that code would have to compute, and whose metamodel alone does not have that code."""


def computed(feature: EStructuralFeature) -> None:
    """Let a feature that is derived and volatile say that nothing computes it, instead of its type's default or nothing.

    One of several values says so by its collection (`FeatureCollection`). A value that was given, or a default, is returned.
    """
    if feature.derived and feature.volatile and not feature.many:
        feature.__class__ = _COMPUTED.get(feature.__class__, feature.__class__)


_assigned: Callable[[EReference, EObject, Any], None] = EReference.__set__  # type: ignore[attr-defined]


def _redirect(self: EReference, instance: EObject, value: Any) -> None:
    """Set a reference; its former target, and what the new one refers to in turn, let go first, as in EMF.

    pyecore's setter only adds the new opposite.
    """
    opposite = self.eOpposite
    if value is not None and not self.many and value.__class__ is not EProxy and (self.containment or opposite is not None):
        former = _target_of(self, instance)
        if former is value:
            if REFUSAL in instance.__dict__:
                raise instance.__dict__[REFUSAL](instance, key_of(self))
            return
        instance.__dict__[key_of(self)].check(value)
        if self.containment:
            refuse_circle(instance, value)
        if opposite is not None:
            if opposite.containment:
                if REFUSAL in value.__dict__:
                    raise value.__dict__[REFUSAL](value, key_of(opposite))
                refuse_circle(value, instance)
            if former is not None:
                _assigned(self, instance, None)
            if not opposite.many and getattr(value, key_of(opposite)) is not None:
                _assigned(opposite, value, None)
    _assigned(self, instance, value)


_QuickReference: type = _Quiet(EReference.__name__, (EReference,), {"__get__": _target_of, "__set__": _redirect})
"""A reference that is read without the two calls that pyecore makes for it, and keeps opposites in agreement when it is set."""


def quick(feature: EStructuralFeature) -> None:
    """Let a reference be read without pyecore's extra calls, unless it is derived."""
    if feature.__class__ is EReference and not (feature.derived or feature.volatile):
        feature.__class__ = _QuickReference


def store_unboxed(feature: EStructuralFeature) -> bool:
    """Let values of a feature be stored without a holder from now on; returns whether it is a single-valued attribute."""
    if feature.__class__ is EAttribute and not (feature.many or feature.derived or feature.volatile):
        feature.__class__ = _BareAttribute
    return feature.__class__ is _BareAttribute


def features_fixed(cls: type) -> bool:
    """Whether a class says that its features never change once it is made, as those of `strict` do."""
    return getattr(cls, "_fixed_features", False) is True


def new_slot(cls: type[EValue], owner: EObject, feature: EStructuralFeature, value: Value) -> EValue:
    """A holder of one of the classes above."""
    made = _new(cls)
    made.owner = owner
    made.feature = feature
    set_slot(made, value)
    return made


def collection(owner: EObject, feature: EStructuralFeature) -> Any:
    """An empty collection for that feature, which is not derived."""
    form = feature.__dict__.get("_robosmi_form", _NOTHING)
    if form is _NOTHING:
        kind = kind_of(feature)
        if kind not in (FeatureOrderedSet, FeatureList, FeatureBag):
            form = None
        else:
            is_ref = feature.is_reference
            is_cont = is_ref and feature.containment
            form = kind, is_ref, is_cont, is_cont and feature.eOpposite is None
        if features_fixed(owner.__class__):  # those of other classes may change yet
            feature.__dict__["_robosmi_form"] = form
    if form is None:
        made = FeatureCollection.create(owner, feature)
        made.birth = None
        return made
    kind, is_ref, is_cont, is_born = form
    made = kind.__new__(kind)
    made.owner = owner
    made.feature = feature
    if not is_ref:  # else as the class has it
        made.is_ref = False
    if is_cont:
        made.is_cont = True
    if kind is FeatureOrderedSet:
        empty_ordered_set(made)
    made.birth = (owner, feature) if is_born and kind is FeatureOrderedSet else None
    return made


def plain_value(slot: Any) -> Any:
    """The value in a slot of an attribute of one value, bare or in a holder."""
    return slot if slot.__class__ in UNBOXED_TYPES else value_in(slot)


class _Made:
    """Descriptor of a container that is created on first access and then is an ordinary attribute."""

    def __init__(self, name: str, make: Callable[[EObject], Any]) -> None:
        self.name = name
        self.make = make

    def __get__(self, element: EObject, owner: type | None = None) -> Any:
        if element is None:
            raise AttributeError(self.name)  # pyecore asks classes too, when one becomes the type of a reference
        made = element.__dict__[self.name] = self.make(element)
        return made


def _set_features(element: EObject) -> Any:
    """The features that have been set, determined from the slots."""
    found = FeatureSet()
    cls = element.__class__
    for name, value in element.__dict__.items():
        if value.__class__ in UNBOXED_TYPES:
            feature = getattr(cls, name, None)
            if feature.__class__ is _BareAttribute:
                found[feature] = None
        elif isinstance(value, EValue):
            if value.__class__ is not EValue and (value_in(value) is not None or isinstance(value, HOLDERS)):
                found[value.feature] = None
        elif isinstance(value, ECollection) and ("birth" in value.__dict__ or len(value)):
            found[value.feature] = None
    return found


def _back_links(element: EObject) -> Any:
    """The elements that refer to this one by references without opposite, as recorded by `note_link` and containers."""
    slots = element.__dict__
    found = set(slots.pop("_linked", ()))
    if (birth := slots.pop("_birth", None)) is not None:
        found.add(birth)
    return found


def note_link(target: EObject, link: tuple[EObject, EStructuralFeature]) -> None:
    """Record on an element that another one refers to it by a reference without opposite.

    Args:
        target: the element.
        link: the referring element and its feature.
    """
    slots = target.__dict__
    if INVERSE_REFERENCES in slots:
        slots[INVERSE_REFERENCES].add(link)
    elif "_linked" in slots:
        slots["_linked"].append(link)
    elif hasattr(type(target), INVERSE_REFERENCES):
        slots["_linked"] = [link]
    else:
        inverse_references_of(target).add(link)


class _Own:
    """Descriptor with one value for the class and another for its elements, like pyecore's fields of the same name in both."""

    def __init__(self, of_class: Any, of_element: Any) -> None:
        self.of_class = of_class
        self.of_element = of_element

    def __get__(self, element: EObject, owner: type | None = None) -> Any:
        return self.of_class if element is None else self.of_element(element)


LAZY: dict[str, Any] = {
    SET_FEATURES: _Made(SET_FEATURES, _set_features),
    INVERSE_REFERENCES: _Made(INVERSE_REFERENCES, _back_links),
    "listeners": _Made("listeners", lambda element: []),
    FIRST_LISTENERS: _Made(FIRST_LISTENERS, lambda element: []),
    "eResource": property(resource_of),
    IDENTITY: None,
    CONTAINER: None,
    CONTAINING_FEATURE: None,
    RESOURCE: None,
}


def is_prepared(cls: type) -> bool:
    """Whether `prepare` was called for a class itself, not only for one of its bases."""
    return INVERSE_REFERENCES in cls.__dict__


def prepare(cls: type) -> None:
    """Make a class ready for compact elements: what pyecore would put into each is found in the class."""
    if is_prepared(cls):
        return
    for name, value in LAZY.items():
        if not isinstance(getattr(type(cls), name, None), property):  # a metaclass may keep the name for itself
            setattr(cls, name, value)
    for name, of_element in (("dyn_inst", lambda element: element), (IS_STATIC, lambda element: False)):
        setattr(cls, name, _Own(getattr(cls, name, None), of_element))


def share_keys(cls: type, keys: Iterable[str]) -> None:
    """Let the elements of a class share one table of the keys of their slots, which takes a quarter of the memory.

    Python adds keys to such a table with the first few elements only, and references are set when all elements are there.
    """
    slots: dict[str, Any] = _new(cls).__dict__
    for key in (IDENTITY, CONTAINER, CONTAINING_FEATURE, "_birth", *keys):
        slots[key] = None


def repair_default(feature: EStructuralFeature, datatype: EDataType) -> None:
    """Make pyecore give an attribute EMF's default, where its own is wrong: literals by their text, zero of small types."""
    literal = feature.defaultValueLiteral
    if isinstance(datatype, EEnum):
        if literal is not None and datatype.from_string(literal) is None:
            datatype.from_string = _literal_of(datatype)
    elif literal is None and feature.default_value is None and not feature.many:
        wanted = datatypes.default(feature, datatype)
        if wanted is not None and datatype.default_value is None:
            feature.default_value = wanted


def _literal_of(enum: EEnum) -> Callable[[str], EEnumLiteral | None]:
    def find(text: str) -> EEnumLiteral | None:
        return next((x for x in enum.eLiterals if text in (datatypes.literal_text(x), x.name)), None)

    return find


_MANY = 50_000  # new objects: fewer are left to the collector as they are
_aged = 0  # objects that became old at once since the last collection of them
_none_frozen = True  # until frozen objects of somebody else are seen: Python counts them one by one


@contextmanager
def collector_at_rest(makes_models: bool = False) -> Iterator[None]:
    """Context manager: suspends cyclic garbage collection, since elements form many cycles that are no garbage yet.

    Many objects that were made meanwhile are old afterwards. As young ones the collector would examine them three times at once.
    Of old ones it knows no number to tell when it is time, so they are counted here, and the next block that makes models
    collects first.

    Args:
        makes_models: whether the block makes models, in place of such as may be garbage by now.
    """
    global _aged, _none_frozen
    if not gc.isenabled():
        yield
        return
    gc.disable()
    if makes_models and _aged > 40 * _MANY:
        gc.collect()
        _aged = 0
    before = gc.get_count()[0]
    try:
        yield
    finally:
        made = gc.get_count()[0] - before
        if made > _MANY and _none_frozen:
            _none_frozen = gc.get_freeze_count() == 0
            if _none_frozen:  # else those of somebody else would thaw
                _aged += made
                gc.freeze()
                gc.unfreeze()  # into the oldest generation
        gc.enable()
