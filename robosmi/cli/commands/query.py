"""`robosmi query MODEL EXPRESSION`: a query over a model of any technology, given as a Python expression."""

from __future__ import annotations

import argparse
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.common import pairs
from robosmi.cli.streams import Shown
from robosmi.errors import UsageError
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument(
        "model",
        metavar="MODEL",
        type=Path,
        help="model file of any technology, or folder with tables; its name in EXPRESSION is M",
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


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    model: Path
    expression: str
    driver: str | None
    metamodels: list[Path]
    models: list[str]


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    from robosmi.model.ecore.metamodel import Metamodel
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
    options = {"metamodel": Metamodel.load(*arguments.metamodels)} if arguments.metamodels else {}
    models = [open_model(arguments.model, driver, "M", **options)]
    models += [open_model(path, name=name) for name, path in others.items()]
    report.findings = [finding for model in models if isinstance(model, EmfModel) for finding in model.findings]
    views = [ModelView(model) for model in models]
    shown = Shown()
    with redirect_stdout(shown), redirect_stderr(shown), Run(*views):  # a query may print, and stdout is the answer's
        value = evaluate(arguments.expression, views, as_json, named_queries())
    report.result, report.lines = {"value": value}, as_lines(value)
    return report
