"""The script of cases/flock/retype, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import Flock


def port(Old: Any, New: Any) -> Flock:
    f = Flock(Old, New)
    f.retype("Book", "Novel", when=lambda o: o.genre.name == "fiction")
    f.retype("Book", "Manual")
    f.retype("Journal", "Manual", when=lambda o: o.issue > 100)
    f.retype("Section", "Shelf")
    return f
