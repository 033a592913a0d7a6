"""Devices bound to the pins of both sides, as wiring and ports say.

`port_devices` binds, `played_devices` drive the source's side.
Imports `devices` through the registry; the runs and the search import it.
"""
