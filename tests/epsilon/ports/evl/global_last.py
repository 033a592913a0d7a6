"""The script of cases/evl/global_last, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)

    @v.critique(message="G1")
    def G1() -> Any:
        print("G1")
        return False

    @v.constraint
    def G2() -> Any:
        print("G2")
        return len(M.Book.all) > 100 or Fail(f"only {len(M.Book.all)} books")

    @v.context(M.Member).constraint(message=lambda m: m.name)
    def M1(m: Any) -> Any:
        print("M1", m.name)
        return m.borrowed

    @v.constraint(guard=lambda: len(M.Library.all) == 1)
    def G3() -> Any:
        library = M.Library.all[0]
        return library.name == "Town" or Fail(f"wrong town {library.name}")

    return v
