"""Every function of `robosmi.quoting`: any text stays text at its place, judged by readers that are not ours."""

from __future__ import annotations

import csv
import doctest
import io
import json
import tomllib
from collections.abc import Callable
from types import ModuleType

import pytest
import yaml
from hypothesis import example, given, strategies as st
from lxml import etree

from robosmi import quoting
from robosmi.base.data_text import Json
from robosmi.quoting import code, data, markup, markup as markdown_text, text
from tests.quoting import judges
from tests.quoting.judges import (
    ATTACKS,
    Page,
    acts_on_terminal,
    markdown_kinds,
    problems,
    texts,
    tokens,
)
from tests.tiers import examples

LANGUAGES = (("x.c", "-std=c99"), ("x.c", "-std=gnu99"), ("x.cpp", "-std=gnu++11"), ("x.cpp", "-std=c++11"))


@pytest.mark.parametrize("module", [code, data, markdown_text, markup, text], ids=lambda module: module.__name__)
def test_the_examples_in_the_docstrings(module: ModuleType) -> None:
    done = doctest.testmod(module)
    assert done.attempted > 0
    assert done.failed == 0


@pytest.mark.parametrize("words", LANGUAGES, ids=" ".join)
def test_an_attack_in_a_comment_is_a_comment(words: tuple[str, str]) -> None:
    quoted = [quoting.c_comment(one) for one in ATTACKS]
    blocks = [quoting.c_block_comment(one) for one in ATTACKS]
    lines = [f"// {q}\n//{q}\n/*{b}*/ /* *{b}*/\nint a{n};\n" for n, (q, b) in enumerate(zip(quoted, blocks, strict=True))]
    wanted = [word for n in range(len(ATTACKS)) for word in ("int", f"a{n}", ";")]
    assert tokens("".join(lines), *words) == wanted
    assert tokens("".join(lines).replace("\n", "\r\n"), *words) == wanted


@examples(150)
@given(texts(), texts(), st.sampled_from(LANGUAGES))
def test_any_texts_in_a_comment_are_a_comment(one: str, other: str, words: tuple[str, str]) -> None:
    line, block = quoting.c_comment, quoting.c_block_comment
    shown = f"// {line(one)}: {line(other)}\nint a; /*{block(one)}{block(other)}*/ int b;\n"
    assert tokens(shown, *words) == ["int", "a", ";", "int", "b", ";"]


@examples(150)
@given(texts(), st.sampled_from(LANGUAGES))
def test_any_text_in_a_string_is_one_literal(one: str, words: tuple[str, str]) -> None:
    shown = f"const char *a = \"{quoting.c_string(one)}\"; int b = '{quoting.c_char(one[:1] or 'x')}';\n"
    found = tokens(shown, *words)
    assert [word for word in found if word[:1] not in "\"'"] == ["const", "char", "*", "a", "=", ";", "int", "b", "=", ";"]
    assert sum(word[:1] in "\"'" for word in found) == 2


@examples(150)
@given(texts())
def test_any_text_in_a_header_name_or_as_a_word_is_one(one: str) -> None:
    shown = f"#include <{quoting.c_header(one) or 'x'}>\nint {quoting.c_word(one) or 'x'};\nint a;\n"
    found = tokens(shown, "x.cpp", "-std=c++11")
    assert found[-3:] == ["int", "a", ";"]
    assert (found[-6], found[-4]) == ("int", ";")


@examples(200)
@given(texts())
def test_an_identifier_is_one_in_c_and_in_cplusplus(one: str) -> None:
    made = quoting.identifier(one)
    if made:
        assert "__" not in made
        assert not (made[0] == "_" and made[1:2].isupper())
        for words in LANGUAGES[1:3]:
            assert problems(f"extern int {made};\n", *words) == []


def test_all_keywords_are_known() -> None:
    """What libclang itself takes for a keyword of C99 or C++20 is never given back."""
    for name, standard in (("x.c", "-std=gnu99"), ("x.cpp", "-std=gnu++20")):
        for word in [*sorted(code.C_WORDS), "LED", "loop"]:
            assert problems(f"extern int {quoting.identifier(word)};\n", name, standard) == [], word


@examples(200)
@given(texts())
def test_a_file_name_is_one_file_in_the_folder(one: str) -> None:
    name = quoting.file_name(one)
    assert 0 < len(name.encode()) < 255
    assert not set(name) & set('/\\:*?"<>|\0\n\r')
    assert name[0] not in ".-~"
    assert name[-1] not in ". "
    assert not acts_on_terminal(name)


PLACES: dict[str, tuple[Callable[[str], str], str, list[str]]] = {
    "in a line": (quoting.markdown, "a {} b", ["paragraph_open", "paragraph_close"]),
    "between brackets": (quoting.markdown, "a ({}) `x`", ["paragraph_open", "paragraph_close"]),
    "beginning a line": (quoting.markdown_block, "a\n{}", ["paragraph_open", "paragraph_close"]),
    "beginning a paragraph": (quoting.markdown_block, "{} z", ["paragraph_open", "paragraph_close"]),
    "in a heading": (quoting.markdown_block, "# {}", ["heading_open", "heading_close"]),
    "in code": (quoting.markdown_code, "a `{}` b", ["paragraph_open", "paragraph_close"]),
}


