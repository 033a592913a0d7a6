"""One number space per flow: each case is a program whose lines say behind `// =>` what they are in the sketch.

`robosmi.toml` of a case binds the ports that it binds; all others are open. Nothing is run here: what the numbers do is
measured in tests/adapters.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

import robosmi
from robosmi.metamodels import migration

CASES = Path(__file__).parent / "ports"
NAMES = sorted(path.name for path in CASES.iterdir())


def sources(name: str) -> list[Path]:
    """The C files of a case."""
    return sorted((CASES / name).glob("*.c"))


@cache
def planned(name: str) -> migration.MigrationPlan:
    """The plan of a case, which no test changes."""
    plan: migration.MigrationPlan = robosmi.plan_migration(sources(name)).plan
    return plan


def port(plan: migration.MigrationPlan, name: str) -> migration.PortBinding:
    """The binding of a port, by any of its names."""
    return next(b for b in plan.portBindings if name in (b.name, *b.names))


@pytest.mark.parametrize("name", NAMES)
def test_every_line_says_what_it_becomes(name: str, tmp_path: Path) -> None:
    made = robosmi.migrate(sources(name), tmp_path / "out", widths="keep").sketch
    lines = [line for path in sorted(made.iterdir()) for line in path.read_text().splitlines() if " // => " in line]
    said = {line.partition(" // => ")[2].strip() for p in (CASES / name).glob("*.[ch]") for line in p.read_text().splitlines()}
    assert len(lines) >= len(said - {""}) > 3
    for line in lines:
        text, _, wanted = line.partition(" // => ")
        assert text.strip() == wanted.strip()


@pytest.mark.parametrize("name", NAMES)
def test_a_flow_is_moved_or_looked_up_and_never_both(name: str) -> None:
    plan = planned(name)
    assert plan.portFlows
    for flow in plan.portFlows:
        assert flow.choice in ("target", "source")
        assert flow.evidence
        assert not (flow.choice == "target" and flow.changes)
    looked_up = {(c.unit.path, c.startOffset) for f in plan.portFlows for c in f.changes if c.unit is not None}
    moved = [(c.unit.path, c.startOffset, c.endOffset) for b in plan.portBindings for c in b.changes if c.unit is not None]
    assert not any(path == other and start <= at <= end for path, at in looked_up for other, start, end in moved)


@pytest.mark.parametrize("name", NAMES)
def test_no_two_ports_share_a_pin_and_each_number_is_one_port(name: str) -> None:
    plan = planned(name)
    pins = [b.pin.label for b in plan.portBindings if b.pin is not None]
    assert len(pins) == len(set(pins))
    numbers = [b.sourcePin for b in plan.portBindings if b.origin != "convention"]
    assert len(numbers) == len(set(numbers))
    names = [n for b in plan.portBindings for n in {b.name, *b.names}]
    assert len(names) == len(set(names))
    assert all(b.open or b.choice for b in plan.portBindings)


def test_every_port_that_a_program_reaches_is_listed() -> None:
    reached = {name: {b.sourcePin for b in planned(name).portBindings} for name in NAMES}
    assert reached["keypad"] == set(range(7))
    assert reached["tables"] == {12, 13, 14, 16, 17, 5, 6, 20, 21, 0}
    assert reached["macros"] == {7, 26, 5, 6, 11, 8}
    assert reached["macros_that_change"] == {3, 4, 5, 13, 14}
    assert reached["ranges"] == {*range(8, 16), 9, 26, 4, 5, 0, 1}
    steps = {2, 3}, {4, 5, 6}, {8, 9, 10}, {12, 13}, {20, 21}, {25, 26, 27}, {30}
    assert reached["stepped"] == set().union(*steps)
    assert reached["conventions"] == {7, 12, 13, 14}, (
        "encoders are no ports of a drive without them, but where a person binds one"
    )


def test_a_port_has_all_its_names_and_the_place_that_holds_it() -> None:
    plan = planned("looked_at")
    assert (port(plan, "P10").name, port(plan, "P10").element.line) == ("printed", 3)  # type: ignore[union-attr]
    assert port(plan, "P4").origin == "given"
    assert port(planned("conventions"), "P12").name == "abdrive.left_servo"
    assert port(planned("conventions"), "P13").name == "main.pin" or port(planned("conventions"), "P13").name == "pin"
    assert port(planned("conventions"), "abdrive.right_servo").sourcePin == 13


def reached_by(plan: migration.MigrationPlan) -> dict[str, set[int]]:
    """Function of the platform -> the numbers of ports that it is given."""
    found: dict[str, set[int]] = {}
    for flow in plan.portFlows:
        for call in flow.calls:
            found.setdefault(str(call.calleeName), set()).update(b.sourcePin for b in flow.bindings)
    return found


def test_members_of_one_name_in_two_records_are_two_flows() -> None:
    assert reached_by(planned("members")) == {
        "high": {5, 6}, "servo_angle": {16, 17}, "toggle": {7}, "freqout": {8}, "set_output": {9},
    }  # fmt: skip


def test_numbers_of_an_own_header_are_known_where_they_are_used() -> None:
    plan = planned("numbers_of_header")
    assert not [finding for finding in plan.findings if finding.rule == "RS327"]
    assert {b.name for b in plan.portBindings if b.origin == "convention" and "AD" in b.name} == {"AD1"}
    assert not plan.symbolUses, "the suffix of a number is no name"


@pytest.mark.parametrize("pin", ["GP9", "D9", "9"])
def test_a_pin_of_a_board_with_one_prefix_is_called_by_its_number_too(pin: str, tmp_path: Path) -> None:
    (tmp_path / "lamp.c").write_text('#include "simpletools.h"\nint main() { high(3); high(4); }\n')
    (tmp_path / "wiring.csv").write_text(f"pin,part,title\n{pin},Red LED,lamp\n")
    plan = robosmi.plan_migration([tmp_path / "lamp.c"], hardware=tmp_path / "wiring.csv", target="pico", bind={"P4": pin}).plan
    assert [(c.pin.label, c.component.title) for c in plan.connections if c.pin and c.component] == [("GP9", "lamp")]
    assert [b.pin.label for b in plan.portBindings if b.name == "P4" and b.pin] == ["GP9"]
    assert not [f for f in plan.findings if f.rule in ("RS223", "RS331")]
