"""Roles of parts as KiCad, EAGLE and Wokwi describe them: rules may not hang on the family words of one tool.

Each `TOOL.csv` lists parts with what that tool says of them (title, family, tags, description, names of connectors) and the role
that a person gave it before the rules were looked at.
"""

from __future__ import annotations

import csv
from pathlib import Path

import pytest
from msgspec.structs import replace

from robosmi.transformations.knowledge.part import ROLES, Part, PartConnector
from robosmi.transformations.knowledge.part_roles import classify

HERE = Path(__file__).parent
TABLES = sorted(HERE.glob("*.csv"))
BUILT_IN = ("eagle", "kicad", "wokwi")


def described(table: Path) -> list[tuple[Part, str]]:
    """The parts of a table with their roles."""
    with table.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file, delimiter=";"))
    return [
        (
            Part(
                row["id"],
                row["title"],
                row["family"],
                tuple(filter(None, row["tags"].split(","))),
                connectors={name: PartConnector(name, name) for name in row["connectors"].split(",") if name},
                tool=table.stem,
                description=row["description"],
            ),
            row["role"],
        )
        for row in rows
    ]


@pytest.mark.parametrize("table", TABLES, ids=lambda table: table.stem)
def test_parts_of_every_tool_get_the_role_that_a_person_gives_them(table: Path) -> None:
    found = [(part, role, classify(part)) for part, role in described(table)]
    assert len(found) >= (40 if table.stem in BUILT_IN else 10)
    assert {role for _, role, _ in found} <= {*ROLES}
    assert [f"{p.id}: {now.role} ({now.evidence}), not {role}" for p, role, now in found if now.role != role] == []
    assert all(now.evidence for _, _, now in found)


@pytest.mark.parametrize("table", TABLES, ids=lambda table: table.stem)
def test_the_sentence_about_a_part_alone_never_leads_to_a_wrong_role(table: Path) -> None:
    """A reader may have nothing but a sentence; the role is right or it is open, which is said, and no pin is lost in silence."""
    parts = [(replace(part, title=part.description, description=""), role) for part, role in described(table) if part.description]
    wrong = [f"{p.title}: {now.role}, not {role}" for p, role in parts if (now := classify(p)).role not in (role, "Unknown")]
    assert wrong == []


def test_a_remark_in_brackets_does_not_make_a_servo_a_connector() -> None:
    servo = Part("Motor:Motor_Servo", "Servo Motor (Futaba, HiTec, JR connector)", "Motor", tool="kicad")
    assert classify(servo).role == "Output"
    assert classify(replace(servo, title="Connector (for a servo motor)", family="Connector")).role == "Passive"


def test_families_of_one_tool_say_nothing_about_the_parts_of_another() -> None:
    part = Part("x", "Thing", "taiway 100", tool="fritzing")
    assert classify(part).role == "Input"
    assert classify(replace(part, tool="kicad")).role == "Unknown"


def test_a_supply_symbol_is_known_by_its_title_and_a_part_that_has_a_supply_is_not() -> None:
    assert classify(Part("x", "+5V", tool="kicad", connectors={"1": PartConnector("1", "+5V")})).role == "Power"
    many = {str(n): PartConnector(str(n)) for n in range(8)}
    assert classify(Part("x", "+5V", tool="kicad", connectors=many)).role == "Unknown"
