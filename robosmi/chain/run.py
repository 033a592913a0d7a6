"""One run of a chain: decides which steps to do, holds the models between them, and remembers the results.

A step is up to date if the digest of its inputs equals that of its last run and its outputs still exist. A model is read or
made only when a step needs it. A run stays usable: read a value, set another one (`give`), read again; then only what
depends on it is done again. A recomputed value that equals the old one counts as unchanged.

The value of a function that replaces a step must have the type that the function's annotation promises. Only the type itself
and the members of tuples and unions are checked, not the contents of lists and mappings.

`State` is the memory of a chain between runs: for each step the digests of its inputs and outputs, and its findings. It is
stored in `.robosmi/chains` in the chain's folder. You can delete it at any time; then every step runs again.
"""

from __future__ import annotations

import hashlib
import os
import time
import types
import typing
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, overload

from msgspec import Struct
from msgspec.structs import asdict

import robosmi
from robosmi import inputs
from robosmi.base.data_text import as_list, as_table, as_text, as_whole, json_of, json_written
from robosmi.base.quantities import quantity
from robosmi.chain.graph import Dependencies
from robosmi.chain.steps import CALL, GIVEN, Step, StepResult, relative
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import RobosmiError, RuleError, SourceError, StoppedError, did_you_mean
from robosmi.files.files import digest, free_name, write_atomic
from robosmi.plugins import raised_by, unloadable

if TYPE_CHECKING:
    from robosmi.base.data_text import Json
    from robosmi.base.functions import Function
    from robosmi.chain.languages import Choice, StepContext  # all languages
    from robosmi.model.elements.dynamic import Dynamic
    from robosmi.model.session import Session

T = TypeVar("T")
V = TypeVar("V")
Progress = Callable[[Step, StepResult | None], None]
"""Called for each step: without a result before it is done, with its result afterwards."""

_SCHEMA = "robosmi-chain/1"


class ChainResult(Struct):
    """The result of a run.

    Attributes:
        steps: the results of the steps, in order.
        seconds: the total duration.
    """

    steps: list[StepResult] = []
    seconds: float = 0.0

    def __getitem__(self, name: str) -> StepResult:
        return {result.step.name: result for result in self.steps}[name]

    @property
    def findings(self) -> list[Finding]:
        """The findings of all steps."""
        return [finding for result in self.steps for finding in result.findings]

    def diff(self) -> str:
        """The changes of generated files as a unified diff."""
        return "".join(result.diff for result in self.steps)

    def text(self) -> str:
        """A line for each step: its state, name, duration, and the files it wrote."""
        wide = max((len(r.step.name) for r in self.steps), default=0)
        lines = []
        for r in self.steps:
            wrote = f"  {len(r.written)} written" if r.written else ""
            wrote += f"  {len(r.removed)} removed" if r.removed else ""
            wrote += f"  {len(r.fixed)} fixed" if r.fixed else ""
            wrote += f"  {quantity(len(r.findings), 'finding')}" if r.findings else ""
            lines.append(f"{r.state:11} {r.step.kind:9} {r.step.name:{wide}} {r.seconds * 1000:8.1f} ms{wrote}")
        return "\n".join(lines)


