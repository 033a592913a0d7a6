"""The chain `analyse`: a program to its code model, and what it uses of its platform."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robosmi.diagnostics import Finding
from robosmi.metamodels import ccode
from robosmi.transformations.chains.reading import read_program
from robosmi.transformations.knowledge.platform_api import ApiIndex
from robosmi.transformations.queries.analysis import analysis


@dataclass(frozen=True)
class Analysis:
    """A program that was analysed: its code model, the contract's result, the findings."""

    program: ccode.Program
    result: dict[str, Any]
    findings: list[Finding]

    def lines(self) -> list[str]:
        """What a person reads."""
        lines: list[str] = []
        for unit in self.result["units"]:
            main = unit["main"]
            loop = (
                f"main has a {main['loop_kind']} loop in line {main['loop_line']}"
                if main and main["loop_line"]
                else "no endless loop in main"
            )
            lines.append(f"{unit['path']}: {len(unit['functions'])} functions, {len(unit['globals'])} globals; {loop}")
            for call in unit["platform_calls"]:
                lines.append(f"  {call['header'] or '?':20} {call['signature'] or call['name']:50} {call['count']} calls")
            symbols = ", ".join(s["name"] for s in unit["platform_symbols"])
            if symbols:
                lines.append(f"  platform symbols: {symbols}")
            for call in unit["unknown_calls"]:
                lines.append(f"  unknown: {call['name']} ({call['count']} calls)")
        return lines


def analyse(
    paths: Sequence[Path], *, source_platform: str, include_dirs: Sequence[Path] = (), defines: Sequence[str] = ()
) -> Analysis:
    """Analyse the source files of one program.

    Args:
        paths: the files.
        source_platform: name of the platform it was written for.
        include_dirs: folders with headers.
        defines: macros defined from outside.

    Raises:
        SourceError: a file cannot be read as a program.
        PlatformDataError: there is no such platform.
    """
    program, findings = read_program(paths, source_platform, include_dirs, defines)
    return Analysis(program, analysis(program, findings, ApiIndex.load(source_platform)), findings)
