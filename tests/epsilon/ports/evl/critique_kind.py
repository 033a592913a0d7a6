"""The script of cases/evl/critique_kind, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)
    book = v.context(M.Book)

    @book.constraint
    def Modern(b: Any) -> Any:
        return b.year > 1900 or Fail(f"{b.name} is old")

    @book.critique
    def Cheap(b: Any) -> Any:
        return b.price <= 20 or Fail(f"{b.name} costs {b.price}")

    @book.critique(info=True)
    def Short(b: Any) -> Any:
        return len(b.name) < 6 or Fail(f"{b.name} has {len(b.name)} letters")

    return v
