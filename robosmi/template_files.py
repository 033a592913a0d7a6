"""Templates of folders for Jinja, read where all files are; those that were merely found only as they were trusted.

The environments that run them are the framework's: `generate.templates`, and `model.codegen` for packages.
"""

from __future__ import annotations

import os
import posixpath
from collections.abc import Callable, Sequence
from functools import partial

import jinja2
from jinja2.loaders import split_template_path

from robosmi import inputs, trust


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


def _is_of(path: str, changed: int) -> bool:
    try:
        return os.stat(path).st_mtime_ns == changed
    except OSError:
        return False
