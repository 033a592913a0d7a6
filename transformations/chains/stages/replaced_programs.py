"""Tells a person when a program replaces another one in an output folder."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.transformations.chains.stages.models import FOLDER, LAST
from robosmi.transformations.chains.stages.program import sketch_name_of
from robosmi.transformations.m2t.program_files import BENCH


def replaced_programs(output: Path, name: str, going: Iterable[str], contents: Iterable[str]) -> list[Finding]:
    """Findings about sketches of other programs in this folder, whose files are removed or replaced."""
    staying = {Path(path).name for path in contents}
    sources = sorted(Path(path).name for path in going if path.startswith(f"{FOLDER}/source/"))
    same = [each for each in sources if each.endswith(".c") and each not in staying and sketch_name_of(Path(each)) == name]
    others = {path.partition("/")[0] for path in going} - {name, FOLDER, LAST.partition("/")[0]}
    tried = [
        Finding(
            "RS526", Severity.warning, "the bench sketch is removed because this run has no --bench",
            Location(str(output / BENCH)), fix="migrate with --bench to keep it",
        )
        for _ in others & {BENCH}
    ]  # fmt: skip
    tried += [
        Finding(
            "RS526", Severity.warning,
            f"this program replaces '{each}' in the sketch '{name}', including its edits",
            Location(str(output / name)),
            fix="give each program an output folder of its own; `robosmi undo` restores the other",
        )
        for each in same
    ]  # fmt: skip
    return tried + [
        Finding(
            "RS526", Severity.warning, f"the sketch '{other}' of an earlier run is removed: this run generates '{name}' here",
            Location(str(output / other)), fix="give each program an output folder of its own",
        )
        for other in sorted(others - {BENCH})
    ]  # fmt: skip
