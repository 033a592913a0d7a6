"""Templates of folders for Jinja, read where all files are; those that were merely found only as they were trusted.

The environments that run them are the framework's: `generate.templates`, and `model.codegen` for packages.
"""

from __future__ import annotations

import os
import posixpath
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from pathlib import Path

import jinja2
from jinja2.loaders import split_template_path

from robosmi import inputs, resources
from robosmi.base import trust
from robosmi.errors import did_you_mean

FOLDER = "templates"
"""The folder of templates in a folder of data."""


class TemplateFiles(jinja2.FileSystemLoader):
    """Templates of folders, the first that has one counts.

    Args:
        folders: the folders.
        found: whether nobody named them; a template of a project's `.robosmi` then runs only as it was trusted (see `trust`).
    """

    def __init__(self, folders: Sequence[str], *, found: bool) -> None:
        super().__init__(folders)
        self._found = found

    def get_source(self, environment: jinja2.Environment, template: str) -> tuple[str, str, Callable[[], bool]]:
        """The text of a template, its path, and how to ask whether it is still so.

        Raises:
            TemplateNotFound: no folder has it.
            SourceError: it is not trusted.
            OSError: it cannot be read.
        """
        pieces = split_template_path(template)
        for folder in self.searchpath:
            path = posixpath.join(folder, *pieces)
            try:
                changed = os.stat(path).st_mtime_ns
                data = inputs.read_bytes(path, inputs.DATA)
            except (FileNotFoundError, NotADirectoryError, IsADirectoryError):
                continue
            if self._found:
                trust.check(path, data)
            text = data.decode(self.encoding).replace("\r\n", "\n").replace("\r", "\n")
            return text, os.path.normpath(path), partial(_is_of, path, changed)
        raise jinja2.TemplateNotFound(template)


def misnamed(own: Path, files: Iterable[str]) -> dict[str, str]:
    """The templates of a project whose names are nearly those of templates that they do not replace.

    One that another template of the project names, as by `include`, is not among them; names in Python code are not known here.

    Args:
        own: the project's `.robosmi` folder, which is trusted.
        files: relative paths of files in it.

    Returns:
        Relative path -> ` (did you mean '...'?)`.

    Raises:
        SourceError: a template cannot be read.
    """
    mine = own / FOLDER
    known = {
        path.relative_to(folder).as_posix()
        for folder in (resources.built_in(FOLDER), *resources.folders(FOLDER, own.parent))
        if folder.resolve() != mine.resolve()
        for path in folder.rglob("*")
    }
    names = {name: name.removeprefix(f"{FOLDER}/") for name in files if name.startswith(f"{FOLDER}/")}
    texts = {name: inputs.read_text(own / name, inputs.DATA, errors="replace") for name in names}
    found = {
        name: did_you_mean(short, known)
        for name, short in names.items()
        if short not in known and not any(short in text for other, text in texts.items() if other != name)
    }
    return {name: meant for name, meant in found.items() if meant}


def _is_of(path: str, changed: int) -> bool:
    try:
        return os.stat(path).st_mtime_ns == changed
    except OSError:
        return False
