"""The script of cases/evl/satisfies_before, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)
    book = v.context(M.Book)

    @book.constraint(guard=lambda b: v.satisfies(b, "First"))
    def Second(b: Any) -> Any:
        print("Second", b.name)
        return b.tags or Fail(f"Second {b.name}")

    @book.constraint
    def First(b: Any) -> Any:
        print("First", b.name)
        return b.year > 1900 or Fail(f"First {b.name}")

    return v
