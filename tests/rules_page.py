"""The tables of docs/reference/rules.md, made from the rules' data.

`python -m tests.rules_page` (make rules) writes the page anew; a test compares. A table stands behind a comment that names the
file of its rules, and ends with the next empty line; the heading before it may have the range of their ids, `(RS230 to RS272)`.
What is around tables and ranges is written by hand.
"""

from __future__ import annotations

import re
from pathlib import Path

from robosmi.report.rules import FindingRule, finding_rules

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "reference" / "rules.md"
DATA = ROOT / "platform_repo" / "rules"
_RANGE = re.compile(r"(?<=\()RS\d+ to RS\d+(?=\)\n(?:(?!## |<!-- rules: ).*\n)*<!-- rules: (\w+) -->)")
_TABLE = re.compile(r"(?<=<!-- rules: )(\w+)( -->\n)(?:\|[^\n]*\n)*")


def filled(text: str) -> str:
    """The page with all tables as the data has them now."""
    sections: dict[str, list[FindingRule]] = {}
    for rule in finding_rules(ROOT).values():
        sections.setdefault(rule.section, []).append(rule)

    def span(match: re.Match[str]) -> str:
        ids = sorted(rule.id for rule in sections[_title(match[1])])
        return f"{ids[0]} to {ids[-1]}"

    def fill(match: re.Match[str]) -> str:
        rules = sections.pop(_title(match[1]))
        errors = any(rule.exit_code is not None for rule in rules)
        head = "| id | exit code | meaning | what to do |" if errors else "| id | severity | meaning | what to do |"
        rows = [f"| {r.id} | {_second(r, errors)} | {r.meaning} | {r.do} |" for r in rules]
        return match[1] + match[2] + "\n".join([head, "|---|---|---|---|", *rows, ""])

    made = _TABLE.sub(fill, _RANGE.sub(span, text))
    assert not sections, f"no table for: {', '.join(sections)}"
    return made


def _title(file: str) -> str:
    source = (DATA / f"{file}.toml").read_text(encoding="utf-8")
    (title,) = re.findall(r'^title = "(.*)"$', source, re.MULTILINE)
    return str(title)


def _second(rule: FindingRule, errors: bool) -> str:
    levels = ", ".join(level.name for level in rule.severities)
    if errors:
        return f"{levels}: as without it" if rule.exit_code is None else str(rule.exit_code)
    return levels


if __name__ == "__main__":
    PAGE.write_text(filled(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
