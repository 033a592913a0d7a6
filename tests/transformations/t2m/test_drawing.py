"""The builder of hardware models: what a reader of drawings may not tell is an error that says which, and is no `KeyError`."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from robosmi.errors import ModelError
from robosmi.transformations.knowledge.part import Part, PartConnector
from robosmi.transformations.t2m.drawing import CircuitBuilder, End, Placed
from robosmi.transformations.t2m.schematic import Schematic, SchematicNet, SchematicPart, circuit_of

LAMP = Part("Lamp", "LED", connectors={pin: PartConnector(pin, pin) for pin in ("A", "K")})


@pytest.fixture
def builder() -> CircuitBuilder:
    """A builder with two lamps placed, whose anodes are one net."""
    made = CircuitBuilder("robot.wires", "wires")
    made.know("Lamp", LAMP)
    for name in ("lamp1", "lamp2"):
        made.place(Placed(name, "Lamp", name, used=["A", "K"]))
    made.net([End("lamp1", "A"), End("lamp2", "A")])
    return made


@pytest.mark.parametrize(
    ("told", "cause"),
    [
        (lambda b: b.net([End("lamp1", "K"), End("lamp2", "A")]), r"puts 'lamp2\.A' into two nets: into 'lamp1\.A'"),
        (
            lambda b: b.net([End("lamp1", "K"), End("lmap2", "K")]),
            r"'lmap2\.K', but has not placed 'lmap2' \(did you mean 'lamp2'",
        ),
        (lambda b: b.net([End("lamp1", "C")]), r"'lamp1\.C', but 'lamp1' has no such connector"),
        (lambda b: b.net([]), "a net without a connector"),
        (lambda b: b.wire("w1", [End("lamp1", "A"), End("lamp3", "A")], None), r"'lamp3\.A', but has not placed 'lamp3'"),
        (lambda b: b.wire("w1", [("lamp1", "B")], None), r"'lamp1\.B', but 'lamp1' has no such connector"),
        (lambda b: b.place(Placed("lamp1", "Lamp")), "two components of the identity 'lamp1'"),
        (lambda b: b.place(Placed("lamp4", "Bulb")), r"part 'Bulb', .*know\(\)"),
    ],
)
def test_what_a_reader_may_not_tell_is_an_error_that_says_which(
    told: Callable[[CircuitBuilder], object], cause: str, builder: CircuitBuilder
) -> None:
    with pytest.raises(ModelError, match=cause) as refused:
        told(builder)
    assert refused.value.message.startswith("the reader of wires drawings ")
    assert refused.value.location is not None
    assert refused.value.location.path == "robot.wires"
    assert refused.value.fix


def test_a_net_of_a_schematic_with_a_part_that_is_not_there_is_an_error(builder: CircuitBuilder) -> None:
    drawn = Schematic("robot.wires", "", "Wires", parts=[SchematicPart("r1", "r1", "Resistor", "Resistor", pins={"1": "1"})])
    drawn.nets.append(SchematicNet("N1", [End("r1", "1"), End("r2", "1")]))
    with pytest.raises(ModelError, match=r"names the end 'r2\.1', but has no part 'r2'"):
        circuit_of(drawn, CircuitBuilder("robot.wires", "wires"))


def test_a_connector_that_a_defined_part_lacks_is_left_out_and_said() -> None:
    builder = CircuitBuilder("robot.wires", "wires")
    builder.know("Lamp", LAMP)
    component = builder.place(Placed("lamp", "Lamp", "lamp", used=["A", "B"], line=7))
    assert [c.connectorId for c in component.connectors] == ["A", "K"]
    found = [f for f in builder.findings if f.rule == "RS208"]
    assert [(f.severity.name, f.evidence["connectors"], f.location.line if f.location else 0) for f in found] == [
        ("warning", ["B"], 7)
    ]


def test_a_part_that_nothing_defines_has_the_connectors_that_are_used() -> None:
    builder = CircuitBuilder("robot.wires", "wires")
    builder.know("Gizmo")
    component = builder.place(Placed("g", "Gizmo", used=["B"]))
    assert [c.connectorId for c in component.connectors] == ["B"]
    assert [f for f in builder.findings if f.rule == "RS208"] == []


PAGE = Path(__file__).resolve().parents[3] / "docs" / "how-to" / "add-a-drawing-reader.md"


def test_the_page_for_authors_of_readers_has_every_call_of_the_builder_as_it_is() -> None:
    calls = {name: call for name, call in vars(CircuitBuilder).items() if inspect.isfunction(call) and not name.startswith("_")}
    told = re.findall(r"^CircuitBuilder\.(\w+)\((.*)\) -> (.*)$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    left_out = {"fault", "report_lacking"}  # for the readers of the package itself
    assert {name for name, _, _ in told} == {*calls} - left_out
    for name, arguments, result in told:
        signature = str(inspect.signature(calls[name])).replace("(self, ", "(")
        plain = re.sub(r"'([A-Za-z][^']*)'", r"\1", signature)
        assert plain == f"({arguments}) -> {result}"


@pytest.mark.parametrize("kind", [Part, Placed])
def test_the_page_says_what_each_field_means(kind: type[Part] | type[Placed]) -> None:
    table = PAGE.read_text(encoding="utf-8").partition(f"| field of `{kind.__name__}` |")[2].partition("\n\n")[0]
    told = {name for row in table.splitlines() for name in re.findall(r"`(\w+)`", row.split("|")[1] if "|" in row else "")}
    assert told == {*kind.__struct_fields__}
