"""The script of cases/etl/order_with_lazy, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.pre
    def _() -> None:
        print("pre")

    def guard_a1(a: Any) -> bool:
        print("guard A1", a.name)
        return True

    @t.rule(L.Author, to=G.Node, guard=guard_a1)
    def A1(a: Any, n: Any) -> None:
        print("A1", a.name)
        n.label = a.name
        if a.mentor is not None:
            print("A1", a.name, "sees mentor", t.equivalent(a.mentor).label)

    def guard_m(m: Any) -> Any:
        print("guard M", m.name)
        return m.borrowed

    @t.rule(L.Member, to=G.Node, guard=guard_m)
    def M(m: Any, n: Any) -> None:
        print("M", m.name)
        n.label = m.name

    def guard_a2(a: Any) -> bool:
        print("guard A2", a.name)
        return bool(a.name != "Ben")

    @t.rule(L.Author, to=G.Note, guard=guard_a2)
    def A2(a: Any, n: Any) -> None:
        print("A2", a.name)
        n.text = a.name

    @t.rule(L.Journal, to=G.Edge, lazy=True)
    def Z(j: Any, n: Any) -> None:
        n.label = j.name

    @t.post
    def _() -> None:
        print("post")

    return t
