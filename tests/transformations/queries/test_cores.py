"""Which functions of the platform's libraries start code on another core: the table, by header, and what programs are told."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from robosmi import resources
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.platform_model import platform_part
from robosmi.transformations.queries.reports.analysis import analysis
from robosmi.transformations.t2m.c_source import read_program

TABLE = resources.built_in("platform_repo") / "propeller" / "cogs.toml"


@pytest.fixture(scope="module")
def api() -> ApiIndex:
    return ApiIndex.load("propeller")


def test_every_function_of_the_table_is_declared_in_its_header(api: ApiIndex) -> None:
    headers = tomllib.loads(TABLE.read_text(encoding="utf-8"))["headers"]
    assert len(headers) >= 30
    missing = [(h, n) for h, names in headers.items() for n in names if h not in {e.header for e in api.entries(n)}]
    assert missing == []
    assert all(names == sorted(set(names)) for names in headers.values())


@pytest.mark.parametrize(
    ("function", "header", "starts"),
    [
        ("drive_getTicks", "abdrive.h", False),
        ("drive_getTicks", "abdrive360.h", True),
        ("fdserial_open", "fdserial.h", True),
        ("cog_run", "simpletools.h", True),
        ("pause", "simpletools.h", False),
        ("ping_cm", "ping.h", False),
    ],
)
def test_a_function_starts_code_as_its_header_has_it(api: ApiIndex, function: str, header: str, starts: bool) -> None:
    assert api.starts_cog(function, header) is starts


def test_hidden_cogs_are_one_finding_a_header_at_the_first_call(api: ApiIndex, tmp_path: Path) -> None:
    path = tmp_path / "robot.c"
    path.write_text(
        '#include "simpletools.h"\n#include "servo360.h"\n#include "fdserial.h"\nint main(void)\n{\n'
        "  servo360_connect(12, 14);\n  servo360_angle(12, 90);\n  fdserial_open(9, 8, 0, 9600);\n}\n"
    )
    program, findings = read_program(path)
    findings.clear()
    analysis(program, findings, api)
    assert [(f.rule, f.message, f.location and f.location.line) for f in findings] == [
        ("RS108", "fdserial_open (fdserial.h) runs on its own core", 8),
        ("RS108", "servo360_angle, servo360_connect (servo360.h) run on their own core", 6),
    ]


def test_the_platform_model_says_it_too(api: ApiIndex) -> None:
    model = platform_part(api, ["drive_getTicks", "pause"], ["simpletools.h", "abdrive360.h"])
    assert {f.name: f.startsCog for h in model.headers for f in h.functions} == {"drive_getTicks": True, "pause": False}
