"""The steps of a corpus run: the chains `analyse`, `migrate`, `compile` and `verify` for one program, with table rows as
results.

`robosmi.corpus` runs them in worker processes; its `store` says what the columns mean. A step leaves for the next ones what
they need in `work.results`. Here is also which files are programs, and which files the results of a program depend on.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from robosmi import inputs
from robosmi.base.data_text import json_written
from robosmi.base.user_folders import OWN
from robosmi.corpus.jobs import OutsideError, ProgramWork, Row, Rows
from robosmi.diagnostics import Finding, Location, Task
from robosmi.errors import RobosmiError
from robosmi.metamodels import ccode, migration
from robosmi.model import save_model
from robosmi.project import FILE_NAME, Project, default_text, defaults, load_project
from robosmi.query import ancestor_of_kind
from robosmi.transformations.chains.adapters import list_adapters
from robosmi.transformations.chains.analyse import analyse
from robosmi.transformations.chains.migrate import migrate, migration_chain
from robosmi.transformations.chains.stages.ports import ports as program_ports
from robosmi.transformations.chains.stages.program import ProgramFiles, StoredProgram, program_files
from robosmi.transformations.chains.stages.reading import platform_of_files
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.target_platform import target_facts
from robosmi.transformations.queries.code import CodeView, views
from robosmi.transformations.queries.flows.pin_uses import PinUse, macro_pin_uses, pin_uses_of
from robosmi.transformations.queries.plans.plan import header_name
from robosmi.transformations.queries.ports.macro_calls import MacroCalls
from robosmi.transformations.queries.ports.port_masks import PortMasks
from robosmi.transformations.queries.ports.ports import ProgramPorts
from robosmi.transformations.queries.ports.register_bits import register_bits
from robosmi.transformations.t2m.c_source.side_file import ENDING as SIDE, adjacent_project, read_side

MIGRATION = "migration"
"""The folder of a program's migration in its output folder."""
_HEADERS = (".h", ".hpp", ".hh", ".hxx")
_SKETCH = (".ino", ".pde")
_INCLUDE = re.compile(rb"^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"\n]+)[>\"]", re.MULTILINE)
_MAIN = re.compile(rb"\bmain\s*\(")
_BODY = ("filled", "care")
"""The states of an adapter that has a body."""
_MOST = 1000
"""Number of files of a program whose includes are followed."""


def programs(paths: Iterable[Path]) -> Iterator[Path]:
    """The files that are programs by themselves: sources that define `main`, and the file of a sketch with its folder's name.

    Args:
        paths: files.
    """
    readers = defaults()["readers"]
    for path in paths:
        ending = path.suffix.lower()
        if ending in _SKETCH:
            if path.stem == path.parent.name:
                yield path
        elif ending in readers and readers[ending] == readers[".c"] and ending not in _HEADERS and _has_main(path):
            yield path


def _has_main(path: Path) -> bool:
    """Whether a file has a function main, as far as its text shows; one that is too large is tried."""
    try:
        return _MAIN.search(inputs.read_bytes(path, inputs.SOURCE)) is not None
    except OSError:
        return path.is_file()


def files(work: ProgramWork) -> list[str]:
    """The files that the results of a program depend on, and paths at which a further file would count.

    These are its sources and drawing, the headers that they include, its project files, and where a missing header may be.
    """
    project = _project(work)
    first, folder = Path(work.path), work.folder
    found = [work.path, str(folder / FILE_NAME), str(folder / OWN)]
    if first.suffix.lower() in _SKETCH:
        found.append(str(folder))
    if (drawing := _settings(work, project).get("hardware")) is not None:
        found.append(drawing)
    include_dirs = list(work.include_dirs)
    sources = [work.path]
    if first.is_file():
        side = work.path if first.suffix == SIDE else adjacent_project(work.path)
        found.append(str(first.with_suffix(SIDE)))
        if side:
            read = read_side(side)
            sources, include_dirs = [*sources, *read.sources], [*include_dirs, *read.include_dirs]
    else:
        sources = [str(path) for path in folder.iterdir() if path.is_file()]
    found += sources
    found += _included(sources, include_dirs)
    return sorted({os.path.abspath(path) for path in found})


