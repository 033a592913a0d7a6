"""Without `keep`, as EGL's engine does it: what becomes of a region whose markers a person has damaged, and of a file's form."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.errors import StoppedError
from robosmi.generate import Gen, Generation

TEMPLATE = "{{ head }}\n{{ out.start_preserve('/*', '*/', 'a', true) }}\ndefault\n{{ out.stop_preserve() }}\ntail\n"
BEGIN, END = "/* protected region a on begin */", "/* protected region a end */"


def generated(folder: Path, head: str, template: str = TEMPLATE, *, append: bool = False) -> Generation:
    """One run without `keep`."""
    g = Gen(folder, {"t": template})

    @g.rule(template="t", target="o.txt", append=append)
    def Page() -> dict[str, str]:
        return {"head": head}

    return g.run()


@pytest.mark.parametrize(
    "region", [f"{BEGIN} mine {END}", f"{BEGIN} mine\n{END}", f"  {BEGIN}mine{END} // and more", f"{BEGIN} mine\nmore"]
)
def test_text_behind_a_marker_stops_the_run_that_would_lose_it(region: str, tmp_path: Path) -> None:
    generated(tmp_path, "head")
    file = tmp_path / "o.txt"
    file.write_text(f"head\n{region}\ntail\n")
    with pytest.raises(StoppedError, match="the marker of the region 'a' is broken") as stopped:
        generated(tmp_path, "other head")
    assert stopped.value.location is not None
    assert (stopped.value.location.path, stopped.value.location.line) == (str(file), 2)
    assert file.read_text() == f"head\n{region}\ntail\n"


def test_markers_next_to_each_other_are_an_empty_region(tmp_path: Path) -> None:
    generated(tmp_path, "head")
    (tmp_path / "o.txt").write_text(f"head\n{BEGIN}{END}\ntail\n")
    generated(tmp_path, "other head")
    assert (tmp_path / "o.txt").read_text() == f"other head\n{BEGIN}\n{END}\ntail\n"


@pytest.mark.parametrize(("region", "what"), [(f"{BEGIN}\nmine", "never ended"), (f"mine\n{END}", "never begun")])
def test_a_marker_without_its_counterpart_loses_its_text_as_with_the_engine_and_it_is_said(
    region: str, what: str, tmp_path: Path
) -> None:
    generated(tmp_path, "head")
    (tmp_path / "o.txt").write_text(f"head\n{region}\ntail\n")
    result = generated(tmp_path, "head")
    assert (tmp_path / "o.txt").read_text() == f"head\n{BEGIN}\ndefault\n{END}\ntail\n"
    assert [f.rule for f in result.findings] == ["RS515"]
    assert what in result.findings[0].message


def test_another_form_is_lost_as_with_the_engine_and_it_is_said(tmp_path: Path) -> None:
    generated(tmp_path, "head")
    file = tmp_path / "o.txt"
    file.write_bytes(file.read_bytes().replace(b"default", b"mine").replace(b"\n", b"\r\n"))
    before = file.read_bytes()
    assert generated(tmp_path, "head").written == []
    assert file.read_bytes() == before, "nothing new, nothing is written"
    result = generated(tmp_path, "new head")
    assert file.read_bytes() == f"new head\n{BEGIN}\nmine\n{END}\ntail\n".encode()
    assert [f.rule for f in result.findings] == ["RS523"]


def test_text_is_appended_in_the_form_of_the_file(tmp_path: Path) -> None:
    (tmp_path / "o.txt").write_bytes(b"\xef\xbb\xbfmine\r\n")
    generated(tmp_path, "head", "{{ head }}\n", append=True)
    assert (tmp_path / "o.txt").read_bytes() == b"\xef\xbb\xbfmine\r\n\r\nhead\r\n"


def test_a_file_of_the_user_with_controlled_regions_keeps_its_form(tmp_path: Path) -> None:
    template = "{{ out.start_control('#', '', 'a', true) }}\n{{ head }}\n{{ out.stop_control() }}\n"
    generated(tmp_path, "old", template)
    file = tmp_path / "o.txt"
    file.write_bytes(b"mine\r\n" + file.read_bytes().replace(b"\n", b"\r\n"))
    result = generated(tmp_path, "new", template)
    assert file.read_bytes() == b"mine\r\n# controlled region a on begin\r\nnew\r\n# controlled region a end\r\n"
    assert result.findings == []


def test_carriage_returns_of_a_template_are_written_and_compared_as_they_are(tmp_path: Path) -> None:
    for keep in (False, True):
        folder = tmp_path / str(keep)
        for head in ("head", "other"):
            g = Gen(folder, {"t": "{% print out.print(text) %}"}, keep=keep)
            text = f"{head}\r\nsecond\nthird\r\n"
            g.rule(domain=[text], template="t", target="o.txt")(lambda text: None)
            g.run()
            assert (folder / "o.txt").read_bytes() == text.encode()
            again = Gen(folder, {"t": "{% print out.print(text) %}"}, keep=keep)
            again.rule(domain=[text], template="t", target="o.txt")(lambda text: None)
            assert again.run().written == []


@pytest.mark.parametrize("damage", ["missing", "changed"])
def test_without_the_text_that_was_made_last_only_an_edit_stops_the_run(damage: str, tmp_path: Path) -> None:
    def run(head: str) -> Generation:
        g = Gen(tmp_path, {"t": "{{ head }}\nbody\n"}, keep=True)
        g.rule(template="t", target="o.txt")(lambda: {"head": head})
        return g.run()

    run("one")
    file, copy = tmp_path / "o.txt", tmp_path / ".robosmi" / "generated" / "o.txt"
    file.write_text("one\nbody\nmine\n")
    if damage == "missing":
        copy.unlink()
    else:
        copy.write_bytes(file.read_bytes())  # with this one, the edit would look like generated text
    with pytest.raises(StoppedError, match="edits cannot be detected"):
        run("two")
    assert file.read_text() == "one\nbody\nmine\n"
    file.write_text("one\nbody\n")
    assert [f.rule for f in run("two").findings] == ["RS521"]
    assert file.read_text() == copy.read_text() == "two\nbody\n"
    assert run("two").written == []
