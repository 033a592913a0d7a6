"""Plans and platforms as version 0.1.0 stored them, in today's metamodels (migration 1 and platform 1, both to 2).

Then a disposition had its rules joined by `+` and what they put in the text joined by `;`, and the changes of text were derived
whenever a sketch was generated. They are made here, from the rules and the stored copies of the sources. A board was
contained in its platform and knew its name there. A target was not in the model: there was one generator.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.metamodels import ccode, migration, platform
from robosmi.query import ancestor_of_kind
from robosmi.transform import Flock, ModelMigration
from robosmi.transformations.m2m.adapter_uses import own_types, target_type
from robosmi.transformations.m2m.edit_rules import RULES, undefine
from robosmi.transformations.m2m.hoisting import HOIST, SPLIT, hoist
from robosmi.transformations.m2m.text_changes import bind_texts, change_texts
from robosmi.transformations.queries.binding_edits import referred
from robosmi.transformations.queries.main_locals import MovedDeclaration
from robosmi.transformations.queries.signature_text import parameter_name, parameter_type, taken_apart
from robosmi.transformations.queries.source_text import SourceText

AND, NEXT, REASONS = "+", ";", "; "
"""Between the rules of a disposition that had several, what they put in, and why."""
_SOURCES = {
    "header": migration.SignatureSource.repository,
    "repository": migration.SignatureSource.repository,
    "program": migration.SignatureSource.program,
    "inferred": migration.SignatureSource.inferred,
}


def rules(f: Flock) -> None:
    """Add the rules; sources are read from beside the first model."""
    folder = f.original.path.parent if f.original.path is not None else Path()

    @cache
    def texts(program: ccode.Program) -> list[SourceText]:
        return [SourceText(unit, _stored(folder / unit.path), ()) for unit in program.units]

    f.delete("Edit", when=lambda e: e.decision is not None)  # made anew from its decision
    f.retype("Edit", "TextChange")
    _platforms(f)
    _adapters(f)

    @f.migrate("Disposition", ignoring=["choice"])
    def _(o: Any, m: migration.Disposition) -> None:
        several = o.rule.split(AND)
        reasons = o.reason.split(REASONS) if len(several) > 1 else [o.reason]
        m.rules.extend(several)
        m.reasons.extend(reasons if len(reasons) == len(several) else [o.reason])
        m.choice = m.action.name
        program = o.eContainer().program
        if program is not None:
            words = o.choice.split(NEXT) if len(several) > 1 else [o.choice]
            pairs = zip(several, words, strict=False)
            why = dict(zip(several, m.reasons, strict=False))
            change_texts(m, [(rule, word, why.get(rule, o.reason)) for rule, word in pairs], texts(program), _RULES)
            if isinstance(m.element, ccode.Variable) and m.rules[0] in (HOIST, SPLIT):
                _hoist(m.element, m, texts(program))

    @f.migrate("LibraryChoice")
    def _(o: Any, m: migration.LibraryChoice) -> None:
        m.included = o.chosen is not None  # whatever was chosen was included

    @f.post
    def targets() -> None:
        plans: list[Any] = [root for root in f.migrated.roots if isinstance(root, migration.MigrationPlan)]
        for plan in plans:
            repository = plan.target.eContainer() if plan.target is not None else None
            described = repository.targets if isinstance(repository, platform.PlatformRepository) else ()
            plan.targetDescription = next((t for t in described if t.board is plan.board), None)
            for binding in plan.portBindings:
                binding.choice = referred(binding) or binding.choice  # then the reference alone counted
            if plan.program is not None:
                bind_texts(plan, texts(plan.program))


_RULES = {**RULES, "platform-include": RULES["standard-include"], "redefine-macro": undefine}
"""What rules did to the text: comments went with includes of the platform, macros of the target gave way to the program's."""


def _hoist(variable: ccode.Variable, verdict: migration.Disposition, texts: Sequence[SourceText]) -> None:
    """Move a local, which is declared alone, as it was moved."""
    statement = variable.eContainer()
    assert isinstance(statement, ccode.DeclarationStatement)
    moved = MovedDeclaration(statement, (variable,), (variable,) if SPLIT in verdict.rules else ())
    hoist(moved, {variable: verdict}, next(text for text in texts if text.unit is ancestor_of_kind(variable, ccode.SourceUnit)))


def _stored(path: Path) -> bytes:
    try:
        return inputs.read_bytes(path, inputs.SOURCE)
    except OSError as error:
        raise SourceError(
            f"the plan's source cannot be read: {error.strerror}",
            location=Location(str(path)),
            fix="keep the models' folder together",
        ) from error


def _adapters(f: Flock) -> None:
    """A signature was a text."""

    @f.migrate("AdapterUse", ignoring=["signatureSource"])
    def _(o: Any, m: migration.AdapterUse) -> None:
        program = o.eContainer().program
        own: Mapping[str, ccode.Declaration] = own_types(program) if program is not None else {}
        returned, name, parameters = taken_apart(o.targetSignature)
        m.targetName, m.result = name or o.name, target_type(returned or "void", own)
        m.parameters.extend(
            migration.AdapterParameter(name=parameter_name(p), valueType=target_type(parameter_type(p), own)) for p in parameters
        )
        m.variadic = o.targetSignature.endswith("...)")
        m.signatureSource = _SOURCES.get(o.signatureSource, migration.SignatureSource.inferred)


def _platforms(f: Flock) -> None:
    """Boards are hardware; what a platform calls them and their pins is the platform's."""

    @f.migrate("PlatformRepository")
    def _(o: Any, m: platform.PlatformRepository) -> None:
        for old in o.platforms:
            for board in old.boards:
                own = f.equivalent(board, platform.Board)
                own.microcontroller = _microcontroller(board)
                m.boards.append(own)
                m.microcontrollers.append(own.microcontroller)
                m.targets.append(_target(f.equivalent(old, platform.Platform), own))

    @f.migrate("Platform")
    def _(o: Any, m: platform.Platform) -> None:
        for board in o.boards:
            named = [pin for pin in board.pins if pin.literal]
            names = [platform.PinName(pin=f.equivalent(pin, platform.Pin), literal=pin.literal) for pin in named]
            now = f.equivalent(board, platform.Board)
            m.boardMappings.append(platform.BoardMapping(board=now, boardId=board.fqbn, pinNames=names))


def _microcontroller(board: Any) -> platform.Microcontroller:
    return platform.Microcontroller(name=board.mcu or board.name, flashBytes=board.flashBytes, ramBytes=board.ramBytes)


def _target(of: platform.Platform, board: platform.Board) -> platform.Target:
    """The one kind of target that there was."""
    return platform.Target(
        name=board.name, platform=of, board=board, generator="arduino_sketch", structure=platform.EntryStructure.setupLoop,
        language="C++", fileSuffix=".ino", moduleSuffix=".cpp", projectFile="sketch.yaml", libraryIndex=of.name,
    )  # fmt: skip


models = ModelMigration(Path(__file__).with_name("metamodels_0_1") / "migration.ecore", rules)