class ChainRun:
    """One run of a chain.

    Args:
        ordered: the steps, each after those it depends on.
        graph: what depends on what.
        folder: what paths are relative to; None where there are values only.
        name: the chain's name, under which its state is stored.
        dry_run: write nothing.
        keep: keep users' edits of generated files outside of regions too.
        force: run every step; a stored model with a user's edits is made again, and theirs becomes `NAME.orig`.
        fix: perform this fix of every finding of a validation, and store the models that it changes; see `Validation.apply`.
        progress: called with each step that has run.
    """

    def __init__(
        self,
        ordered: list[Step],
        graph: Dependencies,
        folder: Path | None,
        name: str,
        *,
        dry_run: bool = False,
        keep: bool = True,
        force: bool = False,
        fix: Choice | None = None,
        progress: Progress | None = None,
    ) -> None:
        self.ordered, self.graph, self.folder = ordered, graph, folder if folder is not None else Path()
        self.name = name
        self.dry_run, self.keep, self.force, self.fix, self.progress = dry_run, keep, force, fix, progress
        self.state = State(folder / ".robosmi" / "chains" / f"{name}.json" if folder is not None else None)
        self.makers = {step.makes: step for step in ordered if step.makes}
        self.models: dict[str, Any] = {}
        self.content: dict[str, str] = {}
        self.stopped: set[str] = set()
        self.rewritten: list[str] = []
        self._told = 0
        self._session: Session | None = None

    # Values

    def give(self, **values: V) -> None:
        """Set values that are given from outside; steps that depend on a changed one are done again when needed.

        Raises:
            SourceError: the chain has no such value.
        """
        for name, value in values.items():
            if name not in self.makers or self.makers[name].kind != GIVEN:
                known = [step.makes for step in self.ordered if step.kind == GIVEN]
                fix = f"use one of: {', '.join(known) or 'the chain needs none'}"
                raise SourceError(f"the chain asks for no value '{name}'{did_you_mean(name, known)}", fix=fix)
            self._set(name, value)

    @overload
    def value(self, name: str) -> Dynamic: ...
    @overload
    def value(self, name: str, kind: type[T]) -> T: ...
    def value(self, name: str, kind: type[T] | None = None) -> Dynamic | T:
        """A model or value, once the steps that it needs are done or up to date.

        Args:
            name: of the model or value.
            kind: the class that it is of, for type checkers and readers; checked against the value.

        Raises:
            SourceError: no step makes it, or a value that it needs was not given; and what the steps raise.
            RuleError: what was made is not of the class.
        """
        if name not in self.makers:
            raise SourceError(f"no step makes '{name}'{did_you_mean(name, self.makers)}", fix="ask for what a step makes")
        self.run([name])
        made = self.model(name)
        if kind is not None and not isinstance(made, kind):
            raise RuleError(
                f"the step of '{name}' made {described(made)}; expected is {named(kind)}",
                fix=f"return {named(kind)}, or ask for the value without a class",
            )
        return made

    def _set(self, name: str, value: Any) -> None:
        """Store a value; digests of later steps use a new number for it, or its `repr` if the state outlives the run."""
        if name in self.models and (self.models[name] is value or _same_value(self.models[name], value)):
            return
        self._told += 1
        self.models[name] = value
        self.content[name] = f"value {self._told}" if self.state.path is None else f"value {value!r}"

    # Steps

    def run(self, goals: Iterable[str] | None = None) -> ChainResult:
        """Do the steps that have to be done.

        Args:
            goals: names of the models and values to make; None for everything.
        """
        begun = time.perf_counter()
        self.stopped.clear()
        self.rewritten.clear()
        self._renew()
        results = []
        known = {step.name for step in self.ordered}
        needed = None if goals is None else self.graph.needed(f"model {name}" for name in goals)
        self.state.steps = {name: entry for name, entry in self.state.steps.items() if name in known}
        try:
            for step in self.ordered:
                if step.kind == GIVEN:
                    self._check_given(step, needed)
                elif needed is None or f"step {step.name}" in needed:
                    start = time.perf_counter()
                    result = self.step(step)
                    result.seconds = time.perf_counter() - start
                    results.append(result)
        except RobosmiError as error:
            if self.rewritten:
                error.message += f"; fixes of a step before it had changed {', '.join(self.rewritten)}, which stays"
            raise
        finally:
            if not self.dry_run:
                self.state.save()  # of what was done, also where a later step fails
        return ChainResult(results, time.perf_counter() - begun)

    def _check_given(self, step: Step, needed: set[str] | None) -> None:
        if step.makes not in self.models and (needed is None or f"step {step.name}" in needed):
            raise SourceError(f"the value '{step.makes}' was not given", fix=f"give it: {step.makes}=...")

    def step(self, step: Step) -> StepResult:
        """Do a step if it has to be done."""
        if self.stopped & set(step.models):
            self.stopped |= {step.makes} - {""}
            return StepResult(step, "not run")
        inputs = self.inputs(step)
        if step.kind != CALL or self.state.path is not None:
            self.content[step.makes] = inputs
        known = self.state.steps.get(step.name)
        mending = self.fix is not None and step.kind == "validate" and known is not None and bool(known.findings)
        again = self.force or mending or (known is not None and known.changes)
        if known is not None and not again and known.inputs == inputs and self.intact(step, known):
            result = StepResult(step, "up to date", findings=[_finding_from(f) for f in known.findings], outputs=known.outputs)
            result.state = "failed" if known.failed else result.state
        else:
            kept = self.guard(step, known)
            if known is not None and known.outputs and not self.dry_run:
                known.outputs = {}
                self.state.save()  # who is killed now must not find his own file changed
            if self.progress is not None:
                self.progress(step, None)
            result = self._done(step)
            result.findings[:0] = kept
            if result.saved:
                self._stored(result.saved)
                inputs = self.inputs(step)
            if self.progress is not None:
                self.progress(step, result)
            self.remember(step, inputs, result)
            if result.read and not self.dry_run:  # which files they are is known only now
                self.content[step.makes] = self.state.steps[step.name].inputs = self.inputs(step)
        if result.state == "failed":
            self.stopped |= set(step.models)
        if step.kind != "load" and step.makes and step.file is not None and result.state in ("done", "up to date"):
            files = (step.file, *step.metamodel_files())  # the same model again changes nothing after it
            self.content[step.makes] = _digest_of_all((str(n), _digest_of(path)) for n, path in enumerate(files))
        return result

    def inputs(self, step: Step) -> str:
        """The digest of all inputs of a step."""
        settings = [robosmi.__version__, step.kind, step.makes, str(step.driver), step.greatest.name, str(step.strict)]
        parts = [("step", "\0".join(settings)), ("keep", str(self.keep and step.kind == "generate"))]
        parts += [(f"output {relative(p, self.folder)}", "") for p in step.outputs()]
        parts += [(f"file {relative(p, self.folder)}", _digest_of(p)) for p in step.inputs()]
        if step.kind == "load" and (known := self.state.steps.get(step.name)) is not None:
            parts += [(f"file {name}", _digest_of(self.folder / name)) for name in known.read]
        parts += [(f"model {name}", self.content[name]) for name in step.models]
        if step.kind == "load" and step.function is None and step.file is not None:
            from robosmi.model.opening import code_of_driver  # a chain of functions loads nothing

            parts += [(f"driver {path}", _digest_of(path)) for path in code_of_driver(step.file, step.driver)]
        return _digest_of_all(parts)

    def intact(self, step: Step, known: StepState) -> bool:
        """Whether a step's outputs still exist unchanged."""
        if step.kind == CALL and self.state.path is None:
            return step.makes in self.models
        if step.kind == "load" or (step.makes and step.file is None):
            return True  # nothing but a model in memory, which is made when it is needed
        return all(_digest_of(self.folder / name) == value for name, value in known.outputs.items())

    def _stored(self, names: Iterable[str]) -> None:
        """Update the digests of loaded models that were written again, so that they do not count as changed."""
        for name in names:
            maker = self.makers[name]
            self.content[name] = self.inputs(maker)
            if (known := self.state.steps.get(maker.name)) is not None:
                known.inputs = self.content[name]

    def guard(self, step: Step, known: StepState | None) -> list[Finding]:
        """Make sure that a stored model changed by hand is not overwritten; with `force` it becomes NAME.orig.

        Raises:
            StoppedError: it would be lost.
        """
        reported = []
        for path in step.stored() if known is not None else []:
            name = relative(path, self.folder)
            if path.is_file() and known is not None and known.outputs.get(name) not in (None, _digest_of(path)):
                if self.force:
                    kept = free_name(self.folder, f"{name}.orig")
                    if not self.dry_run:
                        write_atomic(self.folder / kept, inputs.read_bytes(path, inputs.MODEL))
                    message = f"'{name}' was changed since the step '{step.name}' made it; the old content is in '{kept}'"
                    reported.append(Finding("RS531", Severity.info, message, Location(str(path)), fix="take over what you need"))
                    continue
                raise StoppedError(
                    f"'{name}' was changed since the step '{step.name}' made it: writing would lose that",
                    location=Location(str(path)),
                    fix="move it away, let another step read it, or run with --force, which renames it to NAME.orig",
                )
        return reported

    def _done(self, step: Step) -> StepResult:
        """Do a step; if its code ends the program, that is an error of the step, whatever exit code it names."""
        try:
            return self.do(step)
        except (SystemExit, RobosmiError) as error:
            from robosmi.query.rules.rule_language import failed, with_place

            what = f"the step '{step.name}'"
            if isinstance(error, RobosmiError):
                if step.function is not None and step.kind != CALL:
                    with_place(error, what, step.function)
                raise
            raise unloadable(error) or raised_by(error) or failed(error, what, step.function or self._done) from error

    def do(self, step: Step) -> StepResult:
        """Do a step, with the models that it needs."""
        models = {name: self.model(name) for name in step.models}
        if step.kind == CALL:
            made = self._called(step, models)
            if self.state.path is None:
                self._set(step.makes, made)
            else:
                self.models[step.makes] = made
            return StepResult(step, "done")
        from robosmi.chain.languages import do  # all languages at once, which a chain of functions does not need

        files = {name: self.makers[name].file for name in step.models}
        result, made = do(step, self._doing(models, files))
        if made is not None:
            self.models[step.makes] = made
        if self.dry_run and result.state == "done":
            result.state = "would run"
        return result

    def _doing(self, models: dict[str, Any], files: dict[str, Path | None]) -> StepContext:
        from robosmi.chain.languages import StepContext

        made = frozenset(name for name in models if self.makers[name].kind != "load")
        return StepContext(self.folder, models, files, made, self.session, self.dry_run, self.keep, self.fix, self.rewritten)

    @property
    def session(self) -> Session:
        """The session in which metamodels are shared by all steps of the run."""
        if self._session is None:
            from robosmi.model.session import Session

            self._session = Session()
        return self._session

    def _renew(self) -> None:
        """Forget the models of a run if a metamodel has changed, since their classes are those of the old one."""
        if self._session is not None and self._session.changed() is not None:
            self._session = None
            self.models = {name: made for name, made in self.models.items() if self.makers[name].kind in (CALL, GIVEN)}

    def _called(self, step: Step, models: dict[str, Any]) -> Any:
        """Call a step's function; returns its value.

        Raises:
            RuleError: a replaced function (of this step or one before it) fails or returns a value of another type.
        """
        assert step.function is not None
        own = [s for s in self.ordered if s.instead_of is not None]
        try:
            made = step.function(**models)
        except RobosmiError:
            raise
        except Exception as error:
            before = self.graph.needed([f"model {step.makes}"]) if own else set()
            replaced = [s for s in own if f"step {s.name}" in before]
            if not replaced:
                raise
            named = [f"'{s.name}'" for s in replaced]
            from robosmi.query.rules.rule_language import failed

            what = f"the step '{step.name}' of the chain '{self.name}', in which {' and '.join(named)} was replaced,"
            raise failed(error, what, step.function, owner=replaced[0].function) from error
        if step.instead_of is not None and (expected := unlike(made, step.instead_of)):
            from robosmi.query.rules.rule_language import place_of

            first = f"{step.instead_of.__module__}.{getattr(step.instead_of, '__qualname__', '')}"
            raise RuleError(
                f"the function in the place of the step '{step.name}' made {described(made)} for '{step.makes}'; "
                f"expected is {expected}",
                location=place_of(step.function), fix=f"return what {first} returns",
            )  # fmt: skip
        return made

    def model(self, name: str) -> Dynamic:
        """A model or value, made by its step or read from the file that the step has made."""
        if name not in self.models:
            maker = self.makers[name]
            if maker.kind != "load" and maker.file is not None and maker.file.is_file():
                maker = Step(maker.name, "load", makes=name, file=maker.file, metamodel=maker.metamodel, driver=maker.driver)
            self.do(maker)
        made: Dynamic = self.models[name]
        return made

    def remember(self, step: Step, inputs: str, result: StepResult) -> None:
        """Store a step's input digest, its outputs and its findings in the state."""
        if self.dry_run:
            return
        result.outputs |= {relative(path, self.folder): "" for path in step.stored()}
        result.outputs = {name: _digest_of(self.folder / name) for name in result.outputs}
        findings = [finding.to_json() for finding in result.findings]
        self.state.steps[step.name] = StepState(
            inputs, result.outputs, findings, result.state == "failed", result.changes, result.read
        )


