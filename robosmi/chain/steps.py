"""The kinds of steps of a chain, and how each is done: what it reads and makes, and the call of the user's function.

A function gets the language's object first, then the models by their names: `constraints(v, library)`, `pages(g, site)`,
`to_site(t, library, site)`, `to_v2(f, old, new)`. When a step has to be done at all is `run`'s business.
"""

from __future__ import annotations

import inspect
import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import RuleError
from robosmi.generate import Gen
from robosmi.model import save_model
from robosmi.model.driver import Model
from robosmi.model.emf import EmfModel
from robosmi.model.metamodel import Metamodel
from robosmi.model.opening import open_model
from robosmi.query import ModelView
from robosmi.query.erl import place_of, technology
from robosmi.transform import ETL, Flock
from robosmi.validate import EVL

KINDS = ("load", "validate", "transform", "migrate", "generate")


@dataclass(frozen=True)
class Step:
    """A step as it is declared. Paths are absolute.

    Attributes:
        name: its name, of which there is one in the chain.
        kind: one of `KINDS`.
        function: the user's function; None for `load`.
        models: names of the models that it reads.
        makes: name of the model that it makes, "" for none.
        file: the file of that model, None if it stays in memory; for `load` the file that is read.
        metamodel: .ecore files of that model.
        trace: the file of the trace of `transform`, None for none.
        driver: the driver of a model that is loaded; found by the file's ending if None.
        folder: where `generate` writes.
        templates: where its templates are: a folder, or None for the built-in ones.
        reads: further files whose change makes the step run again.
        code: the files that the function comes from.
        greatest: the worst severity of findings with which a `validate` lets the next steps go on.
        place: where it is declared, for errors.
    """

    name: str
    kind: str
    function: Callable[..., Any] | None = None
    models: tuple[str, ...] = ()
    makes: str = ""
    file: Path | None = None
    metamodel: tuple[Path, ...] = ()
    trace: Path | None = None
    driver: str | None = None
    folder: Path | None = None
    templates: Path | None = None
    reads: tuple[Path, ...] = ()
    code: tuple[Path, ...] = ()
    greatest: Severity = Severity.warning

    def inputs(self) -> list[Path]:
        """The files and folders that it reads, but for those of its models."""
        own = [self.file] if self.kind == "load" and self.file is not None else []
        return [*own, *self.metamodel, *([self.templates] if self.templates is not None else []), *self.reads, *self.code]

    def outputs(self) -> list[Path]:
        """The files and folders that it makes."""
        return [*self.stored(), *([self.folder] if self.folder is not None else [])]

    def stored(self) -> list[Path]:
        """The model files that it makes: the model's, and that of its trace."""
        return [path for path in (self.file, self.trace) if path is not None and self.kind != "load"]


@dataclass
class StepResult:
    """What became of a step.

    Attributes:
        step: the step.
        state: `up to date`, `done`, `would run` (in a dry run), `failed` (a validation with findings that stop), `not run`.
        seconds: how long it took.
        findings: what it says; of a step that is up to date what it said when it was done.
        written: files that it wrote, or would write; relative to the chain's folder.
        removed: files that it removed.
        diff: what it changed in text files, a unified diff.
        outputs: every file that it made, changed or not -> its digest.
    """

    step: Step
    state: str
    seconds: float = 0.0
    findings: list[Finding] = field(default_factory=list)
    written: list[str] = field(default_factory=list)
    removed: list[str] = field(default_factory=list)
    diff: str = ""
    outputs: dict[str, str] = field(default_factory=dict)

    def to_json(self) -> dict[str, Any]:
        """The step in the contract's result of `run`."""
        return {
            "name": self.step.name, "kind": self.step.kind, "state": self.state, "seconds": round(self.seconds, 6),
            "written": self.written, "removed": self.removed, "findings": len(self.findings),
        }  # fmt: skip


@dataclass
class Doing:
    """What a step needs while it is done: the models and their files, where paths are relative to, the options of the run."""

    folder: Path
    models: Mapping[str, Model]
    files: Mapping[str, Path | None]
    dry_run: bool
    keep: bool