def _included(sources: Sequence[str], include_dirs: Sequence[str]) -> Iterator[str]:
    """The headers that files include, directly or not, and all places where a header that is not found may be."""
    waiting, seen = list(sources), {os.path.abspath(source) for source in sources}
    while waiting:
        path = waiting.pop()
        try:
            names = _INCLUDE.findall(inputs.read_bytes(path, inputs.SOURCE))
        except OSError:
            continue
        for name in {os.fsdecode(each) for each in names if b"\0" not in each}:
            for folder in (os.path.dirname(path), *include_dirs):
                place = os.path.abspath(os.path.join(folder, name))
                if place in seen:
                    break
                yield place  # one before that where it is found would count before it
                if os.path.isfile(place):
                    if len(seen) < _MOST:
                        seen.add(place)
                        waiting.append(place)
                    break


def check_settings(settings: Mapping[str, str]) -> None:
    """Look up what the settings of a specification name, before any program is run with them.

    Args:
        settings: `target`, `from`, `source_platform` ...

    Raises:
        RobosmiError: there is no such target, board or platform.
    """
    if (platform := settings.get("source_platform")) is not None:
        ApiIndex.load(platform)
    for key in ("target", "from"):
        if (name := settings.get(key)) is not None:
            target_facts(name)


def _project(work: ProgramWork) -> Project:
    """The project file beside the program; none where it cannot be read, which the steps report."""
    try:
        return load_project(work.folder)
    except RobosmiError:
        return Project()


def _settings(work: ProgramWork, project: Project) -> dict[str, str]:
    """The settings of a migration: those of the entry, then of the project file beside the program, then of the specification."""
    beside = {
        "hardware": str(project.hardware) if project.hardware is not None else None, "target": project.target,
        "source_platform": project.source_platform, "from": project.source_board,
        "console_wait_ms": str(project.console_wait_ms) if project.console_wait_ms is not None else None,
    }  # fmt: skip
    return {**work.defaults, **{key: value for key, value in beside.items() if value is not None}, **work.migrate}


def _sources(work: ProgramWork, api: ApiIndex) -> ProgramFiles:
    """The files of the program, as a migration reads them: those of its project file and its own headers, too.

    Raises:
        RobosmiError: they cannot be found.
    """
    return program_files([work.path], [Path(each) for each in work.include_dirs], work.defines, api)


def _output(work: ProgramWork) -> Path:
    """The folder for the results of the program, which is made if need be.

    Raises:
        OutsideError: it cannot be made.
    """
    try:
        Path(work.output).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        place = Location(work.output)
        raise OutsideError(f"cannot write here: {error.strerror}", location=place, fix="check the folder") from error
    return Path(work.output)


def analyse_step(work: ProgramWork) -> Rows:
    """What a program uses of its platform.

    Raises:
        RobosmiError: it cannot be read.
    """
    settings = _settings(work, load_project(work.folder))
    platform = settings.get("source_platform") or platform_of_files([Path(work.path)])
    api = ApiIndex.load(platform)
    sources = _sources(work, api)
    sketch = sources.paths[0].suffix.lower() in _SKETCH
    found = analyse(
        sources.paths, source_platform=platform, include_dirs=sources.include_dirs, defines=sources.defines,
        source_board=settings.get("from"), target=settings.get("target") if sketch else None,
    )  # fmt: skip
    rows: dict[str, list[Row]] = {
        "findings": [_finding("analyse", each) for each in (*sources.findings, *found.findings)], "calls": [],
    }  # fmt: skip
    bodies = {} if sketch else _bodies(settings.get("target"), platform)
    seen = views(found.program, api)
    for view in seen:
        path = str(view.unit.path)
        for function in view.functions_of("platform"):
            body = bodies.get((function.name, function.header))
            calls = [*function.calls, *function.made]
            rows["calls"] += [_call(function.name, function.header, int(call.line), path, None, body) for call in calls]
        for function in view.unknown():
            calls = [*function.calls, *function.made]
            rows["calls"] += [_call(function.name, None, int(call.line), path, "unknown", False) for call in calls]
    rows["pins"] = list(_pins(seen))
    if work.keep_models:
        place = _output(work) / "analysis" / "code.xmi"
        place.parent.mkdir(parents=True, exist_ok=True)
        save_model(found.program, place)
        rows["models"] = [{"kind": "code", "path": str(place)}]
    return rows


