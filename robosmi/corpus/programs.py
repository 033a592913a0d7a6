"""Which programs a specification has: the files of folders, repositories and lists, each with its id.

What is not there is no error: it is a program that is not run, with the reason. Two programs of one id are an error.
"""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterator
from pathlib import Path

from msgspec import Struct

from robosmi import inputs
from robosmi.base.quantities import quantity
from robosmi.corpus.repositories import checkout
from robosmi.corpus.spec import ProgramPlace, Spec
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, did_you_mean
from robosmi.files.files import read_input
from robosmi.plugins import content

SOURCES = "sources"
"""The folder in OUT in which commits are laid out."""


class ProgramSource(Struct, frozen=True):
    """A program of a corpus.

    Attributes:
        id: `programs.id`.
        path: the file or folder, absolute.
        place: the entry of the specification that has it.
        repository: the git repository, or None.
        revision: the commit, or None.
        labels: its labels.
        missing: why it cannot be run; None if it can.
        origin: where it is named, for messages.
        root: the folder in which the commit is laid out; None without one.
    """

    id: str
    path: str
    place: ProgramPlace
    repository: str | None = None
    revision: str | None = None
    labels: dict[str, str] = {}
    missing: str | None = None
    origin: str = ""
    root: str | None = None


def program_sources(spec: Spec, out: Path) -> list[ProgramSource]:
    """The programs of a specification, in its order; a pattern that no file matches stands for a program that is missing.

    Args:
        spec: the specification.
        out: the output folder: commits are laid out there, and what lies in it is no program.

    Raises:
        SourceError: two programs have one id, or a list cannot be read.
        MissingToolError: there is a repository, and git is not installed.
    """
    found: dict[str, ProgramSource] = {}
    for place in spec.places:
        for source in _of_place(place, spec, out):
            if (other := found.get(source.id)) is not None:
                raise SourceError(
                    f"two programs have the id '{source.id}': {other.path} ({other.origin}) and {source.path} ({source.origin})",
                    location=Location(str(spec.path)),
                    fix="name each program once: change a pattern or an id in the list, or give an entry a prefix: prefix = ...",
                )
            found[source.id] = source
    return list(found.values())


def _of_place(place: ProgramPlace, spec: Spec, out: Path) -> Iterator[ProgramSource]:
    origin = f"[[programs]] number {place.number}"
    if place.list is not None:
        yield from _of_list(place, spec)
    elif place.git is not None:
        name = f"{place.prefix}{_shown(str(place.git), spec)}"
        laid = checkout(place.git, place.revision, out / SOURCES)
        if laid.missing is not None:
            yield ProgramSource(name, str(place.git), place, labels=place.labels, missing=laid.missing, origin=origin)
            return
        for path in _matches(laid.folder, place.glob, None):
            inner = path.relative_to(laid.folder).as_posix()
            yield ProgramSource(
                f"{name}/{_text(inner)}", str(path), place, str(place.git.resolve()), laid.commit, place.labels, origin=origin,
                root=str(laid.folder),
            )  # fmt: skip
    else:
        folder = Path(os.path.normpath(place.folder))
        if not folder.is_dir():
            name = f"{place.prefix}{_shown(str(folder), spec)}"
            yield ProgramSource(name, str(folder), place, labels=place.labels, missing="there is no such folder", origin=origin)
            return
        count = 0
        for count, path in enumerate(_matches(folder, place.glob, out), 1):  # noqa: B007
            name = f"{place.prefix}{_shown(str(path), spec)}"
            yield ProgramSource(name, str(path), place, labels=place.labels, missing=_missing(path), origin=origin)
        if not count:
            path = folder / place.glob if place.glob is not None else folder
            why = "no file matches the pattern" if place.glob is not None else "no source file in it defines main"
            yield ProgramSource(
                f"{place.prefix}{_shown(str(path), spec)}", str(path), place, labels=place.labels, missing=why, origin=origin
            )


def _shown(path: str, spec: Spec) -> str:
    """A path relative to the specification's folder where it lies below, else absolute."""
    path, folder = os.path.normpath(path), os.path.normpath(spec.folder)
    if path.startswith(folder.rstrip(os.sep) + os.sep):
        path = os.path.relpath(path, folder)
    return _text(Path(path).as_posix())


