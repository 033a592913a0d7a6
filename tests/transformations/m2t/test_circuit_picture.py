"""The picture of a circuit: well-formed SVG in which every connection and every component can be found."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from lxml import etree

from robosmi.transformations.chains.hardware import hardware
from robosmi.transformations.m2t import circuit_picture as circuit_picture_module
from robosmi.transformations.m2t.circuit_picture import circuit_picture
from robosmi.transformations.t2m.fritzing import read_circuit
from tests.tools import require_tools
from tests.transformations.t2m.fritzing.support import CASES, FIXTURES

SVG = "{http://www.w3.org/2000/svg}"
SKETCHES = [*CASES.values(), *sorted(p for p in FIXTURES.glob("*.fz") if p.stem != "nothing_connected")]


def texts(svg: str) -> list[str]:
    return [" ".join(str(t.xpath("string()")).split()) for t in etree.fromstring(svg.encode()).iter(f"{SVG}text")]


@pytest.mark.parametrize("path", SKETCHES, ids=lambda p: p.stem)
def test_every_sketch_can_be_drawn(path: Path) -> None:
    circuit, _ = read_circuit(path)
    picture = circuit_picture(circuit)
    boxes = {box.number: box for box in picture.boxes}
    for link in picture.links:
        for place in (link.one, link.other):
            assert place.row < len(boxes[place.box].rows)
        assert abs(boxes[link.one.box].column - boxes[link.other.box].column) <= 1  # no line passes a column of boxes


def test_graphviz_is_not_given_more_than_it_places_in_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = tmp_path / "dot"
    program.write_text("#!/bin/sh\ncat >/dev/null; echo '<svg>placed</svg>'\n")
    program.chmod(0o755)
    drawn = hardware(CASES["line_following_robot"])
    assert "placed" in drawn.picture(dot=str(program))
    monkeypatch.setattr(circuit_picture_module, "MOST_FOR_DOT", 3)
    assert "placed" not in drawn.picture(dot=str(program))


@pytest.mark.parametrize("dot", [False, True], ids=["own layout", "graphviz"])
def test_the_line_follower_as_a_picture(dot: bool) -> None:
    if dot:
        require_tools("dot")
    found = texts(hardware(CASES["line_following_robot"]).picture(dot=shutil.which("dot") if dot else None))
    for wanted in ("Arduino Uno", "Basic Servo1", "HIH4030 2", "Red (633nm)-LED1", "R1", "D8", "D12", "pulse", "GND", "5V", "9V"):
        assert wanted in found
    assert "Breadboard1" not in found


def test_links_are_the_signal_nets() -> None:
    circuit, _ = read_circuit(CASES["line_following_robot"])
    links = [link.text for link in circuit_picture(circuit).links]
    assert sorted(links) == [
        "Arduino Uno D10 - HIH4030 2 OUT",
        "Arduino Uno D11 - HIH4030 1 OUT",
        "Arduino Uno D12 - R1 Pin 0",
        "Arduino Uno D8 - Basic Servo2 pulse",
        "Arduino Uno D9 - Basic Servo1 pulse",
        "R1 Pin 1 - Red (633nm)-LED1 anode",
    ]


def test_titles_that_are_markup_do_no_harm() -> None:
    circuit, _ = read_circuit(FIXTURES / "one_sided.fz")
    circuit.components[0].title = '<script>"&\\\x07 -->'
    circuit.name = '</title><a href="x">'
    from robosmi.transformations.m2t.circuit_picture import svg

    for program in (None, shutil.which("dot")):
        assert any(text.startswith('<script>"&') for text in texts(svg(circuit, program)))


def test_a_program_that_fails_gives_way_to_the_own_layout() -> None:
    done = hardware(CASES["line_following_robot"])
    assert done.picture(dot="/no/such/program") == done.picture(dot=shutil.which("false")) == done.picture()
