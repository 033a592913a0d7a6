"""The evaluation is complete, its page is what it gives now, and it fails for nothing but a row outside its tolerance."""

from __future__ import annotations

import json
import re
import time
from dataclasses import replace
from pathlib import Path

import pytest

from robosmi.errors import MissingToolError, SourceError
from tests.evaluation import page, table
from tests.evaluation.__main__ import MODULES, main
from tests.evaluation.scoring.programs import Score, answered, expected, labelled_programs
from tests.evaluation.scoring.queries import labelled_queries
from tests.evaluation.scoring.sketches import SketchScore, labelled_sketches
from tests.evaluation.table import DIFFERS, EXCEEDED, NEVER, NOT_RUN, OUTSIDE, REPRODUCED, Got, Missing, Outcome, Row, Setting

ROOT = Path(__file__).parents[2]
SECTIONS = {"1", "2", "3", "3.1", "3.2", "3.3", "3.4", "4", "5", "5.1", "5.2", "5.3", "5.4", "6", "7"}
"""Sections of the paper."""
CITED = re.compile(r"\bpaper,? (?:sections? )?(\d(?:\.\d+)*)|\bsection (\d(?:\.\d+)*) of the paper")
SECONDS = 60
KEYS = {"row", "claim", "place", "expected", "got", "verdict", "how"}


@pytest.fixture(scope="module")
def quick(tmp_path_factory: pytest.TempPathFactory) -> tuple[list[Outcome], float]:
    """The outcomes of the quick rows, and the processor time that they took."""
    start = time.process_time()
    done = list(table.outcomes(table.rows(), Setting(tmp_path_factory.mktemp("rows")), quick=True))
    return done, time.process_time() - start


def test_the_page_is_what_the_quick_rows_give(quick: tuple[list[Outcome], float]) -> None:
    done = [outcome for outcome in quick[0] if outcome.row.quick]
    assert page.PAGE.read_text(encoding="utf-8") == page.page(done, page.load()), "run: python -m tests.evaluation --quick"


def test_quick_rows_are_within_their_tolerance_and_quick(quick: tuple[list[Outcome], float]) -> None:
    done, seconds = quick
    assert [outcome.row.name for outcome in done if outcome.verdict == OUTSIDE] == []
    assert [o.row.name for o in done if o.row.quick and o.verdict.startswith(NOT_RUN)] == []
    assert seconds < SECONDS


def test_every_cited_section_of_the_paper_exists() -> None:
    places = [each for folder in ("robosmi", "transformations") for each in (ROOT / folder).rglob("*.py")]
    places += [*(ROOT / "docs").rglob("*.md"), *(ROOT / "metamodels").glob("*.ecore")]
    cited = {(path.name, one or other) for path in places for one, other in CITED.findall(path.read_text(encoding="utf-8"))}
    assert len(cited) > 20
    assert sorted(each for each in cited if each[1] not in SECTIONS) == []
    assert {section for row in table.rows() for section in re.findall(r"\d\.\d|^\d", row.place)} <= SECTIONS


def test_every_row_is_given_and_says_how_to_get_what_is_missing(quick: tuple[list[Outcome], float]) -> None:
    done, _ = quick
    assert [outcome.row for outcome in done] == table.rows()
    assert {outcome.row.name[0] for outcome in done} == set("ABCDEFGHI")
    assert len(done) >= 40
    assert all("run: " in outcome.verdict for outcome in done if not outcome.row.quick)
    assert all(outcome.to_json().keys() >= KEYS for outcome in done)


def test_thirty_rows_are_reproduced_or_exceeded_and_every_other_has_its_reason(quick: tuple[list[Outcome], float]) -> None:
    kept = page.load()
    verdicts = {o.row.name: o.told if o.row.quick else kept.get(o.row.name, {"verdict": NOT_RUN})["verdict"] for o in quick[0]}
    assert sum(verdict in (REPRODUCED, EXCEEDED) for verdict in verdicts.values()) >= 30
    assert [name for name, verdict in verdicts.items() if verdict.startswith((DIFFERS, NEVER)) and "(" not in verdict] == []


def test_kept_values_belong_to_rows_and_have_day_and_commit() -> None:
    for name, value in page.load().items():
        assert not table.ROWS[name].quick
        assert value.keys() == {"got", "verdict", "date", "commit"}
        assert all(value.values())


def made(measure: table.Measure, verdict: str = REPRODUCED) -> Row:
    return replace(table.ROWS["A1"], measure=measure, verdict=verdict)


def outcome(measure: table.Measure) -> Outcome:
    return next(table.outcomes([made(measure)], Setting(Path()), quick=True))


def raising(error: Exception) -> table.Measure:
    def measure(_: Setting) -> Got:
        raise error

    return measure


