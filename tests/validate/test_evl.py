"""The EVL mirror beyond the engine's cases: declarations, several models, fixes one by one, reports, bad input."""

from __future__ import annotations

import json
from functools import partial
from typing import Any

import pytest

from robosmi.diagnostics import Location, Severity
from robosmi.errors import RuleError, UsageError
from robosmi.generate import Gen
from robosmi.model.elements.driver import UnknownTypeError
from robosmi.transform import ETL, Flock
from robosmi.validate import EVL, Fail, Fix
from tests.library import empty, library


def messages(v: EVL) -> list[str]:
    return [u.message for u in v.unsatisfied]


def test_a_context_takes_a_type_of_a_model_a_class_or_a_name() -> None:
    L = library()
    for kind in (L.Comic, L.type_named("Comic").python_class, L.type_named("Comic"), "Comic", "L!Comic", "library::Comic"):
        v = EVL(L)
        v.context(kind).constraint(name="C", message=lambda c: c.name)(lambda c: False)
        assert messages_of(v) == ["Zap"], kind


def messages_of(v: EVL) -> list[str]:
    v.run()
    return messages(v)


@pytest.mark.parametrize("beside", [False, True])
def test_two_constraints_of_one_name_about_one_type_are_refused_with_both_places(beside: bool) -> None:
    L = library()
    v = EVL(L)
    comics = v.context(L.Comic)

    @comics.constraint
    def is_told(comic: Any) -> bool:
        return bool(comic.name)

    def is_told_again(comic: Any) -> bool:
        return bool(comic.name)

    with pytest.raises(
        RuleError, match=r"there are two constraints 'is_told' of Comic, the other one at .*test_evl\.py:"
    ) as caught:
        (v.context(L.Comic) if beside else comics).critique(name="is_told")(is_told_again)
    assert caught.value.location is not None
    assert caught.value.location.path.endswith("test_evl.py")
    assert caught.value.fix == "rename one of them, or give it another name with name="


def test_a_name_may_return_in_another_type_in_a_context_with_a_guard_and_without_context() -> None:
    v = EVL(library())
    for made in (v.context("Comic"), v.context("Book"), v.context("Comic", guard=lambda comic: False)):
        made.constraint(name="told")(lambda element: True)
    v.constraint(name="told")(lambda: True)
    assert [constraint.name for constraint in v.declared()] == ["told"] * 4


@pytest.mark.parametrize("ask", [False, True])
def test_a_check_that_gives_a_text_is_refused(ask: bool) -> None:
    """`return holds or "message"` is true for every element: the constraint would never fail."""
    L = library()
    v = EVL(L)
    book = v.context(L.Book)

    @book.constraint(lazy=ask)
    def Dear(b: Any) -> Any:
        return b.price < 0 or f"{b.name} costs {b.price}"

    if ask:
        book.constraint(name="Asks")(lambda b: v.satisfies(b, "Dear"))
    with pytest.raises(RuleError, match=r"the check of Dear fails for .*: it gives the text 'Propellers costs .*\n.*Fail\("):
        v.run()


def generating(b: Any) -> Any:
    yield b.price < 0


async def waiting(b: Any) -> Any:
    return b.price < 0


NO_VERDICTS = [
    (lambda b: (b.price < 0, "too dear"), "a plain tuple"),
    (lambda b: b.price < 0 or ["too dear"], "a plain list"),
    (lambda b: {"price": b.price}, "a plain dict"),
    (lambda b: lambda: False, "the function '<lambda>', which was not called"),
    (lambda b: b.name.isupper, "the function 'isupper', which was not called"),
    (lambda b: Fail, "the class 'Fail', which was not called"),
    (generating, "a generator"),
    (waiting, "a coroutine"),
]


@pytest.mark.parametrize(("check", "given"), NO_VERDICTS)
def test_what_is_true_of_every_element_is_no_verdict(check: Any, given: str) -> None:
    L = library()
    v = EVL(L)
    v.context(L.Book).constraint(name="Dear")(check)
    with pytest.raises(RuleError, match=f"the check of Dear fails for .*: it gives {given}"):
        v.run()


