"""The findings of every program of a folder as SARIF, judged by the SARIF Multitool.

    python -m tests.corpus.sarif_corpus FOLDER

Each `.c` file is analysed, and migrated with `--widths keep`, which finds most. Prints how many files were made, with how many
results, code flows and fixes, and each complaint; ends with 1 if there is one.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections import Counter
from pathlib import Path

from tests.running import run
from tests.sarif_judge import complaints

BATCH = 40
"""Number of files that are judged at a time; the judge may take a while for each."""


def main(folder: Path) -> int:
    """Make and judge the files; the exit code."""
    counts: Counter[str] = Counter()
    with tempfile.TemporaryDirectory(prefix="sarif-corpus-") as name:
        out = Path(name)
        made: list[Path] = []
        said: list[str] = []
        judged = 0
        for number, program in enumerate(sorted(folder.rglob("*.c"))):
            for command in ("analyse", "migrate"):
                path = out / f"{number}-{command}.sarif"
                more: list[str | Path] = ["-o", out / "sketch" / str(number), "--widths", "keep"] if command == "migrate" else []
                run(command, program, *more, "--sarif", path)
                made.append(path)
                counts += _counted(json.loads(path.read_text(encoding="utf-8")))
            if len(made) - judged >= BATCH:
                said += complaints(made[judged:])
                judged = len(made)
                print(f"{judged} files: {len(said)} complaints", flush=True)
        said += complaints(made[judged:]) if made[judged:] else []
    print(f"{len(made)} files, {counts['results']} results of {len([k for k in counts if k.startswith('RS')])} rules,", end=" ")
    print(f"{counts['codeFlows']} with code flows, {counts['fixes']} with fixes: {len(said)} complaints")
    for complaint in said:
        print(complaint)
    return int(bool(said))


def _counted(log: dict[str, object]) -> Counter[str]:
    found: Counter[str] = Counter()
    for result in log["runs"][0]["results"]:  # type: ignore[index]
        found.update(["results", result["ruleId"], *(k for k in ("codeFlows", "fixes") if k in result)])
    return found


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
