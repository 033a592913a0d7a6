"""A copy of each group."""

from __future__ import annotations

from typing import Any

from robosmi.query import ModelView
from robosmi.transform import ETL


def to_copy(t: ETL, P: ModelView, C: ModelView) -> None:
    """A group with the same name for each group."""

    @t.rule(P.Group, to=[C.Group])
    def Copy(group: Any, made: Any) -> None:
        made.name = group.name
