"""Ten real programs with pin tables that we made up for this: the keyboard alone settles all choices, and the sketch compiles.

Like parts are called by numbers in the tables, so that ports stay open. The programs are in the corpus, which is not part of the
project; what is meant for each port stands in remarks of its table.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

import robosmi
from tests.corpus.test_pin_tables import TABLES as OTHERS, meant
from tests.page.browsers import Served
from tests.page.conftest import browser, serve
from tests.running import run

__all__ = ["browser", "serve"]  # fixtures
TABLES = sorted((Path(__file__).parent / "page_tables").glob("*.csv"))


def test_there_are_ten_tables_for_ten_programs_of_their_own() -> None:
    programs = {meant(table)[0] for table in TABLES}
    assert len(TABLES) == len(programs) == 10
    assert not programs & {meant(table)[0] for table in OTHERS}


def corpus() -> Path:
    """The folder with the programs."""
    if "ROBOSMI_CORPUS" not in os.environ:
        pytest.skip("ROBOSMI_CORPUS does not say where the corpus is")
    return Path(os.environ["ROBOSMI_CORPUS"])


@pytest.mark.parametrize("table", TABLES, ids=lambda t: t.stem)
def test_the_keyboard_alone_settles_a_program(table: Path, serve: Callable[[Path], Served], tmp_path: Path) -> None:
    program, pins = meant(table)
    source = tmp_path / Path(program).name
    source.write_bytes((corpus() / program).read_bytes())
    out = tmp_path / "out"
    robosmi.migrate([source], out, hardware=table, target="uno")
    named = {c.pin.label: c.name for c in robosmi.load_model(out / "models" / "plan.xmi").connections if c.pin is not None}
    page = serve(out)
    page.open()
    settled: list[str] = []
    while left := page.open_choices():
        kind, _, name = left[0].partition(":")
        settled += [name] if kind == "port" else []
        page.choose(left[0], named.get(pins[name], pins[name]) if kind == "port" else page.offered(left[0])[0])
    assert page.script("return document.getElementById('progress').dataset.open") == "0"
    assert (tmp_path / "robosmi.toml").is_file()
    again: list[str | Path] = ["migrate", source, "--hardware", table, "--target", "uno", "-o", out, "--json"]
    outcome = run(*again)
    assert outcome.code in (0, 1), outcome.err
    assert outcome.result["plan"]["open_choices"] == 0
    bound = {n: b["pin"] for b in outcome.result["plan"]["bindings"] for n in (b["name"], *b["names"])}
    assert {name: bound[name] for name in pins} == pins
    assert run("compile", out, "--json").result["ok"]
    taken = pins[settled[1]]
    page.open()
    page.choose(f"port:{settled[0]}", named.get(taken, taken))
    assert f"both bound to pin {taken}" in page.script("return document.getElementById('check').textContent")
    wrong = run(*again)
    assert "RS702" in wrong.rules()
