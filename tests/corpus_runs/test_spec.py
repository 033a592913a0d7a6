"""Specifications: what is refused, where, and with which advice."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi.corpus.jobs import Limits
from robosmi.corpus.programs import program_sources
from robosmi.corpus.spec import checked_steps, read_spec
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, UsageError
from tests.corpus_runs.running_corpora import copied, run_here

WRONG = {
    "": "names no programs",
    "[[program]]\nglob = 'a'": "did you mean 'programs'",
    "[[programs]]\nglop = 'a'": "did you mean 'glob'",
    "[[programs]]\nglob = 3": "glob of [[programs]] number 1 is no text",
    "[[programs]]\nrevision = 'a'": "says nowhere",
    "[[programs]]\nfolder = '.'\nrevision = 'a'": "a revision and no git",
    "[[programs]]\nfolder = '.'\ngit = 'a'": "folder and git",
    "[[programs]]\nfolder = 'sub'\ngit = 'b'": "folder and git",
    "[[programs]]\nlist = 'a'\nglob = 'a'": "a glob and a list",
    "[[programs]]\nfolder = '.'\n[migrate]\ntarged = 'uno'": "did you mean 'target'",
    "[[programs]]\nfolder = '.'\n[programs.migrate]\nhardwear = 'a'": "did you mean 'hardware'",
    "[[programs]]\nfolder = '.'\n[migrate]\nconsole_wait_ms = 'long'": 'console_wait_ms = "long" is no time',
    "[[programs]]\nfolder = '.'\n[limits]\nsecond = 3": "did you mean 'seconds'",
    "[[programs]]\nfolder = '.'\n[limits]\nseconds = 0": "seconds = 0 is no time",
    "[[programs]]\nfolder = '.'\n[limits]\nseconds = nan": "is no time",
    "[[programs]]\nfolder = '.'\n[limits]\nmegabytes = 1.5": "megabytes = 1.5 is no whole number",
    "[[programs]]\nfolder = '.'\n[limits]\nmegabytes = '1'": 'megabytes = "1" is no whole number',
    "[[programs]]\nfolder = '.'\n[limits]\nmegabytes = 10": "megabytes = 10 is too little",
    "[[programs]]\nfolder = '.'\n[limits.verify]\nmegabytes = 99": "megabytes = 99 is too little",
    "[[programs]]\nfolder = '.'\n[limits]\nmegabytes = 99999999": "megabytes = 99999999 is too much",
    "[[programs]]\nfolder = '.'\n[limits.verify]\nmegabyte = 1": "did you mean 'megabytes'",
    "[[programs]]\nfolder = '.'\ninclude_dirs = 'a'": "include_dirs is no list of texts",
    "[[programs]]\nfolder = '.'\ninclude_dirs = ['.', 'inc']": "include_dirs of [[programs]] number 1: there is no folder 'inc'",
    "[[programs]]\nfolder = '.'\ndefines = ['A', 'B=1 2', '2X=1']": "defines of [[programs]] number 1: '2X=1' is no macro",
    "[[programs]]\nfolder = '.'\ndefines = ['-DA']": "'-DA' is no macro",
    "steps = ['analyze']\n[[programs]]\nfolder = '.'": "did you mean 'analyse'",
    "steps = ['compile']\n[[programs]]\nfolder = '.'": "needs the step 'migrate'",
    "keep_models = 1\n[[programs]]\nfolder = '.'": "neither true nor false",
    "programs = 3": "names no programs",
    "programs = [3]": "number 1 is no table",
    "[[programs": "cannot be read",
    "\x00": "cannot be read",
}


@pytest.mark.parametrize("text", WRONG)
def test_a_key_or_value_that_means_nothing_is_refused(text: str, tmp_path: Path) -> None:
    spec = tmp_path / "spec.toml"
    spec.write_text(text, encoding="utf-8")
    with pytest.raises(SourceError) as refused:
        read_spec(spec)
    assert WRONG[text] in refused.value.message
    assert refused.value.location is not None
    assert refused.value.fix


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[[programs]]\nfolder = '.'\n[migrate]\ntarget = 'unoo'", "[migrate]: unknown target 'unoo' (did you mean 'uno'?)"),
        ("[[programs]]\nfolder = '.'\nmigrate = {from = 'meega'}", "migrate of [[programs]] number 1: unknown target 'meega'"),
        ("[[programs]]\nfolder = '.'\n[migrate]\nsource_platform = 'basic'", "[migrate]: there is no 'basic/platform.toml'"),
    ],
)
def test_a_setting_that_names_what_is_unknown_is_refused_before_a_program_is_run(text: str, said: str, tmp_path: Path) -> None:
    spec = copied(tmp_path)
    spec.write_text(text, encoding="utf-8")
    with pytest.raises(SourceError) as refused:
        run_here(spec, tmp_path / "out", lambda job: pytest.fail(f"{job.work.id} is run"))
    assert said in refused.value.message
    assert refused.value.location == Location(str(spec))


def test_a_specification_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(SourceError):
        read_spec(tmp_path / "none.toml")


def test_limits_of_a_step_count_before_those_of_all(tmp_path: Path) -> None:
    spec = tmp_path / "spec.toml"
    spec.write_text("[[programs]]\nfolder = '.'\n[limits]\nseconds = 5\n[limits.verify]\nseconds = 60\n", encoding="utf-8")
    limits = read_spec(spec).limits
    assert (limits.of("analyse").seconds, limits.of("verify").seconds) == (5, 60)
    assert limits.of("verify").megabytes == Limits().megabytes


def test_steps_are_put_in_order() -> None:
    assert checked_steps(["verify", "migrate"]) == ("migrate", "verify")
    for wrong in (["nothing"], [], ["verify"]):
        with pytest.raises(UsageError):
            checked_steps(wrong)


def test_no_worker_process(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="jobs = 0"):
        robosmi.corpus.run(copied(tmp_path), tmp_path / "out", jobs=0)


def test_two_programs_of_one_id_are_an_error_that_names_both(tmp_path: Path) -> None:
    spec = copied(tmp_path)
    spec.write_text("[[programs]]\nglob = 'programs/*.c'\n[[programs]]\nfolder = 'programs'\n", encoding="utf-8")
    with pytest.raises(SourceError) as refused:
        program_sources(read_spec(spec), tmp_path / "out")
    assert "programs/blink.c" in refused.value.message
    assert "number 1" in refused.value.message
    assert "number 2" in refused.value.message
    spec.write_text(
        "[[programs]]\nglob = 'programs/*.c'\n[[programs]]\nfolder = 'programs'\nprefix = 'again/'\n", encoding="utf-8"
    )
    ids = [source.id for source in program_sources(read_spec(spec), tmp_path / "out")]
    assert "again/programs/blink.c" in ids
    (tmp_path / "list.csv").write_text("id;path\na;programs/blink.c\na;programs/wheels.c\n", encoding="utf-8")
    spec.write_text("[[programs]]\nlist = 'list.csv'\n", encoding="utf-8")
    with pytest.raises(SourceError) as refused:
        program_sources(read_spec(spec), tmp_path / "out")
    assert "line 2" in refused.value.message
    assert "line 3" in refused.value.message


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"name,site\n", "no column 'path'; its columns are: name, site"),
        (b"id,Path\na,b.c\n", "its columns are: id, Path (did you mean 'path'?)"),
        (b"id,path\na,\n", "list.csv:2: this program has no path"),
        (b"id,path\n\xff\xfe,\n", "not UTF-8"),
        (b'id,path,site\na,a.c,x\nb,b.c,"5\nc,c.c,y\n', "list.csv:3: this row is no CSV: unexpected end of data"),
        (b'id,path,site\nb,b.c,"5\nc,c.c,"y"\n', "list.csv:2: this row is no CSV"),
        (b"id,path\na,a.c\nb,b.c,x\n", "list.csv:3: this row has 3 cells, and the list 2 columns"),
        (b"id,path,site,site\na,a.c,x,y\n", "list.csv:1: two columns of the list are named 'site'"),
    ],
)
def test_a_list_that_cannot_be_read(data: bytes, message: str, tmp_path: Path) -> None:
    spec = tmp_path / "spec.toml"
    (tmp_path / "list.csv").write_bytes(data)
    spec.write_text("[[programs]]\nlist = 'list.csv'\n", encoding="utf-8")
    with pytest.raises(SourceError) as refused:
        program_sources(read_spec(spec), tmp_path / "out")
    assert message in str(refused.value)
    assert refused.value.fix


@pytest.mark.parametrize("separator", ",;\t")
def test_cells_of_a_list_may_have_separators_and_lines_in_quotation_marks(separator: str, tmp_path: Path) -> None:
    spec = tmp_path / "spec.toml"
    rows = (["path", "site"], ["a.c", f'"one{separator}\n""two"""'], ["", ""], ["b.c"])
    (tmp_path / "list.csv").write_text("\n".join(map(separator.join, rows)), encoding="utf-8")
    spec.write_text("[[programs]]\nlist = 'list.csv'\n", encoding="utf-8")
    found = program_sources(read_spec(spec), tmp_path / "out")
    assert [(each.id, each.labels, each.origin) for each in found] == [
        ("a.c", {"site": f'one{separator}\n"two"'}, "list.csv, line 2"), ("b.c", {}, "list.csv, line 5"),
    ]  # fmt: skip


