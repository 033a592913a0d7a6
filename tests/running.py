"""Runs the command line in this process as tests do, and checks every run against the rules that all commands share.

There must be no traceback and no message "our own bug"; with --json exactly one JSON document on stdout, always with the same
keys.
"""

from __future__ import annotations

import hashlib
import io
import json
import os
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robosmi.cli.main import main

DOCUMENT_KEYS = {"schema", "command", "ok", "result", "findings", "tasks", "artifacts", "timings"}
FINDING_KEYS = {"id", "rule", "severity", "message", "location", "element", "fix", "evidence", "steps", "edits"}
LOCATION_KEYS = {"path", "line", "column", "end_line", "end_column"}


@dataclass(frozen=True)
class Outcome:
    """What one run of the command line gave: exit code, and what it printed."""

    code: int
    out: str
    err: str

    @property
    def document(self) -> Any:
        """The JSON document on stdout."""
        return json.loads(self.out)

    @property
    def result(self) -> Any:
        """The command's own part of the document."""
        return self.document["result"]

    def rules(self) -> set[str]:
        """The rules of the document's findings."""
        return {finding["rule"] for finding in self.document["findings"]}


def run(*words: str | Path) -> Outcome:
    """Run one command."""
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        try:
            code = main([str(word) for word in words])
        except SystemExit as end:  # --help and --version
            code = int(end.code or 0)
    outcome = Outcome(code, out.getvalue(), err.getvalue())
    assert "Traceback" not in outcome.out + outcome.err
    assert code != 70, outcome.err
    if "--json" in words:
        check_document(outcome.document)
    return outcome


def check_document(document: Any) -> None:
    """Check a document against the part of the contract that all commands share."""
    assert set(document) >= DOCUMENT_KEYS
    assert document["schema"] == "robosmi/1"
    assert document["timings"]["total_s"] >= 0
    entries = [*document["findings"], *document["tasks"]]
    for entry in entries:
        assert set(entry) >= FINDING_KEYS
        assert entry["severity"] in ("error", "warning", "info")
        assert entry["location"] is None or set(entry["location"]) == LOCATION_KEYS
    assert all(set(artifact) == {"path", "kind"} for artifact in document["artifacts"])
    ids = [entry["id"] for entry in entries]
    assert len(ids) == len(set(ids)), "ids are unique, or scripts cannot follow them"


def tree(folder: Path) -> dict[str, str]:
    """Everything below a folder: relative path -> digest of a file, or what else it is."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        found[name] = hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else "folder"
    return found


def alive(process: int) -> bool:
    """Whether a process runs; one that has ended and that nobody has asked about does not."""
    try:
        os.kill(process, 0)
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (ProcessLookupError, FileNotFoundError):
        return False
