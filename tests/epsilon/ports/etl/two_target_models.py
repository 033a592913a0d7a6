"""The script of cases/etl/two_target_models, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query import is_type_of
from robosmi.transform import ETL


def depth(s: Any) -> int:
    return 1 + depth(s.parent) if s.parent is not None else 0


def port(L: Any, G: Any, R: Any) -> ETL:
    t = ETL(L, G, R)

    @t.rule(L.Section, to=[G.Group, R.Line])
    def S(s: Any, g: Any, r: Any) -> None:
        g.label = s.name
        r.text = s.name
        r.level = depth(s)
        g.inner.extend([e for e in t.equivalent(s.sections) if is_type_of(e, G.Group)])

    @t.rule(L.Library, to=R.Report)
    def L1(library: Any, r: Any) -> None:
        r.title = library.name
        r.lines.extend([t.equivalents(s).select_one(lambda e: is_type_of(e, R.Line)) for s in L.Section.all])

    return t
