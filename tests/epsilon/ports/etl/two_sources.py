"""The script of cases/etl/two_sources, rule by rule."""

from __future__ import annotations

from typing import Any

from robosmi.query.numbers import round_
from robosmi.query.values import as_string
from robosmi.transform import ETL


def port(L: Any, P: Any, G: Any) -> ETL:
    t = ETL(L, P, G)

    @t.rule(P.Price, to=G.Note, name="P", guard=lambda p: L.Item.all.exists(lambda i: i.name == p.key))
    def Price(p: Any, n: Any) -> None:
        n.text = f"{p.key}={p.amount} {as_string(p.valid)}"
        t.set(n, about=L.Item.all.select_one(lambda i: i.name == p.key))

    @t.rule(L.Item, to=G.Node, greedy=True, name="I")
    def item(i: Any, n: Any) -> None:
        n.label = i.name
        p = P.Price.all.select_one(lambda p: p.key == i.name)
        if p is not None:
            n.remarks.append(t.equivalent(p))
            n.weight = round_(p.amount)

    @t.rule(P.PriceList, to=G.Graph)
    def PL(pl: Any, g: Any) -> None:
        t.set(g, notes=pl.prices, nodes=L.Item.all)

    return t
