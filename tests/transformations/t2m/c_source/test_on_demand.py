"""The C program as a model on demand: the same answers as the stored model, and nothing built that no query asks for."""

from __future__ import annotations

import gc
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import ModelError, SourceError
from robosmi.metamodels import ccode
from robosmi.model.elements.driver import ReadOnlyError
from robosmi.model.elements.strict import Element
from robosmi.model.elements.structure import feature_names
from robosmi.model.opening import open_model
from robosmi.model.xmi.xmi_writer import to_xmi
from robosmi.query import ModelView
from robosmi.transformations.queries import code
from robosmi.transformations.t2m.c_source import read_program
from robosmi.transformations.t2m.c_source.on_demand import OnDemandProgram, open_program
from tests.new_objects import only_new_objects

ROOT = Path(__file__).resolve().parents[4]
PROGRAMS = [
    *sorted((ROOT / "docs" / "examples").rglob("*.c")),
    *[path for path in sorted((ROOT / "tests").rglob("*.c")) if path.stat().st_size < 40_000][::4],
]
"""The case studies, and every fourth program of the tests; `tests/fuzz/two_views.py` compares all, and a corpus."""
ROBOT = ROOT / "tests" / "model" / "drivers" / "cases" / "program" / "robot.c"


def built() -> set[str]:
    """The classes of the elements of C programs that the test has built and that still exist."""
    gc.collect()
    return {type(x).__name__ for x in gc.get_objects() if isinstance(x, Element) and type(x).__module__ == ccode.__name__}


@pytest.fixture
def nothing_old() -> Iterator[None]:
    """Lets `built` see only what the test has built."""
    with only_new_objects():
        yield


def looked_at(model: OnDemandProgram) -> ccode.Program:
    """The program, after reading every feature of every element."""
    for element in list(model.all_contents()):
        for name in feature_names(element.eClass):
            getattr(element, name)
    return model.program


def programs() -> Iterator[tuple[Path, ccode.Program]]:
    """The programs that are C at all, and their models read as a whole."""
    for path in PROGRAMS:
        try:
            yield path, read_program(path)[0]
        except SourceError:
            continue


def test_it_is_the_stored_model_byte_for_byte_in_whatever_order_it_is_asked() -> None:
    compared = 0
    kinds = [ccode.If, ccode.Call, ccode.NameReference, ccode.Variable, ccode.TypeUse, ccode.MacroUse, ccode.Function, ccode.For]
    for path, stored in programs():
        chance = random.Random(path.name)
        model = open_program(path)
        for kind in chance.sample(kinds, 3):
            found = model.all_of_kind(kind)
            for element in chance.sample(found, min(4, len(found))):
                for name in chance.sample(feature_names(element.eClass), 3):
                    getattr(element, name)
        assert to_xmi({"m": looked_at(model)}) == to_xmi({"m": stored}), path
        model.close()
        compared += 1
    assert compared > 20


def test_several_files_are_one_program(tmp_path: Path) -> None:
    (tmp_path / "a.c").write_text('#include "b.h"\nint main(void) { return twice(4); }\n')
    (tmp_path / "b.c").write_text("int twice(int x) { return 2 * x; }\n")
    (tmp_path / "b.h").write_text("int twice(int x);\n")
    paths = [tmp_path / "a.c", tmp_path / "b.c"]
    model = open_program(paths)
    call = model.Call.all[0]
    assert call.callee.eContainer() is model.program.units[1]
    assert not model._linked  # the program's own function was found without the rest
    stored, _ = read_program(paths)
    assert to_xmi({"m": looked_at(model)}) == to_xmi({"m": stored})


@pytest.mark.usefixtures("nothing_old")
def test_nothing_is_parsed_before_it_is_asked_for() -> None:
    model = open_program(ROBOT)
    assert [unit.path for unit in model.SourceUnit.all] == [str(ROBOT)]
    assert model.program.units[0].digest
    assert model._units[0]._parsed is None
    assert built() == {"Program", "SourceUnit"}


EXPRESSIONS = {"Assignment", "Binary", "Call", "NameReference"}
"""What is built for statements, too: an expression may hold some (GNU C's statement expressions)."""


@pytest.mark.usefixtures("nothing_old")
@pytest.mark.parametrize(
    ("kind", "needed"),
    [
        ("Include", {"Include"}),
        ("Macro", {"Macro"}),
        ("Comment", set()),
        (
            "If",
            {
                "Function",
                "Variable",
                "Block",
                "If",
                "While",
                "Return",
                "DeclarationStatement",
                "ExpressionStatement",
                "Parameter",
                *EXPRESSIONS,
            },
        ),
        (
            "While",
            {
                "Function",
                "Variable",
                "Block",
                "If",
                "While",
                "Return",
                "DeclarationStatement",
                "ExpressionStatement",
                "Parameter",
                *EXPRESSIONS,
            },
        ),
    ],
)
def test_only_what_can_hold_what_is_asked_for_is_built(kind: str, needed: set[str]) -> None:
    model = open_program(ROBOT)
    assert len(model[kind].all) == {"Include": 1, "Macro": 1, "Comment": 0, "If": 2, "While": 1}[kind]
    assert built() - {"Program", "SourceUnit"} == needed
    assert not model._linked


