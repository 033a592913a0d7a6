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
WRONG: dict[str, Any] = {"gives nothing": None, "gives texts": (hardware.Circuit(name="robot"), ["oops"])}
"""Value of CHECKS_PLUGIN -> what the reader gives then."""


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
    if os.environ.get("CHECKS_PLUGIN") == "replaces":
        registry.add("drawing reader", "pin_table", "robosmi.transformations.t2m.pin_table:read_circuit")
    if os.environ.get("CHECKS_PLUGIN") == "dangling":
        registry.add("constraints", "migration", "checks_plugin:nothing")


@plans.critique(id="CH001", advice="call it otherwise")
def is_not_called_beacon(plan: migration.MigrationPlan) -> bool:
    """A plan that is called beacon."""
    if os.environ.get("CHECKS_PLUGIN") == "prints":
        print("checked")
    return bool(plan.name != "beacon")


@taken.context(migration.PortBinding).constraint(id="RS702")
def has_our_id(binding: migration.PortBinding) -> bool:
    """A constraint whose id is another's."""
    return True


def read_circuit(path: Path, project: Any = None, roles: Any = None, board: Any = None) -> Any:
    """Ends with an exception whatever it is given, or ends the program."""
    if os.environ.get("CHECKS_PLUGIN") == "exits":
        sys.exit(0)
    if os.environ.get("CHECKS_PLUGIN") in WRONG:
        return WRONG[os.environ["CHECKS_PLUGIN"]]
    return dict[str, Any]()["wiring"]
