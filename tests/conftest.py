"""What all tests share: data of their own, the folder with the shared facts if there is one, EMF's word on every model."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Callable
from itertools import count
from pathlib import Path

import pytest

from tests import tiers, written_models_judge
from tests.copies import Copies

ROOT = Path(__file__).resolve().parents[1]
BYTECODE = ROOT / ".pytest_cache" / "bytecode"
"""It lasts: to compile the tests takes longer than to collect them."""
_NUMBERS = count()
_HOME = pytest.StashKey["tempfile.TemporaryDirectory[str]"]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """Let the tier be chosen."""
    tiers.add_option(parser)


def pytest_xdist_auto_num_workers(config: pytest.Config) -> int:
    """What `-n auto` means."""
    return tiers.workers(config.getoption("tier"))


def pytest_configure(config: pytest.Config) -> None:
    """Have real EMF judge every model that a test writes, and keep fixtures of modules, too, out of the data of the person."""
    folder = config.stash[_HOME] = tempfile.TemporaryDirectory(prefix="robosmi-tests-")
    os.environ["ROBOSMI_HOME"] = folder.name
    os.environ["ROBOSMI_HISTORY"] = str(Path(folder.name) / "history.sqlite")
    if not hasattr(config, "workerinput"):  # one set of bytecode for the processes of this run, hundreds of which are a test's
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        os.environ.setdefault("PYTHONPYCACHEPREFIX", str(BYTECODE))
    for mark, meaning in written_models_judge.MARKS.items():
        config.addinivalue_line("markers", f"{mark}(reason): {meaning}")
    tiers.join(config)
    if config.getoption("tier") != "check":  # EMF is a program, too
        written_models_judge.join(config)


def pytest_unconfigure(config: pytest.Config) -> None:
    """Remove what fixtures of modules have written."""
    config.stash[_HOME].cleanup()
    if not hasattr(config, "workerinput"):  # bytecode of modules in temporary folders
        shutil.rmtree(BYTECODE.joinpath(*Path(tempfile.gettempdir()).parts[1:]), ignore_errors=True)


@pytest.fixture(autouse=True)
def _own_data(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """No test reads or writes the data of the person who runs it: history, imported libraries, parts and platforms."""
    folder = Path(request.config.stash[_HOME].name, str(next(_NUMBERS)))  # pytest's own would look at all folders of the run
    folder.mkdir()
    monkeypatch.setenv("ROBOSMI_HOME", str(folder))
    monkeypatch.setenv("ROBOSMI_HISTORY", str(folder / "history.sqlite"))
    if "ROBOSMI_NPM" not in os.environ:
        monkeypatch.setenv("ROBOSMI_NPM", str(ROOT / ".npm"))


@pytest.fixture(scope="session")
def copies(tmp_path_factory: pytest.TempPathFactory) -> Copies:
    """Folders that are filled once for all tests of this process."""
    return Copies(tmp_path_factory.mktemp("copies"))


@pytest.fixture
def restored(copies: Copies, monkeypatch: pytest.MonkeyPatch) -> Callable[[str, Callable[[Path], None]], Path]:
    """`Copies.restored` with the data that the user had who filled the folder; they are in its folder `user`."""

    def folder(name: str, fill: Callable[[Path], None]) -> Path:
        user = copies.place_of(name) / "user"
        monkeypatch.setenv("ROBOSMI_HOME", str(user))
        monkeypatch.setenv("ROBOSMI_HISTORY", str(user / "history.sqlite"))
        return copies.restored(name, fill)

    return folder


@pytest.fixture
def examples() -> Path:
    """The case studies."""
    return ROOT / "docs" / "examples"


@pytest.fixture
def shared() -> Path:
    """The folder with labels and judges that are not part of the project."""
    folder = ROOT.parent / "shared"
    if not folder.is_dir():
        pytest.skip("the folder 'shared' with labels and judges is not beside the project")
    return folder
