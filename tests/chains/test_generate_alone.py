"""`generate` reads the stored models and nothing else: it makes the same bytes where all other files are out of reach.

Over 30 programs: of the corpus that ROBOSMI_CORPUS names, else the project's own.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

import pytest

import robosmi
from robosmi.errors import RobosmiError
from tests.corpus.migrate_corpus import programs
from tests.running import tree

ROOT = Path(__file__).parents[2]
COUNT = 30
Program = tuple[Sequence[Path], Path | None, str | None]
"""Source files, drawing, target."""


def alone(work: str, jobs: Iterable[tuple[Path, Path, Path]]) -> subprocess.CompletedProcess[str]:
    """Run `tests.alone` over (input, what may be read, output)."""
    words = [str(word) for job in jobs for word in job]
    return subprocess.run(
        [sys.executable, "-m", "tests.alone", work, *words], cwd=ROOT, capture_output=True, text=True, check=False
    )


def chosen() -> list[Program]:
    """Programs with their drawings, at even distances in the order of their names."""
    corpus = os.environ.get("ROBOSMI_CORPUS")
    if corpus:
        found: list[Program] = [(files, None, None) for files in programs(Path(corpus))]
        return found[:: max(1, len(found) // COUNT)]
    cases = ROOT / "tests" / "transformations" / "m2t" / "cases"
    own: list[Program] = [(sorted(path.glob("input/*.c")), None, None) for path in sorted(cases.iterdir())]
    drawn: list[Program] = [
        ([path.parent / f"{path.parent.name}.c"], path, None) for path in sorted((ROOT / "docs" / "examples").glob("*/*.fzz"))
    ]
    plain: Program = ([cases / "ports_open" / "input" / "ports.c"], None, "avr-c")
    return [plain, *drawn, *[program for program in own if program[0]][:: max(1, len(own) // COUNT)]]


def test_the_stored_models_alone_give_the_same_bytes(tmp_path: Path) -> None:
    jobs: list[tuple[Path, Path, Path]] = []
    for number, (files, drawing, target) in enumerate(chosen()):
        folder = tmp_path / f"{number:03}"
        try:
            robosmi.migrate(list(files), folder / "made", hardware=drawing, target=target)
        except RobosmiError:
            assert "ROBOSMI_CORPUS" in os.environ, files  # where a few are no programs as they stand
            shutil.rmtree(folder, ignore_errors=True)
            continue
        for name in ("sent", "again"):
            (folder / name).mkdir()
        shutil.copytree(folder / "made" / "models", folder / "sent" / "models")
        jobs.append((folder / "sent" / "models" / "plan.xmi", folder / "sent" / "models", folder / "again" / "out"))
    assert len(jobs) >= COUNT
    done = alone("generate", jobs)
    assert done.returncode == 0, done.stdout + done.stderr
    for plan, _, again in jobs:
        made = tree(plan.parents[2] / "made")
        assert {n: d for n, d in tree(again).items() if n != ".robosmi.json"} == {
            n: d for n, d in made.items() if n != ".robosmi.json"
        }


@pytest.mark.parametrize("work", ["migrate"])
def test_what_needs_other_files_is_refused_there(work: str, line_follower: Path, tmp_path: Path) -> None:
    """The test above can fail: a migration reads the platforms' data, and the hook sees it."""
    (tmp_path / "again").mkdir()
    done = alone(work, [(line_follower, line_follower.parent, tmp_path / "again" / "out")])
    assert done.returncode == 9
    assert "platform_repo" in done.stdout


def test_a_source_beside_the_models_is_out_of_reach(migrated: Path, tmp_path: Path) -> None:
    """The test above can fail: a copy of a source that lies elsewhere is not opened."""
    source = next((migrated / "models" / "source").glob("*.c"))
    shutil.move(source, tmp_path / source.name)
    source.symlink_to(tmp_path / source.name)
    (tmp_path / "again").mkdir()
    done = alone("generate", [(migrated / "models" / "plan.xmi", migrated / "models", tmp_path / "again" / "out")])
    assert done.returncode == 9
    assert source.name in done.stdout
