"""What a person meets at a terminal: findings grouped, colour where it is taken, completion, an example in each help."""

from __future__ import annotations

import io
import shlex
import subprocess

import pytest

from robosmi.cli.examples import EXAMPLES
from robosmi.cli.main import COMMANDS, build_parser
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.report import Report, takes_colour, terminal_text
from tests.running import run

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


def test_texts_in_the_script_for_fish_are_quoted() -> None:
    """Of such lines bash reads quotation marks as fish does."""
    script = run("completion", "fish").out
    assert subprocess.run(["bash", "-n"], input=script, text=True, check=False).returncode == 0
