"""A plug-in whose step does what the text of a program says: it crashes, hangs, takes memory or starts a process."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from robosmi.corpus.jobs import ProgramWork, Rows
from robosmi.errors import MissingToolError
from robosmi.plugins import Registry


def offer(registry: Registry) -> None:
    """Fill the registry."""
    registry.add("chain", "corpus_analyse", "faulty:step")
    registry.add("chain", "corpus_files", "faulty:files")


def files(work: ProgramWork) -> list[str]:
    """The program alone."""
    return [work.path]


def step(work: ProgramWork) -> Rows:
    """Do what the program says."""
    text = Path(work.path).read_text(encoding="utf-8")
    if "crash" in text:
        os.kill(os.getpid(), signal.SIGSEGV)
    if "hang" in text:
        subprocess.Popen([sys.executable, "-c", "import time; time.sleep(3600)", work.id], start_new_session=True)
        time.sleep(3600)
    if "slow" in text:
        time.sleep(0.5)
    if "grow" in text:
        held = []
        while True:
            held.append(bytearray(b"x") * (32 << 20))
            time.sleep(0.01)
    if "leap" in text:
        bytearray(1 << 40)
    if "fault" in text:
        raise ValueError("a fault of the step")
    if "tool" in text:
        raise MissingToolError("the tool is not installed", fix="install it")
    with (Path(work.folder) / "log").open("a", encoding="utf-8") as log:
        log.write(f"{work.id}\n")
    return {}
