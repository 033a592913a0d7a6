"""Corpus runs: programs of folders, lists and repositories, what is run again and what is not, exit codes."""

from __future__ import annotations

import json
import os
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from robosmi.corpus import backends
from robosmi.corpus.jobs import ProgramJob, ProgramResult
from tests.corpus_runs.running_corpora import copied, rows
from tests.running import Outcome, run
from tests.tools import require_tools, require_verification

pytestmark = pytest.mark.processes


def corpus_run(spec: Path, out: Path, *words: str | Path) -> Outcome:
    return run("corpus", "run", spec, "-o", out, "--json", "--jobs", "1", *words)


@pytest.fixture(scope="module")
def analysed(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path, Outcome]:
    """The specification, the output folder and the outcome of a first run."""
    folder = tmp_path_factory.mktemp("corpus")
    spec = copied(folder)
    return spec, folder / "out", corpus_run(spec, folder / "out", "--models")


def test_each_match_of_a_glob_is_a_program_with_rows(analysed: tuple[Path, Path, Outcome]) -> None:
    spec, out, outcome = analysed
    assert outcome.code == 0
    assert outcome.result | {"programs": 4, "done": 4, "failed": 0, "unchanged": 0, "run": 4} == outcome.result
    names = {"programs/blink.c", "programs/wheels.c", "programs/sub/badge.c", "programs/sub/no_main.c"}
    assert {row[0] for row in rows(out, "SELECT id FROM programs")} == names
    assert rows(out, "SELECT path, state FROM programs WHERE id = 'programs/blink.c'") == [
        (str(spec.parent / "programs" / "blink.c"), "done")
    ]
    calls = "SELECT function, header, line, disposition, has_body FROM calls WHERE program = 'programs/sub/badge.c' ORDER BY line"
    assert rows(out, calls) == [
        ("badge_setup", "badgetools.h", 6, None, 0), ("cursor", "badgetools.h", 7, None, 0),
        ("oledprint", "badgetools.h", 8, None, 0), ("launch_rocket", None, 9, "unknown", 0),
    ]  # fmt: skip
    assert rows(out, "SELECT count(*), min(pin), max(direction) FROM pins WHERE program = 'programs/blink.c'") == [(2, 26, "out")]
    assert rows(out, "SELECT has_body FROM calls WHERE function = 'drive_speed'") == [(1,), (1,)]
    seconds, peak = rows(out, "SELECT min(seconds), min(peak_mb) FROM programs")[0]
    assert 0 < seconds < 60
    assert 0 <= peak < 1000
    steps = "SELECT max(peak_mb) FROM steps WHERE program <> (SELECT id FROM programs ORDER BY finished LIMIT 1)"
    assert rows(out, steps)[0][0] < 40, "what earlier programs have loaded does not count"


