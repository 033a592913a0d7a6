"""Packages that robosmi needs, installed in broken ways: missing, without their shared library, in another version, damaged.

A package of the same name is put before the installed one on Python's path. `hostile_world` checks what a command says then.
"""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from functools import partial
from pathlib import Path

from tests.hostile_world import World

PACKAGES = ("clang", "filelock", "jinja2", "lxml", "networkx", "pyecore", "pyecoregen")
BROKEN = {
    "missing": "raise ModuleNotFoundError(f\"No module named '{__name__}'\", name=__name__)",
    "without its shared library": (
        "raise ImportError('libxyz.so.2: cannot open shared object file: No such file or directory', name=__name__ + '.native')"
    ),
    "without anything in it": "",
    "of another version": "def __getattr__(name): raise AttributeError(f\"module '{__name__}' has no attribute '{name}'\")",
    "no Python": "this is \0 no Python",
    "of a Python that is gone": "raise SystemError('initialization of the module failed')",
    "ending the program": "raise SystemExit(0)",
}
"""How it is broken -> the text of its __init__.py."""
LIBRARIES = {"an empty library": b"", "a text for a library": b"no library\n", "another library": None}
FOLDER = "packages"


def put_package(place: Path, name: str, kind: str) -> None:
    """Put a broken package into the folder of packages of a world."""
    folder = place / FOLDER / name
    folder.mkdir(parents=True)
    (folder / "__init__.py").write_text(BROKEN[kind])


def put_library(place: Path, kind: str) -> None:
    """Put a `clang` with an invalid or a foreign shared library."""
    native = place / FOLDER / "clang" / "native"
    native.mkdir(parents=True)
    (native.parent / "__init__.py").touch()
    data = LIBRARIES[kind]
    if data is not None:
        (native / "libclang.so").write_bytes(data)
        return
    import _ctypes  # whose own library is one that can be loaded

    shutil.copy(_ctypes.__file__, native / "libclang.so")


def worlds_of_packages() -> Iterator[World]:
    """A world for each package and each way."""
    changes = {"PYTHONPATH": f"{{place}}/{FOLDER}"}
    for name in PACKAGES:
        for kind in BROKEN:
            yield World(f"{name} {kind}", changes=changes, before=partial(put_package, name=name, kind=kind))
    for kind in LIBRARIES:
        yield World(f"clang with {kind}", changes=changes, before=partial(put_library, kind=kind))
