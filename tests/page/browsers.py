"""A real browser that tests and measurements drive, and a page that it shows."""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

PATIENCE = 20.0
"""Seconds that a test waits for the page, on a busy machine."""


@contextmanager
def chromium() -> Iterator[Any]:
    """Chromium without a window, driven by chromedriver."""
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--window-size=1280,900", "--disable-gpu"):
        options.add_argument(argument)
    options.binary_location = str(shutil.which("chromium"))
    driver = webdriver.Chrome(options=options, service=Service(str(shutil.which("chromedriver"))))
    try:
        yield driver
    finally:
        driver.quit()


def task_seconds(browser: Any) -> float:
    """Processor seconds that the page's thread has spent on all of its tasks."""
    metrics = browser.execute_cdp_cmd("Performance.getMetrics", {})["metrics"]
    return float(next(metric["value"] for metric in metrics if metric["name"] == "TaskDuration"))


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

    def wait(self, condition: Callable[[], Any], patience: float = PATIENCE) -> Any:
        """Wait until something holds."""
        end = time.monotonic() + patience
        while not (found := condition()):
            assert time.monotonic() < end, f"{self.state()}: {self.told()}"
            time.sleep(0.02)
        return found

    def state(self) -> str:
        """The state that the page shows."""
        return str(self.script("return document.getElementById('status').dataset.state"))

    def told(self) -> str:
        """The page's message about the last step."""
        return str(self.script("return document.getElementById('status').textContent"))

    def wait_for_another(self, plan: str) -> None:
        """Wait until the page shows another plan than the one with that digest."""
        self.wait(lambda: self.script("return document.body.dataset.plan") != plan)

    def shown(self) -> None:
        """Wait until what the page has changed is laid out and painted."""
        self.browser.execute_async_script(
            "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => done()))"
        )

    def open_choices(self) -> list[str]:
        """The choices that are open."""
        found = "return [...document.querySelectorAll('[data-choice][data-chosen=\"\"]')].map(each => each.dataset.choice)"
        return list(self.script(found))

    def offered(self, choice: str) -> list[str]:
        """The answers that a choice offers, in their order."""
        found = (
            'return [...document.querySelectorAll(`[data-choice="${arguments[0]}"] [data-option]`)].map(e => e.dataset.option)'
        )
        return list(self.script(found, choice))

    def go(self, choice: str, value: str) -> None:
        """Go to an answer with the Tab key alone; a decided choice is unfolded before."""
        from selenium.webdriver.common.action_chains import ActionChains
        from selenium.webdriver.common.keys import Keys

        self.script(
            'const its = document.querySelector(`details[data-choice="${arguments[0]}"]`); if (its) its.open = true', choice
        )
        steps = self.script(
            "const all = [...document.querySelectorAll('a[href], button, input, select, summary, [tabindex=\"0\"]')]"
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