def test_a_run_that_leaves_out_programs_because_of_a_workers_version_does_not_exit_with_0(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def backend(jobs: Iterator[ProgramJob], _: object) -> Iterator[ProgramResult]:
        for number, job in enumerate(jobs):
            if number:
                yield ProgramResult(job.work.id)
            else:
                yield ProgramResult(job.work.id, "skipped", message="the worker has RoboSMi 0", other_version=True)

    monkeypatch.setattr(backends, "backend_of", lambda _: backend)
    outcome = corpus_run(copied(tmp_path), tmp_path / "out")
    assert (outcome.code, outcome.result["skipped"]) == (3, 1)


def test_models_are_kept_where_asked(analysed: tuple[Path, Path, Outcome]) -> None:
    _, out, _ = analysed
    paths = rows(out, "SELECT path FROM models WHERE kind = 'code'")
    assert len(paths) == 4
    assert all((out / path).is_file() for (path,) in paths)


def test_a_second_run_does_what_is_new_or_changed(tmp_path: Path) -> None:
    spec, out = copied(tmp_path), tmp_path / "out"
    programs = spec.parent / "programs"
    assert corpus_run(spec, out).result["run"] == 4
    before = dict(rows(out, "SELECT id, finished FROM programs"))
    second = corpus_run(spec, out).result
    assert second | {"run": 0, "unchanged": 4, "done": 4} == second
    (programs / "speeds.h").write_text("#define FORWARD 32\n", encoding="utf-8")  # an included header
    (programs / "sub" / "badgetools.h").write_text("void badge_setup(void);\n", encoding="utf-8")  # one that was missing
    (programs / "new.c").write_text("int main(void) { return 0; }\n", encoding="utf-8")
    again = corpus_run(spec, out).result
    assert again | {"programs": 5, "run": 3, "unchanged": 2} == again
    changed = {name for name, time in rows(out, "SELECT id, finished FROM programs") if before.get(name) != time}
    assert changed == {"programs/wheels.c", "programs/sub/badge.c", "programs/new.c"}


def test_other_settings_run_all_again_and_a_program_that_is_gone_is_no_longer_listed(tmp_path: Path) -> None:
    spec, out = copied(tmp_path), tmp_path / "out"
    corpus_run(spec, out)
    (spec.parent / "programs" / "blink.c").unlink()
    spec.write_text(spec.read_text(encoding="utf-8") + '[migrate]\ntarget = "mega"\n', encoding="utf-8")
    outcome = corpus_run(spec, out)
    assert outcome.result | {"programs": 3, "run": 3, "no_longer_listed": 1, "done": 3} == outcome.result
    assert outcome.rules() == {"RS922"}
    assert rows(out, "SELECT state, listed FROM programs WHERE id = 'programs/blink.c'") == [("done", 0)]


def test_a_failure_is_a_result_that_stays_and_is_redone_on_request(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    spec, out = copied(tmp_path), tmp_path / "out"
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path / "home"))
    first = corpus_run(spec, out, "--steps", "analyse,migrate")
    assert (first.code, first.result["failed"], first.result["done"]) == (1, 1, 3)
    assert "RS920" in first.rules()
    assert not (tmp_path / "home" / "runs").exists()
    assert not list(out.rglob(".runs"))
    assert rows(out, "SELECT id, step FROM programs WHERE state = 'failed'") == [("programs/sub/no_main.c", "migrate")]
    assert rows(out, "SELECT count(*) FROM calls WHERE program = 'programs/sub/no_main.c'") == [(1,)]  # of its analysis
    again = corpus_run(spec, out, "--steps", "analyse,migrate")
    assert (again.code, again.result["run"], again.result["failed"]) == (1, 0, 1)
    retried = corpus_run(spec, out, "--steps", "analyse,migrate", "--retry", "failed")
    assert (retried.code, retried.result["run"]) == (1, 1)
    assert corpus_run(spec, out, "--steps", "analyse,migrate", "--fail-on", "never").code == 0
    plan = rows(out, "SELECT target, adapt, call_sites, with_body FROM plans WHERE program = 'programs/blink.c'")
    assert plan == [("uno", 3, 4, 4)]
    (report,) = rows(out, "SELECT report FROM plans WHERE program = 'programs/blink.c'")[0]
    assert (out / report).is_file()
    assert rows(out, "SELECT DISTINCT disposition, has_body FROM calls WHERE program = 'programs/blink.c'") == [("adapt", 1)]


def test_settings_of_an_entry_count_before_the_project_file_and_that_before_the_specification(tmp_path: Path) -> None:
    spec, out = copied(tmp_path), tmp_path / "out"
    (tmp_path / "programs" / "robosmi.toml").write_text('[migrate]\ntarget = "nano"\n', encoding="utf-8")
    spec.write_text(
        '[[programs]]\nglob = "programs/blink.c"\n[[programs]]\nglob = "programs/wheels.c"\nmigrate = {target = "mega"}\n'
        '[[programs]]\nglob = "programs/sub/badge.c"\n[migrate]\ntarget = "leonardo"\n', encoding="utf-8",
    )  # fmt: skip
    assert corpus_run(spec, out, "--steps", "migrate").code == 0
    assert dict(rows(out, "SELECT program, target FROM plans")) == {
        "programs/blink.c": "nano", "programs/wheels.c": "mega", "programs/sub/badge.c": "leonardo",
    }  # fmt: skip


def git(folder: Path, *words: str) -> str:
    identity = ["-c", "user.name=a", "-c", "user.email=a@b", "-c", "init.defaultBranch=main"]
    return subprocess.run(["git", *identity, *words], cwd=folder, check=True, capture_output=True, text=True).stdout.strip()


