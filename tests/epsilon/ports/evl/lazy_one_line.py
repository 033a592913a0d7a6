"""The script of cases/evl/lazy_one_line, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)
    book = v.context(M.Book)

    @book.constraint(lazy=True)
    def Lost(b: Any) -> Any:
        return False

    @book.constraint
    def Kept(b: Any) -> Any:
        return b.year > 1900 or Fail(b.name)

    return v
