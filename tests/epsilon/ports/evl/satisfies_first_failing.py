"""The script of cases/evl/satisfies_first_failing, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)
    book = v.context(M.Book)
    n = 0

    @book.constraint
    def Never(b: Any) -> Any:
        nonlocal n
        n += 1
        return Fail(f"Never {b.name} no. {n}")

    @book.constraint
    def Ask(b: Any) -> Any:
        return v.satisfies(b, "Never") or True

    return v
