"""The script of cases/evl/kind_not_type, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query import is_kind_of, is_type_of
from robosmi.validate import EVL


def port(M: Any) -> EVL:
    v = EVL(M)

    @v.context(M.Comic).constraint(message=lambda c: f"C1 {c.name}")
    def C1(c: Any) -> Any:
        print("C1", c.name)
        return False

    item = v.context(M.Item)

    @item.constraint(message=lambda i: f"I1 {i.name}")
    def I1(i: Any) -> Any:
        print("I1", i.name)
        return not is_type_of(i, M.Book)

    @item.constraint
    def I2(i: Any) -> Any:
        print("I2", i.name)
        return True

    @v.context(M.Book).constraint(message=lambda b: f"B1 {b.name}")
    def B1(b: Any) -> Any:
        print("B1", b.name)
        return is_kind_of(b, M.Comic)

    return v
