"""A program on demand and its stored model: queries, constraints and the partition give the same answer on both.

The case studies and every twentieth C program of the tests, every fifth in the tier `all`. `tests/fuzz/two_views.py` compares
all, and a corpus.
"""

from __future__ import annotations

import pytest

from robosmi.model import EmfModel, Model
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.t2m.c_source import read_program
from robosmi.transformations.t2m.c_source.on_demand import open_program
from tests.fuzz.two_views import ROOT, differences, programs
from tests.tiers import sample


@pytest.mark.parametrize(("step", "least"), sample([(20, 15), (5, 40)], 1))
def test_every_answer_is_the_same_on_both_views(step: int, least: int) -> None:
    api = ApiIndex.load("propeller")
    own = [path for path in programs() if path.is_relative_to(ROOT)]
    studies = [path for path in own if path.is_relative_to(ROOT / "docs")]
    share = [*studies, *own[len(studies) :: step]]
    found = {path: differences(path, api) for path in share}
    compared = {path: wrong for path, wrong in found.items() if wrong is not None}
    assert {path: wrong for path, wrong in compared.items() if wrong} == {}
    assert len(compared) > least


def test_ids_are_the_same_on_both_views_and_in_another_run() -> None:
    path = ROOT / "docs" / "examples" / "line_follower" / "line_follower.c"
    models: list[Model] = [open_program(path), EmfModel(read_program(path)[0]), open_program(path)]
    ids = [[model.id_of(e) for e in model.all_contents()] for model in models]
    assert len(set(ids[0])) == len(ids[0]) > 100
    assert ids[0] == ids[1] == ids[2]
