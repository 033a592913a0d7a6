"""The script of cases/evl/same_name, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)

    @v.context(M.Journal).constraint(name="Ok")
    def journal_ok(j: Any) -> Any:
        print("Journal.Ok", j.name)
        return True

    @v.context(M.Item).constraint(name="Ok")
    def item_ok(i: Any) -> Any:
        print("Item.Ok", i.name)
        return i.year > 2000 or Fail(f"item {i.name}")

    book = v.context(M.Book)

    @book.constraint(name="Ok")
    def book_ok(b: Any) -> Any:
        print("Book.Ok", b.name)
        return Fail(f"book {b.name}")

    @book.constraint
    def Ask(b: Any) -> Any:
        return v.satisfies(b, "Ok") or Fail(f"ask {b.name}")

    return v
