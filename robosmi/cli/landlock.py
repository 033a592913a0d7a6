"""Landlock of the Linux kernel: what this process, and all that it starts, may reach from now on.

https://docs.kernel.org/userspace-api/landlock.html. No privilege is needed. The numbers are the kernel's (linux/landlock.h);
rights that an older kernel does not know are left out, as its documentation advises. Which folders are allowed is decided by
who calls.
"""

from __future__ import annotations

import ctypes
import os
import struct
import sys
from collections.abc import Iterable
from pathlib import Path

from robosmi.errors import MissingToolError

_CREATE, _ADD_RULE, _RESTRICT = 444, 445, 446  # system calls, alike on all architectures
_ASK_VERSION = 1
_PATH_BENEATH = 1
_NO_NEW_PRIVILEGES = 38

_EXECUTE, _WRITE_FILE, _READ_FILE, _READ_FOLDER = 1, 2, 4, 8
_MAKE_SYMLINK = 1 << 12
_CHANGES = sum(1 << n for n in range(4, 12))  # remove and make what is in a folder, but for symbolic links
_MOVE, _TRUNCATE = 1 << 13, 1 << 14
_OF_FILES = _EXECUTE | _WRITE_FILE | _READ_FILE | _TRUNCATE
READ = _READ_FILE | _READ_FOLDER
RUN = READ | _EXECUTE
WRITE = READ | _WRITE_FILE | _CHANGES | _MOVE | _TRUNCATE
_LAST_OF_VERSION = {1: 12, 2: 13, 3: 14, 4: 14}
"""Version of the interface -> its last right over files; from version 5 on it is 15."""


def version() -> int:
    """The version of the kernel's interface; 0 where there is none."""
    if not sys.platform.startswith("linux"):
        return 0
    return max(0, int(ctypes.CDLL(None).syscall(_CREATE, None, 0, _ASK_VERSION)))


def restrict(allowed: Iterable[tuple[Path, int]]) -> None:
    """Allow this process, and all that it starts, no more than this, and no connection over TCP.

    From version 6 of the interface on also no abstract socket and no signal to others.

    Args:
        allowed: files and folders with the rights over what is in them; what is not there is passed over.

    Raises:
        MissingToolError: the kernel has no Landlock, or refuses.
    """
    number = version()
    if not number:
        raise MissingToolError("the kernel has no Landlock", fix="use Linux 5.13 or newer with Landlock")
    library = ctypes.CDLL(None, use_errno=True)
    known = (1 << _LAST_OF_VERSION.get(number, 15) + 1) - 1
    network = 3 if number >= 4 else 0  # bind and connect
    scoped = 3 if number >= 6 else 0  # abstract sockets, and signals to processes that are not confined alike
    attributes = struct.pack("=QQQ", known, network, scoped)[: 8 if number < 4 else 16 if number < 6 else 24]
    ruleset = library.syscall(_CREATE, attributes, len(attributes), 0)
    if ruleset < 0:
        raise _refused()
    try:
        for path, rights in allowed:
            _allow(library, ruleset, path, rights & known & ~_MAKE_SYMLINK)
        if library.prctl(_NO_NEW_PRIVILEGES, 1, 0, 0, 0) or library.syscall(_RESTRICT, ruleset, 0):
            raise _refused()
    finally:
        os.close(ruleset)


def _allow(library: ctypes.CDLL, ruleset: int, path: Path, rights: int) -> None:
    try:
        opened = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except OSError:
        return
    try:
        rule = struct.pack("=Qi", rights if path.is_dir() else rights & _OF_FILES, opened)
        if library.syscall(_ADD_RULE, ruleset, _PATH_BENEATH, rule, 0):
            raise _refused()
    finally:
        os.close(opened)


def _refused() -> MissingToolError:
    return MissingToolError(f"Landlock: {os.strerror(ctypes.get_errno())}", fix="run without confinement: --unconfined")
