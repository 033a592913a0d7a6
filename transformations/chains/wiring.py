"""The chain `wiring`: exports the wiring planned by a migration for another tool, as a table, or as a picture.

It reads the plan, the models beside it, and the current sketch. Formats are registered (`wiring form`): functions that return
files, or a single file.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from msgspec import Struct

from robosmi import __version__, inputs
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError, StoppedError
from robosmi.files.commit import update
from robosmi.files.files import refuse_link, write_atomic
from robosmi.generate.output_paths import Places
from robosmi.metamodels import migration
from robosmi.plugins import content
from robosmi.project import Project
from robosmi.query import Q
from robosmi.transformations.chains.stages.models import MigrationModels, stored_models
from robosmi.transformations.chains.stages.sources import project_of_output
from robosmi.transformations.knowledge.electrical_facts import rests_beyond_names
from robosmi.transformations.m2m.circuits.wokwi_wiring import WITH_DRAWING, no_drawing, wokwi_wiring
from robosmi.transformations.m2t.circuits.circuit_picture import plan_svg
from robosmi.transformations.m2t.pin_table import pin_table
from robosmi.transformations.m2t.sketch_project import project, project_files
from robosmi.transformations.queries.circuits.electrical import fed_parts
from robosmi.transformations.queries.plans.plan import as_findings

FORM: Final = "wiring form"
"""The registry's kind for formats: functions of `(models, OUT, path)` that return `Handed`."""


class Handed(Struct):
    """A wiring exported in one format: a pin table, a picture or a folder for a simulator.

    Attributes:
        files: relative path -> bytes; a single file has an empty path.
        kinds: relative path -> kind of artifact.
        findings: what could not be exported, with what to do.
        result: further facts, JSON values.
        written: the paths of the files, each with its kind.
        project: the project file that judges the findings.
    """

    files: Mapping[str, bytes]
    kinds: Mapping[str, str]
    findings: list[Finding] = []
    result: dict[str, Any] = {}
    written: list[tuple[Path, str]] = []
    project: Project = Project()

    def artifacts(self) -> list[dict[str, str]]:
        """The files, as the contract lists them."""
        return [{"path": str(path), "kind": kind} for path, kind in self.written]


def wiring(output: Path, form: str, path: Path) -> Handed:
    """Write the wiring of a migration.

    Args:
        output: the output folder of `migrate` or `generate`.
        form: name of a registered form.
        path: where to: a file, or a folder, as the form is.

    Raises:
        SourceError: there is no plan, it has no drawing, or the form cannot say it.
        StoppedError: a file in the folder is there already and is another, or is a link.
    """
    models = stored_models(output)
    project_file = project_of_output(output, models.plan)
    made: Handed = content(FORM, form)(models, output, path)
    if "" in made.files:
        _check_free(path.parent, {path.name: made.files[""]})
        write_atomic(path, made.files[""])
    else:
        if Path(os.path.realpath(path)).is_relative_to(os.path.realpath(output)):
            raise SourceError(
                "the project would be inside the migration's output folder",
                location=Location(str(path)), fix="give a folder next to it: -o PATH",
            )  # fmt: skip
        _check_free(path, made.files)
        update(path, made.files)
    made.project = project_file
    made.written = [(path / name if name else path, made.kinds[name]) for name in made.files]
    return made


def _check_free(folder: Path, files: Mapping[str, bytes]) -> None:
    """Make sure that no file that the user may have edited, and no link, is overwritten."""
    for name, data in files.items():
        refuse_link(folder / name)
        try:
            there = inputs.read_bytes(folder / name, inputs.OUTPUT)
        except FileNotFoundError:
            continue
        except OSError as error:
            raise SourceError(
                f"the wiring cannot be written here: {error.strerror}", location=Location(str(folder / name))
            ) from error
        if there != data:
            fix = "give another folder with -o, or move the file"
            raise StoppedError("another file of that name exists", location=Location(str(folder / name)), fix=fix)


# ---- forms


def wokwi(models: MigrationModels, output: Path, path: Path) -> Handed:
    """Export a folder for the Wokwi simulator: diagram, sketch, libraries; parts that Wokwi lacks are listed."""
    plan = models.plan
    drawn = wokwi_wiring(plan)
    source = Location(str(path))
    findings = [
        Finding("RS536", Severity.warning, f"not in the diagram: {line}", source, fix="wire it by hand; Wokwi does not have it")
        for line in drawn.listed()
    ]
    if drawn.added:
        message = f"{drawn.added} wires to supply and ground added; the pin table does not list them"
        findings.append(Finding("RS537", Severity.info, message, source))
    if drawn.loose:
        message = f"only one wire in the diagram: {', '.join(drawn.loose)}; the pin table does not list their other connections"
        fix = "wire them in Wokwi; connect a button that reads high when pressed to the supply, with a resistor to ground"
        findings.append(Finding("RS538", Severity.warning, message, source, fix=fix))
    sketch = _sketch(output, plan.name)
    files = project_files(drawn, sketch, project(plan)["libraries"], drawn.listed(), f"RoboSMi {__version__}")
    kinds = {name: "sketch" if name in sketch or name.endswith(".ino") else "wiring" for name in files}
    result = {
        "drawn": [{"id": part.identity, "type": part.kind} for part in drawn.parts],
        "not_drawn": [
            {"component": p.title, "model_index": p.identity, "part": p.part, "pins": [*p.pins], "why": p.why}
            for p in drawn.not_drawn
        ],
    }
    return Handed(files, kinds, findings, result)


def _sketch(output: Path, name: str) -> dict[str, bytes]:
    """The current files of the sketch; links are refused."""
    place, places = Location(str(output / name)), Places(output)
    try:
        places.check_inside(name)
        files = [file.name for file in sorted((output / name).iterdir()) if file.is_file()]
        return {file: places.read(f"{name}/{file}") or b"" for file in files}
    except OSError as error:
        raise SourceError(
            f"the sketch cannot be read: {error.strerror}", location=place, fix="generate it again: robosmi generate"
        ) from error


def csv(models: MigrationModels, output: Path, path: Path) -> Handed:
    """Export the pin table, which can be read as a drawing again."""
    plan = models.plan
    connections, board = _connections(plan), plan.board.name if plan.board is not None else ""
    circuit = plan.circuit
    rests, volts = (rests_beyond_names(circuit.components), fed_parts(circuit)) if circuit is not None else ({}, {})
    text = pin_table(connections, board, path.with_suffix(".csv"), rests, volts)
    return Handed({"": text.encode()}, {"": "pin table"})


def picture(models: MigrationModels, output: Path, path: Path) -> Handed:
    """Export the picture (SVG), with the source's ports at their pins and the faults at their places.

    Without a drawing it shows what the program uses, and a finding says so.
    """
    plan = models.plan
    wrong = [f for f in as_findings(Q(plan.findings), models.places) if f.rule.startswith("RS2")]
    text = plan_svg(plan, wrong)
    if not text:
        raise no_drawing()
    findings = []
    if plan.circuit is None:
        message = "no drawing given: the picture shows the ports of the program, without supplies and passive parts"
        findings.append(Finding("RS210", Severity.info, message, Location(str(path)), fix=WITH_DRAWING))
    return Handed({"": text.encode()}, {"": "picture"}, findings)


def _connections(plan: migration.MigrationPlan) -> Sequence[migration.Connection]:
    if plan.circuit is None:
        raise no_drawing()
    return list(plan.connections)
