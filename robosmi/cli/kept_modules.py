"""Modules, loaded from one file: finding and reading some 600 of them one by one takes a tenth of a migration.

Python looks for a module in each folder of its path, compares its source with the bytecode file beside it, and reads that. A
command keeps the code of all modules that it loaded in one file of the user's cache folder, and the next command takes from it
what is still current:

- no folder in which the module was sought has changed, up to the one in which it was found: Python would find the same file, and
- the source has the same size and the same times of change, to the nanosecond.

All other modules are found and loaded by Python as ever, and kept when the command ends. The code comes from Python's own loader,
which also answers all other questions about a kept module (its source, its data files), so tracebacks, debuggers and coverage
see no difference. Where Python is not to write bytecode, nothing is kept. The file is valid for one installation of robosmi and
one build of Python.
"""

from __future__ import annotations

import atexit
import marshal
import mmap
import os
import sys
import zlib
from collections.abc import Callable, Sequence
from contextlib import suppress
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from types import CodeType, ModuleType
from typing import TypeAlias

import robosmi
from robosmi.user_cache import keep, open_kept
from robosmi.user_folders import cache_dir

Stamp: TypeAlias = tuple[int, ...]
"""When a file or folder was changed (st_mtime_ns, st_ctime_ns), and its size; nothing where there is none."""
Folders: TypeAlias = tuple[str, ...]
Kept: TypeAlias = tuple[Folders, str, str, Stamp, int, int, int]
"""Of a module: the folders in which it was sought, the last of which has it; the paths of its source and of its bytecode file;
the source's stamp; the code's place, size and checksum."""
Key: TypeAlias = tuple[str, str]
"""Under which a module is kept: the first folder in which it was sought, and its name."""

FOLDER = "modules"
"""The folder of the cache folder, with a file for each installation."""
MOST = 12
"""Files that are kept; beyond them, the one that was written first is removed."""
MOST_MODULES = 4000
"""Modules that are kept in a file at most: all commands together have a third of them. Beyond them, it is started anew."""
_FORM = 2
"""To be raised where other modules of this name would not understand the file."""
_HEAD = f"{_FORM} {sys.version} {sys.flags.optimize}".replace("\n", " ").encode() + b"\n"
_NUMBER = 4
"""Bytes of each of the two numbers behind the head: the size of the index, and its checksum."""

_code_in: Callable[[bytes], CodeType] = marshal.loads
_index_in: Callable[[bytes], tuple[dict[str, Stamp], dict[Key, Kept], set[Key]]] = marshal.loads


def keep_modules() -> None:
    """Let this process take modules from the cache folder, and keep new ones when it ends.

    Other finders that come before Python's own, such as those of tools that measure or check code, still come first.
    """
    if PathFinder not in sys.meta_path:
        return
    installation = zlib.crc32("\n".join(robosmi.__path__).encode(errors="surrogateescape"))
    finder = KeptModules(f"{FOLDER}/{installation:08x}-{sys.implementation.cache_tag}")
    sys.meta_path.insert(sys.meta_path.index(PathFinder), finder)
    if not sys.dont_write_bytecode:
        atexit.register(finder.write)