def test_a_verdict_follows_from_what_was_measured() -> None:
    assert outcome(lambda _: Got("8")).verdict == REPRODUCED
    assert outcome(lambda _: Got("7", within=False)).verdict == OUTSIDE
    assert outcome(raising(SourceError("cannot be read"))).verdict == OUTSIDE
    missing = outcome(raising(Missing("the corpus is not here", "run: make corpus"))).verdict
    assert missing == f"{NOT_RUN} (the corpus is not here; run: make corpus)"
    missing = outcome(raising(MissingToolError("avr-gcc is missing", fix="install gcc-avr"))).verdict
    assert missing == f"{NOT_RUN} (avr-gcc is missing; install gcc-avr)"


def test_without_java_and_git_a_row_is_not_run_and_the_commit_unknown(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(page, "MEASURED", tmp_path / "measured.json")
    assert main(["--only", "B1e"]) == 0
    assert "not installed: sh, java, javac" in capsys.readouterr().out
    page.keep([Outcome(table.ROWS["A5"], "all", REPRODUCED)])
    assert json.loads((tmp_path / "measured.json").read_text())["A5"]["commit"] == "unknown"


def test_exit_1_for_a_row_outside_its_tolerance_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(page, "PAGE", tmp_path / "page.md")
    target = tmp_path / "rows.json"
    assert main(["--quick", "--only", "A1", "--only", "A5", "--json", str(target)]) == 0
    assert [row["verdict"].partition(" (")[0] for row in json.loads(target.read_text())] == [REPRODUCED, NOT_RUN]
    monkeypatch.setitem(table.ROWS, "A1", made(lambda _: Got("none", within=False)))
    assert main(["--quick", "--only", "A1"]) == 1
    assert "OUTSIDE ITS TOLERANCE" in capsys.readouterr().out
    assert not (tmp_path / "page.md").exists(), "a part of the rows is no page"


def test_a_folder_that_is_something_else_is_a_row_not_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ROBOSMI_CORPUS", raising=False)
    monkeypatch.setattr("tests.evaluation.sources.ROOT", tmp_path)
    monkeypatch.setattr(page, "MEASURED", tmp_path / "measured.json")
    (tmp_path / "other").mkdir()
    target = tmp_path / "rows.json"
    assert main(["--corpus", str(tmp_path / "other"), "--only", "A5", "--json", str(target)]) == 0
    verdict = json.loads(target.read_text())[0]["verdict"]
    assert verdict.startswith(NOT_RUN)
    assert str(tmp_path / "other") in verdict
    assert "make corpus" in verdict


@pytest.mark.parametrize(
    ("words", "said"),
    [(["--corpus", "nowhere"], "nowhere"), (["--only", "A99"], "A99"), (["--json", "/no/x"], "/no/x"), (["--json", "/"], "'/'")],
)
def test_wrong_usage_is_named(words: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["--quick", *words, *([] if "--only" in words else ["--only", "B5"])])
    assert ended.value.code == 2
    assert said in capsys.readouterr().err


def test_all_labels_are_there() -> None:
    assert [len(labels()) for labels in (labelled_programs, labelled_sketches, labelled_queries)] == [156, 44, 153]
    assert len(MODULES) == 5


def test_the_scorer_of_programs_counts_what_is_extra_missing_and_not_judged() -> None:
    label = next(
        each
        for each in labelled_programs()
        if len(each["platform_calls"]) > 3 and not each["declared_elsewhere"] + each["in_macros"]
    )
    calls = [
        {"name": n, "count": c, "lines": lines, "header": h, "in_macro": False} for n, c, lines, h in label["platform_calls"]
    ]
    unit = {"path": label["path"], "platform_calls": calls, "globals": [{"name": n} for n in label["globals"]]}
    assert answered(label, unit)["platform_calls.lines"] == expected(label)["platform_calls.lines"]
    unit["globals"] = [*unit["globals"], {"name": "invented"}]
    unit["platform_calls"] = calls[1:]
    score = Score()
    score.add(label, [unit])
    assert (score.fields["globals"].extra, score.fields["globals"].missed) == (1, 0)
    assert (score.fields["platform_calls"].extra, score.fields["platform_calls"].missed) == (0, 1)
    assert "functions" in score.wrong[label["id"]], "a field that is not answered is wrong"


def test_the_scorer_of_sketches_counts_what_is_extra_missing_and_optional() -> None:
    mapping = {"board": "1", "pin": "D2", "component": "3", "connectors": ["c1"], "role": "Input", "driver": False}
    label = {"name": "x", "optional": [["1", "D9", "4"]], "mappings": [{**mapping, "signal": "read"}]}
    right = {
        "board_model_index": "1", "pin": "D2", "component_model_index": "3", "connectors": [{"id": "c1"}], "role": "Input",
        "driver": False, "signal": "read", "name": "EyeReadP1",
    }  # fmt: skip
    score = SketchScore()
    score.add(label, [right, {**right, "pin": "D9", "component_model_index": "4", "name": "OtherReadP1"}])
    assert (score.precision, score.recall, score.wrong) == (1.0, 1.0, {})
    score.add({**label, "name": "y"}, [{**right, "role": "Passive"}, {**right, "pin": "D5", "name": "EyeReadP2"}])
    assert (score.right, score.extra, score.missed) == (2, 1, 0)
    assert len(score.wrong["y"]) == 2
