"""The steps of a chain: their kind, inputs and outputs, and the result of doing them.

A metamodel is an input with all .ecore files that it refers to, directly or not. `languages` implements the kinds, `run` decides
when a step has to be done. Nothing slow is imported here: a chain of plain functions costs no more than the functions.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct

from robosmi.diagnostics import Finding, Severity
from robosmi.errors import SourceError
from robosmi.model.ecore.ecore_description import Package
from robosmi.model.ecore.ecore_files import EcoreFile, EcoreFiles

if TYPE_CHECKING:
    from robosmi.base.data_text import Json
    from robosmi.base.functions import Function


KINDS = ("load", "validate", "transform", "migrate", "generate")
"""The kinds that read and make models and files."""

FILLING = ("transform", "migrate")
"""The kinds whose function fills a new model."""

CALL, GIVEN = "call", "given"
"""The kinds of values in memory: one computed by a function from other values, and one that is given from outside."""


class Step(Struct, frozen=True):
    """A step as it is declared. Paths are absolute.

    Attributes:
        name: its name, of which there is one in the chain.
        kind: one of `KINDS`, `CALL` or `GIVEN`.
        function: the user's function, of `load` the user's driver; None for `given`, and for `load` with a driver by name.
        models: names of the models and values that it reads.
        makes: name of the model or value that it makes, "" for none.
        file: the file of that model, None if it stays in memory; for `load` the file that is read.
        metamodel: .ecore files of that model.
        trace: the file of the trace of `transform`, None for none.
        driver: the driver of a model that is loaded; found by the file's ending if None.
        lenient: has no effect any more.
        strict: whether too few or too many values in an XMI file, or a reference that leads nowhere, is an error.
        folder: where `generate` writes.
        templates: where its templates are: a folder, or None for the built-in ones.
        reads: further files whose change makes the step run again.
        code: the files that the function comes from.
        greatest: the worst severity of findings with which a `validate` lets the next steps go on.
        place: where it is declared, for errors.
        instead_of: the function that this one replaces (`Chain.replace`), which declares the result; or None.
    """

    name: str
    kind: str
    function: Function | None = None
    models: tuple[str, ...] = ()
    makes: str = ""
    file: Path | None = None
    metamodel: tuple[Path, ...] = ()
    trace: Path | None = None
    driver: str | None = None
    lenient: bool = False
    strict: bool = False
    folder: Path | None = None
    templates: Path | None = None
    reads: tuple[Path, ...] = ()
    code: tuple[Path, ...] = ()
    greatest: Severity = Severity.warning
    instead_of: Function | None = None

    def given_models(self) -> tuple[str, ...]:
        """The names under which its function gets models: those that it reads, and the one that it fills."""
        return (*self.models, self.makes) if self.kind in FILLING else self.models

    def inputs(self) -> list[Path]:
        """The files and folders that it reads, but for those of its models."""
        own = [self.file] if self.kind == "load" and self.file is not None else []
        return [*own, *self.metamodel_files(), *([self.templates] if self.templates is not None else []), *self.reads, *self.code]

    def metamodel_files(self) -> list[Path]:
        """The .ecore files of its model, and those that they refer to."""
        if not self.metamodel:
            return []

        return files_of(self.metamodel)

    def outputs(self) -> list[Path]:
        """The files and folders that it makes."""
        return [*self.stored(), *([self.folder] if self.folder is not None else [])]

    def stored(self) -> list[Path]:
        """The model files that it makes: the model's, and that of its trace."""
        return [path for path in (self.file, self.trace) if path is not None and self.kind != "load"]


class StepResult(Struct):
    """The result of a step.

    Attributes:
        step: the step.
        state: `up to date`, `done`, `would run` (in a dry run), `failed` (a validation with findings that stop), `not run`.
        seconds: its duration.
        findings: its findings; for a step that is up to date those of its last run.
        written: files that it wrote, or would write; relative to the chain's folder.
        removed: files that it removed.
        diff: the changes of text files, as a unified diff.
        read: files that were read with a model that it loads, as that refers to them; relative to the chain's folder.
        outputs: every file that it made, changed or not -> its digest.
        fixed: the fixes that a validation performed, each with its element.
        saved: names of the models that were written again because of them.
        changes: whether it changed an input model in memory, so that later steps need the changed model.
    """

    step: Step
    state: str
    seconds: float = 0.0
    findings: list[Finding] = []
    written: list[str] = []
    removed: list[str] = []
    diff: str = ""
    read: list[str] = []
    outputs: dict[str, str] = {}
    fixed: list[str] = []
    saved: list[str] = []
    changes: bool = False

    def to_json(self) -> dict[str, Json]:
        """The step in the contract's result of `run`."""
        return {
            "name": self.step.name, "kind": self.step.kind, "state": self.state, "seconds": round(self.seconds, 6),
            "written": self.written, "removed": self.removed, "findings": len(self.findings), "fixed": self.fixed,
        }  # fmt: skip


def relative(path: Path, folder: Path) -> str:
    """A path as the chain writes it."""
    return Path(os.path.relpath(path, folder)).as_posix()


# ---- the files of metamodels

_REFERRING = ("eClassifier", "eExceptions", "eKeys", "eOpposite", "eRawType", "eSuperTypes", "eType", "eTypeParameter", "href")
"""The attributes of a node that hold references."""


def files_of(paths: Iterable[Path]) -> list[Path]:
    """The files of metamodels, each once: the given ones in order, then those that they refer to.

    A file that cannot be read refers to nothing; loading it reports the error.
    """
    files = EcoreFiles()
    found: dict[Path, Path] = {}
    pending = list(paths)
    while pending:
        path = pending.pop(0)
        if (place := Path(os.path.realpath(path))) in found:
            continue
        found[place] = path
        try:
            pending += _referred(files.load(path), files)
        except (SourceError, OSError):
            continue
    return list(found.values())


def _referred(file: EcoreFile, files: EcoreFiles) -> list[Path]:
    """The files that one refers to."""
    led: dict[Path, None] = {}
    for uri in dict.fromkeys(_uris(file)):
        try:
            there = files.find(uri, file)
        except (SourceError, OSError):
            continue
        if there is not None and not isinstance(there, Package):
            led[there[0].path] = None
    return list(led)


def _uris(file: EcoreFile) -> Iterator[str]:
    for root in file.roots:
        for node in root.walk():
            for name in _REFERRING:
                for word in node.get(name).split():
                    uri, mark, _ = word.rpartition("#")
                    if mark and uri:
                        yield uri
