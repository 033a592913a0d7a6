"""Compares what a C program prints on a 32-bit machine with unsigned plain char with what its migrated sketch prints.

The former is the truth (gcc for 32 bits); the sketch runs on a simulated board. Programs that never end are stopped: then the
sketch, which is slower, must have printed a prefix of it.
"""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from pathlib import Path
from threading import Timer

import robosmi
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import simulate
from robosmi.verify.toolchains.toolchain import compile_sketch

LIBRARY = Path(__file__).parent / "library"
_FLAGS = ("-m32", "-funsigned-char", "-std=gnu99", "-O0", "-w", "-fcommon", "-include", "by_line.h")
_MOST = 200_000
ENOUGH = 400
"""Characters that the sketch of an endless program has to print before they count."""


def sources(program: Path) -> list[Path]:
    """The files of a program, the one with main first: a file, or those of a folder."""
    return sorted(program.glob("*.c"), key=lambda path: (path.name != "main.c", path.name)) if program.is_dir() else [program]


def truth(files: Sequence[Path], folder: Path) -> tuple[str, bool]:
    """The output of a program on this machine, and whether it ends within a second."""
    binary = folder / "truth"
    subprocess.run(["gcc", *_FLAGS, f"-I{LIBRARY}", *map(str, files), "-o", str(binary), "-lm"], check=True)
    with subprocess.Popen([str(binary)], stdout=subprocess.PIPE) as process:
        assert process.stdout is not None
        timer = Timer(1.0, process.kill)
        timer.start()
        said = process.stdout.read(_MOST)
        ended = timer.is_alive() and len(said) < _MOST
        timer.cancel()
        if not ended:
            process.kill()
    return said.decode("latin-1"), ended


def sketch(files: Sequence[Path], folder: Path, seconds: float, board: str = "uno") -> str:
    """The output of a program's migrated sketch in so many seconds on a simulated board.

    Raises:
        AssertionError: the sketch does not compile, or generated text gives a warning.
    """
    made = robosmi.migrate(list(files), folder / "out", target=board)
    assert [f.message for f in made.models.plan.findings if f.rule == "RS337"] == []
    report = compile_sketch(made.sketch, board, keep=folder)
    assert report.ok, [f"{d.location}: {d.message}" for d in report.diagnostics][:5]
    said = [d for d in report.diagnostics if d.severity.name == "warning" and d.location is not None]
    assert [d for d in said if d.location is not None and d.location.path.endswith("adapters.h")] == []
    assert report.elf is not None
    assert report.hex is not None
    return simulate(job(report.elf, report.hex, load_board(board), seconds * 1e6)).text.replace("\r\n", "\n")
