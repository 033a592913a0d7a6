"""Regenerates sketches and template files that are edited in between, and judges whether an edit was lost silently.

Usage: python -m tests.fuzz.edits [--runs N] [--seed N]. By hand (`make fuzz`); `tests/chains/test_regenerations.py` has a short
form. Between two runs a file is edited in one of ten ways, and the program, the drawing or the elements are changed. The
generated text is known from runs into empty folders; `edits_judge` knows nothing of the merge. The same seed gives the same
runs.
"""

from __future__ import annotations

import argparse
import random
import re
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from robosmi.diagnostics import Finding
from robosmi.errors import RobosmiError, StoppedError
from robosmi.transformations.chains.stages.models import LAST
from robosmi.transformations.m2t.program_files import REPORT
from tests.fuzz.edits_arenas import ARENAS, Arena
from tests.fuzz.edits_judge import BOM, Round, faults

Edit = Callable[[list[str], random.Random, str], list[str]]
_WORD = re.compile(r"\b[A-Za-z_]\w{3,}\b")


def filled(lines: list[str], chance: random.Random, mark: str) -> list[str]:
    """Write a body in place of a placeholder, or text into a region."""
    places = [n for n, line in enumerate(lines) if "TODO" in line or "default of" in line] or [chance.randrange(len(lines) + 1)]
    place = chance.choice(places)
    return [*lines[:place], f"  int {mark} = 1;", f"\tdigitalWrite(13, {mark});  // {mark} body", *lines[place + 1 :]]


def renamed(lines: list[str], chance: random.Random, mark: str) -> list[str]:
    """Rename something wherever it occurs."""
    words = sorted({word for line in lines for word in _WORD.findall(line) if "region" not in line})
    if not words:
        return lines
    old = re.compile(rf"\b{chance.choice(words)}\b")
    return [line if "region" in line else old.sub(f"{mark}_new", line) for line in lines]


def inserted(lines: list[str], chance: random.Random, mark: str) -> list[str]:
    """Insert a few lines, sometimes the same ones twice."""
    place = chance.randrange(len(lines) + 1)
    again = "  // EDIT again"
    new = chance.choice(([f"  int {mark} = 2;"], [f"// {mark}", "", f"\tint {mark} = 3;\t"], [again, again]))
    return [*lines[:place], *new, *lines[place:]]


def deleted(lines: list[str], chance: random.Random, mark: str) -> list[str]:
    """Delete a few lines, or all of them."""
    if chance.random() < 0.03:
        return []
    place = chance.randrange(len(lines) + 1)
    return lines[:place] + lines[place + chance.choice((1, 1, 2, 5)) :]


def moved(lines: list[str], chance: random.Random, mark: str) -> list[str]:
    """Move a few lines."""
    place = chance.randrange(len(lines) + 1)
    block, rest = lines[place : place + 3], lines[:place] + lines[place + 3 :]
    other = chance.randrange(len(rest) + 1)
    return [*rest[:other], *block, *rest[other:]]


def reformatted(lines: list[str], chance: random.Random, mark: str) -> list[str]:
    """Change white space like an editor or a formatter, in a part of the file or everywhere."""
    first, last = sorted(chance.randrange(len(lines) + 1) for _ in range(2))
    kind = chance.randrange(4)
    part = lines if chance.random() < 0.3 else lines[first:last]
    if kind == 0:
        part = [line.rstrip() for line in part]
    elif kind == 1:
        part = [line.replace("  ", "\t") for line in part]
    elif kind == 2:
        part = [f"  {line}" if line.strip() else line for line in part]
    else:
        part = [one for line in part for one in ([line[:-1].rstrip(), "{"] if line.endswith(" {") else [line])]
    return part if len(part) >= len(lines) else [*lines[:first], *part, *lines[last:]]


def commented(lines: list[str], chance: random.Random, mark: str) -> list[str]:
    """Append a comment to a line."""
    if not lines:
        return lines
    place = chance.randrange(len(lines))
    return [*lines[:place], f"{lines[place]}  // {mark}", *lines[place + 1 :]]


