"""Runs Microsoft's SARIF Multitool on SARIF files.

Its rules are about the format, consistency, help for readers, and the requirements of a large service's code scanning. It exits
with 0 whatever it finds, so its output is read. Notes are left out: four of its rules ask for what there is not (a page in the
web for each rule, an answer of the web, the revision of the user's repository, quotation marks around all messages).
"""

from __future__ import annotations

import os
import re
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TOOL = ROOT / ".npm" / "node_modules" / "@microsoft" / "sarif-multitool-linux" / "Sarif.Multitool"
_SAID = re.compile(r"^(?P<file>.*?)\(\d+,\d+\): (?P<level>error|warning) (?P<rule>\w+): (?P<text>.*)$", re.MULTILINE)


def complaints(files: Sequence[Path]) -> list[str]:
    """The errors and warnings about these files, as `name: rule: text`.

    Args:
        files: files in SARIF, each of a name of its own.
    """
    assert len({path.name for path in files}) == len(files)
    with tempfile.TemporaryDirectory(prefix="sarif-") as name:
        folder = Path(name)
        for path in files:
            (folder / path.name).write_bytes(path.read_bytes())
        done = subprocess.run(
            [TOOL, "validate", f"{folder}/*.sarif", "--level", "Error;Warning", "--rule-kind", "Sarif;Ghas"],
            capture_output=True, text=True, check=False, timeout=600,
            env={**os.environ, "DOTNET_SYSTEM_GLOBALIZATION_INVARIANT": "1", "HOME": name},
        )  # fmt: skip
    said = done.stdout + done.stderr
    assert f"Done. {len(files)} files scanned." in said, said
    assert "Analysis completed successfully." in said, said
    return [f"{Path(m['file']).name}: {m['rule']}: {m['text']}" for m in _SAID.finditer(said)]
