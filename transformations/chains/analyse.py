"""The chain `analyse`: reads a program into its code model, and determines what it uses of its platform."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from msgspec import Struct, structs

from robosmi.base.quantities import quantity
from robosmi.chain import Chain
from robosmi.chain.run import Progress
from robosmi.diagnostics import Finding
from robosmi.inputs import read_once
from robosmi.metamodels import ccode
from robosmi.project import default_text, project_of
from robosmi.resources import project_of_input
from robosmi.transformations.chains.source_board import SourceBoard, bundled_library, find_source_board, places_of
from robosmi.transformations.chains.stages.reading import check_source_platform, platform_of_files, read_program
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.portability.analysed_program import PortabilityPlace
from robosmi.transformations.queries.reports.analysis import UNKNOWN, analysis
from robosmi.transformations.t2m.c_source.side_file import ENDING as PROJECT, read_side


class Analysis(Struct, frozen=True):
    """A program that was analysed: its code model, the contract's result, the findings."""

    program: ccode.Program
    result: dict[str, Any]
    findings: list[Finding]

    def lines(self) -> list[str]:
        """What the user reads."""
        lines: list[str] = []
        for unit in self.result["units"]:
            counts = f"{unit['path']}: {quantity(len(unit['functions']), 'function')}, {quantity(len(unit['globals']), 'global')}"
            lines.append(counts if unit["main"] is None else f"{counts}; {_loop_of(unit['main'])}")
            for call in unit["platform_calls"]:
                lines.append(
                    f"  {call['header'] or '?':20} {call['signature'] or call['name']:50} {quantity(call['count'], 'call')}"
                )
            symbols = ", ".join(s["name"] for s in unit["platform_symbols"])
            if symbols:
                lines.append(f"  platform symbols: {symbols}")
            for call in unit["unknown_calls"]:
                adapter = call.get("adapter")
                of = f"with your adapter ({os.path.relpath(adapter)})" if adapter else "unknown"
                lines.append(f"  {of}: {call['name']} ({quantity(call['count'], 'call')})")
        return [*lines, *self._portability()]

    def _portability(self) -> list[str]:
        """The places that may behave differently on the target, by kind."""
        if (places := self.result.get("portability")) is None:
            return []
        by_kind: dict[str, list[dict[str, Any]]] = {}
        for place in places:
            by_kind.setdefault(place["kind"], []).append(place)
        lines = [f"{quantity(len(places), 'place')} may behave differently on the target" + (":" if places else "")]
        for kind, found in sorted(by_kind.items(), key=lambda item: -len(item[1])):
            lines.append(f"  {kind}: {len(found)}")
            for place in found:
                lines.append(f"    {os.path.relpath(place['path'])}:{place['line']}: {place['what']}")
        for library in self.result["bundled_libraries"]:
            lines.append(
                f"  {os.path.relpath(library)}: a library in the sketch that uses such things; its places are not listed"
            )
        return lines


def analysis_chain() -> Chain:
    """The steps from source files to the value `analysis`; each can be replaced by its name (`Chain.replace`)."""
    chain = Chain(None, "analyse")
    chain.given("paths", "source_platform", "include_dirs", "defines", "source_board", "target")
    chain.call(source_api, makes="api", step="look up the source platform")
    chain.call(board_of_source, makes="board", step="look up the source board")
    chain.call(read_program_and_findings, makes="read", step="read the program")
    chain.call(analysed, makes="analysis", step="analyse the program")
    return chain


def source_api(source_platform: str | None, paths: Sequence[Path]) -> ApiIndex:
    """The API of the platform that the program was written for.

    Raises:
        UsageError: there is no such platform.
    """
    name = source_platform or platform_of_files(paths)
    check_source_platform(name)
    return ApiIndex.load(name)


def board_of_source(paths: Sequence[Path], api: ApiIndex, source_board: str | None, target: str | None) -> SourceBoard | None:
    """The board that the program runs on today; None on a platform that does not tell its boards apart.

    Raises:
        UsageError: there is no such board.
    """
    return find_source_board(paths, api, source_board, target)


