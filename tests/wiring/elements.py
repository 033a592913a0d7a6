"""The elements of the npm package @wokwi/elements, with the names of their pins, read from its classes."""

from __future__ import annotations

import json
import subprocess
from functools import cache
from pathlib import Path

from tests.tools import require_tools

HERE = Path(__file__).resolve().parent
PACKAGE = HERE.parents[1] / ".npm" / "node_modules" / "@wokwi" / "elements"


def wokwi_elements() -> dict[str, list[str]]:
    """The pins of each element; the test is skipped if node or the package is missing, but fails in CI."""
    require_tools("node", "wokwi-elements")
    return _elements()


@cache
def _elements() -> dict[str, list[str]]:
    done = subprocess.run(["node", str(HERE / "pins.js"), str(PACKAGE)], capture_output=True, text=True, check=True)
    found: dict[str, list[str]] = json.loads(done.stdout)
    assert len(found) > 40
    return found
