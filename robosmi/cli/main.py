"""The entry point: reads the arguments, runs one command, prints its report, turns errors into exit codes.

Each command is a module of `commands` with `configure(parser)` and `run(arguments) -> Report`; only the requested one is
imported. Its example, from `EXAMPLES`, ends its `--help`. With `--json`, stdout is exactly one document, also when the command
fails.

A failure of the system that ends a command becomes an error with a cause and advice: a full disk, no memory, too deeply nested
text, an incomplete installation, a removed folder. Any other unexpected exception is a bug of ours.
"""

from __future__ import annotations

import argparse
import importlib
import os
import signal
import sys
import time
from collections.abc import Sequence
from contextlib import nullcontext, redirect_stdout, suppress
from pathlib import Path
from typing import Any, NoReturn

from robosmi import plugins
from robosmi.base import foreign_code
from robosmi.base.ending_signals import ending_signals
from robosmi.base.foreign_code import END
from robosmi.cli import sarif_file, streams
from robosmi.cli.progress import progress
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import (
    CompileError,
    InternalError,
    MissingToolError,
    ModelError,
    PlatformDataError,
    RobosmiError,
    RuleError,
    SourceError,
    StoppedError,
    TooLargeError,
    UploadError,
    UsageError,
    VerificationError,
    did_you_mean,
)
from robosmi.inputs import fix_of
from robosmi.plugins import plugin_findings
from robosmi.quoting import json_text, terminal

GROUPS = {
    "start": {
        "demo": "migrate the example that comes with RoboSMi and open it in the browser",
        "analyse": "list what a program uses of its platform",
        "hardware": "list which pin of a drawn board drives which component",
        "recommend": "recommend a library for each component",
        "migrate": "move a program to the board of a drawing",
    },
    "decide": {
        "open": "decide and check in the browser",
        "choose": "change a decision of a migration and update the sketch",
        "undo": "restore an output folder to its state before the last run",
        "generate": "generate the sketch from a stored plan",
        "explain": "explain a rule, with an example and what to do",
    },
    "prove": {
        "check": "check a drawing, a plan or a model",
        "compile": "compile a generated sketch",
        "simulate": "simulate a generated program and show its console and pins",
        "verify": "compare the behaviour of the original and the migrated program",
        "upload": "upload a compiled sketch to its board",
    },
    "share": {
        "report": "save the page of a migration as one file, to read or print",
        "wiring": "export the wiring for another tool, as a table or as a picture",
    },
    "models": {
        "query": "query a model of any technology",
        "diff": "compare two models or two migrations and list what differs",
        "merge": "merge two edited copies of a model",
        "run": "run the steps of a chain that have changed",
        "corpus": "run many programs and collect their results in tables",
        "metamodels": "export the metamodels, or generate Python packages from one",
    },
    "data": {
        "targets": "list the target boards, and how results on each are tested",
        "adapters": "list, show and save adapters (replacements for the source platform's functions)",
        "history": "list, export and import earlier library choices",
        "libraries": "install libraries, and add installed ones to the index",
        "parts": "add a drawing tool's parts to the catalogue",
        "platform": "create a source platform from its headers",
    },
    "setup": {
        "doctor": "report what is installed and what is missing",
        "trust": "allow a folder's own code to run",
        "lsp": "serve editors: findings, completions and choices while you type",
        "mcp": "serve the commands as tools for assistants, confined to one folder",
        "completion": "print a completion script for bash, zsh or fish",
    },
}
"""What a command is for, in the order in which the user needs it: group -> command -> summary."""

COMMANDS = {name: summary for group in GROUPS.values() for name, summary in group.items()}

FIRST_COMMANDS = ("demo", "migrate", "open", "verify", "doctor")
"""The commands that a new user needs first, in their order."""

ERROR_RULES: tuple[tuple[type[RobosmiError], str], ...] = (
    (UsageError, "RS901"),
    (ModelError, "RS907"),
    (TooLargeError, "RS912"),
    (SourceError, "RS902"),
    (PlatformDataError, "RS903"),
    (MissingToolError, "RS904"),
    (StoppedError, "RS905"),
    (CompileError, "RS906"),
    (UploadError, "RS909"),
    (VerificationError, "RS913"),
    (RobosmiError, "RS970"),
)


