"""A report's findings and tasks in SARIF 2.1.0, the form that code scanning services, editors and viewers read.

https://docs.oasis-open.org/sarif/sarif/v2.1.0/sarif-v2.1.0.html; section numbers below are of that text. Same findings and same
files give the same bytes.

Addresses are relative to a base. Columns, which findings count in bytes as compilers do, are counted in characters here, so the
files are read again; the text at a place is shown with it. A column of a file that cannot be read, or that is no text, is left
out rather than wrong. A finding in a file that is no text, such as an archive, has the whole file for its region, in bytes; a
finding about a whole text has it in lines.
"""

from __future__ import annotations

import hashlib
import os
import re
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from robosmi import inputs
from robosmi.base.data_text import json_written
from robosmi.diagnostics import Finding, Location, Severity, Task
from robosmi.errors import PlatformDataError
from robosmi.report.document import Report
from robosmi.report.rules import FindingRule, finding_rules, page, plain_text, sentence

if TYPE_CHECKING:
    from robosmi.base.data_text import Json


SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
MARK = b"sarif-"
"""What stands at the beginning of each file of SARIF 2.1.0: the name of its schema."""
HOME = "http://robosmi.org/"
"""The project's namespace, which its metamodels have, too."""
FINGERPRINT = "robosmiFinding/v1"
LEVELS = {Severity.info: "note", Severity.warning: "warning", Severity.error: "error"}
_LINES = re.compile(r"\(lines? [\d, .]+\)|\b(?:in|from)? ?lines? \d+(?: to \d+)?|:\d+(?::\d+)?")


def sarif_text(report: Report, exit_code: int, base: Path | None = None, about: Path | None = None) -> str:
    """The text of the SARIF file of one command's findings and tasks.

    Args:
        report: what the command found.
        exit_code: with which it ends.
        base: the folder that paths are relative to; None for the root of the repository that the current folder is in, else that
            folder.
        about: the file that the command is about: the place of findings that have none, without which code scanning services
            refuse them.
    """
    return json_written(sarif_document(report, exit_code, base, about), indent=1, ensure_ascii=True) + "\n"


def sarif_document(report: Report, exit_code: int, base: Path | None = None, about: Path | None = None) -> dict[str, Any]:
    """The SARIF log, as values of JSON: one run.

    Args:
        report: what the command found.
        exit_code: with which it ends.
        base: as for `sarif_text`.
        about: as for `sarif_text`.
    """
    from robosmi import __version__

    places = SarifPlaces(base)
    said = [*report.findings, *report.tasks]
    try:
        known = finding_rules()
    except PlatformDataError:  # a damaged file of rules is an error of `explain`; findings are not lost for it
        known = {}
    ids = sorted({finding.rule for finding in said})
    levels = {rule: next(f.severity for f in said if f.rule == rule) for rule in ids}
    seen: Counter[str] = Counter()
    results = [_result(finding, ids.index(finding.rule), places, seen, about) for finding in said]
    driver = {
        "name": "RoboSMi", "version": __version__, "semanticVersion": __version__, "informationUri": HOME,
        "rules": [_rule(rule, levels[rule], known.get(rule)) for rule in ids],
    }  # fmt: skip
    run = {
        "tool": {"driver": driver},
        "invocations": [{"executionSuccessful": report.ok, "exitCode": exit_code}],
        "automationDetails": {"id": f"robosmi/{report.command}/"},
        "columnKind": "unicodeCodePoints",
        "originalUriBaseIds": places.bases(),
        "results": results,
    }
    return {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}


def _rule(rule: str, level: Severity, known: FindingRule | None) -> dict[str, Json]:
    """A rule (3.49) with its help; one that nobody has described has its id alone."""
    if known is None:
        short = f"Rule {rule} of a constraint without a page."
        return {
            "id": rule, "shortDescription": {"text": short}, "defaultConfiguration": {"level": LEVELS[level]},
            "messageStrings": {"default": {"text": "{0}."}},
        }  # fmt: skip
    meaning, advice = sentence(plain_text(known.meaning)), sentence(plain_text(known.do))
    said = f"\nRoboSMi says: {known.says}" if known.says else ""
    return {
        "id": rule,
        "name": known.name,
        "shortDescription": {"text": meaning},
        "fullDescription": {"text": f"{meaning} What to do: {advice}"},
        "help": {
            "text": f"{meaning}\n\nExample:\n{known.code or plain_text(known.example)}{said}\n\nWhat to do: {advice}",
            "markdown": page(known),
        },
        "messageStrings": {"default": {"text": "{0}."}},
        "defaultConfiguration": {"level": LEVELS[known.severities[0]]},
        "properties": {"tags": [known.section]} if known.section else {},
    }