# ---- the type of a step's value


def unlike(value: Any, function: Function) -> str:
    """The type that a function promises to return, in words, if a value does not have it; else an empty text.

    Args:
        value: what was made.
        function: the function with the expected return annotation; one without an annotation expects anything.
    """
    try:
        expected = typing.get_type_hints(function).get("return", Any)
    except (NameError, TypeError, AttributeError):  # of a name that only type checkers import
        return ""
    return "" if _fits(value, expected) else named(expected)


def _fits(value: Any, expected: Any) -> bool:
    origin, members = typing.get_origin(expected), typing.get_args(expected)
    if origin in (typing.Union, types.UnionType):
        return any(_fits(value, member) for member in members)
    if origin is tuple and members and members[-1] is not Ellipsis:
        fits = isinstance(value, tuple) and len(value) == len(members)
        return fits and all(_fits(part, member) for part, member in zip(value, members, strict=True))
    kind = origin or expected
    if kind is None:
        return value is None
    return not isinstance(kind, type) or getattr(kind, "_is_protocol", False) or isinstance(value, kind)


def named(expected: Any) -> str:
    """A type as users write it: `list[PortBinding]`, `StoredDrawing or None`."""
    origin, members = typing.get_origin(expected), typing.get_args(expected)
    if origin in (typing.Union, types.UnionType):
        return " or ".join(named(member) for member in members)
    if expected is type(None) or expected is None:
        return "None"
    name = getattr(origin or expected, "__name__", str(expected))
    return f"{name}[{', '.join('...' if m is Ellipsis else named(m) for m in members)}]" if members else name


