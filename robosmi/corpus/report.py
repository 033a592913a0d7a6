"""The page of a corpus: one static file with tables that sort and filter, charts, and a section for each program.

It opens from a file. All data are in it as JSON, which the page's own script shows; nothing is loaded from elsewhere, which a
content security policy ensures. Bar charts are SVG texts; their colours are classes of the page's style.

The page also says what to do next: which missing bodies of functions would free most programs, and what stops programs. That is
a greedy cover by sets: the next functions are all those that one more program lacks, namely the set that frees most programs for
each function in it. Of equal sets the smaller comes first, then the one with more call sites.
"""

from __future__ import annotations

import base64
import hashlib
import math
import os
import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import quote

from msgspec import Struct

from robosmi import inputs
from robosmi.base.data_text import json_of, json_written
from robosmi.corpus.states import STATES
from robosmi.corpus.store import Store
from robosmi.files.files import write_atomic
from robosmi.generate import Gen
from robosmi.quoting import html, html_attribute
from robosmi.resources import built_in

FILE = "index.html"
_CHOSEN = 100
_SHOWN = 12
_NAMED = 5
"""Programs that a row names; the others are folded."""
_LACKING = (
    "SELECT calls.program, function, header, count(*) FROM calls JOIN programs ON programs.id = calls.program "
    "WHERE listed AND (has_body IS NULL OR NOT has_body) "
    "AND (disposition IS NULL OR disposition <> 'retain') GROUP BY calls.program, function, header"
)
_STOPPED = (
    "SELECT id FROM programs WHERE state NOT IN ('done', 'skipped') UNION SELECT program FROM compiles WHERE NOT ok OR NOT fits "
    "UNION SELECT program FROM findings WHERE severity = 'error' AND NOT task"
)
"""The programs that something else than a missing body stops."""

_WIDTH, _BAR, _LABEL = 640, 20, 200

_Function = tuple[str, str | None]
"""Name, and the header that declares it, or None."""


def write_report(store: Store, out: Path, folder: Path) -> Path:
    """Write the page.

    Args:
        store: the store of the corpus.
        out: its output folder, to which links lead.
        folder: where `index.html` goes; it is made if need be.

    Raises:
        SourceError: the store cannot be read, or the page cannot be written.
    """
    path = folder / FILE
    write_atomic(path, page(store, out, folder).encode("utf-8", "backslashreplace"))
    return path


def page(store: Store, out: Path, folder: Path) -> str:
    """The text of the page; see `write_report`."""
    programs = store.query(
        "SELECT id, state, step, message, seconds, peak_mb, labels, path FROM programs WHERE listed ORDER BY id"
    ).rows
    plans = {row[0]: row[1:] for row in store.query("SELECT program, tasks, open_choices, report FROM plans").rows}
    lacking = [(str(row[0]), str(row[1]), row[2], int(row[3])) for row in store.query(_LACKING).rows]
    open_calls: dict[str, int] = defaultdict(int)
    for program, _, _, count in lacking:
        open_calls[program] += count
    data = _data(store, programs, plans, open_calls, os.path.relpath(out, folder))
    counts = {state: sum(row[1] == state for row in programs) for state in STATES}
    stopped = {row[0] for row in store.query(_STOPPED).rows}
    chosen = greedy_cover([row for row in lacking if row[0] not in stopped], _CHOSEN)
    open_programs = {row[0] for row in lacking}
    return Gen(templates=_folder()).text(
        "index.html.j2",
        total=len(programs),
        counts=counts,
        states=_bars([(state, float(counts[state]), state) for state in STATES], "programs by state"),
        chosen=chosen,
        best=_bars([(each.function, float(each.calls), "plain") for each in chosen[:_SHOWN]], "call sites of missing bodies"),
        lacking=len(open_programs),
        left_out=len(open_programs & stopped),
        shown=_NAMED,
        stopped=clusters((row[0], row[1], row[2], row[3]) for row in programs if row[1] != "done"),
        rules=_rules(store),
        effort=histogram([float(open_calls.get(row[0], 0)) for row in programs], "calls", "calls without a body by program"),
        times=histogram([float(row[4] or 0) for row in programs], "s", "time by program"),
        slowest=sorted(programs, key=lambda row: -(row[4] or 0))[:_SHOWN],
        largest=sorted(programs, key=lambda row: -(row[5] or 0))[:_SHOWN],
        head=_head(),
        foot=_foot(data),
    )


def _rules(store: Store) -> list[tuple[Any, ...]]:
    """Rule, severity, findings and programs of each rule of warnings and errors, the most frequent first."""
    return store.query(
        "SELECT rule, severity, count(*), count(DISTINCT program), min(findings.message) FROM findings "
        "JOIN programs ON programs.id = findings.program WHERE listed AND severity <> 'info' "
        "GROUP BY rule, severity ORDER BY 4 DESC, rule LIMIT 40"
    ).rows


