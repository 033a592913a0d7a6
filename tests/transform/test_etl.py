"""The ETL mirror beyond the engine's cases: types in all forms, schedules, modules, models of other technologies, bad input."""

from __future__ import annotations

from functools import wraps
from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import RuleError, UsageError
from robosmi.metamodels import ccode, trace
from robosmi.model.elements.driver import UnknownTypeError
from robosmi.model.opening import open_model
from robosmi.query import ModelView
from robosmi.transform import ETL
from tests.library import LIBRARY, empty, library

FORMS = {
    "handles in the decorator": "lambda L, G: (L.Comic, [G.Node])",
    "names": "lambda L, G: ('Comic', ['Node'])",
    "qualified names": "lambda L, G: ('L!Comic', 'G!Node')",
    "classes": "lambda L, G: (L.type_named('Comic').python_class, G.type_named('Node').python_class)",
}


@pytest.mark.parametrize("form", FORMS)
def test_types_are_given_in_the_decorator(form: str) -> None:
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G)
    source, targets = eval(FORMS[form])(L, G)

    @t.rule(source, to=targets)
    def C(c: Any, n: Any) -> None:
        n.label = c.name

    t.run()
    assert [n.label for n in G.Node.all] == ["Zap"]


ANNOTATED = """
{first}
def make(ETL, L, G):
    t = ETL(L, G)

    @t.rule
    def C(c: L.Comic, n: G.Node):
        n.label = c.name

    @t.rule(lazy=True)
    def T(s: str, n: G.Note):
        n.text = s

    t.post.append(lambda: t.equivalent("x"))
    return t
"""


@pytest.mark.parametrize("first", ["", "from __future__ import annotations"], ids=["objects", "texts"])
def test_types_are_given_as_annotations(first: str) -> None:
    L, G = library("L"), empty("graph", "G")
    scope: dict[str, Any] = {}
    exec(compile(ANNOTATED.format(first=first), __file__, "exec", dont_inherit=True), scope)
    scope["make"](ETL, L, G).run()
    assert [n.label for n in G.Node.all] == ["Zap"]
    assert [n.text for n in G.Note.all] == ["x"]


def test_generated_classes_are_types_and_root_elements_models() -> None:
    program = ccode.Program(units=[ccode.SourceUnit(path="a.c"), ccode.SourceUnit(path="b.c")])
    t = ETL(program)

    @t.rule
    def Unit2Text(unit: ccode.SourceUnit, text: trace.TextTrace) -> None:
        text.path = unit.path

    made = t.run()
    assert [x.path for unit in program.units for x in made.equivalents(unit)] == ["a.c", "b.c"]


def test_a_model_of_another_technology_is_a_source(tmp_path: Path) -> None:
    (tmp_path / "prices.csv").write_text("key,amount\nZap,3.5\nAnts,8\n", encoding="utf-8")
    P, G = ModelView(open_model(tmp_path / "prices.csv", name="P")), empty("graph", "G")
    kind = P.type_names()[0]
    t = ETL(P, G)

    @t.rule(P[kind], to=G.Note)
    def Row2Note(row: Any, n: Any) -> None:
        n.text = f"{row.key}={row.amount}"

    t.run()
    assert [n.text for n in G.Note.all] == ["Zap=3.5", "Ants=8"]
    assert t.trace.origins(G.Note.all[1])[0].key == "Ants"


def two_authors(schedule: str) -> tuple[list[str], ETL]:
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G, schedule=schedule)
    order: list[str] = []

    def not_ben(a: Any) -> bool:
        order.append(f"guard {a.name}")
        return bool(a.name != "Ben")

    @t.rule(L.Author, to=G.Node, guard=not_ben)
    def A(a: Any, n: Any) -> None:
        order.append(a.name)

    t.run()
    return order, t


def test_the_schedule_can_be_chosen() -> None:
    match, demand = two_authors("match")[0], two_authors("demand")[0]
    assert match == ["guard Ada", "guard Ben", "guard Cy", "Ada", "Cy"]
    assert demand == ["guard Ada", "Ada", "guard Ben", "guard Cy", "Cy"]
    assert two_authors("auto")[0] == match


def test_a_rule_that_extends_a_concrete_one_applies_whoever_was_asked_first() -> None:
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G, schedule="demand")

    @t.rule(L.Library, to=G.Graph)
    def Asks(library: Any, g: Any) -> None:
        t.set(g, nodes=L.Comic.all)

    @t.rule(L.Book, to=G.Node)
    def Base(b: Any, n: Any) -> None:
        n.label = b.name

    @t.rule(L.Comic, to=G.Node, extends=Base)
    def Own(c: Any, n: Any) -> None:
        n.weight = 7

    t.run()
    assert [(n.label, n.weight) for n in G.Graph.all[0].nodes] == [("Zap", 7)]


