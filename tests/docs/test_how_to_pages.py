"""The pages `docs/how-to/add-a-*.md`: their files are written and their commands run, in an empty folder, in the page's order.

A line with a path in backquotes and a colon says which file the block below it is. Of what a command of a `console` block prints,
each line of the block must be the beginning of a line, in order; `...` stands for anything. A file `pyproject.toml` is what an
installed package says of itself.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from tests.tools import require_tools

HOW_TO = Path(__file__).resolve().parents[2] / "docs" / "how-to"
ROOT = HOW_TO.parents[1]
PAGES = sorted(page.stem for page in HOW_TO.glob("add-*.md") if "```console" in page.read_text(encoding="utf-8"))
_FENCE = re.compile(r"(?:^`(?P<path>[^`\n]+)`:\n\n)?^```(?P<language>\w*)\n(?P<body>.*?)^```$", re.MULTILINE | re.DOTALL)


def test_every_row_of_the_table_of_what_adding_costs_has_a_page() -> None:
    text = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    linked = set(re.findall(r"\]\(how-to/([\w-]+)\.md\)", text))
    assert {"add-a-board", "add-a-part", "add-an-adapter", "add-a-target", "add-a-drawing-reader", "add-a-constraint",
            "add-a-driver", "add-a-query", "add-a-metamodel-and-chain", "change-a-step"} <= linked  # fmt: skip
    assert [name for name in linked if not (HOW_TO / f"{name}.md").is_file()] == []


def test_every_link_of_the_documents_leads_somewhere() -> None:
    broken = []
    pages = [*(ROOT / "docs").rglob("*.md"), ROOT / "README.md", ROOT / "CHANGELOG.md"]
    for page in pages:
        prose = re.sub(r"```.*?```|`[^`\n]*`", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)  # nor is `f[i](x)` one
        for link in re.findall(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)", prose):
            if not (page.parent / link).exists():
                broken.append(f"{page.relative_to(ROOT)}: {link}")
    assert len(pages) > 30
    assert broken == []


def test_every_module_that_the_method_and_the_promises_name_exists() -> None:
    docs = ROOT / "docs"
    pages = [*docs.glob("method/*.md"), *docs.glob("decisions/*.md"), docs / "security.md", docs / "glossary.md"]
    folders = ("robosmi", "transformations", "platform_repo", "metamodels", "tests")
    modules = {path.name for folder in folders for path in (ROOT / folder).rglob("*.py")} | {"robosmi.py", "argparse.py"}
    named = {(page.name, name) for page in pages for name in re.findall(r"`(?:[\w/]+/)?(\w+\.py)`", page.read_text("utf-8"))}
    assert len(named) > 20
    assert sorted(each for each in named if each[1] not in modules) == []


@pytest.mark.parametrize("page", PAGES)
def test_the_files_and_commands_of_a_page_do_what_it_says(page: str, tmp_path: Path) -> None:
    text = (HOW_TO / f"{page}.md").read_text(encoding="utf-8")
    if "robosmi compile" in text:
        require_tools("avr-g++", "arduino-core-avr")
    folder = tmp_path / "here"
    folder.mkdir()
    commands = 0
    for fence in _FENCE.finditer(text):
        if fence["path"] is not None:
            write(folder, fence["path"], fence["body"])
        elif fence["language"] == "console":
            for command, expected in steps(fence["body"]):
                said = run(command, folder, tmp_path)
                compare(said, expected, f"{page}: {command}")
                commands += 1
    assert commands


def write(folder: Path, name: str, text: str) -> None:
    """Write a file of the page; of a package also what `pip install` would note of its entry points."""
    file = folder / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
    if name == "pyproject.toml":
        project = tomllib.loads(text)["project"]
        noted = folder / f"{project['name'].replace('-', '_')}-{project['version']}.dist-info"
        noted.mkdir()
        (noted / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n")
        lines = [
            f"[{group}]\n{key} = {value}\n" for group, points in project["entry-points"].items() for key, value in points.items()
        ]
        (noted / "entry_points.txt").write_text("".join(lines))


def steps(body: str) -> list[tuple[str, list[str]]]:
    """The commands of a block, each with the lines that it is to print."""
    found: list[tuple[str, list[str]]] = []
    for line in body.splitlines():
        if line.startswith("$ "):
            found.append((line[2:], []))
        else:
            found[-1][1].append(line)
    return found


def run(command: str, folder: Path, home: Path) -> list[str]:
    """The lines that a command prints, on either stream."""
    environment = {**os.environ, "ROBOSMI_HOME": str(home / "home"), "PYTHONPATH": f"{folder}{os.pathsep}{ROOT}", "NO_COLOR": "1"}
    for name in ("ROBOSMI_HISTORY", "ROBOSMI_PATH"):
        environment.pop(name, None)
    words = re.sub(r"^python\b", sys.executable, re.sub(r"^robosmi\b", f"{sys.executable} -m robosmi", command))
    done = subprocess.run(
        ["sh", "-c", words], cwd=folder, env=environment, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=120
    )
    assert done.returncode in (0, 1), f"{command}: {done.stdout}{done.stderr}"
    return [*done.stdout.splitlines(), *done.stderr.splitlines()]


def compare(said: list[str], expected: list[str], what: str) -> None:
    """Find each expected line in what was said, in order."""
    place = 0
    for line in expected:
        if line == "...":
            continue
        pattern = ".*".join(map(re.escape, line.split("...")))
        rest = [n for n in range(place, len(said)) if re.match(pattern, said[n])]
        assert rest, f"{what} does not print '{line}' (any more):\n" + "\n".join(said)
        place = rest[0] + 1
