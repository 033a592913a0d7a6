"""Pictures and wirings of a circuit: SVG, and projects for the Wokwi simulator.

`circuit_picture` draws, `circuit_layout` places, `circuit_routes` leads the lines.
Imports queries; reports and the wiring chain import it.
"""
