"""A browser for the tests of the page, one for all, and pages served from this process."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Thread
from typing import Any

import pytest

import robosmi
from robosmi.report.page_server import PageServer
from robosmi.transformations.chains.page import PlanPage
from tests.page.browsers import Served, chromium
from tests.tools import require_tools

AXE = Path(__file__).parents[2] / ".npm" / "node_modules" / "axe-core" / "axe.min.js"


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """Chromium without a window, one for all tests."""
    require_tools("chromium", "chromedriver")
    with chromium() as driver:
        yield driver


@pytest.fixture
def serve(browser: Any) -> Iterator[Callable[[Path], Served]]:
    """Serve the page of an output folder."""
    servers: list[PageServer] = []

    def started(out: Path) -> Served:
        server = PageServer(PlanPage(out))
        servers.append(server)
        Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()
        return Served(browser, server.url, out)

    yield started
    for server in servers:
        server.shutdown()
        server.server_close()


@pytest.fixture
def migrated(tmp_path: Path, examples: Path) -> Callable[[str], tuple[list[Path], Path, Path]]:
    """Migrate a case study without what an engineer has said of it: its sources, its drawing, the output folder."""

    def made(name: str) -> tuple[list[Path], Path, Path]:
        shutil.copytree(examples / name, tmp_path / name)
        (tmp_path / name / "robosmi.toml").unlink()
        sources, (drawing,) = sorted((tmp_path / name).glob("*.c")), list((tmp_path / name).glob("*.fzz"))
        robosmi.migrate(sources, tmp_path / "out", hardware=drawing)
        return sources, drawing, tmp_path / "out"

    return made
