"""The script of cases/evl/other_element, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)

    @v.constraint
    def HasLibrary() -> Any:
        print("HasLibrary")
        return M.Library.all

    @v.context(M.Named).constraint
    def NamedOk(n: Any) -> Any:
        print("NamedOk", n.name)
        return len(n.name) > 2 or Fail(f"short {n.name}")

    @v.context(M.Author).constraint(guard=lambda a: a.mentor is not None)
    def MentorOk(a: Any) -> Any:
        good = v.satisfies(a.mentor, "NamedOk") and v.satisfies(a, "HasLibrary")
        return good or Fail(f"{a.name} has a bad mentor")

    return v
