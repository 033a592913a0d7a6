"""A platform's folder is a model like any other: opened by its path, asked by queries, as complete as its data."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from robosmi import resources
from robosmi.errors import SourceError
from robosmi.model.opening import drivers, open_model
from tests.running import run

REPOSITORY = resources.built_in("platform_repo")


def test_a_source_platform_has_every_declaration_of_its_data() -> None:
    model = open_model(REPOSITORY / "propeller")
    data = json.loads((REPOSITORY / "propeller" / "api.json").read_text(encoding="utf-8"))["headers"]
    headers = {header.name: header for header in model["Header"].all_of_type}
    for name, content in data.items():
        functions = {*content.get("functions", ()), *(m for m, like in content.get("macros", {}).items() if like)}
        assert {f.name for f in headers[name].functions} == functions, name
        assert {t.name for t in headers[name].types} == {*content.get("types", ())} - functions, name
    assert len(headers) > 100


def test_a_target_platform_has_its_boards() -> None:
    model = open_model(REPOSITORY / "arduino" / "platform.toml", "platform")
    boards = {board.name for board in model["Board"].all_of_type}
    assert boards == {path.stem for path in (REPOSITORY / "arduino" / "boards").glob("*.toml")}
    assert {mapping.board.name for mapping in model["BoardMapping"].all_of_type} == boards
    assert model["Microcontroller"].all_of_type
    assert "platform" in drivers()
    assert not [name for name in drivers() if "/" in name]


def test_a_platform_that_is_both_is_one_with_all_that_both_declare() -> None:
    model = open_model(REPOSITORY / "arduino", "platform")
    (both,) = model["Platform"].all_of_type
    data = json.loads((REPOSITORY / "arduino" / "api.json").read_text(encoding="utf-8"))["headers"]
    declared = {header.name: {function.name for function in header.functions} for header in both.headers}
    for name, content in data.items():  # a constructor and a conversion have no type of a result, and so no signature
        assert {f for f, (result, _) in content.get("functions", {}).items() if result} <= declared[name], name
    assert both.widths
    assert both.boardMappings


def test_a_query_asks_a_platform() -> None:
    question = "ApiFunction.all.select(lambda f: f.blocking and f.name == 'pause').signature"
    outcome = run("query", REPOSITORY / "propeller", question)
    assert (outcome.code, outcome.out.strip()) == (0, "void pause(int time)")
    outcome = run("query", REPOSITORY / "arduino", "Board.all.select(lambda b: b.volts < 4).name")
    assert "fio" in outcome.out


def test_another_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match=r"has no platform\.toml"):
        open_model(tmp_path, "platform")
