"""`robosmi query MODEL EXPRESSION`: a query over a model of any technology, given as a Python expression."""

from __future__ import annotations

import argparse
import warnings
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.base.data_text import json_written
from robosmi.cli.common import pairs
from robosmi.cli.streams import Shown
from robosmi.diagnostics import Finding, Severity
from robosmi.errors import UsageError
from robosmi.report import Report

CORPUS = ("corpus.sqlite", "corpus.lock")
"""The files that mark the output folder of a corpus run; its tables may be in a database elsewhere."""

if TYPE_CHECKING:
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument(
        "model",
        metavar="MODEL",
        type=Path,
        help="model file of any technology, folder with tables, or output folder of a corpus run; its name in EXPRESSION is M",
    )
    parser.add_argument("expression", metavar="EXPRESSION", help="for example 'Book.all.select(lambda b: b.year > 2000).name'")
    parser.add_argument("--driver", metavar="NAME", help="driver that opens MODEL (default: by its file extension)")
    parser.add_argument(
        "--metamodel", dest="metamodels", action="append", default=[], metavar="X.ecore", type=Path,
        help="metamodel of an XMI model; repeatable",
    )  # fmt: skip
    parser.add_argument(
        "--model",
        dest="models",
        action="append",
        default=[],
        metavar="NAME=MODEL",
        help="another model and its name in EXPRESSION",
    )

    parser.add_argument(
        "--kind", metavar="KIND", default="code",
        help="of a corpus: kind of models to query: code (default), hardware, plan or platform",
    )  # fmt: skip
    parser.add_argument("--store", metavar="URL", help="of a corpus: its database (default: OUT/corpus.sqlite)")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    model: Path
    expression: str
    driver: str | None
    metamodels: list[Path]
    models: list[str]
    kind: str
    store: str | None


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    if arguments.store is not None or any((arguments.model / name).is_file() for name in CORPUS):
        return _over_corpus(arguments)
    from robosmi.model.ecore.metamodel import Metamodel
    from robosmi.model.elements.driver import AmbiguousTypeWarning
    from robosmi.model.emf import EmfModel
    from robosmi.model.opening import open_model
    from robosmi.query.answers import as_json, as_lines
    from robosmi.query.expression import evaluate, named_queries
    from robosmi.query.models import ModelView
    from robosmi.query.run import Run

    report = Report("query")
    others = pairs(arguments.models, "--model")
    for name in others:
        if not name.isidentifier() or name.startswith("_") or name in ("M", "Q"):
            raise UsageError(f"--model {name}=...: this name is not allowed", fix="use letters and digits; M and Q are taken")
    driver = arguments.driver or ("emf" if arguments.metamodels else None)
    if arguments.metamodels and driver != "emf":
        raise UsageError(f"the driver '{driver}' takes no metamodel", fix="omit --metamodel, or use the driver emf")
    metamodel = Metamodel.load(*arguments.metamodels) if arguments.metamodels else None
    options = {} if metamodel is None else {"metamodel": metamodel}
    models = [open_model(arguments.model, driver, "M", **options)]
    models += [open_model(path, name=name) for name, path in others.items()]
    report.findings = [] if metamodel is None else list(metamodel.findings)
    report.findings += [finding for model in models if isinstance(model, EmfModel) for finding in model.findings]
    views = [ModelView(model) for model in models]
    shown = Shown()
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always", AmbiguousTypeWarning)
        with redirect_stdout(shown), redirect_stderr(shown), Run(*views):  # a query may print, and stdout is the answer's
            value = evaluate(arguments.expression, views, as_json, named_queries())
    for each in told:
        if not issubclass(each.category, AmbiguousTypeWarning):
            warnings.warn_explicit(each.message, each.category, each.filename, each.lineno)
    ambiguous = dict.fromkeys(str(each.message) for each in told if issubclass(each.category, AmbiguousTypeWarning))
    fix = "name the type with its package or its model"
    report.findings += [Finding("RS614", Severity.warning, text, fix=fix) for text in ambiguous]
    report.result, report.lines = {"value": value}, as_lines(value)
    return report


def _over_corpus(arguments: _Arguments) -> Report:
    """The values of the expression over the models of all programs of a corpus, each with its program."""
    from robosmi.corpus.model_queries import query_models
    from robosmi.corpus.running import store_place
    from robosmi.corpus.settings import cores
    from robosmi.corpus.store import Store

    if arguments.models or arguments.metamodels or arguments.driver:
        raise UsageError("a query over a corpus takes no further models", fix="omit --model, --metamodel and --driver")
    report = Report("query")
    out = arguments.model.absolute()
    with Store(store_place(out, arguments.store)) as store:
        answers = list(query_models(store, out, arguments.expression, kind=arguments.kind, jobs=cores()))
    failed = sorted((answer for answer in answers if answer.error is not None), key=lambda answer: answer.program)
    if len(failed) == len(answers):
        raise UsageError(f"the expression has no value for any program: {failed[0].error}", fix="correct the expression")
    report.findings = [
        Finding("RS921", Severity.warning, f"no value for '{each.program}': {each.error}", element=each.program)
        for each in failed
    ]
    found = sorted((answer for answer in answers if answer.error is None), key=lambda answer: answer.program)
    report.result = {"value": [{"program": answer.program, "value": answer.value} for answer in found]}
    report.lines = [f"{answer.program}: {json_written(answer.value, ensure_ascii=False)}" for answer in found]
    return report
