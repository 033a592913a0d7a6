"""The script of cases/flock/ignoring, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import Flock


def port(Old: Any, New: Any) -> Flock:
    f = Flock(Old, New)

    @f.migrate("Item", ignoring=["year"])
    def _(o: Any, m: Any) -> None:
        print("item", o.name)
        m.price = o.price + 1

    @f.migrate("Book", ignoring=["tags", "genre"], when=lambda o: o.price > 10)
    def _(o: Any, m: Any) -> None:
        print("book", o.name, m.price)
        m.tags.append("dear")

    @f.migrate("Book", strict=True)
    def _(o: Any, m: Any) -> None:
        print("strict", o.name)
        m.name += "!"

    f.migrate("Author", ignoring=["books"])
    return f
