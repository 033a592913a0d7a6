"""Programs that a test needs: skip it with the reason where they are missing, fail it there if this is the CI.

A test that is skipped everywhere tests nothing; so environment CI=true turns the skip into a failure.
"""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from robosmi.plugins import content
from robosmi.verify.host_model import load_host_model
from robosmi.verify.original_build import missing_tools
from robosmi.verify.simulation import Engine

KNOWN_PLACES = {
    "axe-core": Path(__file__).parents[1] / ".npm" / "node_modules" / "axe-core" / "axe.min.js",
    "arduino-core-avr": Path("/usr/share/arduino/hardware/arduino/avr/cores/arduino/Arduino.h"),
    "gcc-32-bits": Path("/usr/lib32/libc.so"),
    "sarif-multitool": Path(__file__).parents[1]
    / ".npm"
    / "node_modules"
    / "@microsoft"
    / "sarif-multitool-linux"
    / "Sarif.Multitool",
    "wokwi-elements": Path(__file__).parents[1] / ".npm" / "node_modules" / "@wokwi" / "elements" / "package.json",
}
"""Things that are no programs: name -> a file that exists if it is installed (by Debian, or by `.ci/npm-packages`)."""

NO_CORE = {"esp32", "esp32c3", "nano33ble", "nucleo-f401re", "teensy40", "uno-r4-minima", "zero"}
"""Boards that need a core which RoboSMi has no stand-in for."""


def require_tools(*names: str) -> None:
    """Skip the running test unless all these programs are installed; with CI=true fail instead.

    Args:
        names: programs on PATH, or keys of `KNOWN_PLACES`.
    """
    missing = [name for name in names if not (KNOWN_PLACES[name].is_file() if name in KNOWN_PLACES else shutil.which(name))]
    if not missing:
        return
    _lack(f"not installed: {', '.join(missing)}")


def require_engine(name: str) -> None:
    """Skip the running test unless this simulator is installed; with CI=true fail instead."""
    engine: Engine = content("engine", name)()
    advice = engine.missing()
    if advice is not None:
        _lack(f"the engine {name} is not installed: {advice}")


def require_verification(*engines: str) -> None:
    """Skip the running test unless originals and sketches can be compiled, and these simulators are there; with CI=true fail."""
    require_tools("avr-gcc", "arduino-core-avr", "gcc")
    if advice := missing_tools(load_host_model("propeller")):
        _lack(advice)
    for name in engines:
        require_engine(name)


def _lack(reason: str) -> None:
    if os.environ.get("CI") == "true":
        pytest.fail(f"{reason} (CI=true: a skipped test would test nothing)")
    pytest.skip(reason)