def _text(name: str) -> str:
    """A name with its bytes that are no UTF-8 written out, so that every database can hold it."""
    return os.fsencode(name).decode("utf-8", "backslashreplace").replace("\0", "\\0")


def _matches(folder: Path, pattern: str | None, out: Path | None) -> Iterator[Path]:
    """The programs below a folder, sorted: what matches the pattern, else every source file that is a program by itself."""
    if pattern is None:
        candidates = (Path(root) / name for root, _, names in os.walk(folder) for name in names)
        paths = sorted(path for path in candidates if not _inside(path, out))
        yield from content("chain", "corpus_programs")(paths)
        return
    root = Path(pattern).anchor
    try:
        matched = Path(root or folder).glob(os.path.relpath(pattern, root) if root else pattern)
        paths = sorted({Path(os.path.normpath(path)) for path in matched})
    except (ValueError, NotImplementedError, OSError) as error:
        raise SourceError(f"the pattern '{pattern}' cannot be used: {error}", fix="give a pattern as programs/**/*.c") from error
    for path in paths:
        if not _inside(path, out) and (path.is_file() or path.is_dir() or path.is_symlink()):
            yield path


def _missing(path: str | Path) -> str | None:
    """Why a program cannot be read; None if it is there."""
    if os.path.exists(path):
        return None
    return "the link leads to nothing" if os.path.islink(path) else "there is no such file"


def _inside(path: Path, out: Path | None) -> bool:
    return out is not None and path.is_relative_to(out)


def _of_list(place: ProgramPlace, spec: Spec) -> Iterator[ProgramSource]:
    """The programs of a CSV file; columns but `id` and `path` are labels, and an empty id is the path's."""
    assert place.list is not None
    where = Location(str(place.list))
    data = read_input(place.list, "list of programs", inputs.TABLE)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise SourceError(f"the list is not UTF-8: {error.reason}", location=where, fix="save it as UTF-8") from error
    rows = _rows(place.list, text)
    _, names = next(rows, (1, []))
    if "path" not in names:
        said = f"; its columns are: {', '.join(names)}{did_you_mean('path', [name.lower() for name in names])}" if names else ""
        raise SourceError(f"the list has no column 'path'{said}", location=where, fix="begin it with the line: id,path")
    for name in names:
        if name and names.count(name) > 1:
            raise SourceError(
                f"two columns of the list are named '{name}'", location=Location(str(place.list), 1), fix="rename one"
            )
    count = 0
    for line, cells in rows:
        if any(cells[len(names) :]):
            found = f"this row has {len(cells)} cells, and the list {quantity(len(names), 'column')}"
            raise SourceError(
                found, location=Location(str(place.list), line), fix="put a cell that has the separator in quotation marks"
            )
        row = dict(zip(names, cells, strict=False))
        if not row.get("path"):
            if any(cells):
                raise SourceError("this program has no path", location=Location(str(place.list), line), fix="give its path")
            continue
        count += 1
        path = os.path.normpath(os.path.join(os.path.dirname(place.list), row["path"]))
        labels = {name: cell for name, cell in row.items() if name not in ("id", "path", "") and cell}
        yield ProgramSource(
            f"{place.prefix}{_text(row.get('id') or _shown(path, spec))}", path, place, labels={**place.labels, **labels},
            missing=_missing(path), origin=f"{place.list.name}, line {line}",
        )  # fmt: skip
    if not count:
        name = f"{place.prefix}{_shown(str(place.list), spec)}"
        yield ProgramSource(
            name, str(place.list), place, labels=place.labels, missing="the list has no programs", origin=place.list.name
        )


def _rows(path: Path, text: str) -> Iterator[tuple[int, list[str]]]:
    """The line at which each row of a CSV file begins, and its cells without blanks around them.

    Raises:
        SourceError: a row is no CSV; a quotation mark that nothing closes would take the rows behind it into its cell.
    """
    head = text.partition("\n")[0]
    rows = csv.reader(io.StringIO(text, newline=""), delimiter=max(",;\t", key=head.count), strict=True)
    while True:
        line = rows.line_num + 1
        try:
            cells = next(rows, None)
        except csv.Error as error:
            fix = 'close each quotation mark, and write one that belongs to a text twice: ""'
            raise SourceError(f"this row is no CSV: {error}", location=Location(str(path), line), fix=fix) from error
        if cells is None:
            return
        yield line, [cell.strip() for cell in cells]
