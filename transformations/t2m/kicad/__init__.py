"""Reader for KiCad schematics (`.kicad_sch`) and netlists (`.net`): `read_circuit` makes a hardware model of one."""

from __future__ import annotations

from robosmi.transformations.t2m.kicad.reader import read_circuit

__all__ = ["read_circuit"]
