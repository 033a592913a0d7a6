"""What a search for scenarios came to, stored beside the scenarios: the next `verify` of the same original need not search again.

The search depends on the original, its host model and its ports alone, never on the sketch. So the user who edits the sketch and
verifies again has the same test cases to expect, and they are there already. A record counts only for the very same search, and
only as long as the stored scenarios are those that it left.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import msgspec
from msgspec import Struct

import robosmi
from robosmi import inputs
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.verify.original import Original
from robosmi.verify.traces.verdict import SearchEnd

FILE = "search.json"
"""Name of the record, in the folder of the scenarios."""


class StoredSearch(Struct):
    """A search that has ended, and not by the clock of a busy machine, unless the user has set the clock.

    Attributes:
        search: digest of all that the search depends on (`search_digest`).
        scenarios: digest of the scenarios that were stored after it (`scenarios_digest`).
        racy: how many scenarios were dropped because the source differs from itself.
        racy_counts: coverage counters of the dropped ones, for the branches that only they reach.
        told: how it went.
    """

    search: str
    scenarios: str
    racy: int
    racy_counts: list[bytes]
    told: SearchEnd = SearchEnd()

    def text(self) -> str:
        """The record as it is stored."""
        return msgspec.json.format(msgspec.json.encode(self), indent=1).decode() + "\n"


def search_digest(program: Original, sources: Mapping[str, bytes], ports: Sequence[BoundPort], *settings: object) -> str:
    """A digest of all that a search depends on.

    Args:
        program: the original.
        sources: path -> content of its files.
        ports: its ports.
        settings: what else the search is given.
    """
    of = [robosmi.__version__, program.compiler, sorted(sources.items()), list(ports), program.stubbed, settings]
    digest = hashlib.sha256(msgspec.json.encode(of, order="deterministic"))
    digest.update(program.digest())
    return digest.hexdigest()


def scenarios_digest(files: Iterable[Path]) -> str:
    """A digest of the stored scenarios."""
    digest = hashlib.sha256()
    for path in sorted(files):  # by name
        digest.update(f"\0{path.name}\0".encode() + inputs.read_bytes(path, inputs.SETTINGS))
    return digest.hexdigest()


def stored_search(folder: Path, search: str, program: Original) -> StoredSearch | None:
    """The record of a search in a folder of scenarios; None if there is none for this search and these scenarios."""
    try:
        found = msgspec.json.decode(inputs.read_bytes(folder / FILE, inputs.RECORD), type=StoredSearch)
        same = found.search == search and found.scenarios == scenarios_digest(folder.glob("*.toml"))
    except (OSError, msgspec.DecodeError):
        return None
    fits = found.racy >= 0 and all(len(counts) in (0, program.counts_bytes) for counts in found.racy_counts)
    return found if same and fits else None
