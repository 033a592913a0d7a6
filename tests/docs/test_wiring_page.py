"""The page about the wiring's functions is the one that the code gives."""

from __future__ import annotations

import re

from robosmi.transformations.constraints.electrical import electrical
from robosmi.transformations.constraints.electrical_plan import by_index, together
from tests.wiring_page import PAGE, filled


def test_the_page_of_the_wiring_is_made_of_the_code() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert filled(text) == text, "run make rules"


def test_every_constraint_on_wiring_is_in_one_module_of_the_page() -> None:
    listed = re.findall(r"RS\d+", PAGE.read_text(encoding="utf-8"))
    contexts = [context for module in electrical.modules() for context in module.contexts] + [
        *together.contexts,
        *by_index.contexts,
    ]
    assert sorted(listed) == sorted(constraint.id for context in contexts for constraint in context.constraints)


def test_everything_on_the_page_has_a_meaning() -> None:
    rows = [line for line in PAGE.read_text(encoding="utf-8").splitlines() if line.startswith("| `")]
    assert len(rows) > 50
    assert [row for row in rows if row.endswith("|  |")] == []
