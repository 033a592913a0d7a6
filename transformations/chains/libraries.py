"""The chains `libraries import`, `install` and `show`: installed libraries in the user's index and in a sketch, a library's API.

The ranking uses the user's index together with the shipped one. The imported facts are kept beside it (`installed.jsonl.gz`),
so that a second import adds to the first; a library that is imported again replaces its earlier facts.
"""

from __future__ import annotations

import gzip
import json
from pathlib import Path
from typing import Any, cast

from msgspec import Struct

from robosmi.base.data_text import json_of
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.files.files import write_atomic
from robosmi.files.packed_lines import packed_lines
from robosmi.files.recovery import at_work
from robosmi.generate.output_paths import Places
from robosmi.recommend.library_api import LibraryApi
from robosmi.transformations.chains.stages.edited_plan import STORED
from robosmi.transformations.chains.stages.models import stored_models
from robosmi.transformations.chains.stages.output import Generated, produce
from robosmi.transformations.chains.stages.refresh_findings import refresh_findings
from robosmi.transformations.constraints.plan_edits import refuse_nonsense
from robosmi.transformations.knowledge.libraries.library_ranking import (
    LibraryFacts,
    installed_index,
    library_api,
    library_by_name,
)
from robosmi.transformations.knowledge.platforms.portability_facts import portability_facts
from robosmi.transformations.m2m.plan_tasks import settle
from robosmi.transformations.t2m.installed_libraries import read_libraries
from robosmi.transformations.t2m.library_index import build
from robosmi.transformations.t2m.library_rows import LibraryRow


class Imported(Struct, frozen=True):
    """What an import did.

    Attributes:
        index: the user's own index.
        added: name and version of each library that was read.
        skipped: path -> why it was left out.
        known: how many libraries the user's index has now.
    """

    index: Path
    added: list[tuple[str, str]]
    skipped: dict[str, str]
    known: int


class ShownLibrary(Struct, frozen=True):
    """A library with its API."""

    facts: LibraryFacts
    api: LibraryApi

    @property
    def result(self) -> dict[str, Any]:
        """The contract's result."""
        library = self.facts.library
        return {
            "name": library.name, "version": library.version, "header": library.header, "author": library.author,
            "license": library.license, "url": library.url, "architectures": list(library.architectures),
            "depends": list(self.facts.depends), "installed": library.installed,
            "api": [header.to_json() for header in self.api.headers],
        }  # fmt: skip

    def lines(self) -> list[str]:
        """What the user reads."""
        library = self.facts.library
        where = ", installed here" if library.installed else ""
        lines = [f"{library.name} {library.version}".rstrip() + f" <{library.header}>{where}"]
        lines += [f"  needs {', '.join(self.facts.depends)}"] if self.facts.depends else []
        for header in self.api.headers:
            lines.append(f"  {header.file}" + (f" (by {header.include})" if header.include != header.file else ""))
            for each in header.classes:
                lines.append(f"    {each.kind} {each.name}" + (f" : {', '.join(each.bases)}" if each.bases else ""))
                lines += [f"      {each.name.rpartition('::')[2]}{parameters}" for parameters in each.constructors]
                lines += [f"      {method.signature}" for method in each.methods]
            lines += [f"    {function.signature}" for function in header.functions]
            lines += [f"    enum {name}: {', '.join(values)}".replace("enum :", "enum:") for name, values in header.enums.items()]
            lines += [f"    {name} = {value}" for name, value in header.constants.items()]
        return lines if self.api.headers else [*lines, "  the declarations of its headers are unknown"]


def show_library(name: str, platform: str) -> ShownLibrary:
    """A library of the index, with its API.

    Raises:
        UsageError: the index has none of that name.
    """
    facts = library_by_name(name, platform)
    return ShownLibrary(facts, library_api(facts.name, platform))


def import_libraries(folder: Path, platform: str) -> Imported:
    """Add the libraries of a folder to the user's index of a platform.

    Raises:
        SourceError: there is no such folder, or the user's own facts are damaged.
        PlatformDataError: more headers than an index holds.
    """
    facts = portability_facts(platform)
    found = read_libraries(folder, [name for kind in facts.registers.values() for name in kind] if facts is not None else [])
    index = installed_index(platform)
    kept = index.with_suffix(".jsonl.gz")
    rows = {row["name"]: row for row in _rows(kept)} | {row["name"]: row for row in found.rows}
    if found.rows:
        index.parent.mkdir(parents=True, exist_ok=True)
        lines = "".join(json.dumps(row, sort_keys=True) + "\n" for _, row in sorted(rows.items()))
        write_atomic(kept, gzip.compress(lines.encode(), mtime=0))
        build(kept, index)
    added = sorted((str(row["name"]), str(row["version"])) for row in found.rows)
    return Imported(index, added, found.skipped, len(rows))


def pin_library(output: Path, name: str, version: str) -> Generated | None:
    """Make the sketch of an output folder again with a version of a library: in `sketch.yaml` and `platformio.ini`.

    Args:
        output: the output folder of a migration.
        name: name of the library.
        version: its version.

    Returns:
        What was written; None if the plan does not use the library.

    Raises:
        SourceError: the folder has no plan, or cannot be written.
        StoppedError: the user's edit would be lost.
    """
    if not (output / STORED).is_file():
        raise SourceError("this folder has no plan", location=Location(str(output)), fix="give the output folder of a migration")
    with at_work(output):
        stored = Places(output).read(STORED) or b""
        models = stored_models(output)
        target = models.plan.target
        found = [each for each in target.libraries if each.name == name] if target is not None else []
        if target is None or not found:
            return None
        for library in found:
            library.version = version
        if name in target.coreLibraries:  # the user wants that one
            target.coreLibraries.remove(name)
        refuse_nonsense(models.plan)
        settle(models.plan, models.files)
        refresh_findings(models.plan, words=False)
        return produce(models, output, inputs={STORED: stored}, diff=True, run=f"library {name} {version}")


def _rows(facts: Path) -> list[LibraryRow]:
    """The facts of earlier imports; a damaged file counts as empty, since importing again restores it."""
    try:
        with packed_lines(facts) as lines:
            rows = [json_of(line) for line in lines]
            return [cast("LibraryRow", row) for row in rows if isinstance(row, dict) and row.get("name")]
    except (OSError, EOFError, ValueError):
        return []
