"""The models of one migration and their storage: a closed set of files in `OUT/models`, with copies of the sources.

`MigrationModels` holds a migration in memory. When stored, references between the files are relative, so the folder can be
moved; when loaded, the digest of every source and model is verified. No transformation runs here.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from msgspec import Struct

from robosmi import inputs
from robosmi.diagnostics import Finding, Location
from robosmi.errors import SourceError
from robosmi.files.files import digest, within
from robosmi.generate.manifest import NAME as MANIFEST
from robosmi.metamodels import ccode, hardware, migration, platform
from robosmi.model.ecore.metamodels import built_in
from robosmi.model.xmi.xmi_locations import XmiLocations
from robosmi.model.xmi.xmi_writer import to_xmi

PLAN, CODE, HARDWARE, PLATFORM = "plan.xmi", "code.xmi", "hardware.xmi", "platform.xmi"
FOLDER = "models"
LAST = ".robosmi/generated"
"""The folder of the last generated texts, beside the models."""
SKETCH_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_]*")
"""The characters allowed in the name of a sketch, and so of its folder and files."""


class MigrationModels(Struct):
    """The models of one migration.

    Attributes:
        plan: the hub.
        program: the code model; paths of units are relative to the models' folder.
        circuit: the hardware model, or None.
        repository: the part of the platform models that the plan refers to.
        files: copies of what was read, path relative to the models' folder -> bytes.
        places: the same paths -> the path as the user knows it.
        notes: findings of the run that made them, which are not the plan's.
        settled: whether a run has stored them as they are, so that nobody can have edited the plan since it was brought in line.
    """

    plan: migration.MigrationPlan
    program: ccode.Program
    circuit: hardware.Circuit | None
    repository: platform.PlatformRepository
    files: dict[str, bytes]
    places: dict[str, str] = {}
    notes: list[Finding] = []
    settled: bool = False
    _places: XmiLocations | None = None

    def _repr_html_(self) -> str:
        from robosmi.model.elements.show import element_html  # for notebooks only

        return element_html(self.plan)

    def to_files(self, unchanged: Mapping[str, bytes] = MappingProxyType({})) -> dict[str, bytes]:
        """Everything that is stored, path relative to the models' folder -> bytes; the plan's digests are brought up to date.

        Args:
            unchanged: models beside the plan that are as they were stored, with these bytes: these are not made again.

        Raises:
            ModelError: a reference leads out of the set.
        """
        roots = {CODE: self.program, PLATFORM: self.repository}
        if self.circuit is not None:
            roots[HARDWARE] = self.circuit
        every = {**roots, PLAN: self.plan}
        places = self._places
        if places is None or places.roots != {id(root): name for name, root in every.items()}:
            places = XmiLocations({name: [root] for name, root in every.items()})
        places.retain(unchanged)
        written = to_xmi(every, [name for name in roots if name not in unchanged], places)
        stored = {name: written[name] if name in written else unchanged[name] for name in roots}
        kinds = {CODE: "code", HARDWARE: "hardware", PLATFORM: "platform"}
        known = {i.path: i for i in self.plan.inputs}
        for name, kind in kinds.items():
            if name in stored:
                if name not in known:
                    known[name] = migration.Input(path=name, kind=kind, digest="0" * 64, origin=name)
                    self.plan.inputs.append(known[name])
                known[name].digest = digest(stored[name])
        files = {**stored, **to_xmi(every, [PLAN], places), **self.files}
        places.retain(unchanged)
        self._places = places
        return files


def load_models(path: Path) -> MigrationModels:
    """Read a stored plan with the models and sources beside it.

    Raises:
        SourceError: a file is missing, is no plan, lies outside of the folder (by a link, too), or does not match its digest.
        ModelError: a model contradicts its metamodel.
    """
    from robosmi.model.versions import read_current  # a migration from sources reads no model

    output = Path(os.path.abspath(path)).parent.parent
    if os.path.lexists(output / MANIFEST):
        _check_inside(path, output)
    folder = Path(os.path.realpath(path)).parent
    found = read_current(path, built_in(), inside=folder)
    roots = {file.name: root for file, root in found.items() if file.parent == folder}
    plan = roots.get(path.name)
    if not isinstance(plan, migration.MigrationPlan):
        kind = type(plan).__name__
        raise SourceError(
            f"this model is a {kind}, not a migration plan", location=Location(str(path)), fix="give the plan.xmi of a migration"
        )
    if not SKETCH_NAME.fullmatch(plan.name):
        raise SourceError(
            f"'{plan.name}' cannot be a sketch's name",
            location=Location(str(path)),
            fix="use letters, digits and underscores in the plan's name",
        )
    files: dict[str, bytes] = {}
    for entry in plan.inputs:
        data = _checked(path, entry)
        if entry.path not in roots:
            files[entry.path] = data
    program, repository = plan.program, _repository(plan)
    if program is None or repository is None or plan.board is None:
        missing = "program" if program is None else "target platform" if repository is None else "target board"
        raise SourceError(f"the plan has no {missing}", location=Location(str(path)), fix="create the plan again with migrate")
    for unit in program.units:
        if unit.path not in files:
            raise SourceError(
                f"the plan has no copy of the source '{unit.path}'",
                location=Location(str(path)),
                fix="create the plan again with migrate",
            )
    places = {name: str(path.parent / name) for name in files}
    return MigrationModels(plan, program, plan.circuit, repository, files, places)


def stored_models(output: Path) -> MigrationModels:
    """Read the plan that an output folder holds, with its models and sources; nothing outside of the folder is read.

    Raises:
        SourceError: the plan lies outside of the folder, by a link, or as for `load_models`.
        ModelError: a model contradicts its metamodel.
    """
    path = output / FOLDER / PLAN
    _check_inside(path, output)
    if not os.path.lexists(output / FOLDER):
        what = "this folder holds no migration" if output.is_dir() else "there is no such folder"
        fix = "give the folder that robosmi migrate ... -o OUT has written"
        raise SourceError(what, location=Location(str(output)), fix=fix)
    from robosmi.model.ecore.xmi_document import NO_MODEL  # a migration from sources reads no model

    try:
        return load_models(path)
    except SourceError as error:
        if error.fix != NO_MODEL:
            raise
        fix = "restore the file (robosmi undo, version control), or create the plan again with migrate"
        raise SourceError(error.message, location=error.location, fix=fix) from error


def _check_inside(path: Path, output: Path) -> None:
    root = os.path.realpath(output)
    if os.path.commonpath([os.path.realpath(path), root]) != root:
        raise SourceError(
            "the plan is outside the output folder, behind a link", location=Location(str(path)),
            fix="copy it and its models into the folder, or create the plan again with migrate",
        )  # fmt: skip


def _checked(path: Path, entry: migration.Input) -> bytes:
    file = path.parent / entry.path
    root = os.path.realpath(path.parent)
    if not within(entry.path) or os.path.commonpath([os.path.realpath(file), root]) != root:
        raise SourceError(
            f"the plan's {entry.kind} is outside its folder",
            location=Location(str(file)),
            fix="copy it into the folder, or create the plan again with migrate",
        )
    try:
        data = inputs.read_bytes(file, inputs.MODEL)
    except OSError as error:
        raise SourceError(
            f"the plan's {entry.kind} cannot be read: {error.strerror}",
            location=Location(str(file)),
            fix="keep the models' folder together",
        ) from error
    if digest(data) != entry.digest:
        raise SourceError(
            f"the plan's {entry.kind} has changed since the plan was created (its digest differs)", location=Location(str(file)),
            fix="restore the original file, or create the plan again with migrate",
        )  # fmt: skip
    return data


def _repository(plan: migration.MigrationPlan) -> platform.PlatformRepository | None:
    root = plan.target.eContainer() if plan.target is not None else None
    return root if isinstance(root, platform.PlatformRepository) else None
