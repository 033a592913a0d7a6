"""Compiled templates, kept from one run to the next in the user's cache folder: compiling takes longer than rendering.

What is kept is the code that Jinja made of a template's text, found again by that text, Jinja's version and our own modules. A
file that another user could have written, or that cannot be read, is passed over, and where the folder cannot be written
nothing is kept.
"""

from __future__ import annotations

import hashlib
import os
import stat
import tempfile
from contextlib import suppress
from pathlib import Path

import jinja2
from jinja2.bccache import Bucket

from robosmi.inputs import flags
from robosmi.user_folders import cache_dir

_MODULES = [
    os.path.join(os.path.dirname(__file__), f"{name}.py")
    for name in ("borders", "contexts", "data_places", "languages", "out", "output", "quoting_filters", "templates")
]
"""They say how templates are compiled: code that was made before one of them changed is not used."""


class TemplateCache(jinja2.BytecodeCache):
    """The cache of the environment that has no values and filters of a caller's: what these are decides what code is made."""

    _known: str | None = None

    def _place(self, bucket: Bucket) -> Path:
        if self._known is None:
            made = [jinja2.__version__, *(f"{path} {_stamp(path)}" for path in _MODULES)]
            self._known = hashlib.sha256("\n".join(made).encode()).hexdigest()[:16]
        return cache_dir() / "templates" / f"{self._known}-{bucket.key}"

    def load_bytecode(self, bucket: Bucket) -> None:
        """Fill in the code of a template, if it is there."""
        with suppress(OSError):
            opened = os.open(self._place(bucket), os.O_RDONLY | flags("O_NOFOLLOW", "O_CLOEXEC"))
            with os.fdopen(opened, "rb") as file:
                if _is_ours(os.fstat(opened)):
                    bucket.load_bytecode(file)

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Keep the code of a template, in one step."""
        place = self._place(bucket)
        with suppress(OSError):
            place.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            handle, name = tempfile.mkstemp(dir=place.parent, prefix=".")
            try:
                with os.fdopen(handle, "wb") as file:
                    bucket.write_bytecode(file)
                os.replace(name, place)
            except OSError:
                os.unlink(name)


def _stamp(path: str) -> int:
    try:
        return os.stat(path).st_mtime_ns
    except OSError:  # a module in a zip archive
        return 0


def _is_ours(found: os.stat_result) -> bool:
    """Whether a file is a plain one that nobody but this user (or root) can have written."""
    if not stat.S_ISREG(found.st_mode):
        return False
    if not hasattr(os, "geteuid"):
        return True
    return found.st_uid in (os.geteuid(), 0) and not found.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
