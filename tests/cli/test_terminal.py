"""What a person meets at a terminal: findings grouped, colour where it is taken, completion, an example in each help."""

from __future__ import annotations

import io
import os
import shlex
import subprocess
from pathlib import Path

import pytest

from robosmi.cli.main import COMMANDS, EXAMPLES, build_parser
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.report import Report, takes_colour, terminal_text
from tests.running import run
from tests.tools import require_tools

MANY = [Finding("RS311", Severity.warning, f"number {n}", Location("a.c", n)) for n in range(1, 9)]


def report(*findings: Finding) -> Report:
    return Report("migrate", findings=list(findings), lines=["made it"])


def test_the_worst_finding_comes_first_and_alike_ones_stand_together() -> None:
    info = Finding("RS210", Severity.info, "no drawing")
    error = Finding("RS101", Severity.error, "no C", Location("a.c", 3), fix="correct it")
    text = terminal_text(report(info, MANY[0], error, MANY[1]))
    assert text.splitlines() == [
        "made it",
        "a.c:3: error: no C [RS101]",
        "  do: correct it",
        "a.c:1: warning: number 1 [RS311]",
        "a.c:2: warning: number 2 [RS311]",
        "info: no drawing [RS210]",
    ]


def test_of_many_alike_the_first_are_shown_and_all_when_asked_for() -> None:
    shown = terminal_text(report(*MANY)).splitlines()
    assert shown[-1] == "  and 5 more of RS311 (-v shows all)"
    assert len(shown) == 5
    assert len(terminal_text(report(*MANY), verbose=True).splitlines()) == 9


class Terminal(io.StringIO):
    """A stream that is a terminal."""

    def isatty(self) -> bool:
        return True


@pytest.mark.parametrize(
    ("environment", "stream", "coloured"),
    [
        ({}, Terminal(), True),
        ({}, io.StringIO(), False),
        ({"NO_COLOR": "1"}, Terminal(), False),
        ({"FORCE_COLOR": "1"}, io.StringIO(), True),
        ({"NO_COLOR": "1", "FORCE_COLOR": "1"}, Terminal(), False),
        ({"TERM": "dumb"}, Terminal(), False),
    ],
)
def test_colour_is_for_terminals_that_take_it(
    environment: dict[str, str], stream: io.StringIO, coloured: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("NO_COLOR", "FORCE_COLOR", "TERM"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    assert takes_colour(stream) is coloured
    assert ("\x1b[33mwarning\x1b[0m" in terminal_text(report(MANY[0]), colour=coloured)) is coloured


def test_a_text_of_a_file_sends_no_colour_of_its_own() -> None:
    text = terminal_text(report(Finding("RS1", Severity.info, "\x1b[31mred")), colour=True)
    assert "\x1b[31m" not in text


@pytest.mark.parametrize("command", COMMANDS)
def test_each_help_ends_with_an_example_that_is_taken(command: str) -> None:
    example = EXAMPLES[command]
    assert run(command, "--help").out.rstrip().endswith(example)
    words = shlex.split(example.partition(" > ")[0])
    assert words[:2] == ["robosmi", command]
    assert build_parser(command).parse_args(words[1:]).command == command


def completed(*words: str) -> list[str]:
    """What bash offers for the last of the words of a command line."""
    script = run("completion", "bash").out
    line = " ".join(shlex.quote(word) for word in words)
    ask = (
        f"{script}\nCOMP_WORDS=({line}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _robosmi; printf '%s\\n' \"${{COMPREPLY[@]}}\""
    )
    return subprocess.run(["bash", "-c", ask], capture_output=True, text=True, check=True).stdout.split()


def test_bash_completes_commands_and_options() -> None:
    assert completed("robosmi", "mi") == ["migrate"]
    assert completed("robosmi", "migrate", "--har") == ["--hardware"]
    assert completed("robosmi", "completion", "z") == ["zsh"]
    assert set(completed("robosmi", "")) >= set(COMMANDS)
    assert completed("robosmi", "migrate", "robot") == []


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_other_shells_get_every_command_and_option(shell: str) -> None:
    script = run("completion", shell).out
    assert all(command in script for command in COMMANDS)
    options = ("hardware", "bind", "dry-run", "strict")
    assert all((f"--{option}:" if shell == "zsh" else f"-l {option} ") in script for option in options)


IN_ZSH = """
autoload -U compinit && compinit -u -d "$ZDOTDIR/dump"
source "$1"
[[ ${_comps[robosmi]} == _robosmi ]] || exit 7
_describe() { print -rl -- "${(@P)argv[-1]}" }
_files() { }
shift
words=("$@"); CURRENT=$#words
_robosmi
"""
"""Loads the script as zsh does, and prints what it gives to zsh for the last word, which zsh itself then matches."""


@pytest.fixture(scope="module", params=["zsh", "fish"])
def shell_and_script(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Path]:
    """A shell that is installed, and the file with the script for it."""
    require_tools(request.param)
    script = tmp_path_factory.mktemp("completion") / f"robosmi.{request.param}"
    script.write_text(run("completion", request.param).out)
    return request.param, script


def completed_in(shell: str, script: Path, *words: str) -> list[str]:
    """What zsh or fish is offered for the last of the words of a command line; of zsh also what does not match it."""
    home = {**os.environ, "HOME": str(script.parent), "XDG_CONFIG_HOME": str(script.parent), "ZDOTDIR": str(script.parent)}
    if shell == "zsh":
        command, mark = ["zsh", "-f", "-c", IN_ZSH, "zsh", str(script), *words], ":"
    else:
        asked = 'source $argv[1]; complete -C "$argv[2]"'
        command, mark = ["fish", "--no-config", "-c", asked, str(script), " ".join(words)], "\t"
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=home)
    assert not done.stderr
    offered = [line.partition(mark)[0] for line in done.stdout.splitlines()]
    return [each for each in offered if each.startswith(words[-1])]


def test_zsh_and_fish_take_their_script(shell_and_script: tuple[str, Path]) -> None:
    shell, script = shell_and_script
    checked = subprocess.run([shell, "-n", str(script)], capture_output=True, text=True, check=False)
    assert (checked.returncode, checked.stderr) == (0, "")


def test_zsh_and_fish_complete_commands_and_options(shell_and_script: tuple[str, Path]) -> None:
    assert completed_in(*shell_and_script, "robosmi", "mi") == ["migrate"]
    assert completed_in(*shell_and_script, "robosmi", "migrate", "--har") == ["--hardware"]
    assert completed_in(*shell_and_script, "robosmi", "completion", "z") == ["zsh"]
    assert set(completed_in(*shell_and_script, "robosmi", "")) >= set(COMMANDS)
    assert "--hardware" not in completed_in(*shell_and_script, "robosmi", "compile", "--")


def test_texts_in_the_script_for_fish_are_quoted() -> None:
    """Of such lines bash reads quotation marks as fish does."""
    script = run("completion", "fish").out
    assert subprocess.run(["bash", "-n"], input=script, text=True, check=False).returncode == 0
