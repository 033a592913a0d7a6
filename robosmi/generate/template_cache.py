"""Caches compiled templates in the user's cache folder between runs, since compiling takes longer than rendering.

The cache contains the code that Jinja made of a template's text; the key consists of the text, Jinja's version and our own
modules.
"""

from __future__ import annotations

import os

import jinja2
from jinja2.bccache import Bucket

from robosmi.user_cache import code_version, read_cached, write_cached

_MODULES = ("borders", "contexts", "data_places", "languages", "out", "output", "quoting_filters", "templates")
"""They say how templates are compiled: code that was made before one of them changed is not used."""


class TemplateCache(jinja2.BytecodeCache):
    """The cache of the environment that has no values and filters of a caller's: what these are decides what code is made."""

    _known: str | None = None

    def _name(self, bucket: Bucket) -> str:
        if self._known is None:
            self._known = f"{jinja2.__version__}-{code_version(os.path.dirname(__file__), _MODULES)}"
        return f"templates/{self._known}-{bucket.key}"

    def load_bytecode(self, bucket: Bucket) -> None:
        """Fill in the code of a template, if it is there."""
        if (code := read_cached(self._name(bucket))) is not None:
            bucket.bytecode_from_string(code)

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Cache the code of a template."""
        write_cached(self._name(bucket), bucket.bytecode_to_string())
