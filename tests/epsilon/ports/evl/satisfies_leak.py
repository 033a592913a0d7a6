"""The script of cases/evl/satisfies_leak, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query.values import as_string
from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)
    author = v.context(M.Author)

    @author.constraint(lazy=True)
    def Long(a: Any) -> Any:
        return len(a.name) > 2 or Fail(f"short {a.name}")

    @author.constraint(lazy=True)
    def Silent(a: Any) -> Any:
        return len(a.name) > 2

    @author.constraint(guard=lambda a: a.mentor is not None)
    def Ask(a: Any) -> Any:
        before = a.name
        r = v.satisfies(a.mentor, "Silent")
        print(before, as_string(r), "now", a.name)
        r = v.satisfies(a.mentor, "Long")
        print(before, as_string(r), "now", a.name)
        return r or Fail(f"asked by {a.name} before {before}")

    return v
