"""What serves those who write the files themselves: `make`, templates that name their parts, the shared built-in templates."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest
from msgspec.structs import replace

from robosmi.base.trust import trust
from robosmi.errors import RuleError, SourceError
from robosmi.generate import Gen
from tests.generate.support import library

PARTS = """\
# not in a part
{% do out.part("head", b, step="first") %}
{{ b.name }}

{% for a in b.authors %}
{% do out.part("author", [a, b], none) %}
{% print out.print(a.name ~ "\n" ~ a.name ~ "!\n") %}
{% endfor %}
{% do out.part("nothing here", b) %}
{% do out.part("tail") %}
no line break at the end"""


def parts(folder: Path, template: str = PARTS) -> tuple[Any, Gen]:
    L = library()
    g = Gen(folder, {"page": template, "included": "{% include 'page' %}"}, [L])

    @g.rule(L.Book, guard=lambda b: b.name == "Propellers", template="page", target=lambda b: f"{b.name}.txt")
    def Page(b: Any) -> None: ...

    return L, g


def named(links: Any) -> list[tuple[int, int, str, str, list[str]]]:
    return [(k.line, k.end_line, k.part, k.step, [e.name for e in k.elements]) for k in links if k.part]


def test_named_parts_say_where_their_lines_come_from(tmp_path: Path) -> None:
    _, g = parts(tmp_path)
    expected = [
        (2, 3, "head", "first", ["Propellers"]),
        (4, 5, "author", "", ["Ada", "Propellers"]),
        (6, 7, "author", "", ["Ben", "Propellers"]),
        (8, 8, "tail", "", []),
    ]
    assert named(g.run().trace.links) == expected
    file = tmp_path / "Propellers.txt"
    assert file.read_text().splitlines()[7] == "no line break at the end"


def test_parts_of_an_included_template_count_and_follow_their_lines_in_an_edited_file() -> None:
    L = library()
    g = Gen(templates={"page": PARTS, "outer": "{% include 'page' %}"})

    @g.rule(domain=[L.Book.all.select_one(lambda b: b.name == "Propellers")], template="outer", target="x.txt")
    def Page(b: Any) -> None: ...

    (made,) = g.make().files
    assert made.after is not None
    edited = made.after.replace("Ada\n", "Ada\nmine\n").replace("# not in a part\n", "").replace("Ben\nBen!\n", "")
    assert named(replace(made, after=edited).links()) == [
        (1, 2, "head", "first", ["Propellers"]),
        (3, 3, "author", "", ["Ada", "Propellers"]),
        (5, 5, "author", "", ["Ada", "Propellers"]),
        (6, 6, "tail", "", []),
    ]


def test_make_neither_reads_nor_writes_the_folder(tmp_path: Path) -> None:
    out = tmp_path / "out"
    for folder in (out, tmp_path):
        _, g = parts(folder, "{{ b.name }}")
        g.write("before.txt", "b")
        (tmp_path / "Propellers.txt").write_bytes(b"\xff not text")
        result = g.make()
        assert [(f.name, f.before, f.after) for f in result.files] == [
            ("before.txt", None, "b"),
            ("Propellers.txt", None, "Propellers"),
        ]
        assert not result.done
        assert not out.exists()
        assert [p.name for p in tmp_path.iterdir()] == ["Propellers.txt"]


@pytest.mark.parametrize("target", ["../x", "/x", "", "a/"])
def test_make_refuses_targets_outside_of_the_folder(target: str, tmp_path: Path) -> None:
    g = Gen(tmp_path, {"page": "x"})
    g.rule(template="page", target=target)(lambda: None)
    with pytest.raises(SourceError):
        g.make()


def test_after_make_a_run_writes_again(tmp_path: Path) -> None:
    _, g = parts(tmp_path)
    g.make()
    assert g.run().written == ["Propellers.txt"]


def test_built_in_templates_are_compiled_once_and_anew_when_they_change(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own = tmp_path / ".robosmi" / "templates"
    own.mkdir(parents=True)
    (own / "mine.j2").write_text("one {{ x }}")
    trust(tmp_path)
    monkeypatch.chdir(tmp_path)
    first, second = Gen(), Gen()
    assert first.text("mine.j2", x=1) == second.text("mine.j2", x=1) == "one 1"
    assert first.templates._environment is second.templates._environment
    (own / "mine.j2").write_text("two, longer {{ x }}")
    os.utime(own / "mine.j2", (1, 1))
    trust(tmp_path)
    assert Gen().text("mine.j2", x=1) == "two, longer 1"
    monkeypatch.chdir(tmp_path.parent)
    with pytest.raises(RuleError, match=r"there is no template 'mine\.j2'"):
        Gen().text("mine.j2", x=1)


def test_values_and_filters_of_one_generation_are_not_anothers() -> None:
    one, other = Gen(values={"v": 1}), Gen()
    other.give(values={"w": 2}, filters={"twice": lambda x: x * 2})
    plain = Gen()
    assert "v" in one.templates._environment.globals
    assert {"v", "w"} & set(plain.templates._environment.globals) == set()
    assert "twice" not in plain.templates._environment.filters
