"""The paper's experiment: ranks among 247 headers as ranges, and its two cases where the formula fails."""

from __future__ import annotations

import statistics

import pytest

from robosmi.recommend.component import ComponentQuery
from robosmi.recommend.history import History
from robosmi.transformations.knowledge.libraries.library_ranking import tfidf_ranker
from tests.recommend.paper_ranks import DHT, HEADERS, SERVO, WAYS, Experiment

DRAWS = 60


@pytest.fixture(scope="module")
def experiment() -> Experiment:
    return Experiment()


def test_the_draw_rule(experiment: Experiment) -> None:
    assert (len(experiment.fixed), len(experiment.rest)) == (85, 1654)
    assert len(set(experiment.draw(3))) == HEADERS
    assert experiment.draw(3) == experiment.draw(3) != experiment.draw(4)


@pytest.mark.parametrize(
    ("title", "way", "median"),
    [
        (SERVO, "words", 2), (SERVO, "substrings", 2), (SERVO, "identifier words", 3),
        (DHT, "words", 6.5), (DHT, "substrings", 4), (DHT, "identifier words", 5),
    ],
)  # fmt: skip
def test_medians_of_the_research_note(experiment: Experiment, title: str, way: str, median: float) -> None:
    """The note drew from the headers in the order of the facts, here in that of names: the same but for half a rank."""
    assert set(WAYS) >= {way}
    ranks = [experiment.rank(title, way, experiment.draw(seed)) for seed in range(DRAWS)]
    assert abs(statistics.median(ranks) - median) <= 0.5
    assert max(ranks) > min(ranks), "the paper's rank is a property of its own collection"


def test_ranks_without_a_draw(experiment: Experiment) -> None:
    everything = [*experiment.fixed, *experiment.rest]
    found = {(title, way): experiment.rank(title, way, everything) for title in (SERVO, DHT) for way in WAYS}
    assert [found[SERVO, way] for way in WAYS] == [4, 4, 12]
    assert [found[DHT, way] for way in WAYS] == [38, 19, 25]


def test_a_board_header_full_of_servo_words_goes_before_the_servo_library(experiment: Experiment) -> None:
    """The paper's first sensitive case: Boards.h says MAX_SERVOS for every board that it knows."""
    first = [experiment.first(SERVO, "words", experiment.draw(seed)) for seed in range(DRAWS)]
    assert first.count("Boards.h") >= DRAWS * 0.8
    assert "Servo.h" not in first


def test_a_part_whose_words_no_header_has_finds_nothing_of_use() -> None:
    """The paper's second sensitive case: TSOP312 is an infrared receiver, and no library says so."""
    names = [c.library for c in tfidf_ranker().rank(ComponentQuery("1", "TSOP312.., 314..")).candidates]
    assert "IRremote" not in names


def test_a_choice_in_the_history_mends_what_words_cannot(history: History) -> None:
    """The second sensitive case again: once a person has chosen IRremote for the receiver, it is first for that part."""
    query = ComponentQuery("1", "TSOP312.., 314..", part_id="tsop")
    history.record("tsop", query.title, "IRremote")
    assert tfidf_ranker().rank(query, history).candidates[0].library == "IRremote"
    other = ComponentQuery("2", "TSOP312.., 314..", part_id="another part")
    assert all(c.library != "IRremote" for c in tfidf_ranker().rank(other, history).candidates), "for that part only"


def test_a_choice_in_the_history_mends_the_ranking(history: History) -> None:
    """The paper's second phase: DHT.h was only 4th, until it had been chosen once."""
    query = ComponentQuery("1", DHT, part_id="dht")
    assert tfidf_ranker().rank(query, history).candidates[0].library != "DHT sensor library"
    history.record("dht", DHT, "DHT sensor library")
    assert tfidf_ranker().rank(query, history).candidates[0].library == "DHT sensor library"
