"""What goes wrong in a corpus run: programs that crash, hang or grow, killed runs, damaged and full stores. Nothing is lost."""

from __future__ import annotations

import os
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.corpus_runs.running_corpora import command, copied, environment, faulty, rows, run_faulty, stopped
from tests.running import run

pytestmark = pytest.mark.processes


def processes_with(word: str) -> list[int]:
    """The running processes that have a word in their command line."""
    found = []
    for place in Path("/proc").iterdir():
        if place.name.isdecimal():
            try:
                if word.encode() in (place / "cmdline").read_bytes().split(b"\0"):
                    found.append(int(place.name))
            except OSError:
                continue
    return found


def test_a_run_that_is_stopped_waits_for_no_program(tmp_path: Path) -> None:
    assert stopped(tmp_path) == "2 1 1 False"


def test_a_program_that_crashes_hangs_or_grows_is_a_row(tmp_path: Path) -> None:
    spec = faulty(
        tmp_path / "all", limits="seconds = 8\nmegabytes = 600", a="good", b="crash", c="hang", d="grow", e="leap", f="fault",
        g="tool", h="good",
    )  # fmt: skip
    out = tmp_path / "out"
    code, document = run_faulty("run", spec, "-o", out, "--jobs", "2")
    states = {Path(name).stem: (state, message) for name, state, message in rows(out, "SELECT id, state, message FROM programs")}
    assert {name: state for name, (state, _) in states.items()} == {
        "a": "done", "b": "failed", "c": "timeout", "d": "too-large", "e": "too-large", "f": "failed", "g": "skipped",
        "h": "done",
    }  # fmt: skip
    assert "crashed: Segmentation fault" in states["b"][1]
    assert states["c"][1] == "it takes longer than 8 s (raise seconds in [limits])"
    assert states["d"][1] == "it needs more than 600 MB (raise megabytes in [limits])"
    assert "a fault of the step" in states["f"][1]
    assert code == 1
    result = document["result"]
    assert (result["done"], result["failed"], result["timeout"], result["too_large"], result["skipped"]) == (2, 2, 1, 2, 1)
    assert processes_with("programs/c.c") == []  # what the step had started has ended with it
    assert len((spec.parent / "programs" / "log").read_text(encoding="utf-8").splitlines()) == 2


def test_another_limit_runs_again_what_did_not_keep_it(tmp_path: Path) -> None:
    spec = faulty(tmp_path / "all", limits="seconds = 0.2", a="slow")
    out = tmp_path / "out"
    assert run_faulty("run", spec, "-o", out)[1]["result"]["timeout"] == 1
    assert run_faulty("run", spec, "-o", out)[1]["result"]["run"] == 0
    spec.write_text(spec.read_text(encoding="utf-8").replace("0.2", "30"), encoding="utf-8")
    code, document = run_faulty("run", spec, "-o", out)
    assert (code, document["result"]["done"]) == (0, 1)


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGINT])
def test_a_killed_run_loses_at_most_the_programs_under_way(tmp_path: Path, how: signal.Signals) -> None:
    names = [f"p{number:02}" for number in range(24)]
    spec = faulty(tmp_path / "all", **dict.fromkeys(names, "slow"))
    out, log = tmp_path / "out", tmp_path / "all" / "programs" / "log"
    with subprocess.Popen(command("run", spec, "-o", out, "--jobs", "2"), env=environment(), stderr=subprocess.DEVNULL) as begun:
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and (not log.is_file() or len(log.read_text(encoding="utf-8").splitlines()) < 6):
            time.sleep(0.05)
        os.kill(begun.pid, how)
        assert begun.wait(timeout=30) == (130 if how == signal.SIGINT else -signal.SIGKILL)
    workers_gone = time.monotonic() + 10
    while time.monotonic() < workers_gone and processes_with(str(spec)):
        time.sleep(0.05)
    stored = rows(out, "SELECT count(*) FROM programs WHERE state = 'done'")[0][0]
    begun_at_most = stored + 2  # one in each worker
    assert 4 <= stored < 24
    time.sleep(0.7)  # a worker that had not noticed would end its program by now
    lines = log.read_text(encoding="utf-8").splitlines()
    assert stored <= len(lines) <= begun_at_most
    code, document = run_faulty("run", spec, "-o", out, "--jobs", "2")
    assert (code, document["result"]["done"]) == (0, 24)
    assert document["result"]["run"] == 24 - stored
    again = log.read_text(encoding="utf-8").splitlines()
    assert {line.removeprefix("programs/") for line in again} == {f"{name}.c" for name in names}
    assert len(again) <= 24 + 2


def test_two_runs_in_one_folder(tmp_path: Path) -> None:
    spec = faulty(tmp_path / "all", **{f"p{number}": "slow" for number in range(60)})
    out = tmp_path / "out"
    with subprocess.Popen(command("run", spec, "-o", out, "--jobs", "1"), env=environment(), stdout=subprocess.DEVNULL) as first:
        while not (out / "corpus.sqlite").is_file():
            time.sleep(0.05)
        assert run_faulty("run", spec, "-o", out)[0] == 5
        first.kill()


