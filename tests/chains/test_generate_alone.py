"""`generate` reads the stored models and nothing else: it makes the same bytes where all other files are out of reach.

Over 5 programs, and over 30 in the tier `all`: of the corpus that ROBOSMI_CORPUS names, else the project's own.
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
from robosmi.errors import RobosmiError, SourceError
from robosmi.transformations.chains.generate import generate
from tests.corpus.migrate_corpus import programs
from tests.running import tree
from tests.tiers import sample

ROOT = Path(__file__).parents[2]
FEW, MANY = 5, 30
Program = tuple[Sequence[Path], Path | None, str | None]
"""Source files, drawing, target."""


def alone(work: str, jobs: Iterable[tuple[Path, Path, Path]]) -> subprocess.CompletedProcess[str]:
    """Run `tests.alone` over (input, what may be read, output)."""
    words = [str(word) for job in jobs for word in job]
    own = {name: value for name, value in os.environ.items() if name != "PYTHONPYCACHEPREFIX"}  # bytecode is elsewhere there
    return subprocess.run(
        [sys.executable, "-m", "tests.alone", work, *words], cwd=ROOT, capture_output=True, text=True, check=False, env=own
    )


def chosen(count: int) -> list[Program]:
    """So many programs and more, with their drawings, at even distances in the order of their names."""
    corpus = os.environ.get("ROBOSMI_CORPUS")
    if corpus:
        found: list[Program] = [(files, None, None) for files in programs(Path(corpus))]
        return found[:: max(1, len(found) // count)]
    cases = ROOT / "tests" / "transformations" / "m2t" / "cases"
    own: list[Program] = [(sorted(path.glob("input/*.c")), None, None) for path in sorted(cases.iterdir())]
    drawn: list[Program] = [
        ([path.parent / f"{path.parent.name}.c"], path, None) for path in sorted((ROOT / "docs" / "examples").glob("*/*.fzz"))
    ]
    plain: Program = ([cases / "ports_open" / "input" / "ports.c"], None, "avr-c")
    return [plain, *drawn, *[program for program in own if program[0]][:: max(1, len(own) // count)]]


@pytest.mark.parametrize("count", sample([FEW, MANY], 1))
def test_the_stored_models_alone_give_the_same_bytes(count: int, tmp_path: Path) -> None:
    jobs: list[tuple[Path, Path, Path]] = []
    for number, (files, drawing, target) in enumerate(chosen(count)):
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
    assert len(jobs) >= count
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


def test_what_lies_beside_what_may_be_read_is_out_of_reach(migrated: Path, tmp_path: Path) -> None:
    """The test above can fail: models in another folder than the one that may be read are not opened."""
    (tmp_path / "again").mkdir()
    done = alone("generate", [(migrated / "models" / "plan.xmi", migrated / "models" / "source", tmp_path / "again" / "out")])
    assert done.returncode == 9
    assert "plan.xmi" in done.stdout


@pytest.mark.parametrize("kind", ["source", "source folder", "model"])
def test_a_link_out_of_the_models_folder_is_not_followed(kind: str, migrated: Path, tmp_path: Path) -> None:
    models = migrated / "models"
    file = models / {"source": "source/line_follower.c", "source folder": "source", "model": "code.xmi"}[kind]
    shutil.move(file, tmp_path / "elsewhere")
    file.symlink_to(tmp_path / "elsewhere")
    before = tree(migrated)
    with pytest.raises(SourceError, match=r"outside (of )?its folder") as raised:
        generate(models / "plan.xmi", tmp_path / "again")
    assert raised.value.fix
    assert tree(migrated) == before
    assert not (tmp_path / "again").exists()


def test_a_folder_of_models_that_is_a_link_out_of_the_output_folder_is_not_followed(migrated: Path, tmp_path: Path) -> None:
    shutil.move(migrated / "models", tmp_path / "elsewhere")
    (migrated / "models").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(SourceError, match="outside the output folder, behind a link"):
        generate(migrated / "models" / "plan.xmi", tmp_path / "again")
    assert not (tmp_path / "again").exists()


def test_a_plan_that_refers_to_models_elsewhere_is_refused(migrated: Path, tmp_path: Path) -> None:
    models = migrated / "models"
    shutil.move(models / "code.xmi", migrated / "code.xmi")
    plan = models / "plan.xmi"
    plan.write_text(plan.read_text().replace('href="code.xmi#', 'href="../code.xmi#'))
    with pytest.raises(SourceError, match=r"'code\.xmi', which lies outside (of )?its folder"):
        generate(plan, tmp_path / "again")
    with pytest.raises(SourceError, match=r"'code\.xmi', which lies outside (of )?its folder"):
        robosmi.check_model(plan)
