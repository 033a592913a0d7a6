"""Questions to a hardware model: walks along nets, kinds of components, connectors, electrical limits.

Voltages are in volts, currents in milliamperes.
Imports knowledge only; plans, rules and constraints may import it.
"""
