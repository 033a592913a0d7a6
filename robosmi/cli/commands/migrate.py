"""`robosmi migrate FILE... --hardware SKETCH -o OUT`: the whole way from a program and a drawing to a sketch.

`robosmi migrate OUT --target NAME -o NEW` moves an output folder on to another board.

Choices that flags, project file and history leave open are asked for, but only at a terminal. A prompt shows the ranked list with
its reasons, and the answer counts as the user's choice; an empty answer leaves the choice open. How candidates are ranked is not
known here. Answers may be stored in the project file.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from robosmi.base.quantities import quantity
from robosmi.cli.common import add_source_board, add_source_options, command_line, output_folder, pairs
from robosmi.cli.progress import progress
from robosmi.files.external_files import ExternalFiles
from robosmi.files.recovery import recover
from robosmi.plugins import content
from robosmi.project import FILE_NAME, Accepted, Project
from robosmi.quoting import terminal
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.api import MigratedSketch
    from robosmi.cli.options import Options


def configure(parser: Options) -> None:
    """Add the command's options."""
    add_source_options(parser)
    parser.add_argument("--hardware", metavar="SKETCH", type=Path, help="drawing of the new hardware")
    parser.add_argument("--target", metavar="NAME", help="target board")
    add_source_board(parser)
    parser.add_argument("-o", dest="output", metavar="OUT", type=output_folder, required=True, help="output folder")
    parser.add_argument(
        "--library",
        dest="libraries",
        action="append",
        default=[],
        metavar="COMPONENT=LIBRARY",
        help="use a library for a drawn component",
    )
    parser.add_argument(
        "--bind", action="append", default=[], metavar="NAME=PIN", help="connect a port of the source to a target pin"
    )
    parser.add_argument(
        "--adapters",
        choices=("filled", "placeholders"),
        help="generate adapters with bodies, or as placeholders to write yourself",
    )
    parser.add_argument(
        "--widths", choices=("fix", "keep"),
        help="fix (default): numbers keep their widths of the source; keep: leave the types and report where it may matter",
    )  # fmt: skip
    parser.add_argument("--ranker", metavar="NAME", help="ranker of libraries: devices (default), or tfidf, the paper's")
    parser.add_argument(
        "--history", metavar="PLACE", help="file or SQLAlchemy URL of the library history (default: the user's own)"
    )
    parser.add_argument(
        "--bench", action="store_true", help="also generate OUT/bench, a sketch that tests one component at a time"
    )
    parser.add_argument("--dry-run", action="store_true", help="show what would be generated; write nothing")
    parser.add_argument("--yes", action="store_true", help="do not ask questions")
    parser.add_argument("--strict", action="store_true", help="stop if a choice is open")
    parser.add_argument("--verify", action="store_true", help="compare the sketch with the original afterwards")
    parser.add_argument("--open", action="store_true", help="open the plan in the browser afterwards, like robosmi open")


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    json: bool
    files: list[Path]
    source_platform: str | None
    source_board: str | None
    include_dirs: list[Path]
    defines: list[str]
    hardware: Path | None
    target: str | None
    output: Path
    libraries: list[str]
    bind: list[str]
    adapters: str | None
    widths: str | None
    history: str | None
    ranker: str | None
    bench: bool
    dry_run: bool
    yes: bool
    strict: bool
    verify: bool
    open: bool


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    report = Report("migrate")
    if not arguments.dry_run:
        recover(arguments.output)  # what a killed run has begun there may be a change of the project file, too
    first = arguments.files[0]
    project: Project = content("query", "migration_project")(arguments.files)
    answers = (
        Answers(bind_table=_bind_table(arguments.target, project)) if may_ask(yes=arguments.yes, as_json=arguments.json) else None
    )
    beside = project.path.parent if project.path is not None else first if first.is_dir() else first.parent
    with progress() as told:
        done: MigratedSketch = content("chain", "migrate")(
            arguments.files, arguments.output, project=project, hardware=arguments.hardware, target=arguments.target,
            source_platform=arguments.source_platform, source_board=arguments.source_board,
            include_dirs=arguments.include_dirs, defines=arguments.defines,
            libraries=pairs(arguments.libraries, "--library"), bind=pairs(arguments.bind, "--bind"), adapters=arguments.adapters,
            dry_run=arguments.dry_run, strict=arguments.strict, history=arguments.history,
            **({"widths": arguments.widths} if arguments.widths is not None else {}),
            ranker=arguments.ranker, bench=arguments.bench, verify=arguments.verify,
            ask=answers.libraries if answers else None, ask_ports=answers.ports if answers else None,
            ask_pins=answers.pins if answers else None, progress=told,
            outside=(lambda: answers.offer(beside)) if answers and not arguments.dry_run else None,
        )  # fmt: skip
    if done.verification is not None and (code := done.verification[1]):
        report.ok, report.failure_code = False, code
    filled(report, done, project.severity, project.accept)
    if arguments.open and not arguments.dry_run:
        from robosmi.cli.commands.open import serve  # a server is wanted only here

        serve(report, arguments.output, browser=not arguments.json)
    return report


