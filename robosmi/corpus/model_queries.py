"""Queries over the stored models of all programs: each model is opened, asked and left again, in worker processes."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from msgspec import Struct

from robosmi.base.data_text import Json
from robosmi.corpus.pool import in_workers
from robosmi.corpus.store import Store
from robosmi.corpus.worker_process import WorkerProcess
from robosmi.errors import RobosmiError, SourceError
from robosmi.model.opening import open_model
from robosmi.query.answers import as_json
from robosmi.query.expression import evaluate
from robosmi.query.models import ModelView
from robosmi.query.run import Run

LIMIT_S = 300.0
"""Seconds that a query may take for one model."""


class ModelAnswer(Struct, frozen=True):
    """What a query says about the model of one program.

    Attributes:
        program: `programs.id`.
        value: its value, as JSON has it.
        error: why there is none; None if there is.
    """

    program: str
    value: Json = None
    error: str | None = None


def answered(path: str, expression: str) -> dict[str, Any]:
    """The value of an expression over a model, in a worker: `value`, or `error`.

    Args:
        path: the XMI file; its name in the expression is M.
        expression: see `robosmi query`.
    """
    try:
        view = ModelView(open_model(Path(path), None, "M"))
        with Run(view):
            return {"value": evaluate(expression, [view], as_json)}
    except RobosmiError as error:
        return {"error": str(error)}
    except Exception as error:
        return {"error": f"{type(error).__name__}: {error}"}


def query_models(store: Store, out: Path, expression: str, *, kind: str = "code", jobs: int = 1) -> Iterator[ModelAnswer]:
    """The values of an expression over the models of all programs that are listed, as they come.

    Args:
        store: the store of the corpus.
        out: its output folder.
        expression: see `robosmi query`.
        kind: the kind of the models: code, hardware, plan or platform.
        jobs: number of worker processes.

    Raises:
        SourceError: the corpus has no models of that kind.
    """
    found = store.query(
        "SELECT programs.id, models.kind, models.path FROM models JOIN programs ON programs.id = models.program "
        "WHERE listed ORDER BY programs.id"
    ).rows
    paths = [(program, str(out / path)) for program, each, path in found if each == kind]
    if not paths:
        kinds = ", ".join(sorted({each for _, each, _ in found}))
        raise SourceError(
            f"the corpus has no models of the kind '{kind}'",
            fix=f"use one of: {kinds}" if kinds else "run it with --models, so that models are kept",
        )

    def ask(worker: WorkerProcess, job: tuple[str, str]) -> ModelAnswer:
        program, path = job
        told = worker.ask({"path": path, "expression": expression}, LIMIT_S)
        return ModelAnswer(program, told.get("value"), told.get("error"))

    return in_workers(ask, paths, min(jobs, len(paths)), ())
