"""All programs of the corpus through migrate and compile: none crashes, none loses an element, as many compile as were measured.

Runs where ROBOSMI_CORPUS names the folder in which the programs are laid out.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.corpus.migrate_corpus import run
from tests.tools import require_tools

MEASURED, COMPILED = 159, 156
"""Programs of the corpus, and how many of them compiled when this was written. The others are no C as they stand."""

BODIES = 0.95
"""Least share of the servable calls that must reach a body."""


def test_corpus() -> None:
    corpus = os.environ.get("ROBOSMI_CORPUS")
    if not corpus:
        pytest.skip("ROBOSMI_CORPUS does not name a folder with the corpus")
    require_tools("avr-gcc", "arduino-core-avr")
    table = run(Path(corpus))
    assert table.crashed() == []
    assert [(o.path, o.lost) for o in table.outcomes if o.lost] == []
    assert [(o.path, o.untrue) for o in table.outcomes if o.untrue] == []
    assert len(table.outcomes) >= MEASURED
    assert [said for o in table.outcomes for said in o.of_adapters] == []
    assert table.share >= BODIES, "\n".join(table.lines())
    assert table.count("compiled") >= len(table.outcomes) - (MEASURED - COMPILED), "\n".join(table.lines())