@pytest.mark.parametrize(("guard", "given"), [*NO_VERDICTS, (lambda b: "no", "the text 'no'")])
def test_a_guard_gives_a_verdict_too(guard: Any, given: str) -> None:
    L = library()
    for options in ({"context": guard}, {"constraint": guard}):
        v = EVL(L)
        v.context(L.Book, guard=options.get("context")).constraint(name="Dear", guard=options.get("constraint"))(lambda b: True)
        with pytest.raises(RuleError, match=f"the guard of .*: it gives {given}"):
            v.run()
    G = empty("graph", "G")
    t = ETL(L, G)
    t.rule(L.Book, to=G.Node, name="Book2Node", guard=guard)(lambda b, n: None)
    with pytest.raises(RuleError, match=f"the guard of the rule Book2Node fails for .*: it gives {given}"):
        t.run()
    f = Flock(L, empty("graph", "N"), lenient=True)
    f.delete("Book", when=guard)
    with pytest.raises(RuleError, match=f"the guard of 'delete Book' fails for .*: it gives {given}"):
        f.run()


@pytest.mark.parametrize(
    ("module", "wrong", "right"),
    [(ETL, "shedule", "schedule"), (Flock, "kep_order", "keep_order"), (Flock, "lenint", "lenient"), (EVL, "contxts", "contexts"),
     (Gen, "ruls", "rules")],
)  # fmt: skip
def test_a_misspelt_setting_is_refused_with_the_nearest_name(module: Any, wrong: str, right: str) -> None:
    made = module(library(), empty("graph", "G")) if module is not Gen else Gen()
    with pytest.raises(UsageError, match=f"has no setting '{wrong}' .did you mean '{right}'"):
        setattr(made, wrong, "match")
    setattr(made, right, getattr(made, right))

    class Own(module):  # type: ignore[misc]
        """With an attribute of its own."""

    own = Own(library(), empty("graph", "G")) if module is not Gen else Own()
    own.seen = 1


def test_constraints_without_a_model_run_over_any() -> None:
    v = EVL()

    @v.context("Book").constraint
    def Dear(b: Any) -> Any:
        return b.price < 20 or Fail(b.name)

    first, second = library(), library()
    second.Book.all[0].price = 99.0
    assert [u.message for u in v.run(first).unsatisfied] == ["Boards", "Mills"]
    assert [u.message for u in v.run(second).unsatisfied] == ["Propellers", "Boards", "Mills"]
    assert [u.message for u in v.run(first.roots[0]).unsatisfied] == ["Boards", "Mills"]


def test_several_models_at_once() -> None:
    L, P = library("L"), empty("prices", "P")
    P.PriceList(prices=[P.Price(key="Zap", amount=3.5), P.Price(key="Nobody", amount=1.0)])
    v = EVL(L, P)

    @v.context(P.Price).constraint
    def OfAnItem(p: Any) -> Any:
        return L.Item.all.exists(lambda i: i.name == p.key) or Fail(f"no item {p.key}")

    @v.context(L.Comic).constraint
    def Priced(c: Any) -> Any:
        price = P.Price.all.select_one(lambda p: p.key == c.name)
        return price.amount == c.price or Fail(f"{c.name}: {c.price} or {price.amount}")

    result = v.run()
    assert [(u.name, u.message, result.place(u)) for u in result.unsatisfied] == [
        ("OfAnItem", "no item Nobody", "P!Price //@prices.1"),
        ("Priced", "Zap: 3.0 or 3.5", "L!Comic //@sections.1/@items.1"),
    ]


def test_a_class_context_covers_all_models_and_a_handle_its_own() -> None:
    first, second = library("A"), library("B")
    kind = first.type_named("Comic").python_class
    v = EVL(first, second)
    v.context(first.Comic).constraint(name="OfFirst")(lambda c: False)
    v.run()
    assert [v.result.place(u) for u in v.unsatisfied] == ["A!Comic //@sections.1/@items.1"]  # type: ignore[union-attr]
    assert kind is not second.type_named("Comic").python_class  # two loads do not mix


