"""How quick the page of a plan is in a real browser, chromium.

Each figure is the least of several runs; the note has the median. Ready: from the first byte of the server's answer to the
event that all is in place, by the clock; for a case study as it is, and for one with 3,000 lines more and 5,000 findings.
A choice shown: from the key to the new plan on the page, with the sketch made again.
Scrolling: the longest task that the browser reports to the page (it does so from 50 ms on, by the clock), and what the page's
thread computes in the longest step, all its tasks together. What else the machine does shows in all that is by the clock.
"""

from __future__ import annotations

import os
import shutil
import statistics
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from threading import Thread
from typing import Any

import robosmi
from robosmi.errors import MissingToolError
from robosmi.metamodels import migration
from robosmi.report.page_server import PageServer
from robosmi.transformations.chains.page import PlanPage
from robosmi.transformations.chains.stages.models import load_models
from tests.bench.figures import Figure
from tests.page.browsers import Served, chromium, task_seconds

EXAMPLES = Path(__file__).parents[2] / "docs" / "examples"
FINDINGS, LINES, STEPS, RUNS = 5000, 3000, 50, 5
WATCH = """
window.tasks = [];
const watch = new PerformanceObserver(list => { for (const task of list.getEntries()) tasks.push(task.duration); });
watch.observe({ type: "longtask" });
"""
STEP = """
const done = arguments[0];
window.scrollBy(0, 700);
for (const side of document.querySelectorAll(".side")) side.scrollBy(0, 700);
requestAnimationFrame(() => requestAnimationFrame(() => done(true)));
"""
READY = "const t = performance.getEntriesByType('navigation')[0]; return t.domContentLoadedEventEnd - t.responseStart"


def figures() -> Iterator[Figure]:
    """Times of the page.

    Raises:
        MissingToolError: there is no chromium, or no driver for it.
    """
    for tool in ("chromium", "chromedriver"):
        if shutil.which(tool) is None:
            raise MissingToolError(f"{tool} is not installed", fix="apt-get install chromium chromium-driver")
    with tempfile.TemporaryDirectory() as name:
        os.environ["ROBOSMI_HOME"] = f"{name}/data"
        for what, bound, values in measured(Path(name), RUNS):
            yield Figure(f"page: {what}", min(values), "ms", bound, note=f"median {statistics.median(values):.0f} ms")


def measured(folder: Path, runs: int) -> Iterator[tuple[str, float, list[float]]]:
    """The figures: what, the bound and the values, in milliseconds."""
    small = migrated(folder / "small")
    big = migrated(folder / "big", more_lines=LINES)
    models = load_models(big / "models" / "plan.xmi")
    models.plan.findings.extend(
        migration.PlanFinding(rule="RS999", severity=migration.SeverityLevel.warning, message=f"finding {n} of many")
        for n in range(FINDINGS)
    )
    for name, data in models.to_files().items():
        (big / "models" / name).write_bytes(data)
    with chromium() as browser:
        with served(browser, small) as page:
            yield "ready, the environmental monitoring robot", 500, [ready(page) for _ in range(runs)]
            offered = page.offered("port:alarmLed")
            yield "a choice shown", 1000, [choice(page, offered[n % len(offered)]) for n in range(runs)]
        with served(browser, big) as page:
            what = f"{FINDINGS} findings, {LINES} more lines"
            yield f"ready, {what}", 500, [ready(page) for _ in range(runs)]
            yield f"a choice shown, {what}", 1000, [choice(page, offered[n % len(offered)]) for n in range(runs)]
            found = [scrolled(page) for _ in range(runs)]
            yield f"longest task while scrolling, {what}", 50, [longest for longest, _ in found]
            yield f"longest step of scrolling, {what}", 50, [step for _, step in found]


def migrated(folder: Path, more_lines: int = 0) -> Path:
    """The robot, migrated without what its engineer has said."""
    shutil.copytree(EXAMPLES / "environmental_monitoring", folder)
    (folder / "robosmi.toml").unlink()
    (source,), (drawing,) = list(folder.glob("*.c")), list(folder.glob("*.fzz"))
    source.write_text(source.read_text() + "\n" + "\n".join(f"int more{n} = {n};" for n in range(more_lines)) + "\n")
    robosmi.migrate([source], folder / "out", hardware=drawing)
    return folder / "out"


@contextmanager
def served(browser: Any, out: Path) -> Iterator[Served]:
    """The page of an output folder in a browser."""
    server = PageServer(PlanPage(out))
    Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()
    page = Served(browser, server.url, out)
    page.open()
    yield page
    server.shutdown()
    server.server_close()


def ready(page: Served) -> float:
    """Milliseconds from the server's answer until the page is ready."""
    page.open()
    return float(page.script(READY))


def choice(page: Served, value: str) -> float:
    """Milliseconds from the key until the page shows what was chosen."""
    page.open()
    if page.script("return document.querySelector('[data-choice=\"port:alarmLed\"]').dataset.chosen") == value:
        value = page.offered("port:alarmLed")[-1]
    before = page.script("return document.body.dataset.plan")
    page.go("port:alarmLed", value)
    start = time.perf_counter()
    page.enter()
    page.wait_for_another(before)
    return 1000 * (time.perf_counter() - start)


def scrolled(page: Served) -> tuple[float, float]:
    """The longest task that the browser reports while the page is scrolled, and the longest step of the page's thread."""
    page.open()
    page.browser.execute_cdp_cmd("Performance.enable", {"timeDomain": "threadTicks"})
    page.browser.execute_async_script(STEP)  # the first one ends what loading has begun
    page.script(WATCH)
    taken = [task_seconds(page.browser)]
    for _ in range(STEPS):
        page.browser.execute_async_script(STEP)
        taken.append(task_seconds(page.browser))
    page.browser.execute_cdp_cmd("Performance.disable", {})
    longest = max(page.script("return window.tasks"), default=0.0)
    return float(longest), 1000 * max(after - before for before, after in pairwise(taken))
