"""The names that a program shares with its target's core: data of the target platform (`names.json`).

Which names are claimed there, which macros mean there what they mean everywhere, which standard functions are missing,
and which words the target's language has reserved. What is done about a clash is decided elsewhere.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from robosmi import inputs, resources
from robosmi.data_text import json_of
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError


@dataclass(frozen=True)
class TargetNames:
    """Names of a target.

    Attributes:
        declared: functions, variables and types that every program sees.
        macros: macros that every program sees.
        same: macros among them that mean what they mean in any C program.
        absent: standard functions that the target's library does not have.
        keywords: words of the target's language that C leaves to programs.
    """

    declared: frozenset[str]
    macros: frozenset[str]
    same: frozenset[str]
    absent: frozenset[str]
    keywords: frozenset[str]


@cache
def target_names(platform: str) -> TargetNames:
    """The names of a target platform.

    Raises:
        PlatformDataError: the data is missing or damaged.
    """
    path = resources.find("platform_repo", f"{platform}/names.json")
    try:
        data = json_of(inputs.read_bytes(path, inputs.DATA))
        return TargetNames(*(frozenset(data[key]) for key in ("declared", "macros", "same", "absent", "keywords")))
    except (OSError, ValueError, KeyError) as error:
        raise PlatformDataError(
            f"the names cannot be read: {error}", location=Location(str(path)), fix="correct the file"
        ) from error
