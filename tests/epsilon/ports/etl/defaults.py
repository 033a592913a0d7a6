"""The script of cases/etl/defaults, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query.values import as_string
from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Book, to=G.Node)
    def B(b: Any, n: Any) -> None:
        n.label = b.name
        if b.genre.name == "science":
            n.shape, n.weight, n.visible = G.Shape.round, 1, True
        elif b.genre.name == "fiction":
            n.shape, n.weight, n.visible = G.Shape.box, 0, False

    @t.rule(L.Author, to=G.Note)
    def A(a: Any, n: Any) -> None:
        n.text = ""
        n.lines.append(a.name)
        n.lines.append("")
        n.lines.append(a.name)

    @t.post
    def _() -> None:
        for n in G.Node.all:
            print(n.label, as_string(n.shape), n.weight, as_string(n.visible))

    return t