def damaged(lines: list[str], chance: random.Random, mark: str) -> list[str]:
    """Damage a marker of a region or of a conflict: lost, doubled, crowded, with another id, or off."""
    places = [n for n, line in enumerate(lines) if " region " in line or line[:4] in ("<<<<", "||||", "====", ">>>>")]
    if not places:
        return inserted(lines, chance, mark)
    place = chance.choice(places)
    line = lines[place]
    other = chance.choice(
        ([], [line, line], [f"{line} {mark}"], [line.replace("region ", f"region {mark}")], [f"  {line}\t"], [line[:-2]],
         [line.replace(" on begin", " off begin")], [line.replace("//", "//// ")])
    )  # fmt: skip
    return [*lines[:place], *other, *lines[place + 1 :]]


TEXT_EDITS: dict[str, Edit] = {
    "filled": filled, "renamed": renamed, "inserted": inserted, "deleted": deleted, "moved": moved, "reformatted": reformatted,
    "comment": commented, "markers damaged": damaged,
}  # fmt: skip
FORM_EDITS = ("line ends", "byte order mark")
KINDS = [*TEXT_EDITS, *FORM_EDITS]


def edited(data: bytes, kind: str, chance: random.Random, mark: str) -> bytes:
    """The file with one edit."""
    if kind == "byte order mark":
        return data[len(BOM) :] if data.startswith(BOM) else BOM + data
    if kind == "line ends":
        return _other_ends(data, chance)
    marked = data.startswith(BOM)
    parts = re.split(rb"(\r\n|\r|\n)", data[len(BOM) if marked else 0 :])
    usual = (Counter(parts[1::2]).most_common(1) or [(b"\n", 0)])[0][0]
    own = dict(zip(parts[::2], parts[1::2], strict=False))
    whole = data.endswith((b"\n", b"\r"))
    texts = [part.decode(errors="surrogateescape") for part in (parts[::2][:-1] if whole else parts[::2])]
    new = [line.encode(errors="surrogateescape") for line in TEXT_EDITS[kind](texts, chance, mark)]
    joined = b"".join(line + own.get(line, usual) for line in new)
    return (BOM if marked else b"") + (joined if whole or not new else joined.removesuffix(own.get(new[-1], usual)))


def _other_ends(data: bytes, chance: random.Random) -> bytes:
    kind = chance.randrange(5)
    if kind == 4:  # the last one
        return data.rstrip(b"\r\n") if data.endswith(b"\n") else data + b"\n"
    ends = ([b"\r\n"], [b"\r"], [b"\n"], [b"\r\n", b"\n"])[kind]
    return re.sub(rb"\r\n|\r|\n", lambda _: chance.choice(ends), data)


def decided(data: bytes, chance: random.Random) -> bytes:
    """The file with its conflicts resolved: one side, the other, or both."""
    keep = chance.choice((b"\\1", b"\\2", b"\\1\\2"))
    end = rb"(?:\r\n|\r|\n)"
    conflict = (
        rb"<<<<<<< yours" + end + rb"(.*?)\|\|\|\|\|\|\| last generated" + end + rb".*?=======" + end
        + rb"(.*?)>>>>>>> generated(?:" + end + rb"|$)"
    )  # fmt: skip
    return re.sub(conflict, keep, data, flags=re.DOTALL)


@dataclass
class Tally:
    """The counts of all runs."""

    edits: Counter[str] = field(default_factory=Counter)
    outcomes: Counter[str] = field(default_factory=Counter)
    runs: int = 0
    wrong: list[str] = field(default_factory=list)

    def lines(self) -> list[str]:
        """The counts."""
        return [
            f"regenerations {self.runs}: {len(self.wrong)} faults",
            f"  edits {sum(self.edits.values())}: {dict(self.edits)}",
            f"  edited files: {dict(self.outcomes)}",
        ]


