"""The signals that a search tries: what happens at an instant does not happen before a program can listen."""

from __future__ import annotations

import random
from itertools import pairwise

import pytest
from msgspec.structs import replace

from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.bound_devices.simulated_kinds import device_facts
from robosmi.transformations.verification.original_side import channel_events
from robosmi.transformations.verification.search.scenario_goals import NEGATIVE, behaviour, near_threshold
from robosmi.transformations.verification.search.scenario_inputs import (
    ScenarioInput,
    constant,
    in_turn,
    random_signals,
    scenario_inputs,
    series_points,
    turned,
)
from robosmi.transformations.verification.search.scenario_search import _horizon
from robosmi.transformations.verification.search.search_effort import SearchEffort
from robosmi.verify.simulation import ConsoleByte, PinTrace
from tests.host_model.bench import original

LINE = ScenarioInput("RX", "points", ("a", "b"), 300.0, "serial_line")
LAMP = ScenarioInput("LAMP", "points", (0, 1), 250.0, "levels")


@pytest.mark.parametrize("seed", range(20))
def test_texts_are_not_sent_at_the_begin(seed: int) -> None:
    signals = random_signals([LINE, LAMP], 6000.0, random.Random(seed))
    assert all(at_ms > 0 for at_ms, _ in signals.get("RX", {}).get("points", ()))


def test_levels_hold_from_the_begin_and_texts_are_sent_once() -> None:
    assert constant(LAMP, 1) == {"LAMP": {"points": ((0.0, 1),)}}
    assert constant(LINE, "a") == {"RX": {"points": ((900.0, "a"),)}}
    assert any(random_signals([LAMP], 6000.0, random.Random(seed))["LAMP"]["points"][0][0] == 0 for seed in range(20))


@pytest.mark.parametrize("horizon", [3_000.0, 6_000.0, 12_000.0, 24_000.0])
def test_what_is_shown_in_turn_is_shown_before_the_end(horizon: float) -> None:
    thermometer = ScenarioInput("DHT", "celsius", (-5, 21, 80), 3000.0, "dht22", (-40, 80))
    times = [at_ms for at_ms, _ in in_turn(thermometer, [20, 21, 20], horizon)]
    assert times[0] == 0
    assert max(times) < horizon
    assert horizon < 12_000 or len(times) == 3


BUTTON = BoundPort("button", "P5", "D5", "", "", ("input",), "levels", "pin")


@pytest.mark.parametrize(("steps", "presses"), [(0, 0), (2, 5), (4, 9), (10, 21)])
def test_a_button_is_pressed_as_often_as_the_program_tells_apart_and_once_more_round(steps: int, presses: int) -> None:
    (button,) = scenario_inputs([BUTTON], (), False, steps)
    points = series_points(button)
    assert [value for _, value in points] == [1, 0] * presses
    assert all(after - at >= button.hold_ms for (at, _), (after, _) in pairwise(points))
    assert series_points(button, 4) == tuple((900.0 + 1000 * n, value) for n, (_, value) in enumerate(points) if n < 23)


def test_all_keys_of_a_matrix_are_pressed() -> None:
    pins = [f"row{n}" for n in range(4)] + [f"column{n}" for n in range(3)]
    ports = [BoundPort(pin, f"P{n}", f"D{n + 2}", device="keypad", pin=pin, group="P0") for n, pin in enumerate(pins)]
    (keypad,) = scenario_inputs(ports, (), False)
    pressed = [value for _, value in series_points(keypad) if value is not None]
    assert pressed == [[row, column] for row in range(4) for column in range(3)]
    assert keypad.series[1::2] == (None,) * 12
    assert None in keypad.values


def test_what_is_typed_follows_one_after_the_other() -> None:
    (console,) = scenario_inputs([], ("up 50\r", "down 50\r"), True)
    times = [at for at, _ in series_points(console)]
    assert [value for _, value in series_points(console)][:2] == ["up 50\r", "down 50\r"]
    assert times == [900.0 + 300 * number for number in range(len(console.values))]


def test_no_voltage_is_tried_that_the_pin_of_the_board_does_not_bear() -> None:
    port = BoundPort("AD0", "AD0", "GP26", device="voltages", pin="pin")
    (every,), (borne,) = (scenario_inputs([each], (), False) for each in (port, replace(port, most=3300.0)))
    assert (4900 in every.values, every.ends) == (True, (0, 5000))
    assert (borne.values, borne.ends) == ((0, 800, 1700, 2500, 3300), (0, 3300))


def test_two_contacts_are_turned_as_a_knob() -> None:
    one, other = scenario_inputs([BUTTON, BoundPort("b", "P6", "D6", device="levels", pin="pin")], (), False, 4)
    forwards, backwards = (turned(one, other, each) for each in (False, True))
    assert [forwards[name]["points"][0] for name in ("button", "b")] == [(900.0, 1), (1150.0, 1)]
    assert [backwards[name]["points"][0] for name in ("button", "b")] == [(1150.0, 1), (900.0, 1)]


def test_what_a_device_can_give_at_the_least_and_at_the_most_are_further_values() -> None:
    thermometer = ScenarioInput("DHT", "celsius", (-5, 21, 80), 3000.0, "dht22", (-40, 80))
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
        trace = PinTrace("e", "running", 1e6, (), (), letters, ())
        return {place[2] for place in behaviour(channel_events(trace, [], target=False)) if place[0] == NEGATIVE}

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
    with original(f"#include <simpletools.h>\nint main() {{ {body} }}") as program:
        assert _horizon(program, [], SearchEffort(240.0), (3_000.0, 6_000.0, 12_000.0)) == horizon


@pytest.mark.parametrize("kind", ["ranger", "two_pin_ranger"])
def test_values_beside_a_border_of_a_ranger_are_no_whole_centimetres(kind: str) -> None:
    """A program that rounds them and waits that long takes another time where two boards round differently."""
    facts = device_facts()[kind]
    assert near_threshold(42, facts) == (40.5, 43.5)  # 41.5 may be seen as 42 by another board
    assert near_threshold(50, facts) == (48.5, 51.5)
    assert near_threshold(100, facts) == (98.5, 101.5)
    for border in range(4, 250):
        low, high = near_threshold(border, facts)
        assert border / 1.02 - 0.8 <= low < border - 0.07
        assert border + 0.07 < high <= border * 1.02 + 0.8
        assert all(0.3 - 1e-9 <= value % 1 <= 0.7 + 1e-9 for value in (low, high))


def test_values_beside_a_border_of_what_nobody_rounds_are_as_near_as_boards_allow() -> None:
    assert list(near_threshold(1020, {"near_percent": 2, "off_least": 7})) == pytest.approx([1000, 1040.4])


def test_all_digits_of_a_remote_are_pressed() -> None:
    """Codes 0 to 9 are the keys 1 to 9 and 0, to which a program that drives a robot gives motions."""
    values = device_facts()["sony_remote"]["values"]["points"]
    assert all([code, 1] in values for code in range(10))
