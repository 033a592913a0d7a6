"""The page on the way to the board shows what its commands print."""

from __future__ import annotations

import re
from pathlib import Path

from tests.readme_tour import ROOT, filled
from tests.tools import require_tools

PAGE = ROOT / "docs" / "how-to" / "bring-a-sketch-to-the-board.md"


def shown(folder: Path) -> str:
    """The page with its commands' output as it is now.

    Args:
        folder: an empty folder that stands for the `out` of the page.
    """
    text = PAGE.read_text(encoding="utf-8")
    sketch = re.search(r"```cpp\n(.*?)```", text, re.DOTALL)
    assert sketch is not None
    (folder / "blink" / "blink").mkdir(parents=True)
    (folder / "blink" / "blink" / "blink.ino").write_text(sketch[1], encoding="utf-8")
    return filled(text, folder)


def test_the_page_shows_real_output(tmp_path: Path) -> None:
    require_tools("avr-g++", "arduino-core-avr", "avrdude")
    assert shown(tmp_path) == PAGE.read_text(encoding="utf-8")