def test_a_list_without_rows_and_links_to_nothing_are_programs_that_are_missing(tmp_path: Path) -> None:
    spec = tmp_path / "spec.toml"
    (tmp_path / "list.csv").write_text("id,path\n\n", encoding="utf-8")
    (tmp_path / "other.csv").write_text("path\nlink.c\n", encoding="utf-8")
    (tmp_path / "link.c").symlink_to("nowhere.c")
    lists = "".join(f"[[programs]]\nlist = '{name}.csv'\nprefix = 'of '\n" for name in ("list", "other"))
    spec.write_text(f"{lists}[[programs]]\nglob = '*.c'\n", encoding="utf-8")
    assert [(each.id, each.missing) for each in program_sources(read_spec(spec), tmp_path / "out")] == [
        ("of list.csv", "the list has no programs"), ("of link.c", "the link leads to nothing"),
        ("link.c", "the link leads to nothing"),
    ]  # fmt: skip


def test_links_in_circles_are_not_followed(tmp_path: Path) -> None:
    spec = copied(tmp_path)
    (tmp_path / "programs" / "sub" / "up").symlink_to(tmp_path / "programs")
    (tmp_path / "programs" / "self.c").symlink_to(tmp_path / "programs" / "self.c")
    for pattern in ("glob = 'programs/**/*.c'", "folder = 'programs'"):
        spec.write_text(f"[[programs]]\n{pattern}\n", encoding="utf-8")
        names = [source.id for source in program_sources(read_spec(spec), tmp_path / "out")]
        assert not any("up/" in name for name in names)
        assert "programs/blink.c" in names
