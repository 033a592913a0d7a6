"""The script of cases/evl/check_error, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query import Q
from robosmi.validate import EVL


def port(M: Any) -> EVL:
    v = EVL(M)

    @v.context(M.Book).constraint(message=lambda b: b.name)
    def FirstAuthor(b: Any) -> Any:
        first: Any = Q(b.authors).first()
        return len(first.name) > 2

    @v.context(M.Member).constraint(name="M")
    def M_(m: Any) -> Any:
        print(m.name)

    @v.post
    def _() -> None:
        print("post")

    return v
