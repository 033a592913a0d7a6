"""A report as the user reads it at a terminal: the command's lines, then its findings, the worst first, alike ones together.

Texts of files and models stay text there: they send a terminal no sequence and begin no line. Colour is only for a terminal that
takes it.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from typing import TextIO

from robosmi.diagnostics import MORE, Finding, Severity
from robosmi.quoting import terminal
from robosmi.report.document import Report

SHOWN = {Severity.error: 10, Severity.warning: 3, Severity.info: 1}
"""How many findings of a rule are shown of each severity, unless all are wanted."""
_COLOURS = {Severity.error: "31", Severity.warning: "33", Severity.info: "36"}


def terminal_text(report: Report, *, verbose: bool = False, colour: bool = False) -> str:
    """What the user reads.

    Args:
        report: the report.
        verbose: show every finding; else of many of one rule the first, and how many more there are.
        colour: whether severities are coloured.
    """
    lines = [terminal(line) for line in report.lines]
    for finding, more in grouped(report.findings, verbose=verbose):
        lines += _finding(finding, colour, verbose)
        if more:
            lines.append(f"  and {more} more of {finding.rule} (-v shows all)")
    if report.next:
        lines.append(terminal(f"next: {report.next}"))
    return "\n".join(lines)


def grouped(findings: Iterable[Finding], *, verbose: bool = False) -> Iterator[tuple[Finding, int]]:
    """Findings by severity, then by rule in the order in which rules are first found, with how many are left out behind each.

    Args:
        findings: in any order; those of one rule and severity keep theirs.
        verbose: leave out none.
    """
    groups: dict[tuple[Severity, str], list[Finding]] = {}
    for finding in findings:
        groups.setdefault((finding.severity, finding.rule), []).append(finding)
    for (severity, _), same in sorted(groups.items(), key=lambda pair: -pair[0][0]):
        shown = same if verbose or len(same) <= SHOWN[severity] + 1 else same[: SHOWN[severity]]
        for number, finding in enumerate(shown, 1):
            yield finding, len(same) - len(shown) if number == len(shown) else 0


def _finding(finding: Finding, colour: bool, verbose: bool) -> Iterator[str]:
    """The lines of a finding, its place first, as compilers print it; verbose, also the other places of which it is true."""
    place = f"{finding.location}: " if finding.location else ""
    word = f"\x1b[{_COLOURS[finding.severity]}m{finding.severity.name}\x1b[0m" if colour else finding.severity.name
    yield f"{terminal(place)}{word}: {terminal(f'{finding.message} [{finding.rule}]')}"
    others = finding.listed(MORE)
    for other in others if verbose else ():
        if isinstance(other, dict) and isinstance(at := other["location"], dict):
            yield terminal(f"  {at['path']}:{at['line']}: {other['message']}")
    if others and not verbose:
        yield "  (-v shows all places)"
    if finding.fix and finding.severity > Severity.info:
        yield terminal(f"  do: {finding.fix}")


def takes_colour(stream: TextIO | None) -> bool:
    """Whether a stream is shown in colour: a terminal that NO_COLOR does not forbid, or any where FORCE_COLOR asks for it.

    https://no-color.org; a terminal called `dumb` takes none, and neither does None, a stream that is closed.
    """
    if os.environ.get("NO_COLOR"):
        return False
    if os.environ.get("FORCE_COLOR"):
        return True
    return stream is not None and stream.isatty() and os.environ.get("TERM") != "dumb"
