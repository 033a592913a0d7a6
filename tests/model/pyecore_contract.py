"""What of pyecore RoboSMi leans on without a promise, and whether it holds in a version of pyecore.

    python -m tests.model.pyecore_contract                  the facts, in the pyecore that is installed
    python -m tests.model.pyecore_contract 0.14.0 0.15.2    the same in other versions, each in an environment of its own

Each fact is a function that raises when it does not hold; its docstring is the fact. Only pyecore, the two modules
`pyecore_internals` and `ecore_bootstrap` of `robosmi/model`, and what they import (types, and helpers over msgspec) are used, so
that a version can be judged that the rest of RoboSMi does not run with.
Exit 1 when a fact does not hold.
"""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
import tempfile
import venv
from collections.abc import Callable
from importlib.metadata import requires
from pathlib import Path
from types import ModuleType
from typing import Any

from pyecore.ecore import (
    EAttribute,
    EClass,
    EEnum,
    EEnumLiteral,
    EInt,
    EObject,
    EPackage,
    EProxy,
    EReference,
    EString,
    MetaEClass,
)
from pyecore.resources import ResourceSet
from pyecore.valuecontainer import ECollection, EList, EOrderedSet, EValue

MODULES = Path(__file__).resolve().parents[2] / "robosmi" / "model" / "elements"


