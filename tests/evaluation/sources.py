"""Where other people's programs and drawings are, of which only labels are in the project: what `make corpus` fetches.

Folders, in this order: the one that is given; ROBOSMI_CORPUS (programs) or ROBOSMI_DRAWINGS (drawings); `out` of the checkout.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
LABELS = Path(__file__).resolve().parent / "labels"
FETCH = "make corpus"
"""The command that fetches all of them."""


def read_lines(path: Path) -> list[dict[str, Any]]:
    """The labels of a file, which has one on each line."""
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def _folders(kind: str, variable: str, given: Path | None) -> Iterator[Path]:
    for folder in (given, Path(named) if (named := os.environ.get(variable)) else None, ROOT / "out"):
        if folder is not None:
            yield from (folder / kind, folder)


def corpus_folder(given: Path | None = None) -> Path | None:
    """The folder with the programs of at least one labelled repository; None if there is none."""
    for folder in _folders("corpus", "ROBOSMI_CORPUS", given):
        if (folder / "parallaxinc" / "Simple-Libraries").is_dir():
            return folder
    return None


def program_file(label: Mapping[str, Any], corpus: Path) -> Path | None:
    """A labelled program, if it is in the corpus and is the file that was labelled."""
    path: Path = corpus / label["repository"] / label["path"]
    return path if path.is_file() and hashlib.sha1(path.read_bytes()).hexdigest() == label["sha1"] else None


def sketch_file(label: Mapping[str, Any], given: Path | None = None) -> Path | None:
    """A labelled drawing, if it is there and is the file that was labelled."""
    for folder in _folders("drawings", "ROBOSMI_DRAWINGS", given):
        path: Path = folder / label["repository"].replace("/", "+") / label["path"]
        if path.is_file() and hashlib.sha256(path.read_bytes()).hexdigest() == label["sha256"]:
            return path
    return None
