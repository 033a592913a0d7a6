"""Ten real programs with pin tables that we made up: the keyboard alone settles all choices on the page, and the sketch compiles.

The tables are those of `pin_tables`, in which two like parts are called by numbers, so that ports stay open. The programs are in
the corpus, which is not part of the project.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

import robosmi
from tests.corpus.test_pin_tables import TABLES, meant
from tests.page.conftest import Served, browser, serve
from tests.running import run

__all__ = ["browser", "serve"]  # fixtures
MOST = 10


def with_open_ports() -> list[Path]:
    """The tables in whose remarks two ports have parts of one name: those stay open."""
    return [table for table in TABLES if len(meant(table)[1]) > 1]


@pytest.mark.parametrize("table", with_open_ports()[:: max(1, len(with_open_ports()) // MOST)][:MOST], ids=lambda t: t.stem)
def test_the_keyboard_alone_settles_a_program(table: Path, serve: Callable[[Path], Served], tmp_path: Path) -> None:
    if "ROBOSMI_CORPUS" not in os.environ:
        pytest.skip("ROBOSMI_CORPUS does not say where the corpus is")
    program, pins = meant(table)
    source = tmp_path / Path(program).name
    source.write_bytes((Path(os.environ["ROBOSMI_CORPUS"]) / program).read_bytes())
    out = tmp_path / "out"
    robosmi.migrate([source], out, hardware=table, target="uno")
    page = serve(out)
    page.open()
    asked = 0
    while left := page.open_choices():
        kind, _, name = left[0].partition(":")
        offered = page.script(
            'return [...document.querySelectorAll(`[data-choice="${arguments[0]}"] [data-option]`)].map(e => e.dataset.option)',
            left[0],
        )
        wanted = pins.get(name, "none") if kind == "port" else offered[0]
        named = {c.pin.label: c.name for c in robosmi.load_model(out / "models" / "plan.xmi").connections if c.pin is not None}
        page.choose(left[0], named.get(wanted, wanted) if named.get(wanted, wanted) in offered else offered[0])
        asked += 1
    assert page.script("return document.getElementById('progress').dataset.open") == "0"
    if asked:
        assert (tmp_path / "robosmi.toml").is_file()
    outcome = run("migrate", source, "--hardware", table, "--target", "uno", "-o", out, "--json")
    assert outcome.code in (0, 1), outcome.err
    assert outcome.result["plan"]["open_choices"] == 0
    assert run("compile", out, "--json").result["ok"]
