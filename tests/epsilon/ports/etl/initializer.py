"""The script of cases/etl/initializer, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)
    shared: Any = None

    @t.pre
    def _() -> None:
        nonlocal shared
        shared = G.Graph(label="shared")

    @t.rule(L.Section, to=[G.Graph, G.Node], init={"g": lambda s: shared})
    def S(s: Any, g: Any, n: Any) -> None:
        n.label = s.name
        g.nodes.append(n)
        g.label = f"{g.label}+{s.name}"

    @t.rule(L.Author, to=G.Node, init={"n": lambda a: G.Node.all[0]})
    def A(a: Any, n: Any) -> None:
        n.weight += 1

    return t
