"""The script of cases/evl/fix_scope, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL, Fail, Fix


def port(M: Any) -> EVL:
    v = EVL(M)

    @v.context(M.Section).constraint
    def Filled(s: Any) -> Any:
        n = len(s.items)
        wanted = f"New{n}"
        add = Fix(f"add {wanted}", lambda: s.items.append(M.Book(name=wanted, year=2000 + n)))
        return n > 0 or Fail(f"{s.name} has {n}", add, count=n)

    return v
