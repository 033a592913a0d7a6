"""Fixtures of the ranking tests: the tiny index that `data/tiny.jsonl` describes, and the shared facts where they are."""

from __future__ import annotations

import gzip
from collections.abc import Iterator
from pathlib import Path

import pytest

from robosmi.recommend.history import History
from robosmi.recommend.index import LibraryIndex
from robosmi.transformations.t2m.library_index import build
from tests.recommend.labelled import Labelled, labelled

DATA = Path(__file__).parent / "data"


@pytest.fixture(autouse=True, scope="module")
def _no_libraries_of_the_user(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Hide libraries that the user has imported, also from fixtures of whole modules, so that they change no figure."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROBOSMI_HOME", str(tmp_path_factory.mktemp("home")))
        yield


@pytest.fixture
def tiny_facts(tmp_path: Path) -> Path:
    """The five libraries as the builder wants them."""
    path = tmp_path / "tiny.jsonl.gz"
    path.write_bytes(gzip.compress((DATA / "tiny.jsonl").read_bytes()))
    return path


@pytest.fixture
def tiny(tiny_facts: Path, tmp_path: Path) -> Iterator[LibraryIndex]:
    """An index of five libraries and seven headers."""
    build(tiny_facts, tmp_path / "tiny.sqlite")
    index = LibraryIndex(tmp_path / "tiny.sqlite")
    yield index
    index.close()


@pytest.fixture
def history(tmp_path: Path) -> History:
    """A history whose file is not there yet."""
    return History(tmp_path / "own" / "history.sqlite")


@pytest.fixture(scope="session")
def data() -> Labelled:
    """The labelled queries with their judge."""
    return labelled()


@pytest.fixture(scope="session")
def shared_facts() -> Path:
    """The folder with the facts about libraries and the labelled queries."""
    folder = Path(__file__).resolve().parents[2].parent / "shared" / "arduino-libraries"
    if not (folder / "index.jsonl.gz").is_file():
        pytest.skip("the shared facts about libraries are not beside this checkout")
    return folder
