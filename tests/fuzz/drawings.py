"""Fuzz the readers of Wokwi, EAGLE and KiCad and what follows them: damaged copies of drawings, none may crash or hang.

Usage: python -m tests.fuzz.drawings [--inputs N] [--seed N] [--every BYTES] [--corpus FOLDER]. Run by hand (`make fuzz`); a small
share is in `make test`. Each drawing is cut off at every so many bytes: it is refused, or gives no pin that the whole one has
not. Others have bytes, values or entries changed, lost, doubled or taken from another drawing, stand in another encoding, or
have ten thousand brackets in them: each is read, stored, drawn and reported, or refused with place, cause and what to do. What
ends otherwise, or takes longer than the limit (`costs`), is kept beside its traceback. The same seed gives the same inputs.
"""

from __future__ import annotations

import argparse
import json
import random
import re
import sys
import tempfile
import traceback
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from robosmi.errors import InternalError, RobosmiError
from tests.fuzz.costs import Costs, TooLong

ROOT = Path(__file__).resolve().parents[2]
DRAWINGS = ROOT / "tests" / "transformations" / "t2m" / "drawing_readers"
TOOLS = ("wokwi", "eagle", "kicad")
ENDINGS = (".json", ".sch", ".kicad_sch", ".net")
Pins = frozenset[tuple[str, str]]
"""Pins of the board, each with the component on it."""