@cache
def _bodies(target: str | None, platform: str) -> Mapping[tuple[str, str], bool]:
    """(function, header) -> whether an adapter for the target has a body; empty where the platforms have no adapters."""
    try:
        listed = list_adapters(target or default_text("migrate", "target"), platform).result["adapters"]
    except RobosmiError:
        return {}
    rows: Any = listed
    return {(row["function"], row["header"]): row["status"] in _BODY for row in rows}


def _call(name: str, header: str | None, line: int, path: str, disposition: str | None, body: bool | None) -> Row:
    return {
        "function": name, "header": header or None, "line": line, "path": path, "disposition": disposition, "has_body": body
    }  # fmt: skip


def _pins(seen: Sequence[CodeView], ports: ProgramPorts | None = None, places: Mapping[str, str] | None = None) -> Iterator[Row]:
    """The pins that a program uses, calls that its macros make and bits of registers included.

    Args:
        seen: a view of each unit.
        ports: where the flow of port numbers is known, it says which pins an argument may have that the text leaves open.
        places: stored path -> path as it was given.
    """
    through = ports.flows if ports is not None else []
    flows = {id(a.argument): each for each in through for a in each.flow.arguments if a.argument is not None}
    masks = PortMasks(seen)
    for view in seen:
        path = str(view.unit.path)
        path = (places or {}).get(path, path)
        for use in [*pin_uses_of(view, seen), *macro_pin_uses(view), *register_bits(view, masks)]:
            numbers: list[int | None] = [use.pin]
            if use.pin is None and (flow := flows.get(id(use.argument))) is not None:
                numbers = [*flow.numbers, *([None] if flow.anything or not flow.numbers else [])]
            yield from (_pin(use, number, path) for number in numbers)


def _pin(use: PinUse, pin: int | None, path: str) -> Row:
    return {
        "pin": pin, "expression": use.expression, "origin": use.origin, "function": use.function, "direction": use.direction,
        "line": use.line, "path": path,
    }  # fmt: skip


def _finding(step: str, finding: Finding) -> Row:
    place = finding.location
    return {
        "step": step, "rule": finding.rule, "severity": finding.severity.name, "message": finding.message,
        "path": place.path if place else None, "line": place.line if place else None, "column": place.column if place else None,
        "element": finding.element, "fix": finding.fix, "task": isinstance(finding, Task),
    }  # fmt: skip


