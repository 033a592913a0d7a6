"""What the application writes, before real EMF: the models of both case studies load with 0 diagnostics and come out the same."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi import resources
from robosmi.metamodels import migration
from tests.emf_judge import judge_same

METAMODELS = [
    resources.built_in("metamodels") / f"{name}.ecore" for name in ("ccode", "hardware", "platform", "trace", "migration")
]


@pytest.mark.parametrize("example", ["line_follower", "environmental_monitoring"])
def test_the_models_of_a_migration_are_emfs_own_bytes(example: str, examples: Path, tmp_path: Path) -> None:
    robosmi.migrate([examples / example / f"{example}.c"], tmp_path / "out")
    models = sorted((tmp_path / "out" / "models").glob("*.xmi"))
    assert {path.name for path in models} >= {"plan.xmi", "code.xmi", "platform.xmi"}
    for path in models:
        judge_same(METAMODELS, path)


def test_models_made_by_hand_are_emfs_own_bytes(tmp_path: Path) -> None:
    option = migration.Option(label='<x> & "y"\n', score=float("inf"))
    for name, model in {"option.xmi": option, "score.xmi": migration.Option(label="x", score=1.5e-4)}.items():
        robosmi.save_model(model, tmp_path / name)
        judge_same(METAMODELS, tmp_path / name)
