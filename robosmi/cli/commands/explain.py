"""`robosmi explain RULE...`: what the findings of a rule mean, an example, what to do. Without a rule, a list of all."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument(
        "rules", nargs="*", metavar="RULE", help="id or name of a rule, such as RS311; without it, list all rules"
    )


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    rules: list[str]


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    from robosmi.report.rules import finding_rules, page, rule_called, terminal_page

    report = Report("explain")
    known = finding_rules()
    asked = list(dict.fromkeys(rule_called(word, known).id for word in arguments.rules))
    report.result = {"rules": [known[rule].to_json() | {"page": page(known[rule])} for rule in asked or known]}
    for rule in asked:
        report.lines += [*([""] if report.lines else []), *terminal_page(known[rule])]
    if not asked:
        width = max((len(name) for name in known), default=0)
        report.lines = [f"{rule.id:{width}}  {rule.severities[0].name:7}  {rule.name}" for rule in known.values()]
    return report
