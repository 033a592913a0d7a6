"""Load every Fritzing sketch of a corpus, map its pins, and print what became of them.

Usage: python -m tests.corpus.hardware_corpus FOLDER [--only TEXT]. Run by hand. A sketch is loaded, refused (a message of ours
that names the fault of the file) or crashed, which is a fault of ours.
"""

from __future__ import annotations

import argparse
import time
import traceback
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from robosmi.errors import InternalError, RobosmiError


@dataclass(frozen=True)
class Outcome:
    """What became of one sketch.

    Attributes:
        path: relative to the corpus.
        state: loaded, refused or crashed.
        boards: how many boards are drawn.
        mappings: connections of pins to components.
        unknown: titles of parts of components on pins whose role is unknown.
        rules: of the findings.
        seconds: reading and mapping, in a process that has everything imported.
    """

    path: str
    state: str
    message: str = ""
    boards: int = 0
    mappings: int = 0
    unknown: tuple[str, ...] = ()
    rules: tuple[str, ...] = ()
    seconds: float = 0.0


@dataclass
class Table:
    """The outcomes of a run."""

    outcomes: list[Outcome] = field(default_factory=list)

    def count(self, state: str) -> int:
        """How many sketches ended in a state."""
        return sum(o.state == state for o in self.outcomes)

    def lines(self) -> list[str]:
        """The table as text."""
        loaded = [o for o in self.outcomes if o.state == "loaded"]
        boards = Counter(min(o.boards, 2) for o in loaded)
        unknown = Counter(title for o in loaded for title in o.unknown)
        times = sorted(o.seconds for o in loaded) or [0.0]
        lines = [
            f"sketches {len(self.outcomes)}: loaded {len(loaded)}, "
            f"refused {self.count('refused')}, crashed {self.count('crashed')}",
            f"boards: none {boards[0]}, one {boards[1]}, more {boards[2]}",
            f"mappings {sum(o.mappings for o in loaded)}, on components of unknown role {sum(unknown.values())}",
            f"seconds: median {times[len(times) // 2]:.3f}, longest {times[-1]:.3f}",
            "findings: " + ", ".join(f"{rule} {n}" for rule, n in sorted(Counter(r for o in loaded for r in o.rules).items())),
            *(f"  unknown: {title} ({number})" for title, number in unknown.most_common(20)),
        ]
        return lines + [f"{o.state}: {o.path} {o.message}".rstrip() for o in self.outcomes if o.state != "loaded"]


def outcome(path: Path, corpus: Path) -> Outcome:
    """Load and map one sketch."""
    from robosmi.transformations.chains.stages.reading import read_drawing
    from robosmi.transformations.queries.circuits.circuit import boards, hardware_report

    shown = str(path.relative_to(corpus))
    started = time.perf_counter()
    try:
        drawing = read_drawing(path, {})
        mappings = hardware_report(drawing.circuit, drawing.connections)["mappings"]
    except InternalError as error:
        return Outcome(shown, "crashed", str(error))
    except RobosmiError as error:
        return Outcome(shown, "refused", str(error))
    except Exception:
        return Outcome(shown, "crashed", traceback.format_exc())
    titles = {c.elementId: c.partTitle or c.partId for c in drawing.circuit.components}
    unknown = tuple(titles[m["component_model_index"]] for m in mappings if m["role"] == "Unknown")
    rules = tuple(f.rule for f in drawing.findings)
    seconds = time.perf_counter() - started
    return Outcome(shown, "loaded", "", len(boards(drawing.circuit)), len(mappings), unknown, rules, seconds)


def run(corpus: Path, only: str = "", workers: int = 2) -> Table:
    """Load all sketches of a corpus.

    Args:
        corpus: the folder.
        only: sketches whose path contains this.
        workers: processes.
    """
    paths = [p for p in sorted(corpus.rglob("*")) if p.suffix.lower() in (".fz", ".fzz") and only in str(p) and p.is_file()]
    with ProcessPoolExecutor(workers) as pool:
        return Table(list(pool.map(outcome, paths, [corpus] * len(paths), chunksize=8)))


def main() -> int:
    """The command line; the exit code is 1 when a sketch crashed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("corpus", type=Path)
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    table = run(arguments.corpus, arguments.only)
    print("\n".join(table.lines()))
    return int(table.count("crashed") > 0)


if __name__ == "__main__":
    raise SystemExit(main())
