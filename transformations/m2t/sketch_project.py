"""`sketch.yaml`: board and libraries with their versions (Arduino CLI, sketch project file)."""

from __future__ import annotations

from robosmi.generate.environment import render
from robosmi.generate.text import GeneratedFile
from robosmi.metamodels import migration


def sketch_yaml(plan: migration.MigrationPlan) -> GeneratedFile:
    """The sketch's project file: its board, its core, the chosen libraries and all that they depend on."""
    file = GeneratedFile(f"{plan.name}/sketch.yaml")
    assert plan.board is not None
    assert plan.target is not None
    versions = {library.name: library.version for library in plan.target.libraries}
    chosen = [c.chosen for c in plan.libraryChoices if c.chosen is not None]
    names = dict.fromkeys(name for library in chosen for name in (library.name, *library.depends))
    platform = ":".join(plan.board.fqbn.split(":")[:2])  # arduino:avr of arduino:avr:uno
    listed = [f"{name} ({versions[name]})" if versions.get(name) else name for name in names]
    text = render(
        "arduino/sketch.yaml.j2",
        board=plan.board.name,
        fqbn=plan.board.fqbn,
        platform=platform,
        core=plan.target.coreVersion,
        libraries=listed,
    )
    file.add(text, "libraries", "sketch project", [plan.board, *chosen])
    return file
