"""Places that may behave differently, on public sketches with labels: precision and recall, and no crash.

ROBOSMI_SKETCHES names a folder with one for each program: `labels.json` (`board`, `traps`: kind -> ["FILE:LINE", ...]) and the
sketch's folder. The labels are for the Pico, made by rules over the text and partly read by eye.
"""

from __future__ import annotations

import json
import os
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from robosmi.transformations.chains.analyse import analyse
from robosmi.transformations.knowledge.platforms.portability_facts import portability_facts

FOLDER = os.environ.get("ROBOSMI_SKETCHES", "")
ENOUGH = 0.95
Places = set[tuple[str, str, str, int]]


def sketches() -> Iterator[tuple[Path, dict[str, Any]]]:
    """The main file of each program, with its labels."""
    for labels in sorted(Path(FOLDER).glob("*/labels.json")):
        files = sorted(file for ending in ("ino", "pde") for file in labels.parent.glob(f"*/*.{ending}"))
        main = [file for file in files if file.stem == file.parent.name] or files
        yield main[0], json.loads(labels.read_text())


@pytest.mark.exhaustive
@pytest.mark.skipif(not FOLDER, reason="ROBOSMI_SKETCHES names no folder of labelled sketches")
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
