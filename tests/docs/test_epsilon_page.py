"""docs/reference/epsilon.md: its Epsilon texts are scripts that the real engine ran, its Python gives what the engine gave.

A section is a case of tests/epsilon: the blocks in Epsilon's languages are the case's files, the others are run on its models and
judged as strictly as the ports are.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.epsilon.egl_running import run_steps
from tests.epsilon.running import CASES, judge, names, run

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "epsilon.md"
LANGUAGES = ("evl", "etl", "flock", "egl", "egx")


def blocks(text: str) -> list[tuple[str, str, str]]:
    """The blocks of code: language, file name (or ""), text."""
    return re.findall(r"^```(\w+) ?(\S*)\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)


def sections() -> dict[str, tuple[str, str]]:
    """Case -> the Python that is given in its chapter, and the section's text."""
    found = {}
    for chapter in re.split(r"^## ", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]:
        start, *parts = re.split(r"^### ", chapter, flags=re.MULTILINE)
        given = "".join(code for language, _, code in blocks(start) if language == "python")
        for part in parts:
            title = re.match(r".* \(case `(\w+/\w+)`\)\n", part)
            assert title is not None, part
            assert title[1] not in found
            found[title[1]] = (given, part)
    return found


SECTIONS = sections()


def test_the_page_has_sections_for_all_languages() -> None:
    assert {language for _, text in SECTIONS.values() for language, _, _ in blocks(text)} == {*LANGUAGES, "python", "jinja"}
    assert len(SECTIONS) > 25


@pytest.mark.parametrize("case", SECTIONS)
def test_the_epsilon_text_is_what_the_engine_ran(case: str) -> None:
    folder = CASES / case
    shown = {name or f"script.{language}": code for language, name, code in blocks(SECTIONS[case][1]) if language in LANGUAGES}
    files = {p.name: p.read_text(encoding="utf-8") for p in folder.iterdir() if p.suffix[1:] in LANGUAGES}
    assert {name: code.rstrip("\n") for name, code in shown.items()} == {name: code.rstrip() for name, code in files.items()}


def port_of(case: str) -> Callable[..., Any]:
    """The Python of a section as a function, called with the case's models as `run` and `run_steps` do."""
    given, text = SECTIONS[case]
    parts = blocks(text)
    code = given + "".join(code for language, _, code in parts if language == "python")
    kind = case.partition("/")[0]
    cut = {
        name for name in (p.name for p in (CASES / case).glob("*.egl")) if not (CASES / case / name).read_text().endswith("\n")
    }
    templates = {name or "script.egl": code for language, name, code in parts if language == "jinja"}
    templates = {name: code.removesuffix("\n") if name in cut else code for name, code in templates.items()}

    def port(*arguments: Any) -> Any:
        scope: dict[str, Any] = {"templates": templates}
        if kind == "egl":
            folder, *models, scope["script"], scope["target"] = arguments
            scope["folder"] = folder
        else:
            models = list(arguments)
        scope |= {model.name: model for model in models}
        exec(compile(code, f"epsilon.md {case}", "exec", dont_inherit=True), scope)
        return scope[{"evl": "v", "etl": "t", "flock": "f", "egl": "g"}[kind]]

    return port


@pytest.mark.parametrize("case", SECTIONS)
def test_the_python_gives_what_the_engine_gave(case: str, tmp_path: Path) -> None:
    kind, _, name = case.partition("/")
    if kind == "egl":
        run_steps(name, tmp_path, port_of(case))
    else:
        run(kind, name, tmp_path, port_of(case))
    verdict = judge(kind, name, tmp_path, "--strict")
    assert verdict.equal, f"{verdict.line}\n{verdict.differences}"


def test_cases_links_and_names_on_the_page_exist() -> None:
    text = PAGE.read_text(encoding="utf-8")
    known = {f"{kind}/{name}" for kind in ("evl", "etl", "flock", "egl") for name in names(kind)}
    assert set(re.findall(r"case `(\w+/\w+)`", text)) <= known
    for link in re.findall(r"\]\(([^)#]+)[^)]*\)", text):
        assert (PAGE.parent / link).is_file(), link
    titles = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    anchors = {re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in titles}
    assert set(re.findall(r"\]\(#([^)]*)\)", text)) <= anchors
