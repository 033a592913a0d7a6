"""docs/reference/command-line.md and environment.md against the code: options, keys of results, environment variables."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest

from robosmi.base.data_text import Json
from robosmi.cli.main import COMMANDS, build_parser
from robosmi.plugins import registry
from tests.running import run
from tests.tools import require_tools

ROOT = Path(__file__).resolve().parents[2]
REFERENCE = ROOT / "docs" / "reference"
COMMAND_LINE = (REFERENCE / "command-line.md").read_text(encoding="utf-8")
OF_ALL = {"-h", "--help", "--json", "--sarif", "--fail-on", "-v", "--verbose"}
"""Options that every command has; the head of the page tells them."""
LINE_FOLLOWER = ROOT / "docs" / "examples" / "line_follower"
_VARIABLE = re.compile(r"\b(?:ROBOSMI|XDG)_[A-Z_]*[A-Z]\b")
_NO_VARIABLES = {"ROBOSMI_STAND_IN"}
"""Words of that form that are none: the guard of a generated header."""


def parts(parser: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    """The commands of a parser, or the parts of a command, by their names; none where it has no parts."""
    named = [
        action.choices if isinstance(action.choices, dict) else {} for action in parser._actions if not action.option_strings
    ]
    return {str(name): part for one in named for name, part in one.items() if isinstance(part, argparse.ArgumentParser)}


def options(parser: argparse.ArgumentParser) -> Iterator[tuple[str, ...]]:
    """The names of each option of a command and of its parts."""
    for part in parts(parser).values():
        yield from options(part)
    yield from (tuple(action.option_strings) for action in parser._actions if action.option_strings)


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_and_all_its_options_are_on_the_page(command: str) -> None:
    rows = [line for line in COMMAND_LINE.splitlines() if line.startswith(f"| `{command}")]
    assert rows
    told = set(re.findall(r"(?<![\w-])--?\w[\w-]*", " ".join(row.split(" | ")[0] for row in rows)))
    whole = parts(build_parser(command))[command]
    missing = [names for names in options(whole) if not OF_ALL & set(names) and not told & set(names)]
    assert missing == []
    known = {name for names in options(whole) for name in names}
    assert told - known == set()


def test_the_options_of_all_commands_are_told_at_the_head() -> None:
    head = COMMAND_LINE.partition("| command |")[0]
    assert [name for name in sorted(OF_ALL - {"-h", "--help"}) if name not in head] == []


def written() -> Iterator[str]:
    """The text of the code, and of the data that names variables."""
    for folder, ending in (("robosmi", "py"), ("transformations", "py"), ("platform_repo", "toml")):
        for path in (ROOT / folder).rglob(f"*.{ending}"):
            yield path.read_text(encoding="utf-8")


def test_every_environment_variable_is_on_its_page_and_none_else() -> None:
    rows = re.findall(r"^\| (`[^|]*`) \|", (REFERENCE / "environment.md").read_text(encoding="utf-8"), re.MULTILINE)
    told = {name for row in rows for name in re.findall(r"`(\w+)`", row)}
    text = "\n".join(written())
    read = set(re.findall(r"environ(?:\.get\(|\[)\s*\"(\w+)\"", text)) - {"PYTHONPATH"}  # that is handed on, not obeyed
    used = set(_VARIABLE.findall(text)) - _NO_VARIABLES
    assert len(used) > 10
    assert used | read == told


def paths(value: Json, path: str = "") -> Iterator[str]:
    """The paths of a JSON value, down to texts, numbers and empty arrays and objects."""
    if isinstance(value, dict) and value:
        for key, one in value.items():
            yield from paths(one, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        yield f"{path}[]"
        for one in value:
            yield from paths(one, f"{path}[]")
    else:
        yield path


def told_paths(command: str) -> set[str]:
    """The JSON paths in the page's section about a command, with all their prefixes."""
    section = COMMAND_LINE.partition(f"\n### {command}\n")[2]
    found: set[str] = set()
    for row in re.findall(r"^\| (`.*) \|$", re.split(r"\n##", section)[0], re.MULTILINE):
        first, _, text = row.partition(" | ")
        starts = re.findall(r"`([\w.\[\]]+)`", first)
        found |= set(starts)
        base = starts[0]
        for word in re.findall(r"`([\w.\[\]]+)`", re.sub(r"\([^)]*\)", "", text)):
            base = word if word.startswith(starts[0].partition("[")[0] + "[]") else base
            found.add(word if base == word else f"{base}.{word}")
    return found


def through(found: Iterable[str]) -> set[str]:
    """JSON paths with all their prefixes: `a[].b` has the prefix `a[]`."""
    return {path[: cut.start()] for path in found for cut in re.finditer(r"(?=\.|$)", path)}


RESULTS: dict[str, list[list[str | Path]]] = {
    "analyse": [
        ["analyse", LINE_FOLLOWER / "line_follower.c"],
        ["analyse", ROOT / "tests" / "docs" / "uses_all.c"],
        ["analyse", ROOT / "tests" / "cli" / "own_header" / "signal.c"],
        ["analyse", ROOT / "tests" / "cli" / "sketches" / "own_library" / "own_library.ino", "--target", "pico"],
    ],
    "hardware": [["hardware", LINE_FOLLOWER / "line_following_robot.fzz"]],
    "recommend": [["recommend", LINE_FOLLOWER / "line_following_robot.fzz"]],
    "metamodels export": [["metamodels", "export", "out"]],
}


@pytest.mark.parametrize("command", RESULTS)
def test_the_result_has_what_the_page_says_and_nothing_else(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    found = {path for words in RESULTS[command] for path in paths(run(*words, "--json").result)}
    compared(command, found)


def test_the_result_of_compile_has_what_the_page_says_and_nothing_else(tmp_path: Path) -> None:
    require_tools("avr-g++", "arduino-core-avr")
    assert run("migrate", LINE_FOLLOWER / "line_follower.c", "-o", tmp_path / "out").code == 0
    result = run("compile", tmp_path / "out", "--json").result
    compared("compile", {path for path in paths(result) if not path.startswith("diagnostics[].")})


def compared(command: str, found: set[str]) -> None:
    """Compare the paths that were found with those of the page."""
    told = through(told_paths(command))
    ends = {re.sub(r"\[\]$", "", path) for path in told} | told
    assert sorted(path for path in through(found) if path not in ends) == []
    met = {re.sub(r"\[\]$", "", path) for path in through(found)}
    assert sorted(path for path in told if re.sub(r"\[\]$", "", path) not in met) == []


def test_every_device_is_in_the_table_of_devices() -> None:
    page = (ROOT / "docs" / "how-to" / "run-a-sketch-on-a-simulator.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (`[^|]*) \|", page.partition("| device | pins |")[2].partition("\n\n")[0], re.MULTILINE)
    assert {name for row in rows for name in re.findall(r"`(\w+)`", row)} == set(registry().names("device"))
