"""Signals of devices with other instants and values."""

from __future__ import annotations

import pytest

from robosmi.verify.input_variation import vary_inputs
from robosmi.verify.simulation import DeviceUse

DEVICES = [
    DeviceUse("levels", {"pin": "P1"}, {"points": [[0, 0], [100, 1], [105, 0]]}),
    DeviceUse("capacitor", {"pin": "P2"}, {"points": [[0, 250], [100, 4000]]}),
    DeviceUse("typing", {}, {"points": [[50, "text"]]}),
    DeviceUse("registers", {}, {"address": 0x1D, "content": [1, 2, 3], "name": []}),
]


def test_nothing_varies_without_an_amount() -> None:
    assert [dict(use.settings) for use in vary_inputs(DEVICES, 1)] == [
        {"points": [[0, 0], [100, 1], [105, 0]]},
        {"points": [[0, 250], [100, 4000]]},
        {"points": [[50, "text"]]},
        {"address": 0x1D, "content": [1, 2, 3], "name": []},
    ]


def test_a_seed_is_one_difference() -> None:
    first = vary_inputs(DEVICES, 1, 20, 0.1)
    assert first == vary_inputs(DEVICES, 1, 20, 0.1)
    assert first != vary_inputs(DEVICES, 2, 20, 0.1)


@pytest.mark.parametrize("seed", range(20))
def test_instants_move_within_the_amount_and_keep_their_order(seed: int) -> None:
    levels, capacitor, typing, registers = vary_inputs(DEVICES, seed, 20)
    points = levels.settings["points"]
    assert points[0] == [0, 0]
    assert [value for _, value in points] == [0, 1, 0]
    assert 80 <= points[1][0] <= 120
    assert points[1][0] <= points[2][0] <= 125
    assert capacitor.settings["points"][1][0] == points[1][0]  # what happens at one instant stays together
    assert typing.settings["points"][0][1] == "text"
    assert registers.settings == DEVICES[3].settings


def test_signals_may_move_apart() -> None:
    levels, capacitor, *_ = vary_inputs(DEVICES, 3, 20, together=False)
    assert levels.settings["points"][1][0] != capacitor.settings["points"][1][0]


def test_values_but_levels_vary() -> None:
    levels, capacitor, *_ = vary_inputs(DEVICES, 5, value_part=0.1)
    assert levels == DEVICES[0]
    values = [value for _, value in capacitor.settings["points"]]
    assert values != [250, 4000]
    assert values == pytest.approx([250, 4000], rel=0.1)
