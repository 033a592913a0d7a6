"""The script of cases/etl/primary, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Book, to=G.Node)
    def R1(b: Any, n: Any) -> None:
        n.label = f"r1 {b.name}"

    @t.rule(L.Book, to=G.Group, primary=True)
    def R2(b: Any, n: Any) -> None:
        n.label = f"r2 {b.name}"
        n.members.append(t.equivalent(b, "R1"))

    @t.rule(L.Book, to=G.Note)
    def R3(b: Any, n: Any) -> None:
        n.text = f"r3 {b.name}"
        t.set(n, about=b)

    @t.rule(L.Book, to=[G.Graph, G.Node], primary=True)
    def R4(b: Any, n: Any, o: Any) -> None:
        n.label = f"r4 {b.name}"
        o.label = "o4"

    @t.post
    def _() -> None:
        for b in L.Book.all_of_type:
            print(b.name, ", ".join(e.eClass.name for e in t.equivalents(b)))

    return t