def test_guards_lazy_contexts_and_terminate() -> None:
    L = library()
    v = EVL(L)
    asked: list[str] = []
    lazy = v.context(L.Book, lazy=True)

    @lazy.constraint
    def Known(b: Any) -> Any:
        asked.append(b.name)
        return b.authors

    @v.context(L.Member).constraint(terminate=True)
    def Once(m: Any) -> Any:
        return Fail(m.name)

    @v.context(L.Comic).constraint
    def Asks(c: Any) -> Any:
        return v.satisfies(c, Known)

    v.run()
    assert asked == ["Zap"]
    assert messages(v) == ["Mia"]


def test_each_of_several_constraints_that_terminate_ends_for_itself() -> None:
    """One fails at an element where others before and after it fail as well, and one fails later."""
    L = library()
    v = EVL(L)
    names = [b.name for b in L.Book.all]
    assert len(names) >= 4
    book = v.context(L.Book)
    book.constraint(name="first", terminate=True)(lambda b: Fail(f"first {b.name}"))
    book.constraint(name="all")(lambda b: Fail(f"all {b.name}"))
    book.constraint(name="second", terminate=True)(lambda b: Fail(f"second {b.name}") if b.name != names[0] else True)
    book.constraint(name="third", terminate=True)(lambda b: Fail(f"third {b.name}") if b.name == names[2] else True)
    book.constraint(name="never", terminate=True)(lambda b: True)
    v.run()
    expected = [f"first {names[0]}", *(f"all {n}" for n in names), f"second {names[1]}", f"third {names[2]}"]
    assert sorted(messages(v)) == sorted(expected)


def test_satisfies_all_and_one_mean_what_they_say() -> None:
    L = library()
    v = EVL(L)
    book = v.context(L.Book)
    for name, answer in (("T", True), ("F", False)):
        book.constraint(name=name, lazy=True)(lambda b, answer=answer: answer)
    b = L.Book.all[0]
    assert [v.satisfies(b, *names) for names in ("T", "TF", "FT", "")] == [True, False, False, True]
    assert v.satisfies_all(b, "F", "T") is False
    assert [v.satisfies_one(b, *names) for names in ("FT", "TF", "FF")] == [True, True, False]
    assert v.satisfies(None, "T") is False


def test_severity_id_advice_and_location_become_findings() -> None:
    L = library()
    v = EVL(L)

    @v.context(L.Comic).critique(
        id="RS000", severity=Severity.error, advice="sell it", location=lambda c: Location("shelf.txt", c.year)
    )
    def Old(c: Any) -> Any:
        return Fail(f"{c.name} is old", year=c.year, author=c.authors[0])

    (finding,) = v.run().findings()
    assert finding.rule == "RS000"
    assert finding.severity is Severity.error
    assert finding.location == Location("shelf.txt", 2001)
    assert finding.element == "L!Comic //@sections.1/@items.1"
    assert finding.fix == "sell it"
    assert finding.evidence["year"] == 2001


def test_the_report_as_text_and_json() -> None:
    L = library()
    v = EVL(L)
    v.context(L.Comic).constraint(name="A", message="wrong", fixes=[Fix("mend it", lambda: None)])(lambda c: False)
    v.critique(name="B", info=True, message="look")(lambda: False)
    v.critique(name="C")(lambda: True)
    result = v.run(fix="first")
    assert not result
    assert result.text() == (
        "L!Comic //@sections.1/@items.1: error: wrong [A]\n  fix 1: mend it\ninfo: look [B]\nfixed A: mend it\n1 error, 1 info"
    )
    assert json.loads(json.dumps(result.to_json())) == {
        "unsatisfied": [
            {
                "constraint": "A", "context": "Comic", "kind": "error", "info": False, "severity": "error",
                "element": "L!Comic //@sections.1/@items.1", "message": "wrong", "extras": {}, "fixes": ["mend it"],
            },
            {
                "constraint": "B", "context": "<Global>", "kind": "critique", "info": True, "severity": "info", "element": None,
                "message": "look", "extras": {}, "fixes": [],
            },
        ],
        "fixed": [{"constraint": "A", "title": "mend it"}],
    }  # fmt: skip
    assert EVL(L).run().text() == "all constraints are satisfied"


