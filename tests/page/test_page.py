"""The page in a real browser: what is chosen on it with the keyboard alone is in plan, project file and sketch, and stays."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from itertools import pairwise, product
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.generate.undo import undo
from robosmi.metamodels import migration
from robosmi.transformations.chains.choose import choose
from robosmi.transformations.chains.stages.models import load_models
from robosmi.transformations.queries.plans.choices import choices_json
from tests.page.browsers import Served, task_seconds
from tests.page.conftest import AXE
from tests.running import run, tree
from tests.tiers import sample
from tests.tools import require_tools

BLINK = '#include "simpletools.h"\nint eye = 3;\nint main() { while (1) { high(eye); pause(5); } }\n'
STEP = """
const done = arguments[0];
window.scrollBy(0, 700);
document.querySelector(".side").scrollBy(0, 700);
requestAnimationFrame(() => requestAnimationFrame(() => done(true)));
"""
"""Scrolls the page and one side of the code, and waits until that is shown."""
Migrated = Callable[[str], tuple[list[Path], Path, Path]]
Serve = Callable[[Path], Served]

AS_BUILT = {
    "line_follower": {
        "port:leftQTI": "HIH40302ReadP1", "port:rightQTI": "HIH40301ReadP1", "port:abdrive.left_servo": "BasicServo2WriteP1",
        "port:abdrive.right_servo": "BasicServo1WriteP1",
    },
    "environmental_monitoring": {
        "port:leftServo": "BasicServo2WriteP1", "port:rightServo": "BasicServo1WriteP1", "port:irLedLeft": "IRLED1WriteP1",
        "port:irReceiverLeft": "IRReceiver1ReadP1", "port:irLedRight": "IRLED2WriteP1",
        "port:irReceiverRight": "IRReceiver2ReadP1",
    },
}  # fmt: skip
"""The choices of the case studies' engineers; for the others the first answer is taken."""


@pytest.mark.parametrize("name", AS_BUILT)
def test_the_keyboard_alone_settles_a_case_study(name: str, migrated: Migrated, serve: Serve) -> None:
    sources, drawing, out = migrated(name)
    page = serve(out)
    page.open()
    while left := page.open_choices():
        first = f"return document.querySelector('[data-choice=\"{left[0]}\"] [data-option]').dataset.option"
        page.choose(left[0], AS_BUILT[name].get(left[0], page.script(first)))
    assert page.script("return document.getElementById('progress').dataset.open") == "0"
    compiled = run("compile", out, "--json")
    assert compiled.result["ok"], compiled.document["findings"]
    outcome = run("migrate", *sources, "--hardware", drawing, "-o", out, "--json")
    assert outcome.code == 0, outcome.err
    assert outcome.result["plan"]["open_choices"] == 0


def test_a_choice_shows_its_diff_and_command_and_a_wrong_one_is_a_finding(migrated: Migrated, serve: Serve) -> None:
    _, _, out = migrated("line_follower")
    page = serve(out)
    page.open()
    page.choose("port:leftQTI", "HIH40302ReadP1")
    assert "+const int32_t leftQTI  = HIH40302ReadP1;" in page.script("return document.getElementById('diff').textContent")
    assert page.script("return document.getElementById('command').textContent").endswith("port:leftQTI=HIH40302ReadP1")
    page.choose("port:rightQTI", "HIH40302ReadP1")
    assert "both bound to pin D10" in page.script("return document.getElementById('check').textContent")
    assert page.script("return document.activeElement.dataset.option") == "HIH40302ReadP1"  # where the person was


def test_undo_takes_a_choice_back_everywhere(migrated: Migrated, serve: Serve) -> None:
    sources, _, out = migrated("line_follower")
    page = serve(out)
    page.open()
    page.choose("port:leftQTI", "D4")
    assert 'leftQTI = "D4"' in (sources[0].parent / "robosmi.toml").read_text()
    page.script("document.querySelector('[data-undo]').click()")
    page.wait(lambda: "port:leftQTI" in page.open_choices())
    assert page.state() == "saved"
    assert not (sources[0].parent / "robosmi.toml").exists()


def test_a_tick_is_kept_in_plan_and_report(migrated: Migrated, serve: Serve) -> None:
    _, _, out = migrated("line_follower")
    page = serve(out)
    page.open()
    page.script("document.querySelector('[data-tick]').click()")
    page.wait(lambda: "MIGRATION.md" in page.told())
    assert "- [x] " in (out / "line_follower" / "MIGRATION.md").read_text()
    page.open()
    assert page.script("return document.querySelector('[data-tick]').checked")


