"""The real headers of the corpus, imported: against the facts that were collected of them without our parser.

Runs where ROBOSMI_CORPUS names the folder with the headers (`make corpus` fetches them); the facts are in `propeller_api.json`:
header -> its functions with signatures, macros, variables, constants, types. What stands behind conditions that do not hold is in
those facts and not in ours, so recall is below 1.
"""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest

from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.t2m.platform_headers import read_headers

RECALL = {"functions": 0.985, "macros": 0.975, "vars": 0.90, "consts": 1.0, "types": 0.985}
"""Recall required for each kind of declaration (measured: .990, .980, .925, 1.000, .989)."""


def test_the_real_headers() -> None:
    corpus = os.environ.get("ROBOSMI_CORPUS")
    folder = Path(corpus or "") / "parallaxinc"
    if not corpus or not (folder / "propgcc" / "lib" / "include").is_dir():
        pytest.skip("ROBOSMI_CORPUS does not name a folder with the platform's headers")
    facts: dict[str, Any] = json.loads((Path(__file__).parent / "propeller_api.json").read_text(encoding="utf-8"))
    api = ApiIndex.load("propeller")
    found = read_headers(folder, api)
    headers: dict[str, Any] = dict(found.headers)
    assert set(facts) <= set(headers)
    assert found.skipped == {}
    assert found.missing == []
    for kind, least in RECALL.items():
        labelled = {(header, name) for header, entry in facts.items() for name in entry[kind]}
        ours = {(header, name) for header in facts for name in headers[header].get(kind, ())}
        assert ours <= labelled, kind
        assert len(ours & labelled) >= least * len(labelled), (kind, len(ours & labelled) / len(labelled))
    registers = {name for entry in found.headers.values() for name in entry.get("registers", ())}
    assert set(api.settings["registers"]["names"]) <= registers
    assert {header: entry["kind"] for header, entry in found.headers.items() if header in facts} == {
        header: entry["kind"] for header, entry in facts.items()
    }
