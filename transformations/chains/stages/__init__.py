"""Stages that the chains share: reading, drawing, choices, own adapters, output.

`output` writes a migration, `reading` loads programs and drawings.
Imports every room of the content but the chains; the chains import it.
"""
