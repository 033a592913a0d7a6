"""The paper's own mode: placeholders to write by hand, libraries by TF-IDF, includes of the selected ones (paper 3.3, 3.4)."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

import robosmi
from robosmi.errors import SourceError, UsageError


def sketch(program: Path, output: Path) -> tuple[str, str]:
    """The sketch and its project file, with placeholders alone."""
    made = robosmi.migrate([program], output, adapters="placeholders")
    name = made.models.plan.name
    return made.contents[f"{name}/{name}.ino"].decode(), made.contents[f"{name}/sketch.yaml"].decode()


def test_selected_libraries_are_included_and_in_the_project_file(case_study: Path, tmp_path: Path) -> None:
    program = case_study
    plan = robosmi.plan_migration([program]).plan
    wanted = {str(c.chosen.name): str(next(iter(c.chosen.headers))) for c in plan.libraryChoices if c.chosen is not None}
    assert wanted
    text, project = sketch(program, tmp_path / "out")
    assert [header for header in wanted.values() if f"#include <{header}>" not in text] == []
    assert [name for name in wanted if f"- {name}" not in project] == []


def test_a_body_that_a_person_writes_finds_its_library_included(case_study: Path, tmp_path: Path) -> None:
    program, out = case_study, tmp_path / "out"
    text, _ = sketch(program, out)
    adapters = next(out.glob("*/adapters.h"))
    edited = adapters.read_text().replace("void high(int32_t pin) {", "void high(int32_t pin) {\n  digitalWrite(pin, HIGH);")
    adapters.write_text(edited)
    again, project = sketch(program, out)
    assert again == text
    assert "- Servo" in project
    assert adapters.read_text() == edited


def test_the_ranker_is_that_of_the_flag_the_project_file_and_the_defaults(examples: Path, tmp_path: Path) -> None:
    folder = tmp_path / "robot"
    shutil.copytree(examples / "line_follower", folder)
    settings, program = folder / "robosmi.toml", folder / "line_follower.c"

    def candidates(**options: str) -> list[list[str]]:
        choices = robosmi.plan_migration([program], **options).plan.libraryChoices  # type: ignore[arg-type]
        return [[str(library.name) for library in choice.candidates] for choice in choices]

    by_default, by_words = candidates(), candidates(ranker="tfidf")
    assert by_default != by_words
    settings.write_text(settings.read_text() + '\n[rank]\nranker = "tfidf"\n')
    assert candidates() == by_words
    assert candidates(ranker="devices") == by_default


def test_an_unknown_ranker_and_an_unknown_key_are_named(examples: Path, tmp_path: Path) -> None:
    program = examples / "line_follower" / "line_follower.c"
    with pytest.raises(UsageError, match="no ranker is called 'tfdif'"):
        robosmi.plan_migration([program], ranker="tfdif")
    copied = tmp_path / "line_follower.c"
    copied.write_bytes(program.read_bytes())
    (tmp_path / "robosmi.toml").write_text('[rank]\nrankr = "tfidf"\n')
    with pytest.raises(SourceError, match="rankr"):
        robosmi.plan_migration([copied])
