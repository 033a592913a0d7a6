"""Every command in every odd world of `tests/hostile_world.py`, and with every damaged input in each place that is read.

Usage: python -m tests.fuzz.environments [--only WORD]. Run by hand (`make fuzz`), not by CI. What breaks the contract is printed.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from functools import partial
from pathlib import Path

from tests.broken_packages import worlds_of_packages
from tests.hostile_world import BAD_TEXTS, EXPRESSIONS, SETTINGS, World, commands, prepared, run, worlds, wrong

PLACES = (
    "in/line_follower.c",
    "in/line_following_robot.fzz",
    "in/robosmi.toml",
    "out/models/plan.xmi",
    "out/models/code.xmi",
    "out/.robosmi.json",
    "out/line_follower/sketch.yaml",
    "out/line_follower/line_follower.ino",
    "history.csv",
    "books.csv",
    "chain.toml",
    "libraries/Mine/library.properties",
    "libraries/Mine/library.json",
    "libraries/Mine/src/Mine.h",
    "parts/my_motor.fzp",
    "headers/mine.h",
    "home/platform_repo/propeller/platform.toml",
    "home/platform_repo/defaults.toml",
    "home/history.sqlite",
    "home/metamodels/trace.ecore",
    ".robosmi/platform_repo/parts.toml",
    "in/compile_commands.json",
)
"""Files of a prepared folder that are damaged, or put there, for the commands that may read them."""
KINDS = ("pipe", "device", "folder", "loop", "large")


def readers_of(place: str) -> Iterator[str]:
    """The commands that may read a file."""
    first = place.partition("/")[0]
    yield from {
        "in": ("analyse", "migrate", "hardware", "recommend"),
        "out": ("generate", "check", "compile", "migrate again"),
        "history.csv": ("history import",),
        "books.csv": ("query", "run"),
        "chain.toml": ("run",),
        "libraries": ("libraries",),
        "parts": ("parts",),
        "headers": ("platform",),
        "home": ("analyse", "migrate", "history list", "doctor"),
        ".robosmi": ("hardware",),
    }[first]


def put(path: Path, kind: str) -> None:
    """Put something damaged in the place of a file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.is_dir():
        shutil.rmtree(path)
    path.unlink(missing_ok=True)
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "device":
        path.symlink_to("/dev/zero")
    elif kind == "folder":
        path.mkdir()
    elif kind == "loop":
        path.symlink_to(path.name)
    elif kind == "large":
        path.write_bytes(b"")
        os.truncate(path, 3 << 30)
    else:
        path.write_bytes(BAD_TEXTS[kind])


def _set(folder: Path, text: str) -> None:
    """Write a project file."""
    (folder / "in" / "robosmi.toml").write_text(text)


def _put(folder: Path, file: str, kind: str) -> None:
    """Put something that is no proper file in the place of a file."""
    put(folder / file, kind)


def _named(folder: Path, odd: str) -> None:
    """Copy the program under an odd name."""
    shutil.copy(folder / "in" / "line_follower.c", folder / odd)


def cases(place: Path) -> Iterator[tuple[str, list[str], World, bool, bool]]:
    """Name, words, world, whether output is JSON that can be read, whether errors can be read."""
    known = commands(place) | {
        "migrate again": ["migrate", str(place / "in" / "line_follower.c"), "-o", str(place / "out")],
        "analyse database": ["analyse", str(place / "in" / "compile_commands.json")],
    }
    for world in (*worlds(), *worlds_of_packages()):
        deaf = "output" in world.name or "streams" in world.name
        mute = "error" in world.name or "streams" in world.name
        for name in commands(place):
            for flags in ([], ["--json"]) if name != "help" else ([],):
                yield f"{world.name}: {name} {' '.join(flags)}", [*known[name], *flags], world, bool(flags) and not deaf, not mute
    for text in SETTINGS:
        for name in ("analyse", "migrate"):
            world = World("settings", before=partial(_set, text=text))
            yield f"robosmi.toml {text[:40]!r}: {name}", [*known[name], "--json"], world, True, True
    for expression in EXPRESSIONS:
        if len(expression) < 100_000 and "\x00" not in expression and "\ud800" not in expression:
            yield (
                f"query {expression[:40]!r}",
                ["query", str(place / "books.csv"), expression, "--json"],
                World("query"),
                True,
                True,
            )
    for file in PLACES:
        for kind in (*BAD_TEXTS, *KINDS):
            world = World("input", before=partial(_put, file=file, kind=kind))
            for name in readers_of(file):
                yield f"{file} is {kind}: {name}", [*known[name], "--json"], world, True, True
    for odd in ("\udcff.c", "a\nb.c", "-x.c", "x" * 250 + ".c", "\u202e.c", "é.c", "a;b.c", '"'):
        for command in ("analyse", "migrate"):
            world = World("name", before=partial(_named, odd=odd))
            words = [
                command,
                str(place / odd),
                *(["-o", str(place / "named")] if command == "migrate" else ["-o", str(place / "c.xmi")]),
            ]
            yield f"named {odd[:20]!r}: {command}", [*words, "--json"], world, True, True


def main() -> int:
    """Run all cases, or those whose name holds a word."""
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--only", default="", help="a word in the names of the cases to run")
    given = arguments.parse_args()
    found: Counter[str] = Counter()
    slowest = 0.0
    with tempfile.TemporaryDirectory(prefix="robosmi-worlds-") as whole:
        first = Path(whole, "first")
        first.mkdir()
        prepared(first)
        place = Path(whole, "now")
        for name, words, world, as_json, told in cases(place):
            if given.only not in name:
                continue
            shutil.rmtree(place, ignore_errors=True)
            shutil.copytree(first, place, symlinks=True)
            done = run(words, world, place)
            verdict = wrong(done, as_json=as_json, told=told)
            found["wrong" if verdict else "ok"] += 1
            slowest = max(slowest, done.seconds)
            if verdict:
                print(f"WRONG {name}: {verdict}: {(done.err or done.out)[-300:]!r}")
                sys.stdout.flush()
    print(f"environments: {sum(found.values())} runs: {dict(found)}; slowest {slowest:.2f} s of processor time")
    return 1 if found["wrong"] else 0


if __name__ == "__main__":
    sys.exit(main())
