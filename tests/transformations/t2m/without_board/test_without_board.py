"""Schematics without a board: read with parts and nets, while no program is moved to them; and those with more than one."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi import plan_migration
from robosmi.errors import SourceError
from robosmi.transformations.chains.hardware import hardware
from tests.running import run
from tests.transformations.t2m.eagle import support as eagle
from tests.transformations.t2m.kicad import support as kicad

PROGRAM = Path(__file__).parents[4] / "docs" / "examples" / "line_follower" / "line_follower.c"


def sheet(tool: str, folder: Path) -> Path:
    """Two lamps on one net, and no board."""
    if tool == "kicad":
        return kicad.schematic(
            folder / "a.kicad_sch", kicad.led("D1", 100, 20), kicad.led("D2", 150, 20), kicad.wire(100, 20, 150, 20)
        )
    parts = [eagle.part("D1", "LED"), eagle.part("D2", "LED")]
    return eagle.schematic(folder, [eagle.device("LED", eagle.TWO, "LED")], parts, [eagle.net("A", "D1.1", "D2.1")])


@pytest.mark.parametrize("tool", ["eagle", "kicad"])
def test_a_sheet_without_a_board_is_read_and_no_program_is_moved_to_it(tool: str, tmp_path: Path) -> None:
    path = sheet(tool, tmp_path)
    outcome = run("hardware", path, "--json")
    assert outcome.code == 0
    result = outcome.document["result"]
    assert result["boards"] == result["mappings"] == []
    assert [c["title"] for c in result["components"]] == ["D1", "D2"]
    assert [{e["component"] for e in net["connectors"]} for net in result["nets"]] == [{"D1", "D2"}]
    assert [f["fix"] is not None for f in outcome.document["findings"] if f["rule"] == "RS229"] == [True]
    assert "net" in run("hardware", path).out
    refused = run("migrate", PROGRAM, "--hardware", path, "-o", tmp_path / "out")
    assert refused.code == 3
    assert "no board" in refused.err
    assert "\n  do: " in refused.err
    assert run("recommend", path).code == 3


def test_a_board_drawn_as_headers_is_an_error_and_no_program_is_moved_to_it(tmp_path: Path) -> None:
    parts = [eagle.part("J1", "PINHD-1X4", "POWER"), eagle.part("J2", "PINHD-1X4", "DIGITAL")]
    path = eagle.schematic(tmp_path, [eagle.device("PINHD-1X4", eagle.HEADER)], parts, [eagle.net("A", "J1.1", "J2.1")])
    outcome = run("hardware", path, "--json")
    assert outcome.code == 1
    assert [c["title"] for c in outcome.document["result"]["components"]] == ["J1", "J2"]
    assert [f["severity"] for f in outcome.document["findings"] if f["rule"] == "RS219"] == ["error"]
    with pytest.raises(SourceError, match="its headers") as refused:
        plan_migration([PROGRAM], hardware=path)
    assert "its own symbol" in str(refused.value.fix)


def two_boards(folder: Path) -> Path:
    """An Arduino Uno and a bare chip on one net, each with a lamp."""
    parts = [
        eagle.part("U1", "ARDUINO_UNO"),
        eagle.part("IC1", "CHIP", "ATMEGA328P"),
        eagle.part("D1", "LED"),
        eagle.part("D2", "LED"),
    ]
    libraries = [eagle.device("ARDUINO_UNO", eagle.UNO), eagle.device("CHIP", eagle.CHIP), eagle.device("LED", eagle.TWO, "LED")]
    nets = [
        eagle.net("A", "U1.D2", "IC1.PD2"), eagle.net("B", "U1.D9", "D1.1"), eagle.net("C", "IC1.PD7", "D2.1"),
        eagle.net("GND", "U1.GND@1", "IC1.GND", "D1.2", "D2.2"),
    ]  # fmt: skip
    return eagle.schematic(folder, libraries, parts, nets)


def test_a_chip_and_a_board_on_one_net_are_two_boards(tmp_path: Path) -> None:
    path = two_boards(tmp_path)
    made = hardware(path)
    assert [b["title"] for b in made.result["boards"]] == ["U1", "IC1"]
    assert [(m["board"], m["pin"], m["component"]) for m in made.result["mappings"]] == [("U1", "D9", "D1"), ("IC1", "D7", "D2")]
    with pytest.raises(SourceError, match=r"2 boards: 'U1' \(#U1\), 'IC1' \(#IC1\)") as refused:
        plan_migration([PROGRAM], hardware=path)
    assert '"#U1" = "Board"' in str(refused.value.fix)


@pytest.mark.parametrize(("board", "pin"), [("U1", "D9"), ("#IC1", "D7")])
def test_the_board_that_a_person_names_is_taken_with_its_connections_alone(board: str, pin: str, tmp_path: Path) -> None:
    path = two_boards(tmp_path)
    (tmp_path / "lamps.c").write_text('#include "simpletools.h"\nint main() { high(2); }\n')
    (tmp_path / "robosmi.toml").write_text(f'[roles]\n"{board}" = "Board"\n')
    outcome = run("migrate", tmp_path / "lamps.c", "--hardware", path, "-o", tmp_path / "out", "--json", "--yes")
    assert outcome.code == 0, outcome.err
    table = run("wiring", tmp_path / "out", "--as", "csv", "-o", tmp_path / "wiring.csv")
    assert table.code == 0
    assert [line.split(",")[0] for line in (tmp_path / "wiring.csv").read_text().splitlines() if ",D" in line] == [pin]


def test_where_no_part_is_a_board_the_unknown_one_is_named(tmp_path: Path) -> None:
    path = tmp_path / "a.fz"
    path.write_text(
        '<module><instances><instance moduleIdRef="acme_9000" modelIndex="7" path=""><title>Brain</title><views><breadboardView>'
        '<geometry z="1" x="0" y="0"/></breadboardView></views></instance></instances></module>'
    )
    with pytest.raises(SourceError, match="'Brain' \\(#7, acme_9000\\)") as refused:
        hardware(path)
    assert '"#7" = "Board"' in str(refused.value.fix)
