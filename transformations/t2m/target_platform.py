"""The target platform: `<platform>/platform.toml` of the repository as a model, and the facts that rules read.

`TargetFacts` holds what has no place in the platform metamodel (the table of types, which standard headers there are).
Boards are `boards`' business.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from robosmi import resources
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, UsageError, did_you_mean
from robosmi.metamodels import platform
from robosmi.project import defaults, read_data


@dataclass(frozen=True)
class TargetFacts:
    """A target: a board of a platform, with the generator that writes for it.

    Attributes:
        target: the name a user gives.
        platform: name of the platform, a folder of the repository.
        board: short name of the board.
        generator: name of the registered generator.
        architecture: as libraries declare it.
        core: version of the platform's core.
        include: header that every program includes.
        standard_headers: C headers that the platform has.
        widths: type of the source by value -> type that holds the same values.
    """

    target: str
    platform: str
    board: str
    generator: str
    architecture: str
    core: str
    include: str
    standard_headers: frozenset[str]
    widths: Mapping[str, str]


_NUMBERS = ("intBits", "longBits", "pointerBits", "doubleBits")


@cache
def target_facts(target: str) -> TargetFacts:
    """The facts of a target.

    Raises:
        UsageError: there is no such target.
        PlatformDataError: its data is damaged.
    """
    targets = defaults()["targets"]
    if target not in targets:
        raise UsageError(
            f"no target is called '{target}'{did_you_mean(target, targets)}", fix=f"use one of: {', '.join(sorted(targets))}"
        )
    entry = targets[target]
    path = resources.find("platform_repo", f"{entry['platform']}/platform.toml")
    data = read_data(path)
    try:
        return TargetFacts(
            target,
            entry["platform"],
            entry["board"],
            entry["generator"],
            data["architecture"],
            data["core"],
            data["include"],
            frozenset(data["standard_headers"]),
            data["widths"],
        )
    except KeyError as error:
        raise PlatformDataError(f"the key {error} is missing", location=Location(str(path)), fix="add it") from None


def target_model(facts: TargetFacts, board: platform.Board, libraries: list[platform.Library]) -> platform.Platform:
    """The part of the target's platform model that a plan refers to.

    Args:
        facts: the target.
        board: its board.
        libraries: the libraries that the plan names.
    """
    data = read_data(resources.find("platform_repo", f"{facts.platform}/platform.toml"))
    return platform.Platform(
        name=data["name"],
        language=data["language"],
        charSigned=data["charSigned"],
        hasCogs=data["hasCogs"],
        architecture=data["architecture"],
        coreVersion=facts.core,
        mainHeader=facts.include,
        boards=[board],
        libraries=libraries,
        **{key: data[key] for key in _NUMBERS},
    )
