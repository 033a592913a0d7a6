"""The script of cases/etl/rule_filter, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query.values import as_string
from robosmi.transform import ETL


def port(L: Any, G: Any) -> ETL:
    t = ETL(L, G)

    @t.rule(L.Book, to=G.Node)
    def R1(b: Any, n: Any) -> None:
        n.label = f"r1 {b.name}"

    @t.rule(L.Book, to=[G.Group, G.Note])
    def R2(b: Any, n: Any, o: Any) -> None:
        n.label = f"r2 {b.name}"
        o.text = f"o {b.name}"

    def kinds(elements: Any, separator: str = ", ") -> str:
        return separator.join(e.eClass.name for e in elements)

    @t.post
    def _() -> None:
        b = L.Book.all[0]
        print(t.equivalent(b, "R2").label)
        print(kinds(t.equivalents(b, "R2", "R1")))
        print(kinds(t.equivalents(b, "R2")))
        print(as_string(t.equivalent(b, "Nope")))
        print(len(t.equivalents(b, "Nope")))
        books = L.Book.all_of_type
        print(", ".join(e.label for e in t.equivalent(books, "R1")))
        print(", ".join(kinds(c, " + ") for c in t.equivalents(books, "R2")))
        print(kinds(t.equivalent(books)))
        print(len(t.equivalents([b, books[-1], b], "R2")))
        print(kinds(t.equivalent([b, books[-1], b], "R2")))

    return t
