"""The prompt for a choice that flags, project file, history and rules have left open. Asked only at a terminal.

What is shown is the ranked list with its reasons; what is answered counts as a person's choice, so it is remembered. An
empty answer leaves the choice open. Nothing is known here of how candidates were ranked.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TextIO

from robosmi.quoting import terminal

SHOWN = 7
NONE = "none"


def may_ask(*, yes: bool, as_json: bool) -> bool:
    """Whether there is somebody to ask: a terminal on both sides, and neither --yes nor --json."""
    return not yes and not as_json and sys.stdin.isatty() and sys.stdout.isatty()


def ask_libraries(
    choices: Sequence[Mapping[str, Any]], *, answer: Callable[[str], str] = input, out: TextIO | None = None
) -> dict[str, str]:
    """Ask for a library for each open choice.

    Args:
        choices: open choices as the contract has them (`libraries[]`), like parts one after the other.
        answer: reads one line.
        out: where is written; stdout if None.

    Returns:
        `#model_index` -> name of a library or `none`, for what was answered.
    """
    said: dict[str, str] = {}
    for choice in choices:
        candidates = list(choice["candidates"])[:SHOWN]
        print(f"\nWhich library drives '{terminal(choice['component'])}'?", file=out or sys.stdout)
        for number, candidate in enumerate(candidates, 1):
            print(terminal(f"  {number}  {candidate['library']}: {'; '.join(candidate['reasons'])}"), file=out or sys.stdout)
        print("  0  none; a name takes another library; Enter leaves it open", file=out or sys.stdout)
        names = [str(candidate["library"]) for candidate in candidates]
        try:
            text = answer("> ").strip()
            while text.isdecimal() and int(text) > len(names):
                print(f"  there is no number {int(text)} in the list", file=out or sys.stdout)
                text = answer("> ").strip()
        except EOFError:
            return said
        if name := _named(text, names):
            said[f"#{choice['component_model_index']}"] = name
    return said


def _named(text: str, names: Sequence[str]) -> str:
    """The library behind a number of the list or a name."""
    if not text.isdecimal():
        return text
    return names[int(text) - 1] if int(text) else NONE
