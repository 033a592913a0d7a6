"""The script of cases/evl/context_guard, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.validate import EVL, Fail


def port(M: Any) -> EVL:
    v = EVL(M)

    def young(i: Any) -> Any:
        print("guard", i.name)
        return i.year > 2000

    item = v.context(M.Item, guard=young)

    @item.constraint(message=lambda i: f"A {i.name}")
    def A(i: Any) -> Any:
        print("A", i.name)
        return False

    @item.constraint(message=lambda i: f"B {i.name}")
    def B(i: Any) -> Any:
        print("B", i.name)
        return i.price > 10

    @v.context(M.Member, guard=lambda m: m.borrowed).constraint
    def Few(m: Any) -> Any:
        return len(m.borrowed) < 2 or Fail(f"{m.name} has {len(m.borrowed)}")

    return v