_VALUE = re.compile(rb'"[^"<>()]{0,80}"|(?<=[ (])-?[0-9.]+(?=[ )\n])')
_ODD = (
    *(b'""', b'"-1"', b"-1", b"0", b"NaN", b"-Infinity", b"1e999", b"9" * 5_000, b'"' + b"9" * 5_000 + b'"'),
    *(b"null", b"true", b"[]", b"{}", b"()", b'"\\ud800"', b'"\xed\xa0\x80"', b'"\x00"', b'"&a;"', b'"a:b:c"'),
    *(b'"uno"', b'"uno:GND.1"', b'"D[0..99999]"', b'"{A B{C D{E}}}"', b'"../../../etc/passwd"', b'"GND"', b'"U1"'),
    *(b'"$serialMonitor:RX"', b'"' + b"x" * 3_000 + b'"', '"\u03a9\u706f\u00df"'.encode()),
)
_DEEP = (b"[" * 10_000, b"(" * 10_000, b"<a>" * 10_000, b'{"a":' * 10_000)
_ENCODINGS = ("utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "latin-1", "utf-32")


def sources(folders: list[Path]) -> list[Path]:
    """The drawings to begin with."""
    found = [p for tool in TOOLS for p in sorted((DRAWINGS / tool).rglob("*.*"))]
    found += [p for folder in folders for p in sorted(folder.rglob("*.*"))]
    return [p for p in found if p.suffix in ENDINGS and p.stat().st_size < 400_000]


def damaged(data: bytes, other: bytes, chance: random.Random) -> bytes:
    """A damaged copy of a drawing."""
    for _ in range(chance.choice((1, 1, 2, 4, 16))):
        kind = chance.randrange(9)
        place = chance.randrange(len(data) + 1)
        if kind == 0:
            data = data[:place] + bytes([chance.randrange(256)]) + data[place + 1 :]
        elif kind == 1:
            data = data[:place] + data[place + chance.randrange(1, 200) :]
        elif kind == 2:
            start = chance.randrange(len(other) + 1)
            data = data[:place] + other[start : start + chance.randrange(1, 2_000)] + data[place:]
        elif kind == 3 and chance.random() < 0.1:
            data = data[:place] + chance.choice(_DEEP) + data[place:]
        elif kind == 4 and chance.random() < 0.2:
            data = data.decode("utf-8", "replace").encode(chance.choice(_ENCODINGS), "replace")
        elif kind == 5:
            lines = data.splitlines(keepends=True)
            if lines:
                first = chance.randrange(len(lines))
                last = min(len(lines), first + chance.randrange(1, 4))
                data = b"".join((*lines[:first], *lines[first:last] * chance.choice((0, 2, 30)), *lines[last:]))
        elif spans := [found.span() for found in _VALUE.finditer(data)]:
            (first, last), (a, b) = chance.choice(spans), chance.choice(spans)
            data = data[:first] + (data[a:b] if chance.random() < 0.5 else chance.choice(_ODD)) + data[last:]
    return data


def read_through(path: Path, store: Path | None = None) -> Pins | None:
    """Read a drawing with all later steps; the pins of its boards, or None if it is refused properly.

    Args:
        path: the drawing.
        store: where to store its model, or None.

    Raises:
        Exception: a fault of ours.
        RobosmiError: a refusal without place or advice.
        AssertionError: a finding without a place.
    """
    from robosmi.model import save_model
    from robosmi.transformations.chains.hardware import hardware

    try:
        made = hardware(path)
    except InternalError:
        raise
    except RobosmiError as error:
        if not error.message or error.location is None or not error.fix:
            raise
        return None
    assert all(f.message and f.location is not None for f in made.findings)
    json.dumps(made.result)
    made.picture().encode("utf-8")
    "\n".join(made.lines())
    if store is not None:
        save_model(made.circuit, store)
    return frozenset((m["pin"], m["component"]) for m in made.result["mappings"])


def cut(path: Path, every: int, folder: Path) -> Iterator[tuple[int, bytes]]:
    """Copies of a drawing, cut off, in its own place of a copy of its folder; where each ends, and its bytes."""
    data = path.read_bytes()
    for length in range(0, len(data.rstrip()), every):
        (folder / path.name).write_bytes(data[:length])
        yield length, data[:length]


def beside(path: Path, folder: Path) -> Path:
    """A copy of a drawing with the other files of its folder, which it may need."""
    for old in folder.iterdir():
        old.unlink()
    for file in path.parent.iterdir():
        if file.is_file() and file.stat().st_size < 1_000_000:
            (folder / file.name).write_bytes(file.read_bytes())
    return folder / path.name


def main() -> int:
    """The command line; the exit code is 1 when an input crashed, hung or gave a wrong pin."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--inputs", type=int, default=10_000)
    parser.add_argument("--every", type=int, default=97, help="bytes between one place to cut off and the next")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--corpus", type=Path, action="append", default=[], help="a folder with further drawings")
    parser.add_argument("--keep", type=Path, default=Path("out") / "fuzz", help="where inputs that fail are kept")
    arguments = parser.parse_args()
    found = sources(arguments.corpus)
    chance, states, costs = random.Random(arguments.seed), Counter[str](), Costs()
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "drawing"
        folder.mkdir()

        def tried(path: Path, what: str, whole: Pins | None = None) -> None:
            try:
                with costs.input():
                    pins = read_through(path, Path(scratch) / "stored.xmi")
                assert whole is None or pins is None or pins <= whole, f"wrong pins: {sorted(pins - whole)}"
                state = "refused" if pins is None else "read"
            except (Exception, TooLong):
                state = "failed"
                arguments.keep.mkdir(parents=True, exist_ok=True)
                (arguments.keep / f"{what}{path.suffix}").write_bytes(path.read_bytes())
                (arguments.keep / f"{what}.txt").write_text(traceback.format_exc(), errors="replace")
                print(f"{what}: {traceback.format_exc(limit=-1).strip()}", file=sys.stderr)
            states[state] += 1

        for number, path in enumerate(found):
            copy = beside(path, folder)
            whole = read_through(copy) or frozenset()
            for length, _ in cut(path, arguments.every, folder):
                tried(copy, f"cut-{number}-{length}", whole)
        cuts = sum(states.values())
        for number in range(arguments.inputs):
            path = chance.choice(found)
            copy = beside(path, folder)
            copy.write_bytes(damaged(path.read_bytes(), chance.choice(found).read_bytes(), chance))
            tried(copy, f"{arguments.seed}-{number}")
    print(f"drawings: {len(found)} drawings, {cuts} cut off, {arguments.inputs} damaged: {dict(states)}; {costs}")
    return int(states["failed"] > 0 or costs.over())


if __name__ == "__main__":
    sys.exit(main())
