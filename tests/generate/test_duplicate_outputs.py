"""A file that several elements are generated into is told, since only the last text is in it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.generate import Gen
from tests.library import library


def generated(folder: Path, text: str, **options: Any) -> list[tuple[str, str]]:
    L = library()
    g = Gen(folder, {"t": text}, [L])
    g.rule(L.Author, name="Authors", template="t", target="all.txt", **options)(lambda a: None)
    return [(finding.rule, finding.message) for finding in g.run().findings]


@pytest.mark.parametrize("merge", [True, False])
def test_several_elements_into_one_file_are_told_once(merge: bool, tmp_path: Path) -> None:
    told = [("RS534", "'Authors' made the file 'all.txt' more than once: only the last text is in it")]
    assert generated(tmp_path, "{{ a.name }}", merge=merge) == told
    assert generated(tmp_path, "{{ a.name }}", merge=merge) == told


@pytest.mark.parametrize(
    ("text", "options"), [("same", {}), ("{{ a.name }}", {"append": True}), ("{{ a.name }}", {"overwrite": False})]
)
def test_nothing_is_told_where_no_text_is_lost(text: str, options: dict[str, Any], tmp_path: Path) -> None:
    assert generated(tmp_path, text, **options) == []