def _bind_table(target: str | None, project: Project) -> str:
    """The table of the project file for pins of a target: one of its own where the file is for another target."""
    return f"bind.{target}" if target is not None and project.target not in (None, target) else "bind"


def filled(report: Report, made: MigratedSketch, severity: Mapping[str, str], accept: tuple[Accepted, ...]) -> Report:
    """The report of a generation, whether from sources or from a stored plan."""
    from robosmi.generate.merge_edits import CONFLICT

    report.rest, report.findings, report.tasks = made.result, list(made.findings), list(made.tasks())
    report.artifacts = made.artifacts()
    report.lines = made.lines()
    report.judge(severity, accept)
    marked = dict.fromkeys(
        str(task.location.path) for task in report.tasks if task.rule == CONFLICT and task.location is not None
    )
    if made.written and marked:
        report.next = f"solve the conflicts in {', '.join(str(made.output / name) for name in marked)}, then migrate again"
    elif made.written:
        report.next = command_line("open" if made.open_choices else "compile", made.output)
    return report


# ---- prompts

SHOWN = 7
NONE = "none"


def may_ask(*, yes: bool, as_json: bool) -> bool:
    """Whether the user can be asked: input and output are a terminal, and neither --yes nor --json is given."""
    return not yes and not as_json and sys.stdin.isatty() and sys.stdout.isatty()


def ask_libraries(
    choices: Sequence[Mapping[str, Any]], *, answer: Callable[[str], str] = input, out: TextIO | None = None
) -> dict[str, str]:
    """Ask for a library for each open choice.

    Args:
        choices: open choices as the contract has them (`libraries[]`), like parts one after the other.
        answer: reads one line.
        out: where is written; stdout if None.

    Returns:
        `#model_index` -> name of a library or `none`, for what was answered.
    """
    said: dict[str, str] = {}
    for choice in choices:
        candidates = list(choice["candidates"])[:SHOWN]
        print(f"\nWhich library drives '{terminal(choice['component'])}'?", file=out or sys.stdout)
        for number, candidate in enumerate(candidates, 1):
            print(terminal(f"  {number}  {candidate['library']}: {'; '.join(candidate['reasons'])}"), file=out or sys.stdout)
        print("  0  no library; or type a library's name; Enter: decide later", file=out or sys.stdout)
        names = [str(candidate["library"]) for candidate in candidates]
        try:
            text = answer("> ").strip()
            while text.isdecimal() and int(text) > len(names):
                print(f"  the list has no number {int(text)}", file=out or sys.stdout)
                text = answer("> ").strip()
        except EOFError:
            return said
        if name := _named(text, names):
            said[f"#{choice['component_model_index']}"] = name
    return said


