"""The tables of docs/reference/wiring.md, made from the signatures and docstrings in the code.

`python -m tests.wiring_page` (make rules) writes the page anew; a test compares. What is around the tables is written by hand.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable
from pathlib import Path

from robosmi.transformations.constraints import (
    electrical_buses,
    electrical_loads,
    electrical_plan,
    electrical_signals,
    electrical_supply,
)
from robosmi.transformations.constraints.electrical_plan import is_drawn, of_plan, place, wired
from robosmi.transformations.constraints.electrical_signals import lacking
from robosmi.transformations.constraints.electrical_supply import takes_part, wiring_of
from robosmi.transformations.constraints.finding_locations import drawing, fault
from robosmi.transformations.knowledge.electrical_facts import DeviceFacts
from robosmi.transformations.queries.circuits.connector_names import displayed_name
from robosmi.transformations.queries.circuits.electrical import BoardPin, Wiring, listed, stated_volts, who
from robosmi.validate import EVL

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "reference" / "wiring.md"
_TABLE = re.compile(r"(?<=<!-- table: )(\w+)( -->\n)(?:\|[^\n]*\n)*")
_QUALIFIER = re.compile(r"\b(?:\w+\.)+(?=\w)")


def _summary(thing: object) -> str:
    text = inspect.getdoc(thing) or ""
    return " ".join(text.partition("\n\n")[0].split()).replace("|", "\\|")


def _type(annotation: str) -> str:
    return _QUALIFIER.sub("", annotation).replace("|", "\\|")


def _functions(functions: Iterable[Callable[..., object]], prefix: str = "") -> list[str]:
    rows = []
    for function in functions:
        signature = inspect.signature(function)
        parameters = ", ".join(
            f"{'**' * (p.kind is p.VAR_KEYWORD)}{p.name}{'' if p.default is p.empty else f'={p.default}'}"
            for p in signature.parameters.values()
            if p.name != "self"
        )
        result = _type(str(signature.return_annotation))
        rows.append(f"| `{prefix}{function.__name__}({parameters})` | `{result}` | {_summary(function)} |")
    return ["| call | result | meaning |", "|---|---|---|", *rows]


def _fields(struct: type) -> list[str]:
    described = dict(re.findall(r"^    (\w+): (.*(?:\n {8}.*)*)", inspect.getdoc(struct) or "", re.MULTILINE))
    rows = [
        f"| `{name}` | `{_type(str(annotation))}` | {' '.join(described.get(name, '').split())} |"
        for name, annotation in inspect.get_annotations(struct).items()
        if name[0] != "_"
    ]
    return ["| attribute | type | meaning |", "|---|---|---|", *rows]


def _modules() -> list[str]:
    sets: dict[str, tuple[object, tuple[EVL, ...]]] = {
        "electrical_supply": (electrical_supply, (electrical_supply.supply,)),
        "electrical_signals": (electrical_signals, (electrical_signals.signals,)),
        "electrical_loads": (electrical_loads, (electrical_loads.loads,)),
        "electrical_buses": (electrical_buses, (electrical_buses.buses,)),
        "electrical_plan": (electrical_plan, (electrical_plan.together, electrical_plan.by_index)),
    }
    rows = []
    for name, (module, rules) in sets.items():
        ids = sorted(constraint.id for each in rules for context in each.contexts for constraint in context.constraints)
        rows.append(f"| `{name}` | {_summary(module)} | {', '.join(ids)} |")
    return ["| module | what its constraints are on | rules |", "|---|---|---|", *rows]


def _methods() -> list[Callable[..., object]]:
    return [value for name, value in vars(Wiring).items() if inspect.isfunction(value) and name[0] != "_"]


_TABLES: dict[str, Callable[[], list[str]]] = {
    "modules": _modules,
    "functions": lambda: _functions([wiring_of, who, listed, displayed_name, stated_volts, takes_part, drawing, fault, lacking]),
    "plan": lambda: _functions([is_drawn, of_plan, wired, place]),
    "wiring": lambda: _functions(_methods(), "w."),
    "board_pin": lambda: _fields(BoardPin),
    "facts": lambda: _fields(DeviceFacts),
}


def filled(text: str) -> str:
    """The page with all tables as the code has them now."""
    found = re.findall(r"<!-- table: (\w+) -->", text)
    assert sorted(found) == sorted(_TABLES), "one place for each table"
    return _TABLE.sub(lambda match: match[1] + match[2] + "\n".join([*_TABLES[match[1]](), ""]), text)


if __name__ == "__main__":
    PAGE.write_text(filled(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
