"""The tour of the README with real output: runs its commands and fills its blocks.

`python tests/readme_tour.py` (make readme) writes the README anew; a test compares. A block stands behind a comment that
says what it shows: a command line, or `sketch:` and a file that a command made.
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
README = ROOT / "README.md"
_BLOCK = re.compile(r"(<!-- (?P<what>[^\n]+) -->\n```(?P<language>\w*)\n)(?P<body>.*?)(```\n)", re.DOTALL)


def filled(text: str, folder: Path) -> str:
    """The text with all blocks as the commands give them now.

    Args:
        text: the README.
        folder: an empty folder that stands for the `out` of the tour.
    """
    environment = {**os.environ, "ROBOSMI_HOME": str(folder), "PYTHONPATH": str(ROOT)}
    environment.pop("ROBOSMI_HISTORY", None)

    def fill(match: re.Match[str]) -> str:
        what = match["what"]
        if what.startswith("sketch: "):
            body = (folder / what.removeprefix("sketch: out/")).read_text(encoding="utf-8")
        else:
            words = [str(folder / w[4:]) if w.startswith("out/") else w for w in shlex.split(what)]
            done = subprocess.run(
                [sys.executable, "-m", *words], capture_output=True, text=True, cwd=ROOT, env=environment, check=True
            )
            body = f"$ {what}\n{done.stdout}".replace(str(folder), "out")
        return f"{match[1]}{body}{match[5]}"

    return _BLOCK.sub(fill, text)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        README.write_text(filled(README.read_text(encoding="utf-8"), Path(name)), encoding="utf-8")
