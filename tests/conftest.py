"""What all tests share: a history of their own, and the folder with the shared facts where there is one."""

from __future__ import annotations

from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(autouse=True)
def _own_history(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    """No test reads or writes the history of the person who runs it."""
    monkeypatch.setenv("ROBOSMI_HISTORY", str(tmp_path_factory.mktemp("history") / "history.sqlite"))


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
