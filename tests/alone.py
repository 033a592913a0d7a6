"""Runs the tool in a process that may open nothing but the code of Python and of the project, and given folders.

Usage: python -m tests.alone generate|migrate [INPUT FOLDER OUTPUT]...; INPUT is a plan.xmi or a source file, FOLDER what may be
read, OUTPUT the output folder, in a folder of its own that may be written. An audit hook refuses to open or list anything else:
data of platforms, of users and of projects, histories, sources beside the stored copies. Every refusal is printed, and the exit
code is then 9.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

import robosmi
from robosmi.base.user_folders import cache_dir
from tests.recording.written_models import FOLDER

ROOT = Path(__file__).resolve().parents[1]
PYTHON = tuple({os.path.realpath(path) for path in (sys.prefix, sys.base_prefix, *sys.path) if path} - {str(ROOT)})
CODE = tuple(str(ROOT / room) for room in ("robosmi", "robosmi.egg-info", "transformations", "metamodels", "templates"))
NEVER = (".c", ".cpp", ".h", ".toml", ".json", ".fzz", ".sqlite")
"""File endings that may never be opened, even within the project, since such files are no code."""
KEPT = (
    *filter(None, [os.environ.get(FOLDER)]),
    *(str(Path(home) / "runs") for home in [os.environ.get("ROBOSMI_HOME")] if home),
    os.path.realpath(cache_dir() / "templates"),
)
"""Folders that may be used besides: for recorded models, for locks on output folders, and for compiled templates."""
OWN_MEMORY = os.path.realpath("/proc/self/statm")
"""How much memory this process has, which limits what a parse may take."""
EVENTS = ("open", "os.listdir", "os.scandir", "sqlite3.connect")


def main(words: list[str]) -> int:
    """Execute one job after the other; returns the exit code."""
    allowed: list[str] = []
    refused: list[str] = []

    def hook(event: str, arguments: tuple[Any, ...]) -> None:
        if event not in EVENTS or not isinstance(arguments[0], (str, bytes, os.PathLike)):
            return
        path = os.path.realpath(os.fsdecode(arguments[0]))
        if not _may(path, allowed):
            refused.append(f"{event} {path}")
            raise PermissionError(13, "out of reach in this test", path)

    def work(given: str, output: str) -> None:
        if words[0] == "generate":
            robosmi.generate_sketch(given, output)
        else:
            robosmi.migrate([given], output)

    sys.addaudithook(hook)
    for given, folder, output in zip(words[1::3], words[2::3], words[3::3], strict=True):
        allowed[:] = [os.path.realpath(place) for place in (folder, os.path.dirname(output), *KEPT)]
        os.chdir(os.path.dirname(output))  # else a relative name is of a folder that was opened before, and so looked at
        try:
            work(given, output)
        except Exception as error:
            refused.append(f"{given}: {error!r}")
    print("\n".join(refused))
    return 9 if refused else 0


def _may(path: str, allowed: list[str]) -> bool:
    """Whether a file may be opened; where the project's code lies may be listed, as an import does."""
    if path in (os.devnull, OWN_MEMORY, str(ROOT)) or _within(path, allowed):
        return True
    if _within(path, CODE):
        return not path.endswith(NEVER)
    inside = path.startswith(f"{ROOT}{os.sep}") and not _within(path, PYTHON)
    return not inside and _within(path, PYTHON)


def _within(path: str, folders: tuple[str, ...] | list[str]) -> bool:
    return any(path == folder or path.startswith(f"{folder}{os.sep}") for folder in folders)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
