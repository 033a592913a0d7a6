"""The option `merge_edits`, case by case: what becomes of edits, regions and files between two runs. A case is a folder.

`template.txt` is rendered once with the `elements` of a run, `steps.toml` has the runs and what a person does in between,
`expected/N` the output folder after the Nth step that says so, the record left out.
"""

from __future__ import annotations

import random
import shutil
import tomllib
from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import StoppedError
from robosmi.generate import Gen
from robosmi.generate.generator import RECORD
from robosmi.generate.merge_edits import merge_edits

CASES = Path(__file__).parent / "cases"
NAMES = sorted(path.parent.name for path in CASES.glob("*/steps.toml"))


def texts(folder: Path) -> dict[str, str]:
    """The files of a folder without the record, CR and LF visible as they are."""
    found = {path.relative_to(folder).as_posix(): path.read_bytes().decode() for path in folder.rglob("*") if path.is_file()}
    return {name: text for name, text in found.items() if not name.startswith(RECORD)}


def run(case: Path, folder: Path, step: dict[str, Any]) -> None:
    """One run, held against the findings that the step names."""
    g = Gen(folder, case, keep=True)

    @g.rule(domain=[step["run"]], template=step.get("template", "template.txt"), target="o.txt")
    def Page(elements: Any) -> None: ...

    for name in step.get("more", []):
        g.write(name, f"made for {name}\n")
    if "stops" in step:
        before = texts(folder)
        with pytest.raises(StoppedError) as stopped:
            g.run()
        assert step["stops"] in str(stopped.value)
        assert stopped.value.fix
        assert texts(folder) == before
        return
    result = g.run()
    said = [f"{f.rule} {Path(f.location.path).name}:{f.location.line or 0}" for f in result.findings if f.location is not None]
    assert said == step.get("findings", []), [str(f) for f in result.findings]


def edit(folder: Path, step: dict[str, Any]) -> None:
    """Edit a folder as the user of the case does."""
    if "delete" in step:
        (folder / step["delete"]).unlink()
        return
    change = step["edit"]
    file = folder / change.get("file", "o.txt")
    text = file.read_bytes().decode()
    assert change["from"] in text
    file.write_bytes(text.replace(change["from"], change["to"]).encode())


@pytest.mark.parametrize("name", NAMES)
def test_case(name: str, tmp_path: Path) -> None:
    case, folder = CASES / name, tmp_path / "out"
    if (case / "before").is_dir():
        shutil.copytree(case / "before", folder)
    steps = tomllib.loads((case / "steps.toml").read_text(encoding="utf-8"))
    for step in steps["step"]:
        if "run" in step:
            run(case, folder, step)
        else:
            edit(folder, step)
        if "expected" in step:
            assert texts(folder) == texts(case / "expected" / step["expected"])
    last = steps["step"][-1]
    if "run" in last and "stops" not in last:
        before = texts(folder)
        again = Gen(folder, case, keep=True)
        again.rule(domain=[last["run"]], template=last.get("template", "template.txt"), target="o.txt")(lambda elements: None)
        for name in last.get("more", []):
            again.write(name, f"made for {name}\n")
        assert again.run().written == [], "a second run without any change writes something"
        assert texts(folder) == before


def words(chance: random.Random, prefix: str, count: int) -> list[str]:
    return [f"{prefix}{chance.randrange(10**9)}\n" for _ in range(count)]


def changed(chance: random.Random, lines: list[str], prefix: str) -> list[str]:
    """The lines with some taken out and some put in."""
    kept = [line for line in lines if chance.random() > 0.15]
    for line in words(chance, prefix, chance.randrange(4)):
        kept.insert(chance.randrange(len(kept) + 1), line)
    return kept


@pytest.mark.parametrize("seed", range(300))
def test_no_line_that_either_side_put_in_is_ever_lost(seed: int) -> None:
    """Random texts: what either put in and what both left alone is in the result, and nothing comes from nowhere."""
    chance = random.Random(seed)
    base = words(chance, "base", chance.randrange(12))
    ours, theirs = changed(chance, base, "ours"), changed(chance, base, "theirs")
    kept = merge_edits("o.txt", "".join(base), "".join(ours), "".join(theirs), [])
    if kept.refused is not None:
        assert not ours
        return
    found = kept.text.splitlines(keepends=True)
    put_in = [line for line in (*ours, *theirs) if line not in base]
    alone = [line for line in base if line in ours and line in theirs]
    assert {*put_in, *alone} <= set(found)
    markers = {"<<<<<<< yours\n", "||||||| last generated\n", "=======\n", ">>>>>>> generated\n"}
    assert set(found) <= {*base, *ours, *theirs, *markers}
    conflict = any(f.rule == "RS511" for f in kept.findings)
    assert conflict == kept.save_old == bool(markers & set(found))
    if not conflict:
        assert len(found) == len(set(found)), "a line stands there twice"
        assert not [line for line in base if line not in (*ours, *theirs) and line in found], "what both took out is back"


def test_the_cases_of_the_issue_are_there() -> None:
    wanted = {
        "existing_output",
        "absent_region",
        "renamed_element",
        "duplicate_region",
        "broken_markers",
        "foreign_text",
        "deleted_file",
    }
    assert wanted <= set(NAMES)
