"""Reader for drawings of the Wokwi simulator: `read_circuit` makes a hardware model of a `diagram.json`."""

from __future__ import annotations

from robosmi.transformations.t2m.wokwi.reader import read_circuit

__all__ = ["read_circuit"]
