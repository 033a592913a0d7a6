"""`robosmi verify` that is asked to end: it ends soon, with all that it has started, and leaves nothing behind."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from itertools import product
from pathlib import Path

import pytest

from tests.running import run
from tests.tiers import sample
from tests.tools import require_verification

BUSY = """#include "simpletools.h"
int busy;
int main() {
  while (1) {
    for (int i = 0; i < 200; i++) busy += i;
    toggle(26);
    if (input(3)) print("pressed\\n");
    pause(1);
  }
}
"""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A migrated program, and a scenario that takes long."""
    require_verification("simavr")
    folder = tmp_path_factory.mktemp("busy")
    (folder / "busy.c").write_text(BUSY)
    (folder / "long.toml").write_text("horizon_ms = 600000\n")
    assert run("migrate", folder / "busy.c", "-o", folder / "out", "--bind", "P26=D13", "--bind", "P3=D3").code in (0, 1)
    return folder


def started_by(mark: str) -> list[int]:
    """The processes that have this text in their environment."""
    found = []
    for entry in Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and mark.encode() in (entry / "environ").read_bytes():
                state = (entry / "stat").read_text().rpartition(")")[2].split()[0]
                found += [int(entry.name)] if state != "Z" else []
        except OSError:
            continue
    return found


def works(mark: str, stage: str) -> bool:
    """Whether a run has reached a stage, recognised by a process that belongs to it."""
    for process in started_by(mark):
        try:
            words = Path(f"/proc/{process}/cmdline").read_bytes().decode(errors="replace")
        except OSError:
            continue
        if stage in words:
            return True
    return False


def heed_signals() -> None:
    """Reset signal handling as in a shell's foreground commands; background ones are started with some signals ignored."""
    for number in (signal.SIGINT, signal.SIGQUIT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="this system does not list its processes in /proc")
@pytest.mark.parametrize(
    ("stage", "name"), sample(product(["avr-g", "/original", "robosmi.verify.worker"], ["SIGTERM", "SIGQUIT", "SIGINT"]), 2)
)
def test_it_ends_with_all_that_it_started(stage: str, name: str, made: Path, tmp_path: Path) -> None:
    place = tmp_path / "passing"
    place.mkdir()
    out = made / "out"
    if stage == "avr-g":  # a compiler that waits for a header of which nobody writes anything
        out = tmp_path / "out"
        shutil.copytree(made / "out", out)
        os.mkfifo(tmp_path / "waits.h")
        sketch = out / "busy" / "busy.ino"
        sketch.write_text(f'#include "{tmp_path / "waits.h"}"\n{sketch.read_text()}')
    command = [sys.executable, "-m", "robosmi", "verify", str(out)]
    if stage == "robosmi.verify.worker":
        (tmp_path / "s.toml").write_text("horizon_ms = 60000\n")
        command += ["--scenario", str(tmp_path / "s.toml")]
    elif stage == "/original":
        command += ["--scenario", str(made / "long.toml")]
    environment = os.environ | {"TMPDIR": str(place), "ROBOSMI_HOME": str(tmp_path / "home")}
    with subprocess.Popen(
        command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, preexec_fn=heed_signals
    ) as process:
        until = time.monotonic() + 90
        while not works(str(place), stage) and time.monotonic() < until and process.poll() is None:
            time.sleep(0.02)
        assert process.poll() is None, process.stderr.read() if process.stderr else ""
        number = getattr(signal, name)
        process.send_signal(number)
        begun = time.monotonic()
        said = process.communicate(timeout=60)[1]
        took = time.monotonic() - begun
    assert (process.returncode, "interrupted" in said) == (128 + number, True), said
    assert took < 20
    for _ in range(50):
        if not started_by(str(place)):
            break
        time.sleep(0.1)
    assert started_by(str(place)) == []
    assert [path.name for path in place.iterdir() if path.name.startswith("robosmi-")] == []
