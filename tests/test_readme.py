"""The README shows what the commands print."""

from __future__ import annotations

import re
from pathlib import Path

from tests.readme_tour import README, filled
from tests.tools import require_tools


def test_the_tour_of_the_readme_shows_real_output(tmp_path: Path) -> None:
    require_tools("avr-g++", "arduino-core-avr")
    text = README.read_text(encoding="utf-8")
    assert filled(text, tmp_path) == text


def test_files_that_the_readme_links_to_exist() -> None:
    links = re.findall(r"\]\(([^)#:]+)\)", README.read_text(encoding="utf-8"))
    assert links
    assert [link for link in links if not (README.parent / link).exists()] == []
