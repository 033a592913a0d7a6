"""Which functions, symbols and types of the source platform that real programs use have no adapter yet, most used first.

`python -m tests.adapters.coverage [FOLDER]` reads all programs below the folder, else below that of ROBOSMI_CORPUS. Without
either it looks at what the covered headers declare, whether or not anybody uses it.
"""

from __future__ import annotations

import os
import sys
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.reports.analysis import analysis
from robosmi.transformations.t2m.c_source import read_program
from tests.adapters.bench import pieces
from tests.corpus.migrate_corpus import programs

UNSERVED = frozenset({
    "badgetools.h", "badgewxtools.h", "il3820.h", "simplegfx.h", "sound.h", "text2speech.h", "vgatext.h", "wavplayer.h", "wifi.h",
})  # fmt: skip
"""Headers of hardware that an Uno lacks."""
CORES = frozenset({"cog_run", "cog_end", "cog_num", "cogstart", "cognew", "coginit", "cogid", "cogstop", "_start_cog_thread"})
"""Functions about cores, which the program's structure replaces and no adapter does."""
STANDARD = frozenset({"time.h", "sys/time.h", "sys/unistd.h", "unistd.h"})
"""Standard headers with functions that the target lacks; of stdio.h it lacks some."""

Name = tuple[str, str, str]
"""Kind of a name, its header, and the name."""


def used(folder: Path) -> Counter[Name]:
    """How often the programs below a folder use each name of the platform."""
    api = ApiIndex.load("propeller")
    found: Counter[Name] = Counter()
    for files in programs(folder):
        program, findings = read_program(files)
        for unit in analysis(program, findings, api)["units"]:
            for call in unit["platform_calls"]:
                found["function", call["header"] or "", call["name"]] += call["count"] or 1
            for call in unit["standard_calls"]:
                if call["header"] in STANDARD:
                    found["function", call["header"], call["name"]] += 1
            found.update(("symbol", "", each["name"]) for each in unit["platform_symbols"])
            found.update(("type", each.get("header") or "", each["name"]) for each in unit["platform_types"])
    return found


def served() -> set[str]:
    """The names for which adapter files have pieces."""
    return {piece.name for piece in pieces() if piece.kind != "helper"}


def without_adapter(names: Iterable[Name]) -> list[Name]:
    """The names, of some, that an Uno could serve and that have no adapter."""
    there = served() | CORES
    return [name for name in names if name[1] not in UNSERVED and name[2] not in there]


def declared() -> list[Name]:
    """The functions of the headers that have adapter files."""
    api = ApiIndex.load("propeller")
    facts = api._facts.entries
    headers = {piece.header for piece in pieces()}
    return [
        ("function", entry.header, name) for name, entries in facts.items() for entry in entries
        if entry.header in headers and entry.kind == "function"
    ]  # fmt: skip


def main(folder: str = "") -> int:
    """Print the names without an adapter, and the share of calls with one."""
    place = folder or os.environ.get("ROBOSMI_CORPUS", "")
    if not place:
        for kind, header, name in sorted(without_adapter(declared()), key=lambda each: each[1:]):
            print(f"{header} {name} ({kind})")
        return 0
    counted = used(Path(place))
    missing = set(without_adapter(counted))
    for used_name, count in counted.most_common():
        if used_name in missing:
            kind, header, name = used_name
            print(f"{count:5} {kind:8} {header} {name}")
    calls = {each: count for each, count in counted.items() if each[0] == "function"}
    possible = sum(count for each, count in calls.items() if each[1] not in UNSERVED)
    lacking = sum(count for each, count in calls.items() if each in missing)
    print(f"{sum(calls.values())} calls, {possible} of what an Uno can serve, {possible - lacking} of those have an adapter")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
