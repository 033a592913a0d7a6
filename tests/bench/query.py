"""Queries over 100,000 model elements against plain comprehensions over the same list.

Both sides give the same answer, which is checked. Ratios of medians measured in one run, turn by turn, since seconds on a
noisy machine tell little. A query may take twice as long as its comprehension.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from robosmi.model.ecore.metamodel import Metamodel
from robosmi.query import ModelView, Q
from tests.bench.figures import Figure

ROOT = Path(__file__).resolve().parents[2]
SECTIONS, BOOKS, RUNS, BOUND = 1000, 100, 11, 2.0


def library() -> tuple[Q[Any], Q[Any]]:
    """The sections and the books of a library."""
    metamodel = Metamodel.load(ROOT / "tests" / "epsilon" / "eol" / "library.ecore")
    view = ModelView((), metamodel.packages, "L")
    root = view.create("Library", name="bench")
    for number in range(SECTIONS):
        section = view.create("Section", name=f"s{number}")
        root.sections.append(section)
        for i in range(BOOKS):
            book = view.create("Book", name=f"b{number * BOOKS + i}", year=1900 + (number * 7919 + i * 104729) % 120)
            book.price = float((i * 37) % 91)
            section.items.append(book)
    return Q(root.sections), view.all("Book")


def medians(query: Callable[[], Any], plain: Callable[[], Any]) -> tuple[float, float]:
    """Median seconds of both, measured in turns."""
    times: tuple[list[float], list[float]] = ([], [])
    for _ in range(RUNS):
        for run, found in zip((query, plain), times, strict=True):
            start = time.perf_counter()
            run()
            found.append(time.perf_counter() - start)
    return statistics.median(times[0]), statistics.median(times[1])


def figures() -> Iterator[Figure]:
    """Ratios of queries to comprehensions."""
    sections, books = library()
    plain, shelves = books.list(), sections.list()
    rows: list[tuple[str, Callable[[], Any], Callable[[], Any]]] = [
        ("select", lambda: books.select(lambda b: b.year > 1960), lambda: [b for b in plain if b.year > 1960]),
        ("collect", lambda: books.collect(lambda b: b.name), lambda: [b.name for b in plain]),
        ("q.name", lambda: books.name, lambda: [b.name for b in plain]),
        (
            "nested sum",
            lambda: sections.collect(lambda s: Q(s.items).price.sum()).sum(),
            lambda: sum([sum([b.price for b in s.items]) for s in shelves]),
        ),
        ("sort_by", lambda: books.sort_by(lambda b: b.year), lambda: sorted(plain, key=lambda b: b.year)),
    ]
    for title, query, comprehension in rows:
        assert query() == comprehension(), title
        ours, theirs = medians(query, comprehension)
        note = f"{ours * 1000:.1f} ms to a comprehension of {theirs * 1000:.1f} ms"
        yield Figure(f"query, {len(plain):,} elements, {title}", ours / theirs, "x", BOUND, note=note)
