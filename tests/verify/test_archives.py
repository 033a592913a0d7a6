"""What is cached is taken from this user only: code that goes onto a board, or runs on this machine."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi import resources
from robosmi.verify.toolchains import archives


@pytest.fixture
def made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An archive that is to be cached."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path / "home"))
    path = tmp_path / "made.a"
    path.write_bytes(b"mine")
    path.chmod(0o664)
    return path


def test_an_archive_of_this_user_is_found_again(made: Path) -> None:
    stored = archives.store(made, "core.a")
    assert stored != made
    assert archives.cached("core.a") == stored
    assert not stored.stat().st_mode & 0o022
    assert stored.read_bytes() == b"mine"


@pytest.mark.parametrize("spoil", ["writable", "link", "folder"])
def test_an_archive_that_another_can_have_written_is_not_taken(spoil: str, made: Path) -> None:
    place = resources.cache_dir() / "archives" / "core.a"
    place.parent.mkdir(parents=True)
    foreign = made.with_name("foreign.a")
    foreign.write_bytes(b"theirs")
    if spoil == "writable":
        place.write_bytes(b"theirs")
        place.chmod(0o666)
    elif spoil == "link":
        place.symlink_to(foreign)
    else:
        place.mkdir()
    assert archives.cached("core.a") is None
    assert archives.store(made, "core.a") == made
