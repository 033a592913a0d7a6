"""Writes generated Python packages where the user's files may lie: atomically, and without overwriting the user's files.

`generate_packages` is the function behind `robosmi metamodels generate`. Each outermost package is a folder with a record
(`.robosmi.json`) of its generated files, so that an edited or foreign file stops the run. `model.codegen` generates the files.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from msgspec import Struct

from robosmi import inputs
from robosmi.diagnostics import Finding, Severity
from robosmi.files.commit import update
from robosmi.files.recovery import at_work
from robosmi.generate.manifest import NAME, Manifest, hidden, reformed_file, retained_file
from robosmi.generate.output_paths import Places
from robosmi.model.generator.codegen import Rendered, render


class GeneratedPackages(Struct, frozen=True):
    """The result of a generation of packages.

    Attributes:
        written: the files that are new or changed.
        unchanged: the files that had these bytes already.
        removed: files of an earlier run that this one no longer makes.
        sources: generated file -> the .ecore file it comes from.
        findings: what was left out, has another name, or is not as the metamodel says.
        classes: number of classes.
    """

    written: list[Path]
    unchanged: list[Path]
    removed: list[Path]
    sources: dict[Path, Path]
    findings: list[Finding]
    classes: int


def generate_packages(metamodels: Sequence[str | Path], folder: str | Path) -> GeneratedPackages:
    """Generate typed Python packages from .ecore files and all files that they refer to.

    Args:
        metamodels: the .ecore files.
        folder: where the packages' folders are made; packages import each other relative to it.

    Raises:
        SourceError: a file cannot be read or written.
        ModelError: a metamodel cannot be used; all reasons together.
        StoppedError: a file in the way was edited, or was not made by robosmi.
    """
    folder = Path(folder)
    rendered = render([Path(each) for each in metamodels], folder)
    with at_work(folder):
        contents: dict[str, bytes] = {}
        obsolete: set[str] = set()
        seen: dict[str, bytes | None] = {}
        told: list[Finding] = []
        for root in sorted({path.partition("/")[0] for path in rendered.files}):
            inner = {path.partition("/")[2]: data for path, data in rendered.files.items() if path.partition("/")[0] == root}
            places = Places(folder / root)
            manifest = Manifest.load(folder / root)
            guarded = manifest.guard(places, inner)
            going = {name for name in guarded.obsolete if manifest.may_remove(name) and not hidden(name)}
            obsolete |= {f"{root}/{name}" for name in going}
            told += [retained_file(folder / root / name) for name in sorted(guarded.obsolete - going)]
            seen |= {f"{root}/{name}": data for name, data in places.seen.items()}
            told += [reformed_file(folder / root / name) for name in guarded.reformed]
            contents |= {f"{root}/{name}": data for name, data in inner.items()}
            contents[f"{root}/{NAME}"] = Manifest.of(inner).to_bytes()
            manifest.note(folder / root, contents[f"{root}/{NAME}"])
        unchanged = {path for path, data in rendered.files.items() if _has(folder / path, data)}
        update(folder, contents, obsolete, seen)
    return GeneratedPackages(
        [folder / path for path in sorted({*rendered.files} - unchanged)],
        [folder / path for path in sorted(unchanged)],
        [folder / path for path in sorted(obsolete)],
        {folder / path: source for path, source in rendered.sources.items()},
        [*rendered.findings, *_import_names(rendered, folder), *told],
        rendered.classes,
    )


def _has(path: Path, data: bytes) -> bool:
    return path.is_file() and inputs.read_bytes(path, inputs.OUTPUT) == data


def _import_names(rendered: Rendered, folder: Path) -> Iterator[Finding]:
    """Findings on packages that must not be found by their own name alone."""
    for root in sorted({path.partition("/")[0] for path in rendered.files}):
        if root in sys.stdlib_module_names:
            yield Finding(
                "RS606",
                Severity.info,
                f"the package '{root}' has the name of a module of Python's own library",
                element=root,
                fix=f"import it as {folder.resolve().name}.{root}; do not put {folder} itself on Python's path",
            )
