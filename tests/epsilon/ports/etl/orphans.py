"""The script of cases/etl/orphans, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)
    early: Any = None

    @t.rule(L.Member, to=G.Node)
    def M(m: Any, n: Any) -> None:
        n.label = m.name

    @t.rule(L.Author, to=G.Node)
    def A(a: Any, n: Any) -> None:
        n.label = a.name

    @t.rule(L.Library, to=G.Graph)
    def L1(library: Any, g: Any) -> None:
        g.label = library.name
        t.set(g, nodes=[a for a in library.authors if a.mentor is not None])
        G.Note(text="late")

    @t.rule(L.Section, to=G.Group)
    def S(s: Any, g: Any) -> None:
        g.label = s.name
        t.set(g, inner=s.sections)

    @t.pre
    def _() -> None:
        nonlocal early
        early = G.Note(text="early")

    @t.post
    def _() -> None:
        G.Graph(label="last", notes=[early])

    return t
