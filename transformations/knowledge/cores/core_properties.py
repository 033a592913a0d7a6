"""Properties of an Arduino core: `key=value` files, their expansion, and the splitting of recipes into arguments.

Source: Arduino platform specification, "Configuration files format" and "Recipes".
"""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from pathlib import Path

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError

_SYSTEMS = ("linux", "windows", "macosx")
SYSTEM = {"win32": "windows", "darwin": "macosx"}.get(sys.platform, "linux")
"""This operating system, as cores call it."""
_NAME = re.compile(r"\{([\w.\-:]+)\}")
_ROUNDS = 30
"""How deep names may stand in each other's values; the cores that exist need 6."""
_LONGEST = 200_000
"""Characters that a value may grow to; the longest recipes that exist have 10,000."""


def read_properties(path: Path) -> dict[str, str]:
    """The properties of a file, in its order; empty if there is none. Those for this operating system replace general ones.

    Raises:
        SourceError: the file cannot be read, or a line has no `=`.
    """
    if not path.is_file():
        return {}
    try:
        text = inputs.read_text(path, inputs.DATA, "utf-8-sig", "replace")
    except OSError as error:
        raise SourceError(f"the file cannot be read: {error}", location=Location(str(path))) from error
    found: dict[str, str] = {}
    for number, raw in enumerate(text.splitlines(), 1):
        line = raw.strip()
        if not line or line.startswith("#"):
            continue
        key, equals, value = line.partition("=")
        if not equals:
            raise SourceError(
                f"'{line[:40]}' is no `key=value` line", location=Location(str(path), number), fix="install the core again"
            )
        found[key.strip()] = value.strip()
    return for_system(found)


def for_system(properties: Mapping[str, str]) -> dict[str, str]:
    """The properties with those of this operating system (`key.linux`) in the place of general ones (`key`)."""
    result: dict[str, str] = {}
    own: dict[str, str] = {}
    for key, value in properties.items():
        stem, _, last = key.rpartition(".")
        if stem and last == SYSTEM:
            own[stem] = value
        if not stem or last not in _SYSTEMS:
            result[key] = value
    return result | own


def below(properties: Mapping[str, str], prefix: str) -> dict[str, str]:
    """The properties whose keys begin with a prefix and a dot, without these."""
    start = f"{prefix}."
    return {key[len(start) :]: value for key, value in properties.items() if key.startswith(start)}


def expand(text: str, properties: Mapping[str, str]) -> str:
    """A text with the properties that it names in braces, and those that these name. Names of no property stay."""
    for _ in range(_ROUNDS):
        more = _NAME.sub(lambda name: properties.get(name[1], name[0]), text)
        if more == text or len(more) > _LONGEST:
            break
        text = more
    return text


def unknown_names(text: str) -> list[str]:
    """The names in braces that an expansion left."""
    return _NAME.findall(text)


def split(command: str) -> list[str]:
    """The arguments of a recipe: blanks separate them, except between quotes, which an argument that holds none loses.

    As Arduino's own builder does it: a quote is one only at the beginning of an argument, there is no escape, and an argument
    without its closing quote ends with the text.
    """
    found = []
    rest = command.strip()
    while rest:
        if rest[0] in "\"'":
            word, _, rest = rest[1:].partition(rest[0])
            found.append(word)
        else:
            word, *more = rest.split(None, 1)
            found.append(word)
            rest = more[0] if more else ""
        rest = rest.lstrip()
    return found
