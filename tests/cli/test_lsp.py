"""The language server: a conversation of an editor over standard input and output, and what the editor's questions give."""

from __future__ import annotations

import asyncio
import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from lsprotocol import types as lsp
from pygls.lsp.client import LanguageClient

from robosmi.plugins import content
from robosmi.project import load_project
from tests.running import run

ROBOT = Path(__file__).parent / "lsp_robot"


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    return Path(shutil.copytree(ROBOT, tmp_path / "robot"))


@pytest.mark.processes
def test_an_editor_is_shown_findings_completions_and_choices(robot: Path) -> None:
    """One conversation: a wrong port is reported as it is typed, completed, and the open port's choice is taken."""
    path = robot / "robosmi.toml"
    uri, program, text = path.as_uri(), (robot / "finder.c").as_uri(), path.read_text()

    async def talk() -> None:
        client = LanguageClient("test", "1")
        shown = dict[str, list[lsp.Diagnostic]]()
        news, examined = asyncio.Event(), -1

        def take(about: lsp.PublishDiagnosticsParams) -> None:
            nonlocal examined
            shown[about.uri] = list(about.diagnostics)
            examined = about.version if about.version is not None else examined
            news.set()

        client.feature(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)(take)

        async def until_examined() -> None:
            while examined != version:
                news.clear()
                await asyncio.wait_for(news.wait(), 30)

        version = 0

        async def typed(new: str) -> None:
            nonlocal version
            version += 1
            change = [lsp.TextDocumentContentChangeWholeDocument(new)]
            client.text_document_did_change(
                lsp.DidChangeTextDocumentParams(lsp.VersionedTextDocumentIdentifier(version, uri), change)
            )

        await client.start_io(sys.executable, "-m", "robosmi", "lsp", "--stdio")
        await client.initialize_async(lsp.InitializeParams(capabilities=lsp.ClientCapabilities()))
        client.initialized(lsp.InitializedParams())
        client.text_document_did_open(lsp.DidOpenTextDocumentParams(lsp.TextDocumentItem(uri, "toml", 0, text)))
        await until_examined()
        (open_port,) = shown[program]
        assert open_port.code == "RS330"
        assert (open_port.range.start.line, open_port.severity) == (7, lsp.DiagnosticSeverity.Warning)

        await typed(f"{text}\n[bind]\nirleft = 'D12'\n")
        await until_examined()
        (wrong,) = shown[uri]
        assert wrong.code == "RS901"
        assert "did you mean 'irLeft'?" in wrong.message
        assert wrong.range.start.line == 4
        assert shown[program] == []

        await typed(f'{text}\n[bind]\nirLeft = ""\n')
        place = lsp.CompletionParams(lsp.TextDocumentIdentifier(uri), lsp.Position(4, 10))
        offered = await client.text_document_completion_async(place)
        assert isinstance(offered, lsp.CompletionList)
        first = offered.items[0]
        assert "left detector" in (first.detail or "")
        assert first.text_edit == lsp.TextEdit(lsp.Range(lsp.Position(4, 9), lsp.Position(4, 11)), '"D12"')

        await typed(text)
        here = lsp.Range(lsp.Position(0, 0), lsp.Position(0, 0))
        asked = lsp.CodeActionParams(lsp.TextDocumentIdentifier(uri), here, lsp.CodeActionContext([]))
        actions = await client.text_document_code_action_async(asked) or []
        (lamp,) = [each for each in actions if each.title == "P26 = D13 (lamp)"]
        assert isinstance(lamp, lsp.CodeAction)
        (edit,) = ((lamp.edit and lamp.edit.changes) or {})[uri]
        await typed(edit.new_text)
        await until_examined()
        assert shown[program] == shown[uri] == []
        path.write_text(edit.new_text)
        await client.shutdown_async(None)
        client.exit(None)
        stop: Any = client.stop  # without types
        await stop()

    asyncio.run(talk())
    assert load_project(robot).bind == {"P26": "D13"}


def test_the_server_ends_without_an_error_when_the_editor_says_so() -> None:
    end = ({"method": "initialize", "id": 1, "params": {"processId": None, "rootUri": None, "capabilities": {}}},
           {"method": "shutdown", "id": 2}, {"method": "exit"})  # fmt: skip
    texts = [json.dumps({"jsonrpc": "2.0", **each}).encode() for each in end]
    sent = b"".join(b"Content-Length: %d\r\n\r\n%s" % (len(text), text) for text in texts)
    done = subprocess.run([sys.executable, "-m", "robosmi", "lsp"], input=sent, capture_output=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, b"")
    assert b'"id": 2' in done.stdout


