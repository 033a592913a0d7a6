"""The page's first screen, its circuit and its questions in a real browser; what is on purpose is in the project file."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.project import load_project
from robosmi.transformations.chains.page import PlanPage
from tests.page.browsers import Served
from tests.running import run

PROGRAM = """#include "simpletools.h"
int main()
{
  int eye;
  while (1) {
    eye = input(7);       // the right eye
    if (eye == 0)
      high(3);            // too near: lamp on
    else
      low(3);
    pause(20);
  }
}
"""
PARTS = "pin;part;title;connector\nD5;LED;near lamp;anode\nD6;LED;far lamp;anode\nD7;Basic Servo;arm;pulse\n"
Serve = Callable[[Path], Served]


@pytest.fixture
def out(tmp_path: Path) -> Path:
    """A migration with two open questions and lamps without resistors."""
    (tmp_path / "eye.c").write_text(PROGRAM)
    (tmp_path / "parts.csv").write_text(PARTS)
    robosmi.migrate([tmp_path / "eye.c"], tmp_path / "out", hardware=tmp_path / "parts.csv", target="uno")
    return tmp_path / "out"


def shown(page: Served, selector: str) -> list[str]:
    """The texts of the elements that are displayed."""
    return list(
        page.script(
            "return [...document.querySelectorAll(arguments[0])].filter(e => e.checkVisibility()).map(e => e.textContent)",
            selector,
        )
    )


def test_the_first_screen_has_the_result_and_the_circuit(migrated: Any, serve: Serve) -> None:
    _, _, out = migrated("line_follower")
    page = serve(out)
    page.browser.set_window_size(1300, 800)
    try:
        page.open()
        for name in ("result", "circuit"):
            top, bottom = page.script(
                "const r = document.getElementById(arguments[0]).getBoundingClientRect(); return [r.top, r.bottom]", name
            )
            assert 0 <= top < page.script("return innerHeight") - 100, name
            assert bottom > top
        height = "return document.documentElement.scrollHeight"  # with four open questions
        assert page.script(height) <= 5 * 800
        page.browser.set_window_size(390, 844)
        assert page.script(height) <= 6 * 844
        tops = "return ['result', 'circuit', 'works'].map(each => document.getElementById(each).getBoundingClientRect().top)"
        order = page.script(tops)
        assert order == sorted(order)
        dark = {"features": [{"name": "prefers-color-scheme", "value": "dark"}]}
        page.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", dark)
        assert "invert" in page.script("return getComputedStyle(document.querySelector('#circuit svg')).filter")
    finally:
        page.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})
        page.browser.set_window_size(1280, 900)
    assert page.script("return document.getElementById('result').dataset.result") == "needs-you"
    assert "4 choices" in shown(page, "#result")[0]
    assert page.script("return document.querySelectorAll('#circuit svg [data-component]').length") >= 6
    assert "open loop" in shown(page, "#works")[0]


def test_a_wire_shows_its_port_its_lines_and_its_findings(migrated: Any, serve: Serve) -> None:
    _, _, out = migrated("line_follower")
    page = serve(out)
    page.open()
    click = "document.querySelector('#circuit .wire[data-pin=D12]').dispatchEvent(new MouseEvent('click', {bubbles: true}))"
    page.script(click)
    (facts,) = shown(page, "[data-wire]")
    assert "LED" in facts
    assert "8: const int LED = 8;" in facts
    assert page.script("return document.querySelectorAll('#circuit .wire.picked').length") > 0
    assert page.script("return document.getElementById('wire').value") == "D12"
    page.script(
        "const s = document.getElementById('wire'); s.value = 'D10'; s.dispatchEvent(new Event('change', {bubbles: true}))"
    )
    (facts,) = shown(page, "[data-wire]")
    assert "RS240" in facts


def test_a_question_highlights_its_wire(migrated: Any, serve: Serve) -> None:
    _, _, out = migrated("line_follower")
    page = serve(out)
    page.open()
    page.go("port:abdrive.left_servo", "BasicServo2WriteP1")
    picked = "return [...new Set([...document.querySelectorAll('#circuit .wire.picked')].map(e => e.dataset.pin))]"
    assert page.script(picked) == ["D8"]
    page.go("port:abdrive.left_servo", "BasicServo1WriteP1")
    assert page.script(picked) == ["D9"]


def test_questions_name_parts_and_show_three_lines(out: Path, serve: Serve) -> None:
    page = serve(out)
    page.open()
    options = "[...document.querySelectorAll('[data-choice=\"port:P3\"] [data-option]')]"
    named = page.script(f"return Object.fromEntries({options}.map(e => [e.dataset.option, e.textContent]))")
    assert "near lamp (D5)" in named.values()
    assert named["none"] == "Not connected"
    lines = page.script("return document.querySelector('[data-choice=\"port:P3\"] .context').textContent").splitlines()
    assert [line.partition(":")[0] for line in lines if line.strip()] == ["7", "8", "9"]
    assert page.script("return document.querySelector('[data-choice=\"port:P3\"] .context mark').textContent").startswith("8:")


def test_a_part_with_200_pins_has_short_options(out: Path) -> None:
    rows = (f"D{n % 12 + 2};Big chip;monster;pin {n}" for n in range(200))
    (out.parent / "parts.csv").write_text("\n".join(["pin;part;title;connector", *rows]))
    robosmi.migrate([out.parent / "eye.c"], out.parent / "wide", hardware=out.parent / "parts.csv", target="uno")
    page = PlanPage(out.parent / "wide")
    page.document(live=True, nonce="n")
    labels = [rest.partition("</button>")[0] for rest in page.sections["decide"].split("<button")[1:]]
    (option,) = {label.rpartition(">")[2] for label in labels if label.endswith("(D2)")}
    assert option.startswith("monster pin 0, pin 12")
    assert option.endswith("more (D2)")
    assert len(option) < 60


def test_many_open_questions_fold_their_sources_and_no_option(out: Path) -> None:
    (out.parent / "many.c").write_text(PROGRAM.replace("int eye;", "".join(f"high({n}); " for n in range(9, 15))))
    robosmi.migrate([out.parent / "many.c"], out.parent / "many", hardware=out.parent / "parts.csv", target="uno")
    page = PlanPage(out.parent / "many")
    page.document(live=True, nonce="n")
    decide = page.sections["decide"]
    folded = re.findall(r'<details class="source">.*?</details>', decide, re.DOTALL)
    assert len(folded) == decide.count('class="choice open"') - 1 >= 5  # the first shows its three lines
    assert not any("data-option" in each for each in folded)
    assert all("<pre" in each for each in folded)


def test_the_next_open_question_is_one_key_away_and_the_progress_counts(out: Path, serve: Serve) -> None:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys

    page = serve(out)
    page.open()
    opened = page.open_choices()
    assert len(opened) >= 2
    heading = page.script("return document.getElementById('decide-title').textContent")
    total = page.script("return document.querySelectorAll('[data-choice]').length")
    assert heading == f"Decide: {total - len(opened)} of {total}"
    for expected in (*opened, opened[0]):
        ActionChains(page.browser).key_down(Keys.ALT).send_keys("n").key_up(Keys.ALT).perform()
        assert page.script("return document.activeElement.closest('[data-choice]').dataset.choice") == expected
        assert page.script("return 'option' in document.activeElement.dataset")
    for identity in opened:
        page.choose(identity, page.offered(identity)[-1])
    assert "robosmi verify" in page.told(), "the last choice offers the next step"
    page.open()
    assert "No open question" not in page.told()
    ActionChains(page.browser).key_down(Keys.ALT).send_keys("n").key_up(Keys.ALT).perform()
    assert "No open question" in page.told()


def test_what_is_decided_is_folded_to_a_line_and_can_be_changed(out: Path, serve: Serve) -> None:
    page = serve(out)
    page.open()
    (first, *_) = page.open_choices()
    values = page.offered(first)
    page.choose(first, values[0])
    folded = f"return document.querySelector('details[data-choice=\"{first}\"]').open"
    assert page.script(folded) is True, "what was just decided is in sight"
    page.open()
    assert page.script(folded) is False
    assert page.script(f"return document.querySelector('[data-choice=\"{first}\"]').dataset.chosen") == values[0]
    page.choose(first, values[-1])
    assert page.script(f"return document.querySelector('[data-choice=\"{first}\"]').dataset.chosen") == values[-1]


REASON = 'it has a "divider" inside'


def test_a_finding_is_on_purpose_with_a_reason_until_it_is_taken_back(migrated: Any, serve: Serve) -> None:
    (source, *_), _, out = migrated("line_follower")
    page = serve(out)
    page.open()
    button = "document.querySelector('[data-accept=RS240]')"
    element = page.script(f"return {button}.dataset.element")
    page.script(f"{button}.click()")
    page.script("document.querySelector('form.accept input').value = arguments[0]", REASON)
    page.script("document.querySelector('form.accept button').click()")
    page.wait(lambda: "on purpose" in page.told())
    assert page.state() == "saved", page.told()
    (entry,) = load_project(source.parent).accept
    assert (entry.rule, entry.element, entry.reason) == ("RS240", element, REASON)
    found = run("wiring", out, "--as", "csv", "-o", source.parent / "w.csv", "--json").document["findings"]
    assert [f for f in found if f["rule"] == "RS911"] == []
    page.open()
    assert any(REASON in text for text in shown(page, "#check .finding"))
    page.script("document.querySelector('[data-accept][data-reason]').click()")
    page.wait(lambda: "no longer" in page.told())
    assert not load_project(source.parent).accept


@pytest.mark.parametrize(
    "about",
    [
        {},
        {"rule": "RS999", "element": "*", "reason": "x"},
        {"rule": "RS240", "element": "no such part", "reason": "x"},
        {"rule": "RS240", "element": "HIH4030 1", "reason": "x" * 301},
    ],
)
def test_only_findings_of_the_page_are_accepted(about: dict[str, str], migrated: Any) -> None:
    (source, *_), _, out = migrated("line_follower")
    page = PlanPage(out)
    page.document(live=True, nonce="n")
    answer = page.act("accept", {**about, "plan": page.now()})
    assert answer["state"] == "refused"
    assert not (source.parent / "robosmi.toml").exists()


def test_a_finding_about_one_port_is_accepted_for_that_port(out: Path) -> None:
    robosmi.migrate([out.parent / "eye.c"], out, hardware=out.parent / "parts.csv", target="uno", bind={"P3": "A1", "P7": "A2"})
    page = PlanPage(out)
    page.document(live=True, nonce="n")
    assert {element for rule, element in page.acceptable if rule == "RS262"} == {"P3", "P7"}
    about = {"rule": "RS262", "element": "P3", "reason": "a test lead", "plan": page.now()}
    assert page.act("accept", about)["state"] == "saved"
    assert load_project(out.parent).accept[0].element == "P3"
    assert {element for rule, element in page.acceptable if rule == "RS262"} == {"P3", "P7"}
    assert "No longer on purpose" in page.sections["check"]
    assert page.sections["check"].count('data-accept="RS262"') - page.sections["check"].count("data-reason") == 1
    table = out.parent / "w.csv"
    for command in (("check", out), ("check", out / "models" / "plan.xmi"), ("wiring", out, "--as", "csv", "-o", table)):
        found = run(*command, "--json").document["findings"]
        assert [f for f in found if f["rule"] == "RS911"] == []
        levels = [f["severity"] for f in found if f["rule"] == "RS262"]
        assert levels in (["info", "warning"], ["warning", "info"], []), command
        assert levels or command[0] == "wiring"


def test_a_finding_about_one_line_is_accepted_for_that_line(tmp_path: Path) -> None:
    (tmp_path / "two.c").write_text(PROGRAM.replace("int eye;", "int eye;\n  horn(1);\n  bell(2);"))
    robosmi.migrate([tmp_path / "two.c"], tmp_path / "out", target="uno")
    page = PlanPage(tmp_path / "out")
    page.document(live=True, nonce="n")
    assert {element for rule, element in page.acceptable if rule == "RS109"} == {"two.c:5", "two.c:6"}
    about = {"rule": "RS109", "element": "two.c:6", "reason": "it is mine", "plan": page.now()}
    assert page.act("accept", about)["state"] == "saved"
    found = run("migrate", tmp_path / "two.c", "--target", "uno", "-o", tmp_path / "out", "--json").document["findings"]
    assert [f["severity"] for f in found if f["rule"] == "RS109" and f["location"]["line"] == 5] == ["warning"]
    assert [f["severity"] for f in found if f["rule"] == "RS109" and f["location"]["line"] == 6] == ["info"]


def test_undo_takes_an_accepted_finding_back(migrated: Any) -> None:
    (source, *_), _, out = migrated("line_follower")
    page = PlanPage(out)
    page.document(live=True, nonce="n")
    rule, element = min(page.acceptable)
    assert page.act("accept", {"rule": rule, "element": element, "reason": "tiny", "plan": page.now()})["state"] == "saved"
    assert load_project(source.parent).accept
    undone = page.act("undo", {"plan": page.now()})
    assert undone["state"] == "saved"
    assert f"on purpose: {rule} of {element}" in undone["message"]
    again = page.act("undo", {"plan": page.now()})
    assert again["state"] == "refused", "what made the migration stays"
    assert "nothing was restored" in again["message"]
    assert not load_project(source.parent).accept


def test_a_damaged_project_file_is_a_finding_and_the_page_stays(out: Path) -> None:
    (out.parent / "robosmi.toml").write_text("[bind\n")
    text = PlanPage(out).document(live=True, nonce="n")
    assert "RS902" in text
    assert 'data-choice="port:P3"' in text


def test_the_printed_page_has_no_rejected_options(out: Path, serve: Serve) -> None:
    page = serve(out)
    page.open()
    page.choose("port:P3", "none")
    page.script("for (const each of document.querySelectorAll('details')) each.open = true")
    page.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    try:
        assert shown(page, ".choice.made .rejected") == []
        assert shown(page, "[data-choice='port:P3'] [data-option]") == ["Not connected"]
        assert len(shown(page, ".choice.open [data-option]")) > 2
    finally:
        page.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
