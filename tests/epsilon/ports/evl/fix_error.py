"""The script of cases/evl/fix_error, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL, Fix


def port(M: Any) -> EVL:
    v = EVL(M)
    book = v.context(M.Book)

    def break_off(b: Any) -> None:
        b.year = 1901
        b.noSuchFeature = 1

    def misprice(b: Any) -> None:
        b.price = "x"

    @book.constraint(message=lambda b: b.name, fixes=[Fix("break", break_off)])
    def Modern(b: Any) -> Any:
        return b.year > 1900

    @book.constraint(message=lambda b: b.name, fixes=[Fix("raise", misprice)])
    def Dear(b: Any) -> Any:
        return b.price > 5

    return v
