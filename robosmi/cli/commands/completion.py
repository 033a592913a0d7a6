"""`robosmi completion bash|zsh|fish`: a script that lets a shell complete commands and options.

It is made of the commands' own parsers, so it knows what they know. Arguments that are files are left to the shell.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING

from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("shell", choices=sorted(_SCRIPTS), help="shell to complete commands in")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    shell: str


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("completion")
    script = _SCRIPTS[arguments.shell]()
    report.result = {"shell": arguments.shell, "script": script}
    report.lines = script.splitlines()
    return report


def _options() -> dict[str, dict[str, str]]:
    """Command -> its options (and words that it takes instead of a file) with their meanings, in the order of its help."""
    from robosmi.cli.main import COMMANDS, build_parser

    return {command: _of(build_parser(command), command) for command in COMMANDS}


def _of(parser: argparse.ArgumentParser, command: str) -> dict[str, str]:
    (commands,) = (a for a in parser._actions if isinstance(a, argparse._SubParsersAction))
    found: dict[str, str] = {}
    for action in commands.choices[command]._actions:
        for name in action.option_strings:
            found[name] = " ".join((action.help or "").split())
        if not action.option_strings:
            found |= {str(choice): "" for choice in action.choices or ()}
    return found


def _bash() -> str:
    from robosmi.cli.main import COMMANDS

    cases = "\n".join(f"    {name}) words='{' '.join(options)}' ;;" for name, options in _options().items())
    return f"""_robosmi() {{
  local words='{" ".join(COMMANDS)} --version --help' current="${{COMP_WORDS[COMP_CWORD]}}"
  if [ "$COMP_CWORD" -gt 1 ]; then
    case "${{COMP_WORDS[1]}}" in
{cases}
    esac
  fi
  COMPREPLY=($(compgen -W "$words" -- "$current"))
}}
complete -o default -F _robosmi robosmi"""


def _zsh() -> str:
    from robosmi.cli.main import COMMANDS

    commands = "\n".join(f"    {_quoted(f'{name}:{said}')}" for name, said in COMMANDS.items())
    cases = "\n".join(
        f"    {name}) words_of=({' '.join(_quoted(f'{_colons(o)}:{said}') for o, said in options.items())}) ;;"
        for name, options in _options().items()
    )
    return f"""#compdef robosmi
_robosmi() {{
  local -a commands words_of
  commands=(
{commands}
  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  case $words[2] in
{cases}
  esac
  _describe -o option words_of
  _files
}}
compdef _robosmi robosmi"""


def _fish() -> str:
    from robosmi.cli.main import COMMANDS

    lines = [f"complete -c robosmi -n __fish_use_subcommand -f -a {name} -d {_quoted(said)}" for name, said in COMMANDS.items()]
    for command, options in _options().items():
        there = f"complete -c robosmi -n '__fish_seen_subcommand_from {command}'"
        for name, said in options.items():
            kind = "-l" if name.startswith("--") else "-s" if name.startswith("-") and len(name) == 2 else "-a"
            lines.append(f"{there} {kind} {name.lstrip('-')} -d {_quoted(said)}")
    return "\n".join(lines)


def _quoted(text: str) -> str:
    """A text in single quotation marks, as all three shells take it."""
    return "'" + text.replace("'", "'\\''") + "'"


def _colons(text: str) -> str:
    return text.replace(":", "\\:")


_SCRIPTS: dict[str, Callable[[], str]] = {"bash": _bash, "zsh": _zsh, "fish": _fish}
