"""Ranking with the shipped index, and at the size of a whole registry.

An index of that many libraries is made of the shipped one's facts, each library several times under names of its own with a
part of its words exchanged, so that terms and postings grow as in a real registry. Measured in a new process: opening, a
query, memory; processor time, best of 3 processes.
"""

from __future__ import annotations

import json
import os
import random
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from tests.bench.figures import Figure

ROOT = Path(__file__).resolve().parents[2]
LIBRARIES = 10_000
BOUNDS = {"open_ms": 300.0, "query_ms": 50.0, "memory_mb": 300.0}
SHIPPED = {"open_ms": 60.0, "query_ms": 15.0, "memory_mb": 300.0}

MEASURE = """
import json, sys, time
from pathlib import Path
start = time.process_time()
from robosmi.recommend.component import ComponentQuery
from robosmi.transformations.knowledge.libraries.library_ranking import device_ranker, library_index
imported = time.process_time()
ranker = device_ranker(architecture="avr")
opened = time.process_time()
queries = [ComponentQuery.from_json(item) for item in json.loads(Path(sys.argv[1]).read_text())]
times = []
for query in queries:
    begin = time.process_time()
    ranker.rank(query, limit=10)
    times.append(time.process_time() - begin)
# not getrusage: a process begins with the peak of the one that started it
peak = next(int(line.split()[1]) / 1024 for line in open("/proc/self/status") if line.startswith("VmHWM"))
print(json.dumps({
    "libraries": len(library_index()), "open_ms": (opened - imported) * 1000, "query_ms": sum(times) / len(times) * 1000,
    "slowest_ms": max(times) * 1000, "memory_mb": peak,
}))
"""

QUERIES = [
    {"id": "1", "title": "Basic Servo", "family": "Servo", "tags": ["servo"]},
    {"id": "2", "title": "DHT22 Temperature and Humidity Sensor"},
    {"id": "3", "title": "Red LED - 5mm", "family": "LED", "tags": ["LED", "indicator"]},
    {
        "id": "4",
        "title": "Motor Driver 1A Dual TB6612FNG",
        "description": "Two motors at a constant current, controlled by PWM inputs",
    },
    {"id": "5", "title": "Barometric Pressure Sensor - BMP180 Breakout (GY-68)", "connectors": ["SDA", "SCL", "GND", "VCC"]},
    {"id": "6", "title": "128 x 64 Graphic LCD", "family": "Display"},
    {"id": "7", "title": "Grove 4 Digit Display", "family": "Grove", "tags": ["Button", "Grove"]},
    {"id": "8", "title": "sensor board with display and motor control over a serial interface", "tags": ["sensor", "display"]},
]


def grow(count: int, target: Path) -> None:
    """Write an index of that many libraries."""
    from robosmi.recommend.index import FIELDS
    from robosmi.recommend.library_record import HeaderRecord, LibraryRecord, write_index
    from robosmi.transformations.knowledge.libraries.library_ranking import library_index

    index, chance = library_index(), random.Random(1)
    said: list[dict[str, int]] = [{} for _ in range(len(index))]
    keywords: list[dict[str, int]] = [{} for _ in range(len(index))]
    identifiers: list[dict[str, int]] = [{} for _ in range(len(index))]
    for (term,) in index._all("SELECT term FROM fact"):
        libraries, columns = index.facts(term)
        for kept, name in ((said, "meta"), (keywords, "keyword"), (identifiers, "ident")):
            column = columns[FIELDS.index(name)]
            for place, library in enumerate(libraries if column else ()):
                if column[place]:
                    kept[library][term] = column[place]

    def changed(counts: dict[str, int], copy: int) -> dict[str, int]:
        return {(f"{w}{copy}" if copy and chance.random() < 0.2 else w): n for w, n in counts.items()}

    def record(number: int) -> LibraryRecord:
        copy, own = divmod(number, len(index))
        library = index.library(own)
        suffix = f" {copy}" if copy else ""
        header = HeaderRecord(library.header, True, changed(said[own], copy), changed(identifiers[own], copy))
        return LibraryRecord(
            f"{library.name}{suffix}", (library.header,), [header], library.version, architectures=library.architectures,
            said=changed(said[own], copy), keywords=changed(keywords[own], copy), copies=library.copies,
        )  # fmt: skip

    write_index(target, (record(number) for number in range(count)))


def measured(project: Path, queries: Path) -> dict[str, float]:
    """The figures of a new process that works in this folder."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "ROBOSMI_HOME": str(project / "home")}
    runs = [
        json.loads(
            subprocess.run(
                [sys.executable, "-c", MEASURE, str(queries)],
                cwd=project,
                env=environment,
                capture_output=True,
                text=True,
                check=True,
            ).stdout
        )
        for _ in range(3)
    ]
    return {name: min(run[name] for run in runs) for name in runs[0]}


def figures() -> Iterator[Figure]:
    """Time to open the index, time of a query, and peak memory."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        queries = folder / "queries.json"
        queries.write_text(json.dumps(QUERIES))
        (folder / "shipped").mkdir()
        grown = folder / "grown/.robosmi/platform_repo/arduino/libraries"
        grown.mkdir(parents=True)
        grow(LIBRARIES, grown / "index.sqlite")
        for project, bounds in ((folder / "shipped", SHIPPED), (folder / "grown", BOUNDS)):
            found = measured(project, queries)
            what = f"{found['libraries']:,.0f} libraries"
            yield Figure(f"{what}, open", found["open_ms"], "ms", bounds["open_ms"])
            yield Figure(
                f"{what}, query", found["query_ms"], "ms", bounds["query_ms"], note=f"slowest {found['slowest_ms']:.1f} ms"
            )
            yield Figure(f"{what}, peak memory", found["memory_mb"], "MB", bounds["memory_mb"])
