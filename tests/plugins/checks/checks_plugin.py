"""A plug-in for tests: constraints on plans, and a drawing reader that ends with an exception of its own."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

from robosmi.metamodels import hardware, migration
from robosmi.plugins import Registry
from robosmi.validate import EVL

plan = EVL()
plans = plan.context(migration.MigrationPlan)
taken = EVL()
drawings = EVL()
rule = EVL()
twice = EVL()
WRONG: dict[str, Any] = {"gives nothing": None, "gives texts": (hardware.Circuit(name="robot"), ["oops"])}
"""Value of CHECKS_PLUGIN -> the wrong result that the reader returns then."""


def register(registry: Registry) -> None:
    """The value of the entry point."""
    if os.environ.get("CHECKS_PLUGIN") == "prints":
        print("registered")
    if os.environ.get("CHECKS_PLUGIN") == "exits at once":
        sys.exit(0)
    registry.add("constraints", "migration", "checks_plugin:plan")
    registry.add("drawing reader", "failing", "checks_plugin:read_circuit")
    registry.add_data(str(Path(__file__).parent / "data"))
    if os.environ.get("CHECKS_PLUGIN") == "taken":
        registry.add("constraints", "migration", "checks_plugin:taken")
    if os.environ.get("CHECKS_PLUGIN") == "drawings":
        registry.add("constraints", "hardware", "checks_plugin:drawings")
    if os.environ.get("CHECKS_PLUGIN") == "rule":
        registry.add("constraints", "hardware", "checks_plugin:rule")
    if os.environ.get("CHECKS_PLUGIN") == "twice":
        registry.add("constraints", "hardware", "checks_plugin:twice")
    if os.environ.get("CHECKS_PLUGIN") == "misspelt":
        registry.add("constraints", "hardwr", "checks_plugin:drawings")
        registry.add("drawing reeder", "failing", "checks_plugin:read_circuit")
        registry.add("view", "Circuit", "checks_plugin:read_circuit")
        registry.add("constraints", "library", "checks_plugin:drawings")
    if os.environ.get("CHECKS_PLUGIN") == "replaces":
        registry.add("drawing reader", "pin_table", "robosmi.transformations.t2m.pin_table:read_circuit")
    if os.environ.get("CHECKS_PLUGIN") == "dangling":
        registry.add("constraints", "migration", "checks_plugin:nothing")


@plans.critique(id="CH001", advice="call it otherwise")
def is_not_called_beacon(plan: migration.MigrationPlan) -> bool:
    """A constraint that a plan called beacon violates."""
    if os.environ.get("CHECKS_PLUGIN") == "prints":
        print("checked")
    return bool(plan.name != "beacon")


@taken.context(migration.PortBinding).constraint(id="RS702")
def has_our_id(binding: migration.PortBinding) -> bool:
    """A constraint whose id is another's."""
    return True


@drawings.context(hardware.Component).critique(id="CH002", advice="draw something else")
def is_no_button(component: hardware.Component) -> bool:
    """A constraint that a push button violates."""
    return "button" not in component.partTitle.lower()


@rule.context(hardware.Component).critique(id="RS203")
def has_the_id_of_a_reader(component: hardware.Component) -> bool:
    """A constraint whose id a reader's finding has."""
    return True


@twice.context(hardware.Component).critique(id="CH001")
def has_my_other_id(component: hardware.Component) -> bool:
    """A constraint whose id another one of this plug-in has, for another metamodel."""
    return True


def read_circuit(path: Path, project: Any = None, roles: Any = None, board: Any = None) -> Any:
    """Raise an exception whatever is given, or end the program."""
    if os.environ.get("CHECKS_PLUGIN") == "exits":
        sys.exit(0)
    if os.environ.get("CHECKS_PLUGIN") in WRONG:
        return WRONG[os.environ["CHECKS_PLUGIN"]]
    return dict[str, Any]()["wiring"]
