"""The signals that a search tries: what happens at an instant does not happen before a program can listen."""

from __future__ import annotations

import random

import pytest

from robosmi.transformations.verification.scenario_goals import NEGATIVE, behaviour
from robosmi.transformations.verification.scenario_search import _constant, _horizon, _in_turn, _Input, _random_signals
from robosmi.transformations.verification.search_effort import SearchEffort
from robosmi.transformations.verification.simulated_kinds import device_facts
from robosmi.verify.original_run import OriginalRun
from robosmi.verify.simulation import ConsoleByte, PinTrace
from tests.host_model.bench import built

LINE = _Input("RX", "points", ("a", "b"), 300.0, "serial_line")
LAMP = _Input("LAMP", "points", (0, 1), 250.0, "levels")


@pytest.mark.parametrize("seed", range(20))
def test_texts_are_not_sent_at_the_begin(seed: int) -> None:
    signals = _random_signals([LINE, LAMP], 6000.0, random.Random(seed))
    assert all(at_ms > 0 for at_ms, _ in signals.get("RX", {}).get("points", ()))


def test_levels_hold_from_the_begin_and_texts_are_sent_once() -> None:
    assert _constant(LAMP, 1) == {"LAMP": {"points": ((0.0, 1),)}}
    assert _constant(LINE, "a") == {"RX": {"points": ((900.0, "a"),)}}
    assert any(_random_signals([LAMP], 6000.0, random.Random(seed))["LAMP"]["points"][0][0] == 0 for seed in range(20))


@pytest.mark.parametrize("horizon", [3_000.0, 6_000.0, 12_000.0, 24_000.0])
def test_what_is_shown_in_turn_is_shown_before_the_end(horizon: float) -> None:
    thermometer = _Input("DHT", "celsius", (-5, 21, 80), 3000.0, "dht22", (-40, 80))
    times = [at_ms for at_ms, _ in _in_turn(thermometer, [20, 21, 20], horizon)]
    assert times[0] == 0
    assert max(times) < horizon
    assert horizon < 12_000 or len(times) == 3


def test_what_a_device_can_give_at_the_least_and_at_the_most_are_further_values() -> None:
    thermometer = _Input("DHT", "celsius", (-5, 21, 80), 3000.0, "dht22", (-40, 80))
    assert thermometer.with_ends().values == (-5, 21, 80, -40)


def test_the_ends_of_devices_are_of_signals_that_they_have() -> None:
    for kind, facts in device_facts().items():
        for setting, ends in facts.get("ends", {}).items():
            least, most = ends
            for value in facts["values"][setting]:
                if isinstance(value, (int, float)):
                    assert isinstance(least, (int, float)), (kind, setting)
                    assert isinstance(most, (int, float)), (kind, setting)
                    assert least <= value <= most, (kind, setting)


def test_a_capacitor_shows_what_does_not_fit_into_16_bits() -> None:
    _, most = device_facts()["capacitor"]["ends"]["points"]
    assert isinstance(most, int)
    assert most > 0x7FFF  # microseconds


def test_a_text_with_a_number_below_zero_is_a_goal_of_its_own() -> None:
    def goals(text: str) -> set[object]:
        letters = tuple(ConsoleByte(1000.0 * at, ord(letter)) for at, letter in enumerate(text))
        run = OriginalRun(PinTrace("e", "running", 1e6, (), (), letters, ()), "running", "", b"")
        return {place[2] for place in behaviour(run, []) if place[0] == NEGATIVE}

    assert goals("T 21\nT 4\n") == set()
    assert goals("T 21\nT -4\nT -5.5\n") == {"T -0"}


@pytest.mark.parametrize(
    ("body", "horizon"),
    [
        ('for (int i = 0; i < 9; i++) pause(1000); print("done"); while (1) pause(1000);', 12_000.0),
        ('while (1) { print("on"); pause(1000); }', 6_000.0),
        ("while (1) pause(1000);", 6_000.0),
    ],
)
def test_a_program_that_goes_round_and_shows_nothing_is_looked_at_for_longer(body: str, horizon: float) -> None:
    with built(f"#include <simpletools.h>\nint main() {{ {body} }}") as program:
        assert _horizon(program, [], SearchEffort(240.0), (3_000.0, 6_000.0, 12_000.0)) == horizon
