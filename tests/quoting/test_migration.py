"""Any title, any connector, any file name: the same tokens of code but for comments and names, a report without links or tags."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml
from hypothesis import HealthCheck, given, strategies as st

from robosmi.transformations.chains.migrate import migrate
from tests.quoting import judges
from tests.quoting.migration import EXAMPLE, declared_names, plan_with_titles, shape_of, texts_of, with_texts
from tests.running import run
from tests.tiers import examples

INERT = {"link_open", "image"}
FOLDS = [
    "<details><summary>Each element</summary>", "</details>", "<details><summary>Each function</summary>", "</details>",
]  # fmt: skip
"""The only HTML of a report: its two long tables are folded."""
FEW = examples(80, suppress_health_check=[HealthCheck.function_scoped_fixture])


@pytest.fixture(scope="module")
def shape(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[str]]:
    """The tokens of the sketch with the drawing's own titles."""
    return shape_of(texts_of(plan_with_titles(tmp_path_factory.mktemp("plain"), ())))


def checked(texts: dict[str, str], shape: dict[str, list[str]]) -> None:
    assert shape_of(texts) == shape
    names = declared_names(texts["line_follower.ino"])
    assert len(set(names)) == len(names) == 5
    for name in names:
        assert judges.problems(f"extern int {name};\n", "x.cpp", "-std=c++11") == []
    assert not INERT & set(judges.markdown_kinds(texts["MIGRATION.md"]))
    assert judges.markdown_html(texts["MIGRATION.md"]) == FOLDS
    assert set(yaml.safe_load(texts["sketch.yaml"])) == {"profiles", "default_profile"}
    assert not judges.acts_on_terminal("".join(texts.values()))


def test_a_line_break_in_a_title_makes_no_code(tmp_path: Path, shape: dict[str, list[str]]) -> None:
    texts = texts_of(
        plan_with_titles(tmp_path, ["LED\nint evil=42; //", "<script>alert(1)</script>", "[x](javascript:alert(1))"])
    )
    checked(texts, shape)
    assert "// LED int evil=42; //: pulse on D9" in texts["line_follower.ino"]
    assert "&lt;script>alert(1)&lt;/script>" in texts["MIGRATION.md"]


@FEW
@given(titles=st.lists(judges.texts(), max_size=7))
def test_any_titles_of_a_drawing(tmp_path: Path, shape: dict[str, list[str]], titles: list[str]) -> None:
    checked(texts_of(plan_with_titles(tmp_path, titles)), shape)


@FEW
@given(data=st.data())
def test_any_texts_of_a_stored_model(tmp_path: Path, shape: dict[str, list[str]], data: st.DataObject) -> None:
    models = plan_with_titles(tmp_path, ())
    said = iter(data.draw(st.lists(judges.texts(), min_size=5, max_size=30)) * 1000)
    with_texts(models, lambda: next(said))
    checked(texts_of(models), shape)


def test_what_the_terminal_is_told_of_a_hostile_drawing(tmp_path: Path) -> None:
    plan_with_titles(tmp_path, ["\x9b2J\x9b31mred", "a\nrobosmi: error: forged", "\u202egnp"])
    for words in (
        ("hardware", tmp_path / "drawing.fz"),
        ("check", tmp_path / "drawing.fz"),
        ("migrate", tmp_path / "line_follower.c", "--hardware", tmp_path / "drawing.fz", "-o", tmp_path / "out"),
        ("hardware", tmp_path / "drawing.fz", "--json"),
    ):
        done = run(*words)
        assert not judges.acts_on_terminal(done.out + done.err)
        assert "\nrobosmi: error: forged" not in done.out + done.err


def test_file_names_that_are_code(tmp_path: Path) -> None:
    program = tmp_path / "a\nint evil;\u2028 \\.c"
    program.write_bytes((EXAMPLE / "line_follower.c").read_bytes())
    migrate([program], tmp_path / "out", hardware=EXAMPLE / "line_following_robot.fzz")
    sketches = list((tmp_path / "out").rglob("*.ino"))
    assert sketches
    for sketch in sketches:
        assert "evil" not in judges.tokens(sketch.read_text(encoding="utf-8"), "x.cpp")


def test_a_name_from_a_title_is_none_of_the_program(tmp_path: Path) -> None:
    plan_with_titles(tmp_path, ())
    program = tmp_path / "line_follower.c"
    own = "int BasicServo1WriteP1; int f(int HIH40301ReadP1) { return HIH40301ReadP1; }\n#define BasicServo1WriteP1_2 1\n"
    program.write_text(own + program.read_text(encoding="utf-8"), encoding="utf-8")
    made = migrate([program], tmp_path / "out", hardware=tmp_path / "drawing.fz")
    sketch = (tmp_path / "out" / "line_follower" / "line_follower.ino").read_text(encoding="utf-8")
    assert {"BasicServo1WriteP1_3", "HIH40301ReadP1_2", "BasicServo2WriteP1"} <= set(declared_names(sketch))
    assert [finding.rule for finding in made.findings].count("RS227") == 2
