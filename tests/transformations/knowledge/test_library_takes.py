"""What libraries occupy, by the microcontroller: the first entry that is for it, or for all of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.base.user_folders import OWN
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.knowledge.libraries.library_takes import library_takes

ENTRIES = """
[[library]]
names = ["Counter"]
mcus = ["atmega2560"]
timers = ["Timer5"]
[[library]]
names = ["Counter"]
mcus = ["atmega32u4", "atmega328p"]
timers = ["Timer2"]
pins = ["D5", "D99"]
[[library]]
names = ["Counter", "Beat"]
timers = ["Timer1"]
[[library]]
names = ["Wide"]
timers = ["Timer5"]
"""


@pytest.mark.parametrize(
    ("board", "library", "timers", "pins"),
    [
        ("mega", "Counter", ("Timer5",), ()),
        ("uno", "Counter", ("Timer2",), ("D5",)),
        ("uno", "Beat", ("Timer1",), ()),
        ("mega", "Wide", ("Timer5",), ()),
        ("uno", "Wide", None, None),
    ],
)
def test_the_entry_for_the_microcontroller_counts(
    board: str, library: str, timers: tuple[str, ...] | None, pins: tuple[str, ...] | None, tmp_path: Path
) -> None:
    path = tmp_path / OWN / "platform_repo" / "arduino" / "libraries" / "takes.toml"
    path.parent.mkdir(parents=True)
    path.write_text(ENTRIES)
    found = library_takes("arduino", load_board(board), tmp_path).get(library)
    assert (found and found.timers, found and tuple(found.pins)) == (timers, pins)
