"""The memory use measured by the last compile of the program in an output folder, if that still is the generated program.

`compile` stores the sizes in its record beside the program. The report shows them only while every compiled file is unchanged.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path

from robosmi.errors import RobosmiError
from robosmi.metamodels import migration
from robosmi.verify.toolchains.build_record import FOLDER, record_at

_SIZES = {"flashBytes": "flash_bytes", "flashLimit": "flash_limit", "ramBytes": "ram_bytes", "ramLimit": "ram_limit",
          "stackBytes": "stack_bytes"}  # fmt: skip


def stored_build_sizes(output: Path, name: str, files: Mapping[str, bytes]) -> migration.Build | None:
    """The sizes of a program, or None if it has not been compiled in its current state.

    Args:
        output: the output folder.
        name: of the program, which is its folder's, too.
        files: relative path -> bytes of what is made there.
    """
    try:
        record = record_at(output / FOLDER / f"{name}.build.json")
    except RobosmiError:
        return None  # a damaged record says nothing; `compile` and `upload` report it
    if record is None or not record.sizes or not _same(record.sources, name, files):
        return None
    return migration.Build(board=record.board, **{feature: record.sizes.get(key, 0) for feature, key in _SIZES.items()})


def _same(compiled: Mapping[str, str], name: str, files: Mapping[str, bytes]) -> bool:
    """Whether the compiled files equal the generated ones; the user's own additional files are ignored."""
    made = {path.removeprefix(f"{name}/"): data for path, data in files.items() if path.startswith(f"{name}/")}
    there = {path: hashlib.sha256(data).hexdigest() for path, data in made.items() if not path.endswith(".md")}
    return all(compiled.get(path) == digest for path, digest in there.items())
