"""`robosmi merge BASE A B -o M`: the three-way merge of models."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from robosmi.base.quantities import quantity
from robosmi.cli.common import check_model_replaced
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("base", metavar="BASE", type=Path, help="the model before both edits")
    parser.add_argument("a", metavar="A", type=Path, help="one copy; the merged model gets its layout")
    parser.add_argument("b", metavar="B", type=Path, help="the other copy")
    parser.add_argument("-o", dest="output", metavar="M", type=Path, required=True, help="the merged model; it may be A")
    parser.add_argument(
        "--metamodel", dest="metamodels", action="append", default=[], metavar="X.ecore", type=Path,
        help="metamodel of the models; repeatable",
    )  # fmt: skip
    parser.add_argument("--take", choices=["a", "b"], help="the side that wins all conflicts")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    base: Path
    a: Path
    b: Path
    output: Path
    metamodels: list[Path]
    take: Literal["a", "b"] | None


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    from robosmi.api import merge

    report = Report("merge")
    check_model_replaced(arguments.output)
    found = merge(arguments.base, arguments.a, arguments.b, take=arguments.take, metamodel=arguments.metamodels)
    report.findings = found.findings
    report.result = {"conflicts": [conflict.to_json() for conflict in found.conflicts], "written": None}
    conflicts = quantity(len(found.conflicts), "conflict")
    if found.conflicts and arguments.take is None:
        report.lines = [f"{conflicts}: {arguments.output} was not written"]
        report.failure_code, report.ok = 1, False
        return report
    found.model.save(arguments.output, keep_layout=True)
    report.result["written"] = str(arguments.output)
    report.artifacts = [{"path": str(arguments.output), "kind": "model"}]
    taken = f", {conflicts} won by {arguments.take.upper()}" if found.conflicts and arguments.take is not None else ""
    report.lines = [f"wrote {arguments.output}{taken}"]
    return report