def test_a_huge_file_junk_and_a_program_without_an_end_of_line(tmp_path: Path) -> None:
    spec, out = copied(tmp_path), tmp_path / "out"
    programs = tmp_path / "programs"
    with (programs / "huge.c").open("wb") as file:
        file.truncate(100 << 20)
    (programs / "junk.c").write_bytes(bytes(range(256)) * 40)
    (programs / "empty.c").write_bytes(b"")
    os.mkfifo(programs / "pipe.c")
    (programs / "sub" / "loop.c").symlink_to("loop.c")
    spec.write_text("[[programs]]\nglob = 'programs/*.c'\n[[programs]]\nglob = 'programs/sub/loop.c'\n", encoding="utf-8")
    outcome = run("corpus", "run", spec, "-o", out, "--json", "--jobs", "1")
    states = dict(rows(out, "SELECT id, state FROM programs"))
    assert states["programs/huge.c"] == "too-large"
    assert states["programs/blink.c"] == states["programs/wheels.c"] == "done"
    assert states["programs/sub/loop.c"] == "skipped"
    assert outcome.code == 1
    (huge,) = [finding for finding in outcome.document["findings"] if finding["element"] == "programs/huge.c"]
    assert "split it" in huge["message"]
    assert "[limits]" not in huge["message"] + huge["fix"], "no limit of the run lets it in"
    again = run("corpus", "run", spec, "-o", out, "--json", "--jobs", "1")
    assert again.result["unchanged"] == again.result["programs"] - 1 == len(states) - 1


def test_a_store_of_another_version_or_of_something_else(tmp_path: Path) -> None:
    spec, out = copied(tmp_path), tmp_path / "out"
    run("corpus", "run", spec, "-o", out, "--jobs", "1")
    with sqlite3.connect(out / "corpus.sqlite") as db:
        db.execute("UPDATE corpus SET value = '99' WHERE key = 'schema'")
    db.close()
    page: list[str | Path] = ["report", out, "-o", tmp_path / "page"]
    for words in (["run", spec, "-o", out], ["query", out, "SELECT 1"], page):
        refused = run("corpus", *words, "--json")
        assert refused.code == 3
        assert "version 99" in refused.document["findings"][0]["message"]
    (out / "corpus.sqlite").write_bytes(b"no database at all, but a text" * 100)
    for left in out.glob("corpus.sqlite-*"):
        left.unlink()
    assert run("corpus", "run", spec, "-o", out, "--json").code == 3
    (out / "corpus.sqlite").unlink()
    with sqlite3.connect(out / "corpus.sqlite") as db:
        db.execute("CREATE TABLE programs (x)")
    db.close()
    assert run("corpus", "run", spec, "-o", out, "--json").code == 3
    assert run("corpus", "query", tmp_path / "nowhere", "SELECT 1", "--json").code == 3


LIMITED = """
import resource, sys
from robosmi.cli.main import main
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[1]), resource.RLIM_INFINITY))
import signal
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
sys.exit(main(sys.argv[2:]))
"""


def test_a_full_disk_ends_the_run_and_what_is_stored_stays(tmp_path: Path) -> None:
    names = [f"p{number:02}" for number in range(30)]
    spec = faulty(tmp_path / "all", **dict.fromkeys(names, "good"))
    out = tmp_path / "out"
    words = ["corpus", "run", str(spec), "-o", str(out), "--jobs", "1"]
    whole = {**environment(), "PYTHONDONTWRITEBYTECODE": "1"}  # a compiled module that is cut off would stay in the cache
    done = subprocess.run(
        [sys.executable, "-c", LIMITED, "250000", *words], capture_output=True, text=True, env=whole, check=False
    )
    assert done.returncode == 3, done.stderr
    assert "Traceback" not in done.stderr
    stored = rows(out, "SELECT count(*) FROM programs")[0][0]
    assert 0 < stored < 30
    code, document = run_faulty("run", spec, "-o", out)
    assert (code, document["result"]["done"], document["result"]["run"]) == (0, 30, 30 - stored)


def test_an_output_folder_that_cannot_be_written(tmp_path: Path) -> None:
    spec = copied(tmp_path)
    (tmp_path / "out").write_text("a file", encoding="utf-8")
    assert run("corpus", "run", spec, "-o", tmp_path / "out", "--json").code == 3


@pytest.mark.parametrize(
    "words",
    [["--steps", "analyze"], ["--steps", "compile"], ["--steps", ""], ["--retry", "broken"], ["--jobs", "0"], ["--jobs", "x"]],
)
def test_wrong_options(words: list[str], tmp_path: Path) -> None:
    refused = run("corpus", "run", copied(tmp_path), "-o", tmp_path / "out", "--json", *words)
    assert refused.code == 2
    if "--jobs" in words:
        assert f"'{words[1]}' is not a whole number from 1 to 1024" in refused.document["findings"][0]["message"]


def test_no_database_driver_or_server(tmp_path: Path) -> None:
    spec = copied(tmp_path)
    refused = run("corpus", "run", spec, "-o", tmp_path / "out", "--json", "--store", "nonsense://x/y")
    assert refused.code in (3, 4)
    assert run("corpus", "query", tmp_path / "out", "SELECT 1", "--json", "--store", "sqlite:///").code in (2, 3)
