"""The script of cases/flock/rename, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query import Q
from robosmi.transform import Flock


def port(Old: Any, New: Any) -> Flock:
    f = Flock(Old, New)

    @f.migrate("Item")
    def _(o: Any, m: Any) -> None:
        m.title = o.name
        m.cost = o.price * 100

    @f.migrate("Book")
    def _(o: Any, m: Any) -> None:
        f.set(m, writers=o.authors)
        print("book", o.name)

    @f.migrate("Member")
    def _(o: Any, m: Any) -> None:
        m.first = f.equivalent(Q(o.borrowed).first())

    @f.post
    def _() -> None:
        print("items", len(New.Item.all))

    return f
