"""The default ranker: the figures it has to reach, answers for plain parts, history as a small prior, odd input."""

from __future__ import annotations

import pytest

from robosmi.errors import UsageError
from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.history import History
from robosmi.recommend.ranking import Ranker, Recommendation
from tests.recommend.evaluate import GOALS
from tests.recommend.labelled import VIEWS, Labelled, ranker

SERVO = ComponentQuery("1", "Basic Servo", family="Servo", tags=("servo",), part_id="servo-1")
RHT03 = ComponentQuery("2", "Humidity and Temperature Sensor RHT03", part_id="rht")


def _names(answer: Recommendation) -> list[str]:
    return [candidate.library for candidate in answer.candidates]


def test_the_goals_are_reached_on_the_labelled_queries(data: Labelled) -> None:
    figures = data.score([ranker().rank(query, limit=10) for query in data.components])
    assert {name: figures[name] >= goal for name, goal in GOALS.items()} == dict.fromkeys(GOALS, True)
    assert figures["five_candidates"] == 1.0


def test_parts_that_no_table_names_are_still_mostly_right(data: Labelled) -> None:
    """Without model numbers and trade names, and without any table: what may be hoped for of parts never thought of."""
    kinds = data.score([ranker(VIEWS[1]).rank(query, limit=10) for query in data.components])
    nothing = data.score([ranker(VIEWS[2]).rank(query, limit=10) for query in data.components])
    assert kinds["top1"] >= 0.92
    assert kinds["end_to_end"] >= 0.90
    assert nothing["top1"] >= 0.88
    assert nothing["top1"] - 0.684 > 0.15, "far better than the paper's formula"


@pytest.mark.parametrize(
    ("title", "family", "library"),
    [
        ("Basic Servo", "Servo", "Servo"),
        ("DHT22 Temperature and Humidity Sensor", "", "DHT sensor library"),
        ("Humidity and Temperature Sensor RHT03", "MaxDetect Technology", "DHT sensor library"),
        ("TSOP312.., 314..", "infrared", "IRremote"),
    ],
)
def test_parts_of_the_case_studies_that_need_a_library(title: str, family: str, library: str) -> None:
    answer = ranker().rank(ComponentQuery("1", title, family=family))
    assert (answer.decision, _names(answer)[0]) == ("library", library)
    assert answer.confidence >= 0.8


@pytest.mark.parametrize(
    ("title", "family"),
    [("Red LED - 5mm", "LED"), ("220 Ω Resistor", "Resistor"), ("Relay", "Relay"), ("Slide Potentiometer", "Potentiometer")],
)
def test_plain_parts_need_none_and_it_is_said_why(title: str, family: str) -> None:
    answer = ranker().rank(ComponentQuery("1", title, family=family))
    assert answer.decision == "none"
    assert answer.confidence >= 0.8
    assert "no library needed" in answer.reasons[0]
    assert answer.reasons[0] in answer.candidates[0].reasons
    assert len(answer.candidates) >= 5


def test_reasons_name_the_model_number_and_where_it_stands() -> None:
    reasons = ranker().rank(RHT03).candidates[0].reasons
    assert "model number DHT22 in its description" in reasons
    assert any(reason.startswith("usual library for DHT") for reason in reasons)


def test_the_bus_of_a_part_counts() -> None:
    parallel = ranker().rank(ComponentQuery("1", "LCD 16x2", connectors=("RS", "E", "D4", "D5", "D6", "D7")))
    bus = ranker().rank(ComponentQuery("1", "LCD 16x2", connectors=("GND", "VCC", "SDA", "SCL")))
    assert _names(parallel)[0] == "LiquidCrystal"
    assert _names(bus)[0] == "LiquidCrystal_I2C"


def test_a_library_for_other_processors_steps_back() -> None:
    query = ComponentQuery("1", "Ethernet controller W5100")
    assert "lwIP_w5100" not in _names(ranker().rank(query, limit=3))
    remark = next(c for c in ranker().rank(query).candidates if c.library == "lwIP_w5100").reasons
    assert any("does not list the architecture avr" in reason for reason in remark)


@pytest.mark.parametrize("title", ["", "   ", "Part2", "x" * 10_000, "😀", "ΩΩΩ", "'; DROP TABLE fact; --", "../../etc/passwd"])
def test_odd_titles_get_a_list_and_little_confidence(title: str) -> None:
    answer = ranker().rank(ComponentQuery("1", title))
    assert len(answer.candidates) >= 5
    assert answer.confidence <= 0.5


def test_history_decides_between_right_ones(history: History) -> None:
    before = _names(ranker().rank(SERVO))
    history.record("servo-1", "Basic Servo", before[1])
    answer = ranker().rank(SERVO, history)
    assert _names(answer)[:2] == [before[1], before[0]]
    assert answer.candidates[0].reasons[0] == "chosen 1 time before for this part"
    other = ComponentQuery("1", "Basic Servo", family="Servo", part_id="another")
    assert _names(ranker().rank(other, history)) == before


def test_history_cannot_push_a_wrong_one_up(history: History) -> None:
    before = _names(ranker().rank(SERVO, limit=10))
    for _ in range(50):
        history.record("servo-1", "Basic Servo", "U8g2")
        history.record("servo-1", "Basic Servo", before[9])
    assert _names(ranker().rank(SERVO, history, limit=10)) == before


def test_history_of_the_same_model_number_counts_too(history: History) -> None:
    query = ComponentQuery("1", "RHT03 board of somebody else", part_id="x")
    second = _names(ranker().rank(query))[1]
    history.record("rht", RHT03.title, second)
    answer = ranker().rank(query, history)
    assert _names(answer)[0] == second
    assert "for parts with the model number RHT03" in answer.candidates[0].reasons[0]


def test_a_library_that_only_history_knows_is_listed_last(history: History) -> None:
    history.record("servo-1", "Basic Servo", "Our Own")
    last = ranker().rank(SERVO, history).candidates[-1]
    assert (last.library, last.header) == ("Our Own", "")
    assert "it is not in the index of libraries" in last.reasons


def test_it_is_a_ranker_and_a_limit_keeps_the_first() -> None:
    ranking: Ranker = ranker()
    everything = ranking.rank(SERVO).candidates
    assert ranking.rank(SERVO, limit=3).candidates == everything[:3]
    with pytest.raises(UsageError):
        ranking.rank(SERVO, limit=0)


@pytest.mark.exhaustive
def test_the_confidence_is_calibrated(data: Labelled) -> None:
    """Cross-validated over queries where the ranker is wrong often enough to measure it: with the tables left out."""
    from tests.recommend.evaluate import _mean_brier, brier, cross_validated
    from tests.recommend.fit import samples

    _, judged = cross_validated(data, samples(data), VIEWS[2])
    assert brier(judged) < 0.8 * _mean_brier(judged)
    sure = [each for each in judged if each.confidence >= 0.9]
    assert len(sure) > 40
    assert sum(each.right for each in sure) / len(sure) >= 0.9
