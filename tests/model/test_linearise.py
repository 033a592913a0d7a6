"""Python's order of bases for hierarchies that no metamodel of the tests has."""

from __future__ import annotations

from robosmi.diagnostics import Location
from robosmi.model.ecore.ecore_description import Class, Package
from robosmi.model.ecore.linearise import bases, topological

WHERE = Location("ladder.ecore")
PACKAGE = Package("ladder", WHERE)


def _class(name: str, *supertypes: Class) -> Class:
    return Class(name, WHERE, package=PACKAGE, supertypes=list(supertypes))


def test_a_ladder_of_diamonds_whose_orders_contradict_each_other_gets_bases_that_python_takes() -> None:
    left, right = _class("L0"), _class("R0")
    for rung in range(1, 40):
        left, right = _class(f"L{rung}", left, right), _class(f"R{rung}", right, left)
    bottom = _class("Bottom", left, right)
    made: dict[Class, type] = {}
    for cls, above in bases(topological([bottom])[0]).items():
        made[cls] = type(cls.name, tuple(made[base] for base in above), {})
    assert len(made) == 81
    assert all(issubclass(made[bottom], each) for each in made.values())
