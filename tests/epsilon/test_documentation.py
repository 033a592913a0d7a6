"""The examples of docs/reference run unchanged on the models of the cases."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from tests.epsilon.running import CASES, HERE

FILES = {
    "library.xmi": HERE / "eol" / "library.xmi",
    "library.ecore": HERE / "eol" / "library.ecore",
    "library1.ecore": HERE / "eol" / "library.ecore",
    "graph.ecore": CASES / "models" / "graph.ecore",
    "library2.ecore": CASES / "flock" / "retype" / "new.ecore",
    "migration0.ecore": HERE.parents[1] / "metamodels" / "migration.ecore",
}


@pytest.mark.parametrize("page", ["evl", "etl", "flock"])
def test_the_examples_run(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, source in FILES.items():
        shutil.copy(source, tmp_path / name)
    monkeypatch.chdir(tmp_path)
    text = (HERE.parents[1] / "docs" / "reference" / f"{page}.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert blocks
    for block in blocks:
        exec(compile(block, f"{page}.md", "exec"), {"__file__": str(tmp_path / f"{page}.py")})
    made = {"evl": [], "etl": ["graph.xmi"], "flock": ["library2.xmi"]}[page]
    assert [p.name for p in tmp_path.glob("*.xmi") if p.name != "library.xmi"] == made
