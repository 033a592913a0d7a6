"""`robosmi verify` where its files cannot be written: the verdict is told all the same, and what is lost is a finding."""

from __future__ import annotations

import resource
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from robosmi.transformations.chains.stages.verified_files import VerifiedFiles
from robosmi.transformations.m2t.task_list import PICTURE
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import PinTrace
from tests.running import run, tree
from tests.tools import require_tools, require_verification

ROOT = Path(__file__).parents[2]
PROGRAM = ROOT / "tests" / "transformations" / "verification" / "programs" / "button.c"
SCENARIO = 'name = "pressed"\nhorizon_ms = 1000\n[signals]\nButton = [[0, 0], [500, 1]]\n'
REST = Scenario("rest", 1000.0)
NOTHING = PinTrace("", "running", 1000.0, (), (), (), ())


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The migrated button program with a scenario, made once."""
    require_verification("simavr")
    folder = tmp_path_factory.mktemp("unwritten")
    shutil.copytree(PROGRAM.parent, folder / "input")
    assert run("migrate", folder / "input" / "button.c", "-o", folder / "out").code == 0
    (folder / "pressed.toml").write_text(SCENARIO)
    return folder


@pytest.fixture
def folder(made: Path, tmp_path: Path) -> Path:
    """A copy of it."""
    shutil.copytree(made, tmp_path / "made")
    return tmp_path / "made"


REPORTED = {
    "out/models/verdict.json", "out/models/plan.xmi", "out/button/MIGRATION.md", "out/.robosmi/generated/button/MIGRATION.md",
    "out/.robosmi.json",
}  # fmt: skip
"""What a verdict changes: the report, the plan with its findings, and their records."""


def test_the_verdict_is_told_though_picture_and_trace_cannot_be_written(folder: Path) -> None:
    (folder / "out" / "models" / PICTURE).mkdir()
    (folder / "file").write_text("mine")
    before = tree(folder)
    words: list[str | Path] = ["verify", folder / "out", "--scenario", folder / "pressed.toml", "-o", folder / "file" / "x.vcd"]
    outcome = run(*words, "--json")
    assert outcome.code == 3
    assert outcome.result["verdict"] == "no-difference-found"
    found = outcome.document["findings"]
    assert [(f["rule"], f["severity"], f["location"]["path"]) for f in found] == [
        ("RS902", "error", str(folder / "out" / "models" / PICTURE)),
        ("RS902", "error", str(folder / "file" / "x.vcd")),
    ]
    assert found[0]["message"] == "the picture cannot be stored: the output path is not an ordinary file"
    assert found[1]["message"].startswith("the trace cannot be written: cannot write here")
    assert outcome.document["artifacts"] == []
    told = run(*words)
    assert told.code == 3
    assert "no difference found" in told.out.lower()
    assert "the picture cannot be stored" in told.out + told.err
    after = tree(folder)
    assert {path for path in after if after[path] != before.get(path)} == REPORTED
    assert not before.keys() - after.keys()


def test_a_difference_is_told_by_the_exit_code_though_the_picture_is_lost(folder: Path) -> None:
    (folder / "out" / "models" / PICTURE).mkdir()
    [sketch] = (folder / "out").glob("*/*.ino")
    sketch.write_text(sketch.read_text().replace("pause(300)", "pause(250)"))
    outcome = run("verify", folder / "out", "--scenario", folder / "pressed.toml", "--json")
    assert (outcome.code, outcome.result["verdict"]) == (6, "different")
    assert [finding["rule"] for finding in outcome.document["findings"]] == ["RS902"]


FULL_DISK = """
mount -t tmpfs -o size=2m none "$1/small" || exit 99
cp -r "$1/out/." "$1/small"
dd if=/dev/zero of="$1/small/filler" bs=1k 2>"$1/dd"
"$2" -m robosmi verify "$1/small" --scenario "$1/pressed.toml"
"""


def test_a_full_disk_costs_nothing_of_the_verdict(folder: Path) -> None:
    require_tools("unshare")
    (folder / "small").mkdir()
    command = ["unshare", "-rm", "sh", "-c", FULL_DISK, "sh", str(folder), sys.executable]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode in (1, 99) and ("unshare" in done.stderr or "mount" in done.stderr):
        pytest.skip(f"no file system of one's own here: {done.stderr}")
    assert done.returncode == 3, done.stdout + done.stderr
    assert "no difference found" in done.stdout.lower()
    assert "the picture cannot be stored: cannot write here: No space left on device" in done.stdout + done.stderr


@contextmanager
def short_files(most: int) -> Iterator[None]:
    """No file of this process may be longer."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def test_scenarios_that_can_be_stored_are_written_before_one_that_cannot(tmp_path: Path) -> None:
    place = tmp_path / "out" / "models" / "scenarios"
    place.parent.mkdir(parents=True)
    long = Scenario("long", 1000.0, {"Button": {"points": tuple((float(at), at % 2) for at in range(500))}})
    files = VerifiedFiles()
    with short_files(2000):
        files.store_scenarios([REST, long, Scenario("other", 2000.0)], place)
    assert files.written == [(place / "generated_01.toml", "scenario")]
    [lost] = files.lost
    assert lost.message == "the scenarios cannot be stored: cannot write here: File too large"
    assert lost.location is not None
    assert lost.location.path == str(place / "generated_02.toml")
    assert [path.name for path in place.iterdir()] == ["generated_01.toml"]


def test_a_file_where_the_folder_of_scenarios_should_be(tmp_path: Path) -> None:
    place = tmp_path / "out" / "models" / "scenarios"
    place.parent.mkdir(parents=True)
    place.write_text("mine")
    files = VerifiedFiles()
    files.store_scenarios([REST], place)
    files.write_vcd(tmp_path / "x.vcd", "rest", NOTHING, NOTHING)  # what comes then is written
    assert [finding.message for finding in files.lost] == ["the scenarios cannot be stored: File exists"]
    assert files.written == [(tmp_path / "x.vcd", "vcd")]
    assert place.read_text() == "mine"


def test_a_link_in_the_place_of_a_file_stays(tmp_path: Path) -> None:
    (tmp_path / "other").write_text("mine")
    (tmp_path / "x.vcd").symlink_to(tmp_path / "other")
    files = VerifiedFiles()
    files.write_vcd(tmp_path / "x.vcd", "rest", NOTHING, NOTHING)
    assert files.written == []
    assert [finding.location and finding.location.path for finding in files.lost] == [str(tmp_path / "x.vcd")]
    assert (tmp_path / "x.vcd").is_symlink()
    assert (tmp_path / "other").read_text() == "mine"
