"""docs/reference/corpus-schema.md has the tables of the code."""

from __future__ import annotations

from tests.corpus_schema_page import PAGE, filled


def test_the_page_has_the_tables_of_the_code() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert filled(text) == text
