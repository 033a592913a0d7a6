"""Files that are no sketch, or no sketch any more: each is a `SourceError` with place, cause and what to do."""

from __future__ import annotations

import contextlib
import io
import os
import re
import stat
import time
import zipfile
from pathlib import Path

import pytest

from robosmi import inputs
from robosmi.errors import SourceError
from robosmi.transformations.t2m import guarded_xml
from robosmi.transformations.t2m.fritzing import container, read_circuit
from robosmi.transformations.t2m.fritzing.container import read_container
from tests.transformations.t2m.fritzing.support import CASES, FIXTURES

SKETCH = (FIXTURES / "one_sided.fz").read_bytes()


def refused(path: Path) -> SourceError:
    with pytest.raises(SourceError) as caught:
        read_circuit(path)
    error = caught.value
    assert error.exit_code == 3
    assert error.location is not None
    assert error.location.path == str(path)
    assert error.fix
    return error


@pytest.mark.parametrize(
    ("name", "cause", "line"),
    [
        ("malformed.fz", "'malformed.fz' is not well-formed XML: Opening and ending tag mismatch", 4),
        ("doctype.fz", "'doctype.fz' has a DOCTYPE", 3),
        ("other_root.fz", "its root is <{http://www.w3.org/2000/svg}svg>, not <module>", 1),
        ("module_without_instances.fz", "it has no <instances>", 1),
        ("a_part.fz", "is the definition of a part (.fzp), not a sketch", 2),
        ("text.fz", "not well-formed XML", 1),
        ("empty.fz", "the file is empty", None),
        ("missing.fz", "no such file", None),
    ],
)
def test_files_that_are_no_sketch(name: str, cause: str, line: int | None) -> None:
    error = refused(FIXTURES / "bad" / name)
    assert cause in error.message
    assert error.location is not None
    assert error.location.line == line


def test_a_folder() -> None:
    assert "it is a folder" in refused(FIXTURES).message


def test_a_name_that_no_file_can_have() -> None:
    with pytest.raises(SourceError, match=r"cannot be read|no such file"):
        read_circuit("a\0b.fz")


