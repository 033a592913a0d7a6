"""Keeps compiled templates in the user's cache folder between runs, since compiling takes longer than rendering.

The cache contains the code that Jinja made of a template's text; the key consists of the text, Jinja's version and our own
modules.
"""

from __future__ import annotations

import hashlib
import os

import jinja2
from jinja2.bccache import Bucket

from robosmi.user_cache import keep, read_kept

_MODULES = [
    os.path.join(os.path.dirname(__file__), f"{name}.py")
    for name in ("borders", "contexts", "data_places", "languages", "out", "output", "quoting_filters", "templates")
]
"""They say how templates are compiled: code that was made before one of them changed is not used."""


class TemplateCache(jinja2.BytecodeCache):
    """The cache of the environment that has no values and filters of a caller's: what these are decides what code is made."""

    _known: str | None = None

    def _name(self, bucket: Bucket) -> str:
        if self._known is None:
            made = [jinja2.__version__, *(f"{path} {_stamp(path)}" for path in _MODULES)]
            self._known = hashlib.sha256("\n".join(made).encode()).hexdigest()[:16]
        return f"templates/{self._known}-{bucket.key}"

    def load_bytecode(self, bucket: Bucket) -> None:
        """Fill in the code of a template, if it is there."""
        if (kept := read_kept(self._name(bucket))) is not None:
            bucket.bytecode_from_string(kept)

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Keep the code of a template, in one step."""
        keep(self._name(bucket), bucket.bytecode_to_string())


def _stamp(path: str) -> int:
    try:
        return os.stat(path).st_mtime_ns
    except OSError:  # a module in a zip archive
        return 0
