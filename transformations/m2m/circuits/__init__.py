"""Circuits: connectors mapped to pins (paper, algorithm 1), wiring for other tools, output settings.

Imports queries and knowledge.
The chains import it.
"""
