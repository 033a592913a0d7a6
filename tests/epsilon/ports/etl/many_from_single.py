"""The script of cases/etl/many_from_single, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Author, to=G.Group)
    def A(a: Any, g: Any) -> None:
        g.label = a.name
        t.set(g, members=L.Author.all[0])

    return t