def editor(path: Path, text: str) -> Any:
    made = content("chain", "editor")()
    made.texts[path] = text
    return made


def test_a_pin_table_has_the_findings_of_check_and_of_its_program(robot: Path) -> None:
    path = robot / "wiring.csv"
    text = f"{path.read_text()}D3,Wombat,w,\n"
    found = editor(path, text).examine(path)
    assert {(f.rule, f.location.line) for f in found.findings if f.rule == "RS203"} == {("RS203", 5)}
    assert "RS330" in {f.rule for f in found.findings}  # the program beside it
    path.write_text(text)
    checked = run("check", path, "--json").document["findings"]
    assert {f["id"] for f in checked} <= {f.id for f in found.findings}


@pytest.mark.parametrize(
    ("row", "column", "offered", "not_offered"),
    [
        ("D", 1, "D3", "D13"),
        ("D3,ser", 6, "Basic Servo", "D3"),
        ("D3,Servo,s,In", 13, "Input", "Board "),
        ("D3,Servo,l", 10, "lamp", "D3"),
    ],
)
def test_cells_of_a_pin_table_are_completed(robot: Path, row: str, column: int, offered: str, not_offered: str) -> None:
    path = robot / "wiring.csv"
    start, found = editor(path, path.read_text() + row).suggestions(path, 4, column)
    assert start == row.rfind(",") + 1
    texts = [each.text for each in found]
    assert offered in texts
    assert not_offered not in texts


@pytest.mark.parametrize(
    ("typed", "offered"),
    [
        ("[", "bind"),
        ("[migrate]\ntar", "target"),
        ("[migrate]\ntarget = ", '"nano"'),
        ('[migrate]\nhardware = "', '"wiring.csv"'),
        ('[migrate]\nhardware = "wiring.csv"\n[roles]\n', '"left detector"'),
        ("[severity]\nRS33", "RS330"),
        ('[severity]\nRS330 = "', '"off"'),
        ("[bind]\nir", "irLeft"),
    ],
)
def test_a_project_file_is_completed(robot: Path, typed: str, offered: str) -> None:
    path, lines = robot / "robosmi.toml", typed.split("\n")
    _, found = editor(path, typed).suggestions(path, len(lines) - 1, len(lines[-1]))
    assert offered in [each.text for each in found]


@pytest.mark.parametrize(
    ("typed", "line", "message"),
    [
        ("[migrate]\nhardware =\n", 2, "the project file cannot be read"),
        ("[migrate]\ntarget = 'uno'\n[bind", 3, "the project file cannot be read"),
        ("[bind]\nirLeft = 'D99'\n", 2, "'D99' is neither a pin"),
        ("[migrat]\n", None, "'migrat' is no table (did you mean 'migrate'?)"),
    ],
)
def test_what_is_wrong_in_a_project_file_has_its_line(robot: Path, typed: str, line: int | None, message: str) -> None:
    path = robot / "robosmi.toml"
    (error,) = editor(path, typed).examine(path).errors
    assert message in error.message
    assert (error.location.line if error.location is not None else 0) == line


def test_a_scenario_names_what_the_program_reads(robot: Path) -> None:
    path = robot / "case.toml"
    text = 'horizon_ms = 400\n[signals]\n"left detektor" = [[0, 1]]\n'
    made = editor(path, text)
    (error,) = made.examine(path).errors
    assert "did you mean 'left detector'?" in error.message
    _, offered = made.suggestions(path, 2, 1)
    assert [each.text for each in offered] == ['"left detector"', "irLeft", "D12", "console"]
    made.texts[path] = text.replace("detektor", "detector")
    assert made.examine(path).errors == []


def test_the_entry_of_a_choice_offers_its_answers(robot: Path) -> None:
    path = robot / "robosmi.toml"
    made = editor(path, f"{path.read_text()}\n[bind]\nirLeft = 'D12'  # the left one\n")
    titles = [each.title for each in made.answers(path, 4)]
    assert {title.partition(" = ")[0] for title in titles} == {"irLeft"}
    other = next(each for each in made.answers(path, 4) if each.title == "irLeft = D7 (spare lamp)")
    assert '"D7"  # the left one' in other.text


def test_lsp_explains_what_it_cannot_do() -> None:
    assert run("lsp", "--json").code == 2