def seen(one: str, place: str) -> str:
    """The text that a reader has to see; blanks at the beginning of a line do not count."""
    if place == "in code":
        return quoting.visible(quoting.one_line(one)).replace("`", "'")
    shown = quoting.visible(quoting.one_line(one))
    return shown.lstrip() if PLACES[place][0] is quoting.markdown_block else shown


@pytest.mark.parametrize("place", PLACES)
@examples(300)
@given(one=texts())
@example("*a*b*").via("emphasis in a word")
@example("a] (b)").via("no link")
def test_any_text_in_markdown_is_seen_as_it_is(place: str, one: str) -> None:
    function, template, kinds = PLACES[place]
    shown = template.format(function(one))
    assert markdown_kinds(shown) == kinds
    left, right = template.replace("`", "").replace("# ", "").split("{}")
    assert judges.markdown_text(shown) == " ".join(f"{left}{seen(one, place)}{right}".split())


@examples(300)
@given(texts(), texts())
def test_any_texts_in_a_table_are_cells(one: str, other: str) -> None:
    table = "| a | b | c |\n|---|---|---|\n"
    shown = f"{table}| {quoting.markdown_cell(one)} | `{quoting.markdown_code_cell(other)}` | end |\n"
    kinds = markdown_kinds(shown)
    assert kinds == markdown_kinds(f"{table}| x | `x` | end |\n")
    for marked in ("<script", "<img", "javascript:"):
        assert marked not in quoting.markdown_cell(one).lower()


def test_harmless_texts_stay_as_they_are_in_markdown() -> None:
    for one in (
        "int *p",
        "#include <stdio.h>",
        "a < b && c > d",
        "x[3]",
        "set_output(P1)",
        "Red (633nm)-LED1",
        "--bind P1=D2",
        "5% - 10",
    ):
        assert quoting.markdown(one) == quoting.markdown_block(one) == quoting.markdown_cell(one) == one


@examples(200)
@given(texts())
def test_any_text_in_html_is_text(one: str) -> None:
    page = Page(
        f'<p title="{quoting.html_attribute(one)}">{quoting.html(one)}</p><a href="{quoting.html_url(one)}"></a>'
        f"<!--{quoting.html_comment(one)}--><b></b>"
    )
    assert [tag for tag, _ in page.tags] == ["p", "a", "b"]
    href = "".join((page.tags[1][1]["href"] or "").split()).lower()
    assert not href.startswith(("javascript", "data:", "vbscript"))
    assert len(page.comments) == 1


@examples(200)
@given(texts())
def test_any_text_in_svg_is_well_formed(one: str) -> None:
    shown = f'<svg><title a="{quoting.xml_attribute(one)}">{quoting.xml(one)}</title><!--{quoting.xml_comment(one)}--></svg>'
    root = etree.fromstring(shown.encode())
    assert [child.tag for child in root if isinstance(child.tag, str)] == ["title"]
    assert len(root.findtext("title") or "") >= len(one.replace("\r\n", "\n")) - one.count("\r")


@examples(300)
@given(texts(), texts())
def test_any_text_comes_back_from_toml_and_yaml(one: str, other: str) -> None:
    whole = one.encode("utf-16", "surrogatepass").decode("utf-16", "replace")
    assert tomllib.loads(f"a = {quoting.toml(one)}\n")["a"] == whole
    found = yaml.safe_load(f"k:\n  - {quoting.yaml(one)}\n{quoting.yaml(other)}: {quoting.yaml(one)}\n")
    key = other.encode("utf-16", "surrogatepass").decode("utf-16", "replace")
    assert found == {"k": [whole], key: whole} if key != "k" else found["k"] == whole
    assert not acts_on_terminal(quoting.toml(one) + quoting.yaml(one))


@examples(300)
@given(st.lists(texts(), min_size=1, max_size=3))
def test_any_texts_come_back_from_a_table_and_none_is_a_formula(row: list[str]) -> None:
    line = ",".join(quoting.csv_record_cell(one) for one in row)
    [cells] = list(csv.reader(io.StringIO(line or '""', newline=""), strict=True)) or [[""]]
    assert [quoting.csv_text(cell) for cell in cells] == row
    for cell in cells:
        assert cell[:1] not in ("=", "@", "\t", "\r")
        assert cell[:1] not in ("+", "-") or not cell.strip("+-") or float(cell.replace(",", ".")) is not None


@examples(300)
@given(texts())
def test_a_terminal_is_told_nothing(one: str) -> None:
    assert not acts_on_terminal(quoting.terminal(one))
    assert "\n" not in quoting.terminal(one)
    assert not acts_on_terminal(quoting.terminal_lines(one))
    document: dict[str, Json] = {"a": one, one: [1]}
    for ascii_only in (False, True):
        shown = quoting.json_text(document, ascii_only=ascii_only)
        assert not acts_on_terminal(shown)
        assert json.loads(shown) == json.loads(json.dumps(document))  # two halves of a character are one there


@examples(200)
@given(texts())
def test_plantuml_gets_no_directive_tag_or_function(one: str) -> None:
    for shown in (quoting.plantuml(one), quoting.plantuml(one, begins=True)):
        assert not [mark for mark in ("\n", '"', "[[", "<img") if mark in shown]
        assert "%getenv" not in shown
    assert quoting.plantuml(one, begins=True)[:1] not in ("!", "@", "'", "}", "-", "=", ".")
