"""Lists and loads adapter files; parsed files are cached between runs, since parsing takes longer than loading."""

from __future__ import annotations

from pathlib import Path

from robosmi import inputs
from robosmi.base.user_cache import CachedResults, code_version
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError
from robosmi.transformations.knowledge.adapters.adapter_files import adapter_file
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterFile

ENDINGS = (".cpp", ".c")
"""Endings of adapter files, in C++ and in C."""
_VERSION = code_version(
    "robosmi.transformations.knowledge.lexer",
    "robosmi.transformations.knowledge.adapters.adapter_checks",
    "robosmi.transformations.knowledge.adapters.adapter_files",
    "robosmi.transformations.knowledge.adapters.adapter_ranges",
    "robosmi.transformations.knowledge.adapters.adapter_records",
)
"""The version of the modules that parse and check adapter files: files that an older one parsed are parsed again."""
_PARSED = CachedResults("adapters.json", _VERSION, AdapterFile, 400)


def adapter_paths(folder: Path) -> list[Path]:
    """The adapter files of a folder and its subfolders (for headers such as `sys/time.h`), sorted by name."""
    return sorted(path for pattern in ("*", "*/*") for path in folder.glob(pattern) if path.suffix in ENDINGS)


def load(path: Path) -> AdapterFile:
    """Load an adapter file.

    Raises:
        PlatformDataError: the file cannot be read, or a marker in it is wrong.
    """
    try:
        text = inputs.read_bytes(path, inputs.DATA).decode("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise PlatformDataError(f"the adapter file cannot be read: {error}", location=Location(str(path))) from error
    key = f"{path}\n{text}"  # locations of pieces name the path
    if (file := _PARSED.get(key)) is None:
        file = adapter_file(path, text)
        _PARSED.put(key, file)
    return file
