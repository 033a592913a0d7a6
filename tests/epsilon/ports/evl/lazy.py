"""The script of cases/evl/lazy, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)
    book = v.context(M.Book)

    @book.constraint(lazy=True)
    def Priced(b: Any) -> Any:
        print("Priced", b.name)
        return b.price > 10 or Fail(f"low price {b.name}")

    @book.constraint(lazy=True)
    def NeverAsked(b: Any) -> Any:
        print("never")
        return False

    @book.constraint(guard=lambda b: b.genre.name == "fiction")
    def Fiction(b: Any) -> Any:
        return v.satisfies(b, "Priced") or Fail(f"Fiction {b.name}")

    return v
