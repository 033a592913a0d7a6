"""What of a platform's programs may behave otherwise on another board: the facts of `portability.toml` and `registers.json`.

A kind is data: the names, headers and types whose use is a place, and where it behaves the same. The rules are in
`queries.portability`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

from msgspec import Struct, ValidationError, convert

from robosmi import inputs
from robosmi.base.data_text import json_of
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError
from robosmi.project import read_data
from robosmi.transformations.knowledge.platforms.platform_folder import platform_folder


class PlaceKind(Struct, frozen=True, forbid_unknown_fields=True):
    """A kind of place; the file explains the attributes.

    `functions`, `stores`, `converters`, `conditions`, `words` and `registers` are read by the one rule that needs them.
    """

    what: str
    names: tuple[str, ...] = ()
    headers: tuple[str, ...] = ()
    not_headers: tuple[str, ...] = ()
    types: tuple[str, ...] = ()
    functions: tuple[str, ...] = ()
    stores: tuple[str, ...] = ()
    converters: tuple[str, ...] = ()
    conditions: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    registers: str = ""
    alike: str = ""
    cure: str = "none"


class Chip(Struct, frozen=True):
    """The registers and interrupt vectors of a microcontroller."""

    registers: frozenset[str] = frozenset()
    vectors: frozenset[str] = frozenset()


class PortabilityFacts(Struct, frozen=True):
    """The facts of one platform.

    Attributes:
        kinds: name of a kind -> its facts, in the order of the file.
        registers: what registers belong to -> their names.
        microcontrollers: name -> what it has; one that is not listed has nothing of it.
    """

    kinds: Mapping[str, PlaceKind]
    registers: Mapping[str, Sequence[str]] = {}
    microcontrollers: Mapping[str, Chip] = {}


def portability_facts(platform: str) -> PortabilityFacts | None:
    """The facts about programs of a source platform; None if there are none.

    Raises:
        PlatformDataError: there is no such platform, or its data is damaged.
    """
    path = platform_folder(platform) / "portability.toml"
    return _facts(path) if path.is_file() else None


@cache
def _facts(path: Path) -> PortabilityFacts:
    registers = path.with_name("registers.json")
    try:
        told = json_of(inputs.read_bytes(registers, inputs.DATA)) if registers.is_file() else {}
        return convert({**(told if isinstance(told, dict) else {}), "kinds": read_data(path).get("kinds", {})}, PortabilityFacts)
    except (OSError, ValueError, ValidationError) as error:
        fix = f"correct it, or {registers.name} beside it"
        raise PlatformDataError(f"the kinds of places cannot be read: {error}", location=Location(str(path)), fix=fix) from error
