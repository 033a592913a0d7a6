"""Collects all constraints on the move of a program; importing this module makes `moved` complete."""

from __future__ import annotations

from robosmi.transformations.constraints import (
    code_calls,
    code_characters,
    code_cores,
    code_fixed_widths,
    code_formats,
    code_memory,
    code_ports,
    code_ranges,
    code_widths,
)
from robosmi.transformations.constraints.code_move import move_findings, moved

__all__ = ["MODULES", "move_findings", "moved"]

MODULES = (
    code_widths,
    code_formats,
    code_characters,
    code_cores,
    code_ports,
    code_ranges,
    code_memory,
    code_fixed_widths,
    code_calls,
)
"""The modules that define these constraints."""
