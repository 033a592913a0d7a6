"""Queries given as text: a Python expression over models' types and this package's functions, and nothing else of Python.

`evaluate` takes expressions only, with lambdas and comprehensions. Names are the types, the models and `NAMES`; there are no
builtins. No attribute starts with an underscore, and attributes are read from values of queries alone: elements, collections,
texts, numbers, models (to look, not to change or store). No type is called. So no frame, module, class or file
is within reach; what may be read and called is `reachable`'s business, and how a value is shown is `answers`'.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterable
from typing import Any

from robosmi.errors import ModelError, RobosmiError, UsageError, did_you_mean
from robosmi.model.driver import Model, TypeHandle
from robosmi.query import (
    anything,
    collections,
    extents,
    models,
    numbers,
    operations,
    operators,
    properties,
    reachable,
    strings,
    types,
)
from robosmi.query.collections import Lazy
from robosmi.query.held import collection
from robosmi.query.run import Run, ext
from robosmi.query.values import Long, as_string, equal

_ALLOWED: tuple[type[ast.AST], ...] = (
    ast.Expression, ast.Constant, ast.Name, ast.Load, ast.Attribute, ast.Subscript, ast.Slice, ast.Call, ast.keyword, ast.Starred,
    ast.BinOp, ast.operator, ast.UnaryOp, ast.unaryop, ast.BoolOp, ast.boolop, ast.Compare, ast.cmpop, ast.IfExp, ast.Lambda,
    ast.arguments, ast.arg, ast.List, ast.Tuple, ast.Set, ast.Dict, ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp,
    ast.comprehension, ast.Store, ast.JoinedStr, ast.FormattedValue,
)  # fmt: skip


def _functions(module: Any, *without: str) -> dict[str, Any]:
    found = {name: value for name, value in vars(module).items() if name[0] != "_" and callable(value)}
    return {n: f for n, f in found.items() if getattr(f, "__module__", None) == module.__name__ and n not in without}


NAMES: dict[str, Any] = {
    "Q": collections.Q, "Bag": collections.Bag, "Set": collections.Set, "OrderedSet": collections.OrderedSet,
    "Map": collections.Map, "Tuple": collections.Tuple, "Lazy": Lazy, "Long": Long, "None": None, "as_string": as_string,
    "equal": equal, "ext": ext, "call": operations.call, "call_built_in": operations.call_built_in,
    "collection": collection,
    **_functions(extents), **_functions(properties, "describe", "property_names"), **_functions(operators, "wrapped"),
    **_functions(types, "resolve", "matching"), **_functions(numbers), **_functions(strings),
    **_functions(anything, "e_resource", "native_type"),
    "all_instances": models.all_instances, "id_of": models.id_of, "literal_named": models.literal_named,
}  # fmt: skip
"""What an expression may call besides the types of its models."""


def evaluate(expression: str, given: Iterable[Model], then: Callable[[Any], Any] = lambda value: value) -> Any:
    """The value of an expression.

    Args:
        expression: as `Book.all.select(lambda b: b.year > 2000).name`.
        given: the models, known by their names; their types by simple names, the first model's first. A type comes before a
            function of the same name.
        then: what is made of the value. A value may be lazy, so the expression can fail here too.

    Raises:
        UsageError: it is no expression, uses what is not allowed, or fails.
        ModelError: it names a type, property or operation that there is not.
    """
    views = [
        reachable.LookedAt(model.model if isinstance(model, models.ModelView) else model, name=model.name) for model in given
    ]
    tree = _checked(expression)
    known = NAMES | {view.name: view for view in views}
    bound = {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)} | {
        node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }
    for name in sorted(
        {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)} - {"Q", *(view.name for view in views)}
    ):
        handle = next((found for view in views if (found := _type(view, name)) is not None), None)
        if handle is not None:
            known[name] = handle
        elif name not in known and name not in bound:
            of_models = [n for view in views for n in view.type_names()]
            near = did_you_mean(name, [*known, *of_models])
            fix = f"use a type ({_few(of_models)}) or a function of robosmi.query"
            if re.search(rf"\(\s*{name}\s*(:\s*\w+\s*)?\|", expression):
                fix = f"a function of an item is written as in Python: lambda {name}: ..."
            raise UsageError(f"the name '{name}' is unknown{near}", fix=fix)
    code = compile(_guarded(tree), "<expression>", "eval")
    try:
        with Run(*views, closed=reachable.CLOSED):
            return then(eval(code, {"__builtins__": {}, **_GUARDS, _CALL: reachable.Caller(NAMES, code), **known}))
    except RobosmiError:
        raise
    except RecursionError as error:
        raise UsageError("the expression calls itself too often", fix="use closure") from error
    except Exception as error:  # whatever the expression does wrong
        raise UsageError(f"the expression fails: {type(error).__name__}: {error}", fix="see docs/reference/eol.md") from error


def _few(names: list[str]) -> str:
    return ", ".join(sorted(set(names))[:20]) or "there is none"


def _type(view: models.ModelView, name: str) -> TypeHandle | None:
    try:
        return view[name]
    except ModelError:
        return None


_GET, _CALL, _FORMAT = "an attribute", "a call", "a format"
"""The names of the functions that read attributes, call, and look at formats; no expression can say them."""
_GUARDS: dict[str, Any] = {
    _GET: reachable.attribute,
    _FORMAT: reachable.check_format,
    **{f"a {n}": f for n, f in reachable.OPERATORS.items()},
}


def _checked(expression: str) -> ast.Expression:
    try:
        tree = ast.parse(expression.strip(), mode="eval")
        for node in ast.walk(tree):
            _check(node)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        said = error.msg if isinstance(error, SyntaxError) else str(error) or "it is nested too deep"
        raise UsageError(f"this is no expression: {said}", fix="write one as Book.all.select(lambda b: b.year > 2000)") from error
    return tree


def _check(node: ast.AST) -> None:
    name = next(filter(None, (getattr(node, field, None) for field in ("attr", "id", "arg"))), "")
    if not isinstance(node, _ALLOWED):
        what = type(node).__name__
        raise UsageError(
            f"an expression may not use {what}", fix="use names, attributes, calls, operators, lambdas and comprehensions"
        )
    if isinstance(name, str) and (name.startswith("__") or (isinstance(node, ast.Attribute) and name.startswith("_"))):
        raise UsageError(f"an expression may not use '{name}'", fix="names with underscores in front belong to Python itself")


class _Guard(ast.NodeTransformer):
    """Turns `a.b`, `f(x)` and `a ** b` into calls of the functions of `reachable`."""

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        self.generic_visit(node)
        return _asked(node, _GET, node.value, ast.Constant(node.attr))

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        call = ast.Call(ast.Name(_CALL, ast.Load()), [node.func, *node.args], node.keywords)
        return ast.copy_location(call, node)

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        self.generic_visit(node)
        operator = type(node.op).__name__
        return _asked(node, f"a {operator}", node.left, node.right) if operator in reachable.OPERATORS else node

    def visit_FormattedValue(self, node: ast.FormattedValue) -> ast.AST:
        self.generic_visit(node)
        if node.format_spec is not None:
            checked = ast.FormattedValue(_asked(node, _FORMAT, node.format_spec), -1, None)
            node.format_spec = ast.JoinedStr([ast.copy_location(checked, node)])
        return node


def _asked(node: ast.expr, name: str, *arguments: ast.expr) -> ast.expr:
    return ast.copy_location(ast.Call(ast.Name(name, ast.Load()), [*arguments], []), node)


def _guarded(tree: ast.Expression) -> ast.Expression:
    try:
        guarded: ast.Expression = _Guard().visit(tree)
        return ast.fix_missing_locations(guarded)
    except RecursionError as error:
        raise UsageError("the expression is nested too deep", fix="shorten it") from error
