"""What every target must pass; a new target passes it by being listed (see `docs/architecture.md`).

The program of `program/` is moved to each target with a pin table that names no board: it is planned, generated, generated again
from the stored models, and compiled with the target's own toolchain.
"""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

import robosmi
from robosmi.errors import MissingToolError
from robosmi.plugins import registry
from robosmi.transformations.chains.stages.models import load_models
from robosmi.transformations.knowledge.platforms.target_platform import LANGUAGES, target_facts, target_names
from tests.running import tree
from tests.tiers import one_of_each
from tests.tools import NO_CORE, require_tools

PROGRAM = Path(__file__).parent / "program"


def chip_of(target: str) -> str:
    """The microcontroller of a target's board."""
    found = target_facts(target).board_model.microcontroller
    assert found is not None
    return str(found.name)


TARGETS = target_names()
OF_EACH_KIND = one_of_each(TARGETS, lambda name: (target_facts(name).model.generator, chip_of(name)))
"""One target of each generator and microcontroller; the tier `all` has the others."""
LABELS = {"pico": "GP", "picow": "GP", "esp32": "IO", "esp32c3": "IO"}
"""What boards call their pins, if not D0, D1 ..."""


@pytest.fixture(scope="module")
def moved(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Output folders by target, made when first asked for."""
    return {"": tmp_path_factory.mktemp("targets")}


def output(target: str, moved: dict[str, Path]) -> Path:
    """The program moved to a target."""
    if target not in moved:
        folder = moved[""] / target
        shutil.copytree(PROGRAM, folder / "input")
        for name in ("wiring.csv", "robosmi.toml"):
            path = folder / "input" / name
            path.write_text(re.sub(r"\bD(\d)\b", rf"{_letters(target)}\1", path.read_text()))
        robosmi.migrate([folder / "input" / "beacon.c"], folder / "out", target=target)
        moved[target] = folder / "out"
    return moved[target]


def _letters(target: str) -> str:
    return LABELS.get(str(target_facts(target).board_model.name), "D")


def test_all_boards_of_the_repository_are_targets() -> None:
    from robosmi.transformations.knowledge.board_models import board_names

    assert len(board_names()) >= 16
    assert set(board_names()) <= set(TARGETS)


@pytest.mark.parametrize("target", TARGETS)
def test_a_target_is_complete(target: str) -> None:
    model = target_facts(target).model
    assert model.platform is not None
    assert model.board is not None
    assert model.toolchain is not None
    assert model.generator in registry().names("generator")
    assert model.language in LANGUAGES
    assert model.fileSuffix.startswith(".")
    mapping = next(m for m in model.platform.boardMappings if m.board is model.board)
    assert {name.pin for name in mapping.pinNames} == set(model.board.pins)
    literals = [name.literal for name in mapping.pinNames]
    assert all(literals)
    assert len(literals) == len(set(literals))
    for name in filter(None, (mapping.boardId, *mapping.otherIds)):
        if target == model.board.name:
            assert target_facts(name).target == target


@pytest.mark.parametrize("target", OF_EACH_KIND)
def test_a_program_is_moved_and_a_second_run_changes_nothing(target: str, moved: dict[str, Path]) -> None:
    made = output(target, moved)
    facts = target_facts(target)
    models = load_models(made / "models" / "plan.xmi")
    assert [t.name for t in models.repository.targets] == [target]
    assert models.plan.board is models.repository.targets[0].board
    d = _letters(target)
    wired = [(c.pin.label, *c.pin.aliases) for c in models.plan.connections if c.pin]
    labels = ["A0", f"{d}3", f"{d}5"]
    assert sorted(next(label for label in labels if label in names) for names in wired) == labels
    assert not any(b.open for b in models.plan.portBindings)
    main = made / "beacon" / f"beacon{facts.model.fileSuffix}"
    assert main.is_file()
    assert ("int main(" in main.read_text()) == facts.preserves_main
    before = tree(made)
    robosmi.migrate([made.parent / "input" / "beacon.c"], made, target=target)
    assert tree(made) == before
    robosmi.generate_sketch(made / "models" / "plan.xmi", made)
    assert tree(made) == before


@pytest.mark.parametrize("target", OF_EACH_KIND)
def test_what_was_made_compiles_and_fits(target: str, moved: dict[str, Path]) -> None:
    require_tools("avr-gcc", "avr-g++", "avr-size", "arduino-core-avr", "arm-none-eabi-g++")
    if target in NO_CORE:
        with pytest.raises(MissingToolError) as caught:
            robosmi.compile_sketch(output(target, moved))
        assert "arduino-cli core install" in str(caught.value.fix)
        return
    report = robosmi.compile_sketch(output(target, moved))
    assert [str(d) for d in report.diagnostics if d.severity.name == "error"] == []
    assert report.ok
    assert report.fits
    assert report.board == target_facts(target).board
