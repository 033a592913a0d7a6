"""Fetches the programs and drawings that the ground-truth tests read, from the repositories of their authors.

    make corpus                                         into out/corpus and out/drawings
    python -m tests.corpus.fetch FOLDER [--from URL]    into FOLDER/corpus and FOLDER/drawings

Which files are wanted is data: `programs.csv` (Propeller C) and the tables of `drawings/` (EAGLE, KiCad, Wokwi) name repository,
commit and path. Only these commits are fetched, and of them only the files, by git. What cannot be had is listed with git's
reason (no network, the repository or the commit is gone, another content than the one that was labelled); all else is there, and
a file that lies there already is not fetched again. Exit 1 when something is missing. Nothing that is fetched is part of the
project: licences are the authors'.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path, PurePosixPath

HERE = Path(__file__).parent
SOURCES = {".c", ".h", ".cogc", ".cpp", ".s", ".spin", ".dat", ".side", ".inc"}
"""Endings of what is fetched beside a program with headers of its own."""
HEADERS = (
    ("parallaxinc/Simple-Libraries", "1cc167c103756e5772b533c833a0f34e6050f459", "Learn/Simple Libraries"),
    ("parallaxinc/propgcc", "b280e7a77103d479e82cc687711de6a45579ad70", "lib/include"),
)
"""Repository, commit and folder of the platform's own headers."""


@dataclass(frozen=True)
class Wanted:
    """A file, or the sources below a folder, of a commit.

    Attributes:
        repository: `OWNER/NAME`.
        commit: its full identifier.
        path: of the file or folder, `.` for the whole repository.
        place: where the repository's files go, relative to the folder that is filled.
        sha1: of the file's bytes; empty for any, and for folders.
        endings: those of the files that are wanted of a folder; empty for a file.
    """

    repository: str
    commit: str
    path: str
    place: str
    sha1: str = ""
    endings: frozenset[str] = frozenset()


def wanted() -> Iterator[Wanted]:
    """All that the tests can read."""
    for row in _rows(HERE / "programs.csv"):
        repository, commit, place = row["repository"], row["commit"], f"corpus/{row['repository']}"
        yield Wanted(repository, commit, row["path"], place, row["sha1"])
        if row["beside"]:
            yield Wanted(repository, commit, row["beside"], place, endings=frozenset(SOURCES))
    for repository, commit, folder in HEADERS:
        yield Wanted(repository, commit, folder, f"corpus/{repository}", endings=frozenset({".h"}))
    for table in sorted((HERE / "drawings").glob("*.csv")):
        for row in _rows(table):
            repository = row["repository"]
            yield Wanted(repository, row["commit"], row["path"], f"drawings/{repository.replace('/', '+')}")


def _rows(table: Path) -> Iterator[dict[str, str]]:
    with table.open(encoding="utf-8", newline="") as file:
        yield from csv.DictReader(file, delimiter=";")


def fetch(files: list[Wanted], folder: Path, source: str) -> Iterator[str]:
    """Fetch files into a folder; gives a line for everything that cannot be had.

    Args:
        files: what is wanted.
        folder: where it goes.
        source: the beginning of the repositories' addresses.
    """
    for (repository, commit), group in groupby(sorted(files, key=_commit_of), _commit_of):
        lacking = [one for one in group if one.endings or not _is_there(folder / one.place / one.path, one.sha1)]
        if lacking:
            with tempfile.TemporaryDirectory() as store:
                if reason := _fetched(store, f"{source}{repository}", commit):
                    yield f"{repository} at {commit[:10]}: {reason} ({len(lacking)} wanted)"
                else:
                    yield from _laid_out(store, lacking, folder)


def _commit_of(one: Wanted) -> tuple[str, str]:
    return one.repository, one.commit


def _is_there(path: Path, sha1: str) -> bool:
    return path.is_file() and sha1 in ("", hashlib.sha1(path.read_bytes()).hexdigest())


def _git(store: str, *words: str) -> tuple[bytes, str]:
    """What git prints, and the last line of why it fails; it asks nobody for a password."""
    environment = {**os.environ, "GIT_TERMINAL_PROMPT": "0"}
    done = subprocess.run(["git", "-C", store, *words], capture_output=True, env=environment, check=False)
    said = done.stderr.decode(errors="replace").strip().splitlines()
    return done.stdout, (said[-1] if said else f"git ends with {done.returncode}") if done.returncode else ""


def _fetched(store: str, address: str, commit: str) -> str:
    """Fetch one commit without its files' contents, which git then gets one by one; the reason where that fails."""
    for words in (["init", "--quiet"], ["remote", "add", "origin", address]):
        if (reason := _git(store, *words)[1]) != "":
            return reason
    return _git(store, "fetch", "--quiet", "--depth=1", "--filter=blob:none", "origin", commit)[1]


def _laid_out(store: str, files: list[Wanted], folder: Path) -> Iterator[str]:
    for one in files:
        paths = [one.path]
        if one.endings:
            under = [] if one.path == "." else ["--", one.path]
            listed = _git(store, "ls-tree", "-r", "-z", "--name-only", "FETCH_HEAD", *under)[0].decode(errors="surrogateescape")
            paths = [path for path in listed.split("\0") if PurePosixPath(path).suffix.lower() in one.endings]
        for path in paths:
            target = folder / one.place / path
            if not target.resolve().is_relative_to(folder.resolve()):
                yield f"{one.repository}: {path} leads out of the folder"
                continue
            data, reason = _git(store, "show", f"FETCH_HEAD:{path}")
            if not reason and one.sha1 not in ("", hashlib.sha1(data).hexdigest()):
                reason = "it is not the file that was labelled"
            if reason:
                yield f"{one.repository}/{path}: {reason}"
                continue
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(data)


def main(words: list[str]) -> int:
    """Fetch, and say what is there, what is missing and how the tests find it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument(
        "--from", dest="source", default="https://github.com/", help="where the repositories are, up to OWNER/NAME"
    )
    given = parser.parse_args(words)
    files = list(wanted())
    missing = list(fetch(files, given.folder, given.source))
    single = [one for one in files if not one.endings]
    there = sum((given.folder / one.place / one.path).is_file() for one in single)
    print(f"{there} of {len(single)} programs and drawings are in {given.folder}")
    print("\n".join(f"  cannot be had: {line}" for line in missing))
    print(f"run the tests with ROBOSMI_CORPUS={given.folder / 'corpus'} ROBOSMI_DRAWINGS={given.folder / 'drawings'}")
    return int(bool(missing))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
