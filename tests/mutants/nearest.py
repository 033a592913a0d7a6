"""Which test files are nearest to a module of the product, by names and imports: they are likely to notice a change of it."""

from __future__ import annotations

from collections import defaultdict
from functools import cache
from pathlib import Path

from tests.source_imports import CONTENT, ROOT, imported, module_name, modules

FAR = 99
"""The distance of a test file that does not import the module, which it may still reach through the command line or data."""


def nearest(module: Path) -> list[Path]:
    """All test files: first those named as the module, then by how many imports lie between, then those of its folder."""
    away = distances(module)
    folders = {*module.relative_to(ROOT).parts[:-1], module.stem}

    def place(test: Path) -> tuple[bool, int, int, Path]:
        shared = len(folders.intersection(test.relative_to(ROOT).parts[:-1]))
        named = test.stem.removeprefix("test_").rstrip("s") == module.stem.rstrip("s")
        return not (named and shared), away.get(test, FAR), -shared, test

    return sorted((path for path in modules("tests") if path.name.startswith("test_")), key=place)


def distances(module: Path) -> dict[Path, int]:
    """Module of the product or the tests -> the number of imports that lead from it to this one."""
    found, here, away = {module: 0}, {module}, 0
    while here:
        away += 1
        here = {user for each in here for user in _users()[each]} - found.keys()
        found |= dict.fromkeys(here, away)
    return found


@cache
def _users() -> defaultdict[Path, set[Path]]:
    """Module -> those that import it, or a name of it. A test also has the fixtures of the conftest.py of its folders."""
    paths = modules("robosmi", *CONTENT, "tests")
    owners = {module_name(path).removeprefix("robosmi." if path.is_relative_to(ROOT / "tests") else ""): path for path in paths}
    users: defaultdict[Path, set[Path]] = defaultdict(set)
    for path in paths:
        for _, used in imported(path):
            if owner := owners.get(used) or owners.get(used.rpartition(".")[0]):
                users[owner].add(path)
        if path.name.startswith("test_"):
            for folder in path.parents[:-1]:
                users[folder / "conftest.py"].add(path)
    return users