def test_a_tick_of_an_editor_is_shown_in_the_report_without_a_run(migrated: Migrated, browser: Any, tmp_path: Path) -> None:
    _, _, out = migrated("line_follower")
    listed = out / "line_follower" / "MIGRATION.md"
    before = listed.read_text()
    head, sign, rest = before.rpartition("- [ ] ")
    listed.write_text(f"{head}{sign.replace(' ]', 'x]')}{rest}")
    path = tmp_path / "report.html"
    assert run("report", out, "-o", path).code == 0
    browser.get(path.as_uri())
    boxes = browser.execute_script("return [...document.querySelectorAll('[data-tick]')].map(each => each.checked)")
    assert boxes.count(True) == 1
    assert "1 of " in browser.execute_script("return document.getElementById('works').textContent")


def test_of_two_tabs_the_later_one_is_told_and_loses_nothing(migrated: Migrated, serve: Serve) -> None:
    _, _, out = migrated("line_follower")
    page = serve(out)
    page.open()
    first = page.browser.current_window_handle
    page.browser.switch_to.new_window("tab")
    page.open()
    page.choose("port:leftQTI", "D4")
    second = page.browser.current_window_handle
    page.browser.switch_to.window(first)
    page.press("port:leftQTI", "D5")
    page.wait(lambda: "plan was changed elsewhere" in page.told())
    assert page.state() == "stale"
    shown = "return document.querySelector('[data-choice=\"port:leftQTI\"]').dataset.chosen"
    assert page.script(shown) == "D4"
    page.choose("port:leftQTI", "D5")
    assert page.script(shown) == "D5"
    page.browser.switch_to.window(second)
    page.browser.close()
    page.browser.switch_to.window(first)


def test_a_plan_that_is_changed_on_disk_is_said_without_a_click(migrated: Migrated, serve: Serve) -> None:
    _, _, out = migrated("line_follower")
    page = serve(out)
    page.open()
    choose(out, {"leftQTI": "D4"})
    page.wait(lambda: page.state() == "stale")
    undo(out)


