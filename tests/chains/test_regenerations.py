"""Edits of ten kinds between regenerations: the short form of `tests.fuzz.edits`, and the judge of both."""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from msgspec.structs import replace

from robosmi.generate import three_way
from robosmi.generate.regions import Region
from robosmi.generate.three_way import Chunk
from tests.fuzz.edits import KINDS, Tally, regenerations, run
from tests.fuzz.edits_arenas import Pages
from tests.fuzz.edits_judge import Round, faults

BETWEEN = three_way._between

BASE = b"head\nvoid one() {\n  // TODO\n}\nvoid two() {\n  // TODO\n}\n"
EDITED = b"head\nvoid one() {\n  EDIT\n}\nvoid two() {\n  // TODO\n}\n"
MADE = b"new\nvoid one() {\n  // TODO\n}\nvoid two() {\n  // TODO\n}\n"
GOOD = b"new\nvoid one() {\n  EDIT\n}\nvoid two() {\n  // TODO\n}\n"
ONE = Round("o", BASE, EDITED, MADE, GOOD, {"RS512"})

REGIONS = b"""void one() {
// protected region r on begin
  // TODO
// protected region r end
}
void two() {
// protected region s on begin
  // TODO
// protected region s end
}
"""
IN_R = REGIONS.replace(b"// TODO", b"EDIT", 1)
SWAPPED = REGIONS.replace(b"region r", b"region q").replace(b"region s", b"region r").replace(b"region q", b"region s")
FOLLOWED = SWAPPED.replace(b"region r on begin\n  // TODO", b"region r on begin\n  EDIT")
INSIDE = Round("o", REGIONS, IN_R, SWAPPED, FOLLOWED, {"RS512"})
IN_THE_OTHER = SWAPPED.replace(b"region s on begin\n  // TODO", b"region s on begin\n  EDIT")
SWITCHED = REGIONS.replace(b"r on begin", b"r off begin")
SAME_HEADS = replace(
    ONE,
    base=BASE.replace(b"two", b"one"),
    edited=EDITED.replace(b"two", b"one"),
    made=MADE.replace(b"one", b"three").replace(b"two", b"one"),
    after=GOOD.replace(b"one", b"three").replace(b"two", b"one"),
)
BY_WORDS = Round(
    "o", b"port 'a' line 3\n", b"port 'a' line 3 // mine\n", b"port 'a' line 4\n", b"port 'a' line 4 // mine\n", {"RS512"}
)
"""A line in which a person and the run changed different words."""
OFF = replace(INSIDE, edited=SWITCHED, made=REGIONS, after=REGIONS, rules={"RS518"})


def test_no_edit_is_lost_in_regenerations() -> None:
    tally = run(24, seed=24, each=6)
    assert tally.wrong == []
    assert set(KINDS) <= set(tally.edits)
    assert {"kept", "RS511", "stopped"} <= set(tally.outcomes), "the runs reach too little"


@pytest.mark.parametrize(
    "good",
    [
        ONE,
        replace(ONE, edited=BASE, after=MADE, rules=set()),
        replace(ONE, edited=EDITED.replace(b"\n", b"\r\n"), after=GOOD.replace(b"\n", b"\r\n")),
        replace(ONE, edited=b"\xef\xbb\xbf" + EDITED[:-1], after=b"\xef\xbb\xbf" + GOOD[:-1]),
        replace(ONE, after=EDITED, rules={"RS516"}),
        replace(ONE, after=b"<<<<<<< yours\n" + GOOD, rules={"RS511"}, old=[EDITED]),
        replace(ONE, made=None, after=EDITED, rules={"RS514"}),
        replace(ONE, made=None, edited=BASE, after=None, rules=set()),
        replace(ONE, edited=None, after=MADE, rules={"RS517"}),
        INSIDE,
        OFF,
        SAME_HEADS,
        BY_WORDS,
        replace(ONE, edited=EDITED[:-1], after=b"<<<<<<< yours\n" + GOOD, rules={"RS511"}, old=[EDITED[:-1]]),
    ],
)
def test_the_judge_finds_no_fault_where_an_edit_is_kept_or_reported(good: Round) -> None:
    assert list(faults(good)) == []


