"""Reader for EAGLE schematics (`.sch` of EAGLE 6 and on): `read_circuit` makes a hardware model of one."""

from __future__ import annotations

from robosmi.transformations.t2m.eagle.reader import read_circuit

__all__ = ["read_circuit"]
