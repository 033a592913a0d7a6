"""The coverage of the original by runs: lines and branches of the user's files, as the compiler counts them.

A run leaves its coverage counters. `reached` compares runs with each other, which is cheap; `coverage` asks the compiler's
coverage tool which lines and branches the counters stand for.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from robosmi.base.data_text import as_table, json_of
from robosmi.errors import InternalError, MissingToolError
from robosmi.verify.coverage_files import counters_file, read_notes
from robosmi.verify.joined_objects import Counters
from robosmi.verify.original import SourceCoverage
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.toolchains.temporary import temporary_folder
from robosmi.verify.toolchains.tools import run

_COUNTER_BYTES = 8


def reached(program: OriginalProgram, counts: bytes) -> frozenset[int]:
    """The edges of the program's flow that a run has taken, as numbers that mean the same in each run of one program.

    Args:
        program: what ran.
        counts: what the run left (`OriginalRun.counts`).
    """
    places = (at for each in program.counters for at in range(each.begin, each.begin + each.size, _COUNTER_BYTES))
    return frozenset(at for at in places if any(counts[at : at + _COUNTER_BYTES]))


def coverage(program: OriginalProgram, runs: Iterable[bytes]) -> SourceCoverage:
    """Lines and branches that runs have reached together.

    Args:
        program: what ran; the folder that it was built in must still be there.
        runs: what each run left (`OriginalRun.counts`); runs that left nothing count for nothing.

    Raises:
        MissingToolError: the coverage tool is not installed.
    """
    _write_counters(program, [counts for counts in runs if counts])
    folder = program.binary.parent
    lines: dict[tuple[str, int], int] = {}
    branches: dict[tuple[str, int, int], int] = {}
    functions: dict[tuple[str, int], str] = {}
    for data in sorted(folder.glob("*.gcda")):
        for file in _ask(program, data)["files"]:
            name = str((Path(_ask_folder(program)) / file["file"]).resolve())
            for line in file["lines"]:
                place = name, int(line["line_number"])
                lines[place] = lines.get(place, 0) + int(line["count"])
                functions[place] = str(line.get("function_name", ""))
                for number, branch in enumerate(line["branches"]):
                    branches[*place, number] = branches.get((*place, number), 0) + int(branch["count"])
    return SourceCoverage(lines, branches, functions)


def _ask_folder(program: OriginalProgram) -> Path:
    return program.binary.parent


def _write_counters(program: OriginalProgram, runs: Sequence[bytes]) -> None:
    """Write the coverage tool's file for each object, with the counters of all runs."""
    of_object: dict[Path, list[Counters]] = {}
    for each in program.counters:
        of_object.setdefault(each.notes, []).append(each)
    for path, counters in of_object.items():
        notes = read_notes(path)
        functions = {function.name: function for function in notes.functions}
        counts = [(functions[each.function], _summed(each, runs)) for each in counters if each.function in functions]
        path.with_suffix(".gcda").write_bytes(counters_file(notes, counts, len(runs)))


def _summed(counters: Counters, runs: Sequence[bytes]) -> list[int]:
    """The counters of a function, summed over runs."""
    layout = struct.Struct(f"<{counters.size // _COUNTER_BYTES}Q")
    found = [layout.unpack_from(counts, counters.begin) for counts in runs if len(counts) >= counters.begin + layout.size]
    return [sum(each) for each in zip(*found, strict=True)] or [0] * (counters.size // _COUNTER_BYTES)


def _ask(program: OriginalProgram, data: Path) -> dict[str, Any]:
    tool = program.model.tools()["coverage"]
    with temporary_folder("coverage") as place:
        command = [tool, "--json-format", "--stdout", "--branch-probabilities", str(data)]
        try:
            done = run(command, Path(place))
        except MissingToolError as error:
            raise MissingToolError(error.message, fix=program.model.install) from error
    try:
        answer: dict[str, Any] = as_table(json_of(done.stdout))
    except ValueError:
        raise InternalError(f"'{tool}' printed no coverage data: {done.stderr.strip()[-300:]}") from None
    return answer