def test_fixes_are_listed_and_applied_one_by_one() -> None:
    L = library()
    v = EVL(L)

    @v.context(L.Book).constraint
    def Cheap(b: Any) -> Any:
        def halve() -> None:
            b.price /= 2

        return b.price < 20 or Fail(
            None, Fix("halve", halve), Fix("give away", lambda: setattr(b, "price", 0.0), guard=b.price > 50)
        )

    found = v.run().unsatisfied
    assert [[f.title for f in u.fixes] for u in found] == [["halve"], ["halve", "give away"]]
    found[1].fixes[1].apply()
    assert (found[0].fixed, found[1].fixed) == (False, True)
    assert [b.price for b in L.Book.all] == [12.5, 20.0, 8.25, 3.0, 0.0]
    v.run(fix=lambda u: u.fixes[0])
    assert [b.price for b in L.Book.all] == [12.5, 10.0, 8.25, 3.0, 0.0]


def test_a_fix_that_raises_is_rolled_back_and_the_others_go_on() -> None:
    L = library()
    v = EVL(L)

    @v.context(L.Book).constraint
    def Alone(b: Any) -> Any:
        def work() -> None:
            b.tags.append("touched")
            b.authors.clear()
            L.Section.all[0].items.append(b)
            L.Author(name="new")
            L.delete(L.Member.all[0])
            if b.name == "Boards":
                raise ValueError("no")

        return Fail("x", Fix("work", work), guard=b) if b.name in ("Boards", "Ants") else True

    result = v.run(fix="first")
    assert [(a.title, a.error is None) for a in result.fixed] == [("work", False), ("work", True)]
    error = result.fixed[0].error
    assert error is not None
    assert "the fix 'work' of Alone fails for <Book name='Boards'" in str(error)
    assert "ValueError: no" in str(error)
    assert error.location is not None
    assert error.location.path.endswith("test_evl.py")
    boards, ants = (next(b for b in L.Book.all if b.name == n) for n in ("Boards", "Ants"))
    assert list(boards.tags) == ["spin"]
    assert [a.name for a in boards.authors] == ["Ben"]
    assert L.id_of(boards) == "/0/@sections.0/@items.0"  # the fix of Ants has added a second root
    assert "touched" in ants.tags
    assert [a.name for a in L.Author.all].count("new") == 1
    assert len(L.Member.all) == 1
    shown: Any = result.to_json()
    assert shown["fixed"][0]["error"] == error.message


def test_a_fix_applied_by_hand_that_raises_says_so() -> None:
    L = library()
    v = EVL(L)
    v.context(L.Comic).constraint(name="A", fixes=[Fix("misspell", lambda c: setattr(c, "nmae", "x"))])(lambda c: False)
    with pytest.raises(RuleError, match=r"fix 'misspell' of A fails for .*did you mean 'name'"):
        v.run().unsatisfied[0].fixes[0].apply()
    assert not v.unsatisfied[0].fixed


@pytest.mark.parametrize("what", ["check", "guard", "message", "context guard", "title", "fix guard", "pre"])
def test_what_raises_is_named_with_element_line_and_cause(what: str) -> None:
    L = library()
    v = EVL(L)

    def raising(*_: Any) -> Any:
        return dict[str, int]()["missing"]

    fine: dict[str, Any] = {"guard": None, "message": "m", "fixes": [Fix("t", lambda: None)]}
    places: dict[str, dict[str, Any]] = {
        "guard": {"guard": raising},
        "message": {"message": lambda x: raising()},
        "title": {"fixes": [Fix(raising, print)]},
        "fix guard": {"fixes": [Fix("t", print, guard=raising)]},
    }
    given = places.get(what, {})
    context = v.context(L.Comic, guard=(lambda c: raising()) if what == "context guard" else None)
    context.constraint(name="A", **{**fine, **given})((lambda c: raising()) if what == "check" else (lambda c: False))
    if what == "pre":
        v.pre.append(lambda: raising())
    with pytest.raises(RuleError, match="KeyError: 'missing'") as caught:
        v.run()
    text = str(caught.value)
    assert "test_evl.py:" in text
    assert "do: " in text
    if what != "pre":
        assert "<Comic name='Zap'" in text
        assert "//@sections.1/@items.1 of L" in text
    if what not in ("context guard", "pre"):
        assert " A " in text


