"""The .ecore files that a user names: files, folders with all that are in them, and patterns (`models/*.ecore`)."""

from __future__ import annotations

import glob
import hashlib
from collections.abc import Iterable
from pathlib import Path

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.model.elements.datatypes import ECORE_URI

_OTHER_NOTATIONS = {
    ".emf": "an Emfatic text",
    ".xcore": "an Xcore text",
    ".genmodel": "a model for EMF's generator",
    ".uml": "a UML model",
    ".xsd": "an XML schema",
}


def means_ecore(given: str | Path) -> bool:
    """Whether a metamodel that is named is Ecore itself, by its name or URI, and no file."""
    return str(given) in ("ecore", ECORE_URI, str(Path(ECORE_URI))) and not Path(given).exists()


def metamodel_files(given: Iterable[str | Path]) -> list[Path]:
    """The files in the order given, each content once; those of a folder, with its folders, are sorted.

    Raises:
        SourceError: a folder or pattern has none, or a file is a metamodel in another notation.
    """
    found: list[Path] = []
    for each in given:
        path = Path(each)
        if path.is_dir():
            files = sorted(file for file in path.rglob("*.ecore") if file.is_file())  # Eclipse projects may be called so
        elif glob.has_magic(str(path)) and not path.exists():
            files = sorted(file for name in glob.glob(str(path), recursive=True) if (file := Path(name)).is_file())
        else:
            found.append(_checked(path))
            continue
        if not files:
            what = f"'{path}' has no .ecore file"
            raise SourceError(what, location=Location(str(path)), fix="give a folder, or a pattern, with .ecore files")
        found += _each_once(files)
    return found


def _each_once(files: Iterable[Path]) -> list[Path]:
    """The files without copies of one that is there already, as builds leave them."""
    seen: dict[str, Path] = {}
    for path in files:
        seen.setdefault(hashlib.sha256(inputs.read_bytes(path, inputs.MODEL)).hexdigest(), path)
    return list(seen.values())


def _checked(path: Path) -> Path:
    if (what := _OTHER_NOTATIONS.get(path.suffix.lower())) is not None:
        fix = "make an .ecore file of it with Eclipse, and give that"
        raise SourceError(f"'{path.name}' is {what}, which is not read", location=Location(str(path)), fix=fix)
    return path