def _data(
    store: Store,
    programs: list[tuple[Any, ...]],
    plans: dict[str, tuple[Any, ...]],
    open_calls: dict[str, int],
    way: str,
) -> dict[str, Any]:
    """What the page's script shows. Names that return are numbers into `names`, so that the page stays small."""
    names: dict[str, int] = {}
    found: dict[str, dict[str, Any]] = {}
    rows: list[list[Any]] = []
    for program, state, step, message, seconds, peak, labels, path in programs:
        tasks, choices, made = plans.get(program, (None, None, None))
        link = f"{quote(Path(way).as_posix())}/{quote(made)}" if made else None
        section: dict[str, Any] = {"m": message, "s": step, "p": path, "l": json_of(labels or "{}"), "c": [], "f": [], "r": link}
        found[program] = section
        rows.append([program, state, seconds, peak, open_calls.get(program, 0), tasks, choices, section])

    def number(name: str) -> int:
        return names.setdefault(name, len(names))

    calls = (
        "SELECT program, function, header, has_body, count(*), min(line) FROM calls GROUP BY program, function, header, has_body"
    )
    with store.reading(calls) as (_, answers):
        for program, function, header, body, count, line in answers:
            if program in found:
                found[program]["c"].append(
                    [number(function), number(header or ""), -1 if body is None else int(body), count, line]
                )
    findings = (
        "SELECT program, rule, severity, message, count(*), min(line) FROM findings WHERE severity <> 'info' "
        "GROUP BY program, rule, severity, message"
    )
    with store.reading(findings) as (_, answers):
        for program, rule, severity, message, count, line in answers:
            if program in found:
                found[program]["f"].append([number(rule), number(severity), number(message), count, line])
    for table, key in (("compiles", "k"), ("verdicts", "v")):
        columns = "ok, fits, flash, ram, target" if key == "k" else "verdict, outputs, outputs_of"
        for program, *values in store.query(f"SELECT program, {columns} FROM {table}").rows:
            if program in found:
                found[program][key] = values
    return {"names": list(names), "programs": rows}


def _head() -> str:
    """The policy, which allows this page's own style and script and nothing else, and the style."""
    style, script = _text("corpus.css"), _text("corpus.js")
    policy = f"default-src 'none'; style-src {_hash(style)}; script-src {_hash(script)}; base-uri 'none'; form-action 'none'"
    content = html_attribute(policy)
    return f'<meta http-equiv="Content-Security-Policy" content="{content}">\n<style>{style}</style>'


def _foot(data: dict[str, Any]) -> str:
    """The data, in which no text ends the element, and the script."""
    text = json_written(data, separators=(",", ":")).replace("<", "\\u003c")
    return f'<script type="application/json" id="data">{text}</script>\n<script>{_text("corpus.js")}</script>'


def _folder() -> Path:
    return built_in("templates") / "corpus"


def _text(name: str) -> str:
    return inputs.read_text(_folder() / name, inputs.DATA)


