"""docs/reference/platform-data.md has the keys that files of the platform repository may have, and these are read."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Sequence
from pathlib import Path

import pytest

from robosmi.transformations.knowledge import data_keys

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "reference" / "platform-data.md").read_text(encoding="utf-8")
TABLES: dict[str, Sequence[str]] = {
    "platform.toml of a target": data_keys.OF_TARGETS,
    "[target]": data_keys.TARGET,
    "platform.toml of a source": data_keys.OF_SOURCES,
    "mcus/NAME.toml": data_keys.OF_MICROCONTROLLERS,
    "[[takes]]": data_keys.TAKES,
}
"""Heading of the page -> the keys that its table has."""


def keys_of(heading: str) -> list[str]:
    """The keys in the first column of the table below a heading."""
    section = re.split(r"^#+ ", re.split(rf"^#+ {re.escape(heading)}$", PAGE, flags=re.MULTILINE)[1], flags=re.MULTILINE)[0]
    rows = re.findall(r"^\| (`[^|]*) \|", section, re.MULTILINE)
    return [key for row in rows for key in re.findall(r"`(\w+)`", row)]


@pytest.mark.parametrize("heading", TABLES)
def test_the_page_has_the_keys_that_a_file_may_have(heading: str) -> None:
    assert sorted(keys_of(heading)) == sorted(TABLES[heading])


def test_every_key_is_read_somewhere() -> None:
    text = "".join(
        path.read_text(encoding="utf-8") for path in (ROOT / "transformations").rglob("*.py") if path.stem != "data_keys"
    )
    text += "".join(path.read_text(encoding="utf-8") for path in (ROOT / "robosmi").rglob("*.py"))
    read = {quoted or named for quoted, named in re.findall(r"\"(\w+)\"|\b(\w+)[=:]", text)}
    assert {key for keys in TABLES.values() for key in keys} - read == set()


def test_the_built_in_files_have_no_other_keys() -> None:
    for path in (ROOT / "platform_repo" / "mcus").glob("*.toml"):
        found = tomllib.loads(path.read_text(encoding="utf-8"))
        assert set(found) <= set(data_keys.OF_MICROCONTROLLERS), path
        assert {key for entry in found["takes"] for key in entry} <= set(data_keys.TAKES), path
    for path in (ROOT / "platform_repo").glob("*/platform.toml"):
        assert set(tomllib.loads(path.read_text(encoding="utf-8"))) <= {*data_keys.OF_TARGETS, *data_keys.OF_SOURCES}, path
