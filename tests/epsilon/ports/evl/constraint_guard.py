"""The script of cases/evl/constraint_guard, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL


def port(M: Any) -> EVL:
    v = EVL(M)
    book = v.context(M.Book)

    @book.constraint(guard=lambda b: b.genre is M.Genre.history, message=lambda b: f"{b.name} of {b.year}")
    def Old(b: Any) -> Any:
        print("check", b.name)
        return b.year > 1900

    @book.constraint(guard=lambda b: b.genre.name == "fiction", message=lambda b: f"cheap fiction {b.name}")
    def Fiction(b: Any) -> Any:
        return b.price > 5

    return v
