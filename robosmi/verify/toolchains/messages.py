"""What compiler and linker say, as findings with places in the sketch's own files.

The patterns are the toolchain's data. The tools run in the sketch's folder, so a relative path, or one inside that folder, is a
file of the sketch. Warnings about other people's files are counted, not reported; errors are reported wherever they are.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from pathlib import Path

from msgspec.structs import replace

from robosmi import inputs
from robosmi.base.data_tables import DataTable
from robosmi.diagnostics import Finding, FlowStep, Location, Severity
from robosmi.verify.toolchains.compile_report import (
    COMPILER_ERROR,
    COMPILER_WARNING,
    LINK_ERROR,
    MISSING_HEADER,
)

_ERRORS = ("fatal error", "error", "sorry, unimplemented", "internal compiler error")
_FAILURE = re.compile(r"error|\bcannot\b|no such file", re.IGNORECASE)
"""What tools say first of a failure; that another program of theirs failed comes later."""
_SEVERITY = {"warning": Severity.warning, **dict.fromkeys(_ERRORS, Severity.error)}


def own_path(path: str, folder: Path) -> str | None:
    """A path of a message as the path of a file of the sketch, or None if it is not in the sketch's folder.

    Args:
        path: as the tool printed it.
        folder: the sketch's folder, as the caller named it.
    """
    full = os.path.normpath(os.path.join(folder.resolve(), path))
    inside = os.path.relpath(full, folder.resolve())
    return None if inside.startswith("..") or not os.path.exists(full) else str(folder / inside)


def compiler_findings(text: str, patterns: DataTable, folder: Path) -> tuple[list[Finding], int]:
    """The findings in what compilers printed, each once, and the number of warnings about other files.

    Args:
        text: what was printed.
        patterns: the toolchain's messages.
        folder: the sketch's folder.
    """
    findings: dict[str, Finding] = {}
    last: str | None = None
    elsewhere = 0
    for match in patterns.pattern("compiler").finditer(text):
        own = own_path(match["path"], folder)
        column = int(match["column"]) if match["column"] else None
        place = Location(own or match["path"], int(match["line"]), column)
        if match["severity"] not in _SEVERITY:
            if last is not None:
                notes = [*findings[last].listed("notes"), {"message": match["message"], "location": place.to_json()}]
                steps = (*findings[last].steps, FlowStep(place, match["message"]))
                findings[last] = replace(findings[last], evidence={**findings[last].evidence, "notes": notes}, steps=steps)
            continue
        finding = _finding(match["message"], _SEVERITY[match["severity"]], place, patterns)
        if own is None and finding.severity is Severity.warning:
            elsewhere += 1
            last = None
        elif finding.id not in findings:
            findings[finding.id] = finding
            last = finding.id
        else:
            last = None
    return list(findings.values()), elsewhere


def _finding(message: str, severity: Severity, place: Location, patterns: DataTable) -> Finding:
    missing = patterns.pattern("missing_header").match(message)
    if missing:
        of_core = missing["header"] in patterns.texts("core_headers", ())
        fix = patterns.text("core_header_fix" if of_core else "missing_header_fix").replace("{header}", missing["header"])
        return Finding(MISSING_HEADER, severity, message, place, fix=fix, evidence={"header": missing["header"]})
    option = patterns.pattern("option").search(message)
    rule = COMPILER_WARNING if severity is Severity.warning else COMPILER_ERROR
    if option:
        return Finding(rule, severity, message[: option.start()], place, evidence={"option": option["option"]})
    return Finding(rule, severity, message, place)


def linker_findings(text: str, patterns: DataTable, files: Iterable[Path]) -> list[Finding]:
    """The findings in what the linker printed, each once.

    The linker of a program optimised as a whole knows no lines. The place is where the name first stands in the sketch's files,
    and the evidence says that it was searched for.

    Args:
        text: what was printed.
        patterns: the toolchain's messages.
        files: the sketch's own files.
    """
    findings: dict[str, Finding] = {}
    for match in patterns.pattern("linker").finditer(text):
        place = _first_use(match["symbol"], files)
        evidence = {"symbol": match["symbol"], "place": "first use of the name in the text" if place else "not known"}
        finding = Finding(LINK_ERROR, Severity.error, match["message"], place, fix=patterns.text("linker_fix"), evidence=evidence)
        findings.setdefault(finding.id, finding)
    return list(findings.values())


def assembler_findings(text: str, patterns: DataTable, files: Iterable[Path]) -> list[Finding]:
    """The finding for instructions that the assembler does not take, with all that it says of them; none if it says nothing.

    A program that is optimised as a whole is assembled when it is linked, from a temporary file: the place is where the sketch
    first has assembler.

    Args:
        text: what was printed.
        patterns: the toolchain's messages.
        files: the sketch's own files.
    """
    said = list(dict.fromkeys(match["message"].strip() for match in patterns.pattern("assembler").finditer(text)))
    if not said:
        return []
    place = _first(patterns.pattern("assembler_word"), files)
    message = f"the assembler rejects an instruction: {said[0]}"
    return [
        Finding(
            COMPILER_ERROR, Severity.error, message, place, fix=patterns.text("assembler_fix"), evidence={"output": said[:20]}
        )
    ]


def _first_use(symbol: str, files: Iterable[Path]) -> Location | None:
    return _first(re.compile(rf"\b{re.escape(symbol.rpartition('::')[2])}\b"), files)


def _first(word: re.Pattern[str], files: Iterable[Path]) -> Location | None:
    for path in files:
        for number, line in enumerate(inputs.read_text(path, inputs.OUTPUT, errors="replace").splitlines(), 1):
            if found := word.search(line.partition("//")[0]):
                return Location(str(path), number, len(line[: found.start()].encode()) + 1)
    return None


def unread(what: str, text: str) -> Finding:
    """The finding for a tool that failed without a message that could be read.

    Args:
        what: what was being done.
        text: what the tool printed.
    """
    lines = [line for line in text.splitlines() if line.strip()]
    told = next((line for line in lines if _FAILURE.search(line)), lines[0] if lines else "no message from the tool")
    message = f"{what} failed: {told}"
    return Finding(COMPILER_ERROR, Severity.error, message, evidence={"output": lines[:20]})