@pytest.mark.parametrize(
    ("bad", "fault"),
    [
        (replace(ONE, after=MADE), "lost: '  EDIT'"),
        (replace(ONE, after=EDITED), "not made: 'new'"),
        (replace(ONE, after=None), "the file is gone"),
        (replace(ONE, edited=BASE.replace(b"void two() {\n", b""), after=MADE), "back: 'void two() {'"),
        (replace(ONE, after=GOOD.replace(b"  EDIT\n", b"").replace(b"two() {\n", b"two() {\n  EDIT\n")), "misplaced: '  EDIT'"),
        (replace(ONE, edited=EDITED.replace(b"\n", b"\r\n")), "line ends"),
        (replace(ONE, edited=EDITED.replace(b"{\n", b"{\r\n", 1), after=GOOD.replace(b"two() {\n", b"two() {\r\n")), "line end"),
        (replace(ONE, edited=b"\xef\xbb\xbf" + EDITED), "byte order mark"),
        (replace(ONE, edited=EDITED[:-1]), "last line break"),
        (replace(ONE, after=b"<<<<<<< yours\n" + GOOD), "not reported"),
        (replace(ONE, rules={"RS511"}), "no old file"),
        (replace(ONE, rules={"RS511"}, old=[BASE]), "no old file"),
        (replace(ONE, rules={"RS516"}), "was changed"),
        (replace(ONE, made=None, after=None), "no longer made"),
        (replace(ONE, made=None, after=EDITED, rules=set()), "no longer made"),
        (replace(ONE, edited=None, after=MADE, rules=set()), "without a word"),
        (replace(INSIDE, after=IN_THE_OTHER), "misplaced: '  EDIT'"),
        (replace(INSIDE, after=SWAPPED), "lost: '  EDIT'"),
        (replace(BY_WORDS, after=b"port 'a' line 4\n"), "lost: "),
        (replace(BY_WORDS, after=b"port 'a' line 5\n"), "lost: "),
        (replace(BY_WORDS, after=b"port 'a' line 3 // mine\n"), "not made: "),
        (replace(BY_WORDS, after=b"port 'a' line 5 // mine\n"), "not made: "),
        (replace(OFF, rules=set()), "lost: '// protected region r off begin'"),
        (replace(OFF, edited=IN_R.replace(b"r on begin", b"r off begin")), "lost: '  EDIT'"),
        (replace(OFF, edited=SWITCHED.replace(b"r end", b"r end EDIT")), "lost: '// protected region r end EDIT'"),
        (replace(OFF, after=REGIONS.replace(b"region r", b"region q")), "lost: '// protected region r off begin'"),
    ],
)  # fmt: skip
def test_the_judge_finds_what_is_lost(bad: Round, fault: str) -> None:
    assert [found for found in faults(bad) if fault in found]


def _generated_wins(*texts: Any) -> list[Chunk]:
    """A wrong merge: the generated text wins wherever the two differ."""
    return [replace(chunk, kind="both" if chunk.kind == "both" else "theirs") for chunk in BETWEEN(*texts)]


def _region_made_anew(self: object, piece: str | Region, old: object, before: object) -> str | Region:
    """A wrong merge: every region gets the template's text."""
    return piece


def _orphans_dropped(self: object, lines: list[Any], orphans: object) -> str:
    """A wrong merge: regions that are no longer generated are dropped."""
    return "".join(line.text for line in lines)


def _line_feeds(self: object, text: str) -> bytes:
    """A wrong merge: the file's line ends are lost."""
    return text.encode(errors="surrogateescape")


@pytest.mark.parametrize(
    ("place", "broken"),
    [
        ("robosmi.generate.three_way._between", _generated_wins),
        ("robosmi.generate.merge_edits._Merge._their", _region_made_anew),
        ("robosmi.generate.merge_edits._Merge._with_orphans", _orphans_dropped),
        ("robosmi.generate.text_form.FileText.written", _line_feeds),
    ],
)
def test_the_judge_notices_a_broken_merge(
    place: str, broken: Callable[..., object], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(place, broken)
    tally, chance = Tally(), random.Random(3)
    for number in range(6):
        regenerations(Pages(tmp_path, chance), tmp_path / str(number), chance, 10, tally)
    assert tally.wrong
