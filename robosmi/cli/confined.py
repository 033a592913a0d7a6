"""`python -m robosmi.cli.confined ROOT OWN DATA COMMAND...`: one command of robosmi that reaches no file outside of a folder.

What it may read besides is what every program needs: the system's programs and libraries, Python, robosmi itself, and the
simulators of npm. It may write into the folder, into OWN, its temporary data, and into DATA/runs, the records of runs; the rest
of DATA, where what is trusted would be, it may only read. Compilers and original programs that it starts are held to the same
(see `landlock`), open no socket (see `seccomp`), and end with it (see `supervised`).
"""

from __future__ import annotations

import os
import site
import sys
import sysconfig
from collections.abc import Iterator
from pathlib import Path

from robosmi import resources
from robosmi.cli import landlock, seccomp
from robosmi.cli.supervised import supervised

_SYSTEM = ("/usr", "/bin", "/lib", "/lib32", "/lib64", "/libx32", "/opt", "/nix/store", "/gnu/store")
_SETTINGS = ("/etc/ld.so.cache", "/etc/ld.so.conf", "/etc/ld.so.conf.d", "/etc/alternatives", "/etc/localtime")
_STATE = ("/proc/self", "/proc/cpuinfo", "/proc/meminfo", "/proc/stat", "/sys/devices/system/cpu", "/sys/fs/cgroup")
_DEVICES = ("/dev/null", "/dev/zero", "/dev/urandom", "/dev/random", "/dev/full")


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
        if seccomp.is_known():
            seccomp.deny_sockets()
        from robosmi.cli.main import main as run

        sys.argv = ["robosmi", *words]  # as a process of its own: a request to end is taken in order
        return run()

    return supervised(work)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
