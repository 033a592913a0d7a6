"""The paper's ranker on the tiny index: order, ties, history, reasons, the contract's JSON form."""

from __future__ import annotations

import pytest

from robosmi.errors import UsageError
from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.history import History
from robosmi.recommend.index import LibraryIndex
from robosmi.recommend.ranking import Ranker, Recommendation, utility
from robosmi.recommend.tfidf_ranker import TfidfRanker

SERVO = ComponentQuery("7", "Basic Servo", part_id="servo-1")


def _names(answer: Recommendation) -> list[str]:
    return [candidate.library for candidate in answer.candidates]


def test_best_header_scores_but_the_main_one_is_included(tiny: LibraryIndex) -> None:
    ranker: Ranker = TfidfRanker(tiny)
    answer = ranker.rank(SERVO)
    assert _names(answer) == ["Servo", "Motor Kit"]
    assert [candidate.header for candidate in answer.candidates] == ["Servo.h", "MotorKit.h"]
    assert "in inner.h" in answer.candidates[1].reasons[0]
    assert answer.candidates[0].score == 1.0


def test_json_form(tiny: LibraryIndex) -> None:
    document = TfidfRanker(tiny).rank(SERVO, limit=1).to_json()
    assert document == {
        "id": "7",
        "decision": "library",
        "confidence": 0.0,
        "reasons": [],
        "candidates": [
            {
                "library": "Servo",
                "header": "Servo.h",
                "version": "2.1",
                "score": 1.0,
                "reasons": [
                    "'servo' of the title occurs 300 times in Servo.h, in 2 of 7 headers: (1 + ln 300) x ln(7/2) = 8.40",
                    "'basic' of the title occurs 1 time in Servo.h, in 1 of 7 headers: (1 + ln 1) x ln(7/1) = 1.95",
                    "TF-IDF 10.34 in Servo.h, 100% of the best",
                ],
            }
        ],
    }


@pytest.mark.parametrize("title", ["board", "nonsense", ""])
def test_nothing_scores(tiny: LibraryIndex, title: str) -> None:
    assert TfidfRanker(tiny).rank(ComponentQuery("1", title)) == Recommendation("1", "none", 0.0, ())


def test_ties_named_then_popular_then_by_name(tiny: LibraryIndex) -> None:
    answer = TfidfRanker(tiny).rank(ComponentQuery("1", "twin"))
    assert len({candidate.score for candidate in answer.candidates}) == 1
    assert _names(answer) == ["Base", "Twins", "Base Sensor"]
    assert answer.candidates[0].header == "Base.h", "of two equal headers the one named like the library"


def test_architecture_is_a_remark_not_a_filter(tiny: LibraryIndex) -> None:
    remark = "does not list the architecture avr (it lists esp32)"
    servo, kit = TfidfRanker(tiny, "avr").rank(SERVO).candidates
    assert remark in kit.reasons
    assert not any("architecture" in reason for reason in servo.reasons)
    assert not any("architecture" in reason for reason in TfidfRanker(tiny).rank(SERVO).candidates[1].reasons)
    unknown = TfidfRanker(tiny, "avr").rank(ComponentQuery("1", "pair")).candidates[0]
    assert not any("architecture" in reason for reason in unknown.reasons), "a library without metadata says nothing"


def test_what_was_chosen_goes_first(tiny: LibraryIndex, history: History) -> None:
    ranker = TfidfRanker(tiny)
    history.record("servo-1", "Basic Servo", "Motor Kit")
    answer = ranker.rank(SERVO, history)
    assert _names(answer) == ["Motor Kit", "Servo"]
    assert answer.candidates[0].reasons[0] == "chosen 1 time before for this part"
    history.record("servo-1", "Basic Servo", "Base")
    history.record("servo-1", "Basic Servo", "Base")
    assert _names(ranker.rank(SERVO, history)) == ["Base", "Motor Kit", "Servo"], "though Base has no word of the title"
    assert _names(ranker.rank(ComponentQuery("1", "Basic Servo", part_id="another"), history)) == ["Servo", "Motor Kit"]


def test_chosen_but_not_in_the_index(tiny: LibraryIndex, history: History) -> None:
    history.record("p", "Thing", "My Own")
    answer = TfidfRanker(tiny).rank(ComponentQuery("1", "Thing", part_id="p"), history)
    assert answer.decision == "library"
    assert answer.candidates[0].to_json() == {
        "library": "My Own",
        "header": "",
        "version": "",
        "score": 1.0,
        "reasons": ["chosen 1 time before for this part", "it is not in the index of libraries"],
    }


def test_limit_keeps_the_first(tiny: LibraryIndex) -> None:
    ranker = TfidfRanker(tiny)
    everything = ranker.rank(ComponentQuery("1", "twin servo"))
    for limit in range(1, 7):
        assert ranker.rank(ComponentQuery("1", "twin servo"), limit=limit).candidates == everything.candidates[:limit]
    with pytest.raises(UsageError):
        ranker.rank(SERVO, limit=0)


def test_utility_counts_first_text_second() -> None:
    assert utility(5.0, 10.0, 0) == 0.5
    assert utility(0.0, 0.0, 0) == 0.0
    assert utility(0.0, 10.0, 1) >= utility(10.0, 10.0, 0)
    assert utility(1.0, 10.0, 2) > utility(9.0, 10.0, 1)