class _Help(argparse.HelpFormatter):
    """Help whose example stands in one line, so that it can be copied, and whose list of commands keeps its lines."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        return text if text.startswith(("example: ", "first: ")) else super()._fill_text(text, width, indent)


class _Parser(argparse.ArgumentParser):
    """An argument parser that raises what `main` reports, instead of ending the process."""

    def error(self, message: str) -> NoReturn:
        raise UsageError(message, fix=f"see: {self.prog} --help")

    def _print_message(self, message: str, file: Any = None) -> None:
        if message:  # help and version; errors do not come here
            streams.print_result(message.rstrip("\n"))


def build_parser(command: str | None = None) -> argparse.ArgumentParser:
    """The parser of one command, or of the program with a summary of each command.

    Args:
        command: the command whose options are wanted; anything else for the summaries.
    """
    from robosmi import __version__

    parser = _Parser(
        prog="robosmi", usage="robosmi COMMAND ...", epilog=_summaries(), formatter_class=_Help,
        description="Move robot software between microcontroller boards with models.",
    )  # fmt: skip
    parser.add_argument("--version", action="version", version=f"robosmi {__version__}")
    commands = parser.add_subparsers(
        dest="command", metavar="COMMAND", required=True, prog="robosmi", parser_class=_Parser, help=argparse.SUPPRESS
    )
    for name in [command] if command is not None and command in COMMANDS else list(COMMANDS):
        summary = COMMANDS[name]
        sub = commands.add_parser(
            name, description=summary[0].upper() + summary[1:] + ".", epilog=f"example: {EXAMPLES[name]}",
            formatter_class=_Help,
        )  # fmt: skip
        if name == command:
            importlib.import_module(f"robosmi.cli.commands.{name}").configure(sub)
        _add_common_options(sub)
    return parser


def _summaries() -> str:
    """Each command with its summary, in groups; first the ones that a new user needs."""
    first = "first: " + ", ".join(f"robosmi {name}" for name in FIRST_COMMANDS)
    groups = [
        "\n".join([f"{group}:", *(f"    {name:<12}{said}" for name, said in named.items())]) for group, named in GROUPS.items()
    ]
    return "\n\n".join([first, *groups, "robosmi COMMAND --help shows a command's options and an example."])


def _add_common_options(parser: argparse.ArgumentParser) -> None:
    common = parser.add_argument_group("options of every command")
    common.add_argument("--json", action="store_true", help="print only one JSON document to stdout")
    sarif_file.add_option(common)
    common.add_argument(
        "-v", "--verbose", action="store_true", help="show every finding, not only the first of many similar ones"
    )
    common.add_argument(
        "--fail-on", choices=("info", "warning", "error", "never"), default="error",
        help="exit with 1 on a finding of at least this severity (default: error)",
    )  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command.

    Args:
        arguments: without the program's name; those of the process if None.

    Returns:
        The exit code of the contract.
    """
    streams.prepare()
    if arguments is None:
        _end_in_order()
    words = list(sys.argv[1:] if arguments is None else arguments)
    as_json, started = "--json" in words, time.perf_counter()
    name = next((w for w in words if not w.startswith("-")), "")
    sarif = sarif_file.requested_path(words)
    try:
        if name and name not in COMMANDS:
            raise UsageError(
                f"there is no command '{name}'{did_you_mean(name, COMMANDS)}", fix=f"use one of: {', '.join(COMMANDS)}"
            )
        parsed = build_parser(name).parse_args(words, _Parsed())
        try:
            return _run(parsed)
        except SystemExit as error:  # no command ends so: a plug-in does
            return _failed(as_error(error), name, as_json, started, sarif)
    except KeyboardInterrupt:
        if arguments is None:  # the process is at its end
            signal.signal(signal.SIGINT, signal.SIG_IGN)
        streams.complain("robosmi: interrupted")
        return 128 + (_received[0] if _received else signal.SIGINT)
    except SystemExit:  # of --help and --version
        raise
    except BaseException as error:  # the user's rule may raise what is no Exception
        if os.environ.get("ROBOSMI_DEBUG") and not isinstance(error, RobosmiError):
            raise
        return _failed(as_error(error), name, as_json, started, sarif)


