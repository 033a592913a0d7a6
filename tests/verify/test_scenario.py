"""Scenarios as files: what is read, what is refused with place and cause, and that a text is read back as the same scenario."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, strategies as st

from robosmi.errors import SourceError
from robosmi.verify.scenario import Scenario, read_scenario
from tests.tiers import examples

TEXT = """
name = "a checkpoint"
horizon_ms = 4000
stored = [[32768, 3, 0], [40, 255]]

[signals]
"QTI left" = [[0, 300], [500, 1700.5]]
DHT22 = { humidity = [[0, 40]], celsius = [[0, "none"], [1000, -2.5]] }
console = [[100, "go\\n"]]
"""


def test_a_scenario_is_read(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    path.write_text(TEXT)
    read = read_scenario(path)
    assert (read.name, read.horizon_ms, read.origin, read.path) == ("a checkpoint", 4000.0, "given", path)
    assert read.stored == ((32768, 3, 0), (40, 255))
    assert read.signals == {
        "QTI left": {"points": ((0.0, 300), (500.0, 1700.5))},
        "DHT22": {"humidity": ((0.0, 40),), "celsius": ((0.0, None), (1000.0, -2.5))},
        "console": {"points": ((100.0, "go\n"),)},
    }


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("horizon_ms = 4000", "", "horizon_ms, the scenario's duration, is missing"),
        ("horizon_ms = 4000", "horizon_ms = 0", "horizon_ms is 0"),
        ("horizon_ms = 4000", "horizon_ms = 1e9", "at most 600,000"),
        ("horizon_ms = 4000", "horizon_ms = true", "horizon_ms is True"),
        ("horizon_ms", "horizont_ms", r"'horizont_ms' is not a key of a scenario \(did you mean 'horizon_ms'\?\)"),
        ("[500, 1700.5]", "[500]", r"the signal 'QTI left' has \[500\], which is not a point"),
        ("[500, 1700.5]", "[-1, 3]", "which is not a point"),
        ("[1000, -2.5]", "[nan, 3]", "the signal 'DHT22.celsius' has"),
        ("[[0, 300], [500, 1700.5]]", "[[500, 300], [0, 1]]", "the signal 'QTI left' goes back in time, from 500 to 0 ms"),
        ("[500, 1700.5]", "[1e308, 3]", "which is out of range"),
        ("[500, 1700.5]", "[500, inf]", "which is out of range"),
        ("[500, 1700.5]", "[4000.5, 3]", r"'QTI left' has \[4000.5, 3\] after the scenario's end at 4000 ms"),
        ("horizon_ms = 4000", "horizon_ms = 900", "the signal 'DHT22.celsius' has .* end at 900 ms"),
        ("[500, 1700.5]", "[500, nan]", "which is out of range"),
        ("[500, 1700.5]", "[500, 99999999999999999999999]", "which is out of range"),
        ("[500, 1700.5]", "[500, true]", "which is out of range"),
        ("[[0, 300], [500, 1700.5]]", "[]", "is not a list of points"),
        ("[[0, 300], [500, 1700.5]]", '"high"', "is not a list of points"),
        ('name = "a checkpoint"', "name = 7", "'name' must be a text"),
        ("[40, 255]", "[40]", "'stored' is no list of addresses with bytes"),
        ("[40, 255]", "[40, 256]", "'stored' is no list"),
        ("[40, 255]", "[65535, 1, 2]", "'stored' is no list"),
        ("[40, 255]", "[-1, 2]", "'stored' is no list"),
        ("[[32768, 3, 0], [40, 255]]", '"all"', "'stored' is no list"),
        ("[signals]", "[signals", "the scenario cannot be read"),
    ],
)
def test_what_means_nothing_is_refused_with_its_place(old: str, new: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    assert old in TEXT
    path.write_text(TEXT.replace(old, new, 1))
    with pytest.raises(SourceError, match=message) as refused:
        read_scenario(path)
    assert str(refused.value).startswith(str(path))
    assert refused.value.fix


def test_the_last_point_may_be_at_the_end(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    path.write_text(TEXT.replace("horizon_ms = 4000", "horizon_ms = 1000"))
    assert read_scenario(path).signals["DHT22"]["celsius"][-1] == (1000.0, -2.5)


def test_a_missing_file_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(SourceError, match="the scenario cannot be read: No such file"):
        read_scenario(tmp_path / "no.toml")


_VALUE = st.none() | st.integers(-9999, 9999) | st.text(max_size=8).filter(lambda t: t != "none") | st.just([1, 2])
_POINTS = st.lists(st.tuples(st.integers(0, 999).map(float), _VALUE), min_size=1, max_size=4).map(
    lambda points: tuple(sorted(points, key=lambda point: point[0]))
)
_NAME = st.text(min_size=1, max_size=12)
Signals = dict[str, dict[str, tuple[tuple[float, object], ...]]]


@examples(80, suppress_health_check=[HealthCheck.too_slow])  # on a machine under load
@given(
    _NAME,
    st.floats(1000, 600_000),
    st.dictionaries(_NAME, _POINTS.map(lambda p: {"points": p}), max_size=4),
    st.lists(st.tuples(st.integers(0, 9999), st.integers(0, 255)), max_size=2).map(tuple),
)
def test_a_text_is_read_back_as_the_same_scenario(
    tmp_path_factory: pytest.TempPathFactory,
    name: str,
    horizon: float,
    signals: Signals,
    stored: tuple[tuple[int, ...], ...],
) -> None:
    path = tmp_path_factory.mktemp("s") / "s.toml"
    scenario = Scenario(name, round(horizon, 6), signals, "stored", path, stored)
    path.write_text(scenario.text(), encoding="utf-8")
    assert read_scenario(path, "stored") == scenario
