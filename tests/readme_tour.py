"""The README and the tutorial with real output: runs their commands and fills their blocks.

`python tests/readme_tour.py` (make readme) writes the pages and their pictures again; a test compares. A comment names the
content of the block below it:

- `robosmi ...`: the command and its output,
- `sketch: FILE`: a file that a command of the page generated,
- `lines: FILE 6-8 26`: these lines of a file, with `// ...` between the groups,
- `output`: the output of the Python block above.

Two comments have no block: `run: robosmi ...` runs a command, and `picture: robosmi ... -o docs/images/NAME` draws a picture.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
README = ROOT / "README.md"
PAGES = (README, ROOT / "docs" / "tutorial.md")
_IMAGES = "docs/images/"
_BLOCK = re.compile(
    r"(?P<head><!-- (?P<what>(?:robosmi|sketch:|lines:|output)[^\n]*) -->\n```\w*\n)(?P<body>.*?)(?P<end>```\n)"
    r"|<!-- (?:run|picture): (?P<command>[^\n]+) -->",
    re.DOTALL,
)
_PYTHON = re.compile(r"```python\n(.*?)```", re.DOTALL)


def filled(text: str, folder: Path) -> str:
    """The text with all blocks as the commands give them now.

    Args:
        text: the page.
        folder: an empty folder that stands for the `out` of the page; it also gets the pictures.
    """
    environment = {**os.environ, "ROBOSMI_HOME": str(folder), "PYTHONPATH": str(ROOT)}
    environment.pop("ROBOSMI_HISTORY", None)

    def located(name: str) -> str:
        if name.startswith(_IMAGES):
            return str(folder / name.removeprefix(_IMAGES))
        return str(folder / name.removeprefix("out/")) if name.startswith("out/") else name

    def python(*arguments: str) -> str:
        done = subprocess.run([sys.executable, *arguments], capture_output=True, text=True, cwd=ROOT, env=environment, check=True)
        return done.stdout.replace(str(folder), "out")

    def command(line: str) -> str:
        return python("-m", *map(located, shlex.split(line)))

    def fill(match: re.Match[str]) -> str:
        if match["command"]:
            command(match["command"])
            return match[0]
        kind, _, rest = match["what"].partition(" ")
        if kind == "sketch:":
            body = Path(located(rest)).read_text(encoding="utf-8")
        elif kind == "lines:":
            name, *groups = rest.split()
            body = _lines(ROOT / located(name), groups)
        elif kind == "output":
            body = python("-c", _PYTHON.findall(text, 0, match.start())[-1])
        else:
            body = f"$ {match['what']}\n{command(match['what'])}"
        return f"{match['head']}{body}{match['end']}"

    return _BLOCK.sub(fill, text)


def pictures(text: str) -> list[str]:
    """The names of a page's pictures in docs/images."""
    return re.findall(rf"<!-- picture: [^\n]+ {_IMAGES}(\S+) -->", text)


def _lines(path: Path, groups: list[str]) -> str:
    """Groups of lines of a file (`6-8`, `26`; from 1 on), with `// ...` between them."""
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    found = []
    for group in groups:
        first, _, last = group.partition("-")
        found.append("".join(lines[int(first) - 1 : int(last or first)]))
    return "// ...\n".join(found)


if __name__ == "__main__":
    for page in PAGES:
        with tempfile.TemporaryDirectory() as made:
            page.write_text(filled(page.read_text(encoding="utf-8"), Path(made)), encoding="utf-8")
            for picture in pictures(page.read_text(encoding="utf-8")):
                shutil.copy(Path(made) / picture, ROOT / _IMAGES / picture)
