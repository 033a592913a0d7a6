"""Pin tables that we made up for 60 real programs: what rules bind is what is meant, and no port is lost or shares a pin.

A table says in remarks which program it is for (its path in the corpus, whose code is not part of the project) and which pin is
meant for each port. Two like parts are called by numbers in many of them, so that the evidence cannot decide: those ports have
to stay open.
"""

from __future__ import annotations

import os
import re
from collections import Counter
from pathlib import Path

import pytest

import robosmi
from robosmi.metamodels import migration
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.code import views
from robosmi.transformations.queries.flows.pin_uses import pin_uses

TABLES = sorted((Path(__file__).parent / "pin_tables").glob("*.csv"))
BOUND = 123
"""Number of ports that rules bound, all correctly, when this was written."""


def meant(table: Path) -> tuple[str, dict[str, str]]:
    """The program that a table is for, and its ports with their pins."""
    text = table.read_text()
    program = re.search(r"^# program (.+)$", text, re.MULTILINE)
    assert program is not None, f"{table.name} names no program"
    return program[1], dict(re.findall(r"^# port (\S+) = (\S+)$", text, re.MULTILINE))


def test_there_are_sixty_tables_for_sixty_programs() -> None:
    assert len(TABLES) == len({meant(table)[0] for table in TABLES}) == 60
    for table in TABLES:
        pins = list(meant(table)[1].values())
        assert pins
        assert len(pins) == len(set(pins))


def test_rules_bind_what_is_meant_and_leave_open_what_they_cannot_know() -> None:
    corpus = os.environ.get("ROBOSMI_CORPUS")
    if not corpus:
        pytest.skip("ROBOSMI_CORPUS does not name a folder with the corpus")
    counts: Counter[str] = Counter()
    wrong: list[str] = []
    for table in TABLES:
        program, truth = meant(table)
        plan = robosmi.plan_migration([Path(corpus) / program], hardware=table).plan
        wrong += [f"{table.stem}: {text}" for text in faults(plan)]
        for binding in plan.portBindings:
            named = {binding.name, *binding.names}
            wanted = next((pin for port, pin in truth.items() if port in named), "")
            pin = binding.pin.label if binding.pin is not None else ""
            state = "open" if binding.open else "none" if not pin else "right" if pin == wanted or not wanted else "wrong"
            counts[state] += 1
            if state == "wrong":
                wrong.append(f"{table.stem}: {binding.name} is bound to {pin}, and {wanted} is meant")
    print(dict(counts))
    assert wrong == []
    assert counts["right"] >= BOUND
    assert counts["open"] > 0


def faults(plan: migration.MigrationPlan) -> list[str]:
    """The errors of a plan in which nobody chose a pin."""
    pins = Counter(b.pin.label for b in plan.portBindings if b.pin is not None)
    found = [f"{count} ports are on {pin}" for pin, count in pins.items() if count > 1]
    found += [f"{b.name} is neither bound nor open nor none" for b in plan.portBindings if not b.open and not b.choice]
    assert plan.program is not None
    api = ApiIndex.load("propeller")
    reached = {use.pin for use in pin_uses(views(plan.program, api)) if use.pin is not None and use.origin != "convention"}
    listed = {b.sourcePin for b in plan.portBindings}
    return found + [f"P{pin} is used and not listed" for pin in sorted(reached - listed)]
