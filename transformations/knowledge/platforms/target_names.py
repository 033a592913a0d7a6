"""The names that a target's core declares, which a program's own names must not clash with.

Those of a platform are in `<platform>/names.json` of the platform repository, those of boards with a certain microcontroller in
`<platform>/names/<microcontroller>.json`. `m2m.partition.renaming` renames the program's names.
"""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from robosmi import inputs, resources
from robosmi.base.data_text import as_table, as_texts, json_of
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError
from robosmi.metamodels import platform
from robosmi.transformations.knowledge.board_models import KIND

KINDS = ("declared", "macros", "same", "absent", "keywords")
"""Functions, variables and types; macros; names with the same meaning; missing standard functions; keywords."""


class TargetNames:
    """The names that a target's core declares, as sets.

    Args:
        names: the model element; None for a target without such names.
    """

    def __init__(self, names: platform.ReservedNames | None) -> None:
        def of(kind: str) -> frozenset[str]:
            return frozenset(getattr(names, kind)) if names is not None else frozenset()

        self.declared, self.macros, self.same, self.absent, self.keywords = (of(kind) for kind in KINDS)
        self.statements: frozenset[str] = frozenset()
        """Words of the statements that stand within the program's text, which no macro of the program may be."""

    def extended(self, declared: frozenset[str], macros: frozenset[str], statements: frozenset[str]) -> TargetNames:
        """A copy extended by the names of other text in the sketch: declarations, macros, and words in statements."""
        made = TargetNames(None)
        made.declared, made.macros = self.declared | declared, self.macros | macros
        made.same, made.absent, made.keywords, made.statements = self.same, self.absent, self.keywords, statements
        return made


def reserved_names(folder: str, project: Path | None) -> platform.ReservedNames:
    """The names of a platform, as a new element.

    Args:
        folder: of the platform in the repository.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: the file is missing or damaged.
    """
    return platform.ReservedNames(**_read_names(resources.find(KIND, f"{folder}/names.json", project), KINDS))


def add_names_of(mcu: str, folder: str, names: platform.ReservedNames, project: Path | None) -> None:
    """Add the names of boards with a certain microcontroller, if there is a file of them.

    Raises:
        PlatformDataError: the file is damaged.
    """
    paths = (each / folder / "names" / f"{mcu}.json" for each in resources.folders(KIND, project))
    path = next((path for path in paths if path.is_file()), None)
    for kind, more in (_read_names(path, ("declared", "macros")) if path is not None else {}).items():
        known = set(getattr(names, kind))
        getattr(names, kind).extend([name for name in more if name not in known])


def _read_names(path: Path, kinds: Collection[str]) -> dict[str, list[str]]:
    """The names of a file by kind.

    Raises:
        PlatformDataError: the file cannot be read, or lacks a kind.
    """
    try:
        data = as_table(json_of(inputs.read_bytes(path, inputs.DATA)))
        return {kind: as_texts(data[kind]) for kind in kinds}
    except (OSError, ValueError, KeyError) as error:
        raise PlatformDataError(
            f"the names cannot be read: {error}", location=Location(str(path)), fix="correct the file"
        ) from error
