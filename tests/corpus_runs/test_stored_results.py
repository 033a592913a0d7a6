"""What becomes of stored results when labels change, and when a program cannot be run for a reason outside of it."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path
from typing import Any

import msgspec
import pytest

from robosmi.corpus import memory
from robosmi.corpus.compare import compare
from robosmi.corpus.digests import digest_of
from robosmi.corpus.jobs import Limits, ProgramJob, ProgramResult, ProgramStep, ProgramWork
from robosmi.corpus.states import DONE, FAILED, SKIPPED, TIMEOUT
from robosmi.corpus.store import Store
from robosmi.corpus.worker import run_program
from robosmi.transformations.chains import corpus
from tests.corpus_runs.running_corpora import copied, rows, run_here

STATE = "SELECT state, step, message FROM programs"


@pytest.fixture
def spec(tmp_path: Path) -> Path:
    """A specification with a list of one program."""
    made = copied(tmp_path)
    made.write_text('[[programs]]\nlist = "list.csv"\n', encoding="utf-8")
    (tmp_path / "list.csv").write_text("path,site\nprograms/blink.c,Oslo\n", encoding="utf-8")
    return made


def ended(job: ProgramJob, state: str = DONE, message: str | None = None) -> ProgramResult:
    """The result of a program whose last step ends so, and those before well; it has a folder."""
    steps = [ProgramStep(name, rows={"pins": [{"expression": message}]}) for name in job.steps]
    steps[-1].state, steps[-1].message = state, message
    Path(job.work.output).mkdir(parents=True, exist_ok=True)
    return ProgramResult(job.work.id, state, steps, {job.work.path: digest_of(job.work.path)}, message)


def test_changed_labels_are_stored_and_nothing_is_run(spec: Path) -> None:
    out = spec.parent / "out"
    run_here(spec, out, ended)
    (spec.parent / "list.csv").write_text("path,site\nprograms/blink.c,Rome\n", encoding="utf-8")
    spec.write_text('[[programs]]\nlist = "list.csv"\nlabels = {fleet = "a"}\n', encoding="utf-8")
    summary = run_here(spec, out, ended)
    assert (summary.run, summary.unchanged) == (0, 1)
    assert json.loads(rows(out, "SELECT labels FROM programs")[0][0]) == {"fleet": "a", "site": "Rome"}


def test_a_program_that_is_gone_is_skipped_and_its_rows_stay(spec: Path, tmp_path: Path) -> None:
    out, before = tmp_path / "out", tmp_path / "before"
    for folder in (out, before):
        run_here(spec, folder, ended)
    program = tmp_path / "programs" / "blink.c"
    text = program.read_bytes()
    program.unlink()
    summary = run_here(spec, out, ended)
    assert (summary.done, summary.skipped, summary.run) == (0, 1, 0)
    assert rows(out, STATE) == [(SKIPPED, None, "there is no such file")]
    assert len(rows(out, "SELECT * FROM pins")) == 1
    with Store(before / "corpus.sqlite") as old, Store(out / "corpus.sqlite") as new:
        assert [(each.before, each.after) for each in compare(old, new).worse] == [(DONE, SKIPPED)]
    program.write_bytes(text)
    assert run_here(spec, out, ended).run == 1
    assert rows(out, STATE) == [(DONE, None, None)]


def test_a_tool_that_is_gone_replaces_no_result_that_got_further(spec: Path, tmp_path: Path) -> None:
    out, steps = tmp_path / "out", ("migrate", "compile")
    run_here(spec, out, partial(ended, state=SKIPPED, message="no compiler yet"), steps)
    assert rows(out, "SELECT expression FROM pins") == [("no compiler yet",)]
    run_here(spec, out, partial(ended, message="good"), steps)
    run_here(spec, out, partial(ended, message="good"), (*steps, "verify"))
    (tmp_path / "programs" / "blink.c").write_text("int main(void) { }\n", encoding="utf-8")
    run_here(spec, out, partial(ended, state=SKIPPED, message="no compiler"), steps)
    assert rows(out, STATE) == [(SKIPPED, "compile", "no compiler")]
    assert rows(out, "SELECT expression FROM pins") == [("good",)]
    run_here(spec, out, partial(ended, state=FAILED, message="bad"), steps)
    assert rows(out, "SELECT expression FROM pins") == [("bad",)]


def worked(job: ProgramJob) -> ProgramResult:
    """The result of a program whose steps a worker runs, in this process."""
    messages: list[dict[str, Any]] = []
    run_program(job, messages.append)
    steps = [msgspec.convert(each["step"], ProgramStep) for each in messages if "step" in each]
    return ProgramResult(job.work.id, steps[-1].state, steps, messages[0]["files"], steps[-1].message)


@pytest.fixture
def own_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    """The process of the tests gets no limit."""
    monkeypatch.setattr(memory, "limit_own", lambda _: None)


@pytest.mark.usefixtures("own_memory")
def test_a_missing_drawing_and_a_place_that_cannot_be_written_are_no_faults_of_the_program(spec: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    run_here(spec, out, ended, ("migrate",))
    (folder,) = (out / "programs").iterdir()
    (folder / "kept").write_text("of the first run", encoding="utf-8")
    spec.write_text(spec.read_text(encoding="utf-8") + '[migrate]\nhardware = "gone.dig"\n', encoding="utf-8")
    run_here(spec, out, worked, ("migrate",))
    ((state, step, message),) = rows(out, STATE)
    assert (state, step) == (SKIPPED, "migrate")
    assert "gone.dig: there is no such drawing" in message
    assert [path.name for path in folder.rglob("*")] == ["kept"]  # it belongs to the rows, which stay
    assert len(rows(out, "SELECT * FROM pins")) == 1
    assert list((out / "programs").iterdir()) == [folder]
    work = ProgramWork("a", str(tmp_path / "programs" / "blink.c"), output=str(spec / "programs" / "a"))
    denied = worked(ProgramJob(work, ("migrate",), Limits()))
    assert (denied.state, denied.steps[0].name) == (SKIPPED, "migrate")
    assert "cannot write here" in str(denied.message)


def test_a_result_that_a_killed_run_left_behind_is_removed(spec: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    run_here(spec, out, ended, ("migrate",))
    (folder,) = (out / "programs").iterdir()
    folder.rename(f"{folder}.before")  # it was killed here
    run_here(spec, out, partial(ended, message="new"), ("analyse", "migrate"))
    assert list((out / "programs").iterdir()) == [folder]


def test_a_failure_of_another_kind_is_neither_better_nor_worse(spec: Path, tmp_path: Path) -> None:
    stores = []
    for state in (FAILED, TIMEOUT):
        run_here(spec, tmp_path / state, partial(ended, state=state))
        stores.append(Store(tmp_path / state / "corpus.sqlite"))
    found = compare(*stores)
    assert (found.better, found.worse, found.new_failures, found.same) == ([], [], [], 1)
    for store in stores:
        store.close()


@pytest.mark.usefixtures("own_memory")
def test_all_settings_of_a_migration_reach_it(spec: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    given: dict[str, Any] = {}
    monkeypatch.setattr(corpus, "migrate", lambda *_, **said: given.update(said))
    spec.write_text(
        spec.read_text(encoding="utf-8") + '[migrate]\ntarget = "nano"\nsource_platform = "arduino"\nfrom = "uno"\n'
        'console_wait_ms = "7"\nhardware = "list.csv"\n', encoding="utf-8",
    )  # fmt: skip
    run_here(spec, tmp_path / "out", worked, ("migrate",))
    found = {key: given[key] for key in ("target", "source_platform", "source_board")}
    assert found == {"target": "nano", "source_platform": "arduino", "source_board": "uno"}
    assert (given["hardware"], given["project"].console_wait_ms) == (str(tmp_path / "list.csv"), 7)
