"""docs/reference/eol.md names every operation, and no operation that is not there."""

from __future__ import annotations

import re
from pathlib import Path

from robosmi.query import operations
from robosmi.query.naming import snake

PAGE = Path(__file__).resolve().parents[2] / "docs" / "reference" / "eol.md"
TABLES = tuple(operations.TABLES.values())
OWN = {"of_kind", "of_type"}
"""Python's names of operations that have another one in EOL."""


def sections() -> dict[str, str]:
    """The page's text by title."""
    parts = re.split(r"^## (.*)$", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def first_column() -> set[str]:
    """The names in the tables' first columns, without those of the language and of what differs."""
    found = set()
    for title, text in sections().items():
        if title == "Boolean":
            found |= set(re.findall(r"`(\w+)`", text))
        elif title not in ("Language", "What differs, and why"):
            for row in re.findall(r"^\| (.*?) \| ", text.replace("\\|", "!"), flags=re.MULTILINE):
                found |= {re.sub(r"\(.*|^[TM]\.", "", name) for name in re.findall(r"`([^`]+)`", row)}
    return found


def test_every_operation_stands_on_the_page() -> None:
    known = {name for table in TABLES for name in table} - OWN
    assert known - {snake(name) for name in first_column()} == set()


def test_every_name_on_the_page_is_an_operation() -> None:
    known = {name for table in TABLES for name in table}
    named = {name for name in first_column() if name != "t.a"}
    assert {name for name in named if snake(name) not in known} == set()
