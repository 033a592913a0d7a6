"""A body that does something else is named by the verdict: the function, the call, and the first difference that it makes.

People write bodies themselves; here those of the repository are spoilt in the adapters of a migrated program.
"""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

import robosmi
from robosmi.transformations.chains.verify import verify
from tests.tiers import sample
from tests.tools import require_verification

PROGRAM = Path(__file__).parent / "programs" / "button.c"
SCENARIO = "horizon_ms = 2500\n[signals]\nP3 = [[0, 0], [500, 1], [900, 0]]\n"
SPOILT = {
    "pin": (
        "KnownIo(pin).level(true);", "KnownIo(pin - 1).level(true);",
        "high", 11, "Lamp (P26)", "",
    ),
    "time": (
        "delay((uint32_t)time);", "delay((uint32_t)(time - time / 20));",
        "pause", 12, "Lamp (P26)", r"285\.\d+ ms; .* 300\.\d+ ms",
    ),
    "frequency": (
        "begin_tone(io, frequency);", "begin_tone(io, 2500);",
        "freqout", 14, "Speaker (P4)", r"2500(\.0\d)? Hz; .* 2999\.99 Hz",
    ),
    "input": ("return io.high();", "return !io.high();", "input", 8, "console", r"'presses 1' 50[01]\.\d ms"),
    "text": (
        "port->write((uint8_t)c);", "port->write((uint8_t)(c == 's' ? 'z' : c));",
        "print", 10, "console", "'prezzez 1'.*'presses 1'",
    ),
}  # fmt: skip
"""Name of a fault -> old text, new text, the call that is named and its line, channel, and the numbers in the message."""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The migrated program."""
    require_verification("simavr")
    folder = tmp_path_factory.mktemp("adapters")
    robosmi.migrate([PROGRAM], folder / "out", bind={"P3": "D2", "P4": "D8", "P26": "D13"})
    return folder / "out"


@pytest.mark.parametrize("what", sample(SPOILT, 2))
def test_a_spoilt_adapter_is_named(what: str, made: Path, tmp_path: Path) -> None:
    old, new, function, line, channel, said = SPOILT[what]
    out = tmp_path / "out"
    shutil.copytree(made, out)
    adapters = out / "button" / "adapters.h"
    assert old in adapters.read_text()
    adapters.write_text(adapters.read_text().replace(old, new))
    (tmp_path / "pressed.toml").write_text(SCENARIO)
    told = verify(out, scenarios=[tmp_path / "pressed.toml"]).verdict.to_json()
    assert told["verdict"] == "different"
    first = told["first_difference"]
    calls = {(each["function"], each["line"]) for each in (first["call"], *first["calls_around"])}
    assert (first["channel"], (function, line) in calls) == (channel, True), first
    assert re.search(said, first["message"])
