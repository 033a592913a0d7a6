"""Models of libraries that lie outside of the package: found beside the program, in named folders, in the user's data."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from robosmi.base.trust import acting
from robosmi.cli.main import main
from robosmi.errors import SourceError, VerificationError
from robosmi.inputs import DATA, read_bytes
from robosmi.transformations.verification.originals import original_program
from robosmi.verify.host_model import load_host_model
from robosmi.verify.original import OriginalRun
from robosmi.verify.original_run import run_original
from tests.tiers import sample
from tests.tools import require_verification

OUTSIDE = Path(__file__).parent / "outside"
HOST = Path("platform_repo", "propeller", "host")


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_verification()


def ran(source: Path, folder: Path) -> OriginalRun:
    """Build a program in an empty folder and run it."""
    folder.mkdir()
    return run_original(original_program([source], load_host_model("propeller"), folder), 1e6)


@pytest.mark.parametrize("place", sample(["project", "path", "home"], 1))
def test_a_model_is_found_wherever_data_is_looked_for(place: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    source = tmp_path / "program.c"
    shutil.copy(OUTSIDE / "program.c", source)
    with pytest.raises(VerificationError, match=r"signal_mast\.h: No such file"):
        ran(source, tmp_path / "without")
    if place == "project":
        shutil.copytree(OUTSIDE / "platform_repo", tmp_path / ".robosmi" / "platform_repo")
    elif place == "path":
        monkeypatch.setenv("ROBOSMI_PATH", str(OUTSIDE))
    else:
        shutil.copytree(OUTSIDE / "platform_repo", tmp_path / "data" / "platform_repo")
        monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path / "data"))
    run = ran(source, tmp_path / "with")
    assert (run.status, run.trace.text) == ("finished", "1 0")
    assert [level for _, level in run.trace.levels("P21")][-1] == 1


def own_library(folder: Path, monkeypatch: pytest.MonkeyPatch, name: str, text: str) -> Path:
    """A model of a library in a user's folder, which takes precedence."""
    path = folder / HOST / "libraries" / name
    path.parent.mkdir(parents=True)
    path.write_text(text)
    monkeypatch.setenv("ROBOSMI_PATH", str(folder))
    return path


def test_a_file_of_the_nearest_place_counts_before_the_built_in_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own_library(tmp_path, monkeypatch, "ping.c", '#include "ping.h"\nint ping_cm(int pin) { return 1000 + pin; }\n')
    source = tmp_path / "near.c"
    source.write_text('#include "simpletools.h"\n#include "ping.h"\nint main() { print("%d", ping_cm(7)); }\n')
    assert ran(source, tmp_path / "built").trace.text == "1007"


def test_a_model_that_does_not_compile_is_told_as_such(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    library = own_library(tmp_path, monkeypatch, "own.c", "int own(void) {\n  return nothing;\n}\n")
    source = tmp_path / "any.c"
    source.write_text("int main() { return 0; }\n")
    with pytest.raises(VerificationError, match=r"the model of a library does not compile on this machine: 'nothing'") as told:
        ran(source, tmp_path / "built")
    assert told.value.location is not None
    assert (told.value.location.path, told.value.location.line) == (str(library), 2)


def test_a_function_without_a_model_is_told_as_the_program_writes_it(tmp_path: Path) -> None:
    source = tmp_path / "badge.c"  # two headers declare badge_setup
    source.write_text('#include "badgetools.h"\nint main() { badge_setup(); }\n')
    run = ran(source, tmp_path / "built")
    assert (run.status, run.cause) == ("unmodelled", "badge_setup")


def test_a_found_model_runs_only_when_it_is_trusted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(OUTSIDE / "platform_repo", tmp_path / ".robosmi" / "platform_repo")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SourceError, match="not trusted"), acting(host=True):
        pass
    assert main(["trust", str(tmp_path)]) == 0
    with acting(host=True):
        assert tmp_path / ".robosmi" / HOST / "libraries" / "signal_mast.c" in load_host_model("propeller").libraries
    (tmp_path / ".robosmi" / HOST / "libraries" / "more.c").write_text("int more(void) { return 1; }\n")
    with pytest.raises(SourceError, match="changed since"), acting(host=True):
        pass


def test_a_command_that_runs_no_model_needs_no_trust_for_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(OUTSIDE / "platform_repo", tmp_path / ".robosmi" / "platform_repo")
    monkeypatch.chdir(tmp_path)
    with acting():
        pass
    with acting(), pytest.raises(SourceError, match="not trusted"):  # a file of it that is read all the same
        read_bytes(tmp_path / ".robosmi" / HOST / "libraries" / "signal_mast.c", DATA)
    program = tmp_path / ".robosmi" / "platform_repo" / "arduino" / "compile.toml"
    program.parent.mkdir()
    program.write_text("")
    with pytest.raises(SourceError, match=r"read them \(platform_repo/arduino/compile\.toml\)"), acting():
        pass
