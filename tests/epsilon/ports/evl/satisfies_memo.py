"""The script of cases/evl/satisfies_memo, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)
    book = v.context(M.Book)

    @book.constraint
    def HasAuthor(b: Any) -> Any:
        print("HasAuthor", b.name)
        return b.authors or Fail(f"no author: {b.name}")

    @book.constraint(guard=lambda b: v.satisfies(b, "HasAuthor"))
    def AuthorKnown(b: Any) -> Any:
        print("AuthorKnown", b.name)
        return b.authors[0].name != "Cy" or Fail(f"by Cy: {b.name}")

    return v