_received: list[int] = []
"""The signal that asked this process to end, if one did."""


def _end_in_order() -> None:
    """Take a request to end, as of a closed terminal, for Ctrl-C: tools that were started end, and temporary files go."""

    def asked(number: int, _: object) -> None:
        _received.append(number)
        raise KeyboardInterrupt

    for number in ending_signals():
        if signal.getsignal(number) is signal.SIG_DFL:  # nohup has SIGHUP ignored, and Python handles SIGINT itself
            signal.signal(number, asked)


class _Parsed(argparse.Namespace):
    """The options that every command has."""

    command: str
    fail_on: str
    json: bool
    sarif: Path | None
    verbose: bool


def _run(parsed: _Parsed) -> int:
    from robosmi.report import takes_colour, terminal_text

    sarif_file.check_file(parsed.sarif)
    aside = redirect_stdout(sys.stderr) if parsed.json else nullcontext()  # what plug-ins and rules print is none of the document
    with progress(), aside:
        report = importlib.import_module(f"robosmi.cli.commands.{parsed.command}").run(parsed)
        report.findings += plugin_findings()
    code = int(report.exit_code(parsed.fail_on)) if report.ok else int(report.failure_code)
    if parsed.sarif is not None:
        sarif_file.write_file(report, parsed.sarif, code, sarif_file.subject(parsed) or Path.cwd())
    if parsed.json:
        _print_json(report.to_json())
    elif text := terminal_text(report, verbose=parsed.verbose, colour=takes_colour(sys.stdout)):
        streams.print_result(text)
    if report.then is not None:
        report.then()
    return code


def _failed(error: RobosmiError, command: str, as_json: bool, started: float, sarif: Path | None) -> int:
    finding = as_finding(error)
    plugins = plugin_findings()  # what is missing may be what one of them was to bring
    if sarif is not None:
        sarif_file.write_failure(command or "robosmi", [finding, *plugins], sarif, error.exit_code)
    if as_json:
        document = {
            "schema": "robosmi/1", "command": command, "ok": False, "result": None,
            "findings": [each.to_json() for each in (finding, *plugins)], "tasks": [],
            "artifacts": [], "timings": {"total_s": round(time.perf_counter() - started, 6)},
        }  # fmt: skip
        with suppress(SourceError):  # the message below has to do
            _print_json(document)
    place = f"{error.location}: " if error.location else ""
    streams.complain(_lines(f"robosmi: error: {place}{error.message} [{finding.rule}]"))
    if error.fix:
        streams.complain(_lines(f"  do: {error.fix}"))
    for each in plugins:
        streams.complain(_lines(f"robosmi: {each.severity.name}: {each.message} [{each.rule}]"))
        streams.complain(_lines(f"  do: {each.fix}"))
    return error.exit_code


def _lines(text: str) -> str:
    """An error as lines for a terminal, as one may list several places; what follows is indented and passes for no error."""
    first, *rest = text.split("\n")
    return "\n".join([terminal(first), *(f"  {terminal(line.strip())}" for line in rest if line.strip())])


def _print_json(document: dict[str, Any]) -> None:
    plain = (getattr(sys.stdout, "encoding", None) or "").lower().replace("-", "") != "utf8"
    streams.print_result(json_text(document, ascii_only=plain))


