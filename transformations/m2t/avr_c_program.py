"""A plain C program of a migration plan: the generator for targets that keep their main and need no core.

It reads the plan, the models it refers to and the stored sources, and takes no decisions. Units stay C files, main stays main,
adapters are C, and a Makefile is added.
"""

from __future__ import annotations

from collections.abc import Mapping

from robosmi.generate import Generation
from robosmi.metamodels import migration
from robosmi.transformations.m2t.program_files import ProgramTemplates, program_files

_TEMPLATES = ProgramTemplates(
    "avr_c/program.c.j2",
    "arduino/own_header.h.j2",
    "avr_c/adapters.h.j2",
    "avr_c/Makefile.j2",
    "Makefile",
    bench="avr_c/bench.c.j2",
)


def generate(plan: migration.MigrationPlan, sources: Mapping[str, bytes]) -> Generation:
    """The files of the program, their paths relative to the output folder; nothing is written.

    Args:
        plan: a complete plan.
        sources: path of a unit -> its bytes.

    Raises:
        RuleError: a template is wrong.
    """
    return program_files(plan, sources, _TEMPLATES, {})
