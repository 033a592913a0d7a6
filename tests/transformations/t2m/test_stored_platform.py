"""The part of a source platform that is stored with a plan answers about its program as the repository does."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.metamodels import platform
from robosmi.model import load_model
from robosmi.model.xmi.xmi_writer import to_xmi
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.platform_model import platform_part
from robosmi.transformations.queries.code import views
from robosmi.transformations.queries.flows.cores import Cores
from robosmi.transformations.queries.reports.analysis import analysis
from robosmi.transformations.queries.source_text import words_of
from robosmi.transformations.t2m.c_source import read_program

ROOT = Path(__file__).parents[3]
PROGRAMS = [
    *sorted((ROOT / "docs" / "examples").glob("*/*.c")),
    *sorted((ROOT / "tests" / "transformations" / "queries" / "programs").glob("*.c")),
    *sorted((ROOT / "tests" / "transformations" / "m2m" / "programs").glob("*.c")),
]


def stored(api: ApiIndex, path: Path, folder: Path) -> ApiIndex:
    """The index over what is stored of a platform for one program, written and read again."""
    program, _ = read_program(path)
    unit = program.units[0]
    includes = tuple(str(i.header) for i in unit.includes)
    part = platform_part(api, [], includes, words_of([path.read_bytes()]), [includes])
    root = platform.PlatformRepository(platforms=[part])
    for name, data in to_xmi({"platform.xmi": root}, ["platform.xmi"]).items():
        (folder / name).write_bytes(data)
    return ApiIndex.of(load_model(folder / "platform.xmi").platforms[0])


def answers(path: Path, api: ApiIndex) -> Any:
    """What the queries say of a program."""
    program, findings = read_program(path)
    seen = views(program, api)
    cores = Cores(seen)
    return analysis(program, findings, api), [v.types() for v in seen], vars(cores).keys()


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda p: p.stem)
def test_the_analysis_of_a_program_is_the_same_with_what_is_stored(path: Path, tmp_path: Path) -> None:
    api = ApiIndex.load("propeller")
    assert answers(path, stored(api, path, tmp_path)) == answers(path, api)


def test_pins_and_meanings_survive(tmp_path: Path) -> None:
    """Every function of the platform with all that is known of it."""
    api = ApiIndex.load("propeller")
    names = sorted({name for name, _ in api._facts.pins} | set(api._facts.functions))
    headers = tuple(api._facts.headers)
    again = ApiIndex.of(platform_part(api, [], headers, names, [headers]))
    assert len(names) > 100
    for (name, header), facts in api._facts.pins.items():
        if any(entry.header == header for entry in api.entries(name)):
            found = again.pins(name, header)
            assert found is not None, (name, header)
            assert [p._replace(name="") for p in found.parameters] == [p._replace(name="") for p in facts.parameters], name
            assert found.conventions == facts.conventions
    for name in names:
        assert sorted(again.entries(name)) == sorted(api.entries(name))
        assert again.code_argument(name) == api.code_argument(name)
        assert bool(again.meaning(name).get("blocking")) == bool(api.meaning(name).get("blocking")) or not api.entries(name)
        for entry in api.entries(name):
            assert again.starts_cog(name, entry.header) == api.starts_cog(name, entry.header)