def test_findings_before_an_error_remain_and_post_does_not_run() -> None:
    L = library()
    v = EVL(L)

    @v.context(L.Book).constraint
    def Short(b: Any) -> Any:
        if b.name == "Ants":
            raise OSError("disk")
        return Fail(b.name)

    done: list[int] = []
    v.post.append(lambda: done.append(1))
    with pytest.raises(RuleError, match=r"the check of Short fails for <Book name='Ants'.*OSError: disk"):
        v.run()
    assert messages(v) == ["Propellers", "Boards"]
    assert done == []


def test_an_unknown_constraint_is_refused_with_the_nearest() -> None:
    L = library()
    v = EVL(L)
    v.context(L.Book).constraint(name="HasAuthor")(lambda b: v.satisfies(b, "HasAutor"))
    with pytest.raises(RuleError, match="there is no constraint 'HasAutor' \\(did you mean 'HasAuthor'\\?\\)"):
        v.run()
    with pytest.raises(UsageError, match="'HasAuthor' is about Book, not about <Library"):
        v.satisfies(L.Library.all[0], "HasAuthor")


def test_constraints_that_ask_for_each_other_are_refused() -> None:
    L = library()
    v = EVL(L)
    book = v.context(L.Book)
    book.constraint(name="A")(lambda b: v.satisfies(b, "B"))
    book.constraint(name="B")(lambda b: v.satisfies(b, "A"))
    with pytest.raises(RuleError, match="ask for each other in a circle: B, A"):
        v.run()


def test_an_unknown_type_or_choice_is_refused() -> None:
    L = library()
    v = EVL(L)
    v.context("Bok").constraint(name="A")(lambda b: True)
    with pytest.raises(UnknownTypeError, match="did you mean 'Book'"):
        v.run()
    with pytest.raises(UsageError, match="fix='frist' is no choice"):
        EVL(L).run(fix="frist")


def test_modules_are_included_once_and_see_each_others_constraints() -> None:
    L = library()
    base, middle, top = EVL(L), EVL(L), EVL(L)
    order: list[str] = []
    for name, module in (("base", base), ("middle", middle), ("top", top)):
        module.pre.append(partial(order.append, name))
    base.context(L.Comic).constraint(name="Base", lazy=True)(lambda c: Fail("base failed"))
    middle.include(base)
    top.include(base)
    top.include(middle)
    top.context(L.Comic).constraint(name="Top")(lambda c: top.satisfies(c, "Base"))
    middle.context(L.Comic).constraint(name="Middle")(lambda c: middle.satisfies(c, "Base") or True)
    top.run()
    assert order == ["base", "middle", "top"]
    assert [u.name for u in top.unsatisfied] == ["Base", "Top"]


def test_a_chain_of_questions_may_be_as_long_as_the_model() -> None:
    L = library()
    library_element, length = L.Library.all[0], 3000
    above = L.Author.all[-1]
    for number in range(length):
        above = L.Author(name=f"a{number}", mentor=above)
        library_element.authors.append(above)
    v = EVL(L)
    asked: list[str] = []

    @v.context(L.Author, lazy=True).constraint
    def Known(a: Any) -> Any:
        asked.append(a.name)
        return a.mentor is None or v.satisfies(a.mentor, Known)

    assert v.satisfies(above, Known)
    assert asked == [*(f"a{n}" for n in range(length - 1, -1, -1)), "Cy"]


def test_a_mistake_in_the_place_of_a_constraint_is_told_with_its_line() -> None:
    v = EVL(library())
    v.context("Book").constraint(name="C", location=lambda b: Location(b.path))(lambda b: False)
    with pytest.raises(RuleError, match=r"the location of C fails for .*Book has no feature 'path'") as told:
        v.run().findings()
    assert str(told.value.location).partition(":")[0].endswith("test_evl.py")
