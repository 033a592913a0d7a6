"""Named queries: functions of the content and of plug-ins that an expression of `robosmi query` calls by name."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from robosmi import plugins
from robosmi.errors import ModelError, RobosmiError, RuleError, UsageError
from robosmi.model.opening import open_model
from robosmi.plugin_contracts import KINDS
from robosmi.plugins import Registry
from robosmi.query import ModelView, expression
from robosmi.query.answers import as_json
from robosmi.query.expression import NAMES, evaluate, named_queries
from tests.running import run

CASES = Path(__file__).parents[1] / "model" / "drivers" / "cases"
PROGRAM = CASES / "program" / "robot.c"


def titles(table: ModelView) -> list[str]:
    return [row.title for row in table["books"].all]


def lazily(table: ModelView) -> Iterator[str]:
    yield from titles(table)


def books() -> str:
    return "not the type"


def flag() -> object:
    return object()


def broken(table: ModelView) -> int:
    return len(None)  # type: ignore[arg-type]


def missing(name: str) -> str:
    raise UsageError(f"nothing is called {name}", fix="use another name")


NEW = {"titles": titles, "lazily": lazily, "books": books, "flag": flag, "broken": broken, "missing": missing, "floor": flag}


@pytest.fixture(autouse=True)
def offered(monkeypatch: pytest.MonkeyPatch) -> None:
    mine, known = Registry(), Registry()
    for name, query in NEW.items():
        mine.add("named query", name, f"{__name__}:{query.__name__}")
    mine.add("named query", "gone", f"{__name__}:no_such_query")
    known.take(mine, "shelves 1.0")
    filled = cache(lambda: known)
    filled()
    for module in (plugins, expression):
        monkeypatch.setattr(module, "registry", filled)


def value(text: str) -> Any:
    return evaluate(text, [open_model(CASES / "rows", name="M")], as_json, named_queries())


@pytest.mark.parametrize("query", ["titles", "lazily"])
def test_a_list_can_be_queried_on(query: str) -> None:
    assert value(f"{query}(M).select(lambda t: t.startswith('G')).size()") == 1


def test_a_type_and_a_function_of_the_language_come_before_a_named_query() -> None:
    assert "floor" in NAMES
    assert value("floor(2.5)") == 2
    assert value("books.all.title.first()") == "Gears"


def test_a_lambda_may_pass_a_named_query_its_items() -> None:
    assert value("Q([M]).collect(lambda m: titles(m).size())") == [3]


@pytest.mark.parametrize(("text", "kind", "said"), [
    ("flag()", RuleError, "the named query 'flag' of the plug-in shelves 1.0 gives <object"),
    ("titles()", UsageError, "titles cannot be called so"),
    ("broken(M)", RuleError, "raised TypeError: object of type 'NoneType'"),
    ("missing('x')", UsageError, "nothing is called x"),
    ("title(M)", UsageError, "did you mean 'titles'"),
    ("gone()", RobosmiError, "cannot be loaded"),
    ("titles.__globals__", UsageError, "__globals__"),
    ("titles.func", UsageError, "may not look into a partial"),
    ("titles", UsageError, "the value is a function or type"),
    ("titles(M).selec(1)", (UsageError, ModelError), "selec"),
])  # fmt: skip
def test_what_goes_wrong_is_blamed_on_who_did_it(text: str, kind: type[RobosmiError], said: str) -> None:
    with pytest.raises(kind) as raised:
        value(text)
    assert said in raised.value.message + str(raised.value)


def test_a_name_that_no_expression_can_say_is_reported() -> None:
    faults = KINDS["named query"].name_fault
    assert faults("titles", ()) is None
    assert faults("_titles", ())
    assert faults("two words", ())


@pytest.mark.parametrize("query", ["boards", "component_named", "disposition_counts", "free_pins", "open_choices", "user_calls"])
def test_the_built_in_named_queries_are_documented_and_shadow_nothing(query: str) -> None:
    built_in = Registry()
    plugins.load(plugins.BUILT_IN)(built_in)
    assert query in built_in.names("named query")
    assert set(built_in.names("named query")).isdisjoint(NAMES)
    assert built_in.get("named query", query).__doc__


def test_a_named_query_on_the_command_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.undo()
    outcome = run("query", PROGRAM, "user_calls(Program.all.first()).keys()", "--json")
    assert outcome.result == {"value": ["clamp"]}
    assert run("query", PROGRAM, "user_calls(Program.all.first(), 1)").code == 2
    assert "pass what it takes: user_calls(program: " in run("query", PROGRAM, "user_calls(1)").err


def test_an_argument_without_a_value_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.undo()
    outcome = run("query", PROGRAM, "user_calls(Macro.all.select(lambda m: False).first())", "--json")
    assert outcome.code == 2
    message = outcome.document["findings"][0]["message"]
    assert message == "the query 'user_calls' fails (AttributeError): its argument 1 has no value"