def described(value: Any) -> str:
    """A value described by its type: `None`, `a tuple of 2 (list, str)`, `an int`."""
    if value is None:
        return "None"
    name = type(value).__name__
    members = f" of {len(value)} ({', '.join(type(part).__name__ for part in value)})" if isinstance(value, tuple) else ""
    return f"{'an' if name[0].lower() in 'aeiou' else 'a'} {name}{members}"


class StepState(Struct):
    """A step's last run: digest of its inputs, outputs with their digests, findings; whether it changed a model that it reads.

    Of a loaded model: the files that were read with it.
    """

    inputs: str
    outputs: dict[str, str] = {}
    findings: list[dict[str, Json]] = []
    failed: bool = False
    changes: bool = False
    read: list[str] = []


class State:
    """The memory of a chain.

    Args:
        path: its file, which need not be there yet; None to remember nothing longer than the run lives.
    """

    def __init__(self, path: Path | None) -> None:
        self.path = path
        self.steps: dict[str, StepState] = {}
        if path is not None and path.is_file():
            try:
                data = as_table(json_of(inputs.read_text(path, inputs.RECORD)))
                if data["schema"] == _SCHEMA:
                    self.steps = {name: _step_from(as_table(entry)) for name, entry in as_table(data["steps"]).items()}
            except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
                raise SourceError(
                    f"the record of the last run cannot be read: {error}",
                    location=Location(str(path)),
                    fix="remove it; then every step is done again",
                ) from error

    def save(self) -> None:
        """Write the state atomically, unless nothing changed or nothing is to be remembered."""
        if self.path is None:
            return
        steps = {name: asdict(entry) for name, entry in self.steps.items()}
        data = (json_written({"schema": _SCHEMA, "steps": steps}, indent=1, sort_keys=True) + "\n").encode()
        if inputs.read_bytes(self.path, inputs.RECORD) != data if self.path.is_file() else bool(steps):
            write_atomic(self.path, data)


