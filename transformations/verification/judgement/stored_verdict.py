"""The verdict of the last comparison of a sketch with its original, as long as the sketch is as it was then.

`verify` stores it beside the models, with a digest of each file of the sketch. A run that writes the report again, and the page,
show it only while these digests fit: a verdict on another sketch says nothing.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path

import msgspec
from msgspec import Struct

from robosmi import inputs
from robosmi.errors import RobosmiError
from robosmi.metamodels import migration

FILE = "verdict.json"
"""Name of the record, in the folder of the models."""
SCHEMA = "robosmi-verdict/1"
SEVERITIES = {
    "RS850": migration.SeverityLevel.info,
    "RS851": migration.SeverityLevel.error,
    "RS852": migration.SeverityLevel.warning,
    "RS853": migration.SeverityLevel.error,
}
"""Rule of a verdict -> how severe its finding is."""


class StoredVerdict(Struct, frozen=True):
    """A verdict, and the sketch that it is about.

    Attributes:
        schema: the form of the record.
        sketch: file of the sketch's folder -> SHA-256.
        rule, message, fix: of the finding that the verdict is in a plan.
        picture: whether the picture beside the models is of this comparison.
    """

    schema: str
    sketch: dict[str, str]
    rule: str
    message: str
    fix: str
    picture: bool = False

    def to_bytes(self) -> bytes:
        """The record's file."""
        return msgspec.json.format(msgspec.json.encode(self), indent=1) + b"\n"

    def finding(self) -> migration.PlanFinding:
        """The verdict as a finding of the plan."""
        return migration.PlanFinding(rule=self.rule, severity=SEVERITIES[self.rule], message=self.message, fix=self.fix)


def sketch_digests(output: Path) -> dict[str, str]:
    """The files of the sketch in an output folder as they are: relative path -> SHA-256.

    Raises:
        SourceError: there is no sketch, or a file of it cannot be read.
    """
    from robosmi.verify.toolchains.compiled_program import digests, folder_of  # few runs find a verdict
    from robosmi.verify.toolchains.sketch import find_sketch

    sketch, _ = find_sketch(output)
    return digests(sketch, folder_of(output, sketch))


def stored_verdict(output: Path, name: str, files: Mapping[str, bytes] | None = None) -> StoredVerdict | None:
    """The verdict that is stored in an output folder, or None if there is none about the sketch there.

    Args:
        output: the output folder.
        name: of the program, which is its folder's, too.
        files: what is about to be written there, relative path -> bytes.
    """
    try:
        record = msgspec.json.decode(inputs.read_bytes(output / "models" / FILE, inputs.RECORD), type=StoredVerdict)
        if record.schema != SCHEMA or record.rule not in SEVERITIES:
            return None
        there = sketch_digests(output)
    except (OSError, msgspec.DecodeError, RobosmiError):
        return None  # `verify` reports it
    made = {path.removeprefix(f"{name}/"): data for path, data in (files or {}).items() if path.startswith(f"{name}/")}
    there |= {path: hashlib.sha256(data).hexdigest() for path, data in made.items() if not path.endswith(".md")}
    return record if there == record.sketch else None


def set_verdict(plan: migration.MigrationPlan, record: StoredVerdict | None) -> None:
    """Make a verdict the only one of a plan's findings; none of them is left where there is no verdict."""
    before = [finding for finding in plan.findings if finding.rule in SEVERITIES]
    new = [record.finding()] if record is not None else []
    if [(f.rule, f.message) for f in before] == [(f.rule, f.message) for f in new]:
        return
    for finding in before:
        plan.findings.remove(finding)
    plan.findings.extend(new)