def migrate_step(work: ProgramWork) -> Rows:
    """The migration of a program into its output folder. Choices of other programs do not count, and nobody is asked.

    Raises:
        RobosmiError: it cannot be migrated.
    """
    project, output = load_project(work.folder), _output(work) / MIGRATION
    settings = _settings(work, project)
    if (wait := settings.get("console_wait_ms")) is not None:
        project = replace(project, console_wait_ms=int(wait))
    if (drawing := settings.get("hardware")) is not None and not os.path.exists(drawing):
        raise OutsideError("there is no such drawing", location=Location(drawing), fix="check hardware")
    read: list[tuple[StoredProgram, ProgramPorts]] = []

    def read_ports(program: StoredProgram) -> ProgramPorts:
        read[:] = [(program, program_ports(program))]
        return read[0][1]

    chain = migration_chain()
    chain.replace("ports", read_ports)
    made = migrate(
        [work.path], output, project=project, hardware=settings.get("hardware"), target=settings.get("target"),
        source_platform=settings.get("source_platform"), source_board=settings.get("from"),
        include_dirs=[Path(each) for each in work.include_dirs],
        defines=work.defines, history=str(output.with_name("history.sqlite")), chain=chain,
    )  # fmt: skip
    plan, places = made.result()["plan"], made.models.places
    program, ports = read[0]
    counts, sites = plan["dispositions"], plan["call_sites"]
    rows: dict[str, list[Row]] = {
        "findings": [_finding("migrate", each) for each in (*made.findings, *made.tasks())],
        "plans": [{
            "target": plan["target"], **{name: counts.get(name, 0) for name in _DISPOSITIONS}, "call_sites": sites["total"],
            "with_body": sites["with_body"], "tasks": plan["tasks"], "open_choices": plan["open_choices"],
            "report": str(made.sketch / "MIGRATION.md"),
        }],
        "calls": list(_calls_of(made.models.plan, program.views, places)),
        "pins": list(_pins(program.views, ports, places)),
        "models": [
            {"kind": Path(name).stem, "path": str(output / name)} for name in sorted(made.contents)
            if name.startswith("models/") and name.endswith(".xmi") and name.count("/") == 1
        ],
    }  # fmt: skip
    work.results["migrated"] = str(output)
    return rows


_DISPOSITIONS = ("retain", "adapt", "drop", "hoist", "rewrite", "unsupported")


def _calls_of(plan: migration.MigrationPlan, seen: Sequence[CodeView], places: Mapping[str, str]) -> Iterator[Row]:
    """The calls that adapters stand for, also those that macros make; of a program whose platform stays, all of its calls.

    Args:
        plan: the plan.
        seen: a view of each unit.
        places: stored path -> path as it was given.
    """
    for view in seen if seen[0].api.sketch is not None else ():
        for function in view.functions_of("platform"):
            for call in (*function.calls, *function.made):
                path = str(view.unit.path)
                yield _call(function.name, function.header, int(call.line), places.get(path, path), "retain", None)
    of_macros = MacroCalls(plan)
    for use in plan.adapterUses:
        status = use.status.name
        header = header_name(use)
        known = header != "unknown"
        disposition = "unsupported" if status == "unsupported" else "adapt" if known else "unknown"
        for call in (*use.calls, *of_macros.of(use)):
            unit = ancestor_of_kind(call, ccode.SourceUnit)
            path = str(unit.path) if unit is not None else ""
            yield _call(use.name, header if known else None, call.line, places.get(path, path), disposition, status in _BODY)


def compile_step(work: ProgramWork) -> Rows:
    """The compile check of the migrated program.

    Raises:
        RobosmiError: the compiler is missing, or the check cannot be made.
    """
    from robosmi.verify.toolchains.compiled_program import compile_into

    done = compile_into(Path(work.results["migrated"]))
    row = {
        "target": done.board, "ok": done.ok, "fits": done.fits, "flash": done.flash_bytes, "ram": done.ram_bytes,
        "messages": len(done.diagnostics),
    }  # fmt: skip
    return {"compiles": [row], "findings": [_finding("compile", each) for each in done.diagnostics]}


def verify_step(work: ProgramWork) -> Rows:
    """The comparison of the original with the migrated program.

    Raises:
        RobosmiError: a tool is missing, or the comparison cannot be made.
    """
    from robosmi.transformations.chains.verify import verify

    done = verify(Path(work.results["migrated"]))
    found: Mapping[str, Any] = done.result
    compared = found.get("compared") or {}
    difference = found.get("first_difference")
    row = {
        "verdict": found["verdict"], "partial": found.get("partial"), "outputs": compared.get("outputs"),
        "outputs_of": compared.get("of"), "lines_pct": compared.get("lines_pct"),
        "first_difference": json_written(difference) if difference else None,
    }  # fmt: skip
    return {"verdicts": [row], "findings": [_finding("verify", each) for each in done.findings]}
