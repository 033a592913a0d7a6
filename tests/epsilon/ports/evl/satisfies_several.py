"""The script of cases/evl/satisfies_several, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query.values import as_string
from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)
    book = v.context(M.Book)

    @book.constraint(lazy=True)
    def T1(b: Any) -> Any:
        return True

    @book.constraint(lazy=True)
    def T2(b: Any) -> Any:
        return True

    @book.constraint(lazy=True)
    def F1(b: Any) -> Any:
        return Fail(f"F1 {b.name}")

    @book.constraint(lazy=True)
    def F2(b: Any) -> Any:
        return Fail(f"F2 {b.name}")

    @book.constraint(guard=lambda b: b.name == "Ants")
    def Ask(b: Any) -> Any:
        print("all T1 T2", as_string(v.satisfies_all(b, "T1", "T2")))
        print("all T1 F1", as_string(v.satisfies_all(b, "T1", "F1")))
        print("all F1 T1", as_string(v.satisfies_all(b, "F1", "T1")))
        print("all F1 F2", as_string(v.satisfies_all(b, "F1", "F2")))
        print("one T1 F1", as_string(v.satisfies_one(b, "T1", "F1")))
        print("one F1 T1", as_string(v.satisfies_one(b, "F1", "T1")))
        print("one F1 F2", as_string(v.satisfies_one(b, "F1", "F2")))
        print("plain T1 F2", as_string(v.satisfies(b, "T1", "F2")))
        print("plain F2 T1", as_string(v.satisfies(b, "F2", "T1")))
        return True

    return v
