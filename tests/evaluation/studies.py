"""The programs that rows are about, each migrated once: the two case studies and the paper's Listing 1."""

from __future__ import annotations

import atexit
from functools import cache
from pathlib import Path
from shutil import rmtree
from tempfile import mkdtemp
from typing import Any

import robosmi
from robosmi.api import MigratedSketch
from robosmi.plugins import content
from tests.evaluation.sources import ROOT

EXAMPLES = ROOT / "docs" / "examples"
INPUTS = Path(__file__).resolve().parent / "inputs"
PROGRAMS = {
    "line follower": EXAMPLES / "line_follower" / "line_follower.c",
    "monitoring": EXAMPLES / "environmental_monitoring" / "environmental_monitoring.c",
    "Listing 1": EXAMPLES / "listing_1" / "listing_1.c",
}
STUDIES = ("line follower", "monitoring")
DRAWINGS = {
    "line follower": EXAMPLES / "line_follower" / "line_following_robot.fzz",
    "monitoring": EXAMPLES / "environmental_monitoring" / "environmental_monitoring_robot.fzz",
}


@cache
def migrated(name: str, adapters: str = "filled", target: str | None = None) -> MigratedSketch:
    """A program of `PROGRAMS`, migrated."""
    folder = mkdtemp(prefix="evaluation-")
    atexit.register(rmtree, folder, ignore_errors=True)
    return robosmi.migrate([PROGRAMS[name]], Path(folder) / "out", adapters=adapters, target=target)


def text_of(made: MigratedSketch, ending: str) -> str:
    """The files of a sketch whose names end so, one after the other."""
    name = made.models.plan.name
    named = [path for path in made.contents if path.startswith(f"{name}/") and path.endswith(ending)]
    return "".join(made.contents[path].decode() for path in named)


@cache
def drawn(path: Path, target: str | None = None) -> Any:
    """What `robosmi hardware --json` says of a drawing."""
    return content("chain", "hardware")(path, roles={}, target=target).result


@cache
def analysed(path: Path) -> Any:
    """The unit that `robosmi analyse --json` says of a program of one file."""
    return content("chain", "analyse")([path]).result["units"][0]
