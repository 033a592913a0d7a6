"""A rule of any language that exits the program is an error of that rule, with its place; its exit code is ignored."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import RuleError
from robosmi.generate import Gen
from robosmi.transform import ETL, Flock
from robosmi.validate import EVL, Fix
from tests.library import empty, library


def ends(*_: Any) -> Any:
    sys.exit(0)


def checked(part: str) -> None:
    L = library()
    v = EVL(L)
    if part in ("pre", "post"):
        getattr(v, part).append(ends)
    context = v.context(L.Comic, guard=ends if part == "guard of a context" else None)
    options: dict[str, Any] = {"guard": ends} if part == "guard" else {"message": ends} if part == "message" else {}
    if part in ("title", "fix"):
        options["fixes"] = [Fix(ends if part == "title" else "mend", ends)]
    context.constraint(name="C", **options)(ends if part == "check" else lambda c: False)
    for unsatisfied in v.run().unsatisfied:
        assert part in ("title", "fix"), "another part has ended the run"
        for fix in unsatisfied.fixes:
            fix.apply()


def transformed(part: str) -> None:
    L, G = library(), empty("graph", "G")
    t = ETL(L, G)
    if part in ("pre", "post"):
        getattr(t, part).append(ends)
    t.rule(L.Comic, to=[G.Node], name="R", guard=ends if part == "guard" else None)(
        lambda c, n: ends() if part == "body" else None
    )
    t.run()


def migrated(part: str) -> None:
    f = Flock(library("Old"), library("New"))
    if part in ("pre", "post"):
        getattr(f, part).append(ends)
    f.delete("Comic", when=ends if part == "guard" else lambda c: False)
    f.migrate("Book")(lambda old, new: ends() if part == "body" else None)
    f.run()


def generated(part: str, folder: Path) -> None:
    L = library()
    g = Gen(folder / "out", {"t": "{{ f() }}"}, [L])
    if part in ("pre", "post"):
        getattr(g, part).append(ends)
    target: Any = ends if part == "target" else "a.txt"
    g.rule(L.Comic, template="t", target=target, guard=ends if part == "guard" else True)(
        lambda c: ends() if part == "body" else {"f": ends if part == "template" else str}
    )
    g.run()


RUNS: list[tuple[Callable[..., None], list[str]]] = [
    (checked, ["pre", "post", "guard of a context", "guard", "check", "message", "title", "fix"]),
    (transformed, ["pre", "post", "guard", "body"]),
    (migrated, ["pre", "post", "guard", "body"]),
    (generated, ["pre", "post", "guard", "target", "body", "template"]),
]


@pytest.mark.parametrize(("run", "part"), [(run, part) for run, parts in RUNS for part in parts])
def test_a_part_that_ends_the_program_is_an_error_of_its_rule(run: Callable[..., None], part: str, tmp_path: Path) -> None:
    with pytest.raises(RuleError, match="SystemExit") as raised:
        run(part, tmp_path) if run is generated else run(part)
    assert raised.value.exit_code == 3
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("error", [SystemExit(0), KeyboardInterrupt()])
def test_a_fix_that_is_broken_off_leaves_the_model_as_it_was(error: BaseException) -> None:
    L = library()

    def half(c: Any) -> None:
        c.name = "half"
        raise error

    v = EVL(L)
    v.context(L.Comic).constraint(name="C", fixes=[Fix("mend", half)])(lambda c: False)
    (unsatisfied,) = v.run().unsatisfied
    with pytest.raises(RuleError if isinstance(error, SystemExit) else KeyboardInterrupt):
        unsatisfied.fixes[0].apply()
    assert [c.name for c in L.Comic.all] == ["Zap"]
