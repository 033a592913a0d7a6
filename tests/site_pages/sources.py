"""The pages of the site: those of the repository in its own layout, so that their links hold, and those made from the code."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

from tests.site_pages.references import command_page, python_page

ROOT = Path(__file__).resolve().parents[2]
PAGES = ("README.md", "CHANGELOG.md", "LICENSE", "metamodels/README.md")
"""What pages in `docs` refer to beside it."""
_FILE = re.compile(r"^(```\w+) (\S+)$", re.MULTILINE)
"""The beginning of a block of code that has its file's name, as GitHub lets it be written."""
_TEMPLATES = "*.html"
"""Templates of an example, which would be pages of the site."""
_LINK = re.compile(r"(?<=\]\()(?P<target>[^)#:\s]+)(?P<anchor>#[^)\s]*)?(?=\))")
_CODE = re.compile(r"(```.*?```|`[^`\n]*`)", re.DOTALL)
_NAVIGATION = {
    "Move your robot": [
        "README.md",
        "docs/tutorial.md",
        "docs/how-to/bring-a-sketch-to-the-board.md",
        "docs/how-to/decide-in-a-browser.md",
        "docs/how-to/verify-a-migration.md",
        "docs/how-to/run-a-sketch-on-a-simulator.md",
        "docs/how-to/run-an-original-on-this-machine.md",
        "docs/how-to/drive-motors.md",
        "docs/how-to/move-an-arduino-sketch.md",
        "docs/how-to/let-an-assistant-work.md",
        "docs/how-to/work-in-an-editor.md",
        "docs/security.md",
    ],
    "Extend it": [
        "docs/how-to/add-a-board.md",
        "docs/how-to/add-a-part.md",
        "docs/how-to/add-an-adapter.md",
        "docs/how-to/add-a-target.md",
        "docs/how-to/add-a-drawing-reader.md",
        "docs/how-to/add-a-constraint.md",
        "docs/how-to/add-a-query.md",
        "docs/how-to/change-a-step.md",
    ],
    "For researchers": [
        "docs/README.md",
        "docs/how-to/query-any-model.md",
        "docs/how-to/add-a-metamodel-and-chain.md",
        "docs/how-to/add-a-driver.md",
        "docs/how-to/use-in-eclipse.md",
        "docs/how-to/run-a-corpus.md",
        "docs/examples/library_catalogue/README.md",
        "docs/examples/paper_chain/README.md",
        "docs/examples/line_follower/line_follower.md",
        "docs/examples/line_follower/step_by_step.md",
    ],
    "Method": ["docs/method/*.md"],
    "Reference": [
        "docs/reference/commands.md",
        "docs/reference/command-line.md",
        "docs/reference/python.md",
        "metamodels/README.md",
        "docs/reference/*.md",
    ],
    "The project": [
        "docs/architecture.md",
        "docs/contributing.md",
        "docs/glossary.md",
        "docs/decisions/README.md",
        "docs/decisions/*.md",
        "CHANGELOG.md",
    ],
}
"""Heading -> its pages, or patterns for those that no heading has yet."""


def collect(folder: Path) -> None:
    """Put all pages, and the files that they show or refer to, into an empty folder."""
    shutil.copytree(ROOT / "docs", folder / "docs", ignore=shutil.ignore_patterns("__pycache__", "*.pyc", _TEMPLATES))
    for name in PAGES:
        (folder / name).parent.mkdir(exist_ok=True)
        shutil.copy(ROOT / name, folder / name)
    (folder / "docs" / "reference" / "commands.md").write_text(command_page(), encoding="utf-8")
    (folder / "docs" / "reference" / "python.md").write_text(python_page(), encoding="utf-8")
    for notebook in folder.rglob("*.ipynb"):
        notebook.with_suffix(".md").write_text(_as_page(notebook), encoding="utf-8")
    for page in folder.rglob("*.md"):
        page.write_text(_relinked(page, folder), encoding="utf-8")


def navigation(folder: Path) -> list[dict[str, list[str]]]:
    """The headings with their pages, each page once."""
    seen: set[str] = set()
    found = []
    for heading, patterns in _NAVIGATION.items():
        pages = [p.relative_to(folder).as_posix() for pattern in patterns for p in sorted(folder.glob(pattern))]
        new = [page for page in dict.fromkeys(pages) if page not in seen]
        seen.update(new)
        found.append({heading: new})
    return found


def _relinked(page: Path, folder: Path) -> str:
    """A page whose links lead to pages or files of the site; a link to what the site lacks becomes its text."""

    def target(match: re.Match[str]) -> str:
        there = (page.parent / match["target"]).resolve()
        if not there.is_relative_to(folder):
            return match[0]
        source = ROOT / there.relative_to(folder)
        if source.is_dir():
            index = there / "README.md"
            if not index.is_file():
                index.parent.mkdir(parents=True, exist_ok=True)
                index.write_text(_listing(source, there), encoding="utf-8")
            return f"{match['target'].rstrip('/')}/README.md{match['anchor'] or ''}"
        if not there.exists() and source.is_file():
            there.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, there)
        if there.suffix == ".ipynb":
            return f"{match['target'].removesuffix('.ipynb')}.md"
        return match[0]

    parts = _CODE.split(page.read_text(encoding="utf-8"))
    return "".join(_FILE.sub(r'\1 title="\2"', part) if part.startswith("`") else _LINK.sub(target, part) for part in parts)


def _listing(source: Path, there: Path) -> str:
    """A page that lists the files of a folder, which are copied."""
    files = [path for path in sorted(source.iterdir()) if path.is_file() and path.suffix != ".pyc"]
    rows = [f"- {path.name}" if path.match(_TEMPLATES) else f"- [{path.name}]({path.name})" for path in files]
    for path in files:
        if not path.match(_TEMPLATES):
            shutil.copy(path, there / path.name)
    return "\n".join([f"# {source.relative_to(ROOT).as_posix()}", "", *rows, ""])


def _as_page(notebook: Path) -> str:
    """The cells of a notebook as a page: texts, and code without its results."""
    parts = [f"*This page is a notebook: [{notebook.name}]({notebook.name}). Run it to see the results.*"]
    for cell in json.loads(notebook.read_text(encoding="utf-8"))["cells"]:
        text = "".join(cell["source"])
        parts.append(text if cell["cell_type"] == "markdown" else f"```python\n{text}\n```")
    first, *rest = parts[1:]
    return "\n\n".join([first, parts[0], *rest, ""])
