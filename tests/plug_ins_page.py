"""The table of docs/reference/plug-ins.md, made from the kinds of content in the code.

`python -m tests.plug_ins_page` (make rules) writes the page anew; a test compares. What is around the table is written by hand.
"""

from __future__ import annotations

import re
from pathlib import Path

from robosmi.plugin_contracts import KINDS, Contribution
from robosmi.plugins import BUILT_IN, Registry, load

PAGE = Path(__file__).resolve().parents[1] / "docs" / "reference" / "plug-ins.md"
_TABLE = re.compile(r"(?<=<!-- kinds of content -->\n)(?:\|[^\n]*\n)*")


def filled(text: str) -> str:
    """The page with the table as the code has it now."""
    registered = Registry()
    load(BUILT_IN)(registered)
    rows = [_row(kind, registered.names(kind.kind)) for kind in KINDS.values()]
    table = "\n".join(["| kind | what it does | contract | name | built in |", "|---|---|---|---|---|", *rows, ""])
    made, count = _TABLE.subn(lambda _: table, text)
    assert count == 1, "the page has one place for the table"
    return made


def _row(kind: type[Contribution], names: list[str]) -> str:
    built_in = ", ".join(f"`{name}`" for name in names)
    contract = f"{f'`{kind.called}` returns ' if kind.called else ''}{kind.returns}"
    return f"| `{kind.kind}` | {kind.description} | {contract} | {kind.names} | {built_in} |"


if __name__ == "__main__":
    PAGE.write_text(filled(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