def ask_ports(
    choices: Sequence[Mapping[str, Any]],
    pins: Sequence[str],
    *,
    answer: Callable[[str], str] = input,
    out: TextIO | None = None,
) -> dict[str, str]:
    """Ask for a pin for each open port.

    Args:
        choices: open ports as the contract has them (`bindings[]`).
        pins: what may be answered: pins of the board and names of connections.
        answer: reads one line.
        out: where is written; stdout if None.

    Returns:
        Name of the port -> pin, connection or `none`, for what was answered.
    """
    said: dict[str, str] = {}
    for choice in choices:
        options = list(choice["options"])[:SHOWN]
        others = [name for name in choice["names"] if name != choice["name"]]
        also = f" ({', '.join(others)})" if others else ""
        print(f"\nWhich pin is port '{terminal(choice['name'])}'{terminal(also)} on?", file=out or sys.stdout)
        for number, option in enumerate(options, 1):
            print(terminal(f"  {number}  {option['label']}: {'; '.join(option['reasons'])}"), file=out or sys.stdout)
        print("  0  not connected; or type a pin's label; Enter: decide later", file=out or sys.stdout)
        names = [str(option["label"]) for option in options]
        try:
            text = answer("> ").strip()
            while text and not (text.isdecimal() and int(text) <= len(names)) and text not in (*pins, NONE):
                print(
                    f"  {'the list has no number' if text.isdecimal() else 'the board has no pin'} {terminal(text)}",
                    file=out or sys.stdout,
                )
                text = answer("> ").strip()
        except EOFError:
            return said
        if name := _named(text, names):
            said[str(choice["name"])] = name
    return said


def ask_pins(rows: Sequence[Mapping[str, str]], *, answer: Callable[[str], str] = input, out: TextIO | None = None) -> bool:
    """Ask whether proposed pins are right.

    Args:
        rows: the pins, each with the former pin (`before`), the proposed one (`pin`), the connection (`name`) and its `ports`.
        answer: reads one line.
        out: where is written; stdout if None.
    """
    print("\nProposed pins:", file=out or sys.stdout)
    for row in rows:
        ports = f"  {row['ports']}" if row["ports"] else ""
        print(terminal(f"  {row['before']:5} -> {row['pin']:5} {row['name']}{ports}"), file=out or sys.stdout)
    print("Use these pins? (y; Enter: stop)", file=out or sys.stdout)
    try:
        return answer("> ").strip().lower() in ("y", "yes")
    except EOFError:
        return False


class Answers:
    """What the user answers in one run, to be kept where the person wishes.

    Args:
        answer: reads one line.
        out: where is written; stdout if None.
        bind_table: the table of the project file for pins.
    """

    def __init__(self, answer: Callable[[str], str] = input, out: TextIO | None = None, bind_table: str = "bind") -> None:
        self.bind_table, self.answer, self.out = bind_table, answer, out
        self.said: dict[str, dict[str, str]] = {}

    def libraries(self, choices: Sequence[Mapping[str, Any]]) -> dict[str, str]:
        """Ask for libraries; see `ask_libraries`."""
        found = ask_libraries(choices, answer=self.answer, out=self.out)
        self.said.setdefault("libraries", {}).update(found)
        return found

    def ports(self, choices: Sequence[Mapping[str, Any]], pins: Sequence[str]) -> dict[str, str]:
        """Ask for pins; see `ask_ports`."""
        found = ask_ports(choices, pins, answer=self.answer, out=self.out)
        self.said.setdefault(self.bind_table, {}).update(found)
        return found

    def pins(self, rows: Sequence[Mapping[str, str]]) -> bool:
        """Ask whether the pins that are proposed for another board are right; see `ask_pins`."""
        return ask_pins(rows, answer=self.answer, out=self.out)

    def offer(self, folder: Path) -> ExternalFiles:
        """Offer to keep what was answered in the project file of a folder; what the file is to hold if the person wants it.

        Raises:
            SourceError: the file cannot be read, or would not mean the same with it.
        """
        entries = {table: values for table, values in self.said.items() if values}
        if not entries:
            return {}
        from robosmi.generate.project_entries import added_to_project, displayed_path  # most runs ask nothing

        change = added_to_project(folder, entries)
        if change.stays:
            print(f"\nYour answers are saved only in the plan: {terminal(change.stays)}.", file=self.out or sys.stdout)
        if not change.files:
            return {}
        count, place = sum(len(each) for each in entries.values()), displayed_path(folder / FILE_NAME)
        print(f"\nSave {quantity(count, 'answer')} in {terminal(place)}? (y; Enter: no)", file=self.out or sys.stdout)
        try:
            wanted = self.answer("> ").strip().lower() in ("y", "yes")
        except EOFError:
            return {}
        return change.files if wanted else {}


def _named(text: str, names: Sequence[str]) -> str:
    """The option with this number or name in the list."""
    if not text.isdecimal():
        return text
    return names[int(text) - 1] if int(text) else NONE
