"""The labelled real programs against the judge that is not part of the project: every field of every program right.

Runs where ROBOSMI_CORPUS names the folder in which the programs are laid out and the shared labels are beside the project.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.reports.analysis import analysis
from robosmi.transformations.t2m.c_source import read_program
from tests.bench.c_source import headers

LEAST_RIGHT = 1.0


@pytest.mark.parametrize("with_headers", [False, True])
def test_labelled_programs(with_headers: bool, shared: Path, tmp_path: Path) -> None:
    corpus = os.environ.get("ROBOSMI_CORPUS")
    if not corpus:
        pytest.skip("ROBOSMI_CORPUS does not name a folder with the labelled programs")
    api = ApiIndex.load("propeller")
    folders = headers() if with_headers else []
    ids = []
    for label in sorted((shared / "propeller" / "programs").glob("*.json")):
        facts = json.loads(label.read_text())
        source = Path(corpus) / facts["repo"] / facts["path"]
        if source.is_file():
            program, findings = read_program(source, include_dirs=folders)
            (tmp_path / label.name).write_text(json.dumps({"result": analysis(program, findings, api)}))
            ids.append(label.stem)
    assert ids
    (tmp_path / "ids").write_text("\n".join(ids))
    judge = [sys.executable, str(shared / "propeller" / "score.py"), str(tmp_path), "--ids", str(tmp_path / "ids"), "--json"]
    result = json.loads(subprocess.run(judge, capture_output=True, check=True, text=True).stdout)
    assert result["wrong"] == {} or result["all_right"] >= LEAST_RIGHT * len(ids), result["wrong"]
