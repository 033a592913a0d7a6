"""The script of cases/flock/removed_types, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query.values import as_string
from robosmi.transform import Flock


def port(Old: Any, New: Any) -> Flock:
    f = Flock(Old, New)

    @f.migrate("Section")
    def _(o: Any, m: Any) -> None:
        print("section", o.name, as_string(m is not None))

    @f.migrate("Comic")
    def _(o: Any, m: Any) -> None:
        print("comic", as_string(m is not None), as_string(f.equivalent(o) is not None))

    @f.migrate("Member")
    def _(o: Any, m: Any) -> None:
        m.name = o.name.upper()

    return f
