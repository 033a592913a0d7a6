"""The paper's four steps as a chain, docs/examples/paper_chain: what it generates has the parts of Listing 3."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from robosmi.chain import read_chain
from robosmi.model.emf import EmfModel
from tests.running import run, tree

ROOT = Path(__file__).parents[2]
MADE = shutil.ignore_patterns("__pycache__", "build", "out", ".robosmi")
EIGHT = {"set_output", "set_direction", "waitcnt", "high", "low", "get_state", "drive_speed", "pause"}
PORTS = {
    "BasicServo2WriteP1": "8", "BasicServo1WriteP1": "9", "HIH40302ReadP1": "10", "HIH40301ReadP1": "11",
    "Red633nmLED1WriteP1": "12",
}  # fmt: skip


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """A copy of the chain's folder, with the program and the drawing beside it."""
    for name in ("paper_chain", "listing_1", "line_follower"):
        shutil.copytree(
            ROOT / "docs" / "examples" / name,
            tmp_path / name,
            ignore=shutil.ignore_patterns("__pycache__", "build", "out", ".robosmi"),
        )
    return tmp_path / "paper_chain"


def test_the_sketch_has_the_parts_of_listing_3(place: Path) -> None:
    outcome = run("run", place / "chain.toml", "--json")
    assert outcome.code == 0, outcome.err
    assert {step["state"] for step in outcome.result["steps"]} == {"done"}
    text = (place / "out" / "listing_1" / "listing_1.ino").read_text()
    assert re.findall(r"^#include (.*)$", text, re.MULTILINE) == ['"Arduino.h"', "<Servo.h>"]
    assert dict(re.findall(r"^const int (\w+P\d+) = (\d+);$", text, re.MULTILINE)) == PORTS
    assert set(re.findall(r"(\w+)\([^()]*\) \{\n  // TODO: complete method\n\}", text)) == EIGHT
    source = (place.parent / "listing_1" / "listing_1.c").read_text()
    own = source[source.index("long GetQTIState") : source.index("int main")].rstrip()
    assert own in text
    assert "const int leftQTI  = 6;" in text
    setup, loop = text[text.index("void setup()") :].split("void loop()")
    assert setup.split() == ["void", "setup()", "{", "}"]
    assert all(line.strip() in loop for line in source[source.index("while (1)") :].splitlines()[1:-3])


def test_the_model_before_the_text_is_xmi_and_a_second_run_changes_nothing(place: Path) -> None:
    read_chain(place / "chain.toml").run()
    model = EmfModel.load(place / "build" / "sketch.xmi", place / "sketch.ecore")
    library = model["Library"].all[0]
    assert (library.component, library.name, library.header) == ("Basic Servo1", "Servo", "Servo.h")
    assert library.rank > 0
    before = tree(place / "out")
    read_chain(place / "chain.toml").run()
    assert tree(place / "out") == before


def test_a_library_that_is_no_candidate_stops_the_chain(place: Path) -> None:
    selected = place / "libraries.csv"
    selected.write_text(selected.read_text().replace("Basic Servo2,Servo", "Basic Servo2,Sirvo"))
    outcome = run("run", place / "chain.toml", "--json")
    assert outcome.code == 1
    assert "'Sirvo' is no candidate for 'Basic Servo2'" in outcome.out
    assert not (place / "out").exists()
