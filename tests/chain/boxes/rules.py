"""A copy of a box, and its name as a text."""

from __future__ import annotations

from typing import Any

from robosmi.generate import Gen
from robosmi.query import ModelView
from robosmi.transform import ETL


def copies(t: ETL, boxes: ModelView, made: ModelView) -> None:
    """A copy of each box."""

    @t.rule(boxes.Box, to=[made.Box])
    def Box(b: Any, m: Any) -> None:
        pass


def texts(g: Gen, made: ModelView) -> None:
    """A file for each box."""

    @g.rule(made.Box, template="box.txt", target="boxes.txt")
    def Box(b: Any) -> dict[str, Any]:
        return {}
