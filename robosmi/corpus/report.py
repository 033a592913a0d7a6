"""The page of a corpus: one static file with tables that sort and filter, charts, and a section for each program.

It opens from a file. All data are in it as JSON, which the page's own script shows; nothing is loaded from elsewhere, which a
content security policy ensures.
"""

from __future__ import annotations

import base64
import hashlib
import os
from collections import defaultdict
from pathlib import Path
from typing import Any
from urllib.parse import quote

from robosmi import inputs
from robosmi.base.data_text import json_of, json_written
from robosmi.corpus.charts import bars, histogram
from robosmi.corpus.next_steps import clusters, greedy_cover
from robosmi.corpus.states import STATES
from robosmi.corpus.store import Store
from robosmi.files.files import write_atomic
from robosmi.generate import Gen
from robosmi.quoting import html_attribute
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
        states=bars([(state, float(counts[state]), state) for state in STATES], "programs by state"),
        chosen=chosen,
        best=bars([(each.function, float(each.calls), "plain") for each in chosen[:_SHOWN]], "call sites of missing bodies"),
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
