"""`Gen` beyond the engine's cases: nothing is written for nothing, dry runs, traces, ids of regions, and bad input."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import ModelError, RobosmiError, RuleError, SourceError
from robosmi.generate import Gen, formatters, region_id
from robosmi.model.opening import open_model
from tests.generate.support import book, library

PAGE = """\
{# a page #}
title {{ b.name }}
{% for a in b.authors %}
by {{ a.name }}
{% endfor %}
{{ out.start_preserve("//", "", region_id(b, "notes"), true) }}
notes
{{ out.stop_preserve() }}
"""


def pages(folder: Path, **options: Any) -> tuple[Any, Gen]:
    L = library()
    g = Gen(folder, {"page": PAGE}, [L], **options)

    @g.rule(L.Book, template="page", target=lambda b: f"{b.name}.txt")
    def Page(b: Any) -> None: ...

    return L, g


def tree(folder: Path) -> dict[str, tuple[bytes, int]]:
    return {str(p.relative_to(folder)): (p.read_bytes(), p.stat().st_mtime_ns) for p in folder.rglob("*") if p.is_file()}


@pytest.mark.parametrize("keep", [False, True])
def test_a_second_run_writes_nothing(keep: bool, tmp_path: Path) -> None:
    first = pages(tmp_path / "out", keep=keep)[1].run()
    before = tree(tmp_path / "out")
    assert {f.state for f in first.files} == {"new"}
    second = pages(tmp_path / "out", keep=keep)[1].run()
    assert (second.written, second.removed, second.diff()) == ([], [], "")
    assert {f.state for f in second.files} == {"unchanged"}
    assert tree(tmp_path / "out") == before


def test_a_dry_run_writes_nothing_and_has_the_diff(tmp_path: Path) -> None:
    _, g = pages(tmp_path / "out")
    result = g.run(dry_run=True)
    assert not (tmp_path / "out").exists()
    assert not result.done
    assert "--- /dev/null\n+++ b/Ants.txt\n@@ -0,0 +1,5 @@\n+title Ants\n" in result.diff()
    g.run()
    (tmp_path / "out" / "Ants.txt").write_text("title Ants")
    before = tree(tmp_path / "out")
    result = pages(tmp_path / "out")[1].run(dry_run=True)
    assert result.written == ["Ants.txt"]
    assert "-title Ants\n\\ No newline at end of file\n" in result.diff()
    assert tree(tmp_path / "out") == before


def test_every_line_and_region_leads_to_its_elements_and_back(tmp_path: Path) -> None:
    L, g = pages(tmp_path / "out")
    g.run()
    file = tmp_path / "out" / "Propellers.txt"
    file.write_text(file.read_text().replace("notes\n", "my\nlonger\nnotes\n", 1).replace("title", "Title"))
    trace = g.run().trace
    lines = file.read_text().splitlines()
    ada, ben, propellers = L.Author.all[0], L.Author.all[1], book(L, "Propellers")
    assert lines[1:3] == ["by Ada", "by Ben"]
    assert ada in trace.elements("Propellers.txt", 2)
    assert ada not in trace.elements("Propellers.txt", 3)
    assert ben in trace.elements("Propellers.txt", 3)
    region = trace.region("Propellers.txt", "City/Tech/Robots/Propellers notes")
    assert region is not None
    assert lines[region.line - 1].endswith("on begin")
    assert lines[region.end_line - 1].endswith("end")
    assert region.end_line - region.line == 4
    assert propellers in region.elements
    assert {(k.path, k.line) for k in trace.links_of(ada) if k.line == k.end_line} == {("Propellers.txt", 2)}
    assert [k.path for k in trace.links_of(propellers) if k.line == 1 and k.end_line == len(lines)] == ["Propellers.txt"]
    assert {line for line in range(1, len(lines) + 1) if propellers in trace.elements("Propellers.txt", line)} == set(
        range(1, len(lines) + 1)
    )


def test_appended_texts_are_traced_to_their_own_lines(tmp_path: Path) -> None:
    L = library()
    g = Gen(tmp_path / "out", {"line": "{{ b.name }}"}, [L])

    @g.rule(L.Book, template="line", target="log.txt", append=True)
    def Log(b: Any) -> None: ...

    trace = g.run().trace
    assert [e.name for n in (1, 2, 3, 4) for e in trace.elements("log.txt", n)] == ["Propellers", "Boards", "Ants", "Mills"]


def test_ids_of_regions_come_from_the_model() -> None:
    L = library()
    ants = book(L, "Ants")
    assert region_id(ants) == "City/Stories/Ants"
    assert region_id(ants, "body", "end") == "City/Stories/Ants body end"
    L.Section.all[0].name = ""
    with pytest.raises(ModelError, match="neither an id nor a name") as wrong:
        region_id(book(L, "Boards"))
    assert wrong.value.fix
    ants._internal_id = "_7"
    ants.name = "Renamed"
    assert region_id(ants) == "_7"


def test_elements_of_another_technology_make_files_too(tmp_path: Path) -> None:
    (tmp_path / "parts.csv").write_text("name,price\nbolt,2\nnut,1\n")
    P = open_model(tmp_path / "parts.csv", name="P")
    g = Gen(tmp_path / "out", {"part": "{{ p.price }}\n{% protected region_id(p), start='#' %}\n{% endprotected %}\n"}, [P])

    @g.rule("parts", template="part", target=lambda p: f"{p.name}.txt")
    def Part(p: Any) -> None: ...

    trace = g.run().trace
    assert (tmp_path / "out" / "nut.txt").read_text().startswith("1\n# protected region nut on begin\n")
    assert [e.name for e in trace.elements("nut.txt", 1)] == ["nut"]


def test_formatters_indent_by_brackets_and_tags() -> None:
    assert formatters.java("a {\n\n   b {\n  c;\n}\n }\nd") == "a {\n\n\tb {\n\t\tc;\n\t}\n}\nd"
    assert formatters.xml("<a>\n<b>\nx\n</b>\n<c/>\n</a>\n") == "<a>\n\t<b>\n\t\tx\n\t</b>\n\t<c/>\n</a>\n"


def test_stop_ends_a_template_and_include_shares_its_lines(tmp_path: Path) -> None:
    templates = {
        "all": "a\n{% include 'part' %}\n{{ out.line }}\n{% if true %}{% do out.stop() %}{% endif %}\nnever",
        "part": "{{ n }}\nb\n",
    }
    assert Gen(tmp_path, templates).text("all", n=1) == "a\n1\nb\n4\n"


# Bad input: place, cause, what to do, and nothing is written.


def failing(tmp_path: Path, source: str = "x", **rule: Any) -> RobosmiError:
    """The error of a generation that also has a rule in order; nothing may be written, anywhere."""
    folder = tmp_path / "out"
    L = library()
    g = Gen(folder, {"good": "good", "bad": source}, [L])

    @g.rule(template="good", target="good.txt")
    def Good() -> None: ...

    options = {"template": "bad", "target": "bad.txt"} | rule

    @g.rule(L.Member, **options)
    def Bad(m: Any) -> None: ...

    before = tree(tmp_path)
    with pytest.raises(RobosmiError) as raised:
        g.run()
    assert tree(tmp_path) == before
    assert raised.value.exit_code in (2, 3)
    assert raised.value.location is not None
    assert raised.value.fix
    return raised.value


@pytest.mark.parametrize(
    ("template", "line", "cause"),
    [
        ("a\n{% for x in %}\n", 2, "does not parse"),
        ("a\n{% if m %}\n", 2, "does not parse"),
        ("a\n{{ m.name }\n", 2, "does not parse"),
        ("a\nb\n{{ nme }}\n", 3, "'nme' is undefined"),
        ("a\n{{ m.nmae }}\n", 2, "no feature 'nmae' (did you mean 'name'?)"),
        ("a\n{{ L.Bok.all }}\n", 2, "no type 'Bok' (did you mean 'Book'?)"),
        ("a\n{{ 1 / 0 }}\n", 2, "ZeroDivisionError"),
        ("a\n{% include 'nothing' %}\n", 2, "no template 'nothing'"),
        ("a\n{{ m.name | nofilter }}\n", 2, "does not parse"),
        ("\n{{ out.start_preserve('//', '', 'x', true) }}\n", 0, "never stopped"),
        ("\n{{ out.stop_preserve() }}\n", 2, "no region to stop"),
        ("{{ out.start_preserve('a') }}\n", 1, "no comment is known"),
        ("{{ out.start_preserve('#', '', ' ') }}\n", 1, "cannot be the id"),
        ("{% do out.set_content_type('Jvaa') %}\n", 1, "no content type (did you mean 'Java'?)"),
        ("{% for i in [1, 2] %}\n{% protected 'a', start='#' %}\n{% endprotected %}\n{% endfor %}\n", 2, "two regions have"),
        ("{{ out.start_preserve('#', '', 'a') }}\n{{ out.start_preserve('#', '', 'b') }}\n", 2, "must be stopped before"),
        ("{{ out.start_preserve('a', '', 'b') }}\n{{ out.stop_preserve() }}\n{{ out.start_control('c') }}", 3, "both protected"),
        ("{{ out.start_preserve('/*', '*/', 'x') }} text {{ out.stop_preserve() }}\n", 0, "'x' could not be found again"),
        ("{{ out.start_preserve('/*', '*/', 'x') }} text\n{{ out.stop_preserve() }}\n", 0, "text stands behind its first marker"),
        ("{{ out.start_preserve('#', '', 'x') | upper }}\ntext\n{{ out.stop_preserve() }}\n", 0, "'x' could not be found again"),
        ("{{ region_id(L.Book.all.first().authors) }}", 1, "is no element of a model"),
    ],
)  # fmt: skip
def test_a_wrong_template(template: str, line: int, cause: str, tmp_path: Path) -> None:
    error = failing(tmp_path, template)
    assert isinstance(error, (RuleError, ModelError))
    assert error.location is not None
    assert (error.location.path, error.location.line or 0) == ("bad", line)
    assert cause in error.message
    assert "rule Bad for" in error.message


def test_a_wrong_template_file_is_named_by_its_path(tmp_path: Path) -> None:
    (tmp_path / "templates").mkdir()
    (tmp_path / "templates" / "outer").write_text("a\n{% include 'inner' %}\n")
    (tmp_path / "templates" / "inner").write_text("{% macro m(x) %}\n{{ x.y }}\n{% endmacro %}\n\n{{ m(1) }}\n")
    with pytest.raises(RuleError) as raised:
        Gen(tmp_path / "out", tmp_path / "templates").text("outer")
    assert str(raised.value.location) == f"{tmp_path / 'templates' / 'inner'}:2"


def test_an_unknown_template_and_a_missing_folder(tmp_path: Path) -> None:
    with pytest.raises(RuleError, match="there is no template 'bda'"):
        Gen(tmp_path, {"bad": ""}).text("bda")
    with pytest.raises(RuleError, match="folder of templates does not exist"):
        Gen(tmp_path, tmp_path / "nowhere")
    (tmp_path / "file").write_text("x")
    with pytest.raises(SourceError, match="the output path is a file"):
        Gen(tmp_path / "file", {})


@pytest.mark.parametrize("target", ["../x.txt", "a/../../x.txt", "/tmp/x.txt", "..", ".", "", "a/", "a\0b", "good.txt/x"])
def test_a_target_outside_of_the_folder(target: str, tmp_path: Path) -> None:
    error = failing(tmp_path, target=target)
    assert isinstance(error, SourceError)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("where", ["folder", "file", "folder above"])
def test_a_link_does_not_lead_outside(where: str, tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "x.txt").write_text("theirs")
    (tmp_path / "out").mkdir()
    if where == "file":
        os.symlink(tmp_path / "elsewhere" / "x.txt", tmp_path / "out" / "x.txt")
    else:
        os.symlink(tmp_path / "elsewhere", tmp_path / "out" / "a")
    error = failing(tmp_path, target={"folder": "a/x.txt", "file": "x.txt", "folder above": "a/b/c.txt"}[where])
    assert "link" in error.message
    assert (tmp_path / "elsewhere" / "x.txt").read_text() == "theirs"


def test_a_link_that_stays_inside_is_followed(tmp_path: Path) -> None:
    (tmp_path / "out" / "real").mkdir(parents=True)
    os.symlink("real", tmp_path / "out" / "a")
    g = Gen(tmp_path / "out", {"t": "x"})
    g.rule(template="t", target="a/x.txt")(lambda: None)
    g.run()
    assert (tmp_path / "out" / "real" / "x.txt").read_text() == "x"


def raising(element: Any) -> Any:
    raise KeyError("lost")


@pytest.mark.parametrize("part", ["guard", "pre", "template", "target", "overwrite", "post", "domain"])
def test_a_rule_that_raises(part: str, tmp_path: Path) -> None:
    functions: dict[str, Any] = {"domain": lambda: raising(None), "post": lambda m, file: raising(m)}
    error = failing(tmp_path, "x", **{part: functions.get(part, raising)})
    assert isinstance(error, RuleError)
    assert "KeyError: 'lost'" in error.message
    assert "of Bad" in error.message
    assert error.location is not None
    assert error.location.path.endswith("test_generator.py")
    assert error.location.line == raising.__code__.co_firstlineno + 1


def test_a_rule_whose_function_does_not_fit_and_a_name_that_is_taken(tmp_path: Path) -> None:
    L = library()
    g = Gen(tmp_path, {}, [L])
    with pytest.raises(RuleError, match="has 0 parameters"):
        g.rule(L.Book, template="t")(lambda: None)
    with pytest.raises(RuleError, match="has 1 parameter"):
        g.rule(template="t")(lambda b: None)
    g.rule(template="t", name="R")(lambda: None)
    with pytest.raises(RuleError, match="two rules are called R"):
        g.rule(template="t", name="R")(lambda: None)


def test_a_file_that_is_no_text_is_not_merged(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "bad.txt").write_bytes(b"\xff\xfe")
    assert "UTF-8" in failing(tmp_path).message


def test_a_folder_stands_where_a_file_is_to_be_written(tmp_path: Path) -> None:
    (tmp_path / "out" / "bad.txt").mkdir(parents=True)
    assert "a folder is in the place of a file" in failing(tmp_path).message


def test_the_record_is_no_place_for_files(tmp_path: Path) -> None:
    g = Gen(tmp_path / "out", {"t": "x"}, keep="last")
    g.rule(template="t", target="last/x.txt")(lambda: None)
    with pytest.raises(SourceError, match="last texts are kept"):
        g.run()
    with pytest.raises(SourceError, match="outside the output folder"):
        Gen(tmp_path / "out", {}, keep="../last")


def test_a_target_that_is_no_text_is_told_with_its_rule(tmp_path: Path) -> None:
    gen = Gen(tmp_path / "out")
    number: Any = lambda: 3  # noqa: E731

    @gen.rule(template="any.txt", target=number)
    def Numbered() -> None: ...

    with pytest.raises(RuleError, match="the target of Numbered is 3") as told:
        gen.run()
    assert told.value.location is not None
