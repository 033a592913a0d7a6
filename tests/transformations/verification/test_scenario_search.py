"""The signals that a search tries: what happens at an instant does not happen before a program can listen."""

from __future__ import annotations

import random

import pytest

from robosmi.transformations.verification.scenario_search import _constant, _Input, _random_signals

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
