"""Queries as text: what an expression may say, and that nothing else of Python is within its reach."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import ModelError, RobosmiError, UsageError
from robosmi.model.emf import EmfModel
from robosmi.model.plain_xml import XmlModel
from robosmi.query.answers import as_json, as_lines
from robosmi.query.expression import NAMES, evaluate

CASE = Path(__file__).parents[1] / "model" / "drivers" / "cases" / "emf"


@pytest.fixture
def model() -> EmfModel:
    """A small model, called M."""
    return EmfModel.load(CASE / "shelf.xmi", CASE / "shelf.ecore", "M")


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("Book.all.name", ["Gears", "Zap", "Levers"]),
        ("Book.all_of_type.size()", 2),
        ("M.Book.all.size()", 3),
        ("Book.all.select(lambda b: b.pages > 50 and b.author.name == 'Ada').name", ["Gears"]),
        ("[b.name for b in Book.all if b.genre == Genre.science]", ["Zap"]),
        ("{b.name: b.pages for b in Book.all}", {"Gears": 120, "Zap": 48, "Levers": 90}),
        ("{b.genre.name for b in Book.all}", ["fiction", "science"]),
        ("Book.all.map_by(lambda b: b.author.name).key_set()", ["Ada", "Ben"]),
        ("Book.all.pages.sum() / Book.all.size()", 86.0),
        ("Shelf.all.first().books[0].name", "Gears"),
        ("Book.all.first().name.upper()[:3]", "GEA"),
        ("f'{Book.all.size()} books, {Book.all.first().pages:04d}'", "3 books, 0120"),
        ("Q([3, 1, 2]).sort_by(lambda x: -x)", [3, 2, 1]),
        ("Q(b.pages for b in Book.all).max()", 120),
        ("Tuple(a=1, b=Bag([1, 1])).b.size()", 2),
        ("call(Book.all, 'atLeastNMatch', lambda b: b.pages > 50, 2)", True),
        ("get(Book.all.first(), 'author').name", "Ada"),
        ("is_kind_of(Book.all[1], Comic), is_type_of(Book.all[1], Book)", [True, False]),
        ("Note.all.first().eContainer().name", "Gears"),
        ("id_of(Book.all.last())", "//@shelves.0/@books.0"),
        ("type_of(Book.all[1]).name", "Comic"),
        ("as_string([1, 'a'])", 'Sequence {1, "a"}'),
        ("Shelf.all.closure(lambda s: s.shelves).name", ["niche"]),
        ("(lambda x, *y, z=2: x + z)(1)", 3),
        ("None if Book.all.is_empty() else -1", -1),
        ("all_instances('M!shelf::Book').size()", 3),
        ("literal_named('Genre#novel').name", "fiction"),
        ("[_ * 2 for _ in [1]]", [2]),
        ("Book.all.lazy().select(lambda b: b.pages < 100).first().name", "Zap"),
        ("  Book.all.size()\n", 3),
        ("Book", "Book"),
    ],
)
def test_what_can_be_said(model: EmfModel, expression: str, value: Any) -> None:
    found = as_json(evaluate(expression, [model]))
    assert (sorted(found) if expression[:2] == "{b" and isinstance(found, list) else found) == value


ESCAPES = [
    "__import__('os').system('true')",
    "().__class__.__base__.__subclasses__()",
    "'{0.__class__}'.format(Book)",
    "'{0.__class__}'.format_map({'0': Book})",
    "f'{Book.all.__class__}'",
    "f'{1:{Book.all.__class__}}'",
    "(x for x in [1]).gi_frame.f_builtins",
    "[g.gi_frame.f_back.f_globals for g in [(x for x in [1])]]",
    "get((x for x in [1]), 'gi_frame')",
    "get_safe((x for x in [1]), 'gi_code')",
    "get_all([(x for x in [1])], 'gi_frame')",
    "Q([(x for x in [1])]).gi_frame",
    "Q([(x for x in [1])]).get('gi_frame')",
    "call((x for x in [1]), 'gi_frame')",
    "(lambda: 0).func_globals",
    "get(lambda: 0, '__globals__')",
    "get(println, '__globals__')",
    "println.__globals__['__builtins__']",
    "Q.mro()",
    "native_type(1).mro()",
    "native_type(native_type(1))('X', (), {})",
    "call(1, 'nativeType').mro()",
    "Book.all.first().eClass.python_class",
    "Book.all.first().eResource",
    "Book.all.eResource",
    "Book.all.get('eResource')",
    "Book.all.get('e_resource', 1)",
    "Book.all.get(name='eResource')",
    "Bag([Book.all.first()]).get('eResource')",
    "Q([1]).get('nativeType')",
    "Q(['eResource']).collect(Book.all.get)",
    "e_get(Book.all.first(), 'eResource')",
    "as_string(Book.all.get('eResource'))",
    "Book.all.first().listeners",
    "Book.all.first().dyn_inst",
    "Book.model.save('{evil}')",
    "M.save('{evil}')",
    "M.model.save('{evil}')",
    "M.path.write_text('x')",
    "get(M, 'path').with_name('evil').write_text('x')",
    "get(M, 'save')('{evil}')",
    "call(M, 'save', '{evil}')",
    "call(Book.all.first(), 'owningModel').save('{evil}')",
    "owning_model(Book.all.first())",
    "model_named('M')",
    "current_run()",
    "Run(M)",
    "operation(Book)",
    "strings.re",
    "anything.sys",
    "open('{evil}', 'w')",
    "eval('1')",
    "exec('x = 1')",
    "getattr(Book, 'model')",
    "type(Book)",
    "globals()",
    "help",
    "import os",
    "x = 1",
    "(x := 1)",
    "[x := 1]",
    "lambda: (yield)",
    "await Book",
    "print('x'); 1",
    "del Book",
    "Book.all; Book",
    "\n".join(["1", "2"]),
    "Book.all._items",
    "Book._of",
    "M._watch",
    "Book.all[0]._container",
    "call(Book.all, '_of', [1])",
    "get(Book.all, '_items')",
    "Q([1])._same",
    "__builtins__",
    "__name__",
]


@pytest.mark.parametrize("expression", ESCAPES)
def test_nothing_else_of_python_is_within_reach(model: EmfModel, tmp_path: Path, expression: str) -> None:
    evil = tmp_path / "evil.xmi"
    with pytest.raises(RobosmiError) as caught:
        as_json(evaluate(expression.replace("{evil}", str(evil)), [model]))
    assert caught.value.exit_code in (2, 3)
    assert list(tmp_path.iterdir()) == []
    assert (CASE / "evil").exists() is False


def test_no_name_gives_a_module_a_model_or_what_changes_one() -> None:
    modules = [name for name, value in NAMES.items() if type(value).__name__ == "module"]
    assert modules == []
    assert (
        NAMES.keys() & {"Run", "ModelView", "current_run", "model_named", "owning_model", "operation", "create", "delete"}
        == set()
    )


@pytest.mark.parametrize(
    ("expression", "said"),
    [
        ("", "not an expression"),
        ("Book.all.select(", "not an expression"),
        ("(" * 3000 + ")" * 3000, "not an expression|nested too deep"),
        ("+".join(["1"] * 20_000), "not an expression|nested too deep|fails"),
        ("a" + ".b" * 20_000, "not an expression|nested too deep|unknown"),
        ("\0", "not an expression"),
        ("Boook.all", r"the name 'Boook' is unknown \(did you mean 'Book'\?\)"),
        ("Book.all.nmae", "did you mean 'name'"),
        ("Book.all.slect(lambda b: b)", "slect"),
        ("Book.all.select(lambda b: False).notEmpty()", "a collection cannot be called"),
        ("Book.al", "did you mean 'all'"),
        ("Genre.poetry", "there is no type 'Genre#poetry'"),
        ("1 / 0", "ZeroDivisionError"),
        ("Book.all.first().author.name + 1", "TypeError"),
        ("None.name", "AttributeError"),
        ("Book.all.select(lambda: True)", "TypeError"),
        ("(lambda f: f(f))(lambda f: f(f))", "calls itself too often"),
        ("len(Book.all)", "the name 'len' is unknown"),
        ("lambda: 1", "a function or type"),
        ("M", "a model"),
        ("10 ** 5000", "more than 4000 digits"),
        ("(lambda f, n: f(f, n))(lambda f, n: [f(f, n - 1)] if n else 1, 200)", "nested deeper"),
    ],
)
def test_a_mistake_is_said_with_what_to_do(model: EmfModel, expression: str, said: str) -> None:
    with pytest.raises(RobosmiError, match=said) as caught:
        as_json(evaluate(expression, [model]))
    assert caught.value.fix
    assert isinstance(caught.value, (UsageError, ModelError))


def test_the_first_model_that_has_a_type_gives_it_and_a_type_comes_before_a_function(model: EmfModel) -> None:
    other = XmlModel.parse(b"<Book><size/></Book>", "X")
    assert evaluate("Book.all.size()", [model, other]) == 3
    assert evaluate("t_Book.all.size() + M.Book.all.size() + X.t_size.all.size()", [model, other]) == 5


def test_values_are_json_and_lines(model: EmfModel) -> None:
    book = {"type": "Book", "id": "//@books.0", "name": "Gears"}
    assert as_lines([book, 1, True, None, 1.5, "x", [1, "a"], {"k": book}]) == [
        "Book //@books.0 Gears", "1", "true", "", "1.5", "x", "[1, a]", "{k: Book //@books.0 Gears}",
    ]  # fmt: skip
    assert as_lines({"a": 1}) == ["a: 1"]
    assert as_lines(book) == ["Book //@books.0 Gears"]
    assert as_json(evaluate("[1.0e308 * 10, Map({(1, 2): 3}), Note.all.key, Genre.fiction]", [model])) == [
        "Infinity", [[[1, 2], 3]], ["n1"], "fiction",
    ]  # fmt: skip