def _step_from(entry: dict[str, Json]) -> StepState:
    outputs = {name: as_text(made) for name, made in as_table(entry["outputs"]).items()}
    findings = [as_table(finding) for finding in as_list(entry["findings"])]
    read = [as_text(name) for name in as_list(entry.get("read", []))]
    return StepState(as_text(entry["inputs"]), outputs, findings, bool(entry["failed"]), bool(entry.get("changes")), read)


def _digest_of(path: Path) -> str:
    """The digest of a file, or of a folder's files and their names; "" if there is nothing."""
    if path.is_file():
        return digest(inputs.read_bytes(path, inputs.OUTPUT))
    if not path.is_dir():
        return ""
    found = hashlib.sha256()
    for folder, folders, files in sorted(os.walk(path)):
        folders[:] = [name for name in folders if not name.startswith((".", "__pycache__"))]
        for name in sorted(files):
            file = Path(folder, name)
            found.update(f"{file.relative_to(path).as_posix()}\0".encode())
            found.update(digest(inputs.read_bytes(file, inputs.OUTPUT)).encode())
    return found.hexdigest()


def _digest_of_all(parts: Iterable[tuple[str, str]]) -> str:
    """A single digest of named digests."""
    return digest("\n".join(f"{name}\0{value}" for name, value in parts).encode())


def _finding_from(data: dict[str, Json]) -> Finding:
    """A finding restored from the state."""

    def text(key: str) -> str | None:
        return None if data[key] is None else as_text(data[key])

    place = _location_from(as_table(data["location"])) if data["location"] else None
    message, evidence = as_text(data["message"]), as_table(data["evidence"])
    level = Severity[as_text(data["severity"])]
    return Finding(as_text(data["rule"]), level, message, place, text("element"), text("fix"), evidence)


def _location_from(data: dict[str, Json]) -> Location:
    numbers = {key: None if value is None else as_whole(value) for key, value in data.items() if key != "path"}
    return Location(as_text(data["path"]), **numbers)


def _same_value(one: object, other: object) -> bool:
    """Whether two values are equal; those that cannot be compared are not."""
    try:
        return one.__class__ is other.__class__ and bool(one == other)
    except (TypeError, ValueError):
        return False
