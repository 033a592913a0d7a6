"""Real Eclipse EMF as judge of the files that a test writes: a Java process for each thread that asks, started when first asked.

`judge(metamodels, model)` asserts that EMF loads a model with 0 diagnostics and gives what EMF makes of it when it saves it
again. Tests that use it are skipped with the reason where Java or EMF's jars are missing, and fail there if this is the CI.
The judge itself is `tests/emf/EmfCheck.java`; `tests/emf/check.sh` runs it by hand.
"""

from __future__ import annotations

import atexit
import hashlib
import os
import subprocess
import tempfile
import threading
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import IO

import pytest

from tests.tools import require_tools

FOLDER = Path(__file__).parent / "emf"
JARS = [Path("/usr/share/java") / f"{name}.jar" for name in (
    "eclipse-emf-common", "eclipse-emf-ecore", "eclipse-emf-ecore-xmi", "equinox-common",
)]  # fmt: skip


@dataclass
class Verdict:
    """What EMF says of a model.

    Attributes:
        text: its whole answer; the last line says OK or BAD.
        ok: whether there is no diagnostic.
        saved: the bytes it writes for the model.
        canon: what it sees in it, one line per element and feature.
    """

    text: str
    ok: bool
    saved: bytes
    canon: str


def require_emf() -> None:
    """Skip the running test where the judge cannot run; fail instead if this is the CI."""
    require_tools("java", "javac")
    missing = [jar.name for jar in JARS if not jar.is_file()]
    if missing:
        reason = f"not installed: {', '.join(missing)}"
        if os.environ.get("CI") == "true":
            pytest.fail(f"{reason} (CI=true: a skipped test would test nothing)")
        pytest.skip(reason)


def classpath() -> str:
    """The judge's class path; compiled once for every state of its source."""
    source = FOLDER / "EmfCheck.java"
    stamp = hashlib.sha256(source.read_bytes()).hexdigest()[:16]
    folder = Path(tempfile.gettempdir()) / f"robosmi-emf-judge-{os.getuid()}-{stamp}"
    jars = os.pathsep.join(map(str, JARS))
    if not (folder / "EmfCheck.class").is_file():
        with tempfile.TemporaryDirectory(dir=folder.parent) as made:
            command = ["javac", "-nowarn", "-encoding", "UTF-8", "-cp", jars, "-d", made, str(source)]
            subprocess.run(command, check=True, capture_output=True)
            folder.mkdir(exist_ok=True)
            for file in Path(made).iterdir():
                os.replace(file, folder / file.name)
    return f"{folder}{os.pathsep}{jars}"


class _OfThread(threading.local):
    """The Java process of one thread."""

    @cached_property
    def process(self) -> subprocess.Popen[str]:
        """Started when first asked, ended with this process."""
        options = ["-Xss64m", "-Xmx2g", "-Dfile.encoding=UTF-8", "-Duser.timezone=UTC", "-cp", classpath()]
        process = subprocess.Popen(
            ["java", *options, "EmfCheck", "--serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
            encoding="utf-8",
        )  # fmt: skip
        _STARTED.append(process)
        return process


_THREAD = _OfThread()
_STARTED: list[subprocess.Popen[str]] = []


@atexit.register
def stop() -> float:
    """End all judges of this process, for good; returns the processor seconds that they have taken."""
    before = sum(os.times()[2:4])
    while _STARTED:
        process = _STARTED.pop()
        for stream in (process.stdin, process.stdout):
            if stream is not None:
                stream.close()
        process.wait(timeout=20)
    return sum(os.times()[2:4]) - before


def _stream(stream: IO[str] | None) -> IO[str]:
    assert stream is not None
    return stream


def ask(*arguments: str | Path) -> tuple[str, bool]:
    """The judge's answer to a command line, and whether it is content."""
    process = _THREAD.process
    _stream(process.stdin).write("\t".join(map(str, arguments)) + "\n")
    _stream(process.stdin).flush()
    lines: list[str] = []
    for line in _stream(process.stdout):
        if line.startswith("\x04"):
            return "".join(lines), line.strip() == "\x040"
        lines.append(line)
    raise AssertionError(f"the judge died: {''.join(lines)}")


def look(metamodels: Iterable[Path], model: Path, *options: str) -> Verdict:
    """EMF's verdict on a model, whatever it is."""
    require_emf()
    with tempfile.TemporaryDirectory() as name:
        # the copy lies beside the model, so that relative references in it are those of the model
        saved, canon = model.with_name(f".{model.name}.saved"), Path(name) / "canon.txt"
        try:
            text, ok = ask(*metamodels, model, "--resave", saved, "--canon", canon, "-q", *options)
            found = Verdict(text, ok, saved.read_bytes() if saved.exists() else b"", canon.read_text() if canon.exists() else "")
        finally:
            saved.unlink(missing_ok=True)
    return found


def judge(metamodels: Iterable[Path], model: Path, *options: str) -> Verdict:
    """EMF's verdict on a model, which must be OK with 0 diagnostics."""
    verdict = look(metamodels, model, *options)
    assert verdict.ok, f"EMF on {model.name}: {verdict.text}"
    assert " 0 diagnostics" in verdict.text
    return verdict


def judge_same(metamodels: Iterable[Path], model: Path, *options: str) -> Verdict:
    """As `judge`; what EMF writes for the model must be the model's own bytes."""
    verdict = judge(metamodels, model, *options)
    assert verdict.saved.decode() == model.read_text(encoding="utf-8")
    return verdict
