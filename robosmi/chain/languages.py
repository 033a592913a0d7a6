"""How each kind of step is done: what it reads and makes, and the call of the user's function.

A function gets the language's object first, then the models by their names: `constraints(v, library)`, `pages(g, site)`,
`to_site(t, library, site)`, `to_v2(f, old, new)`; one of values gets these by name alone. When a step has to be done at all is
`run`'s business.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from types import FunctionType
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from robosmi import inputs
from robosmi.chain.steps import Step, StepResult, relative
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import RobosmiError, RuleError
from robosmi.files.files import free_name, write_atomic
from robosmi.generate import Gen
from robosmi.model import save_model
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements.driver import Model
from robosmi.model.elements.ecore import EObject
from robosmi.model.emf import EmfModel
from robosmi.model.session import Session
from robosmi.model.xmi.saved_places import lost_comment_lines, still_roots
from robosmi.model.xmi.xml_comments import lost_comments
from robosmi.query import ModelView
from robosmi.query.rules.rule_language import failed, owner_of, place_of, technology
from robosmi.transform import ETL, Flock
from robosmi.transform.flock_rules import left_out_fix, left_out_text
from robosmi.validate import EVL
from robosmi.validate.findings import ApplicableFix, Unsatisfied, Validation

if TYPE_CHECKING:
    from robosmi.base.functions import Function

Choice = str | Callable[[Unsatisfied], ApplicableFix | None]
"""Which fix of a finding is performed: "first", "last", or a function that chooses one (None for none)."""


class StepContext(Struct):
    """What a step needs while it is done.

    Attributes:
        folder: what paths are relative to.
        models: its models by name.
        files: the files of those that have one.
        made: names of those that another step makes; the rest was loaded from users' files.
        session: in which metamodels are the same for all steps.
        dry_run, keep, fix: the options of the run.
        rewritten: receives a short text for each file of a user's model that a fix has changed.
    """

    folder: Path
    models: Mapping[str, Model]
    files: Mapping[str, Path | None]
    made: frozenset[str]
    session: Session
    dry_run: bool
    keep: bool
    fix: Choice | None = None
    rewritten: list[str] = []


def load(step: Step, doing: StepContext) -> tuple[StepResult, Model]:
    """Read a model."""
    assert step.file is not None
    if step.function is not None:
        made = _opened(step, step.function)
    else:
        options = {"strict": True} if step.strict else {}
        made = doing.session.open_model(step.file, step.driver, step.makes, metamodel=step.metamodel, **options)
    read = sorted(relative(path, doing.folder) for path in made.read_with) if isinstance(made, EmfModel) else []
    return StepResult(step, "done", read=read), ModelView(made)


def _opened(step: Step, driver: Function) -> Model:
    """The model that a driver of the chain's own makes.

    Raises:
        RuleError: it raises, or makes something else.
    """
    init = getattr(driver, "__init__", None)
    code = init if isinstance(init, FunctionType) else driver
    try:
        made = driver(step.file, step.makes)
    except (Exception, SystemExit) as error:
        raise failed(error, f"the driver of the step '{step.name}'", code) from error
    if not isinstance(made, Model):
        raise RuleError(
            f"the driver of the step '{step.name}' gives {made!r:.60}, which is no Model", location=place_of(code),
            fix="let it return a model: a subclass of robosmi.model.driver.Model, or what robosmi.model.open_model gives",
        )  # fmt: skip
    return made


def validate(step: Step, doing: StepContext) -> tuple[StepResult, None]:
    """Check constraints; the step fails when a finding is worse than it may be."""
    result = StepResult(step, "done")
    found = _validated(step, doing)
    reported: list[Finding] = []
    if doing.fix is not None and not doing.dry_run:
        reported = _mend(result, found, doing, doing.fix)
        found = _validated(step, doing) if result.fixed else found
    result.findings = [*reported, *(_located(finding, doing.files) for finding in found.findings())]
    result.state = "failed" if any(finding.severity > step.greatest for finding in result.findings) else "done"
    return result, None


def _validated(step: Step, doing: StepContext) -> Validation:
    v = EVL(*doing.models.values())
    call(step, v, doing.models)
    return v.run()


def _mend(result: StepResult, found: Validation, doing: StepContext, fix: Choice) -> list[Finding]:
    """Perform fixes on elements of models that were loaded, and store the models that changed.

    Returns:
        What could not be mended, and why.
    """
    given = {name: model for name, model in doing.models.items() if name not in doing.made}
    loaded = {name: model for name, model in given.items() if not model.read_only}
    before = {name: _stored(model) for name, model in loaded.items()}
    made = [model for name, model in doing.models.items() if name in doing.made]
    unwritable = [model for model in given.values() if model.read_only]
    reported = []
    left = []
    for models, why, advice in (
        (made, "another step makes the model", "correct the rules of that step"),
        (unwritable, "its model can only be read", "correct what the model is read from"),
    ):
        for u in found.unsatisfied:
            if u.fixes and owner_of(u.element, models) is not None:
                left.append(u)
                message = f"the fix '{u.fixes[0].title}' was not performed: {why}"
                reported.append(Finding("RS532", Severity.info, message, element=found.place(u), fix=advice))

    def choose(unsatisfied: Unsatisfied) -> ApplicableFix | None:
        fixes = unsatisfied.fixes if unsatisfied not in left else []
        return fix(unsatisfied) if callable(fix) and fixes else fixes[0 if fix == "first" else -1] if fixes else None

    found.apply(choose)
    for applied in found.fixed:
        title = f"{found.place(applied.of) or applied.of.name}: {applied.title}"
        if applied.error is None:
            result.fixed.append(title)
        else:
            message = f"the fix was undone: {applied.error.message}"
            reported.append(Finding("RS533", Severity.warning, message, applied.error.location, fix=applied.error.fix))
    for name, model in loaded.items():
        if _stored(model) != before[name]:
            reported += _store(model, doing)
            result.saved.append(name)
            result.written.append(relative(Path(str(model.path)), doing.folder))
    return reported


def _store(model: Model, doing: StepContext) -> list[Finding]:
    """Save a user's model again; an old file with comments, which a model does not contain, is renamed and reported."""
    path = Path(str(model.path))
    old = inputs.read_bytes(path, inputs.MODEL) if path.is_file() else b""
    lost = lost_comment_lines(path, old, _stored(model))
    name = relative(path, doing.folder)
    if not lost:
        model.save()
        doing.rewritten.append(f"'{name}'")
        return []
    backup = free_name(path.parent, f"{path.name}.orig")
    if not isinstance(technology(model), EmfModel):  # which puts the old file there by itself
        write_atomic(path.parent / backup, old)
    model.save()
    doing.rewritten.append(f"'{name}' (the old content is in '{backup}')")
    place = Location(str(path), lost[0])
    return [Finding("RS524", Severity.warning, lost_comments(lost, backup), place, fix="keep such notes outside of the models")]


