"""constraints.txt pins what users install, within the bounds of pyproject.toml, with all that these packages need themselves."""

from __future__ import annotations

import tomllib
from importlib.metadata import PackageNotFoundError, requires
from pathlib import Path
from typing import Any

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import robosmi

ROOT = Path(__file__).parents[2]
LARGE = frozenset({"mcp"})
"""Extras whose own dependencies are not pinned: they are many, and change often."""


def pins() -> dict[str, str]:
    """Package -> its version."""
    lines = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    found = [line.split("==") for line in lines if line and not line.startswith("#")]
    return {canonicalize_name(name): version for name, version in found}


def wanted() -> list[Requirement]:
    """The dependencies of the project, and of the extras of its users."""
    project: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    return [Requirement(text) for text in (*project["dependencies"], *extras["database"], *extras["lsp"], *extras["mcp"])]


def test_every_dependency_is_pinned_within_its_bounds() -> None:
    known = pins()
    for requirement in wanted():
        version = known[canonicalize_name(requirement.name)]
        assert requirement.specifier.contains(version), requirement


def test_what_the_dependencies_need_is_pinned_too() -> None:
    known = pins()
    pending = [canonicalize_name(requirement.name) for requirement in wanted() if requirement.name not in LARGE]
    seen: set[str] = set()
    while pending:
        name = pending.pop()
        if name in seen:
            continue
        seen.add(name)
        assert name in known
        try:
            needs = [Requirement(text) for text in requires(name) or ()]
        except PackageNotFoundError:  # of an extra that is not installed here
            continue
        pending += [canonicalize_name(n.name) for n in needs if n.marker is None or n.marker.evaluate({"extra": ""})]
    assert set(known) - seen - LARGE == set()


def test_all_places_have_one_version() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"\nversion: {project['version']}\n" in citation
    assert robosmi.__version__ == project["version"]
