"""Figures of the generator: 10,000 files generated a second time, in which nothing may be written, against reading them.

The files have about 1 KB, three values of the model and a protected region each. The reference is `Path.read_bytes`
over the same files in the same run; each figure is the best of several, since other work only adds.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from robosmi.generate import Gen
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from tests.bench.figures import Figure

FILES = 10_000
BOUND = 3.0
ECORE = Path(__file__).parents[1] / "epsilon" / "eol" / "library.ecore"
TEMPLATE = (
    """\
// {{ b.name }}, of {{ b.year }}
double price() {
  return {{ b.price }};
}
{{ out.start_preserve("//", "", b.name, true) }}
// your own functions
{{ out.stop_preserve() }}
"""
    + "// A comment that all files have, as licences and such are, of which there are about ten lines.\n" * 9
)


def library() -> EmfModel:
    """A library with a book for each file."""
    metamodel = Metamodel.load(ECORE)
    model = EmfModel((), metamodel, "L")
    section = model.create("Section", name="all")
    model.create("Library", name="big", sections=[section])
    section.items.extend(metamodel.Book(name=f"Book{n}", year=1900 + n % 100, price=n / 4) for n in range(FILES))
    return model


def generation(model: EmfModel, folder: Path, keep: bool) -> Callable[[], Any]:
    """A function that generates all files."""

    def run() -> Any:
        g = Gen(folder, {"book": TEMPLATE}, [model], keep=keep)

        @g.rule(model.Book, template="book", target=lambda b: f"{b.name[-2:]}/{b.name}.txt")
        def Book(b: Any) -> None: ...

        return g.run()

    return run


def best(*runs: Callable[[], Any], times: int = 9) -> list[float]:
    """Seconds of the fastest run of each, the two taking turns."""
    found = [float("inf")] * len(runs)
    for _ in range(times):
        for number, run in enumerate(runs):
            start = time.perf_counter()
            run()
            found[number] = min(found[number], time.perf_counter() - start)
    return found


def figures() -> Iterator[Figure]:
    """The second generation against reading its files."""
    model = library()
    with tempfile.TemporaryDirectory() as name:
        for keep in (False, True):
            folder = Path(name) / ("keep" if keep else "plain")
            run = generation(model, folder, keep)
            start = time.perf_counter()
            run()
            first = time.perf_counter() - start
            paths = [folder / f"{b.name[-2:]}" / f"{b.name}.txt" for b in model.Book.all]
            again = run()
            assert again.written == [], "the second generation writes something"
            assert len(again.files) == len(paths) == FILES

            def read(paths: list[Path] = paths) -> None:
                for path in paths:
                    path.read_bytes()

            reading, second = best(read, run)
            note = f"{second:.2f} s to reading them; first {first:.2f} s" + ("; reads the last texts as well" if keep else "")
            what = f"{FILES:,} files generated again, {'keep' if keep else 'as EGL'}"
            yield Figure(what, second / reading, "x", None if keep else BOUND, note=note)
