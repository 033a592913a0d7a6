"""Mutated XMI into the reader: nothing but our own errors may come out, and what is read is written and read again.

`make fuzz`, or `python -m tests.fuzz.xmi [--seconds N] [--seed N]`. Not part of the test run. The seeds are the files of
`tests/model/xmi`; a file that breaks the rule is kept in the folder that is named at the end.
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import tempfile
import time
import traceback
from collections import Counter
from pathlib import Path

from robosmi.errors import ModelError, RobosmiError, SourceError
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.xmi.xmi_reader import read_documents
from robosmi.model.xmi.xmi_writer import to_xmi
from tests.fuzz.costs import Costs, TooLong

TESTS = Path(__file__).resolve().parents[1]
SEEDS = sorted((TESTS / "model" / "xmi").rglob("*.xmi"))
WORDS = [
    b'//@items.0', b'//@items.99999999999999999999', b'/1', b'#/', b'#', b'xmi:id', b'xsi:type', b'xsi:nil="true"',
    b'href', b'-1', b'kitchen:Leaf', b'kitchen:Root', b'sub:SubLeaf', b'ecore:EClass', b'&amp;', b'&#0;',
    b'&#x1F600;', b'&e;', b'<![CDATA[', b']]>', b'\xff', b'\x00', b'999999999999999999999999999999', b'1e999999',
    b'NaN', b'%', b'%zz', b'@', b"[name='a']", b'?', b'<items/>', b'<items>', b'</items>', b'xmlns=""',
    b'xmlns:kitchen="http://www.omg.org/XMI"', b'<!DOCTYPE a>', b'<!-- -->', b'encoding="UTF-16"', b'encoding="idna"',
    b'\n\n\n\n\n',
]  # fmt: skip
PIECES = re.compile(rb"""<[^>]*>|[^<]+""")
VALUES = re.compile(rb'"[^"]*"')


def mutated(data: bytes, other: bytes, chance: random.Random) -> bytes:
    """The data with one to four changes: bytes, words, elements moved, doubled or taken away, values exchanged."""
    for _ in range(chance.randint(1, 4)):
        place = chance.randrange(len(data) + 1)
        kind = chance.randrange(8)
        if kind == 0:
            data = data[:place] + bytes([chance.randrange(256)]) + data[place + chance.randrange(2) :]
        elif kind == 1:
            data = data[:place] + chance.choice(WORDS) + data[place + chance.randrange(4) :]
        elif kind == 2:
            data = data[:place] + data[place + chance.randrange(20) :]
        elif kind == 3:
            data = data[:place] if chance.random() < 0.2 else data
        elif kind in (4, 5):
            pieces = PIECES.findall(data)
            if pieces:
                one = chance.randrange(len(pieces))
                pieces[one : one + 1] = chance.choice(([], [pieces[one]] * 2, [chance.choice(PIECES.findall(other) or [b""])]))
                data = b"".join(pieces)
        else:
            spans = [match.span() for match in VALUES.finditer(data)]
            values = VALUES.findall(other) + [b'"' + word + b'"' for word in WORDS]
            if spans:
                start, end = chance.choice(spans)
                data = data[:start] + chance.choice(values) + data[end:]
    return data


def check(path: Path, metamodel: Metamodel) -> str:
    """Read a file, and if that works write it and read it again; the outcome in a word.

    Raises:
        AssertionError: what was written is not what was read.
        Exception: whatever the reader or writer raises that is no error of ours.
    """
    try:
        documents = read_documents(path, metamodel)
    except (SourceError, ModelError) as error:
        if error.location is None or not str(error):
            raise AssertionError(f"no place or no cause: {error!r}") from error
        return "refused"
    names = {f"{index}.xmi": document.roots for index, document in enumerate(documents.values())}
    try:
        texts = to_xmi(names)
    except ModelError:
        return "read, not written"
    for name, text in texts.items():
        (path.parent / name).write_bytes(text)
    again = read_documents(path.parent / "0.xmi", metamodel, strict=False)
    if set(again) == {path.parent / name for name in names}:
        assert to_xmi({file.name: document.roots for file, document in again.items()}) == texts
    return "read and written"


def main() -> int:
    """Mutate until the time is up."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--seconds", type=float, default=60)
    arguments.add_argument("--seed", type=int, default=0, help="the same seed gives the same files")
    given = arguments.parse_args()
    metamodel = Metamodel.load(TESTS / "emf" / "kitchen.ecore")
    chance = random.Random(given.seed)
    seeds = [path.read_bytes() for path in SEEDS]
    folder = Path(tempfile.mkdtemp(prefix="robosmi-fuzz-"))
    found: Counter[str] = Counter()
    costs = Costs()
    end = time.monotonic() + given.seconds
    while time.monotonic() < end:
        file = folder / "case.xmi"
        file.write_bytes(mutated(chance.choice(seeds), chance.choice(seeds), chance))
        try:
            with costs.input():
                state = check(file, metamodel)
            found[state] += 1
        except (Exception, TooLong) as error:
            kind = "an error of ours in the wrong place" if isinstance(error, RobosmiError) else type(error).__name__
            found[f"BROKEN: {kind}"] += 1
            file.rename(folder / f"broken{sum(found.values())}.xmi")
            traceback.print_exc()
    print(f"models: {sum(found.values())} files, seed {given.seed}: {dict(found)}; {costs}")
    broken = costs.over() or any(name.startswith("BROKEN") for name in found)
    if broken:
        print(f"kept in {folder}")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