def regenerations(arena: Arena, folder: Path, chance: random.Random, runs: int, tally: Tally) -> None:
    """Generate, edit, change the input, generate again and judge, so many times."""
    arena.make(folder)
    base = arena.fresh()
    for number in range(runs):
        before = {name: (folder / name).read_bytes() for name in base if (folder / name).is_file()}
        for name in sorted(before):
            if b">>>>>>> generated" in before[name] and chance.random() < 0.7:
                before[name] = decided(before[name], chance)
        kinds = _edit(before, chance, tally.runs)
        tally.edits.update(kinds)
        _put(folder, before, base)
        if chance.random() < 0.85:
            arena.change(chance)
        tally.runs += 1
        made = arena.fresh()
        whole = {path: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}
        problems: list[str]
        try:
            findings = arena.make(folder)
        except StoppedError as stopped:
            tally.outcomes["stopped"] += 1
            now = {path: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}
            problems = [] if now == whole and stopped.fix else ["a run that stopped changed something"]
            if not problems:
                _way_out(folder, base, str(stopped))
        except RobosmiError as error:
            problems = [f"{type(error).__name__}: {error}"]
        else:
            made |= _reports(folder)
            problems = list(_judged(folder, whole, findings, before, base, made, tally))
            base = made
        tally.wrong += [f"{arena.name} {number} {kinds}: {problem}" for problem in problems]
        if problems:
            return


def _reports(folder: Path) -> dict[str, bytes]:
    """The reports of the run itself: they tell of conflicts in this folder, which a run into an empty folder cannot have."""
    last = folder / LAST
    return {path.relative_to(last).as_posix(): path.read_bytes() for path in last.rglob(REPORT)}


def _edit(before: dict[str, bytes], chance: random.Random, run: int) -> list[str]:
    kinds = []
    for turn in range(chance.choice((1, 1, 2, 4))):
        name = chance.choice(sorted(before))
        if chance.random() < 0.02:
            before.pop(name)
            kinds.append("file deleted")
        else:
            kinds.append(chance.choice(KINDS))
            before[name] = edited(before[name], kinds[-1], chance, f"EDIT{run}_{turn}")
        if not before:
            break
    return kinds


def _put(folder: Path, texts: Mapping[str, bytes], known: Mapping[str, bytes]) -> None:
    for name in known:
        if name not in texts:
            (folder / name).unlink(missing_ok=True)
    for name, data in texts.items():
        if (folder / name).read_bytes() != data:
            (folder / name).write_bytes(data)


def _way_out(folder: Path, base: Mapping[str, bytes], said: str) -> None:
    """Do what a user does whom a run has stopped: restore the generated file, which always helps."""
    named = [name for name in base if name in said]
    for name in named or list(base):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(base[name])


def _judged(
    folder: Path,
    whole: Mapping[Path, bytes],
    findings: list[Finding],
    before: Mapping[str, bytes],
    base: Mapping[str, bytes],
    made: Mapping[str, bytes],
    tally: Tally,
) -> Iterator[str]:
    rules: dict[str, set[str]] = {}
    for finding in findings:
        if finding.location is not None:
            rules.setdefault(str(Path(finding.location.path).resolve()), set()).add(finding.rule)
    for name in sorted({*base, *made}):
        path = folder / name
        after = path.read_bytes() if path.is_file() else None
        old = [p.read_bytes() for p in path.parent.glob(f"{path.name}.orig*") if p not in whole]
        said = rules.get(str(path.resolve()), set())
        yield from (
            f"{name}: {fault}"
            for fault in faults(Round(name, base.get(name), before.get(name), made.get(name), after, said, old))
        )
        if before.get(name) != base.get(name):
            shown = sorted(said & {"RS510", "RS511", "RS513", "RS514", "RS516", "RS517", "RS518", "RS519", "RS522"})
            tally.outcomes[" ".join(shown) or "kept"] += 1


def run(runs: int, seed: int, *, each: int = 12) -> Tally:
    """Use all arenas in turn, and a new one after so many regenerations or after a fault."""
    tally, chance = Tally(), random.Random(seed)
    with tempfile.TemporaryDirectory() as scratch:
        number = 0
        while tally.runs < runs:
            arena = ARENAS[number % len(ARENAS)](Path(scratch) / f"input{number}", chance)
            regenerations(arena, Path(scratch) / f"out{number}", chance, min(each, runs - tally.runs), tally)
            number += 1
    return tally


def main() -> int:
    """The command line; the exit code is 1 when an edit was lost."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=1200)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    tally = run(arguments.runs, arguments.seed)
    print("\n".join(["edits:", *tally.lines(), *tally.wrong]))
    return int(bool(tally.wrong))


if __name__ == "__main__":
    sys.exit(main())
