"""One run of a chain: which steps have to be done, the models between them, and what is remembered of it.

A step is up to date when the digest of all that it reads is the one of its last run, and what it made is still there. A model
is read or made only when a step needs it.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from pathlib import Path

import robosmi
from robosmi.chain.state import State, StepState, digest_of, digest_of_all, finding_from
from robosmi.chain.steps import DOES, Doing, Step, StepResult, relative
from robosmi.diagnostics import Finding, Location
from robosmi.errors import StoppedError
from robosmi.model.driver import Model


@dataclass
class ChainResult:
    """What a run did.

    Attributes:
        steps: the steps in the order in which they were looked at.
        seconds: how long all took.
    """

    steps: list[StepResult] = field(default_factory=list)
    seconds: float = 0.0

    def __getitem__(self, name: str) -> StepResult:
        return {result.step.name: result for result in self.steps}[name]

    @property
    def findings(self) -> list[Finding]:
        """What all steps say."""
        return [finding for result in self.steps for finding in result.findings]

    def diff(self) -> str:
        """What changed in generated files, a unified diff."""
        return "".join(result.diff for result in self.steps)

    def text(self) -> str:
        """A line for each step: its state, its name, its time, what it wrote."""
        wide = max((len(r.step.name) for r in self.steps), default=0)
        lines = []
        for r in self.steps:
            wrote = f"  {len(r.written)} written" if r.written else ""
            wrote += f"  {len(r.removed)} removed" if r.removed else ""
            wrote += f"  {len(r.findings)} findings" if r.findings else ""
            lines.append(f"{r.state:11} {r.step.kind:9} {r.step.name:{wide}} {r.seconds * 1000:8.1f} ms{wrote}")
        return "\n".join(lines)


class Run:
    """One run of a chain.

    Args:
        ordered: the steps, each behind those it depends on.
        folder: what paths are relative to.
        name: the chain's name, under which its state is kept.
        dry_run: write nothing.
        keep: keep what persons changed in generated files outside of regions too.
        force: do every step.
    """

    def __init__(self, ordered: list[Step], folder: Path, name: str, *, dry_run: bool, keep: bool, force: bool) -> None:
        self.ordered, self.folder = ordered, folder
        self.dry_run, self.keep, self.force = dry_run, keep, force
        self.state = State(folder / ".robosmi" / "chains" / f"{name}.json")
        self.makers = {step.makes: step for step in ordered if step.makes}
        self.models: dict[str, Model] = {}
        self.content: dict[str, str] = {}
        self.stopped: set[str] = set()

    def run(self) -> ChainResult:
        """Do the steps that have to be done."""
        begun = time.perf_counter()
        results = []
        known = {step.name for step in self.ordered}
        self.state.steps = {name: entry for name, entry in self.state.steps.items() if name in known}
        try:
            for step in self.ordered:
                start = time.perf_counter()
                result = self.step(step)
                result.seconds = time.perf_counter() - start
                results.append(result)
        finally:
            if not self.dry_run:
                self.state.save()  # of what was done, also where a later step fails
        return ChainResult(results, time.perf_counter() - begun)

    def step(self, step: Step) -> StepResult:
        """Do a step if it has to be done."""
        if self.stopped & set(step.models):
            self.stopped |= {step.makes} - {""}
            return StepResult(step, "not run")
        inputs = self.inputs(step)
        self.content[step.makes] = inputs
        known = self.state.steps.get(step.name)
        if known is not None and not self.force and known.inputs == inputs and self.intact(step, known):
            result = StepResult(step, "up to date", findings=[finding_from(f) for f in known.findings], outputs=known.outputs)
            result.state = "failed" if known.failed else result.state
        else:
            self.guard(step, known)
            if known is not None and known.outputs and not self.dry_run:
                known.outputs = {}
                self.state.save()  # who is killed now must not find his own file changed
            result = self.do(step)
            self.remember(step, inputs, result)
        if result.state == "failed":
            self.stopped |= set(step.models)
        if step.kind != "load" and step.makes and step.file is not None and result.state in ("done", "up to date"):
            files = (step.file, *step.metamodel)  # the same model again changes nothing behind it
            self.content[step.makes] = digest_of_all((str(n), digest_of(path)) for n, path in enumerate(files))
        return result

    def inputs(self, step: Step) -> str:
        """The digest of all that a step depends on."""
        settings = [robosmi.__version__, step.kind, step.makes, str(step.driver), step.greatest.name]
        parts = [("step", "\0".join(settings)), ("keep", str(self.keep and step.kind == "generate"))]
        parts += [(f"output {relative(p, self.folder)}", "") for p in step.outputs()]
        parts += [(f"file {relative(p, self.folder)}", digest_of(p)) for p in step.inputs()]
        parts += [(f"model {name}", self.content[name]) for name in step.models]
        return digest_of_all(parts)

    def intact(self, step: Step, known: StepState) -> bool:
        """Whether what the step made is still there, as it was made."""
        if step.kind == "load" or (step.makes and step.file is None):
            return True  # nothing but a model in memory, which is made when it is needed
        return all(digest_of(self.folder / name) == value for name, value in known.outputs.items())

    def guard(self, step: Step, known: StepState | None) -> None:
        """A model that was changed by hand since a step wrote it is not written over."""
        for path in step.stored() if known is not None else []:
            name = relative(path, self.folder)
            if path.is_file() and known is not None and known.outputs.get(name) not in (None, digest_of(path)):
                raise StoppedError(
                    f"'{name}' was changed since the step '{step.name}' made it: writing would lose that",
                    location=Location(str(path)),
                    fix="move it away, or let another step read it",
                )

    def do(self, step: Step) -> StepResult:
        """Do a step, with the models that it needs."""
        models = {name: self.model(name) for name in step.models}
        files = {name: self.makers[name].file for name in step.models}
        result, made = DOES[step.kind](step, Doing(self.folder, models, files, self.dry_run, self.keep))
        if made is not None:
            self.models[step.makes] = made
        if self.dry_run and result.state == "done":
            result.state = "would run"
        return result

    def model(self, name: str) -> Model:
        """A model, made by its step or read from the file that the step has made."""
        if name not in self.models:
            maker = self.makers[name]
            if maker.kind != "load" and maker.file is not None and maker.file.is_file():
                maker = Step(maker.name, "load", makes=name, file=maker.file, metamodel=maker.metamodel)
            self.do(maker)
        return self.models[name]

    def remember(self, step: Step, inputs: str, result: StepResult) -> None:
        """Note what a step read, made and said."""
        if self.dry_run:
            return
        result.outputs |= {relative(path, self.folder): "" for path in step.stored()}
        result.outputs = {name: digest_of(self.folder / name) for name in result.outputs}
        findings = [finding.to_json() for finding in result.findings]
        self.state.steps[step.name] = StepState(inputs, result.outputs, findings, result.state == "failed")
