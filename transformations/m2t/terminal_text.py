"""The terminal output of a migration: the first screen of the report, the pins, the libraries, and where the rest is."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from robosmi.metamodels import migration
from robosmi.transformations.m2t.first_screen import Counted, Item, Listed, first_screen
from robosmi.transformations.m2t.move_text import move_lines

_INDENT = "  "


def terminal_lines(
    plan: migration.MigrationPlan, sources: Mapping[str, bytes], sketch: Path, *, made: bool, known: Counted | None = None,
    compiles: bool | None = None,
) -> list[str]:  # fmt: skip
    """The lines of the output.

    Args:
        plan: the plan, complete.
        sources: path of a unit -> its bytes.
        sketch: the folder of the generated program.
        made: whether files were written.
        known: what was counted of the plan as it is; None where nothing was.
        compiles: whether this run has compiled the program with success; None if it has not compiled it.
    """
    board = plan.board.title if plan.board else "the target"
    screen = first_screen(plan, sources, known=known)
    lines = [f"{'generated' if made else 'would generate'} {sketch} for {board}"]
    lines += [_sum("too big", short) for short in screen.shortages]
    if moved := move_lines(plan):
        lines += [_sum("moved", moved[0]), *(f"{_INDENT}{line}" for line in moved[1:])]
    known_build = "" if plan.build is not None else "; not compiled yet"
    lines.append(_sum("works", screen.works + {None: known_build, True: "; compiles", False: "; does not compile"}[compiles]))
    for word, each in (("decide", screen.decide), ("write", screen.write), ("check", screen.check)):
        lines += _list(word, each)
    if screen.needs:
        lines.append(_sum("needs", screen.needs))
    for connection in plan.connections:
        ports = ", ".join(b.name for b in plan.portBindings if b.connection is connection or b.answer is connection)
        pin = connection.pin.label if connection.pin else "?"
        lines.append(f"{_INDENT}{pin:4} {connection.name:28} {('is ' + ports) if ports else ''}".rstrip())
    if plan.libraryChoices:
        included: dict[str, bool] = {}
        for choice in plan.libraryChoices:
            if choice.chosen is not None:
                included[choice.chosen.name] = included.get(choice.chosen.name, False) or choice.included
        named = [name + " (not used, not included)" * (not included[name]) for name in sorted(included)]
        lines.append(f"{_INDENT}libraries: {', '.join(named) or 'none chosen'}")
    return [*lines, f"{_INDENT}see {sketch / 'MIGRATION.md'}"] if made else lines


def _sum(word: str, total: str) -> str:
    return f"{_INDENT}{word:7} {total}"


def _list(word: str, listed: Listed) -> list[str]:
    """A list with its total; of what is to be checked on the bench only the total, since the report lists it."""
    lines = [_sum(word, listed.total)]
    if word == "check":
        return lines
    lines += [f"{_INDENT * 2}{_item(item)}" for item in listed.first]
    if listed.rest:
        lines.append(f"{_INDENT * 2}and {sum(bool(item.rule) for item in listed.rest)} more")
    if listed.hint and listed.first:
        lines.append(f"{_INDENT * 2}{listed.hint}")
    return lines


def _item(item: Item) -> str:
    text = f"{item.text} `{item.source}`" if item.source else item.text
    text = f"{text}: {item.typed}" if item.typed else text
    text = f"{text}, {item.more}" if item.more else text
    return f"{text} [{item.rule}]" if item.rule else text
