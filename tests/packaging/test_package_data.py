"""What pyproject hands to the wheel: every data file of the house is matched by a glob, and no glob matches nothing."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest

from robosmi import resources

ROOT = Path(__file__).parents[2]
ROOMS = ("robosmi", "transformations", "templates", "metamodels", "platform_repo")


def settings() -> Any:
    """The setuptools table of pyproject.toml."""
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["setuptools"]


def folder_of(package: str) -> Path:
    """The folder of a package, by the longest entry of package-dir (as setuptools looks it up)."""
    directories = settings()["package-dir"]
    parts = package.split(".")
    for length in range(len(parts), 0, -1):
        place = directories.get(".".join(parts[:length]))
        if place is not None:
            return ROOT.joinpath(place, *parts[length:])
    return ROOT.joinpath(*parts)


def matched(package: str, pattern: str) -> set[Path]:
    """The files that a glob gives to a wheel; names with a leading dot are never matched by setuptools."""
    folder = folder_of(package)
    found = {path for path in folder.glob(pattern) if path.is_file()}
    return {path for path in found if not any(part.startswith(".") for part in path.relative_to(folder).parts)}


def test_every_data_file_is_in_the_wheel() -> None:
    given = {
        path
        for package, patterns in settings()["package-data"].items()
        for pattern in patterns
        for path in matched(package, pattern)
    }
    data = {
        path
        for room in ROOMS
        for path in (ROOT / room).rglob("*")
        if path.is_file() and path.suffix not in (".py", ".pyc") and "__pycache__" not in path.parts
    }
    assert len(data) > 50
    assert sorted(str(path.relative_to(ROOT)) for path in data - given) == []


@pytest.mark.parametrize(
    ("package", "pattern"),
    [(package, pattern) for package, patterns in settings()["package-data"].items() for pattern in patterns],
)
def test_no_glob_is_vacuous(package: str, pattern: str) -> None:
    assert package in settings()["packages"]
    assert matched(package, pattern)


@pytest.mark.parametrize("package", settings()["packages"])
def test_every_listed_package_is_there(package: str) -> None:
    assert (folder_of(package) / "__init__.py").is_file()


def test_the_package_tells_type_checkers_that_it_is_typed() -> None:
    assert (ROOT / "robosmi" / "py.typed").is_file()
    assert "py.typed" in settings()["package-data"]["robosmi"]


@pytest.mark.parametrize("kind", resources.KINDS)
def test_built_in_data_is_found_by_its_kind(kind: str) -> None:
    assert resources.built_in(kind).is_dir()
    assert any(resources.built_in(kind).iterdir())
