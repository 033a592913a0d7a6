"""Damaged drawings of Wokwi, EAGLE and KiCad, through the command line and all that follows the readers.

Each is refused with place, cause and what to do, or read with what is sound in it: never with a wrong pin, never with a trace.
`python -m tests.fuzz.drawings` tries many more; a small share of it is here.
"""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from robosmi.errors import SourceError
from robosmi.transformations.chains.hardware import hardware
from tests.fuzz.drawings import DRAWINGS, beside, cut, damaged, read_through, sources
from tests.running import run
from tests.transformations.t2m.fritzing.support import FIXTURES
from tests.transformations.t2m.kicad import support as kicad

UNO = '{"type": "wokwi-arduino-uno", "id": "uno"}'


def wokwi(parts: str, wires: str) -> str:
    """A diagram of an Arduino Uno and further parts."""
    return f'{{"version": 1, "editor": "wokwi", "parts": [{UNO}, {parts}], "connections": [{wires}]}}'


@pytest.mark.parametrize("path", sources([]), ids=lambda path: f"{path.parent.name}-{path.name}")
def test_a_drawing_cut_off_anywhere_gives_no_wrong_pin(path: Path, tmp_path: Path) -> None:
    copy = beside(path, tmp_path)
    whole = read_through(copy)
    assert whole
    for length, _ in cut(copy, max(1, copy.stat().st_size // 25), tmp_path):
        found = read_through(copy)
        assert found is None or found <= whole, length


def test_a_share_of_the_damaged_drawings(tmp_path: Path) -> None:
    chance, found = random.Random(7), sources([])
    for _ in range(60):
        path = chance.choice(found)
        copy = beside(path, tmp_path)
        copy.write_bytes(damaged(path.read_bytes(), chance.choice(found).read_bytes(), chance))
        read_through(copy)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be", "utf-32"])
@pytest.mark.parametrize("path", sources([])[::3], ids=lambda path: f"{path.parent.name}-{path.name}")
def test_another_encoding_is_named(path: Path, encoding: str, tmp_path: Path) -> None:
    copy = beside(path, tmp_path)
    copy.write_bytes(path.read_text(encoding="utf-8").encode(encoding))
    outcome = run("hardware", copy)
    assert outcome.code in (0, 3), outcome.err
    if outcome.code == 3:
        assert "UTF-" in outcome.err, outcome.err
        assert "\n  do: " in outcome.err
    else:
        assert read_through(copy) == read_through(path)


@pytest.mark.parametrize("path", sources([]), ids=lambda path: f"{path.parent.name}-{path.name}")
def test_a_byte_order_mark_changes_nothing(path: Path, tmp_path: Path) -> None:
    copy = beside(path, tmp_path)
    copy.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())
    assert read_through(copy) == read_through(path)


@pytest.mark.parametrize(
    ("parts", "wires", "mapped"),
    [
        ('{"type": "wokwi-led", "id": 5}', '["uno:13", "5:A", "", []]', {("D13", "5")}),
        ('{"type": "wokwi-led", "id": 5}, {"type": "wokwi-led", "id": "5"}', '["uno:13", "5:A", "", []]', set()),
        ('{"type": "wokwi-led", "id": "l", "top": NaN, "attrs": {"value": NaN}}', '["uno:13", "l:A", "", []]', {("D13", "l")}),
        ('{"type": "wokwi-led", "id": NaN}', '["uno:13", "nan:A", "", []]', {("D13", "nan")}),
        ('{"type": "wokwi-led", "id": null}', '["uno:13", ":A", "", []]', set()),
        ('{"type": ["wokwi-led"], "id": {}}', '["uno:13", {}, "", []]', set()),
        ('{"type": "wokwi-led", "id": "l"}', '["uno:13", 5], ["uno:12", "l:7"], ["uno:11", "l"], [[], []]', set()),
    ],
)
def test_numbers_and_other_values_where_texts_belong(
    parts: str, wires: str, mapped: set[tuple[str, str]], tmp_path: Path
) -> None:
    path = tmp_path / "diagram.json"
    path.write_text(wokwi(parts, wires))
    assert read_through(path) == frozenset(mapped)


@pytest.mark.parametrize("name", ["\\ud800", "a\\u0000b", "\\u202e\\u200f", "x" * 3000, "]]>", "<&\\\"'"])
def test_odd_names_are_stored_drawn_and_printed(name: str, tmp_path: Path) -> None:
    path = tmp_path / "diagram.json"
    path.write_text(wokwi(f'{{"type": "wokwi-led", "id": "{name}"}}', f'["uno:13", "{name}:A", "{name}", []]'))
    for words in ((), ("--json",)):
        outcome = run("hardware", path, "-o", tmp_path / "a.xmi", "--svg", tmp_path / "a.svg", *words)
        assert outcome.code in (0, 1, 3), outcome.err
        assert "Traceback" not in outcome.err
        assert outcome.code != 3 or "\n  do: " in outcome.err


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("diagram.json", '{"editor": "wokwi", "parts": ' + "[" * 10_000),
        ("diagram.json", wokwi('{"type": "wokwi-led", "id": "a", "attrs": ' + '{"a":' * 10_000, "")),
        ("a.sch", "<eagle><drawing><schematic>" + "<sheets>" * 10_000 + "</sheets>" * 10_000 + "</schematic></drawing></eagle>"),
        ("a.kicad_sch", "(kicad_sch (version 20230121) " + "(a " * 10_000 + ")" * 10_000 + ")"),
        ("a.net", "(export (version D) " + "(a " * 10_000 + ")" * 10_000 + ")"),
    ],
)
def test_ten_thousand_levels_are_refused(name: str, text: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    assert read_through(tmp_path / name) is None


@pytest.mark.parametrize("name", ["xxe", "billion"])
@pytest.mark.parametrize(
    ("source", "begins", "one"),
    [(DRAWINGS / "eagle" / "robot.sch", "<eagle", "part"), (FIXTURES / "blocked_passive.fz", "<module", "instance")],
)
def test_external_and_growing_entities_are_refused(source: Path, begins: str, one: str, name: str, tmp_path: Path) -> None:
    entities = {
        "xxe": '<!ENTITY a SYSTEM "file:///etc/hostname">',
        "billion": "".join(f'<!ENTITY a{n} "{f"&a{n - 1};" * 10}">' for n in range(1, 12))
        + '<!ENTITY a "&a11;"><!ENTITY a0 "x">',
    }
    text = source.read_text(encoding="utf-8")
    path = tmp_path / f"a{source.suffix}"
    body = text[text.index(begins) :].replace(f"<{one} ", f'<{one} note="&a;" ', 1)
    path.write_text(f'<?xml version="1.0"?>\n<!DOCTYPE {begins[1:]} [{entities[name]}]>\n{body}')
    with pytest.raises(SourceError) as refused:
        hardware(path)
    assert refused.value.fix


def test_a_hundred_thousand_parts_are_refused(tmp_path: Path) -> None:
    led = '{"type":"wokwi-led","id":"a%d"}'
    (tmp_path / "diagram.json").write_text(wokwi(",".join(led % n for n in range(100_000)), ""))
    parts = "".join(f'<part name="R{n}" library="l" deviceset="R" device=""/>' for n in range(100_000))
    (tmp_path / "a.sch").write_text(
        f"<eagle version='9'><drawing><schematic><parts>{parts}</parts></schematic></drawing></eagle>"
    )
    listed = "".join(f'(comp (ref "R{n}") (value "1k"))' for n in range(100_000))
    (tmp_path / "a.net").write_text(f'(export (version "D") (components {listed}) (nets))')
    for name in ("diagram.json", "a.sch", "a.net"):
        assert read_through(tmp_path / name) is None


def test_sheets_that_draw_each_other_are_refused(tmp_path: Path) -> None:
    kicad.schematic(tmp_path / "b.kicad_sch", kicad.below("c", "c.kicad_sch"))
    kicad.schematic(tmp_path / "c.kicad_sch", kicad.below("b", "b.kicad_sch"))
    assert read_through(kicad.schematic(tmp_path / "a.kicad_sch", kicad.uno(), kicad.below("b", "b.kicad_sch"))) is None


def test_a_board_that_nobody_knows_is_no_board(tmp_path: Path) -> None:
    path = tmp_path / "diagram.json"
    path.write_text(wokwi('{"type": "wokwi-led", "id": "l"}', '["uno:13", "l:A", "", []]').replace("arduino-uno", "arduino-xyz"))
    outcome = run("hardware", path)
    assert outcome.code == 3
    assert "no board" in outcome.err
    assert "do: " in outcome.err
