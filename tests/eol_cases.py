"""Do our queries give the answers of the real Epsilon engine?  `python tests/eol_cases.py CASES.json`

Interprets the neutral form of the cases over the model beside the file. Variables, `if` and short circuit are done here; every
operation, operator and property goes through a public entry of `robosmi.query`. Prints `N agree, M differ (K quirk)` and the ids
that differ; exit 0 when each of these is tagged `quirk`. Not collected by pytest; tests/query/test_eol_cases.py runs it.
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from robosmi.errors import RobosmiError
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements.driver import is_element
from robosmi.model.emf import EmfModel
from robosmi.query import (
    Bag,
    Long,
    Map,
    ModelView,
    OrderedSet,
    Q,
    Run,
    Set,
    Tuple,
    all_instances,
    call,
    elvis,
    equal,
    get,
    get_safe,
    id_of,
    implies,
    integer_range,
    literal_named,
    model_named,
    operators,
    type_named,
    xor,
)
from robosmi.query.values import as_string, collection_kind

Scope = dict[str, Any]
KINDS: dict[str, Callable[[list[Any]], Any]] = {"Sequence": Q, "Bag": Bag, "Set": Set, "OrderedSet": OrderedSet}
OPERATORS: dict[str, Callable[[Any, Any], Any]] = {
    "=": equal, "==": equal, "<>": operators.unequal, "<": operators.less, ">": operators.greater,
    "<=": operators.less_or_equal, ">=": operators.greater_or_equal, "+": operators.plus, "-": operators.minus,
    "*": operators.times, "/": operators.divided, "xor": xor,
}  # fmt: skip
CONDITIONS = {
    "select", "reject", "selectOne", "selectFirst", "rejectOne", "find", "findOne", "exists", "forAll", "one", "none", "nMatch",
    "atLeastNMatch", "atMostNMatch", "count",
}  # fmt: skip


def value(form: Any) -> Any:
    """A value of the neutral form."""
    if not isinstance(form, dict):
        return form
    ((tag, content),) = form.items()
    if tag in KINDS:
        return KINDS[tag]([value(x) for x in content])
    if tag == "Real":
        return float(content)
    if tag == "Long":
        return Long(content)
    if tag == "Map":
        return Map([(value(k), value(v)) for k, v in content])
    if tag == "Tuple":
        return Tuple([(k, value(v)) for k, v in content])
    if tag == "Range":
        return integer_range(*content)
    if tag == "Type":
        return type_named(content)
    if tag == "Literal":
        return literal_named(content)
    if tag == "all":
        return all_instances(content)
    if tag == "allOfType":
        return model_named("M").all_of_type(content)
    if tag == "model":
        return model_named(content)
    if tag == "Element":
        return model_named("M").element(content.split(" ", 1)[1])
    raise ValueError(f"no value: {form}")


def evaluate(form: Any, scope: Scope) -> Any:
    """The value of a body or expression."""
    if not isinstance(form, list):
        return value(form)
    head, *rest = form
    if head == "var":
        return scope[rest[0]]
    if head == "val":
        return value(rest[0])
    if head == "get":
        return get(evaluate(rest[0], scope), rest[1])
    if head == "get?":
        return get_safe(evaluate(rest[0], scope), rest[1])
    if head == "call":
        return call(evaluate(rest[0], scope), rest[1], *(evaluate(x, scope) for x in rest[2:]))
    if head == "not":
        return operators.negated(evaluate(rest[0], scope))
    if head == "neg":
        return operators.negative(evaluate(rest[0], scope))
    if head == "elvis":
        return elvis(evaluate(rest[0], scope), lambda: evaluate(rest[1], scope))
    if head == "if":
        return evaluate(rest[1] if operators.truth(evaluate(rest[0], scope)) else rest[2], scope)
    if head in ("and", "or", "implies"):
        logical = {"and": operators.both, "or": operators.either, "implies": implies}[head]
        return logical(evaluate(rest[0], scope), lambda: evaluate(rest[1], scope))
    return OPERATORS[head](evaluate(rest[0], scope), evaluate(rest[1], scope))


def step(target: Any, form: dict[str, Any]) -> Any:
    """Apply one step to the previous value."""
    if "get" in form:
        return get(target, form["get"])
    name = form["op"]
    arguments = [value(x) for x in form.get("args", [])]
    if "lambda" not in form:
        return call(target, name, *arguments)
    variable, *bodies = form["lambda"]
    if form.get("multi") and len(bodies) == 1:
        bodies = bodies[0]
    functions: list[Callable[..., Any]] = [lambda x, body=body: evaluate(body, {variable: x}) for body in bodies]
    if name in CONDITIONS:
        functions = [lambda x, f=f: operators.truth(f(x)) for f in functions]
    if name == "aggregate":
        functions[1] = lambda x, total: evaluate(bodies[1], {variable: x, "total": total})
    if "iterator_type" not in form:
        return call(target, name, *functions, *arguments)
    kind = form["iterator_type"]
    wanted = value(kind) if isinstance(kind, dict) else type_named(kind)
    return call(target, name, *functions, *arguments, kind=wanted)


def same(answer: Any, expected: Any) -> bool:
    """Whether an answer is the expected one."""
    if isinstance(expected, dict):
        ((tag, content),) = expected.items()
        if tag in KINDS:
            if collection_kind(answer) != tag:
                return False
            items = list(answer)
            if len(items) != len(content):
                return False
            if tag in ("Sequence", "OrderedSet"):
                return all(map(same, items, content))
            return _matched(items, content)
        if tag == "Real":
            return isinstance(answer, float) and (
                math.isclose(answer, float(content), rel_tol=1e-9) or as_string(answer) == str(content)
            )
        if tag == "Long":
            return isinstance(answer, int) and answer.__class__ is not bool and answer == content
        if tag == "Map":
            entries = list(answer.items()) if isinstance(answer, Map) else []
            return len(entries) == len(content) and all(
                same(k, a) and same(v, b) for (k, v), (a, b) in zip(entries, content, strict=True)
            )
        if tag == "Tuple":
            return isinstance(answer, Tuple) and len(answer) == len(content) and all(same(answer.field(k), v) for k, v in content)
        if tag == "Element":
            return is_element(answer) and content in (f"{answer.eClass.name} {id_of(answer)}", id_of(answer))
        if tag == "Literal":
            return str(as_string(answer)) in (content, content.split("#")[-1]) and not isinstance(answer, str)
        if tag == "Type":
            return bool(getattr(answer, "name", None) == content)
        return False
    return type(answer) is type(expected) and bool(answer == expected)


def _matched(items: list[Any], content: list[Any]) -> bool:
    left = list(content)
    for item in items:
        place = next((i for i, x in enumerate(left) if same(item, x)), None)
        if place is None:
            return False
        del left[place]
    return True


def run(case: dict[str, Any]) -> Any:
    """The answer to a case, `{"error": true}` when it raises."""
    try:
        if "expression" in case:
            return evaluate(case["expression"], {})
        answer = value(case.get("input"))
        for form in case.get("steps", []):
            answer = step(answer, form)
        return answer
    except RobosmiError:
        return {"error": True}


def load(path: Path, model: dict[str, str], metamodel: Metamodel) -> ModelView:
    """Load the model beside the cases, anew for each case, which may change it."""
    return ModelView(EmfModel.load(path.parent / model["file"], metamodel, model["name"]))


def check(path: Path) -> tuple[int, list[tuple[dict[str, Any], Any]]]:
    """How many cases of a file agree, and those that differ with our answers."""
    data = json.loads(path.read_text(encoding="utf-8"))
    metamodel = Metamodel.load(path.parent / data["model"]["metamodel"])
    differing = []
    for case in data["cases"]:
        with Run(load(path, data["model"], metamodel)):
            answer = run(case)
            agrees = answer == {"error": True} if case["expected"] == {"error": True} else same(answer, case["expected"])
            if not agrees:
                differing.append((case, answer))
    return len(data["cases"]) - len(differing), differing


def main(arguments: list[str]) -> int:
    """Check a file of cases and say how it went."""
    if len(arguments) != 1:
        print("usage: python tests/eol_cases.py CASES.json", file=sys.stderr)
        return 2
    agreeing, differing = check(Path(arguments[0]))
    quirks = sum("quirk" in case for case, _ in differing)
    print(f"{agreeing} agree, {len(differing)} differ ({quirks} quirk)")
    for case, answer in differing:
        print(f"{case['id']}: {case.get('eol', '')} gives {answer!r}, the engine {case['expected']!r}")
    return 0 if quirks == len(differing) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
