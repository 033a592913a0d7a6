"""The record beside a compiled program: it is read as it was written, and refused with a message where it is damaged."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.verify.toolchains.build_record import BuildRecord, record_at


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("[]", "it is no object"),
        ('"robosmi-build/1"', "it is no object"),
        ("{}", "it has no 'schema'"),
        ('{"schema": ["robosmi-build/2"]}', 'its schema is ["robosmi-build/2"], not robosmi-build/1'),
        ({"board": None}, "its 'board' is not a text"),
        ({"fits": "yes"}, "its 'fits' is not true or false"),
        ({"stand_ins": "Servo"}, "its 'stand_ins' is not a list of texts"),
        ({"stand_ins": [1]}, "its 'stand_ins' is not a list of texts"),
        ({"sources": None}, "its 'sources' is not an object of texts"),
        ({"sources": ["a.ino"]}, "its 'sources' is not an object of texts"),
        ({"sources": {"a.ino": 5}}, "its 'sources' is not an object of texts"),
        ({"sizes": {"ram_bytes": "5"}}, "its 'sizes' is not an object of whole numbers"),
        ({"outside": 5}, "its 'outside' is not an object of texts"),
        (b"\xff", "it is no text in UTF-8"),
    ],
)
def test_a_damaged_record_is_told_in_words_of_the_record(text: str | bytes | dict[str, Any], why: str, tmp_path: Path) -> None:
    path = tmp_path / "blink.build.json"
    if isinstance(text, dict):
        text = json.dumps({**json.loads(BuildRecord("uno", True, (), {}, "").to_bytes()), **text})
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(SourceError) as caught:
        record_at(path)
    assert caught.value.message == f"the record of the program is damaged: {why}"
    assert caught.value.location == Location(str(path))
    assert caught.value.fix == "compile the sketch again"


def test_a_record_of_an_earlier_version_is_read(tmp_path: Path) -> None:
    values = json.loads(BuildRecord("uno", True, ("Servo",), {"a.ino": "1"}, "2").to_bytes())
    (tmp_path / "a.build.json").write_text(json.dumps({k: v for k, v in values.items() if k not in ("sizes", "outside")}))
    assert record_at(tmp_path / "a.build.json") == BuildRecord("uno", True, ("Servo",), {"a.ino": "1"}, "2")
