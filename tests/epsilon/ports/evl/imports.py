"""The script of cases/evl/imports, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL


def other(M: Any) -> EVL:
    v = EVL(M)

    @v.pre
    def _() -> None:
        print("pre of other")

    @v.context(M.Member).constraint(message=lambda m: f"other {m.name}")
    def Other(m: Any) -> Any:
        print("Other", m.name)
        return m.borrowed

    @v.post
    def _() -> None:
        print("post of other")

    return v


def young(i: Any) -> bool:
    return bool(i.year > 2000)


def port(M: Any) -> EVL:
    v = EVL(M)
    v.include(other(M))

    @v.context(M.Book).constraint(message=lambda b: f"own {b.name}")
    def Own(b: Any) -> Any:
        print("Own", b.name)
        return young(b)

    return v
