"""The script of cases/evl/satisfies_guard_false, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query import is_kind_of
from robosmi.query.values import as_string
from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)

    @v.context(M.Book, guard=lambda b: b.year > 1900).constraint(guard=lambda b: b.genre.name == "science")
    def Guarded(b: Any) -> Any:
        return b.price < 15 or Fail(f"dear science {b.name}")

    @v.context(M.Item).constraint(guard=lambda i: is_kind_of(i, M.Book))
    def Ask(i: Any) -> Any:
        print(i.name, as_string(v.satisfies(i, "Guarded")))
        return True

    return v
