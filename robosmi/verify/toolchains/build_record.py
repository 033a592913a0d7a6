"""The record of a program that `compile` stores: its inputs and its sizes.

It shows whether the program still belongs to the sketch. `compiled_program` writes it together with the program.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TypeVar

from msgspec import Struct

from robosmi import inputs
from robosmi.base.data_text import Json, json_of, json_written
from robosmi.diagnostics import Location
from robosmi.errors import SourceError

FOLDER = "build"
"""Where programs are kept, beside a sketch's folder."""
SCHEMA = "robosmi-build/1"
V = TypeVar("V", str, int)


class BuildRecord(Struct, frozen=True):
    """What a kept program was made from.

    Attributes:
        board: name of the board it was compiled for.
        fits: whether it fits on that board.
        stand_ins: libraries that were not installed, so that stand-ins are in the program.
        sources: file of the sketch's folder -> SHA-256.
        program: SHA-256 of the `.hex`.
        outside: path of a file outside of the sketch's folder that its files include -> SHA-256.
        stand_in_core: the core that was not installed, so that a stand-in is in the program; empty for none.
        sizes: `flash_bytes`, `flash_limit`, `ram_bytes`, `ram_limit`, and `stack_bytes` where a
            bound is known; empty in a record of an earlier version.
    """

    board: str
    fits: bool
    stand_ins: tuple[str, ...]
    sources: dict[str, str]
    program: str
    sizes: dict[str, int] = {}
    outside: dict[str, str] = {}
    stand_in_core: str = ""

    def to_bytes(self) -> bytes:
        """The record's file."""
        values: dict[str, Json] = {
            "schema": SCHEMA, "board": self.board, "fits": self.fits, "stand_ins": list(self.stand_ins),
            "sources": self.sources, "program": self.program, "sizes": self.sizes, "outside": self.outside,
            **({"stand_in_core": self.stand_in_core} if self.stand_in_core else {}),
        }  # fmt: skip
        return (json_written(values, indent=1, sort_keys=True) + "\n").encode()


def record_at(path: Path) -> BuildRecord | None:
    """The record in a file, or None where there is none.

    Raises:
        SourceError: it is damaged.
    """
    fix = "compile the sketch again"
    try:
        return _record(json_of(inputs.read_bytes(path, inputs.RECORD).decode()))
    except FileNotFoundError:
        return None
    except OSError as error:
        raise SourceError(f"the record cannot be read: {error.strerror}", location=Location(str(path)), fix=fix) from error
    except ValueError as error:
        why = "it is no text in UTF-8" if isinstance(error, UnicodeDecodeError) else error
        raise SourceError(f"the record of the program is damaged: {why}", location=Location(str(path)), fix=fix) from error


def _record(data: Json) -> BuildRecord:
    """The record that a value in JSON is.

    Raises:
        ValueError: it is none.
    """
    if not isinstance(data, Mapping):
        raise ValueError("it is no object")
    schema = data.get("schema")
    if schema != SCHEMA:
        raise ValueError(f"its schema is {json_written(schema)}, not {SCHEMA}" if "schema" in data else "it has no 'schema'")
    stand_ins, fits = data.get("stand_ins"), data.get("fits")
    if not isinstance(fits, bool):
        raise _wrong(data, "fits", "true or false")
    if isinstance(stand_ins, str) or not isinstance(stand_ins, Sequence):
        raise _wrong(data, "stand_ins", "a list of texts")
    names = tuple(name for name in stand_ins if isinstance(name, str))
    if len(names) < len(stand_ins):
        raise _wrong(data, "stand_ins", "a list of texts")
    sizes = _table(data, "sizes", int, "whole numbers", optional=True)
    sources, outside = _table(data, "sources", str, "texts"), _table(data, "outside", str, "texts", optional=True)
    core = _text(data, "stand_in_core") if "stand_in_core" in data else ""
    return BuildRecord(_text(data, "board"), fits, names, sources, _text(data, "program"), sizes, outside, core)


def _text(data: Mapping[str, Json], name: str) -> str:
    value = data.get(name)
    if not isinstance(value, str):
        raise _wrong(data, name, "a text")
    return value


def _table(data: Mapping[str, Json], name: str, kind: type[V], called: str, *, optional: bool = False) -> dict[str, V]:
    value = {} if optional and name not in data else data.get(name)
    if not isinstance(value, Mapping):
        raise _wrong(data, name, f"an object of {called}")
    found = {key: each for key, each in value.items() if isinstance(each, kind) and not isinstance(each, bool)}
    if len(found) < len(value):
        raise _wrong(data, name, f"an object of {called}")
    return found


def _wrong(data: Mapping[str, Json], name: str, wanted: str) -> ValueError:
    return ValueError(f"its '{name}' is not {wanted}" if name in data else f"it has no '{name}'")