def _load(name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, MODULES / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


inside: Any = _load("pyecore_internals")
ecore_bootstrap: Any = _load("ecore_bootstrap")
FACTS: list[Callable[[], None]] = []


def fact(function: Callable[[], None]) -> Callable[[], None]:
    """Note a fact."""
    FACTS.append(function)
    return function


def node_class() -> Any:
    """A class with one attribute of each kind, containments and references of each kind, made anew for each fact."""
    node = EClass("Node")
    child = EReference("children", node, upper=-1, containment=True)
    parent = EReference("parent", node, eOpposite=child)
    for feature in (
        EAttribute("label", EString),
        EAttribute("numbers", EInt, upper=-1, unique=False),
        child,
        parent,
        EReference("next", node),
        EReference("seen", node, upper=-1),
        EReference("part", node, containment=True),
    ):
        node.eStructuralFeatures.append(feature)
    EPackage("nodes", "http://nodes", "nodes").eClassifiers.append(node)
    return node


def feature(node: Any, name: str) -> Any:
    """A feature of the class."""
    return node.findEStructuralFeature(name)


class Ear:
    """A listener that counts."""

    def __init__(self) -> None:
        self.heard: list[Any] = []

    def notifyChanged(self, notification: Any) -> None:
        """Called by pyecore."""
        self.heard.append(notification)


@fact
def every_element_has_the_fields() -> None:
    """A new element has every field: no container, resource and xmi:id, nothing set, no inverse references, no listener."""
    made = node_class()()
    assert set(made.__dict__) >= inside.FIELDS - {"_instances", inside.IS_STATIC}
    assert inside.container_of(made) is inside.containing_feature_of(made) is inside.own_resource_of(made) is None
    assert inside.xmi_id_of(made) is None
    assert list(inside.set_features_of(made)) == []
    assert list(inside.inverse_references_of(made)) == []
    assert list(inside.first_listeners_of(made)) == []


@fact
def containment_is_in_the_fields() -> None:
    """The container and its feature are the fields, and `eContainer` reads them."""
    node = node_class()
    outer, inner, other = node(), node(), node()
    outer.children.append(inner)
    assert inside.container_of(inner) is outer
    assert inside.containing_feature_of(inner) is feature(node, "children")
    inside.contain(other, outer, feature(node, "part"))
    assert other.eContainer() is outer
    assert other.eContainmentFeature() is feature(node, "part")


@fact
def resources_are_in_the_fields() -> None:
    """A root has its resource in the field, and `eResource` of what it contains reads it there."""
    node = node_class()
    outer, inner = node(), node()
    outer.children.append(inner)
    ResourceSet().create_resource("x.xmi").append(outer)
    assert inside.own_resource_of(outer) is outer.eResource
    assert inside.own_resource_of(inner) is None
    home = inside.ListenedTo([])
    inside.set_own_resource(outer, home)
    assert inner.eResource is home


@fact
def what_was_set_is_in_the_fields() -> None:
    """Assigning and adding note the feature as a key of the field, which takes more by `add`; `eIsSet` reads it."""
    node = node_class()
    made = node()
    made.label = "a"
    made.children.append(node())
    assert set(inside.set_features_of(made)) == {feature(node, "label"), feature(node, "children")}
    inside.set_features_of(made).add(feature(node, "part"))
    assert made.eIsSet("part")
    assert isinstance(inside.set_features_of(made), inside.FeatureSet)
    assert isinstance(inside.set_features_of(made), dict)


@fact
def references_without_opposite_are_noted() -> None:
    """The target of a reference without opposite knows the pair of element and feature; with an opposite it does not."""
    node = node_class()
    one, two, part = node(), node(), node()
    one.next = two
    one.seen.append(two)
    one.children.append(part)
    assert set(inside.inverse_references_of(two)) == {(one, feature(node, "next")), (one, feature(node, "seen"))}
    assert set(inside.inverse_references_of(part)) == set()
    two.delete()
    assert one.next is None
    assert list(one.seen) == []


@fact
def slots_are_made_at_the_first_look() -> None:
    """The slot of a feature is in the element's dictionary under the feature's key, from the first read on."""
    node = node_class()
    made = node()
    assert inside.key_of(feature(node, "label")) == "label"
    assert "label" not in made.__dict__
    assert made.label is None
    assert isinstance(made.__dict__["label"], EValue)
    assert isinstance(made.children, ECollection)
    assert made.__dict__["children"] is made.children


@fact
def a_feature_may_have_another_slot() -> None:
    """A feature whose key is another than its name has its slot there."""
    node = node_class()
    inside.set_key(feature(node, "label"), "label_")
    made = node()
    made.label = "a"
    assert "label" not in made.__dict__
    assert inside.value_in(made.__dict__["label_"]) == made.label == "a"


@fact
def holders_hold_what_is_read() -> None:
    """A holder's value is what reading gives, put there with or without a word."""
    made = node_class()()
    made.label = "a"
    slot = made.__dict__["label"]
    assert inside.is_value(slot)
    assert not inside.is_value(made.children)
    assert inside.value_in(slot) == inside.read(slot) == "a"
    inside.set_slot(slot, "b")
    assert made.label == "b"
    assert inside.read(made.children) is made.children


@fact
def reading_asks_what_lies_in_the_slot() -> None:
    """Reading and assigning ask whatever lies in the slot, and a value that cannot be asked is taken for the value itself."""

    class Given(inside.Slot):  # type: ignore[misc]
        assigned: Any = None

        def read(self) -> Any:
            return "given"

        def assign(self, value: Any) -> None:
            self.assigned = value

    made = node_class()()
    made.__dict__["label"] = given = Given()
    assert made.label == "given"
    made.label = "b"
    assert given.assigned == "b"
    made.__dict__["label"] = "bare"
    assert made.label == "bare"


@fact
def holders_may_be_guarded() -> None:
    """A subclass of the holder decides what assigning does; the constructor takes owner and feature."""

    class Guarded(inside.GuardedValue):  # type: ignore[misc]
        def assign(self, value: Any) -> None:
            raise PermissionError

    node = node_class()
    made = node()
    made.__dict__["label"] = Guarded(made, feature(node, "label"))
    try:
        made.label = "x"
    except PermissionError:
        return
    raise AssertionError("assigned")


@fact
def unique_collections_are_ordered_sets() -> None:
    """A unique collection has its values in `items` and their positions in `map`; one that is not unique is a list."""
    node = node_class()
    made, one, two = node(), node(), node()
    assert isinstance(made.seen, EOrderedSet)
    assert isinstance(made.numbers, EList)
    assert isinstance(made.numbers, list)
    made.seen.extend([one, two])
    assert made.seen.items == [one, two]
    assert dict(made.seen.map) == {one: 0, two: 1}
    empty = object.__new__(EOrderedSet)
    empty.owner, empty.feature = made, feature(node, "seen")
    empty.is_ref, empty.is_cont, empty.generic_type = True, False, None
    inside.empty_ordered_set(empty)
    empty.append(one)
    assert list(empty) == [one]


@fact
def collections_take_values_silently() -> None:
    """What is added or filled in silently is found by reading, and nobody is told."""
    node = node_class()
    made, one, two = node(), node(), node()
    made.listeners.append(ear := Ear())
    assert inside.add_silently(made.seen, one)
    assert not inside.add_silently(made.seen, one)
    assert inside.add_silently(made.numbers, 3)
    assert inside.add_silently(made.numbers, 3)
    assert list(made.seen) == [one]
    assert list(made.numbers) == [3, 3]
    inside.fill_silently(made.seen, [two, one])
    inside.fill_silently(made.numbers, [1])
    assert list(made.seen) == [two, one]
    assert made.seen.index(one) == 1
    assert list(made.numbers) == [1]
    assert ear.heard == []


@fact
def listeners_are_told() -> None:
    """First listeners of the resource and of the element are told of a change, and the others of both."""
    made = node_class()()
    ears = [Ear() for _ in range(4)]
    home = inside.ListenedTo([ears[0]])
    inside.first_listeners_of(home).append(ears[1])
    inside.set_own_resource(made, home)
    inside.first_listeners_of(made).append(ears[2])
    made.listeners.append(ears[3])
    made.label = "a"
    assert [len(ear.heard) for ear in ears] == [1, 1, 1, 1]


@fact
def collections_come_from_the_features_class() -> None:
    """An empty collection comes from `derived_class.create(element, feature)` of its feature."""
    node = node_class()
    asked = []

    class Maker(ECollection):  # type: ignore[misc]
        @staticmethod
        def create(owner: Any, wanted: Any) -> Any:
            asked.append((owner, wanted))
            return EOrderedSet(owner, wanted)

    feature(node, "seen").derived_class = Maker
    made = node()
    assert list(made.seen) == []
    assert asked == [(made, feature(node, "seen"))]


@fact
def features_may_get_another_class() -> None:
    """An attribute may become an object of a subclass, whose `__get__` and `__set__` are then asked."""
    node = node_class()
    quiet: Any = type("Quiet", (type(EAttribute),), {"__init__": type.__init__})
    other = quiet("EAttribute", (EAttribute,), {"__get__": lambda self, instance, owner=None: self if instance is None else "x"})
    feature(node, "label").__class__ = other
    assert node().label == "x"


@fact
def fields_may_lie_in_the_class() -> None:
    """An element without fields of its own finds them in its class: pyecore's own setters and collections work on it."""
    node = node_class()
    cls = node.python_class
    for name in (inside.CONTAINER, inside.CONTAINING_FEATURE, inside.RESOURCE, inside.IDENTITY):
        setattr(cls, name, None)
    setattr(cls, inside.SET_FEATURES, property(lambda self: self.__dict__.setdefault(inside.SET_FEATURES, inside.FeatureSet())))
    setattr(cls, inside.INVERSE_REFERENCES, property(lambda self: self.__dict__.setdefault(inside.INVERSE_REFERENCES, set())))
    cls.listeners = ()
    setattr(cls, inside.FIRST_LISTENERS, ())
    cls.dyn_inst = property(lambda self: self)
    outer, inner = object.__new__(cls), object.__new__(cls)
    outer.children.append(inner)
    outer.next = inner
    assert inner.eContainer() is outer
    assert inner.parent is outer
    assert list(outer.eContents) == [inner]


@fact
def proxies_say_what_they_stand_for() -> None:
    """A proxy knows its URI and its resource, and when it is resolved what it stands for."""
    made, place = node_class()(), object()
    proxy = EProxy(path="a.xmi#/", resource=place)
    assert not proxy.resolved
    assert inside.proxy_place(proxy) == ("a.xmi#/", place)
    assert inside.proxied(EProxy(wrapped=made)) is made


@fact
def types_are_declared() -> None:
    """A feature's declared type is what its `eType` was set to, proxies unresolved; None without one."""
    node = node_class()
    assert inside.declared_type_of(feature(node, "label")) is EString
    proxy = EProxy(path="b.ecore#//B", resource=None)
    reference = EReference("to", node)
    reference.eType = proxy
    assert inside.declared_type_of(reference) is proxy
    assert inside.declared_type_of(EReference("to")) is None


@fact
def elements_are_told_from_modules() -> None:
    """Elements and packages have fields, modules of generated packages have none; generated classes are known as such."""
    node = node_class()
    assert inside.is_element(node())
    assert inside.is_element(node.ePackage)
    assert not inside.is_element(sys)
    assert inside.is_static(EObject)
    assert not inside.is_static(node.python_class)


@fact
def features_may_be_made_by_copy() -> None:
    """A feature that is a copy of one made without arguments, with what is given assigned, is as its constructor makes it."""
    node = node_class()
    given: list[dict[str, Any]] = [
        {"name": "a", "eType": EInt},
        {"eType": EString, "default_value": "x", "lower": 1},
        {"name": "a", "eType": EInt, "upper": -1, "unique": False, "ordered": False},
        {"name": "a", "eType": EString, "iD": True, "changeable": False, "defaultValueLiteral": "y"},
        {"name": "a", "eType": EInt, "derived": True, "volatile": True, "transient": True, "derived_class": Ear},
    ]
    links: list[dict[str, Any]] = [
        {"name": "r", "eType": node, "containment": True, "upper": -1},
        {"eType": EObject, "unsettable": True},
        {"name": "r", "eType": node, "eOpposite": feature(node, "next")},
    ]
    for kind, arguments in [(EAttribute, one) for one in given] + [(EReference, one) for one in links]:
        slow, quick = kind(**arguments), ecore_bootstrap.quick_constructor(kind)(**dict(arguments))
        other = ecore_bootstrap.quick_constructor(kind)()
        assert other.name is None, "a copy changed another"
        for name in {*slow.__dict__} - inside.FIELDS - {"dyn_inst"}:
            value = getattr(quick, name)  # makes a slot that holds the default
            ours, theirs = (x.__dict__[name] for x in (quick, slow))
            if isinstance(theirs, EValue):
                assert value == theirs._value, name
                assert ours == value if not isinstance(ours, EValue) else ours.owner is quick, name
            else:
                assert ours == theirs, name
        assert set(quick.__dict__) == set(slow.__dict__)
        assert set(inside.set_features_of(quick)) == set(inside.set_features_of(slow))
        assert inside.first_listeners_of(quick) == [quick]
        assert quick.many == slow.many
        quick.upperBound, quick.name = 5, "b"
        assert quick.many
        assert inside.key_of(quick) == "b"


@fact
def a_class_may_be_given() -> None:
    """`EClass(name, metainstance=cls)` makes a class of the metamodel of a Python class that exists."""
    python: Any = type(EObject)("Given", (EObject,), {})
    made = EClass("Given", metainstance=python)
    python.eClass = made
    assert made.python_class is python
    assert isinstance(python(), python)


def _told(element: Any) -> dict[str, Any]:
    """The fields of an element with classes and elements by their names, without collections that a mere look made."""
    said: dict[str, Any] = {}
    for name, held in element.__dict__.items():
        if isinstance(held, ECollection):
            if len(held):
                said[name] = (held.feature.name, held.is_ref, held.is_cont, [part.name for part in held])
        elif isinstance(held, EValue) and not held.is_ref:
            said[name] = held._value  # as without a holder
        elif isinstance(held, EValue):
            fields = {field: value for field, value in held.__dict__.items() if field not in ("owner", "feature", "_value")}
            said[name] = (held.owner is element, held.feature.name, fields, getattr(held._value, "name", held._value))
        elif name in (inside.SET_FEATURES, inside.INVERSE_REFERENCES, inside.FIRST_LISTENERS):
            said[name] = sorted(str(getattr(one[-1] if isinstance(one, tuple) else one, "name", one)) for one in held)
        else:
            said[name] = getattr(held, "__name__", getattr(held, "name", held))
    return said


@fact
def classes_may_be_promoted_silently() -> None:
    """A generated class whose EClass is put together silently is described as by pyecore's metaclass, in every field."""
    made: list[Any] = []
    for quiet in (False, True):
        kind = type(EObject) if quiet else MetaEClass
        root = type(EObject)("Root", (EObject,), {})

        def of(name: str, bases: tuple[Any, ...], kind: Any = kind, root: Any = root, quiet: bool = quiet, **given: Any) -> Any:
            cls = kind(name, bases, {"__module__": __name__, **given})
            if quiet:
                ecore_bootstrap.promote(cls, root)
            elif root in bases:
                cls.eClass.eSuperTypes.remove(EObject.eClass)
            return cls

        above = of("Above", (root,), label=EAttribute(eType=EString), ids=EAttribute(name="id", eType=EInt, upper=-1))
        below = of("Below", (above,), parts=EReference(eType=above, upper=-1, containment=True))
        method = of("Method", (root,), size=EAttribute(eType=EInt), grow=lambda self, by: None)
        assert list(below.eClass.eSuperTypes) == [above.eClass]
        assert list(method.eClass.eOperations), "methods are operations"
        described = [cls.eClass for cls in (above, below, method)]
        made.append([_told(each) for one in described for each in (one, *one.eStructuralFeatures)])
        assert sys.modules[__name__].__dict__["eClassifiers"]["Below"] is below
    assert made[0] == made[1]


@fact
def literals_may_be_added_silently() -> None:
    """A literal that is put into an enumeration silently is described as if it had been appended, in every field."""
    made = []
    for quiet in (False, True):
        state = EEnum("State")
        for name, value in (("off", 0), ("on", 2)):
            if quiet:
                ecore_bootstrap.add_literal(state, name, value)
            else:
                state.eLiterals.append(EEnumLiteral(name=name, value=value))
                del state.__dict__[name]  # pyecore also makes each literal an attribute of its enumeration
        assert state.getEEnumLiteral(value=2) is state.eLiterals[1]
        made.append([_told(one) for one in (state, *state.eLiterals)])
    assert made[0] == made[1]


def judge() -> dict[str, str]:
    """Every fact -> what is wrong, or nothing."""
    found = {}
    for function in FACTS:
        try:
            function()
        except Exception as error:
            found[function.__doc__ or ""] = f"{type(error).__name__}: {error}"
        else:
            found[function.__doc__ or ""] = ""
    return found


def judged_in(version: str) -> int:
    """The facts in another version, installed from the package index into an environment of its own; the exit code."""
    with tempfile.TemporaryDirectory() as folder:
        venv.create(folder, with_pip=True)
        python = str(Path(folder) / "bin" / "python")
        wanted = [f"pyecore=={version}", *(each for each in requires("robosmi") or () if each.startswith("msgspec"))]
        subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *wanted], check=True)
        found_by = {**os.environ, "PYTHONPATH": str(MODULES.parents[1])}
        return subprocess.run([python, str(Path(__file__))], check=False, env=found_by).returncode


def main(versions: list[str]) -> int:
    """Print the facts and whether they hold."""
    if versions:
        return max(judged_in(version) for version in versions)
    from importlib.metadata import version

    found = judge()
    print(f"pyecore {version('pyecore')}: {sum(not text for text in found.values())} of {len(found)} facts hold")
    for said, text in found.items():
        print(f"  {'no ' if text else 'yes'}  {said}{f'  [{text}]' if text else ''}")
    return int(any(found.values()))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
