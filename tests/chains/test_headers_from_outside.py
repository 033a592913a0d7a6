"""A header that a program takes from outside of its folders is named: it is copied into the output folder."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.running import run

PROGRAM = '#include "simpletools.h"\n#include "{header}"\nint main() {{ high(KEY); pause(5); }}\n'


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
@pytest.mark.parametrize(
    ("header", "options", "said"),
    [
        ("/key.h", [], True),
        ("../key.h", [], True),
        ("link.h", [], True),
        ("../key.h", ["-I", ".."], False),
        ("own.h", [], False),
        ("sub/own.h", [], False),
        ("inner.h", [], False),
    ],
)
def test_a_header_from_outside_is_named(
    header: str, options: list[str], said: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    robot = tmp_path / "robot"
    (robot / "sub").mkdir(parents=True)
    for path in (tmp_path / "key.h", robot / "own.h", robot / "sub" / "own.h"):
        path.write_text("#define KEY 3\n")
    (robot / "link.h").symlink_to(tmp_path / "key.h")
    (robot / "inner.h").symlink_to("sub/own.h")
    absolute = header.startswith("/")
    (robot / "blink.c").write_text(PROGRAM.format(header=f"{tmp_path}{header}" if absolute else header))
    monkeypatch.chdir(robot)
    outcome = run("migrate", "blink.c", *options, "-o", "out", "--json")
    told = [finding["message"] for finding in outcome.document["findings"] if finding["rule"] == "RS113"]
    assert told == ([f"'{tmp_path / 'key.h'}' is outside the program's folders and is copied with it"] if said else [])


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
@pytest.mark.parametrize("options", [[], ["-I", "inc"]])
def test_a_header_that_is_a_pipe_is_rejected_at_once(options: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "inc").mkdir()
    os.mkfifo((tmp_path / "inc" if options else tmp_path) / "key.h")
    (tmp_path / "blink.c").write_text(PROGRAM.format(header="key.h"))
    monkeypatch.chdir(tmp_path)
    outcome = run("migrate", "blink.c", *options, "-o", "out")
    assert (outcome.code, "named pipe" in outcome.err, (tmp_path / "out").exists()) == (3, True, False)
