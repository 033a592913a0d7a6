"""How the XMI reader treats each class: for every name in a file, the feature that it denotes and what to do with it.

A plan is made once for each class and load; classes of `strict`, which cannot change, keep theirs. The reader follows plans
without checks, so all questions about a metamodel (what is unsupported, abstract, required) are answered here.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from robosmi.model.elements import compact_slots, datatypes, ecore, features
from robosmi.model.elements.datatypes import FromText
from robosmi.model.elements.ecore import EClass, EDataType, EReference, EStructuralFeature
from robosmi.model.elements.feature_values import is_stored
from robosmi.model.elements.pyecore_internals import key_of
from robosmi.model.elements.strict import Element

VALUE, REFERENCE, CHILDREN, CHILD, VALUES, XMI_ID, IGNORED, REFUSED, ROOT = range(9)
"""What a name in a file stands for: a value, reference(s), contained elements (each once), contained element(s) of the rarer
kind, values, an id, nothing to be done, nothing allowed, a root."""

XMI = "http://www.omg.org/XMI"
XSI = "http://www.w3.org/2001/XMLSchema-instance"


class FeatureEntry:
    """What is done with one XML name in elements of one class.

    Attributes:
        kind: one of the numbers above.
        key: where pyecore keeps the value in the element's `__dict__`.
        feature: pyecore's feature.
        many: whether it takes more than one value.
        convert: text -> value, or None if the text is the value.
        is_id: whether the value identifies the element.
        bare: whether plain values lie bare in the element, as a constructor puts them there.
        declared: the EClass that contained or referred elements must have.
        plan: the plan of `declared`, once it was needed.
        accepted: plans and Python classes already seen to conform to `declared`.
        back: the opposite's entry, or None.
        message: why the name is refused.
    """

    __slots__ = ("accepted", "back", "bare", "convert", "declared", "feature", "is_id", "key", "kind", "many", "message", "plan")

    def __init__(self, kind: int, feature: EStructuralFeature | None = None, message: str = "") -> None:
        self.kind = kind
        if feature is not None:
            self.feature = feature
        self.key: str = key_of(feature) if feature is not None else ""
        self.many = feature is not None and feature.many
        self.convert: FromText | None = None
        self.is_id = False
        self.bare = False
        self.declared: EClass = ecore.EObject.eClass
        self.plan: ClassPlan | None = None
        self.accepted: set[type | ClassPlan] = set()
        self.back: EReference | None = None
        self.message = message

    def takes(self, cls: type) -> bool:
        """Whether elements of that Python class may be contained or referred to."""
        if cls in self.accepted:
            return True
        declared = self.declared
        if declared is ecore.EObject.eClass or issubclass(cls, declared.python_class):
            self.accepted.add(cls)
            return True
        return False


class ClassPlan:
    """What the reader knows of one class.

    Attributes:
        eclass: the EClass.
        cls: the Python class of its elements.
        name: its name.
        abstract: whether it has no elements of its own.
        fixed: whether its features never change, so that they may be read and kept the short way.
        entries: name in a file -> what to do.
        bounds: key, name, lower and upper bound of the features whose number of values is limited.
        refused: why no element of the class can be read, or None.
    """

    __slots__ = ("abstract", "bounds", "cls", "eclass", "entries", "fixed", "name", "refused")

    def __init__(self, eclass: EClass) -> None:
        self.eclass = eclass
        self.cls = eclass.python_class
        self.name = str(eclass.name)
        self.abstract = features.is_abstract(eclass)
        self.fixed = compact_slots.features_fixed(self.cls)
        self.entries: dict[str, FeatureEntry] = {f"{XMI}}}id": FeatureEntry(XMI_ID)}
        self.bounds: list[tuple[str, str, int, int]] = []
        self.refused = features.without_elements(eclass)
        compact_slots.prepare(self.cls)
        for feature in features.all_features(eclass):
            self._add(feature)
        compact_slots.share_keys(self.cls, [entry.key for entry in self.entries.values() if entry.key])

    def _add(self, feature: EStructuralFeature) -> None:
        name = str(feature.name)
        kind = features.declared_type(feature)
        if feature.is_attribute:
            entry = self._attribute(feature, kind)
        else:
            entry = self._reference(feature, kind)
        self.entries[name] = entry
        if entry.kind in (VALUE, VALUES, REFERENCE, CHILD, CHILDREN) and not (features.is_computed(feature) or feature.transient):
            upper = feature.upperBound
            lower = 0 if entry.kind == VALUE and datatypes.default(feature, kind) is not None else feature.lowerBound
            if lower > 0 or upper > 1:
                self.bounds.append((entry.key, name, lower, upper))

    def _attribute(self, feature: EStructuralFeature, kind: EDataType) -> FeatureEntry:
        if kind.name == datatypes.FEATURE_MAP:
            self.refused = f"{self.name} has the feature map '{feature.name}', which is not supported"
            return FeatureEntry(REFUSED, feature, self.refused)
        if not is_stored(feature) or (feature.many and features.is_computed(feature)):
            return FeatureEntry(REFUSED, feature, f"{self.name}.{feature.name} is computed, not stored")
        compact_slots.repair_default(feature, kind)
        entry = FeatureEntry(VALUES if feature.many else VALUE, feature)
        entry.convert = datatypes.from_text(kind)
        entry.is_id = bool(feature.iD)
        entry.bare = self.fixed and compact_slots.store_unboxed(feature)
        return entry

    def _reference(self, feature: EStructuralFeature, kind: EClass) -> FeatureEntry:
        if (feature.many and features.is_computed(feature)) or (feature.derived and not is_stored(feature)):
            return FeatureEntry(REFUSED, feature, f"{self.name}.{feature.name} is computed, not stored")
        if self.fixed:
            compact_slots.quick(feature)
        back = features.opposite(feature)
        if back is not None and back.containment:
            return FeatureEntry(IGNORED, feature)  # the containment itself says it
        kept_once = feature.many and feature.unique
        entry = FeatureEntry((CHILDREN if kept_once else CHILD) if feature.containment else REFERENCE, feature)
        entry.declared = kind
        entry.back = back
        return entry


class Plans:
    """The plans of one load, and what makes the elements of a class in it."""

    def __init__(self) -> None:
        self.made: Callable[[type], Any] = object.__new__
        self._plans: dict[EClass, ClassPlan] = {}

    def of(self, eclass: EClass) -> ClassPlan:
        """The plan of an EClass."""
        plan = self._plans.get(eclass)
        if plan is None:
            cls = eclass.python_class
            plan = cls.__dict__.get("_robosmi_plan") or ClassPlan(eclass)
            self._plans[eclass] = plan
            if issubclass(cls, Element):
                cls._robosmi_plan = plan
        return plan


def renaming(start: Callable[[str, dict[str, str]], None], uri: str) -> Callable[[str, dict[str, str]], None]:
    """A parser's handler of elements of another year's XMI, with `xmi:id`, `xmi:type` and `xmi:idref` as EMF has them."""
    theirs = f"{uri}}}"

    def renamed(name: str) -> str:
        return f"{XMI}}}{name[len(theirs) :]}" if name.startswith(theirs) else name

    return lambda tag, attributes: start(tag, {renamed(name): text for name, text in attributes.items()})
