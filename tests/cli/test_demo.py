"""`robosmi demo`: the shipped example in a folder of the user's, without a compiler; what it cannot do is told."""

from __future__ import annotations

import socket
import webbrowser
from pathlib import Path

import pytest

from robosmi import resources
from robosmi.cli.commands.demo import EXAMPLE
from robosmi.cli.commands.open import serve
from robosmi.report import Report
from robosmi.report.page_server import HOST, PageServer
from tests.running import run, tree


def test_it_writes_the_example_and_its_sketch_and_ends(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")  # no compiler
    monkeypatch.chdir(tmp_path)
    outcome = run("demo", "--no-browser", "--json")
    assert outcome.code == 0, outcome.err
    assert outcome.result["plan"]["work"]["calls"]["working"] == outcome.result["plan"]["call_sites"]["total"] > 0
    made = tmp_path / "robosmi-demo"
    assert (made / EXAMPLE / f"{EXAMPLE}.ino").is_file()
    assert (made / "models" / "plan.xmi").is_file()
    for path in resources.example(EXAMPLE).iterdir():
        copied = made / "program" / path.name
        assert copied.is_file() == (path.suffix in (".c", ".fzz", ".toml"))
        assert not copied.is_file() or copied.read_bytes() == path.read_bytes()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["robosmi-demo"], "nothing is written elsewhere"


def test_a_second_run_keeps_what_the_user_made_of_it(tmp_path: Path) -> None:
    assert run("demo", "--no-browser", "-o", tmp_path / "demo").code == 0
    before = tree(tmp_path / "demo")
    assert run("demo", "--no-browser", "-o", tmp_path / "demo").code == 0
    assert tree(tmp_path / "demo") == before
    program = tmp_path / "demo" / "program" / f"{EXAMPLE}.c"
    program.write_text(program.read_text().replace("pause(1000)", "pause(500)"))
    assert run("demo", "--no-browser", "-o", tmp_path / "demo").code == 0
    assert "pause(500)" in (tmp_path / "demo" / EXAMPLE / f"{EXAMPLE}.ino").read_text()


def test_it_counts_no_choice_in_the_history(tmp_path: Path) -> None:
    assert run("demo", "--no-browser", "-o", tmp_path / "demo").code == 0
    assert run("history", "list", "--json").result["entries"] == []


def test_a_place_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    (tmp_path / "demo").mkdir()
    (tmp_path / "demo" / "program").write_text("a file of the user's\n")
    outcome = run("demo", "--no-browser", "-o", tmp_path / "demo")
    assert outcome.code == 3
    assert str(tmp_path / "demo" / "program") in outcome.err
    assert "-o DIR" in outcome.err


def test_a_port_in_use_is_named_before_anything_is_served(tmp_path: Path) -> None:
    with socket.socket() as taken:
        taken.bind((HOST, 0))
        taken.listen()
        port = taken.getsockname()[1]
        outcome = run("demo", "--port", str(port), "-o", tmp_path / "demo")
    assert outcome.code == 2
    assert str(port) in outcome.err
    assert "--port" in outcome.err


def test_without_a_browser_the_address_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("demo", "--no-browser", "-o", tmp_path / "demo").code == 0
    monkeypatch.setattr(webbrowser, "open_new_tab", lambda url: False)
    monkeypatch.setattr(PageServer, "serve_forever", lambda self: None)
    report = Report("demo")
    serve(report, tmp_path / "demo")
    assert report.then is not None
    report.then()
    assert str(report.result["url"]) in capsys.readouterr().err
