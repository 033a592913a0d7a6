"""The script of cases/flock/delete, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query.values import as_string
from robosmi.transform import Flock


def port(Old: Any, New: Any) -> Flock:
    f = Flock(Old, New)
    f.delete("Section", when=lambda o: o.name == "Robots")
    f.delete("Section", when=lambda o: o.name == "Stories", cascade=True)
    f.delete("Author", when=lambda o: len(o.books) == 2 and o.mentor is None)

    @f.migrate("Author")
    def _(o: Any, m: Any) -> None:
        print(o.name, as_string(m is not None))

    return f
