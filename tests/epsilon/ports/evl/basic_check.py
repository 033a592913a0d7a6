"""The script of cases/evl/basic_check, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query.values import as_string
from robosmi.validate import EVL


def port(M: Any) -> EVL:
    v = EVL(M)
    book = v.context(M.Book)

    @book.constraint(message=lambda b: f"Book {b.name} ({b.year}, {b.price}, {as_string(b.genre)}) has no author")
    def HasAuthor(b: Any) -> Any:
        return len(b.authors) > 0

    @book.constraint
    def Tagged(b: Any) -> Any:
        return b.tags

    return v