def load(step: Step, doing: Doing) -> tuple[StepResult, Model]:
    """Read a model."""
    assert step.file is not None
    options = {"metamodel": Metamodel.load(*step.metamodel)} if step.metamodel else {}
    return StepResult(step, "done"), ModelView(open_model(step.file, step.driver, step.makes, **options))


def validate(step: Step, doing: Doing) -> tuple[StepResult, None]:
    """Check constraints; the step fails when a finding is worse than it may be."""
    v = EVL(*doing.models.values())
    call(step, v, doing.models)
    findings = [_located(finding, doing.files) for finding in v.run().findings()]
    failed = any(finding.severity > step.greatest for finding in findings)
    return StepResult(step, "failed" if failed else "done", findings=findings), None


def _located(finding: Finding, files: Mapping[str, Path | None]) -> Finding:
    """The finding with the file of the model that its element is in, where the constraint gives no place."""
    file = files.get((finding.element or "").partition("!")[0])
    return replace(finding, location=Location(str(file))) if file is not None and finding.location is None else finding


def transform(step: Step, doing: Doing) -> tuple[StepResult, Model]:
    """Make a model of others, by ETL or Flock, and save it where it has a file."""
    made = ModelView(EmfModel((), Metamodel.load(*step.metamodel), step.makes))
    models = {**doing.models, step.makes: made}
    module: ETL | Flock = ETL(*models.values()) if step.kind == "transform" else Flock(*list(models.values())[-2:])
    call(step, module, models)
    module.run()
    result = StepResult(step, "done", findings=[Finding("RS530", Severity.warning, text) for text in module.warnings])
    result.written = [relative(path, doing.folder) for path in step.stored()]
    if not doing.dry_run:
        for path in step.stored():
            path.parent.mkdir(parents=True, exist_ok=True)
        if step.file is not None:
            made.save(step.file)
        if step.trace is not None and isinstance(module, ETL):
            files = {**doing.files, step.makes: step.file}
            stored = {relative(path, step.trace.parent): models[name] for name, path in files.items() if path is not None}
            save_model(module.trace.to_model(), step.trace, {p: list(m.roots) for p, m in _of_emf(stored)})
    return result, made


def _of_emf(models: Mapping[str, Model]) -> Iterator[tuple[str, EmfModel]]:
    for name, model in models.items():
        if isinstance(own := technology(model), EmfModel):
            yield name, own


def generate(step: Step, doing: Doing) -> tuple[StepResult, None]:
    """Make the files of a folder."""
    assert step.folder is not None
    g = Gen(step.folder, step.templates, list(doing.models.values()), keep=f".robosmi/{step.name}" if doing.keep else False)
    call(step, g, doing.models)
    made = g.run(dry_run=doing.dry_run)
    root = relative(step.folder, doing.folder)
    result = StepResult(step, "done", findings=made.findings, diff=made.diff())
    result.written = [f"{root}/{name}" for name in made.written]
    result.removed = [f"{root}/{name}" for name in made.removed]
    result.outputs = {f"{root}/{file.name}": "" for file in made.files}
    return result, None


DOES: dict[str, Callable[[Step, Doing], tuple[StepResult, Model | None]]] = {
    "load": load, "validate": validate, "transform": transform, "migrate": transform, "generate": generate,
}  # fmt: skip
"""How each kind is done."""


def call(step: Step, language: Any, models: Mapping[str, Model]) -> None:
    """Call the user's function: the language's object, then the models by name.

    Raises:
        RuleError: it does not take these.
    """
    assert step.function is not None
    try:
        inspect.signature(step.function).bind(language, **models)
    except TypeError as error:
        takes = ", ".join(["the language", *models])
        raise RuleError(
            f"the function of the step '{step.name}' does not fit: {error}",
            location=place_of(step.function),
            fix=f"give it these parameters: {takes}",
        ) from None
    step.function(language, **models)


def relative(path: Path, folder: Path) -> str:
    """A path as the chain writes it."""
    return Path(os.path.relpath(path, folder)).as_posix()