class KeptModules:
    """Finder of the modules that earlier commands kept, for `sys.meta_path`.

    Args:
        name: path of their file below the cache folder.
    """

    def __init__(self, name: str) -> None:
        self._name = name
        self._path = tuple(sys.path)
        self._data: mmap.mmap | bytes = b""
        self._codes = 0
        self._folders: dict[str, Stamp] = {}
        self._kept: dict[Key, Kept] = {}
        self._others: set[Key] = set()
        self._current: dict[str, Stamp] = {}
        self._unchanged: dict[Folders, bool] = {}
        self._missed: dict[Key, Folders] = {}
        self._open()

    def find_spec(self, fullname: str, path: Sequence[str] | None = None, target: ModuleType | None = None) -> ModuleSpec | None:
        """How a kept module is loaded; None for all other modules.

        Args:
            fullname: the module's name.
            path: the folders of its package; None for `sys.path`.
            target: not needed.
        """
        sought = tuple(sys.path if path is None else path)
        if not sought or (path is None and sought != self._path):  # while code of a user's is read, its folder is searched, too
            return None
        key = sought[0], fullname
        if (kept := self._kept.get(key)) is not None and self._is_current(kept, sought) and (code := self._code(kept)):
            _, source, bytecode, *_ = kept
            spec = ModuleSpec(fullname, _Loader(fullname, source, code), origin=source)
            if os.path.basename(source) == "__init__.py":
                spec.submodule_search_locations = [os.path.dirname(source)]
            spec.has_location, spec.cached = True, bytecode
            return spec
        if key not in self._others:
            self._missed[key] = sought
            for folder in sought:
                self._stamp(folder)
        return None

    def write(self) -> None:
        """Keep the modules that this process has found in the ordinary way, beside those that were kept before."""
        others = len(self._others)
        found = {key: new for key, sought in self._missed.items() if (new := self._found(key, sought)) is not None}
        if not found and len(self._others) == others:
            return
        if len(found) + len(self._kept) <= MOST_MODULES:
            for key, kept in self._kept.items():
                if key not in found and self._is_current(kept, kept[0]) and (code := self._code(kept)):
                    found[key] = kept, code
        folders = {folder: self._stamp(folder) for (sought, *_), _ in found.values() for folder in sought}
        index: dict[Key, Kept] = {}
        end = 0
        for key, ((sought, source, bytecode, stamp, *_), code) in found.items():
            index[key] = sought, source, bytecode, stamp, end, len(code), zlib.crc32(code)
            end += len(code)
        packed = marshal.dumps((folders, index, self._others))
        numbers = b"".join(number.to_bytes(_NUMBER, "big") for number in (len(packed), zlib.crc32(packed)))
        self._kept.clear()  # what is imported from here on is not taken from the closed file
        if isinstance(self._data, mmap.mmap):
            self._data.close()  # some systems do not replace a file that is in use
        keep(self._name, b"".join((_HEAD, numbers, packed, *(code for _, code in found.values()))))
        _remove_oldest()

    def _found(self, key: Key, sought: Folders) -> tuple[Kept, bytes] | None:
        """A module as Python finds it in some folders, and its code; None if something has changed meanwhile.

        What is no source with a bytecode file is left to Python. This is noted where it will stay so.
        """
        _, fullname = key
        spec = PathFinder.find_spec(fullname, sought)
        if spec is None or spec.origin is None or type(spec.loader) is not SourceFileLoader:
            self._others.add(key)
            return None
        folder = os.path.dirname(spec.origin if spec.submodule_search_locations is None else os.path.dirname(spec.origin))
        if (
            folder not in sought
            or not all(os.path.isabs(each) for each in sought)
            or spec.cached is None
            or not os.path.exists(spec.cached)
        ):
            return None
        stamp, code = _stamp(spec.origin), None
        with suppress(OSError, ImportError, SyntaxError):
            code = spec.loader.get_code(fullname)
        sought = sought[: sought.index(folder) + 1]
        if not stamp or code is None or _stamp(spec.origin) != stamp or any(_stamp(each) != self._stamp(each) for each in sought):
            return None
        return (sought, spec.origin, spec.cached, stamp, 0, 0, 0), marshal.dumps(code)

    def _is_current(self, kept: Kept, sought: Folders) -> bool:
        """Whether Python would find a kept module in these folders, with the code that is kept."""
        folders, source, _, stamp, *_ = kept
        if folders not in self._unchanged:
            self._unchanged[folders] = all(self._stamp(folder) == self._folders[folder] for folder in folders)
        return self._unchanged[folders] and sought[: len(folders)] == folders and _stamp(source) == stamp

    def _stamp(self, folder: str) -> Stamp:
        """The stamp of a folder when it was first asked for."""
        if folder not in self._current:
            self._current[folder] = _stamp(folder)
        return self._current[folder]

    def _open(self) -> None:
        """Read the index of the file, if it is there and whole."""
        with suppress(OSError, ValueError):  # ValueError: the file is empty
            if (file := open_kept(self._name)) is not None:
                with file:
                    self._data = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        size, checksum = (int.from_bytes(self._piece(len(_HEAD) + at, _NUMBER), "big") for at in (0, _NUMBER))
        self._codes = len(_HEAD) + 2 * _NUMBER + size
        packed = self._piece(self._codes - size, size)
        if packed and self._piece(0, len(_HEAD)) == _HEAD and zlib.crc32(packed) == checksum:
            self._folders, self._kept, self._others = _index_in(packed)

    def _code(self, kept: Kept) -> bytes:
        """The code of a kept module; nothing if it is damaged."""
        *_, start, size, checksum = kept
        code = self._piece(self._codes + start, size)
        return code if zlib.crc32(code) == checksum else b""

    def _piece(self, start: int, size: int) -> bytes:
        return self._data[start : start + size]


class _Loader(SourceFileLoader):
    """Python's loader of a source, with the module's code at hand."""

    def __init__(self, fullname: str, path: str, kept: bytes) -> None:
        super().__init__(fullname, path)
        self._kept = kept

    def get_code(self, fullname: str) -> CodeType | None:
        """The code of the module, which is asked for once."""
        kept, self._kept = self._kept, b""
        if not kept:
            return super().get_code(fullname)
        return _code_in(kept)


def _stamp(path: str) -> Stamp:
    try:
        found = os.stat(path)
    except OSError:
        return ()
    return found.st_mtime_ns, found.st_ctime_ns, found.st_size


def _remove_oldest() -> None:
    """Remove the files of installations that have not been written to for longest, beyond those that are kept."""
    with suppress(OSError):
        files = sorted((cache_dir() / FOLDER).iterdir(), key=lambda file: file.stat().st_mtime_ns)
        for file in files[:-MOST]:
            file.unlink()
