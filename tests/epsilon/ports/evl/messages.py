"""The script of cases/evl/messages, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query.values import as_string
from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)

    @v.context(M.Book).constraint
    def A(b: Any) -> Any:
        return b.name != "Mills" or Fail(f"tags {', '.join(b.tags)} genre {as_string(b.genre)} {b.price}")

    author = v.context(M.Author)

    @author.constraint
    def B(a: Any) -> Any:
        return a.name != "Cy" or Fail(f"mentor {as_string(a.mentor)}")

    @author.critique
    def C(a: Any) -> Any:
        return not a.books or Fail(f"{a.name}: {', '.join(b.name for b in a.books)}")

    @v.context(M.Member).constraint
    def D(m: Any) -> Any:
        return Fail(", ".join(as_string(i.price) for i in m.borrowed))

    return v
