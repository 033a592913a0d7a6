"""The script of cases/egl/factory: Python generates what the template generates by its factory, then the template."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {
    "script.egl": """\
inline <{{ inline }}>
""",
    "book.egl": "book {{ n }} {{ b.name }} ({{ b.year }})",
}


def port(folder: Path, L: Any, script: str, target: str) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    @g.rule(template=script, target=target)
    def Script() -> dict[str, Any]:
        for n, b in enumerate(L.Book.all, 1):
            g.write(f"books/{b.name}.txt", g.text("book.egl", b=b, n=n))
        g.write("books/Zap.txt", g.text("book.egl", b=L.Book.all.first(), n=99), overwrite=False, merge=False)
        return {"inline": g.text("book.egl", b=L.Book.all.first(), n=99)}

    return g
