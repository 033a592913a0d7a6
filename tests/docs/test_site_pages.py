"""The documentation as a site: its pages, those made from the code among them, and the check of links. Without MkDocs."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.cli.main import COMMANDS
from tests.site_pages.links import broken
from tests.site_pages.references import PUBLIC
from tests.site_pages.sources import collect, navigation


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site").resolve()
    collect(folder)
    return folder


def test_every_page_has_a_heading_in_the_navigation(pages: Path) -> None:
    listed = [page for entry in navigation(pages) for names in entry.values() for page in names]
    assert len(listed) == len(set(listed))
    assert all((pages / page).is_file() for page in listed)
    written = {path.relative_to(pages).as_posix() for path in pages.rglob("*.md")}
    lists = {page for page in written - set(listed) if page.endswith("README.md")}  # of the files of an example
    assert written - set(listed) - lists == set()
    assert len(listed) > 60


def test_the_reference_has_every_command_and_public_module(pages: Path) -> None:
    commands = (pages / "docs" / "reference" / "commands.md").read_text(encoding="utf-8")
    assert [line[3:] for line in commands.splitlines() if line.startswith("## ")] == list(COMMANDS)
    assert "--widths" in commands
    python = (pages / "docs" / "reference" / "python.md").read_text(encoding="utf-8")
    assert [line[3:] for line in python.splitlines() if line.startswith("## ")] == list(PUBLIC)
    assert "### robosmi.migrate\n" in python
    assert "### robosmi.query.Q\n" in python
    assert "- output: " in python


def test_links_to_what_is_beside_the_documents_lead_to_copies(pages: Path) -> None:
    page = (pages / "docs" / "how-to" / "add-a-constraint.md").read_text(encoding="utf-8")
    assert "](../../metamodels/README.md)" in page
    assert (pages / "metamodels" / "README.md").is_file()
    assert "line_follower.ipynb" not in (pages / "docs" / "README.md").read_text(encoding="utf-8").replace("line_follower.md", "")


def test_a_link_that_leads_nowhere_is_found(tmp_path: Path) -> None:
    (tmp_path / "a.html").write_text(
        '<h1 id="top">A</h1><a href="b.html#here">b</a><img src="c.png"><a href="https://x.org/y">x</a>'
    )
    (tmp_path / "b.html").write_text('<a id="there" href="a.html#top">a</a><a href="#there">b</a>')
    assert list(broken(tmp_path)) == ["a.html: b.html#here", "a.html: c.png"]