def _result(finding: Finding, index: int, places: SarifPlaces, seen: Counter[str], about: Path | None) -> dict[str, Json]:
    """A result (3.27)."""
    text = finding.message.rstrip(". \n")
    result: dict[str, Any] = {
        "ruleId": finding.rule,
        "ruleIndex": index,
        "level": LEVELS[finding.severity],
        "message": {"text": f"{text}.", "id": "default", "arguments": [text]},
    }
    if places_of := _locations(finding, places, about):
        result["locations"] = places_of[:1]
        if others := _related(finding, places, places_of[1:]):
            result["relatedLocations"] = others
    result["partialFingerprints"] = {FINGERPRINT: _fingerprint(finding, places, seen)}
    if finding.steps:
        result["codeFlows"] = [_flow(finding, places)]
    if finding.edits and (fix := _fix(finding, places)):
        result["fixes"] = [fix]
    if isinstance(reason := finding.evidence.get("accepted"), str):
        result["suppressions"] = [{"kind": "external", "status": "accepted", "justification": reason}]
    advice = {"advice": finding.fix} if finding.fix else {}
    result["properties"] = {"id": finding.id, "kind": "task" if isinstance(finding, Task) else "finding", **advice}
    return result


def _locations(finding: Finding, places: SarifPlaces, about: Path | None) -> list[dict[str, Any]]:
    """The locations (3.28) of a finding: its own, then the other places that it is about."""
    logical = [{"fullyQualifiedName": finding.element, "kind": "element"}] if finding.element else []
    place = finding.location or (Location(str(about)) if about is not None else None)
    if place is None:
        return [{"logicalLocations": logical}] if logical else []
    first: dict[str, Any] = {"physicalLocation": places.physical(place)}
    if logical:
        first["logicalLocations"] = logical
    ranges = [p for p in finding.listed("places") if isinstance(p, (list, tuple)) and len(p) == 4][1:]
    more = [[part if isinstance(part, int) else None for part in p] for p in ranges]
    return [first, *({"physicalLocation": places.physical_at(place.path, *p)} for p in more)]


def _related(finding: Finding, places: SarifPlaces, others: list[dict[str, Json]]) -> list[dict[str, Json]]:
    """Further places that a finding is about (3.27.22)."""
    return [{"id": n, **place, "message": {"text": "The same finding applies here."}} for n, place in enumerate(others, 1)]


def _flow(finding: Finding, places: SarifPlaces) -> dict[str, Any]:
    """The steps that lead to a finding (3.36), as a single thread flow."""
    steps = [
        {"location": {"physicalLocation": places.physical(s.location), "message": {"text": sentence(s.message)}}}
        for s in finding.steps
    ]
    return {"threadFlows": [{"locations": steps}]}


def _fix(finding: Finding, places: SarifPlaces) -> dict[str, Any] | None:
    """The text change that fixes a finding (3.55), with one entry for each file; None if a place has no character offset."""
    changes: dict[str, dict[str, Any]] = {}
    for edit in finding.edits:
        place = places.physical(edit.location, snippet=False)
        region = place.get("region", {})
        if not {"startLine", "startColumn", "endColumn"} <= set(region):
            return None
        replacement = {"deletedRegion": region, "insertedContent": {"text": edit.text}}
        own = changes.setdefault(edit.location.path, {"artifactLocation": place["artifactLocation"], "replacements": []})
        own["replacements"].append(replacement)
    return {"description": {"text": sentence(finding.fix or finding.message)}, "artifactChanges": list(changes.values())}


def _fingerprint(finding: Finding, places: SarifPlaces, seen: Counter[str]) -> str:
    """An identification of a finding that survives inserted lines: rule, file, element, message, and the text of its line.

    Findings that agree in all of these get a number after a colon from the second on (Appendix B of SARIF).
    """
    where, line = places.named(finding.location) if finding.location else ("", "")
    message = _LINES.sub("", finding.message)
    about = finding.element or str(finding.evidence.get("component", ""))
    parts = [finding.rule, where, " ".join(line.split()), about, message]
    key = hashlib.sha256("\0".join(parts).encode(errors="surrogatepass")).hexdigest()[:32]
    seen[key] += 1
    return f"{key}:{seen[key]}"


# ---- places

ROOT_ID = "SRCROOT"
"""The conventional name of the folder that sources are relative to (3.14.14)."""
OTHER_ID = "OTHERROOT"
"""The folder above all files that are not below that one."""
_LONGEST = 400  # characters of a line that are shown


