"""The parts of the compile check that need no tools: project files, messages, make rules, data, doctor."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from robosmi.cli.commands.doctor import tools
from robosmi.errors import PlatformDataError, SourceError
from robosmi.verify.toolchains import messages
from robosmi.verify.toolchains.libraries import missing_headers
from robosmi.verify.toolchains.sketch import ProjectFile, check_plain, read_project_file
from robosmi.verify.toolchains.toolchain_data import fill, load_toolchains, version_key

VERIFY = Path(messages.__file__).parent
CASES = Path(__file__).parent / "cases"

KEYS = {
    "profiles": "profiles",
    "default_profile": "default_profile",
    "default_board": "default_fqbn",
    "board": "fqbn",
    "libraries": "libraries",
}
"""How the project files of sketches call these, as the toolchain's data has it."""


def project_file(tmp_path: Path, text: str) -> ProjectFile:
    """The file of that text, read."""
    path = tmp_path / "sketch.yaml"
    path.write_text(text)
    return read_project_file(path, KEYS)


@pytest.mark.parametrize("name", ["adapters.h.gch", "src/Servo.h.gch/c++", "adapters.h.pch"])
def test_a_precompiled_header_beside_a_sketch_is_refused(tmp_path: Path, name: str) -> None:
    check_plain(tmp_path)
    (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / name).write_bytes(b"gpch")
    with pytest.raises(SourceError, match="a precompiled header"):
        check_plain(tmp_path)


def test_a_pipe_in_a_sketchs_folder_is_refused(tmp_path: Path) -> None:
    (tmp_path / "nowhere").symlink_to(tmp_path / "missing")
    check_plain(tmp_path)
    os.mkfifo(tmp_path / "my.h")
    with pytest.raises(SourceError, match="cannot be compiled: it is a named pipe"):
        check_plain(tmp_path)


def test_the_default_profile_names_board_and_libraries() -> None:
    read = read_project_file(CASES / "for_mega" / "for_mega" / "sketch.yaml", KEYS)
    assert (read.board, read.board_line) == ("arduino:avr:mega:cpu=atmega2560", 7)
    assert read.libraries == {"Servo": "1.2.1", "DHT sensor library": "1.4.6"}


