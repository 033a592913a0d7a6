"""Run the host model's tests with the libraries' own sources in the place of its models, and say where they disagree.

    python tests/corpus/compare_libraries.py FOLDER [pytest's arguments]

FOLDER holds the Simple Libraries (`Motor/libservo`, `Utility/libsimpletools` ...). Their C files are added to the program of each
test that includes their header, and go before the model's functions, as a program's own do. What fails then is a fault of the
model, or of the test, or is expected: sources compiled here cannot take a double of 4 bytes out of a variable argument list,
their loops cost what those of a program cost, a function that forgets its return value returns none, and a drive without a
calibration has no table. The sources are not part of the project.
"""

from __future__ import annotations

import re
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from robosmi.verify import original_build  # noqa: E402
from robosmi.verify.original_build import OriginalProgram  # noqa: E402

LIBRARIES = {
    "simpletools.h": "Utility/libsimpletools/source",
    "simpletext.h": "TextDevices/libsimpletext",
    "servo.h": "Motor/libservo",
    "ping.h": "Sensor/libping",
    "abdrive.h": "Robotics/ActivityBot/libabdrive",
    "dht22.h": "Sensor/libdht22",
    "sirc.h": "Remote/libsirc",
    "mstimer.h": "Misc/libmstimer",
    "keypad.h": "Interface/libkeypad",
    "dac2ch.h": "Convert/libdac2ch",
    "pwm2ch.h": "Convert/libpwm2ch",
    "datetime.h": "Time/libdatetime",
    "lis3dh.h": "Sensor/liblis3dh",
    "servo360.h": "Motor/libservo360",
    "abdrive360.h": "Robotics/ActivityBot360/libabdrive360",
    "arlodrive.h": "Robotics/Arlo/libarlodrive",
    "bme680.h": "Sensor/libbme680",
}
"""Header -> its folder. A header is only wanted where a test includes it besides simpletools.h, which all of them do."""
LEFT_OUT = re.compile(
    r"i2c_\w+|addfiledriver|sddriverconfig|cogrun|cogend|timeTicks|simpleterm\w*|serial_\w+|gets|monitor|calibrationResults|Display"
    r"|encoderLeds|z_dev_console|bme680"
)
"""Matches files that need what the simulated chip lacks: edges of the bus, drivers, the layout of memory."""
_RENAMED = re.compile(r"^#define drive_\w+ \w+_drive_.*$", re.MULTILINE)
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)


def sources(folder: Path, header: str, place: Path) -> list[Path]:
    """The library's files that implement a header, with the model's names for functions that two libraries define."""
    own = ROOT / "platform_repo" / "propeller" / "host" / "include" / header
    renamed = "\n".join(_RENAMED.findall(own.read_text(encoding="utf-8")))
    found = []
    for path in sorted((folder / LIBRARIES[header]).glob("*.c")):
        text = _COMMENT.sub("", path.read_text(encoding="utf-8", errors="replace"))
        if LEFT_OUT.fullmatch(path.stem) or re.search(r"\bmain\s*\(|__asm__", text):
            continue
        if not renamed:
            found.append(path)
            continue
        wrapped = place / f"{Path(header).stem}_{path.name}"
        wrapped.write_text(f'{renamed}\n#include "{path}"\n', encoding="utf-8")
        found.append(wrapped)
    return found


_OF_MODELS = ["tests/host_model/test_feedback.py::test_each_motion_tells_what_it_aims_at"]
"""Tests of what models tell the verification, which the libraries' own sources do not."""


def main() -> int:
    """Run the tests."""
    folder, arguments = Path(sys.argv[1]).resolve(), sys.argv[2:] or [str(ROOT / "tests" / "host_model")]
    build = original_build.build_original
    with tempfile.TemporaryDirectory() as place, pytest.MonkeyPatch.context() as monkeypatch:
        known = {header: sources(folder, header, Path(place)) for header in LIBRARIES}

        def with_sources(programs: Sequence[Path], *rest: Any) -> OriginalProgram:
            text = programs[0].read_text(encoding="utf-8")
            wanted = [header for header in LIBRARIES if header in text]
            if len(wanted) > 1:
                wanted.remove("simpletools.h")
            if "abdrive360.h" in wanted:
                wanted.append("servo360.h")
            more = [path for header in dict.fromkeys(wanted) for path in known[header]]
            return build([*programs, *more], *rest)

        monkeypatch.setattr(original_build, "build_original", with_sources)
        left_out = [f"--deselect={test}" for test in _OF_MODELS]
        return int(pytest.main(["-q", "-p", "no:cacheprovider", "--rootdir", str(ROOT), *left_out, *arguments]))


if __name__ == "__main__":
    sys.exit(main())