def _stored(model: Model) -> bytes:
    """The bytes that the model's file would contain."""
    with TemporaryDirectory() as folder:
        copy = Path(folder) / Path(str(model.path)).name
        model.save(copy)
        return inputs.read_bytes(copy, inputs.MODEL)


def _located(finding: Finding, files: Mapping[str, Path | None]) -> Finding:
    """The finding with the file of the model that its element is in, where the constraint gives no place."""
    file = files.get((finding.element or "").partition("!")[0])
    return replace(finding, location=Location(str(file))) if file is not None and finding.location is None else finding


def transform(step: Step, doing: StepContext) -> tuple[StepResult, Model]:
    """Make a model of others, by ETL or Flock, and save it where it has a file."""
    made = ModelView(_new(step, doing))
    models = {**doing.models, step.makes: made}
    module: ETL | Flock = ETL(*models.values()) if step.kind == "transform" else Flock(*list(models.values())[-2:])
    call(step, module, models)
    module.run()
    result = StepResult(step, "done", findings=[Finding("RS530", Severity.warning, text) for text in module.warnings])
    if isinstance(module, Flock) and module.left_out:
        found = Finding("RS530", Severity.warning, left_out_text(module.left_out), fix=left_out_fix(module.left_out))
        result.findings.append(found)
    result.written = [relative(path, doing.folder) for path in step.stored()]
    if not doing.dry_run:
        for path in step.stored():
            path.parent.mkdir(parents=True, exist_ok=True)
        if step.file is not None:
            made.save(step.file)
        if step.trace is not None and isinstance(module, ETL):
            files = {**doing.files, step.makes: step.file}
            stored = {relative(path, step.trace.parent): models[name] for name, path in files.items() if path is not None}
            save_model(module.trace.to_model(), step.trace, _roots_by_file(stored, step.trace.parent))
    return result, made


def _new(step: Step, doing: StepContext) -> Model:
    """The model that a step is to fill."""
    if step.driver == "xml":
        from robosmi.model.plain_xml import XmlModel  # few chains make plain XML

        return XmlModel.new(step.file, step.makes)
    return EmfModel((), doing.session.metamodel(*step.metamodel) if step.metamodel else Metamodel.ecore(), step.makes, step.file)


def _roots_by_file(models: Mapping[str, Model], folder: Path) -> dict[str, list[EObject]]:
    """The root elements of models, and of the files that were read with them, by the files' names seen from a folder."""
    found: dict[str, list[EObject]] = {name: list(model.roots) for name, model in _of_emf(models)}
    taken = {id(root) for roots in found.values() for root in roots}
    for _, model in _of_emf(models):
        for path, roots in model.read_with.items():
            name, others = relative(path, folder), still_roots(roots)
            if name not in found and not any(id(root) in taken for root in others):
                found[name] = others
                taken.update(id(root) for root in others)
    return found


def _of_emf(models: Mapping[str, Model]) -> Iterator[tuple[str, EmfModel]]:
    for name, model in models.items():
        if isinstance(own := technology(model), EmfModel):
            yield name, own


def generate(step: Step, doing: StepContext) -> tuple[StepResult, None]:
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


DOES: dict[str, Callable[[Step, StepContext], tuple[StepResult, Model | None]]] = {
    "load": load, "validate": validate, "transform": transform, "migrate": transform, "generate": generate,
}  # fmt: skip
"""How each kind is done."""


def do(step: Step, doing: StepContext) -> tuple[StepResult, Model | None]:
    """Do a step, and note whether it changed a model that it only reads; what fixes changed is stored, and not meant."""
    read = [model for given in doing.models.values() if isinstance(model := technology(given), EmfModel)]
    for model in read:
        model.touched()
    result, made = DOES[step.kind](step, doing)
    result.changes = not result.saved and any(model.touched() for model in read)
    return result, made


def call(step: Step, language: Any, models: Mapping[str, Model]) -> None:
    """Call the user's function: the language's object, then the models by name.

    Raises:
        RuleError: it raises.
    """
    assert step.function is not None
    try:
        step.function(language, **models)
    except RobosmiError:
        raise
    except (Exception, SystemExit) as error:
        raise failed(error, f"the function of the step '{step.name}'", step.function) from error