def read_program_and_findings(
    paths: Sequence[Path], api: ApiIndex, include_dirs: Sequence[Path], defines: Sequence[str], board: SourceBoard | None
) -> tuple[ccode.Program, list[Finding]]:
    """The code model and its reader's findings; a project file of SimpleIDE is replaced by the files that it lists.

    Raises:
        SourceError: a file cannot be read as a program.
    """
    defines = [*(board.defines if board is not None else ()), *defines]
    if len(paths) == 1 and paths[0].suffix == PROJECT:
        side = read_side(str(paths[0]), sourced=True)
        folders, macros = [*include_dirs, *(Path(each) for each in side.include_dirs)], [*defines, *side.defines]
        program, findings = read_program([Path(source) for source in side.sources], api.name, folders, macros)
        return program, [*side.findings, *findings]
    return read_program(paths, api.name, include_dirs, defines)


def analysed(
    read: tuple[ccode.Program, list[Finding]],
    api: ApiIndex,
    paths: Sequence[Path],
    board: SourceBoard | None,
    target: str | None,
) -> Analysis:
    """Determine what the program uses of its platform, and which adapters of one's own there are for what nobody else knows.

    Raises:
        PlatformDataError: an adapter file of the project is wrong.
    """
    program, findings = read
    result = analysis(program, findings, api)
    if board is not None:
        findings = [*board.findings, *findings]
        result["board"] = board.name
    if target is not None:
        places = places_of(program, api, board, target)
        bundled = {place.path: library for place in places if (library := bundled_library(place.path, api)) is not None}
        result["portability"] = [_json(place) for place in places if place.path not in bundled]
        result["bundled_libraries"] = sorted(set(bundled.values()))
    if any(finding.rule in UNKNOWN for finding in findings):
        from robosmi.transformations.chains.stages.own_adapters import adapter_files_of, still_unknown  # most programs are known
        from robosmi.transformations.knowledge.platforms.target_platform import target_facts

        settings = project_of(Path(paths[0]))
        index = adapter_files_of(settings, target_facts(settings.target or default_text("migrate", "target")), api)
        findings = still_unknown(findings, index)
        for unit in result["units"]:
            for call in unit["unknown_calls"]:
                if (piece := index.own_adapter(call["name"])) is not None:
                    call["adapter"] = piece.location.path
    return Analysis(program, result, findings)


def analyse(
    paths: Sequence[Path],
    *,
    source_platform: str | None = None,
    include_dirs: Sequence[Path] = (),
    defines: Sequence[str] = (),
    source_board: str | None = None,
    target: str | None = None,
    progress: Progress | None = None,
    chain: Chain | None = None,
) -> Analysis:
    """Analyse the source files of one program.

    Args:
        paths: the files.
        source_platform: name of the platform it was written for; that of the defaults if None.
        include_dirs: folders with headers.
        defines: macros defined from outside.
        source_board: the board that it runs on today; if None that of its drawing, else the platform's usual one.
        target: a target; the result lists places that may behave differently there. None for no such list.
        progress: told of each step.
        chain: steps of one's own, which make `analysis`; `analysis_chain()` if None.

    Raises:
        SourceError: a file cannot be read as a program.
        UsageError: there is no such platform.
    """
    run = (chain or analysis_chain()).start(
        progress=progress,
        paths=paths,
        source_platform=source_platform,
        include_dirs=include_dirs,
        defines=defines,
        source_board=source_board,
        target=target,
    )
    with project_of_input(paths[0]), read_once():
        return run.value("analysis", Analysis)


def _json(place: PortabilityPlace) -> dict[str, Any]:
    """The contract's form of a place."""
    return {key: value for key, value in structs.asdict(place).items() if key != "name"}


def _loop_of(main: dict[str, Any]) -> str:
    if not main["loop_line"]:
        return "no endless loop in main"
    return f"main has a {main['loop_kind']} loop in line {main['loop_line']}"
