"""The line follower with other texts: titles of the drawing's parts, and the texts that a model keeps of parts and connectors."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

import robosmi
from robosmi.transformations.m2t.arduino_sketch import generate
from robosmi.transformations.m2t.first_screen import counted
from robosmi.transformations.m2t.program_files import report_file
from tests.quoting.judges import tokens

EXAMPLE = Path(__file__).resolve().parents[2] / "docs" / "examples" / "line_follower"
DRAWN = ("Basic Servo1", "Basic Servo2", "HIH4030 1", "HIH4030 2", "VCC1", "R1", "Red (633nm)-LED1")
PORTS = {"leftQTI": "D10", "rightQTI": "D11", "LED": "D12", "P12": "D8", "P13": "D9"}
"""What is bound to which pin, so that no title has to say so."""
NAME = re.compile(r"\w+(?:Read|Write|Bus)P\d+(?:_\d+)?")
"""A name that is made from a title."""


def plan_with_titles(folder: Path, titles: Sequence[str]) -> Any:
    """The models of a migration whose drawing has these titles; what no XML may hold becomes U+FFFD."""
    with zipfile.ZipFile(EXAMPLE / "line_following_robot.fzz") as archive:
        text = archive.read("line_following_robot.fz").decode()
    for old, title in zip(DRAWN, titles, strict=False):
        fit = re.sub("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]", "\ufffd", title)
        text = text.replace(f"<title>{old}</title>", f"<title>{escape(fit, {chr(10): '&#10;', chr(13): '&#13;'})}</title>")
    program, drawing = folder / "line_follower.c", folder / "drawing.fz"
    program.write_bytes((EXAMPLE / "line_follower.c").read_bytes())
    drawing.write_text(text, encoding="utf-8", newline="")
    return robosmi.plan_migration([program], hardware=drawing, bind=PORTS)


def with_texts(models: Any, text: Callable[[], str]) -> None:
    """Replace all texts in the models that a stranger could set, except names of the program and of the target."""
    for component in models.circuit.components:
        component.title, component.partTitle = text(), text()
        for connector in component.connectors:
            connector.name = text()
    for unit in models.program.units:
        kept = unit.path
        unit.path = f"source/{text().replace('/', '')}.c"
        models.files[unit.path] = models.files.pop(kept)
    for entry in (*models.plan.tasks, *models.plan.findings):
        entry.message, entry.fix = text(), text()
    for binding in models.plan.portBindings:
        binding.what = text()
    for use in models.plan.adapterUses:
        use.notes.extend([text()])


def texts_of(models: Any) -> dict[str, str]:
    """The files of the sketch, by their names without the folder."""
    plan, sources = models.plan, models.files
    files = [*generate(plan, sources).files, *report_file(plan, sources, counted(plan, sources)).files]
    return {file.name.rpartition("/")[2]: file.after or "" for file in files}


def shape_of(texts: dict[str, str]) -> dict[str, list[str]]:
    """The tokens of each file of code, with one word for all names that are made from titles."""
    found = {}
    for name, text in texts.items():
        if name.endswith((".ino", ".h", ".cpp")):
            found[name] = ["NAME" if NAME.fullmatch(word) else word for word in tokens(text, "x.cpp", "-std=c++11")]
    return found


def declared_names(sketch: str) -> list[str]:
    """The constants for the ports, in order."""
    return re.findall(rf"^const int ({NAME.pattern}) = \d+;", sketch, re.MULTILINE)
