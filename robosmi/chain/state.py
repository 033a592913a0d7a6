"""The memory of a chain between runs: for each step the digests of its inputs and outputs, and its findings.

The state is stored in `.robosmi/chains` in the chain's folder. You can delete it at any time; then every step runs again.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import asdict

from robosmi import inputs
from robosmi.base.data_text import as_list, as_table, as_text, as_whole, json_of, json_written
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError
from robosmi.files.files import digest, write_atomic

if TYPE_CHECKING:
    from robosmi.base.data_text import Json

SCHEMA = "robosmi-chain/1"


class StepState(Struct):
    """A step's last run: digest of its inputs, outputs with their digests, findings; whether it changed a model that it reads.

    Of a loaded model: the files that were read with it.
    """

    inputs: str
    outputs: dict[str, str] = {}
    findings: list[dict[str, Json]] = []
    failed: bool = False
    changes: bool = False
    read: list[str] = []


class State:
    """The memory of a chain.

    Args:
        path: its file, which need not be there yet; None to remember nothing longer than the run lives.
    """

    def __init__(self, path: Path | None) -> None:
        self.path = path
        self.steps: dict[str, StepState] = {}
        if path is not None and path.is_file():
            try:
                data = as_table(json_of(inputs.read_text(path, inputs.RECORD)))
                if data["schema"] == SCHEMA:
                    self.steps = {name: _step_from(as_table(entry)) for name, entry in as_table(data["steps"]).items()}
            except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
                raise SourceError(
                    f"the record of the last run cannot be read: {error}",
                    location=Location(str(path)),
                    fix="remove it; then every step is done again",
                ) from error

    def save(self) -> None:
        """Write the state atomically, unless nothing changed or nothing is to be remembered."""
        if self.path is None:
            return
        steps = {name: asdict(entry) for name, entry in self.steps.items()}
        data = (json_written({"schema": SCHEMA, "steps": steps}, indent=1, sort_keys=True) + "\n").encode()
        if inputs.read_bytes(self.path, inputs.RECORD) != data if self.path.is_file() else bool(steps):
            write_atomic(self.path, data)


def _step_from(entry: dict[str, Json]) -> StepState:
    outputs = {name: as_text(made) for name, made in as_table(entry["outputs"]).items()}
    findings = [as_table(finding) for finding in as_list(entry["findings"])]
    read = [as_text(name) for name in as_list(entry.get("read", []))]
    return StepState(as_text(entry["inputs"]), outputs, findings, bool(entry["failed"]), bool(entry.get("changes")), read)


def digest_of(path: Path) -> str:
    """The digest of a file, or of a folder's files and their names; "" if there is nothing."""
    if path.is_file():
        return digest(inputs.read_bytes(path, inputs.OUTPUT))
    if not path.is_dir():
        return ""
    found = hashlib.sha256()
    for folder, folders, files in sorted(os.walk(path)):
        folders[:] = [name for name in folders if not name.startswith((".", "__pycache__"))]
        for name in sorted(files):
            file = Path(folder, name)
            found.update(f"{file.relative_to(path).as_posix()}\0".encode())
            found.update(digest(inputs.read_bytes(file, inputs.OUTPUT)).encode())
    return found.hexdigest()


def digest_of_all(parts: Iterable[tuple[str, str]]) -> str:
    """A single digest of named digests."""
    return digest("\n".join(f"{name}\0{value}" for name, value in parts).encode())


def finding_from(data: dict[str, Json]) -> Finding:
    """A finding restored from the state."""

    def text(key: str) -> str | None:
        return None if data[key] is None else as_text(data[key])

    place = _location_from(as_table(data["location"])) if data["location"] else None
    message, evidence = as_text(data["message"]), as_table(data["evidence"])
    level = Severity[as_text(data["severity"])]
    return Finding(as_text(data["rule"]), level, message, place, text("element"), text("fix"), evidence)


def _location_from(data: dict[str, Json]) -> Location:
    numbers = {key: None if value is None else as_whole(value) for key, value in data.items() if key != "path"}
    return Location(as_text(data["path"]), **numbers)


def same_value(one: object, other: object) -> bool:
    """Whether two values are equal; those that cannot be compared are not."""
    try:
        return one.__class__ is other.__class__ and bool(one == other)
    except (TypeError, ValueError):
        return False
