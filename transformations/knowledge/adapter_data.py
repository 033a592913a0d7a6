"""Precompiled adapter files: a JSON of the same name beside each file, so that a migration need not parse markers.

`python -m robosmi.transformations.knowledge.adapter_data PLACE...` builds it for the given files or for all files of a folder.
Names in `needs` are fully qualified there (`servo.h/servo_set`), so that the needed pieces are found without reading further
files. A file without JSON, or whose text differs from the one it was built from, is parsed: an edit takes effect at once.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any

from msgspec.structs import astuple

from robosmi import inputs
from robosmi.data_text import Json, as_table, json_of, json_written
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError
from robosmi.model.files import write_atomic
from robosmi.transformations.knowledge.adapter_files import adapter_file
from robosmi.transformations.knowledge.adapter_records import (
    AdapterFile,
    AdapterPiece,
    AdapterPin,
    ArgumentRange,
    ConventionalPort,
    InterruptStack,
    PortTable,
)
from robosmi.typed import distinct, dynamic_attribute

ENDINGS = (".cpp", ".c")
"""Endings of adapter files, in C++ and in C."""
_PARTS = {
    "pins": AdapterPin,
    "ports": ConventionalPort,
    "tables": PortTable,
    "interrupts": InterruptStack,
    "ranges": ArgumentRange,
}
_PLAIN = AdapterPiece("", "", "", Location(""))
"""A piece with default values; values equal to these are not written."""
_OPTIONAL = AdapterPiece.__struct_fields__[4:]


def adapter_paths(folder: Path) -> list[Path]:
    """The adapter files of a folder and its subfolders (for headers such as `sys/time.h`), sorted by name."""
    return sorted(path for pattern in ("*", "*/*") for path in folder.glob(pattern) if path.suffix in ENDINGS)


def load(path: Path) -> AdapterFile:
    """Load an adapter file, from its JSON if that belongs to its current text.

    Raises:
        PlatformDataError: the file cannot be read, or a marker in it is wrong.
    """
    try:
        raw = inputs.read_bytes(path, inputs.DATA)
    except OSError as error:
        raise PlatformDataError(f"the adapter file cannot be read: {error}", location=Location(str(path))) from error
    built = path.with_suffix(".json")
    if built.is_file():
        try:
            data = as_table(json_of(inputs.read_bytes(built, inputs.DATA)))
            if data["digest"] == sha256(raw).hexdigest():
                return _file(data, str(path))
        except (OSError, ValueError, KeyError, TypeError):
            pass  # damaged data is no reason not to take the file itself
    try:
        return adapter_file(path, raw.decode("utf-8"))
    except UnicodeDecodeError as error:
        raise PlatformDataError(f"the adapter file cannot be read: {error}", location=Location(str(path))) from error


def _file(data: Mapping[str, Any], path: str) -> AdapterFile:
    header = str(data["header"])
    pieces = []
    for said in data["pieces"]:
        known = dict(said)
        location = Location(path, known.pop("line"))
        for key, part in _PARTS.items():
            if key in known:
                known[key] = [part(*values) for values in known[key]]
        pieces.append(AdapterPiece(header=header, location=location, **known))
    return AdapterFile(header, pieces, str(data["unsupported"]), dict(data.get("tasks", {})))


def to_data(file: AdapterFile, raw: bytes, headers: Mapping[str, Sequence[str]]) -> str:
    """The JSON of an adapter file.

    Args:
        file: the parsed file.
        raw: its bytes.
        headers: name of a piece of any file -> the headers that have one.
    """
    rows = [_piece(piece, headers) for piece in file.pieces]
    text = ",\n".join(json_written(row, ensure_ascii=False) for row in rows)
    said = {"header": file.header, "digest": sha256(raw).hexdigest(), "unsupported": file.unsupported}
    head = json_written(said | ({"tasks": file.tasks} if file.tasks else {}), ensure_ascii=False)
    return f'{head[:-1]}, "pieces": [\n{text}\n]}}\n'


def _piece(piece: AdapterPiece, headers: Mapping[str, Sequence[str]]) -> dict[str, Json]:
    row: dict[str, Json] = {"kind": piece.kind, "name": piece.name, "line": piece.location.line}
    for key in _OPTIONAL:
        value = dynamic_attribute(piece, key)
        if value == dynamic_attribute(_PLAIN, key):
            continue
        if key in _PARTS:
            value = [[*part] if isinstance(part, tuple) else [*astuple(part)] for part in value]
        elif key == "needs":
            value = [_complete(name, piece.header, headers) for name in value]
        row[key] = value
    return row


def _complete(name: str, header: str, headers: Mapping[str, Sequence[str]]) -> str:
    if "/" in name:
        return name
    there = headers.get(name, [])
    return f"{header if header in there or not there else there[0]}/{name}"


def build(folder: Path) -> dict[Path, str]:
    """The JSON of all adapter files in a folder: path -> text.

    Raises:
        PlatformDataError: a file cannot be read, or a marker in it is wrong.
    """
    paths = adapter_paths(folder)
    raw = {path: inputs.read_bytes(path, inputs.DATA) for path in paths}
    files = {path: adapter_file(path, raw[path].decode("utf-8")) for path in paths}
    headers: dict[str, list[str]] = {}
    for file in files.values():
        for name in distinct(piece.name for piece in file.pieces):
            headers.setdefault(name, []).append(file.header)
    return {path.with_suffix(".json"): to_data(file, raw[path], headers) for path, file in files.items()}


def asked(place: Path) -> dict[Path, str]:
    """The JSON of the adapter files that a person asks for: path -> text.

    Args:
        place: an adapter file, or a folder with adapter files. Where the pieces are that a file needs is read in its folder.

    Raises:
        PlatformDataError: it is neither, a file cannot be read, or a marker in one is wrong.
    """
    if place.is_dir() and adapter_paths(place):
        return build(place)
    if not place.is_file() or place.suffix not in ENDINGS:
        raise PlatformDataError(
            "this is no adapter file and no folder that has one",
            location=Location(str(place)),
            fix=f"give adapter files (their names end in {' or '.join(ENDINGS)}), or folders of them",
        )
    levels = adapter_file(place, inputs.read_bytes(place, inputs.DATA).decode("utf-8")).header.count(
        "/"
    )  # that of sys/time.h lies in a folder of its own
    data = place.with_suffix(".json")
    return {data: build(place.parents[levels])[data]}


def main(places: Sequence[str]) -> int:
    """Write the JSON of adapter files and of folders of them; returns 1, without writing any, if one cannot be built."""
    try:
        built = {path: text for place in places for path, text in asked(Path(place)).items()}
    except PlatformDataError as error:
        print(error, file=sys.stderr)
        return 1
    for path, text in built.items():
        write_atomic(path, text.encode())
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
