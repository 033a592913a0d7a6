"""The record of a program that `compile` has left: what it was made from, and what it takes.

It is read by whoever asks whether that program still is the sketch's. It is written, with the program, by `kept_program`.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path

from robosmi import inputs
from robosmi.data_text import json_of
from robosmi.diagnostics import Location
from robosmi.errors import SourceError

FOLDER = "build"
"""Where programs are kept, beside a sketch's folder."""
SCHEMA = "robosmi-build/1"


@dataclass(frozen=True)
class BuildRecord:
    """What a kept program was made from.

    Attributes:
        board: name of the board it was compiled for.
        fits: whether it fits on that board.
        stand_ins: libraries that were not installed, so that stand-ins are in the program.
        sources: file of the sketch's folder -> SHA-256.
        program: SHA-256 of the `.hex`.
        outside: path of a file outside of the sketch's folder that its files include -> SHA-256.
        sizes: `flash_bytes`, `flash_limit`, `ram_bytes`, `ram_limit`, and `stack_bytes` where a
            bound is known; empty in a record of an earlier version.
    """

    board: str
    fits: bool
    stand_ins: tuple[str, ...]
    sources: dict[str, str]
    program: str
    sizes: dict[str, int] = field(default_factory=dict)
    outside: dict[str, str] = field(default_factory=dict)

    def to_bytes(self) -> bytes:
        """The record's file."""
        values = {
            "schema": SCHEMA, "board": self.board, "fits": self.fits, "stand_ins": list(self.stand_ins),
            "sources": self.sources, "program": self.program, "sizes": self.sizes, "outside": self.outside,
        }  # fmt: skip
        return (json.dumps(values, indent=1, sort_keys=True) + "\n").encode()


def record_at(path: Path) -> BuildRecord | None:
    """The record in a file, or None where there is none.

    Raises:
        SourceError: it is damaged.
    """
    fix = "compile the sketch again"
    try:
        data = json_of(inputs.read_bytes(path, inputs.RECORD).decode())
        if data["schema"] != SCHEMA:
            raise ValueError(f"its schema is '{data['schema']}'")
        return BuildRecord(
            str(data["board"]), bool(data["fits"]), tuple(str(name) for name in data["stand_ins"]),
            {str(name): str(digest) for name, digest in data["sources"].items()}, str(data["program"]),
            {str(name): int(size) for name, size in data.get("sizes", {}).items()},
            {str(name): str(digest) for name, digest in data.get("outside", {}).items()},
        )  # fmt: skip
    except FileNotFoundError:
        return None
    except OSError as error:
        raise SourceError(f"the record cannot be read: {error.strerror}", location=Location(str(path)), fix=fix) from error
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise SourceError(f"the record of the program is damaged: {error}", location=Location(str(path)), fix=fix) from error