def test_a_base_of_two_bases_runs_once() -> None:
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G)
    for name, bases in (("Base", []), ("Left", ["Base"]), ("Right", ["Base"])):

        @t.rule(L.Named, to=G.Element, abstract=True, extends=bases, name=name)
        def body(x: Any, e: Any, name: str = name) -> None:
            e.label = f"{e.label or ''}{name} "

    @t.rule(L.Comic, to=G.Node, extends=["Left", "Right"])
    def Own(c: Any, n: Any) -> None:
        n.label += "Own"

    t.run()
    assert [n.label for n in G.Node.all] == ["Base Left Right Own"]


def test_modules_are_included() -> None:
    L, G = library("L"), empty("graph", "G")
    base, top = ETL(L, G), ETL(L, G)
    order: list[str] = []
    base.pre.append(lambda: order.append("pre base"))
    top.pre.append(lambda: order.append("pre top"))

    @base.rule(L.Author, to=G.Node)
    def A(a: Any, n: Any) -> None:
        order.append(f"A {a.name}")

    @top.rule(L.Comic, to=G.Group)
    def C(c: Any, g: Any) -> None:
        top.set(g, members=c.authors)
        assert base.equivalent(c.authors[0]) is g.members[0]

    top.include(base)
    made = top.run()
    assert order[:2] == ["pre base", "pre top"]
    assert base.trace is made
    assert len(G.Group.all[0].members) == 2


def test_unknown_rules_are_asked_for_with_a_warning() -> None:
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G)

    @t.rule(L.Author, to=G.Node)
    def Author2Node(a: Any, n: Any) -> None:
        assert t.equivalent(a, "Autor2Node") is None
        assert t.equivalent(a, Author2Node) is n

    t.run()
    assert t.warnings == ["equivalents are requested of 'Autor2Node', which is no rule (did you mean 'Author2Node'?)"]


def fails(t: ETL, text: str) -> str:
    with pytest.raises(RuleError, match=text) as caught:
        t.run()
    assert "test_etl.py:" in str(caught.value)
    assert "do: " in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize("schedule", ["match", "demand"])
@pytest.mark.parametrize("what", ["body", "guard", "base", "init", "pre", "post"])
def test_what_raises_is_named_with_element_line_and_cause(what: str, schedule: str) -> None:
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G, schedule=schedule)

    def raising(*_: Any) -> Any:
        return [][0]

    def nothing(*_: Any) -> None: ...

    t.rule(L.Named, to=G.Element, abstract=True, name="Base")(lambda x, e: raising() if what == "base" else None)
    t.rule(
        L.Comic, to=G.Node, extends="Base", name="Own", guard=raising if what == "guard" else None,
        init={"n": raising} if what == "init" else None,
    )(lambda c, n: raising() if what == "body" else None)  # fmt: skip
    t.pre.append(raising if what == "pre" else nothing)
    t.post.append(raising if what == "post" else nothing)
    text = fails(t, "IndexError: list index out of range")
    name = {"base": "Base", "pre": "the pre block", "post": "the post block"}.get(what, "Own")
    assert name in text
    assert ("<Comic name='Zap'" in text and "//@sections.1/@items.1 of L" in text) == (what not in ("pre", "post"))


def test_a_wrong_feature_is_named_with_the_nearest() -> None:
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G)
    t.rule(L.Comic, to=G.Node, name="C")(lambda c, n: t.set(n, lable=c))
    fails(t, "the rule C fails for <Comic name='Zap'.*has no feature 'lable' \\(did you mean 'label'")


def test_a_cyclic_extends_is_refused_before_anything_runs() -> None:
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G)
    for name, base in (("A", "B"), ("B", "C"), ("C", "A")):
        t.rule(L.Book, to=G.Node, name=name, extends=base)(lambda b, n: None)
    t.pre.append(lambda: pytest.fail("ran"))
    fails(t, "the rule A extends itself: A extends B extends C extends A")
    assert list(G.Node.all) == []


@pytest.mark.parametrize(
    ("rule", "text"),
    [
        (
            lambda t, L, G: t.rule(L.Book, to=G.Node, extends="Bse")(lambda b, n: None),
            "extends 'Bse', which is no rule.*did you mean 'Base'",
        ),
        (lambda t, L, G: t.rule(L.Book, to=G.Node, name="Base")(lambda b, n: None), "the rule Base is there twice"),
        (lambda t, L, G: t.rule(L.Book, to=G.Edge, extends="Base", name="X")(lambda b, n: None), None),
        (
            lambda t, L, G: t.rule(L.Book, to=[G.Node], extends="Two", name="X")(lambda b, n: None),
            "extends Two, which has 2 targets, but has 1 itself",
        ),
        (lambda t, L, G: t.rule(L.Book, to=str, name="X")(lambda b, n: None), "cannot make 'n': str is no type of a model"),
    ],
)
def test_rules_that_do_not_fit_together_are_refused(rule: Any, text: str | None) -> None:
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G)
    t.rule(L.Book, to=G.Node, name="Base")(lambda b, n: None)
    t.rule(L.Book, to=[G.Node, G.Node], abstract=True, name="Two")(lambda b, n, m: None)
    rule(t, L, G)
    if text is None:
        t.run()
    else:
        fails(t, text)
        assert len(t.trace) == 0


