"""The labelled real programs: every field of every program that is there is right.

Runs where the programs are laid out: `make corpus`, or a folder that ROBOSMI_CORPUS names.
"""

from __future__ import annotations

import json

import pytest

from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.reports.analysis import analysis
from robosmi.transformations.t2m.c_source import read_program
from tests.bench.c_source import headers
from tests.evaluation.scoring.programs import Score, labelled_programs
from tests.evaluation.sources import FETCH, corpus_folder, program_file


@pytest.mark.parametrize("with_headers", [False, True])
def test_labelled_programs(with_headers: bool) -> None:
    corpus = corpus_folder()
    if corpus is None:
        pytest.skip(f"the labelled programs are not there: {FETCH}")
    api, folders, score = ApiIndex.load("propeller"), headers() if with_headers else [], Score()
    for label in labelled_programs():
        if (source := program_file(label, corpus)) is not None:
            program, findings = read_program(source, include_dirs=folders)
            score.add(label, json.loads(json.dumps(analysis(program, findings, api)))["units"])
    assert score.programs
    assert score.wrong == {}
