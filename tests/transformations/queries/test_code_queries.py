"""Queries on the code model with the platform's API: paper listing, structure of main, pins, the contract's JSON."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from robosmi.diagnostics import Finding
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.platform_model import platform_part
from robosmi.transformations.queries import code
from robosmi.transformations.queries.flows.pin_uses import pin_uses
from robosmi.transformations.queries.programs.main_program import main_structure
from robosmi.transformations.queries.reports.analysis import analysis
from robosmi.transformations.t2m.c_source import read_program

PROGRAMS = Path(__file__).parent / "programs"
LISTING = Path(__file__).parents[1] / "t2m" / "c_source" / "listing1.c"
EIGHT = ["drive_speed", "get_state", "high", "low", "pause", "set_direction", "set_output", "waitcnt"]


@pytest.fixture(scope="module")
def api() -> ApiIndex:
    return ApiIndex.load("propeller")


def read(path: Path) -> Any:
    return read_program(path)[0]


def unit_json(path: Path, api: ApiIndex) -> tuple[dict[str, Any], list[Finding]]:
    program, findings = read_program(path)
    result = analysis(program, findings, api)
    assert json.loads(json.dumps(result)) == result
    return result["units"][0], findings


def test_the_eight_functions_of_the_listing(api: ApiIndex) -> None:
    program = read(LISTING)
    constructs = code.platform_dependent_constructs(program, api)
    assert constructs.names() == EIGHT
    assert constructs.unknown == []
    by_name = {f.name: f for f in constructs.functions}
    assert by_name["drive_speed"].header == "abdrive.h"
    assert by_name["drive_speed"].signature == "void drive_speed(int left, int right)"
    assert by_name["waitcnt"].entry is not None
    assert by_name["waitcnt"].entry.kind == "function_macro"
    assert by_name["drive_speed"].lines == [22, 24, 26, 30]
    assert not code.platform_agnostic_libraries(program, api)
    assert [i.header for i in code.platform_dependent_libraries(program, api)] == ["simpletools.h", "abdrive.h"]
    assert list(code.user_calls(program)) == ["GetQTIState"]


def test_structure_of_main(api: ApiIndex) -> None:
    program = read(PROGRAMS / "main_loop.c")
    main = main_structure(program.units[0])
    assert main is not None
    assert main.loop_kind == "while"
    assert [v.name for v in main.hoisted] == ["used", "shown", "later"]
    assert (len(main.before), len(main.after)) == (5, 2)
    assert [(e.kind, e.line) for e in main.exits] == [("break", 20), ("return", 21)]
    starts = [start for view in code.views(program, api) for start in code.cogs_of(view)]
    assert [(c.via, c.function) for c in starts] == [("cogstart", "worker"), ("cog_run", "worker")]


def test_own_definitions_win_and_locals_shadow(api: ApiIndex) -> None:
    unit, findings = unit_json(PROGRAMS / "main_loop.c", api)
    assert [c["name"] for c in unit["platform_calls"]] == [
        "cog_run",
        "cogstart",
        "fdserial_open",
        "low",
        "pause",
        "print",
        "waitcnt",
    ]
    assert {c["name"]: (c["count"], c["in_macro"]) for c in unit["platform_calls"]}["print"] == (0, True)
    assert {s["name"]: (s["kind"], s["lines"]) for s in unit["platform_symbols"]} == {
        "CLKFREQ": ("macro", [27]),
        "CNT": ("register", [22, 27]),
        "DIRA": ("register", [27]),
        "ms": ("variable", [22]),
    }
    assert [t["name"] for t in unit["platform_types"]] == ["fdserial"]
    assert unit["standard_calls"] == [{"name": "strlen", "header": "string.h", "explicit_include": False}]
    assert {c["name"]: c["count"] for c in unit["user_calls"]} == {"high": 1}
    assert {c["name"]: c["signature"] for c in unit["unknown_calls"]} == {
        "nowhere": "void nowhere(const char *, ...)",
        "own": "void own(int)",
    }
    assert sorted(f.rule for f in findings) == ["RS108", "RS109", "RS109"]
    assert unit["coverage"]["unresolved"] == []


def test_pin_uses(api: ApiIndex) -> None:
    uses = [(u.function, u.pin, u.direction, u.origin) for u in pin_uses(code.views(read(PROGRAMS / "pins.c"), api))]
    expected: list[tuple[str, int | None, str, str]] = [
        *[("freqout", 4, "out", "literal"), ("freqout", 5, "out", "constant")],
        ("low", None, "out", "runtime"),
        *[("high", 24, "out", "array"), ("high", 25, "out", "array")],
        *[
            ("high", 26, "out", "literal"),
            ("high", 17, "out", "literal"),
            ("low", 26, "out", "constant"),
            ("input", 10, "in", "constant"),
        ],
        *[("toggle", pin, "out", "constant") for pin in (16, 17, 18)],
        *[("set_outputs", pin, "out", "literal") for pin in (1, 2, 3)],
        ("high", 21, "out", "array"),
        *[("low", pin, "out", "array") for pin in (20, 21, 22, 23)],
        *[("input", None, "in", "runtime"), ("get_state", 12, "in", "constant")],
        *[("keypad_setup", pin, "out", "array") for pin in (20, 21, 22, 23)],
        *[("keypad_setup", pin, "in", "array") for pin in (24, 25)],
        ("set_direction", 6, "unknown", "constant"),
        *[("fdserial_open", 12, "in", "literal"), ("fdserial_open", 12, "out", "literal")],
        *[("drive_speed", 12, "out", "convention"), ("drive_speed", 13, "out", "convention")],
        *[("drive_speed", 14, "in", "convention"), ("drive_speed", 15, "in", "convention")],
    ]
    assert uses == expected


def test_the_platform_model_of_some_names(api: ApiIndex) -> None:
    model = platform_part(api, [*EIGHT, "CNT", "no_such_name"], ["simpletools.h", "abdrive.h"])
    functions = {str(f.name): f for h in model.headers for f in h.functions}
    assert sorted(functions) == EIGHT
    assert functions["pause"].blocking
    assert [p.meaning.name for p in functions["high"].parameters] == ["pin"]
    assert [p.direction.name for p in functions["get_state"].parameters] == ["input"]
    assert [p.meaning.name for p in functions["waitcnt"].parameters] == ["ticks"]
    assert [c.pin for c in functions["drive_speed"].conventions] == [12, 13, 14, 15]
    assert [(str(s.name), s.symbolKind.name, str(s.typeName)) for h in model.headers for s in h.symbols] == [
        ("CNT", "register", "unsigned int")
    ]


def test_one_name_in_several_headers(api: ApiIndex) -> None:
    for header in ("abdrive.h", "abdrive360.h", "arlodrive.h"):
        entry = api.resolve("drive_speed", ["simpletools.h", header])
        assert entry is not None
        assert entry.header == header
    assert api.header_kind("unistd.h") == "posix"
    assert api.header_kind("stdio.h") == "standard"
    assert api.header_kind("mine.h") is None
    assert api.resolve("strlen", ["simpletools.h"]) is not None
    assert api.resolve("no_such_name", []) is None