def test_rules_without_types_are_refused_where_they_stand() -> None:
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G)
    with pytest.raises(RuleError, match=r"test_etl.py:\d+: the rule X does not say of which type 'n' is"):
        t.rule(L.Book, name="X")(lambda b, n: None)
    with pytest.raises(RuleError, match="the rule X has 2 target types and 1 parameter"):
        t.rule(L.Book, to=[G.Node, G.Node], name="X")(lambda b, n: None)
    with pytest.raises(RuleError, match="the rule X has no source"):
        t.rule(L.Book, name="X")(lambda: None)
    with pytest.raises(RuleError, match="initial value for 'm', which is no target"):
        t.rule(L.Book, to=G.Node, name="X", init={"m": lambda b: None})(lambda b, n: None)


def test_wrong_schedules_are_refused() -> None:
    with pytest.raises(UsageError, match="no schedule 'mach' \\(did you mean 'match'"):
        ETL(schedule="mach")
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G, schedule="match")
    t.rule(L.Book, to=G.Node, lazy=True, name="Z")(lambda b, n: None)
    fails(t, "the rule Z is lazy, and the schedule 'match' runs no lazy rule")
    with pytest.raises(UsageError, match="before the transformation runs"):
        ETL().equivalent(L.Book.all[0])


def test_an_unknown_type_is_refused() -> None:
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G)
    t.rule("L!Bok", to=G.Node, name="X")(lambda b, n: None)
    with pytest.raises(UnknownTypeError, match="did you mean 'Book'"):
        t.run()


def test_a_failed_run_leaves_the_files_alone(tmp_path: Path) -> None:
    source = tmp_path / "library.xmi"
    source.write_bytes((LIBRARY / "library.xmi").read_bytes())
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G)
    t.rule(L.Book, to=G.Node, name="X")(lambda b, n: 1 / 0)
    fails(t, "ZeroDivisionError")
    assert [p.name for p in tmp_path.iterdir()] == ["library.xmi"]


@pytest.mark.parametrize("schedule", ["match", "demand"])
def test_a_chain_of_equivalents_may_be_as_long_as_the_model(schedule: str) -> None:
    L, G = library("L"), empty("graph", "G")
    library_element, above = L.Library.all[0], L.Author.all[-1]
    for number in range(3000):
        above = L.Author(name=f"a{number}", mentor=above)
        library_element.authors.insert(0, above)
    t = ETL(L, G, schedule=schedule)

    @t.rule(L.Author, to=G.Group)
    def A(a: Any, g: Any) -> None:
        t.set(g, main=a.mentor)
        g.weight = 1 if g.main is None else g.main.weight + 1  # the target of the element above exists already

    t.run()
    assert t.equivalent(above).weight == 3001
    assert [link.source.name for link in t.trace][:2] == ["a2999", "a2998"]


def test_what_raises_deep_down_is_named_once() -> None:
    L, G = library("L"), empty("graph", "G")
    library_element, above = L.Library.all[0], L.Author.all[-1]
    for number in range(300):
        above = L.Author(name=f"a{number}", mentor=above)
        library_element.authors.insert(0, above)
    t = ETL(L, G)

    @t.rule(L.Author, to=G.Group)
    def A(a: Any, g: Any) -> None:
        if a.name == "Cy":
            raise OSError("no")
        t.set(g, main=a.mentor)

    assert fails(t, "OSError: no").count("the rule A fails for <Author name='Cy'") == 1


def test_a_target_of_a_class_that_no_model_has_is_in_no_model() -> None:
    L = library("L")
    count = len(list(L.all_contents()))
    t = ETL(L, step="second")

    @t.rule
    def C(c: L.Comic, text: trace.TextTrace) -> None:  # type: ignore[name-defined]
        text.path = c.name

    made = t.run()
    assert [x.path for link in made for x in link.targets] == ["Zap"]
    assert [link.step for link in made] == ["second"]
    assert len(list(L.all_contents())) == count


def test_parameters_with_defaults_are_no_targets_and_wrapped_functions_count_as_they_are_written() -> None:
    L, G = library("L"), empty("graph", "G")
    t = ETL(L, G)

    @t.rule(name="First")
    def first(c: L.Comic, n: G.Node, mark: str = "!") -> None:  # type: ignore[name-defined]
        n.label = c.name + mark

    def second(c: L.Comic, n: G.Node) -> None:  # type: ignore[name-defined]
        n.label = c.name

    wrapped: Any = wraps(second)(lambda *given: second(*given))
    t.rule(wrapped)
    t.run()
    assert [n.label for n in G.Node.all] == ["Zap!", "Zap"]
