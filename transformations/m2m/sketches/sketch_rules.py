"""The rules that change the text of a program whose platform stays; each is a function in a module of its own subject."""

from __future__ import annotations

from robosmi.transformations.m2m.sketches.absent_names import absent_names
from robosmi.transformations.m2m.sketches.analogue import analogue
from robosmi.transformations.m2m.sketches.argument_values import argument_values
from robosmi.transformations.m2m.sketches.avr_calls import avr_calls, sleep_modes
from robosmi.transformations.m2m.sketches.clashing_names import clashing_names
from robosmi.transformations.m2m.sketches.flash_eeprom import flash_eeprom
from robosmi.transformations.m2m.sketches.flash_reads import flash_reads
from robosmi.transformations.m2m.sketches.foreign_libraries import foreign_libraries
from robosmi.transformations.m2m.sketches.int_widths import char_signs, int_widths
from robosmi.transformations.m2m.sketches.missing_returns import missing_returns
from robosmi.transformations.m2m.sketches.object_bytes import object_bytes
from robosmi.transformations.m2m.sketches.pin_levels import pin_levels
from robosmi.transformations.m2m.sketches.register_idioms import register_idioms
from robosmi.transformations.m2m.sketches.servo_limits import servo_limits
from robosmi.transformations.m2m.sketches.sketch_edits import SketchRule
from robosmi.transformations.m2m.sketches.timer_ticks import timer_ticks
from robosmi.transformations.m2m.sketches.usb_console import usb_console

RULES: tuple[SketchRule, ...] = (
    clashing_names, timer_ticks, register_idioms, sleep_modes, avr_calls, object_bytes, int_widths, char_signs, servo_limits,
    flash_eeprom, flash_reads, pin_levels, usb_console, analogue, missing_returns, argument_values, foreign_libraries,
    absent_names,
)  # fmt: skip
"""All rules. Where edits of two of them overlap, that of the earlier one counts."""
