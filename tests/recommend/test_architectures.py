"""On which processors a library works: what it lists, what the core brings, what replaces it; and the ranking by that."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from robosmi.errors import PlatformDataError
from robosmi.recommend.architectures import ArchitectureFacts, LibrarySubstitute, Support
from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.index import Library
from robosmi.recommend.ranking import Candidate
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.knowledge.libraries.library_ranking import (
    architecture_facts,
    device_ranker,
    library_by_name,
    library_index,
    unsuitable,
)
from robosmi.transformations.knowledge.platforms.target_platform import target_names

FACTS = ArchitectureFacts({"rp2040": frozenset({"Servo"})}, {"esp32": {"Servo": LibrarySubstitute("ESP32Servo", "why")}}, "avr")
SERVO = ComponentQuery("1", "Basic Servo", family="Servo")


def library(*architectures: str, name: str = "A") -> Library:
    return Library(1, name, architectures=architectures)


def candidates(query: ComponentQuery, architecture: str) -> Mapping[str, Candidate]:
    answer = device_ranker("arduino", architecture=architecture).rank(query, limit=40)
    return {candidate.library: candidate for candidate in answer.candidates}


@pytest.mark.parametrize(
    ("known", "architecture", "support"),
    [
        (library("avr"), "avr", Support.listed),
        (library("avr"), "rp2040", Support.absent),
        (library("*"), "rp2040", Support.probable),
        (library(), "rp2040", Support.probable),
        (library("mbed_rp2040"), "rp2040", Support.absent),  # one processor, two cores
        (library("rp2040"), "mbed_rp2040", Support.absent),
        (library("avr", name="Servo"), "rp2040", Support.listed),  # the core brings its own
        (library("avr", "samd", name="Servo"), "esp32", Support.absent),
        (library("*", name="Servo"), "esp32", Support.absent),
        (library("avr"), None, Support.probable),
    ],
)
def test_what_a_library_lists_and_what_is_known_of_it(known: Library, architecture: str | None, support: Support) -> None:
    assert FACTS.support(known, architecture) is support
    assert bool(FACTS.objection(known, architecture)) == (support is Support.absent)


def test_a_library_for_all_probably_works_where_it_was_not_written_for() -> None:
    assert "probably" in FACTS.remark(library("*"), "esp32")
    assert FACTS.remark(library("*"), "avr") == FACTS.remark(library("esp32"), "esp32") == ""


@pytest.mark.parametrize(
    ("architecture", "first"),
    [
        ("avr", "Servo"),
        ("rp2040", "Servo"),
        ("esp32", "ESP32Servo"),
        ("samd", "Servo"),
        ("renesas_uno", "Servo"),
        ("teensy", "Servo"),
    ],
)
def test_a_servo_gets_the_library_that_works_on_the_target(architecture: str, first: str) -> None:
    assert next(iter(candidates(SERVO, architecture))) == first


def test_a_candidate_that_cannot_work_says_what_to_use() -> None:
    found = candidates(SERVO, "esp32")
    assert any("use ESP32Servo" in reason for reason in found["Servo"].reasons)
    assert found["Servo"].score < found["ESP32Servo"].score
    assert not any("use " in reason for reason in candidates(SERVO, "avr")["Servo"].reasons)


def test_no_rule_chooses_a_library_that_cannot_work(monkeypatch: pytest.MonkeyPatch) -> None:
    ranker = device_ranker("arduino", architecture="rp2040")
    sure = ranker.rank(SERVO)
    assert sure.decision == "library"
    assert sure.confidence >= 0.8
    monkeypatch.setattr(ranker, "_suits", lambda _: False)
    assert ranker.rank(SERVO).confidence <= 0.5


def test_every_library_of_the_facts_is_one_of_the_index_and_works_where_it_is_proposed() -> None:
    facts, names = architecture_facts("arduino"), {*library_index("arduino").names()}
    assert {library for libraries in facts.brings.values() for library in libraries} <= names
    for architecture, replaced in facts.instead.items():
        for name, instead in replaced.items():
            assert name in names
            assert facts.support(library_by_name(instead.library).library, architecture) is not Support.absent, (
                architecture,
                name,
            )


def test_the_architectures_of_the_facts_are_those_of_targets() -> None:
    boards = [name for name in target_names() if name != "avr-c"]
    chips = {str(chip.architecture) for name in boards if (chip := load_board(name).microcontroller) is not None}
    facts = architecture_facts("arduino")
    assert {*facts.brings, *facts.instead, facts.home} - {"mbed_rp2040"} <= chips


def test_a_library_may_be_asked_for_by_name() -> None:
    assert unsuitable("Servo", "arduino", "rp2040") == unsuitable("DHT sensor library", "arduino", "rp2040") == ""
    assert "ESP32Servo" in unsuitable("Servo", "arduino", "esp32")
    assert "avr" in unsuitable("PinChangeInterrupt", "arduino", "rp2040")
    assert unsuitable("no such library", "arduino", "rp2040")
    assert unsuitable("Servo", "", "avr")


@pytest.mark.parametrize(
    "text",
    [
        'hom = "avr"',
        '[[brings]]\nlibraries = ["A"]\nsource = "s"',
        '[[brings]]\narchitectures = ["x"]\nlibraries = ["A"]',
        '[[instead]]\narchitectures = ["x"]\nlibrary = "A"\nuse = "B"\nsource = "s"\nwhy = 1',
        '[[instead]]\narchitectures = ["x"]\nlibrary = "A"\nuses = "B"\nsource = "s"\nwhy = "w"',
    ],
)
def test_a_damaged_file_is_told(text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "platform_repo" / "arduino" / "libraries"
    folder.mkdir(parents=True)
    (folder / "architectures.toml").write_text(text)
    monkeypatch.setenv("ROBOSMI_PATH", str(tmp_path))
    with pytest.raises(PlatformDataError) as refused:
        architecture_facts("arduino")
    assert refused.value.location is not None
    assert refused.value.location.path == str(folder / "architectures.toml")
