"""The script of cases/evl/pre_post, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query import ext
from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)
    limit = 0

    @v.pre
    def one() -> None:
        nonlocal limit
        limit = 10
        print("pre one")
        for b in M.Book.all:
            ext(b).rank = len(b.name)

    @v.pre
    def two() -> None:
        nonlocal limit
        limit += 5
        print("pre two", limit)

    @v.context(M.Book).constraint
    def Price(b: Any) -> Any:
        return b.price < limit or Fail(f"{b.name} above {limit}, rank {ext(b).rank}")

    @v.post
    def _() -> None:
        print("post first")

    @v.post
    def last() -> None:
        print("limit", limit)
        print("books", sum(ext(b).rank for b in M.Book.all))

    return v
