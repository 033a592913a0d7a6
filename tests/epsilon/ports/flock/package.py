"""The script of cases/flock/package, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import Flock


def port(Old: Any, New: Any) -> Flock:
    f = Flock(Old, New, lenient=True)
    f.retype("Comic", "library2::Book")
    f.retype_package("library", "library2")
    f.delete_package("other")

    @f.migrate("Book")
    def _(o: Any, m: Any) -> None:
        m.tags.append(f"was {o.eClass.name}")

    return f