@pytest.mark.parametrize(
    ("text", "board"),
    [
        ("profiles:\n  only:\n    fqbn: a:b:c\n", "a:b:c"),
        ("default_fqbn: 'a:b:c'\n", "a:b:c"),
        ("profiles:\n  x:\n    fqbn: a:b:c\n  y:\n    fqbn: a:b:d\n", None),
        ("profiles:\n  x:\n    fqbn:   # to do\n    libraries:\ndefault_profile: x\n", ""),  # no board has that name
        ("default_profile:\ndefault_fqbn:\n", ""),
        ("---\n# nothing\n", None),
    ],
)
def test_the_board_of_other_project_files(tmp_path: Path, text: str, board: str | None) -> None:
    read = project_file(tmp_path, text)
    assert (read.board, read.libraries) == (board, {})


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("default_profile: uno\n", "1: the default profile 'uno' is not among the profiles"),
        ("profiles: {uno: {fqbn: a}}\n", "1: '{uno: {fqbn: a}}': unsupported YAML style"),
        ("profiles:\n\tuno:\n", "2: a tab indents the line"),
        ("profiles:\n  uno\n", "2: 'uno' is not a `key: value` line"),
    ],
)
def test_what_is_not_read_is_refused_with_its_line(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(SourceError) as caught:
        project_file(tmp_path, text)
    assert f"sketch.yaml:{message}" in str(caught.value)


def test_compiler_messages_become_findings_once_with_their_notes(tmp_path: Path) -> None:
    (tmp_path / "x.ino").write_text("")
    said = (
        "In file included from x.ino:1:0:\n"
        "./x.ino: In function 'void loop()':\n"
        "./x.ino:3:5: error: too few arguments\n"
        "/usr/lib/core.h:9:1: note: declared here\n"
        "x.ino:3:5: error: too few arguments\n"
        "/usr/lib/core.h:2:1: warning: not ours [-Wunused]\n"
        "/usr/lib/core.h:7:1: error: used wrongly\n"
    )
    found, elsewhere = messages.compiler_findings(said, load_toolchains()[0].messages, tmp_path)
    assert [str(f.location) for f in found] == [f"{tmp_path}/x.ino:3:5", "/usr/lib/core.h:7:1"]
    (note,) = found[0].listed("notes")
    assert isinstance(note, dict)
    assert note["message"] == "declared here"
    assert elsewhere == 1


@pytest.mark.parametrize("kind", ["fatal error", "sorry, unimplemented", "internal compiler error"])
def test_all_kinds_of_errors_of_the_compiler_are_errors(kind: str, tmp_path: Path) -> None:
    (tmp_path / "x.ino").write_text("")
    for toolchain in load_toolchains():
        found, _ = messages.compiler_findings(f"x.ino:3:5: {kind}: not this\n", toolchain.messages, tmp_path)
        assert [(f.severity.name, f.message, f.location.line if f.location else 0) for f in found] == [("error", "not this", 3)]


def test_a_header_of_the_core_is_not_looked_for_in_a_library(tmp_path: Path) -> None:
    (tmp_path / "x.ino").write_text("")
    patterns = next(toolchain.messages for toolchain in load_toolchains() if toolchain.platform == "arduino")
    for header, fix in (("Arduino.h", "install the board's core again"), ("Other.h", "install the library that has Other.h")):
        said = f"x.ino:1:10: fatal error: {header}: No such file or directory\n"
        (finding,) = messages.compiler_findings(said, patterns, tmp_path)[0]
        assert (finding.fix or "").startswith(fix)


def test_a_tool_that_says_nothing_is_still_a_finding() -> None:
    assert messages.unread("linking", "").message == "linking failed: no message from the tool"
    said = "ld: cannot open linker script file memory.ld: No such file or directory\ncollect2: error: ld returned 1 exit status"
    assert "memory.ld" in messages.unread("linking", said).message


def test_missing_headers_are_the_names_that_are_no_files(tmp_path: Path) -> None:
    (tmp_path / "with blank.h").write_text("")
    (tmp_path / "there.h").write_text("")
    assert missing_headers("x.o: there.h with\\ blank.h \\\n gone.h sub/gone.h\n", tmp_path) == ["gone.h", "sub/gone.h"]
    assert missing_headers("", tmp_path) == []


def test_braces_are_filled_in() -> None:
    assert fill(["-I{a}/x", "{many}", "{none}"], {"a": "1"}, {"many": ["p", "q"], "none": []}) == ["-I1/x", "p", "q"]
    with pytest.raises(PlatformDataError, match=r"unknown placeholder '\{b\}' in '-D\{b\}'"):
        fill(["-D{b}"], {"a": "1"})


def test_versions_sort_by_number() -> None:
    assert sorted(["1.8.10", "1.8.9"], key=version_key) == ["1.8.9", "1.8.10"]


@pytest.mark.processes
def test_doctor_names_what_is_missing_and_how_to_get_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("HOME", str(tmp_path))
    by_name = {status.name: status.to_json() for status in tools()}
    assert {"pyecore", "libclang", "lxml", "jinja2", "networkx", "avr-gcc", "Arduino AVR core"} <= set(by_name)
    assert by_name["avr-gcc"] == {
        "name": "avr-gcc",
        "needed_for": "compile, verify",
        "found": None,
        "version": None,
        "fix": "sudo apt install gcc-avr",
        "gives": "compile says whether C programs build and fit the board; upload, simulate and verify rest on that",
        "purpose": "compile",
    }
    assert by_name["networkx"]["version"]
    assert by_name["networkx"]["fix"] is None


def test_the_framework_names_no_platform() -> None:
    words = ("propeller", "arduino", "fritzing", "avr")
    for path in VERIFY.glob("*.py"):
        assert not [word for word in words if word in path.read_text().lower()], path.name
