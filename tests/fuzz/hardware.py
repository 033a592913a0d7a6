"""Fuzz the reader of drawings and what follows it: damaged copies of real sketches, none of which may crash or hang.

Usage: python -m tests.fuzz.hardware [--inputs N] [--seed N] [--corpus FOLDER]. Run by hand (`make fuzz`), not by CI. An input
that ends in anything but a result or a `RobosmiError`, or takes longer than the limit (`costs`), is kept beside its traceback.
The same seed gives the same inputs.
"""

from __future__ import annotations

import argparse
import json
import random
import re
import sys
import tempfile
import traceback
import zipfile
from collections import Counter
from io import BytesIO
from pathlib import Path

from robosmi.errors import InternalError, RobosmiError
from tests.fuzz.costs import Costs, TooLong

ROOT = Path(__file__).resolve().parents[2]
SOURCES = (ROOT / "tests" / "transformations" / "t2m" / "fritzing" / "fixtures", ROOT / "docs" / "examples")
PARTS = sorted(SOURCES[0].glob("*.fzp"))
_VALUE = re.compile(rb'"[^"<>]{0,80}"')
_ELEMENT = re.compile(rb"<(connect|connector|instance|property|wireExtras|geometry|nodeMember|bus|view\w*|\w+View)\b[^<>]*/?>")
_ODD = (
    *(b"", b"-1", b"0", b"1", b"2", b"99999999999999999999", b"9" * 5000, b"x" * 3000, "Ω灯ß".encode(), b"connector0"),
    *(b"WireModuleID", b"NetLabelModuleID", b"GroundModuleID", b"ResistorModuleID", b"arduino_Uno_Rev3(fix)", b"breadboardView"),
    *(b"999.999Stripboard2ModuleID", b"generic_ic_dip_999_300mil"),
)


def mutated(data: bytes, other: bytes, chance: random.Random) -> bytes:
    """A damaged copy of a sketch: bytes, values or whole elements changed, lost, doubled or taken from another one."""
    rough = chance.random() < 0.25  # most of the others can still be read, and reach what comes after the reader
    for _ in range(chance.choice((1, 1, 2, 4, 16))):
        kind = chance.randrange(4) if rough else chance.randrange(4, 8)
        if kind == 0 and data:
            place = chance.randrange(len(data))
            data = data[:place] + bytes([chance.randrange(256)]) + data[place + 1 :]
        elif kind == 1 and data:
            place = chance.randrange(len(data))
            data = data[:place] + data[place + chance.randrange(1, 200) :]
        elif kind == 2:
            place = chance.randrange(len(data) + 1)
            start = chance.randrange(len(other) + 1)
            data = data[:place] + other[start : start + chance.randrange(1, 2000)] + data[place:]
        elif kind == 3 and data:
            data = data[: chance.randrange(len(data))]
        else:
            data = _changed_xml(data, chance, kind)
    return data


def _changed_xml(data: bytes, chance: random.Random, kind: int) -> bytes:
    spans = [m.span() for m in (_VALUE if kind < 7 else _ELEMENT).finditer(data)]
    if not spans:
        return data
    first, last = chance.choice(spans)
    if kind == 7:  # an element lost or doubled
        return data[:first] + data[first:last] * chance.choice((0, 2, 50)) + data[last:]
    a, b = chance.choice(spans)
    value = data[a:b] if chance.random() < 0.6 else b'"' + chance.choice(_ODD) + b'"'
    return data[:first] + value + data[last:]


def input_of(sketches: list[bytes], chance: random.Random) -> tuple[str, bytes]:
    """File ending and bytes of one input: a sketch, or an archive damaged inside or outside."""
    data = mutated(chance.choice(sketches), chance.choice(sketches), chance)
    if chance.random() < 0.8:
        return ".fz", data
    stream = BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(chance.choice(("a.fz", "../a.fz", "b/a.fz", "A.FZ", "")) or "none", data)
        for number in range(chance.randrange(3)):
            archive.writestr(f"part.{number}.fzp", mutated(chance.choice(PARTS).read_bytes(), b"<buses>", chance))
    packed = stream.getvalue()
    return ".fzz", mutated(packed, packed, chance) if chance.random() < 0.5 else packed


def run_one(path: Path) -> str:
    """Read, map, report and draw one input; "read" or "refused".

    Raises:
        Exception: a fault of ours.
    """
    from robosmi.transformations.chains.stages.reading import read_drawing
    from robosmi.transformations.m2t.circuits.circuit_picture import svg
    from robosmi.transformations.queries.circuits.circuit import hardware_report

    try:
        drawing = read_drawing(path, {})
    except InternalError:
        raise
    except RobosmiError as error:
        if not error.message:
            raise
        return "refused"
    json.dumps(hardware_report(drawing.circuit, drawing.connections))
    svg(drawing.circuit)
    return "read"


def main() -> int:
    """The command line; the exit code is 1 when an input crashed or hung."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--inputs", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--corpus", type=Path, action="append", default=[], help="a folder with further sketches")
    parser.add_argument("--keep", type=Path, default=Path("out") / "fuzz", help="where inputs that fail are kept")
    arguments = parser.parse_args()
    sketches = _sketches([*SOURCES, *arguments.corpus])
    chance = random.Random(arguments.seed)
    states, costs = Counter[str](), Costs()
    with tempfile.TemporaryDirectory() as scratch:
        for number in range(arguments.inputs):
            ending, data = input_of(sketches, chance)
            path = Path(scratch) / f"input{ending}"
            path.write_bytes(data)
            try:
                with costs.input():
                    state = run_one(path)
            except (Exception, TooLong):
                state = "failed"
                arguments.keep.mkdir(parents=True, exist_ok=True)
                (arguments.keep / f"{arguments.seed}-{number}{ending}").write_bytes(data)
                (arguments.keep / f"{arguments.seed}-{number}.txt").write_text(traceback.format_exc())
                print(f"{number}: {traceback.format_exc(limit=-1).strip()}", file=sys.stderr)
            states[state] += 1
    print(f"drawings: {sum(states.values())} inputs from {len(sketches)} sketches: {dict(states)}; {costs}")
    return int(states["failed"] > 0 or costs.over())


def _sketches(folders: list[Path]) -> list[bytes]:
    found = []
    for folder in folders:
        for path in sorted(folder.rglob("*.fz*")):
            if path.suffix == ".fz" and path.parent.name != "bad":
                found.append(path.read_bytes())
            elif path.suffix == ".fzz" and zipfile.is_zipfile(path):
                with zipfile.ZipFile(path) as archive:
                    found += [archive.read(name) for name in archive.namelist() if name.endswith(".fz")]
    return [data for data in found if len(data) < 400_000]


if __name__ == "__main__":
    sys.exit(main())
