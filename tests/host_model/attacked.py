"""What a program on the host model tries to do to this machine, and a judge who sees it: files, sockets, signals, processes."""

from __future__ import annotations

import os
import shutil
import signal
import socket
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

ATTACKS = Path(__file__).parent / "attacks"
EFFECTS = (
    "file", "socket by its path", "abstract socket", "UDP", "signal", "ptrace", "folder", "rename", "shared memory", "fork",
    "start again", "execute",
)  # fmt: skip
"""What `attack.h` tries, in its order."""


class Judge:
    """A folder, sockets and a process that an attack tries to reach.

    Args:
        place: an empty folder; a short path.
    """

    def __init__(self, place: Path) -> None:
        self.place = place
        (place / "kept").write_text("as it was")
        self.abstract = f"robosmi-attack-{os.getpid()}-{place.name}"
        self.by_path, self.by_name = (socket.socket(socket.AF_UNIX) for _ in range(2))
        self.by_path.bind(str(place / "socket"))
        self.by_name.bind(f"\0{self.abstract}")
        self.udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.udp.bind(("127.0.0.1", 0))
        for each in (self.by_path, self.by_name):
            each.listen()
        for each in (self.by_path, self.by_name, self.udp):
            each.setblocking(False)
        self.victim = subprocess.Popen(["sleep", "1000"], stdin=subprocess.DEVNULL, start_new_session=True)
        self.key = 0x52000000 + os.getpid()
        self.before = self._files()

    def _files(self) -> dict[str, bytes]:
        return {
            path.relative_to(self.place).as_posix(): path.read_bytes() if path.is_file() else b""
            for path in sorted(self.place.rglob("*"))
        }

    def source(self, attack: Path, folder: Path, effect: int, effects: int = len(EFFECTS)) -> Path:
        """Copy an attack into a folder, with a header that says what it tries.

        Args:
            attack: the C file.
            folder: an empty folder.
            effect: number of the effect with which it begins.
            effects: how many it tries, one after another.
        """
        for header in ATTACKS.glob("*.h"):
            shutil.copy(header, folder)
        port = socket.htons(self.udp.getsockname()[1])
        texts = {"PLACE": f'"{self.place}"', "ABSTRACT": f'"{self.abstract}"'}
        numbers = {"PORT": port, "VICTIM": self.victim.pid, "KEY": self.key, "EFFECT": effect, "EFFECTS": effects}
        (folder / "place.h").write_text("".join(f"#define {name} {value}\n" for name, value in {**texts, **numbers}.items()))
        return Path(shutil.copy(attack, folder / "program.c"))

    def seen(self, binary: Path) -> list[str]:
        """What an attack has done.

        Args:
            binary: its program; processes that still run it are ended.
        """
        found = [f"changed {name}" for name in self._files().items() ^ self.before.items()]
        for name, each in (("socket by its path", self.by_path), ("abstract socket", self.by_name), ("UDP", self.udp)):
            with suppress(BlockingIOError):
                if each is self.udp:
                    each.recv(100)
                else:
                    each.accept()[0].close()
                found.append(name)
        with suppress(ProcessLookupError):
            if self.victim.poll() is not None:
                found.append("the other process has ended")
            elif "State:\tS" not in Path(f"/proc/{self.victim.pid}/status").read_text():
                found.append("the other process is stopped")
        shared = Path("/proc/sysvipc/shm")
        if shared.exists() and any(line.split()[0] == str(self.key) for line in shared.read_text().splitlines()):
            found.append("shared memory")
        for left in Path("/proc").glob("[0-9]*/exe"):
            with suppress(OSError):
                if os.readlink(left).startswith(str(binary)):
                    found.append(f"process {left.parent.name}")
                    os.kill(int(left.parent.name), signal.SIGKILL)
        return found

    def close(self) -> None:
        """End the process, close the sockets, and remove the shared memory."""
        self.victim.kill()
        self.victim.wait()
        for each in (self.by_path, self.by_name, self.udp):
            each.close()
        subprocess.run(["ipcrm", "-M", str(self.key)], capture_output=True, check=False)


@contextmanager
def judge(place: Path) -> Iterator[Judge]:
    """A judge whose sockets and process go away in the end."""
    place.mkdir(exist_ok=True)
    made = Judge(place)
    try:
        yield made
    finally:
        made.close()
