"""The migration step that preserves the widths of a program's numbers: types expressions, and widens them where necessary."""

from __future__ import annotations

import os

from robosmi.metamodels import ccode
from robosmi.transformations.chains.stages.program import ProgramFiles, StoredProgram
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.target_platform import CPLUSPLUS, TargetFacts
from robosmi.transformations.m2m.partition.platform_dependence import Dependence
from robosmi.transformations.m2m.partition.renaming import RENAME
from robosmi.transformations.m2m.widths.widths import Widened, retype_decisions, widenings
from robosmi.transformations.queries.macros.macro_definitions import TextPlace, macros_of
from robosmi.transformations.queries.numbers import Machine
from robosmi.transformations.t2m.c_source.parsing.included_before import included_before
from robosmi.transformations.t2m.c_source.typed import typed_unit

FIX, KEEP = "fix", "keep"


def widened(
    program: StoredProgram, files: ProgramFiles, dependence: Dependence, api: ApiIndex, target: TargetFacts, policy: str | None
) -> Widened:
    """The changes by which a program's numbers keep their widths; none under `keep`.

    Args:
        program: the program.
        files: how it was read.
        dependence: which functions adapters replace, and which names are others.
        api: the source platform.
        target: the target.
        policy: `fix` or `keep`; None for `fix`.
    """
    source, there = dependence.source, target.model.platform
    assert source is not None
    assert there is not None
    machines = Machine.of(source), Machine.of(there)
    same = machines[1].int_bits >= machines[0].int_bits and machines[1].char_signed == machines[0].char_signed
    if policy == KEEP or same:
        return Widened()
    if machines[1].int_bits < machines[0].int_bits:
        retype_decisions(dependence, machines[0].int_bits, target.wider_names)
    units = list(program.program.units)
    macros = macros_of(units, program.copies)
    adapted = {use.name for use in dependence.adapters}
    given = {copy: path for path, copy in program.places.items()}
    real = {os.path.realpath(copy): os.path.abspath(path) for copy, path in given.items()}
    folders, defines = [str(d) for d in files.include_dirs], list(files.defines)
    stayed: list[TextPlace] = []
    typed = {
        unit.path: typed_unit(
            unit,
            given.get(unit.path, unit.path),
            program.copies[unit.path],
            macros,
            api,
            machines,
            folders,
            defines,
            adapted,
            target.wider_names,
            [real[each] for each in included_before(str(unit.path), units) if each in real],
            stayed,
        )
        for unit in units
    }
    renamed = {
        d.element.name: d.changes[0].replacement
        for d in dependence.dispositions
        if RENAME in d.rules and d.changes and isinstance(d.element, (ccode.Declaration, ccode.Macro))
    }
    made = widenings(units, program.copies, typed, machines, target.wider_names, renamed, target.language == CPLUSPLUS)
    made.unread = stayed
    return made