EXAMPLES = {
    "demo": "robosmi demo",
    "analyse": "robosmi analyse robot.c -I include --json",
    "hardware": "robosmi hardware robot.fzz --svg wiring.svg",
    "recommend": "robosmi recommend robot.fzz",
    "migrate": "robosmi migrate robot.c --hardware robot.fzz -o out --bind leftQTI=D10",
    "generate": "robosmi generate out/models/plan.xmi -o out",
    "choose": "robosmi choose out port:leftServo=D9",
    "open": "robosmi open out",
    "report": "robosmi report out -o report.html",
    "wiring": "robosmi wiring out --as csv -o wiring.csv",
    "undo": "robosmi undo out",
    "check": "robosmi check robot.fzz --fail-on warning",
    "compile": "robosmi compile out",
    "upload": "robosmi upload out --port /dev/ttyACM0",
    "simulate": "robosmi simulate out --seconds 10 -o trace.vcd",
    "verify": "robosmi verify out",
    "adapters": "robosmi adapters save out --as project",
    "history": "robosmi history export choices.csv",
    "libraries": "robosmi libraries import installed/libraries",
    "corpus": "robosmi corpus run corpus.toml -o results --steps analyse,migrate",
    "run": "robosmi run chain.toml --dry-run",
    "query": 'robosmi query out/models/plan.xmi "PortBinding.all.select(lambda b: b.open).name"',
    "diff": "robosmi diff before/models/plan.xmi after/models/plan.xmi",
    "merge": "robosmi merge base.xmi mine.xmi theirs.xmi -o merged.xmi --metamodel library.ecore",
    "parts": "robosmi parts import parts-folder",
    "platform": "robosmi platform import include --name mine",
    "metamodels": "robosmi metamodels generate library.ecore -o packages",
    "targets": "robosmi targets",
    "trust": "robosmi trust .",
    "lsp": "robosmi lsp",
    "mcp": "robosmi mcp --root my-robot",
    "explain": "robosmi explain RS311",
    "doctor": "robosmi doctor",
    "completion": "robosmi completion bash > ~/.local/share/bash-completion/completions/robosmi",
}
"""Command -> a command line of it."""


def as_finding(error: RobosmiError) -> Finding:
    """An error as a finding."""
    rule = next(rule for kind, rule in ERROR_RULES if isinstance(error, kind))
    return Finding(rule, Severity.error, error.message, error.location, fix=error.fix)


def as_error(error: BaseException) -> RobosmiError:
    """The error to report for whatever a command ended with.

    Args:
        error: what was raised.
    """
    if isinstance(error, RobosmiError):
        return error
    if isinstance(error, OSError):
        return _of_system(error)
    if isinstance(error, MemoryError):
        return SourceError("there is not enough memory for this input", fix="give a smaller input, or more memory")
    if isinstance(error, RecursionError):
        if (found := foreign_code.endless(error)) is not None:
            return RuleError(f"the function '{found[0]}' calls itself without end", location=found[1], fix=END)
        return SourceError("the input is nested too deeply to be read", fix="look for brackets or elements within each other")
    if (missing := plugins.unloadable(error)) is not None:
        return missing
    if isinstance(error, UnicodeEncodeError):
        return _unwritable_text(error)
    if (raised := plugins.raised_by(error)) is not None:
        return raised
    if not isinstance(error, (Exception, SystemExit)) and (place := foreign_code.innermost(error)) is not None:
        return RuleError(f"{type(error).__name__}: {error}", location=place, fix="let this code raise an Exception, or nothing")
    return InternalError(
        f"{type(error).__name__}: {error}",
        fix="this is a bug of robosmi: please report it; ROBOSMI_DEBUG=1 shows where it happened",
    )


def _of_system(error: OSError) -> SourceError:
    if not _current_folder_is_there():
        return SourceError("the current folder is no longer there", fix="change to a folder that is, and run the command again")
    place = Location(os.fsdecode(error.filename)) if isinstance(error.filename, (str, bytes, os.PathLike)) else None
    fix = fix_of(error, "check the path, the permissions and the space on the disk")
    return SourceError(f"the system refuses: {error.strerror or error}", location=place, fix=fix)


def _current_folder_is_there() -> bool:
    try:
        os.getcwd()
    except OSError:
        return False
    return True


def _unwritable_text(error: UnicodeEncodeError) -> SourceError:
    """A text that cannot be stored: half of a pair of UTF-16, which is how Python holds a byte of a name that is no UTF-8."""
    shown = str(error.object)[max(0, error.start - 40) : error.end + 40].encode("ascii", "backslashreplace").decode()
    return SourceError(
        f"a name or text cannot be stored as {error.encoding.upper()}: '{shown}'",
        fix="rename the file or correct the text, so that it is UTF-8",
    )


if __name__ == "__main__":
    sys.exit(main())