def test_programs_of_a_clone_and_of_a_bare_repository(tmp_path: Path) -> None:
    copied(tmp_path / "work")
    git(tmp_path / "work", "init", "-q")
    git(tmp_path / "work", "add", ".")
    git(tmp_path / "work", "commit", "-q", "-m", "first")
    commit = git(tmp_path / "work", "rev-parse", "HEAD")
    (tmp_path / "work" / "programs" / "blink.c").unlink()
    git(tmp_path / "work", "commit", "-q", "-a", "-m", "second")
    git(tmp_path, "clone", "-q", "--bare", "work", "bare.git")
    spec, out = tmp_path / "spec.toml", tmp_path / "out"
    spec.write_text(
        f'[[programs]]\ngit = "work"\nrevision = "{commit[:8]}"\nglob = "programs/*.c"\n[[programs]]\ngit = "bare.git"\n',
        encoding="utf-8",
    )
    outcome = corpus_run(spec, out, "--models")
    assert outcome.code == 0
    found = {row[0]: row[1:] for row in rows(out, "SELECT id, repository, revision FROM programs")}
    assert set(found) == {  # without a pattern, each source file with main
        "work/programs/blink.c", "work/programs/wheels.c", "bare.git/programs/wheels.c", "bare.git/programs/sub/badge.c",
    }  # fmt: skip
    assert found["work/programs/blink.c"] == (str(tmp_path / "work"), commit)
    assert corpus_run(spec, out, "--models").result["run"] == 0
    (tmp_path / "work" / "programs" / "speeds.h").write_text("#define FORWARD 32\n", encoding="utf-8")
    git(tmp_path / "work", "commit", "-q", "-a", "-m", "third")
    git(tmp_path / "work", "push", "-q", "../bare.git", "HEAD")
    new = git(tmp_path / "work", "rev-parse", "HEAD")
    later = corpus_run(spec, out, "--models").result
    assert later | {"run": 1, "unchanged": 3, "done": 4} == later  # wheels.c of the branch includes speeds.h
    assert set(rows(out, "SELECT revision FROM programs WHERE id LIKE 'bare%'")) == {(new,)}
    assert {path.name.split("-")[-1] for path in (out / "sources").iterdir()} == {commit[:12], new[:12]}
    for table in ("programs", "calls", "files"):
        below = f"SELECT path FROM {table} WHERE path LIKE '%/sources/%'" + " AND digest <> ''" * (table == "files")
        assert all(Path(path).exists() for (path,) in rows(out, below)), table
    for (model,) in rows(out, "SELECT path FROM models"):
        text = (out / model).read_text(encoding="utf-8")
        assert (named := re.findall(r'="([^"]*/sources/[^"]*)"', text))
        assert all(map(os.path.exists, named))
    assert corpus_run(spec, out, "--models").result["run"] == 0
    os.rename(tmp_path / "bare.git", tmp_path / "elsewhere")
    gone = corpus_run(spec, out, "--models")
    assert gone.code == 0
    assert gone.result | {"skipped": 1, "run": 0, "done": 2, "no_longer_listed": 2} == gone.result
    assert "RS921" in gone.rules()
    assert rows(out, "SELECT count(*) FROM programs WHERE state = 'done'") == [(4,)]


def test_a_list_has_ids_paths_and_labels(tmp_path: Path) -> None:
    copied(tmp_path)
    (tmp_path / "list.csv").write_text(
        "id,path,site\nhall,programs/blink.c,Berlin\n,programs/wheels.c,Oslo\ngone,programs/gone.c,Rome\n", encoding="utf-8"
    )
    spec, out = tmp_path / "spec.toml", tmp_path / "out"
    spec.write_text('[[programs]]\nlist = "list.csv"\nlabels = {fleet = "a"}\n', encoding="utf-8")
    outcome = corpus_run(spec, out)
    assert outcome.result | {"programs": 3, "done": 2, "skipped": 1} == outcome.result
    assert "RS921" in outcome.rules()
    found = {row[0]: (json.loads(row[1]), row[2]) for row in rows(out, "SELECT id, labels, state FROM programs")}
    assert found["hall"] == ({"fleet": "a", "site": "Berlin"}, "done")
    assert found["programs/wheels.c"] == ({"fleet": "a", "site": "Oslo"}, "done")
    assert found["gone"][1] == "skipped"
    (tmp_path / "programs" / "blink.c").unlink()  # it was run: what is known of it stays
    again = corpus_run(spec, out)
    assert again.result | {"done": 1, "skipped": 2, "run": 0} == again.result
    assert rows(out, "SELECT state FROM programs WHERE id = 'hall'") == [("skipped",)]
    assert rows(out, "SELECT count(*) > 0 FROM calls WHERE program = 'hall'") == [(1,)]


