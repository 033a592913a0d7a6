"""`robosmi compile OUT`: compile a generated sketch with the target's real toolchain."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.cli.common import command_line, output_folder
from robosmi.report import Report

if TYPE_CHECKING:
    from robosmi.cli.options import Options
    from robosmi.verify.toolchains.compile_report import CompileReport, StackBound


def configure(parser: Options) -> None:
    """Add the command's options."""
    parser.add_argument("output", metavar="OUT", type=Path, help="output folder of migrate, or the sketch's own folder")
    parser.add_argument("--board", metavar="NAME", help="board to compile for, instead of the one in the sketch's project file")
    parser.add_argument(
        "-o", dest="into", metavar="DIR", type=output_folder, help="folder for the compiled program (default: OUT/build)"
    )


class _Arguments(argparse.Namespace):
    """The options and arguments of the command."""

    output: Path
    board: str | None
    into: Path | None


def run(arguments: _Arguments) -> Report:
    """Run the command."""
    from robosmi.verify.toolchains.compiled_program import compile_into

    compiled = compile_into(arguments.output, arguments.board, into=arguments.into)
    report = Report("compile", ok=compiled.exit_code == 0, failure_code=compiled.exit_code)
    report.result = compiled.to_json()
    report.findings = list(compiled.diagnostics)
    report.artifacts = compiled.artifacts()
    report.lines = _lines(compiled)
    if report.ok:
        migrated = (arguments.output / "models").is_dir()  # a sketch of one's own has no original to compare with
        report.next = (
            command_line("verify", arguments.output) if migrated else command_line("upload", arguments.output, "--port", "PORT")
        )
    return report


def _stack(stack: StackBound) -> str:
    """The stack bound in words, with the functions for which it is unknown."""
    said = f"at most {stack.bytes} bytes, {stack.interrupts} of them for interrupts"
    if stack.certain:
        return said
    doubts = [(stack.recursive, "are recursive"), (stack.unknown, "allocate a size known only at run time")]
    more = "; ".join(f"{', '.join(names)} {what}" for names, what in doubts if names)
    return f"{said.replace('at most', 'about')}, or more: {more}"


def _lines(compiled: CompileReport) -> list[str]:
    lines = [f"compiled for {compiled.board} with {compiled.tool}" if compiled.ok else f"does not compile for {compiled.board}"]
    for what, used, limit in (
        ("flash", compiled.flash_bytes, compiled.flash_limit),
        ("RAM", compiled.ram_bytes, compiled.ram_limit),
    ):
        if used is not None:
            share = f" of {limit} bytes ({100 * used / limit:.0f} %)" if limit is not None else " bytes"
            lines.append(f"  {what}: {used}{share}")
    if compiled.stack is not None:
        lines.append(f"  stack: {_stack(compiled.stack)}")
    if compiled.stand_in_core:
        lines.append(f"  core: {compiled.stand_in_core} (stand-in)")
    lines += [f"  library: {library.name} ({library.source})" for library in compiled.libraries]
    if compiled.ok and not compiled.fits:
        lines.append(f"  too big for this board{f'; fits on {compiled.fits_on}' if compiled.fits_on else ''}")
    if compiled.hex is not None:
        lines.append(f"  program: {compiled.hex}")
    return lines
