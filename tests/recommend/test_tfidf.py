"""The paper's equation by numbers worked out by hand on the tiny index, and what is closed in it."""

from __future__ import annotations

import math

import pytest

from robosmi.recommend.index import LibraryIndex
from robosmi.recommend.tfidf import explain, idf, score_headers, tf_weight, words

# N = 7 headers: 0 Other.h, 1 Base.h (Base), 2 sensor.h, 3 MotorKit.h, 4 inner.h (Motor Kit), 5 Servo.h, 6 alike.h (Twins)


@pytest.mark.parametrize(
    ("title", "expected"),
    [
        ("Basic Servo", ("basic", "servo")),
        ("DHT22 Temperature and Humidity Sensor", ("dht22", "temperature", "and", "humidity", "sensor")),
        ("HC-05 (HC_05)", ("hc", "05")),
        ("Relay – für 220 Ω", ("relay", "für", "220", "ω")),
        ("...", ()),
        ("", ()),
    ],
)
def test_words(title: str, expected: tuple[str, ...]) -> None:
    assert words(title) == expected


def test_scores_by_hand(tiny: LibraryIndex) -> None:
    """servo: df 2, ln(7/2) = 1.252763; basic: df 1, ln 7 = 1.945910; 1 + ln 300 = 6.703782; 1 + ln 4 = 2.386294."""
    scores = score_headers(tiny, words("Basic Servo"))
    assert set(scores) == {4, 5}
    assert scores[5] == pytest.approx(6.703782 * 1.252763 + 1 * 1.945910, abs=1e-5)
    assert scores[4] == pytest.approx(2.386294 * 1.252763, abs=1e-5)


def test_a_word_counts_once_however_often_the_title_says_it(tiny: LibraryIndex) -> None:
    assert score_headers(tiny, words("servo Servo SERVO")) == score_headers(tiny, words("servo"))


def test_word_in_no_header_and_word_in_every_header_add_nothing(tiny: LibraryIndex) -> None:
    assert score_headers(tiny, ["nonsense"]) == {}
    assert tiny.postings("board")[0] == (0, 1, 2, 3, 4, 5, 6)
    assert set(score_headers(tiny, ["board"]).values()) == {0.0}


def test_tf_zero_and_df_zero_are_closed() -> None:
    assert tf_weight(0) == 0.0
    assert tf_weight(1) == 1.0
    assert idf(7, 0) == 0.0
    assert idf(7, 7) == 0.0
    assert idf(7, 1) == pytest.approx(math.log(7))


def test_explanation_adds_up_to_the_score(tiny: LibraryIndex) -> None:
    terms = words("Basic Servo board")
    parts = explain(tiny, terms, 5)
    assert [(part.term, part.tf, part.df) for part in parts] == [("servo", 300, 2), ("basic", 1, 1), ("board", 1, 7)]
    assert sum(part.value for part in parts) == pytest.approx(score_headers(tiny, terms)[5])
    assert [part.term for part in explain(tiny, terms, 4)] == ["servo", "board"]