def test_a_folder_without_a_pattern_and_a_folder_as_a_program(tmp_path: Path) -> None:
    copied(tmp_path)
    spec, out = tmp_path / "spec.toml", tmp_path / "out"
    robot = tmp_path / "robots" / "one"
    robot.mkdir(parents=True)
    (robot / "main.c").write_text('#include "simpletools.h"\nvoid turn(void);\nint main() { turn(); }\n', encoding="utf-8")
    (robot / "turn.c").write_text('#include "simpletools.h"\nvoid turn(void) { high(3); }\n', encoding="utf-8")
    spec.write_text('[[programs]]\nfolder = "programs"\n[[programs]]\nfolder = "robots"\nglob = "*"\n', encoding="utf-8")
    outcome = corpus_run(spec, out, "--steps", "analyse,migrate")
    assert outcome.code == 0
    ids = {row[0] for row in rows(out, "SELECT id FROM programs")}
    assert ids == {"programs/blink.c", "programs/wheels.c", "programs/sub/badge.c", "robots/one"}
    assert rows(out, "SELECT function, pin FROM pins WHERE program = 'robots/one'") == [("high", 3)]
    (robot / "turn.c").write_text('#include "simpletools.h"\nvoid turn(void) { high(4); }\n', encoding="utf-8")
    assert corpus_run(spec, out, "--steps", "analyse,migrate").result["run"] == 1


def test_a_program_outside_has_its_whole_path_as_id_and_the_output_folder_is_none(tmp_path: Path) -> None:
    copied(tmp_path / "a")
    (tmp_path / "b").mkdir()
    spec = tmp_path / "b" / "spec.toml"
    spec.write_text(f'[[programs]]\nglob = "{tmp_path}/**/blink*.c"\n', encoding="utf-8")
    out = tmp_path / "b" / "out"
    assert corpus_run(spec, out, "--steps", "migrate").result["programs"] == 1
    assert corpus_run(spec, out, "--steps", "migrate").result["programs"] == 1  # not the copy in out
    assert rows(out, "SELECT id FROM programs") == [(str(tmp_path / "a" / "programs" / "blink.c"),)]


def blinker(folder: Path) -> Path:
    """A corpus of one program that blinks on a wired pin; its specification."""
    copied(folder)
    (folder / "one").mkdir()
    (folder / "programs" / "blink.c").rename(folder / "one" / "blink.c")
    (folder / "one" / "robosmi.toml").write_text('[bind]\nP26 = "D13"\n', encoding="utf-8")
    spec = folder / "one.toml"
    spec.write_text('[[programs]]\nglob = "one/*.c"\n', encoding="utf-8")
    return spec


def test_compile_and_verify_have_rows(tmp_path: Path) -> None:
    require_verification("simavr")
    outcome = corpus_run(blinker(tmp_path), tmp_path / "out", "--steps", "migrate,compile,verify")
    assert outcome.code == 0
    (compiled,) = rows(tmp_path / "out", "SELECT target, ok, fits, flash, ram, messages FROM compiles")
    assert compiled[:3] == ("uno", 1, 1)
    assert 100 < compiled[3] < 32_256
    assert 0 < compiled[4] < 2_048
    assert compiled[5] == rows(tmp_path / "out", "SELECT count(*) FROM findings WHERE step = 'compile'")[0][0]
    verdict = "SELECT verdict, partial, outputs, outputs_of, lines_pct, first_difference FROM verdicts"
    assert rows(tmp_path / "out", verdict) == [("no-difference-found", 0, 1, 1, 100.0, None)]
    assert rows(tmp_path / "out", "SELECT name, state FROM steps") == [
        ("migrate", "done"), ("compile", "done"), ("verify", "done"),
    ]  # fmt: skip


def test_a_program_without_a_compiler_is_run_when_it_is_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    spec, out = blinker(tmp_path), tmp_path / "out"
    with monkeypatch.context() as patched:
        patched.setenv("PATH", str(tmp_path))
        lacking = corpus_run(spec, out, "--steps", "migrate,compile")
    assert lacking.result | {"skipped": 1, "done": 0, "failed": 0} == lacking.result
    assert lacking.rules() == {"RS921"}
    assert rows(out, "SELECT count(*) FROM compiles") == [(0,)]
    assert rows(out, "SELECT target FROM plans") == [("uno",)]
    again = corpus_run(spec, out, "--steps", "migrate,compile")
    assert again.result | {"run": 1, "done": 1} == again.result
    assert rows(out, "SELECT ok FROM compiles") == [(1,)]