@pytest.mark.usefixtures("nothing_old")
def test_leaves_are_not_built_to_find_out_what_they_are() -> None:
    model = open_program(ROBOT)
    assert len(model.Call.all) == 5
    assert not built() & {"IntegerLiteral", "TypeUse", "MacroUse", "Include"}


@pytest.mark.usefixtures("nothing_old")
def test_an_id_builds_only_the_way_to_its_element() -> None:
    model = open_program(ROBOT)
    element = model.element("//@units.0/@declarations.1/@body/@statements.0/@condition")
    assert isinstance(element, ccode.Binary)
    assert model.id_of(element) == "//@units.0/@declarations.1/@body/@statements.0/@condition"
    assert not built() & {"While", "Call", "NameReference"}


def test_what_was_built_stays() -> None:
    model = open_program(ROBOT)
    first = model.Call.all[0]
    assert model.Call.all[0] is first
    assert first.eContainer() is first.eContainer()
    assert first.arguments[0] is first.arguments[0]
    list(model.all_contents())
    _ = model.program.externals[0]
    assert model.Call.all[0] is first
    assert first.callee.calls[0] is first


def test_a_local_name_is_found_without_the_rest_of_the_program() -> None:
    model = open_program(ROBOT)
    reference = next(x for x in model.NameReference.all if x.name == "reading")
    assert isinstance(reference.target, ccode.Variable)
    assert isinstance(reference.target.initializer, ccode.IntegerLiteral)
    assert reference.target.initializer.value == 0
    assert not model._linked


def test_the_queries_of_the_application_run_on_it() -> None:
    model = open_program(ROBOT)
    stored, _ = read_program(ROBOT)
    for name in ("functions", "calls"):
        query = getattr(code, name, None)
        if query is not None:
            assert len(query(model.program)) == len(query(stored)) > 0
    view = ModelView(model)
    ours = view.Call.all.select(lambda c: c.callee.linkage is ccode.Linkage.defined).calleeName
    assert ours == ["clamp"]


def refusals(model: OnDemandProgram) -> list[Any]:
    """Everything that would change the model."""
    call, function = model.Call.all[0], model.Function.all[0]
    return [
        lambda: setattr(call, "calleeName", "x"),
        lambda: setattr(call, "arguments", []),
        lambda: setattr(call, "callee", function),
        lambda: setattr(function, "body", None),
        lambda: setattr(function, "comment", "x"),
        lambda: call.arguments.append(ccode.IntegerLiteral()),
        lambda: call.arguments.remove(call.arguments[0]),
        lambda: call.arguments.clear(),
        lambda: function.calls.append(call),
        lambda: function.parameters.insert(0, ccode.Parameter()),
        lambda: model.program.languages.append("x"),
        lambda: model.program.units.pop(),
        lambda: call.eSet("line", 3),
        lambda: call.delete(),
    ]


@pytest.mark.parametrize("linked", [False, True])
@pytest.mark.parametrize("number", range(14))
def test_every_change_of_an_element_is_refused(number: int, linked: bool) -> None:
    model = open_program(ROBOT)
    if linked:
        looked_at(model)
    before = [model.id_of(x) for x in model.all_contents()] if linked else None
    with pytest.raises(ReadOnlyError, match="read-only") as caught:
        refusals(model)[number]()
    assert caught.value.fix
    stored, _ = read_program(ROBOT)
    assert to_xmi({"m": looked_at(model)}) == to_xmi({"m": stored})
    assert before is None or before == [model.id_of(x) for x in model.all_contents()]


def test_a_closed_program_says_so() -> None:
    model = open_program(ROBOT)
    first = model.Function.all[0]
    model2 = open_program(ROBOT)
    assert len(model2.Include.all) == 1
    function = model2.program.units[0].declarations[1]
    assert isinstance(function, ccode.Function)
    model2.close()
    with pytest.raises(ModelError, match="was closed"):
        _ = function.body
    assert first.name == "clamp"


def test_a_file_that_is_no_c_is_refused_when_it_is_parsed(tmp_path: Path) -> None:
    (tmp_path / "page.c").write_text("<html><body>no</body></html>")
    model = open_model(tmp_path / "page.c")
    with pytest.raises(SourceError, match="C source text"):
        list(model.all_contents())
