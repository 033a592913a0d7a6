"""A browser for the tests of the page, one for all, and pages served from this process."""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from threading import Thread
from typing import Any

import pytest

import robosmi
from robosmi.report.page_server import PageServer
from robosmi.transformations.chains.page import PlanPage
from tests.tools import require_tools

AXE = Path(__file__).parents[2] / ".npm" / "node_modules" / "axe-core" / "axe.min.js"
PATIENCE = 20.0
"""Seconds that a test waits for what the page is to show, on a machine that does much else."""


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """Chromium without a window, driven by chromedriver."""
    require_tools("chromium", "chromedriver")
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--window-size=1280,900", "--disable-gpu"):
        options.add_argument(argument)
    options.binary_location = str(shutil.which("chromium"))
    driver = webdriver.Chrome(options=options, service=Service(str(shutil.which("chromedriver"))))
    yield driver
    driver.quit()


@dataclass
class Served:
    """A page that is served, and the browser that shows it."""

    browser: Any
    url: str
    out: Path

    def open(self) -> None:
        """Show the page and wait until it is ready."""
        self.browser.get(self.url)
        self.wait(lambda: self.script("return document.body.dataset.ready"))

    def script(self, text: str, *values: Any) -> Any:
        """The value of a piece of JavaScript, run by the driver and not by the page."""
        return self.browser.execute_script(text, *values)

    def wait(self, condition: Callable[[], Any]) -> Any:
        """Wait until something holds."""
        end = time.monotonic() + PATIENCE
        while not (found := condition()):
            assert time.monotonic() < end, f"{self.state()}: {self.told()}"
            time.sleep(0.02)
        return found

    def state(self) -> str:
        """The state that the page says it is in."""
        return str(self.script("return document.getElementById('status').dataset.state"))

    def told(self) -> str:
        """What the page says of the last step."""
        return str(self.script("return document.getElementById('status').textContent"))

    def wait_for_another(self, plan: str) -> None:
        """Wait until the page shows another plan than the one with that digest."""
        self.wait(lambda: self.script("return document.body.dataset.plan") != plan)

    def open_choices(self) -> list[str]:
        """The choices that are open."""
        found = "return [...document.querySelectorAll('[data-choice][data-chosen=\"\"]')].map(each => each.dataset.choice)"
        return list(self.script(found))

    def go(self, choice: str, value: str) -> None:
        """Go to an answer with the Tab key alone."""
        from selenium.webdriver.common.action_chains import ActionChains
        from selenium.webdriver.common.keys import Keys

        steps = self.script(
            "const all = [...document.querySelectorAll('a[href], button, input, [tabindex=\"0\"]')]"
            ".filter(e => e.checkVisibility());"
            "const to = all.findIndex(e => e.dataset.option === arguments[1]"
            " && e.closest('[data-choice]')?.dataset.choice === arguments[0]);"
            "return to - all.indexOf(document.activeElement)",
            choice, value,
        )  # fmt: skip
        keys = ActionChains(self.browser)
        if steps < 0:
            keys.key_down(Keys.SHIFT)
        for _ in range(abs(steps)):
            keys.send_keys(Keys.TAB)
        if steps < 0:
            keys.key_up(Keys.SHIFT)
        keys.perform()
        held = "const e = document.activeElement; return [e.closest('[data-choice]')?.dataset.choice, e.dataset.option]"
        assert self.script(held) == [choice, value], (steps, self.script("return document.activeElement.outerHTML.slice(0, 300)"))

    def enter(self) -> None:
        """Press Enter where the focus is."""
        from selenium.webdriver.common.action_chains import ActionChains
        from selenium.webdriver.common.keys import Keys

        ActionChains(self.browser).send_keys(Keys.ENTER).perform()

    def press(self, choice: str, value: str) -> None:
        """Take an answer with the keyboard alone."""
        self.go(choice, value)
        self.enter()

    def choose(self, choice: str, value: str) -> None:
        """Press an answer, and wait until the page says that it is saved."""
        before = self.script("return document.body.dataset.plan")
        self.press(choice, value)
        self.wait_for_another(before)
        assert self.state() == "saved", self.told()


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