def _hash(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def _bars(rows: Sequence[tuple[str, float, str]], title: str) -> str:
    """Horizontal bars.

    Args:
        rows: label, value and class of each bar.
        title: what a screen reader reads.
    """
    most = max((value for _, value, _ in rows), default=0) or 1
    parts = [f'<svg viewBox="0 0 {_WIDTH} {_BAR * len(rows)}" role="img" aria-label="{html(title)}" class="chart">']
    for number, (label, value, kind) in enumerate(rows):
        top, length = number * _BAR, (_WIDTH - _LABEL - 80) * value / most
        parts.append(
            f'<text x="{_LABEL - 6}" y="{top + 14}" text-anchor="end">{html(label[:34])}<title>{html(label)}</title></text>'
            f'<rect x="{_LABEL}" y="{top + 3}" width="{max(length, 1):.1f}" height="{_BAR - 6}" class="{html(kind)}"/>'
            f'<text x="{_LABEL + length + 5:.1f}" y="{top + 14}">{value:,g}</text>'
        )
    return "".join([*parts, "</svg>"])


def histogram(values: Sequence[float], unit: str, title: str) -> str:
    """How many values lie in each of up to ten ranges, whose bounds are 1, 2 or 5 times a power of ten apart.

    Args:
        values: what is counted.
        unit: behind the bounds.
        title: what a screen reader reads.
    """
    if not values:
        return ""
    most = max(values)
    whole = all(value == int(value) for value in values)
    width = _step(max(most / 10, 1.0 if whole else 0.0)) if most > 0 else 1.0
    counts = [0] * (int(most / width) + 1)
    for value in values:
        counts[int(value / width)] += 1
    rows = [(_range(number * width, width, whole, unit), float(count), "plain") for number, count in enumerate(counts)]
    return _bars(rows, title)


def _range(first: float, width: float, whole: bool, unit: str) -> str:
    """The label of a range; its upper bound belongs to the next one."""
    if not whole:
        return f"{first:g} to below {first + width:g} {unit}".rstrip()
    return f"{first:g} {unit}".rstrip() if width == 1 else f"{first:g} to {first + width - 1:g} {unit}".rstrip()


def _step(least: float) -> float:
    """The smallest number of 1, 2 and 5 times a power of ten that is not below."""
    power = 10.0 ** math.floor(math.log10(least))
    return next(step * power for step in (1, 2, 5, 10) if step * power >= least * (1 - 1e-9))


class Missing(Struct, frozen=True):
    """A function without a body, as the cover chooses it.

    Attributes:
        function: its name.
        header: the header that declares it; None if nothing known does, so that a fact is missing, too.
        calls: its call sites in all programs.
        programs: number of programs that call it.
        frees: the programs that lack nothing more once it and all before it have a body.
        freed: the number of these for all chosen so far.
    """

    function: str
    header: str | None
    calls: int
    programs: int
    frees: Sequence[str]
    freed: int


def greedy_cover(lacks: Iterable[tuple[str, str, str | None, int]], most: int) -> list[Missing]:
    """The functions to write next, best first.

    Args:
        lacks: program, function, header and number of calls, for each function that lacks a body.
        most: number of functions that are chosen.
    """
    lacked: dict[str, set[_Function]] = defaultdict(set)
    users: Counter[_Function] = Counter()
    calls: Counter[_Function] = Counter()
    for program, name, header, count in lacks:
        function = (name, header)
        users[function] += function not in lacked[program]
        lacked[program].add(function)
        calls[function] += count
    left: dict[frozenset[_Function], list[str]] = defaultdict(list)
    for program, functions in lacked.items():
        left[frozenset(functions)].append(program)
    chosen: list[Missing] = []
    freed = 0
    while left and len(chosen) < most:
        best = _best(left, calls)
        for function in sorted(best, key=lambda each: (-calls[each], each[0], each[1] or "")):
            remaining: dict[frozenset[_Function], list[str]] = defaultdict(list)
            for lacking, names in left.items():
                remaining[lacking - {function}] += names
            frees = sorted(remaining.pop(frozenset(), ()))
            left = remaining
            freed += len(frees)
            chosen.append(Missing(*function, calls[function], users[function], frees, freed))
    return chosen[:most]


def _best(left: dict[frozenset[_Function], list[str]], calls: Counter[_Function]) -> frozenset[_Function]:
    """The set of functions that frees most programs for each of its functions.

    Args:
        left: functions -> the programs that lack just these.
        calls: call sites of each function.
    """
    shared = Counter(function for functions in left for function in functions)
    with_rarest: dict[_Function, list[frozenset[_Function]]] = defaultdict(list)
    for functions in left:  # a set lies within another only if its rarest function does
        with_rarest[min(functions, key=lambda each: (shared[each], each[0], each[1] or ""))].append(functions)

    def worth(functions: frozenset[_Function]) -> tuple[float, int, int, list[tuple[str, str]]]:
        within = (inner for function in functions for inner in with_rarest.get(function, ()) if inner <= functions)
        frees = sum(len(left[inner]) for inner in within)
        names = sorted((name, header or "") for name, header in functions)
        return -frees / len(functions), len(functions), -sum(calls[each] for each in functions), names

    return min(left, key=worth)


_QUOTED = re.compile(r"'[^']*'|\"[^\"]*\"")
_PLACE = re.compile(r"^(?:/|[A-Za-z]:\\)[^:\n]*(?::\d+)*: ")
_NUMBER = re.compile(r"\d+(?:\.\d+)?")


def kind_of_message(message: str) -> str:
    """A message without what differs from program to program: its place, names in quotes, numbers."""
    return _NUMBER.sub("N", _QUOTED.sub("'...'", _PLACE.sub("", message)))


class Cluster(Struct):
    """Programs that are stopped by the same.

    Attributes:
        state, step: where they ended.
        kind: their messages without what differs.
        programs: their number.
        examples: the first few of them.
    """

    state: str
    step: str
    kind: str
    programs: int = 0
    examples: list[str] = []


def clusters(stopped: Iterable[tuple[str, str, str | None, str | None]]) -> list[Cluster]:
    """What stops programs, the most frequent first.

    Args:
        stopped: id, state, step and message of each program that is not done.
    """
    found: dict[tuple[str, str, str], Cluster] = {}
    for program, state, step, message in stopped:
        kind = kind_of_message(message or "")
        cluster = found.setdefault((state, step or "", kind), Cluster(state, step or "", kind, examples=[]))
        cluster.programs += 1
        if len(cluster.examples) < 5:
            cluster.examples.append(program)
    return sorted(found.values(), key=lambda cluster: (-cluster.programs, cluster.kind))
