"""The example of docs/reference/egl.md does what the page says."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.generate.support import LIBRARY

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "egl.md"


def block(kind: str) -> str:
    """The first block of code of that kind."""
    found = re.search(rf"```{kind}\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    assert found is not None
    return found[1]


def test_the_example_generates(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("library.ecore", "library.xmi"):
        shutil.copy(LIBRARY / name, name)
    (tmp_path / "templates").mkdir()
    (tmp_path / "templates" / "book.txt").write_text(block("jinja"))
    (tmp_path / "templates" / "index.txt").write_text("{% for b in books %}\n* {{ b.name }}\n{% endfor %}\n")
    scope: dict[str, Any] = {}
    exec(block("python"), scope)
    assert sorted(p.name for p in (tmp_path / "out" / "b").iterdir()) == ["Ants.txt", "Boards.txt", "Propellers.txt"]
    assert (tmp_path / "out" / "b" / "Propellers.txt").read_text() == (
        "PROPELLERS (2016)\n- 1: Ada,\n- 2: Ben\n// protected region City/Tech/Robots/Propellers on begin\nyour text\n"
        "// protected region City/Tech/Robots/Propellers end\n"
    )
    assert len(scope["result"].files) == 4


def test_every_argument_of_a_rule_is_on_the_page() -> None:
    import inspect

    from robosmi.generate import Gen

    text = PAGE.read_text(encoding="utf-8")
    names = [p for p in inspect.signature(Gen.rule).parameters if p not in ("self", "kind")]
    assert [name for name in names if f"`{name}" not in text and f"{name}=" not in text] == []