@pytest.mark.skipif(os.name == "nt" or not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may read everything")
def test_a_file_without_permission(tmp_path: Path) -> None:
    path = tmp_path / "closed.fz"
    path.write_bytes(SKETCH)
    path.chmod(0)
    assert "cannot be read" in refused(path).message


def archive(path: Path, entries: dict[str, bytes]) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        for name, data in entries.items():
            file.writestr(name, data)
    return path


def test_archives_without_a_sketch(tmp_path: Path) -> None:
    assert "has no .fz sketch" in refused(archive(tmp_path / "a.fzz", {"code.ino": b"void setup(){}"})).message
    assert "has no .fz sketch" in refused(archive(tmp_path / "b.fzz", {"../up.fz": SKETCH})).message
    assert "has no .fz sketch" in refused(archive(tmp_path / "c.fzz", {})).message


@pytest.mark.parametrize("folder", ["robot/", "deep/er/", "robot\\"])
def test_an_archive_that_was_packed_again_with_its_folder_is_read(folder: str, tmp_path: Path) -> None:
    entries = {f"__MACOSX/{folder}._a.fz": b"?", f"{folder}a.fz": SKETCH, f"{folder}part.b.fzp": b"<module moduleId='b'/>"}
    container = read_container(archive(tmp_path / "a.fzz", entries))
    assert container.sketch == SKETCH
    assert [name for name, _ in container.parts] == [f"{folder}part.b.fzp"]


def test_what_is_no_archive(tmp_path: Path) -> None:
    path = tmp_path / "a.fzz"
    path.write_bytes(b"\x00\x01\x02 no archive")
    assert "ZIP archive" in refused(path).message


@pytest.mark.parametrize("case", CASES)
def test_every_cut_of_an_archive_is_refused(case: str, tmp_path: Path) -> None:
    data = CASES[case].read_bytes()
    path = tmp_path / "cut.fzz"
    for length in range(1, len(data), 97):
        path.write_bytes(data[:length])
        refused(path)


def test_a_damaged_byte_is_refused_or_does_not_matter(tmp_path: Path) -> None:
    data = bytearray(CASES["line_following_robot"].read_bytes())
    path = tmp_path / "bits.fzz"
    for place in range(0, len(data), 61):
        damaged = bytes(data[:place]) + bytes([data[place] ^ 0x55]) + bytes(data[place + 1 :])
        path.write_bytes(damaged)
        with contextlib.suppress(SourceError):
            read_circuit(path)


def test_an_encrypted_entry(tmp_path: Path) -> None:
    data = bytearray(archive(tmp_path / "a.fzz", {"a.fz": SKETCH}).read_bytes())
    data[6] |= 1
    data[data.index(b"PK\x01\x02") + 8] |= 1
    path = tmp_path / "locked.fzz"
    path.write_bytes(data)
    assert "is encrypted" in refused(path).message


def test_sizes_are_limited_by_what_is_really_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(container, "MAX_BYTES", 4096)
    big = archive(tmp_path / "a.fzz", {"a.fz": b"<module>" + b" " * 100_000 + b"</module>"})
    assert "has more than" in refused(big).message
    plain = tmp_path / "a.fz"
    plain.write_bytes(SKETCH)
    os.truncate(plain, inputs.DRAWING.most + 1)
    assert "larger than 64 MB" in refused(plain).message


def test_too_many_entries(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(container, "MAX_ENTRIES", 2)
    assert "3 entries" in refused(archive(tmp_path / "a.fzz", {"a.fz": SKETCH, "b": b"", "c": b""})).message


def test_what_else_an_archive_holds_is_told(tmp_path: Path) -> None:
    path = archive(tmp_path / "a.fzz", {"first.fz": SKETCH, "second.fz": SKETCH, "x/part.y.fzp": b"<module/>", "sketch.ino": b""})
    circuit, findings = read_circuit(path)
    assert [f.rule for f in findings] == ["RS209", "RS209"]
    assert [f.evidence["entries"] for f in findings] == [["second.fz"], ["x/part.y.fzp"]]
    assert circuit.components


@pytest.mark.parametrize("encoding", ["utf-16", "utf-32"])
def test_a_document_type_in_another_encoding(encoding: str, tmp_path: Path) -> None:
    text = f'<?xml version="1.0" encoding="{encoding}"?><!DOCTYPE module><module><instances/></module>'
    path = tmp_path / "a.fz"
    path.write_bytes(text.encode(encoding))
    error = refused(path)
    assert "DOCTYPE" in error.message or "not well-formed" in error.message


def test_deep_nesting_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "deep.fz"
    path.write_bytes(b"<module>" + b"<a>" * 5000 + b"</a>" * 5000 + b"</module>")
    assert "not well-formed" in refused(path).message


def test_many_comments_before_the_root_are_looked_through_at_once(tmp_path: Path) -> None:
    buffer = io.BytesIO()
    buffer.write(b"<!-- x -->\n" * 20_000 + SKETCH.partition(b"?>")[2].strip())
    path = tmp_path / "comments.fz"
    path.write_bytes(buffer.getvalue())
    assert read_circuit(path)[0].components


def test_numbers_as_long_as_you_like_are_only_texts(tmp_path: Path) -> None:
    path = tmp_path / "a.fz"
    text = SKETCH.replace(b'modelIndex="2"', b'modelIndex="' + b"9" * 6000 + b'"').replace(
        b"arduino_Uno", b"9" * 5000 + b"." + b"9" * 5000 + b"Stripboard2ModuleID"
    )
    assert text != SKETCH
    path.write_bytes(text)
    assert read_circuit(path)[0].components


def test_more_parts_than_a_drawing_has(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(container, "MAX_INSTANCES", 2)
    path = tmp_path / "a.fz"
    path.write_bytes(SKETCH)
    error = refused(path)
    assert "the limit is 2" in error.message
    assert error.location is not None
    assert error.location.line is not None


def test_a_hundred_thousand_wires_are_refused_at_once(tmp_path: Path) -> None:
    wire = b'<instance moduleIdRef="WireModuleID" modelIndex="7"><views><breadboardView/></views></instance>'
    path = tmp_path / "a.fz"
    path.write_bytes(b"<module><instances>" + wire * 100_000 + b"</instances></module>")
    started = time.process_time()
    assert "100,000 parts and wires" in refused(path).message
    assert time.process_time() - started < 5


def test_more_tags_than_a_text_has(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(guarded_xml, "MAX_TAGS", 10)
    path = tmp_path / "a.fz"
    path.write_bytes(SKETCH)
    assert "more than 10 tags" in refused(path).message


def test_links_in_an_archive_are_left_out(tmp_path: Path) -> None:
    path = tmp_path / "a.fzz"
    with zipfile.ZipFile(path, "w") as file:
        link = zipfile.ZipInfo("link.fz")
        link.external_attr = (stat.S_IFLNK | 0o777) << 16
        file.writestr(link, "/etc/passwd")
        file.writestr("real.fz", SKETCH)
    circuit, findings = read_circuit(path)
    assert circuit.components
    assert [(f.rule, f.evidence["entries"]) for f in findings] == [("RS209", ["link.fz"])]


def test_a_nested_archive_is_no_sketch(tmp_path: Path) -> None:
    inner = archive(tmp_path / "inner.fzz", {"a.fz": SKETCH})
    assert "not well-formed" in refused(archive(tmp_path / "outer.fzz", {"a.fz": inner.read_bytes()})).message


def test_a_strip_board_as_large_as_a_field(tmp_path: Path) -> None:
    path = tmp_path / "a.fz"
    text = (FIXTURES / "stripboard.fz").read_bytes()
    path.write_bytes(re.sub(rb'moduleIdRef="\d+\.\d+Strip', b'moduleIdRef="999.999Strip', text))
    circuit, findings = read_circuit(path)
    assert circuit.components
    assert [f.rule for f in findings] == ["RS213"]
    assert findings[0].location is not None
    assert findings[0].location.line is not None


def test_buses_that_lead_in_circles(tmp_path: Path) -> None:
    members = [f"c{number}" for number in range(3000)]
    connectors = "".join(f'<connector id="{m}" name="x"/>' for m in members)
    pairs = zip(members, [*members[1:], members[0]], strict=True)
    buses = "".join(f'<bus id="{a}"><nodeMember connectorId="{a}"/><nodeMember connectorId="{b}"/></bus>' for a, b in pairs)
    part = f'<module moduleId="ring"><connectors>{connectors}</connectors><buses>{buses}</buses></module>'
    sketch = SKETCH.replace(b"3234DBDC80leg", b"ring").replace(b'connectorId="connector2"', b'connectorId="c2999"')
    path = archive(tmp_path / "a.fzz", {"a.fz": sketch, "part.ring.fzp": part.encode()})
    started = time.process_time()
    circuit, _ = read_circuit(path)
    assert time.process_time() - started < 10
    assert any(c.partId == "ring" for c in circuit.components)
