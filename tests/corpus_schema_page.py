"""The tables of docs/reference/corpus-schema.md, made from `robosmi.corpus.store`.

`python -m tests.corpus_schema_page` (make rules) writes the page anew; a test compares.
What is around the tables is written by hand.
"""

from __future__ import annotations

import re
from pathlib import Path

from robosmi.corpus.store import TABLES, VERSION

PAGE = Path(__file__).resolve().parents[1] / "docs" / "reference" / "corpus-schema.md"
_MADE = re.compile(r"(?<=<!-- tables of a corpus -->\n).*\Z", re.DOTALL)


def filled(text: str) -> str:
    """The page with the tables as the code has them now."""
    parts = [f"\nVersion of the tables: {VERSION}\n"]
    for table in TABLES.sorted_tables:
        parts.append(f"\n## {table.name}\n\n{str(table.comment)[0].upper()}{str(table.comment)[1:]}.\n")
        parts.append("\n| column | type | content |\n|---|---|---|\n")
        for column in table.columns:
            key = ", primary key" if column.primary_key else ""
            parts.append(f"| `{column.name}` | {column.type}{key} | {column.comment} |\n")
    made, count = _MADE.subn(lambda _: "".join(parts), text)
    assert count == 1, "the page has one place for the tables"
    return made


if __name__ == "__main__":
    PAGE.write_text(filled(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
