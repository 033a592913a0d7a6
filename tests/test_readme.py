"""The README and the tutorial show the real output of their commands and programs."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.readme_tour import PAGES, README, ROOT, filled, pictures
from tests.tools import require_tools


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_page_shows_real_output_and_pictures(page: Path, tmp_path: Path) -> None:
    text = page.read_text(encoding="utf-8")
    if "robosmi compile" in text:
        require_tools("avr-g++", "arduino-core-avr")
    assert filled(text, tmp_path) == text
    for picture in pictures(text):
        assert (tmp_path / picture).read_bytes() == (ROOT / "docs" / "images" / picture).read_bytes()


def test_each_picture_of_the_documents_is_drawn_for_a_page() -> None:
    drawn = [picture for page in PAGES for picture in pictures(page.read_text(encoding="utf-8"))]
    assert sorted(drawn) == sorted(path.name for path in (ROOT / "docs" / "images").iterdir())


def test_files_that_the_readme_links_to_exist() -> None:
    links = re.findall(r"\]\(([^)#:]+)\)", README.read_text(encoding="utf-8"))
    assert links
    assert [link for link in links if not (README.parent / link).exists()] == []
