"""Public sketches with labels: places that may behave differently, moves to the Pico that compile, moves that change nothing.

ROBOSMI_SKETCHES names a folder with one for each program: `labels.json` (`board`, `traps`: kind -> ["FILE:LINE", ...],
`compiles_avr`) and the sketch's folder. The labels are for the Pico, made by rules over the text and partly read by eye.
ROBOSMI_LIBRARIES has the libraries that are at hand: a sketch of which a header is missing is not judged by the compiler.
"""

from __future__ import annotations

import json
import os
import re
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.transformations.chains.analyse import analyse
from robosmi.transformations.knowledge.platforms.portability_facts import portability_facts
from robosmi.verify.toolchains.compile_report import COMPILER_ERROR, MISSING_HEADER
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tools import require_tools

FOLDER = os.environ.get("ROBOSMI_SKETCHES", "")
ENOUGH = 0.95
needs_sketches = pytest.mark.skipif(not FOLDER, reason="ROBOSMI_SKETCHES names no folder of labelled sketches")
Places = set[tuple[str, str, str, int]]


def sketches() -> Iterator[tuple[Path, dict[str, Any]]]:
    """The main file of each program, with its labels."""
    for labels in sorted(Path(FOLDER).glob("*/labels.json")):
        files = sorted(file for ending in ("ino", "pde") for file in labels.parent.glob(f"*/*.{ending}"))
        main = [file for file in files if file.stem == file.parent.name] or files
        yield main[0], json.loads(labels.read_text())


@pytest.mark.exhaustive
@needs_sketches
def test_places_agree_with_the_labels() -> None:
    facts = portability_facts("arduino")
    assert facts is not None
    found: Places = set()
    wanted: Places = set()
    for main, labels in sketches():
        places = analyse([main], source_board=labels["board"], target="pico").result["portability"]
        name = labels["id"]
        found |= {(name, p["kind"], os.path.relpath(p["path"], main.parent), p["line"]) for p in places}
        for kind in facts.kinds:
            for place in labels["traps"].get(kind, []):
                file, _, line = place.rpartition(":")
                wanted.add((name, kind, file, int(line)))
    wrong: dict[str, list[str]] = defaultdict(list)
    for name, kind, file, line in sorted(found ^ wanted):
        wrong[kind].append(f"{name} {file}:{line}")
    assert wanted
    assert len(found & wanted) >= ENOUGH * len(found), dict(wrong)
    assert len(found & wanted) >= ENOUGH * len(wanted), dict(wrong)


@pytest.mark.exhaustive
@needs_sketches
def test_each_sketch_moves_to_the_pico_and_compiles_or_says_where_it_does_not(tmp_path: Path) -> None:
    """What a compiler refuses is at a line with a finding, or in a library whose include is one."""
    require_tools("arm-none-eabi-gcc", "arm-none-eabi-g++")
    judged, silent = 0, []
    for main, labels in sketches():
        moved = robosmi.migrate([main], tmp_path / labels["id"], target="pico", source_board=labels["board"])
        assert any(moved.sketch.glob("*.ino"))
        if not labels["compiles_avr"]:
            continue
        report = compile_sketch(tmp_path / labels["id"], "pico")
        if any(finding.rule == MISSING_HEADER for finding in report.diagnostics):
            continue
        judged += 1
        found = {(_key(f.location.path), f.location.line) for f in moved.findings if f.location is not None}
        foreign = any("unsuitable_library" in f.message for f in moved.findings)
        errors = [f.location for f in report.diagnostics if f.rule == COMPILER_ERROR and f.location is not None]
        own = [each for each in errors if Path(each.path).is_relative_to(moved.sketch)]
        more = {_key(path.name): _lines(path) - _lines(at) for path in moved.sketch.rglob("*") if (at := _source_of(path, main))}
        unsaid = [e for e in own if (_key(e.path), (e.line or 0) - more.get(_key(e.path), 0)) not in found]
        if unsaid or (len(own) < len(errors) and not foreign) or (not report.ok and not errors):
            silent.append(f"{labels['id']}: {unsaid[:3] or report.diagnostics[:1]}")
    assert judged
    assert len(silent) <= (1 - ENOUGH) * judged, silent


def _lines(path: Path) -> int:
    return path.read_bytes().count(b"\n")


def _source_of(path: Path, main: Path) -> Path | None:
    """The file of a sketch from which one of the moved sketch was made."""
    return next((each for each in main.parent.rglob("*") if each.is_file() and _key(each.name) == _key(path.name)), None)


def _key(path: str) -> str:
    """The name of a file without what its sketch's new name changes."""
    return re.sub(r"\W", "_", Path(path).stem)


@pytest.mark.exhaustive
@needs_sketches
def test_a_sketch_for_the_uno_stays_as_it_is_on_a_nano(tmp_path: Path) -> None:
    changed = []
    for main, labels in sketches():
        if labels["board"] != "uno" or not labels["compiles_avr"]:
            continue
        moved = robosmi.migrate([main], tmp_path / labels["id"], target="nano", source_board="uno")
        before, after = main.read_bytes().split(), next(iter(moved.sketch.glob("*.ino"))).read_bytes().split()
        if before != after:
            changed.append(f"{labels['id']}: {[each for each in after if each not in before][:5]}")
    assert not changed