def test_a_plan_that_is_gone_or_damaged_is_said_with_its_place(migrated: Migrated, serve: Serve) -> None:
    _, _, out = migrated("line_follower")
    page = serve(out)
    page.open()
    plan = out / "models" / "plan.xmi"
    text = plan.read_bytes()
    plan.unlink()
    page.wait(lambda: "plan is missing" in page.told())
    plan.write_bytes(text)
    page.wait(lambda: page.state() == "saved" and "matches this page again" in page.told())
    plan.write_text("<x")
    page.press("port:leftQTI", "D4")
    page.wait(lambda: page.state() == "refused")
    assert f"(in {plan}:1)" in page.told()
    assert "restore the file" in page.told()
    time.sleep(2.5)  # the page looks every two seconds
    assert page.state() == "refused", "what was refused stays in sight"
    plan.write_bytes(text)
    page.choose("port:leftQTI", "D4")


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A disk of three megabytes, in memory."""
    place = tmp_path / "disk"
    place.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=3m", "tmpfs", str(place)]
    if not shutil.which("mount") or subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("no small disk can be mounted here: that needs Linux, and its administrator")
    yield place
    subprocess.run(["umount", str(place)], check=True)


def test_a_full_disk_is_said_and_nothing_is_half_written(small_disk: Path, serve: Serve) -> None:
    robot = small_disk / "robot"
    robot.mkdir()
    (robot / "blink.c").write_text(BLINK)
    robosmi.migrate([robot / "blink.c"], robot / "out")
    page = serve(robot / "out")
    page.open()
    page.choose("port:eye", "D5")
    for kilobytes in (0, 4, 16):  # of which the first steps of a run find room, and the later ones do not
        free = os.statvfs(small_disk)
        (small_disk / "photos").write_bytes(b"x" * (free.f_bavail * free.f_frsize - 1024 * kilobytes))
        before = tree(robot)
        page.press("port:eye", "D7")
        page.wait(lambda: page.state() == "refused")
        assert "No space left on device" in page.told()
        assert str(robot / "out") in page.told()
        assert "the space on the disk" in page.told()
        assert tree(robot) == before
        (small_disk / "photos").unlink()
        page.choose("port:eye", "D7")
        page.choose("port:eye", "D5")


def test_a_killed_server_is_said_and_what_was_not_saved_too(migrated: Migrated, browser: Any) -> None:
    _, _, out = migrated("line_follower")
    process, url = opened(out)
    page = Served(browser, url, out)
    try:
        page.open()
        page.choose("port:leftQTI", "D4")
        port = url.split(":")[2].partition("/")[0]
        taken = run("open", out, "--port", port, "--no-browser")
        assert taken.code == 2
        assert f"port {port} cannot be used" in taken.err
    finally:
        process.kill()
        process.communicate()
    page.press("port:rightQTI", "D5")
    page.wait(lambda: page.state() == "offline" and "Not saved: port:rightQTI = D5" in page.told())
    choices = {c["id"]: c["chosen"] for c in choices_json(load_models(out / "models" / "plan.xmi").plan)}
    assert (choices["port:leftQTI"], choices["port:rightQTI"]) == ("D4", None)


def opened(out: Path) -> tuple[subprocess.Popen[str], str]:
    """A page that a process of its own serves, and its address, which it prints before it serves."""
    words = [sys.executable, "-m", "robosmi", "open", str(out), "--json", "--no-browser"]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    text = ""
    while not text.rstrip().endswith("}") or not _whole(text):
        text += process.stdout.readline()
    return process, str(json.loads(text)["result"]["url"])


def _whole(text: str) -> bool:
    try:
        json.loads(text)
    except ValueError:
        return False
    return True


def test_a_page_is_ready_in_half_a_second_and_a_choice_costs_less_than_one(migrated: Migrated, serve: Serve) -> None:
    _, _, out = migrated("environmental_monitoring")
    page = serve(out)
    ready, shown = [], []
    navigation = "const t = performance.getEntriesByType('navigation')[0]"
    page.open()
    page.browser.execute_cdp_cmd("Performance.enable", {"timeDomain": "threadTicks"})
    options = "return [...document.querySelectorAll('[data-choice=\"port:alarmLed\"] [data-option]')].map(e => e.dataset.option)"
    for value in page.script(options)[:3]:  # the best of three: the machine may do something else
        page.open()
        ready.append(page.script(f"{navigation}; return t.domInteractive - t.responseStart"))
        before = page.script("return document.body.dataset.plan")
        page.go("port:alarmLed", value)
        # The processor's time of the server and of the page's thread, not the clock's: one waits for the other.
        start = time.process_time() + task_seconds(page.browser)
        page.enter()
        page.wait_for_another(before)
        page.shown()
        shown.append(time.process_time() + task_seconds(page.browser) - start)
    assert min(ready) <= 500
    assert min(shown) <= 0.7


def test_texts_of_parts_and_paths_stay_text(tmp_path: Path, serve: Serve) -> None:
    folder = tmp_path / 'it\'s "quoted" <b>'
    folder.mkdir()
    (folder / "blink.c").write_text(BLINK)
    (folder / "parts.csv").write_text('pin;part\nD3;"<script>document.body.dataset.ill = 1</script> LED"\nD4;LED\n')
    robosmi.migrate([folder / "blink.c"], folder / "out", hardware=folder / "parts.csv", target="uno")
    page = serve(folder / "out")
    page.open()
    assert page.script("return document.body.dataset.ill") is None
    assert page.script("return document.querySelectorAll('main script, main b').length") == 0
    assert "<script>document.body.dataset.ill" in page.script("return document.body.textContent")
    (choice,) = [c for c in page.script("return [...document.querySelectorAll('[data-choice]')].map(c => c.dataset.choice)")
                 if c.startswith("port:")]  # fmt: skip
    page.choose(choice, "D9")
    assert page.script("return document.body.dataset.ill") is None


def test_many_findings_and_long_programs_scroll_without_a_long_task(migrated: Migrated, serve: Serve) -> None:
    sources, drawing, out = migrated("line_follower")
    sources[0].write_text(sources[0].read_text() + "\n" + "\n".join(f"int more{n} = {n};" for n in range(3000)) + "\n")
    robosmi.migrate(sources, out, hardware=drawing)
    models = load_models(out / "models" / "plan.xmi")
    models.plan.findings.extend(
        migration.PlanFinding(rule="RS999", severity=migration.SeverityLevel.warning, message=f"finding {n}") for n in range(5000)
    )
    for name, data in models.to_files().items():
        (out / "models" / name).write_bytes(data)
    page = serve(out)
    page.open()
    assert page.script("return document.querySelectorAll('.finding').length") >= 5000
    assert page.script("return document.querySelectorAll('.code > div').length") >= 6000
    # The processor's time of the page's thread, not the clock's: all tasks of a step together take no longer than one may.
    page.browser.execute_cdp_cmd("Performance.enable", {"timeDomain": "threadTicks"})
    taken = [task_seconds(page.browser)]
    for _ in range(50):
        page.browser.execute_async_script(STEP)
        taken.append(task_seconds(page.browser))
    page.browser.execute_cdp_cmd("Performance.disable", {})
    steps = [round(1000 * (after - before)) for before, after in pairwise(taken)]
    assert sum(steps) > 0
    assert max(steps[1:]) <= 50, steps  # the first one ends what loading has begun


@pytest.mark.parametrize(("scheme", "size"), sample(product(["light", "dark"], [(1280, 900), (360, 740)]), 1))
def test_axe_finds_nothing(scheme: str, size: tuple[int, int], migrated: Migrated, serve: Serve, tmp_path: Path) -> None:
    require_tools("axe-core")
    _, _, out = migrated("line_follower")
    page = serve(out)
    page.browser.set_window_size(*size)
    page.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
    try:
        page.open()
        page.choose("port:leftQTI", "D4")
        paper = "return getComputedStyle(document.body).backgroundColor"
        assert (page.script(paper) == "rgb(255, 255, 255)") == (scheme == "light")
        assert page.script("return document.documentElement.scrollWidth <= innerWidth")  # a phone need not scroll sideways
        page.script("window.scrollTo(0, 0)")  # axe calls small what the bar at the top covers, which scrolling uncovers
        found = violations(page.browser)
        assert run("report", out, "-o", tmp_path / "report.html").code == 0
        page.browser.get((tmp_path / "report.html").as_uri())
        found += violations(page.browser)
    finally:
        page.browser.set_window_size(1280, 900)
        page.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
    assert found == [], json.dumps(found, indent=1)


def violations(browser: Any) -> list[Any]:
    """What axe-core finds on the page that a browser shows: rule, its text, where."""
    browser.execute_script(AXE.read_text(encoding="utf-8"))
    tags = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"]
    found: Any = browser.execute_async_script("axe.run(document, { runOnly: arguments[0] }).then(arguments[1])", tags)
    assert len(found["passes"]) > 10
    return [(v["id"], v["help"], [n["html"][:120] for n in v["nodes"]][:3]) for v in found["violations"]]


def test_the_report_is_one_file_that_needs_no_server(migrated: Migrated, browser: Any, tmp_path: Path) -> None:
    _, _, out = migrated("line_follower")
    path = tmp_path / "report.html"
    outcome = run("report", out, "-o", path, "--json")
    assert outcome.code == 0, outcome.err
    browser.get(path.as_uri())
    assert browser.execute_script("return document.body.dataset.ready") == "true"
    headings = browser.execute_script("return [...document.querySelectorAll('section')].map(each => each.id)")
    assert headings == ["works", "wiring", "decide", "write", "check", "watch", "verdict", "code", "history"]
    loaded = browser.execute_script("return performance.getEntriesByType('resource').map(each => each.name)")
    assert [name for name in loaded if not name.startswith("data:")] == []
    assert browser.execute_script("return document.querySelectorAll('[data-option], [data-undo]').length") == 0


def test_a_role_is_a_choice_too(tmp_path: Path, serve: Serve) -> None:
    (tmp_path / "blink.c").write_text(
        '#include "simpletools.h"\nint eye = 3;\nint main() { while (1) { high(eye); pause(5); } }\n'
    )
    (tmp_path / "parts.csv").write_text("pin;part;title\nD3;Gizmo;thing\n")
    robosmi.migrate([tmp_path / "blink.c"], tmp_path / "out", hardware=tmp_path / "parts.csv", target="uno")
    page = serve(tmp_path / "out")
    page.open()
    (role,) = page.script("return [...document.querySelectorAll('[data-kind=role]')].map(each => each.dataset.choice)")
    page.choose(role, "Output")
    assert page.script("return document.querySelector('[data-kind=role]').dataset.chosen") == "Output"
    assert 'thing = "Output"' in (tmp_path / "robosmi.toml").read_text()
