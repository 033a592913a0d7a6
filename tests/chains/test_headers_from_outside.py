"""A header that a program takes from outside of its folders is named: it is copied into the output folder."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.running import run

PROGRAM = '#include "simpletools.h"\n#include "{header}"\nint main() {{ high(KEY); pause(5); }}\n'

ADAPTER = """//# header ping.h
//# adapter ping_cm
//#   for: int ping_cm(int pin)
//#   kind: oneToOne
//#   pin: pin digital in
//#   fidelity: no echo
int ping_cm(int pin) { return missing(pin); }
"""


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


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
def test_a_drawing_and_an_adapter_from_outside_are_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    robot, other = tmp_path / "robot", tmp_path / "other"
    (robot / "adapters").mkdir(parents=True)
    other.mkdir()
    (other / "pins.csv").write_text("pin,part,title\nD9,Red LED,A\n")
    (other / "ping.cpp").write_text(ADAPTER)
    (robot / "adapters" / "ping.cpp").symlink_to(other / "ping.cpp")
    (robot / "robosmi.toml").write_text('[migrate]\nhardware = "../other/pins.csv"\n')
    (robot / "look.c").write_text('#include "simpletools.h"\n#include "ping.h"\nint main() { pause(ping_cm(3)); }\n')
    (robot / ".robosmi" / "platform_repo").mkdir(parents=True)
    (robot / ".robosmi" / "platform_repo" / "own.toml").write_text("")
    monkeypatch.chdir(robot)
    found = run("migrate", "look.c", "-o", "out", "--json").document["findings"]
    told = [f["message"] for f in found if f["rule"] == "RS113"]
    assert told == [
        f"'{other / name}' is outside the program's folders and is copied with it" for name in ("pins.csv", "ping.cpp")
    ]
    (untested,) = [f["message"] for f in found if f["rule"] == "RS539"]
    assert "not compiled" in untested
    assert "are not trusted" in untested
    named = run("migrate", "look.c", "--hardware", other / "pins.csv", "-o", "out2", "--json").document["findings"]
    assert str(other / "pins.csv") not in str([f for f in named if f["rule"] == "RS113"])


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
@pytest.mark.parametrize("options", [[], ["-I", "inc"]])
def test_a_header_that_is_a_pipe_is_rejected_at_once(options: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "inc").mkdir()
    os.mkfifo((tmp_path / "inc" if options else tmp_path) / "key.h")
    (tmp_path / "blink.c").write_text(PROGRAM.format(header="key.h"))
    monkeypatch.chdir(tmp_path)
    outcome = run("migrate", "blink.c", *options, "-o", "out")
    assert (outcome.code, "named pipe" in outcome.err, (tmp_path / "out").exists()) == (3, True, False)