class SarifPlaces:
    """Turns places of findings into those of SARIF.

    Args:
        base: the folder that paths are relative to; None for the root of the repository that the current folder is in, else that
            folder.
    """

    def __init__(self, base: Path | None = None) -> None:
        self.root = Path(os.path.abspath(base)) if base is not None else _repository(Path.cwd())
        self._lines: dict[str, list[bytes] | None] = {}
        self._others: set[Path] = set()

    def bases(self) -> dict[str, Any]:
        """The folders that addresses are relative to (3.14.14)."""
        bases = {ROOT_ID: {"uri": f"{self.root.as_uri().rstrip('/')}/"}}
        if self._others:
            bases[OTHER_ID] = {"uri": Path("/").resolve().as_uri()}
        return bases

    def artifact(self, path: str) -> dict[str, Any]:
        """The address of a file (3.4), relative to the root, or to the root of all files if it is not below that."""
        whole = Path(os.path.abspath(path))
        if whole.is_relative_to(self.root):
            return {"uri": _quoted(whole.relative_to(self.root)), "uriBaseId": ROOT_ID}
        self._others.add(whole)
        return {"uri": _quoted(whole.relative_to(whole.anchor)), "uriBaseId": OTHER_ID}

    def physical(self, location: Location, *, snippet: bool = True) -> dict[str, Any]:
        """A physical location (3.29).

        Args:
            location: as a finding has it.
            snippet: whether the text of the region and the line around it are shown.
        """
        return self.physical_at(
            location.path, location.line, location.column, location.end_line, location.end_column, snippet=snippet
        )

    def physical_at(
        self,
        path: str,
        line: int | None,
        column: int | None,
        end_line: int | None,
        end_column: int | None,
        *,
        snippet: bool = True,
    ) -> dict[str, Any]:
        """A physical location of a line and a column, both counted from 1, the columns in bytes."""
        place: dict[str, Any] = {"artifactLocation": self.artifact(path)}
        lines = self._read(path)
        if lines is None:
            place["region"] = {"byteOffset": 0, "byteLength": _size(path)}
            return place
        if line is None or not 1 <= line <= len(lines):
            place["region"] = {"startLine": 1, "endLine": len(lines)}
            return place
        region: dict[str, int | dict[str, str]] = {"startLine": line}
        place["region"] = region
        start, end = self._column(lines, line, column), self._column(lines, end_line or line, end_column)
        if start is not None:
            region["startColumn"] = start
            if end is not None and ((end_line or line), end) >= (line, start):
                region |= {"endLine": end_line or line, "endColumn": end}
        shown = _shown(lines[line - 1])
        if snippet and shown.strip() and len(shown) <= _LONGEST:
            if region.get("endLine") == line and isinstance(end, int) and isinstance(start, int) and end > start:
                region["snippet"] = {"text": shown[start - 1 : end - 1]}
            first, last = max(1, line - 1), min(len(lines), max(line, end_line or line) + 1)
            around = [_shown(text) for text in lines[first - 1 : last]]
            if last - first < 12 and all(len(text) <= _LONGEST for text in around) and "snippet" in region:
                place["contextRegion"] = {"startLine": first, "endLine": last, "snippet": {"text": "\n".join(around)}}
        return place

    def named(self, location: Location) -> tuple[str, str]:
        """A file's address below its base, and the text of the line; an empty text if unknown."""
        lines = self._read(location.path)
        known = lines is not None and location.line is not None and 1 <= location.line <= len(lines)
        return self.artifact(location.path)["uri"], _shown(lines[location.line - 1]) if known else ""  # type: ignore[index, operator]

    def _column(self, lines: list[bytes], line: int, column: int | None) -> int | None:
        """A column in characters of one that is given in bytes; None where the line has no such place."""
        if column is None or column < 1 or line > len(lines) or column > len(lines[line - 1]) + 1:
            return None
        whole = lines[line - 1]
        before = whole[: column - 1]
        return len(before.decode("utf-8", errors="ignore") if _is_utf8(whole) else before) + 1

    def _read(self, path: str) -> list[bytes] | None:
        """The lines of a text file; None if it is not text, does not exist, or may not be read."""
        if path not in self._lines:
            try:
                data = inputs.read_bytes(path, inputs.DRAWING)
            except (OSError, ValueError):
                data = b"\0"
            self._lines[path] = None if b"\0" in data[:8192] else data.replace(b"\r\n", b"\n").split(b"\n")
        return self._lines[path]


def _shown(line: bytes) -> str:
    """A line as text; a byte that is no UTF-8 is one character."""
    return line.decode("utf-8" if _is_utf8(line) else "latin-1")


def _is_utf8(line: bytes) -> bool:
    try:
        line.decode("utf-8")
    except UnicodeDecodeError:
        return False
    return True


def _size(path: str) -> int:
    """The size of a file in bytes; 0 if there is no such file."""
    try:
        return os.path.getsize(path) if os.path.isfile(path) else 0
    except (OSError, ValueError):
        return 0


def _quoted(path: Path) -> str:
    """A relative path as a relative reference (RFC 3986); a first part with a colon is no scheme."""
    text = quote(os.fsencode(path.as_posix()), safe="/!$&'()*+,;=@-._~")
    return text.replace("%2F", "/") if text != "." else "./"


def _repository(folder: Path) -> Path:
    """The folder of the repository that a folder is in; that folder itself if it is in none."""
    return next((each for each in (folder, *folder.parents) if (each / ".git").exists()), folder)
