"""What a drawing decides of the ports of a program: each case says which pin a port is bound to, or that it has to stay open."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import robosmi
from robosmi.metamodels import ccode, migration
from robosmi.transformations.m2m.ports import port_binding
from robosmi.transformations.queries.circuits.component_kinds import significant_words
from robosmi.transformations.queries.plans.choices import available_choices
from robosmi.transformations.queries.values import Values

CASES = sorted((Path(__file__).parent / "port_evidence").iterdir())


@pytest.mark.parametrize("case", CASES, ids=lambda path: path.name)
def test_evidence_binds_a_port_or_leaves_it_open(case: Path) -> None:
    wiring = case / "wiring.csv"
    wanted = dict(re.findall(r"^# port (\S+) = (\S+)$", wiring.read_text(), re.MULTILINE))
    plan = robosmi.plan_migration([case / "program.c"], hardware=wiring).plan
    found = {b.name: b.pin.label if b.pin is not None else "open" for b in plan.portBindings if b.open or b.pin is not None}
    assert {name: pin for name, pin in found.items() if name in wanted} == wanted
    for binding in plan.portBindings:
        if binding.pin is not None:
            assert binding.chosenBy is migration.ChosenBy.rule
            assert binding.evidence
            assert 0.8 <= binding.confidence < 1


@pytest.mark.parametrize(
    "case", [case for case in CASES if "# first " in (case / "wiring.csv").read_text()], ids=lambda path: path.name
)
def test_what_the_program_says_beside_an_open_port_orders_its_options(case: Path) -> None:
    wiring = case / "wiring.csv"
    wanted = dict(re.findall(r"^# first (.+?) = (\S+)$", wiring.read_text(), re.MULTILINE))
    plan = robosmi.plan_migration([case / "program.c"], hardware=wiring).plan
    pins = {c.name: c.pin.label for c in plan.connections if c.pin is not None}
    offered = {choice.subject: choice.options for choice in available_choices(plan) if choice.chosen is None}
    assert {name: pins.get(offered[name][0].value, offered[name][0].value) for name in wanted} == wanted
    assert all(len({option.value for option in options}) == len(options) for options in offered.values())
    assert all(offered[name][0].score < 0.5 for name in wanted)  # it only orders: nothing is decided by it


def test_what_another_port_has_is_offered_after_what_is_free_and_before_nothing() -> None:
    case = Path(__file__).parent / "port_evidence" / "comments_and_variables"
    plan = robosmi.plan_migration([case / "program.c"], hardware=case / "wiring.csv", bind={"P3": "D2"}).plan
    names = {c.pin.label: c.name for c in plan.connections if c.pin is not None}
    options = next(choice.options for choice in available_choices(plan) if choice.subject == "P4")
    values = [option.value for option in options]
    assert values[0] in (names["D3"], names["D4"])
    assert values[-2:] == [names["D2"], "none"]
    assert options[-2].why.startswith("used by port 'P3'")


def test_the_feedback_of_a_servo_is_an_encoder_where_a_person_binds_it(tmp_path: Path) -> None:
    case = Path(__file__).parent / "port_evidence" / "feedback_servos"
    bound = {"abdrive360.left_encoder": "D4", "abdrive360.right_encoder": "D5"}
    plan = robosmi.plan_migration([case / "program.c"], hardware=case / "wiring.csv", bind=bound).plan
    assert [f.rule for f in plan.findings if f.rule == "RS727"] == []
    drawn = {b.name: b.pin.label for b in plan.portBindings if b.pin is not None}
    assert (drawn["abdrive360.left_servo"], drawn["abdrive360.right_servo"]) == ("D9", "D10")


def test_a_channel_of_a_converter_is_offered_pins_that_measure() -> None:
    case = Path(__file__).parent / "port_evidence" / "channel_of_a_converter"
    plan = robosmi.plan_migration([case / "program.c"], hardware=case / "wiring.csv").plan
    channel = next(b for b in plan.portBindings if b.name == "AD2")
    offered = {o.value: o for choice in available_choices(plan) if choice.subject == "AD2" for o in choice.options}
    assert [o.label for o in channel.options] == ["Potentiometer2ReadP1"]
    assert offered["Potentiometer1ReadP1"].why == "drawn; D3 cannot measure a voltage"
    assert {name for name in offered if re.fullmatch(r"[AD]\d+", name)} == {"A0", "A2", "A3", "A4", "A5"}


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("PINBUTTON", {"button"}),
        ("redled", {"red", "led"}),
        ("leftServo", {"left", "servo"}),
        ("servoleft", {"servo", "left"}),
        ("ledger", {"ledger"}),
        ("LED2", {"led"}),
        ("spin", {"spin"}),
        ("NeoPixel Strip", {"neo", "pixel", "neopixel", "strip"}),
        ("XBee S2", {"xbee", "bee"}),
        ("FooBar", {"foo", "bar"}),
    ],
)
def test_names_are_taken_apart_where_all_of_them_is_known(name: str, words: set[str]) -> None:
    assert significant_words([name]) == words


def test_the_values_of_a_variable_are_read_once_for_all_tones(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Reading them again for each use made the cost quadratic."""
    made: list[ccode.SourceUnit] = []

    def counted(unit: ccode.SourceUnit) -> Values:
        made.append(unit)
        assert unit.program is not None
        return Values(unit.program, unit)

    monkeypatch.setattr(port_binding, "_values", counted)
    tones = "".join(f"freqout({port}, 5, hz); " for port in (4, 4, 5, 6))
    (tmp_path / "song.c").write_text(f'#include "simpletools.h"\nint hz = 440;\nint main() {{ {tones} }}\n')
    plan = robosmi.plan_migration([tmp_path / "song.c"]).plan
    assert (len(made), len(plan.portBindings)) == (1, 3)
