"""The sketch folder of a migration plan: the generator registered for Arduino targets (paper 3.4).

It reads the plan, the models it refers to and the stored sources, and takes no decisions.
"""

from __future__ import annotations

from collections.abc import Mapping

from msgspec.structs import replace

from robosmi.generate import Generation
from robosmi.metamodels import migration
from robosmi.transformations.m2t.program_files import ProgramTemplates, program_files
from robosmi.transformations.m2t.sketch_project import project

_TEMPLATES = ProgramTemplates(
    "arduino/sketch.ino.j2",
    "arduino/own_header.h.j2",
    "arduino/adapters.h.j2",
    "arduino/sketch.yaml.j2",
    "sketch.yaml",
    bench="arduino/bench.ino.j2",
    pins="arduino/moved_pins.h.j2",
)
_MORE = {"platformio.ini": "arduino/platformio.ini.j2"}


def generate(plan: migration.MigrationPlan, sources: Mapping[str, bytes]) -> Generation:
    """The files of the sketch, their paths relative to the output folder; nothing is written.

    Args:
        plan: a complete plan.
        sources: path of a unit -> its bytes.

    Raises:
        RuleError: a template is wrong.
    """
    shown = project(plan)
    return program_files(plan, sources, replace(_TEMPLATES, more=_MORE if shown["platformio"] else {}), shown)
