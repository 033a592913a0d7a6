"""Words and model numbers: the same device is written in many ways and comes out the same."""

from __future__ import annotations

import pytest

from robosmi.recommend.tokens import StopWords, is_model, models, parts, plain, runs, stem, words


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("HC-05 Bluetooth", "hc05"),
        ("DRV 8825 Stepper Motor Carrier", "drv8825"),
        ("24LC256", "24lc256"),
        ("24 LC 256", "24lc256"),
        ("NRF24L01+ Breakout", "nrf24l01"),
        ("SparkFun IMU Breakout - MPU-9250", "mpu9250"),
        ("US-100 Ultrasonic Distance Sensor", "us100"),
        ("SHT1x-Breakout", "sht1x"),
    ],
)
def test_a_model_number_is_found_however_it_is_written(text: str, wanted: str) -> None:
    assert wanted in models(text)


@pytest.mark.parametrize("word", ["5mm", "16x2", "lqfp80", "rev3", "10k", "9dof", "12bit", "servo", "555", "v2", "i2c", "mp3"])
def test_sizes_housings_versions_and_words_are_no_model_numbers(word: str) -> None:
    assert not is_model(word)


def test_compounds_are_taken_apart_and_model_numbers_are_not() -> None:
    assert parts("QuadStepper") == ("quadstepper", "quad", "stepper")
    assert parts("MPU6050") == ("mpu6050",)
    assert list(words("LED-Matrix_driver")) == ["led", "matrix", "driver"]


def test_plurals() -> None:
    assert [stem(w) for w in ("sensors", "switches", "batteries", "bus", "axis", "ws2812s", "gas")] == [
        "sensor", "switch", "battery", "bus", "axis", "ws2812s", "gas",
    ]  # fmt: skip


def test_names_are_compared_plainly() -> None:
    assert plain("IR Receivers!") == plain("ir-receiver") == "irreceiver"
    assert plain("HC-SR04") == plain("hcsr04") == "hcsr04"
    assert plain("...") == ""


def test_runs_of_neighbours() -> None:
    assert list(runs("a Bs c", longest=2)) == [(0, 1, "a"), (0, 2, "abs"), (1, 2, "bs"), (1, 3, "bsc"), (2, 3, "c")]


def test_stop_words() -> None:
    stop = StopWords(frozenset({"adafruit"}), frozenset({"the"}))
    assert [w for w in ("adafruit", "the", "12", "x", "servo") if w not in stop] == ["servo"]
