"""`python -m robosmi.cli.confined ROOT OWN DATA COMMAND...`: one command of robosmi that reaches no file outside of a folder.

What it may read besides is what every program needs: the system's programs and libraries, Python, robosmi itself, and the
simulators of npm. It may write into the folder, into OWN, its temporary data, and into DATA/runs, the records of runs; the rest
of DATA, where what is trusted would be, it may only read. Compilers and original programs that it starts are held to the same
(see `landlock`), open no socket, leave no key in the kernel's keyrings, and end with it (see `supervised`).

A filter of system calls (seccomp) of the Linux kernel denies the sockets and keys. Landlock does not know sockets in the file
system, such as those of containers' and sessions' services, UDP, and what System V shares between processes. `io_uring` can
make sockets, too. https://docs.kernel.org/userspace-api/seccomp_filter.html. The numbers are the kernel's (linux/audit.h, the
tables of calls).
"""

from __future__ import annotations

import ctypes
import errno
import os
import site
import struct
import sys
import sysconfig
from collections.abc import Iterator
from pathlib import Path

from robosmi import resources
from robosmi.cli import landlock
from robosmi.cli.supervised import supervised
from robosmi.errors import MissingToolError

_SYSTEM = ("/usr", "/bin", "/lib", "/lib32", "/lib64", "/libx32", "/opt", "/nix/store", "/gnu/store")
_SETTINGS = ("/etc/ld.so.cache", "/etc/ld.so.conf", "/etc/ld.so.conf.d", "/etc/alternatives", "/etc/localtime")
_STATE = ("/proc/self", "/proc/cpuinfo", "/proc/meminfo", "/proc/stat", "/sys/devices/system/cpu", "/sys/fs/cgroup")
_DEVICES = ("/dev/null", "/dev/zero", "/dev/urandom", "/dev/random", "/dev/full")

_X86_64, _I386, _AARCH64 = 0xC000003E, 0x40000003, 0xC00000B7
_URING = 425
_X32 = 1 << 30
"""Added to a call's number where a program of x86-64 has pointers of 32 bits."""
_LONG = (41, 29, 64, 68, 248, 249, 250, _URING)
_DENIED = {
    _X86_64: (*_LONG, *(call | _X32 for call in _LONG)),
    _I386: (102, 359, 117, 393, 395, 399, 286, 287, 288, _URING),
    _AARCH64: (198, 194, 190, 186, 217, 218, 219, _URING),
}
"""Architecture -> its calls socket, shmget, semget, msgget, add_key, request_key, keyctl, io_uring_setup; on i386 also
socketcall and ipc, which are many."""
_NATIVE = ("x86_64", "aarch64")
_NO_NEW_PRIVILEGES, _SET_SECCOMP, _FILTER = 38, 22, 2
_LOAD, _EQUAL, _RETURN = 0x20, 0x15, 0x06
_CALL, _ARCHITECTURE = 0, 4
_ALLOW, _FAIL = 0x7FFF0000, 0x00050000 | errno.EACCES


def allowed(root: Path, own: Path, data: Path) -> Iterator[tuple[Path, int]]:
    """The files and folders that a command may reach, with its rights.

    Args:
        root: the folder that it works in.
        own: its temporary data.
        data: what stands for the user's own data.
    """
    import robosmi

    yield root, landlock.WRITE
    yield own, landlock.WRITE | landlock.RUN
    yield data, landlock.READ
    yield data / "runs", landlock.WRITE
    for name in _SYSTEM:
        yield Path(name), landlock.RUN
    for name in (*_SETTINGS, *_STATE):
        yield Path(name), landlock.READ
    for name in _DEVICES:
        yield Path(name), landlock.READ | landlock.WRITE
    prefixes = {sys.prefix, sys.base_prefix, sys.exec_prefix, *sysconfig.get_paths().values(), *site.getsitepackages()}
    for folder in sorted(prefixes):
        yield Path(folder), landlock.RUN
    yield Path(robosmi.__file__).parent, landlock.READ
    for kind in (*resources.KINDS, "transformations"):
        yield from ((place, landlock.READ) for at in robosmi.__path__ if (place := Path(at) / kind).is_dir())
    if npm := os.environ.get("ROBOSMI_NPM"):
        yield Path(npm), landlock.RUN


def main(arguments: list[str]) -> int:
    """Confine this process, and run the command."""
    root, own, data, *words = arguments

    def work() -> int:
        if landlock.version():
            landlock.restrict(allowed(Path(root), Path(own), Path(data)))
        if can_deny_sockets():
            deny_sockets()
        from robosmi.cli.main import main as run

        sys.argv = ["robosmi", *words]  # as a process of its own: a request to end is taken in order
        return run()

    return supervised(work)


def can_deny_sockets() -> bool:
    """Whether this system has such filters and its calls are known here."""
    return sys.platform.startswith("linux") and os.uname().machine in _NATIVE


def deny_sockets() -> None:
    """Let each attempt to make a socket, what System V shares, or a key fail with EACCES.

    Raises:
        MissingToolError: the kernel refuses the filter.
    """
    steps = _steps()
    code = ctypes.create_string_buffer(b"".join(steps))
    program = struct.pack("@HP", len(steps), ctypes.addressof(code))
    library = ctypes.CDLL(None, use_errno=True)
    if library.prctl(_NO_NEW_PRIVILEGES, 1, 0, 0, 0) or library.prctl(_SET_SECCOMP, _FILTER, program, 0, 0):
        raise MissingToolError(f"seccomp: {os.strerror(ctypes.get_errno())}", fix="run without confinement: --unconfined")


def _steps() -> list[bytes]:
    """The filter: for each architecture a block that compares the call's number; nothing passes on another one."""
    steps = [_step(_LOAD, _ARCHITECTURE)]
    for architecture, calls in _DENIED.items():
        block = [_step(_LOAD, _CALL)]
        for number, call in enumerate(calls):
            block.append(_step(_EQUAL, call, yes=len(calls) - number))
        block += [_step(_RETURN, _ALLOW), _step(_RETURN, _FAIL)]
        steps += [_step(_EQUAL, architecture, no=len(block)), *block]
    return [*steps, _step(_RETURN, _FAIL)]


def _step(code: int, value: int, yes: int = 0, no: int = 0) -> bytes:
    return struct.pack("=HBBI", code, yes, no, value)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
