"""The script of cases/flock/copy, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.transform import Flock


def port(Old: Any, New: Any) -> Flock:
    return Flock(Old, New)
