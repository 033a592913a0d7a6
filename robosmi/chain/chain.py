"""`Chain`: steps that read and make models, values and files, done in the order of their dependencies, where something changed.

    c = Chain(folder)
    c.load("library", "library.xmi", metamodel="library.ecore")
    c.validate(constraints, models=["library"])
    c.transform(to_site, models=["library"], makes="site", metamodel="site.ecore", file="site.xmi")
    c.generate(pages, models=["site"], folder="out", templates="templates")
    c.run()

Steps may be plain functions over values in memory, too; then a run stays usable, with other values:

    c = Chain(None)
    c.given("numbers")
    c.call(lambda numbers: sum(numbers), makes="total")
    run = c.start(numbers=[1, 2])
    run.value("total")           # 3
    run.give(numbers=[1, 2, 3])  # only the steps that depend on it run again, on demand

How a step is done is `languages`' business, when and in which order `run`'s, what depends on what `graph`'s.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from msgspec import structs

from robosmi.chain.graph import Dependencies, graph_of, missing, topological_order
from robosmi.chain.run import ChainResult, ChainRun, Progress
from robosmi.chain.steps import CALL, GIVEN, KINDS, Step, relative
from robosmi.diagnostics import Location, Severity
from robosmi.errors import RuleError, SourceError, did_you_mean

if TYPE_CHECKING:
    import networkx as nx  # longer to import than most chains take

    from robosmi.base.functions import Function
    from robosmi.chain.languages import Choice  # all languages

V = TypeVar("V")
Names = str | Sequence[str]
Paths = str | Path | Sequence[str | Path]
ECORE = "ecore"
"""The value for `metamodel` of a step that makes a metamodel, in place of .ecore files."""


class Chain:
    """A workflow.

    Args:
        folder: the base of relative paths, with the state in `.robosmi/chains`; None for a chain of values
            alone, which reads and makes no files of its own and remembers nothing longer than a run lives.
        name: the chain's name; two chains in one folder have different ones.
        place: where it is declared, for errors.
    """

    def __init__(self, folder: str | Path | None = ".", name: str = "chain", place: Location | None = None) -> None:
        self.folder = Path(folder).resolve() if folder is not None else None
        self.name = name
        self.place = place
        self.steps: list[Step] = []
        self.defaults: dict[str, Any] = {}

    # Declaration

    def load(
        self,
        name: str,
        file: str | Path,
        *,
        metamodel: Paths = (),
        driver: str | Function | None = None,
        lenient: bool = False,
        reads: Paths = (),
        step: str = "",
    ) -> None:
        """Read a model of any technology.

        Args:
            name: the model's name.
            file: the file.
            metamodel: .ecore files, of XMI.
            driver: the driver's name, or a driver itself: it is called with the path and the model's name, and gives a `Model`;
                found by the file's ending if None.
            lenient: whether an XMI file may lack required values, or have too many or too few: a `validate` finds and mends that.
            reads: files that the model refers to.
            step: the step's name; `load NAME` if not given.
        """
        own, named = (None, driver) if driver is None or isinstance(driver, str) else (driver, None)
        title = step or f"load {name}"
        options = {"metamodel": metamodel, "driver": named, "lenient": lenient, "reads": reads}
        self._add(title, "load", own, (), makes=name, file=file, **options)

    def validate(self, function: Function, *, models: Names, stop_at: str = "error", reads: Paths = (), step: str = "") -> None:
        """Check constraints; later steps that use one of the models are done only if they hold.

        Args:
            function: `constraints(v, library)`: adds contexts and constraints to `v`, an `EVL` over the models.
            models: names of the models.
            stop_at: the least severity of findings that stop later steps on these models: `error`, `warning`, or `never`.
            reads: further files it reads.
            step: the step's name; the function's if not given.
        """
        levels = {"error": Severity.warning, "warning": Severity.info, "never": Severity.error}
        greatest = levels.get(stop_at)
        if greatest is None:
            raise SourceError(f"stop_at = '{stop_at}' is no level", location=self.place, fix="use error, warning or never")
        self._add(step, "validate", function, models, reads=reads, greatest=greatest)

    def transform(
        self,
        function: Function,
        *,
        models: Names,
        makes: str,
        metamodel: Paths = (),
        file: str | Path | None = None,
        trace: str | Path | None = None,
        driver: str | None = None,
        reads: Paths = (),
        step: str = "",
    ) -> None:
        """Make a model of others by rules.

        Args:
            function: `to_site(t, library, site)`: adds rules to `t`, an `ETL` over the models and the new one.
            models: names of the models it reads.
            makes: name of the model it makes.
            metamodel: its .ecore files, or "ecore" for a model that is a metamodel itself.
            file: where it is saved; without one it stays in memory, and is made anew whenever a later step needs it.
            trace: where the trace is saved as a model that refers to those of the sources and targets; these must have files.
            driver: "xml" for a new document of plain XML, which has no metamodel.
            reads: further files it reads.
            step: the step's name; the function's if not given.
        """  # fmt: skip
        if driver not in (None, "emf", "xml"):
            fix = 'use "xml" for plain XML, or leave it out and give the metamodel'
            raise SourceError(f"no new model can be made by the driver '{driver}'", location=self.place, fix=fix)
        if (driver == "xml") == bool(metamodel):
            said = "plain XML has no metamodel" if metamodel else f"the model '{makes}' has no metamodel"
            fix = "leave the metamodel out" if metamodel else 'name its .ecore files, "ecore", or driver = "xml" for plain XML'
            raise SourceError(said, location=self.place, fix=fix)
        options = {"metamodel": metamodel, "file": file, "trace": trace, "driver": driver, "reads": reads}
        self._add(step, "transform", function, models, makes=makes, **options)

    def migrate(
        self,
        function: Function,
        *,
        models: Names,
        makes: str,
        metamodel: Paths,
        file: str | Path | None = None,
        reads: Paths = (),
        step: str = "",
    ) -> None:
        """Make a model of another version of its metamodel.

        Args:
            function: `to_v2(f, old, new)`: adds rules to `f`, a `Flock` from the old model to the new one.
            models: name of the old model.
            makes: name of the new one.
            metamodel, file, reads, step: as for `transform`.
        """  # fmt: skip
        self._add(step, "migrate", function, models, makes=makes, metamodel=metamodel, file=file, reads=reads)

    def generate(
        self,
        function: Function,
        *,
        models: Names,
        folder: str | Path,
        templates: str | Path | None = None,
        reads: Paths = (),
        step: str = "",
    ) -> None:
        """Make files.

        Args:
            function: `pages(g, site)`: adds rules to `g`, a `Gen` for the folder.
            models: names of the models it reads.
            folder: the output folder.
            templates: the folder of templates; the built-in ones if None.
            reads: further files it reads.
            step: the step's name; the function's if not given.
        """  # fmt: skip
        self._add(step, "generate", function, models, folder=folder, templates=templates, reads=reads)

    def given(self, *names: str, **defaults: V) -> None:
        """Declare values that are given from outside when a run starts.

        Args:
            names: those that must be given.
            defaults: those that need not be, with what they are then.
        """
        for name in (*names, *defaults):
            self.steps.append(Step(f"given {name}", GIVEN, makes=name))
        self.defaults |= defaults

    def call(self, function: Function, *, makes: str, step: str = "") -> None:
        """Make a value of others by a plain function.

        Args:
            function: its parameters are the names of the models and values that it reads; it changes none of them.
            makes: name of the value that it returns.
            step: the step's name, which is what progress shows; the value's if not given.
        """
        self.steps.append(self._call(function, makes, step or makes))

    def _call(self, function: Function, makes: str, title: str) -> Step:
        code = inspect.getsourcefile(function) if self.folder is not None else None
        code_files = (Path(code).resolve(),) if code and Path(code).is_file() else ()
        return Step(title, CALL, function, tuple(inspect.signature(function).parameters), makes, code=code_files)

    def replace(self, name: str, function: Function) -> None:
        """Put another function in the place of a step of values; it makes the same value, of whatever values it asks for.

        Args:
            name: the step's name, or that of the value that it makes.
            function: as for `call`. Its result is checked against the return annotation of the first function.

        Raises:
            SourceError: there is no such step of values.
        """
        for number, step in enumerate(self.steps):
            if step.kind == CALL and name in (step.name, step.makes):
                first = step.instead_of or step.function
                self.steps[number] = structs.replace(self._call(function, step.makes, step.name), instead_of=first)
                return
        known = [step.name for step in self.steps if step.kind == CALL]
        raise SourceError(
            f"the chain has no step of values '{name}'{did_you_mean(name, known)}",
            location=self.place, fix=f"use one of: {', '.join(known) or 'none is there'}",
        )  # fmt: skip

    def _add(self, name: str, kind: str, function: Function | None, models: Names, **options: Any) -> None:
        if self.folder is None:
            raise SourceError(
                f"a step of kind '{kind}' reads or makes files, and the chain has no folder",
                location=self.place, fix="give the chain a folder",
            )  # fmt: skip
        folder = self.folder
        for key in ("file", "trace", "folder", "templates"):
            if options.get(key) is not None:
                options[key] = folder / options[key]
        if options.get("metamodel") == ECORE:
            options["metamodel"] = ()
        for key in ("metamodel", "reads"):
            given = options.get(key, ())
            options[key] = tuple(folder / p for p in ([given] if isinstance(given, (str, Path)) else given))
        code = _source_of(function) if function is not None else None
        listed = (models,) if isinstance(models, str) else tuple(models)
        title = name or getattr(function, "__name__", None) or kind
        if not re.fullmatch(r"\w[\w .-]*", title):
            raise SourceError(
                f"'{title}' cannot be a step's name", location=self.place, fix="use letters, digits, blanks, points and dashes"
            )
        code_files = (Path(code).resolve(),) if code and Path(code).is_file() else ()
        self.steps.append(Step(title, kind, function, listed, code=code_files, **options))

    # Running

    def graph(self) -> nx.DiGraph[str]:
        """What depends on what: nodes `step NAME`, `model NAME`, `file PATH`, with the attribute `kind` (step, model, file).

        Raises:
            SourceError: two steps make the same, or a model is used that no step makes.
        """
        import networkx as nx

        graph: nx.DiGraph[str] = nx.DiGraph()
        depends = self.dependencies()
        for name, kind in depends.kinds.items():
            graph.add_node(name, kind=kind)
        for first, then, gate in depends.edges():
            graph.add_edge(first, then, **({"gate": True} if gate else {}))
        return graph

    def dependencies(self) -> Dependencies:
        """The same as plain data.

        Raises:
            SourceError: as for `graph`.
        """
        return graph_of(self.steps, self.folder, self.place)

    def check(self) -> list[Step]:
        """The steps in the order in which they are done, once it is sure that they can be.

        Raises:
            SourceError: the chain has a circle, a model that no step makes, a file that is not there, or a trace of a model
                without a file.
            RuleError: a function does not take the models of its step.
        """
        graph = self.dependencies()
        ordered = topological_order(self.steps, graph, self.place)
        for step, path in missing(ordered, graph, self.folder):
            problem = f"reads '{relative(path, self.folder or path)}', which does not exist and no step makes"
            nearby = [ECORE, *(file.name for file in path.parent.glob("*.ecore"))] if path in step.metamodel else []
            meant = did_you_mean(path.name, nearby)
            raise SourceError(
                f"the step '{step.name}' {problem}{meant}",
                location=self.place or Location(str(path)),
                fix="correct the path, relative to the chain's folder; nothing was done",
            )
        files = {step.makes: step.file for step in ordered}
        for step in ordered:
            _check_parameters(step)
            for model in (*step.models, step.makes) if step.trace is not None else ():
                if files[model] is None:
                    raise SourceError(
                        f"the step '{step.name}' saves a trace, which cannot refer to the model '{model}': it has no file",
                        location=self.place,
                        fix=f"give the step that makes '{model}' a file; nothing was done",
                    )
        return ordered

    def run(
        self, *, dry_run: bool = False, keep: bool = True, force: bool = False, fix: Choice | None = None, **values: V
    ) -> ChainResult:
        """Do the steps whose inputs have changed since they were done last, or whose outputs are gone.

        Args:
            dry_run: write nothing; the result lists what would be written.
            keep: keep users' edits of generated files outside of regions too.
            force: run every step; a stored model with a user's edits is made again, and theirs becomes NAME.orig.
            fix: perform this fix of every finding of a validation ("first", "last", or a function from a finding to one of its
                fixes), and store the loaded models that it changes. A model that another step makes is left as it is.
            values: those that are given from outside.

        Raises:
            SourceError: the chain is wrong, a value is not given, or a file cannot be read or written.
            RuleError: a rule or template is wrong, or raises.
            StoppedError: a user's edits would be lost.
        """
        return self.start(dry_run=dry_run, keep=keep, force=force, fix=fix, progress=None, **values).run()

    def start(
        self,
        *,
        dry_run: bool = False,
        keep: bool = True,
        force: bool = False,
        fix: Choice | None = None,
        progress: Progress | None = None,
        **values: V,
    ) -> ChainRun:
        """A run that has done nothing yet; read values from it, set others, and read again.

        Args:
            dry_run, keep, force, fix, values: as for `run`.
            progress: called with each step before it runs, and with its result afterwards.

        Raises:
            SourceError: the chain is wrong, or a value is given that the chain does not know.
        """  # fmt: skip
        run = ChainRun(
            self.check(), self.dependencies(), self.folder, self.name,
            dry_run=dry_run, keep=keep, force=force, fix=fix, progress=progress,
        )  # fmt: skip
        run.give(**{**self.defaults, **values})
        return run


def _source_of(function: Function) -> str | None:
    """The file with the source of a function or class; None if unknown, as for a class whose file is not a module."""
    try:
        return inspect.getsourcefile(function)
    except TypeError:
        return None


def _check_parameters(step: Step) -> None:
    """Hold the parameters of a function of models against what it will be called with: the language, then the models by name.

    Raises:
        RuleError: it does not take these.
    """
    if step.kind not in KINDS or step.function is None:
        return
    try:
        signature = inspect.signature(step.function)
    except (TypeError, ValueError):  # some callables of C have none
        return
    names = step.given_models()
    needed = ["the path", "the model's name"] if step.kind == "load" else ["the language", *names]
    try:
        if step.kind == "load":
            signature.bind(None, None)
        else:
            signature.bind(None, **dict.fromkeys(names))
    except TypeError as error:
        from robosmi.query.rules.rule_language import place_of  # a chain of plain functions needs no queries

        raise RuleError(
            f"the function of the step '{step.name}' does not fit: {error}",
            location=place_of(step.function),
            fix=f"give it these parameters: {', '.join(needed)}; nothing was done",
        ) from None
