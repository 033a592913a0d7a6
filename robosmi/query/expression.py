"""Queries given as text: a Python expression over models' types and this package's functions, and nothing else of Python.

`evaluate` accepts expressions only, with lambdas and comprehensions. Names are the types, the models and `NAMES`; there are no
builtins. Each `a.b`, `f(x)` and `a ** b` is checked when it is evaluated. No attribute starts with an underscore, and attributes
are read from values of queries alone: elements, collections, texts, numbers, models (to look, not to change or store); of parts
of models only what `robosmi.model.elements.reachable` lists. Only functions of the expression, functions of `robosmi.query` and
readable methods are called; no type is, nor anything else contained in a value. So no frame, module, class or file is within
reach. How a value is shown is in `answers`.
"""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Set
from datetime import date
from decimal import Decimal
from functools import partial
from pathlib import Path
from types import BuiltinMethodType, CodeType, FunctionType, MethodType
from typing import Any, Never, NoReturn

from robosmi.errors import ModelError, RobosmiError, UsageError, did_you_mean, some_of
from robosmi.model.elements.containment_order import ORDERED_FEATURES, EmfOperation, ordered_feature
from robosmi.model.elements.driver import Model, ModelElement, TypeHandle
from robosmi.model.elements.ecore import ECollection, EObject
from robosmi.model.elements.reachable import is_resource, of_models
from robosmi.plugin_contracts import KINDS, wrong_result
from robosmi.plugins import raised_by, registry
from robosmi.query import any_operations, collections, extents, models, numbers, operations, operators, properties, strings, types
from robosmi.query.collections import Lazy
from robosmi.query.first_order import FIRST_ORDER
from robosmi.query.live_collections import CHANGING, FeatureView, collection
from robosmi.query.naming import snake
from robosmi.query.run import Extended, Run, ext
from robosmi.query.values import EolType, Long, as_string, equal

MAX_BITS = 100_000
MAX_ITEMS = 10_000_000
_MAX_POWERSET = 16
_READABLE = (
    str, int, float, list, tuple, dict, date, Decimal, Mapping, Set, collections.Q, collections.Lazy, EObject, ModelElement,
    ECollection, Extended, TypeHandle, EolType, Model,
)  # fmt: skip
_HIDDEN = frozenset({"format", "format_map", "maketrans", "to_bytes", "from_bytes"})
"""Methods of Python's own values that access other values, or return what is no value of queries."""
CLOSED = frozenset({"e_resource", "native_type", "get_native_type", "create_instance", "delete_element", "save"})
"""Operations that return what is no value of queries, or that change a model."""
_BY_NAME = frozenset({"call", "call_built_in", "get", "get_safe", "get_all", "has_property"})
_CALLING = FIRST_ORDER | {"sort", "and", "or", "both", "either", "xor", "implies", "elvis"}
"""Functions that call their arguments."""
_UNSEEN = _BY_NAME | {"both", "either", "implies", "elvis"}
_GROWING = frozenset(
    {"repeat", "pad", "ljust", "rjust", "center", "zfill", "expandtabs", "integer_range", "to", "iota", "format_", "format"}
)


class LookedAt(models.ModelView):
    """A model that a query of a stranger looks at: nothing creates, deletes or stores."""

    def create(self, kind: Any, /, *values: Never, **features: Any) -> Any:
        """Refuse to make an element."""
        self._looked("make an element")

    def delete(self, element: Any) -> None:
        """Refuse to delete an element."""
        self._looked("delete an element")

    def save(self, path: str | Path | None = None) -> None:
        """Refuse to write the model."""
        self._looked("save a model")

    def _looked(self, what: str) -> NoReturn:
        raise UsageError(f"an expression may not {what}", fix="change models in Python, with robosmi.model")


def attribute(target: Any, name: str) -> Any:
    """What `target.name` means in an expression.

    Raises:
        UsageError: it is nothing that an expression may read.
        ModelError: the target has no such property.
    """
    if isinstance(target, Model) and name == "path":
        return target[name]
    if target is not None and not isinstance(target, _READABLE):
        raise UsageError(f"an expression may not look into a {type(target).__name__}", fix="use the functions of robosmi.query")
    if not _may_read(target, name):
        if isinstance(target, Model):
            return target[name]  # a type, or the error that there is none
        raise UsageError(f"an expression may not use '{name}'", fix="use features, and the functions of robosmi.query")
    if name in ORDERED_FEATURES and isinstance(target, EObject) and (ordered := ordered_feature(target, name)) is not None:
        return ordered
    return getattr(target, name)


def _may_read(target: Any, name: str) -> bool:
    if name.startswith("_"):
        return False
    part = of_models(target, name)
    if part is not None:
        return part
    if isinstance(target, EolType):
        return name == "name"
    if isinstance(target, FeatureView) and name in CHANGING:
        return False
    return name not in _HIDDEN or isinstance(target, (collections.Q, Extended, collections.Tuple))


class Caller:
    """Calls what an expression may call.

    Args:
        named: the functions that it can name.
        code: the expression's code, whose lambdas may be called, too.
    """

    def __init__(self, named: Mapping[str, Any], code: CodeType) -> None:
        self._named = {id(value): name for name, value in named.items() if callable(value) and not isinstance(value, TypeHandle)}
        self._codes: set[CodeType] = set()
        pending = [code]
        while pending:
            one = pending.pop()
            self._codes.add(one)
            pending += [constant for constant in one.co_consts if isinstance(constant, CodeType)]

    def __call__(self, function: Any, /, *arguments: Any, **options: Any) -> Any:
        """What `function(...)` means in an expression.

        Raises:
            UsageError: it may not be called, or not with these arguments.
        """
        if isinstance(function, collections.Q):
            raise UsageError(
                "a collection cannot be called: the name before the bracket is no operation of collections, so it means the "
                "values of a property",
                fix="write an operation of EOL by its name in Python, as not_empty() for notEmpty()",
            )
        if not self._may_call(function):
            raise UsageError(f"an expression may not call {_said(function)}", fix="use the functions of robosmi.query")
        name = str(self._named.get(id(function)) or getattr(function, "__name__", ""))
        self._check(name, function, arguments, options)
        value = function(*arguments, **options)
        inner = value if isinstance(value, (list, tuple)) and name in _BY_NAME else ()
        for each in (value, *inner):
            if is_resource(each) or isinstance(each, type):
                raise UsageError(f"an expression may not use a {type(each).__name__} of Python's", fix="ask for values")
        return value

    def _may_call(self, function: Any) -> bool:
        if (
            id(function) in self._named
            or type(function) is EmfOperation
            or (type(function) is FunctionType and function.__code__ in self._codes)
        ):
            return True
        if type(function) in (MethodType, BuiltinMethodType):
            owner = function.__self__
            return not isinstance(owner, type) and isinstance(owner, _READABLE) and _may_read(owner, function.__name__)
        return False

    def _check(self, name: str, function: Any, arguments: tuple[Any, ...], options: dict[str, Any]) -> None:
        for value in (*arguments, *options.values()):  # called by another function, their arguments would not be looked at
            if self._named.get(id(value)) in _UNSEEN:
                raise UsageError(f"an expression may not pass '{self._named[id(value)]}' on", fix="give a lambda that calls it")
        given = arguments
        if id(function) in self._named and name in _BY_NAME:
            name = options.get("name", arguments[1] if len(arguments) > 1 else "")
            if not isinstance(name, str) or name.lstrip("~").startswith("_"):
                raise UsageError(
                    f"an expression may not use '{name}'", fix="names with underscores in front belong to Python itself"
                )
            name, given = snake(name), arguments[2:]
        if name in _CALLING:
            given = given[1:] if given is arguments and name in ("both", "either", "implies", "elvis") else given
            for value in [*given, *(value for option, value in options.items() if option != "kind")]:
                if callable(value) and not isinstance(value, (EObject, TypeHandle)) and not self._may_call(value):
                    raise UsageError(f"an expression may not call {_said(value)}", fix="give a lambda")
            self._check_bodies(name, given, options)
        if name in _GROWING:
            _check_size(name, [*given, *options.values()])
        if name == "powerset" and len(getattr(function, "__self__", arguments[0] if arguments else ())) > _MAX_POWERSET:
            raise UsageError(f"the powerset of more than {_MAX_POWERSET} items is too large", fix="ask for less")

    def _check_bodies(self, name: str, given: tuple[Any, ...], options: dict[str, Any]) -> None:
        """Types are callable, too, and one in a function's place would make an element."""
        places = len(given) if name not in FIRST_ORDER else 3 if name == "aggregate" else 1
        bodies = [*given[:places], *(value for option, value in options.items() if option != "kind")]
        for value in bodies:
            if callable(value) and isinstance(value, (EObject, TypeHandle)) and name != "count":
                raise UsageError(f"an expression may not call {_said(value)}", fix="give a lambda")


def _said(function: Any) -> str:
    if isinstance(function, (EObject, TypeHandle, type)):
        name = getattr(function, "name", None)
        return f"the type {name if isinstance(name, str) else type(function).__name__}"
    return f"a {type(function).__name__}"


def _check_size(name: str, given: list[Any]) -> None:
    for value in given:
        if isinstance(value, int) and abs(value) > MAX_ITEMS:
            raise UsageError(f"{name} of {value:.3g} is more than {MAX_ITEMS:,}", fix="ask for less")


def power(left: Any, right: Any) -> Any:
    """`left ** right`.

    Raises:
        UsageError: the result is larger than an expression may make.
    """
    if isinstance(left, int) and isinstance(right, int) and right > 0 and abs(left) > 1:
        _check_bits(left.bit_length() * right)
    return left**right


def product(left: Any, right: Any) -> Any:
    """`left * right`, where a text or list times a number repeats it.

    Raises:
        UsageError: the result is larger than an expression may make.
    """
    if isinstance(left, int) and isinstance(right, int):
        _check_bits(left.bit_length() + right.bit_length())
    for one, other in ((left, right), (right, left)):
        if isinstance(one, (str, bytes, list, tuple)) and isinstance(other, int) and len(one) * other > MAX_ITEMS:
            raise UsageError(f"the repetition has more than {MAX_ITEMS:,} items", fix="ask for less")
    return left * right


def shifted(left: Any, right: Any) -> Any:
    """`left << right`.

    Raises:
        UsageError: the result is larger than an expression may make.
    """
    if isinstance(left, int) and isinstance(right, int):
        _check_bits(left.bit_length() + right)
    return left << right


def _check_bits(bits: int) -> None:
    if bits > MAX_BITS:
        raise UsageError(f"the number would have more than {MAX_BITS:,} bits", fix="ask for less")


def remainder(left: Any, right: Any) -> Any:
    """`left % right` of numbers; the formats of texts are `f"{x:04d}"` and `format_`.

    Raises:
        UsageError: the left side is a text whose format asks for a great width.
    """
    if isinstance(left, (str, bytes)):
        check_format(str(left))
        if "*" in str(left):
            raise UsageError("a format may not take its width from a value", fix="write the width")
    return left % right


def check_format(specification: str) -> str:
    """A format as it is, if its numbers are small.

    Raises:
        UsageError: it asks for a great width.
    """
    digits = 0
    for letter in specification:
        digits = digits + 1 if letter.isdigit() else 0
        if digits > 6:
            raise UsageError("the format asks for more than 999,999 characters", fix="ask for less")
    return specification


OPERATORS: dict[str, Callable[[Any, Any], Any]] = {"Pow": power, "Mult": product, "LShift": shifted, "Mod": remainder}
"""Python operators whose results can be much larger than their operands."""


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
    **_functions(any_operations, "e_resource", "native_type"),
    "all_instances": models.all_instances, "id_of": models.id_of, "literal_named": models.literal_named,
}  # fmt: skip
"""What an expression may call besides the types of its models."""


def evaluate(
    expression: str,
    given: Iterable[Model],
    then: Callable[[Any], Any] = lambda value: value,
    named: Mapping[str, Callable[..., Any]] | None = None,
) -> Any:
    """The value of an expression.

    Args:
        expression: as `Book.all.select(lambda b: b.year > 2000).name`.
        given: the models, known by their names; their types by simple names, the first model's first. A type comes before a
            function of the same name.
        then: what is made of the value. A value may be lazy, so the expression can fail here too.
        named: more functions that the expression may call, by name (`named_queries`).

    Raises:
        UsageError: it is no expression, uses what is not allowed, or fails.
        RuleError: a plug-in's named query fails.
        ModelError: it names a type, property or operation that there is not.
    """
    views = [LookedAt(model.model if isinstance(model, models.ModelView) else model, name=model.name) for model in given]
    tree = _checked(expression)
    functions = dict(named or {}) | NAMES
    known = functions | {view.name: view for view in views}
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
            fix = f"use a type ({some_of(of_models, name) or 'there is none'}) or a function of robosmi.query"
            paths = (path for view in views for path, _ in view.types())
            if (inside := next((path for path in paths if name in path.split("::")[:-1]), None)) is not None:
                fix = f'name a type with its package as in all_instances("{inside}")'
            if re.search(rf"\(\s*{name}\s*(:\s*\w+\s*)?\|", expression):
                fix = f"a function of an item is written as in Python: lambda {name}: ..."
            raise UsageError(f"the name '{name}' is unknown{near}", fix=fix)
    code = compile(_guarded(tree), "<expression>", "eval")
    try:
        with Run(*views, closed=CLOSED):
            return then(eval(code, {"__builtins__": {}, **_GUARDS, _CALL: Caller(functions, code), **known}))
    except RobosmiError:
        raise
    except RecursionError as error:
        raise UsageError("the expression calls itself too often", fix="use closure") from error
    except Exception as error:  # whatever the expression does wrong
        if (blamed := raised_by(error)) is not None:
            raise blamed from error
        raise UsageError(f"the expression fails: {type(error).__name__}: {error}", fix="see docs/reference/eol.md") from error


def named_queries() -> dict[str, Callable[..., Any]]:
    """The registered functions for `evaluate`, by name (kind `named query`); each is loaded by its first call."""
    return {name: partial(_answer, name) for name in registry().names("named query")}


def _answer(name: str, /, *arguments: Any, **options: Any) -> Any:
    query = KINDS["named query"](registry().get("named query", name), name, registry().owner("named query", name))
    try:
        made = query(*arguments, **options)
    except RobosmiError:
        raise
    except Exception as error:  # whatever a query does that is given nothing
        if (number := next((n for n, each in enumerate(arguments, 1) if each is None), None)) is None:
            if registry().owner("named query", name):
                raise  # its plug-in is blamed
            taken = f"pass what it takes: {name}{inspect.signature(registry().get('named query', name))}"
            raise UsageError(f"the query '{name}' fails: {type(error).__name__}: {error}", fix=taken) from error
        said = f"the query '{name}' fails ({type(error).__name__}): its argument {number} has no value"
        raise UsageError(said, fix="query that argument by itself; the models may have no such element") from error
    if isinstance(made, Iterator):
        made = list(made)
    if made is not None and not isinstance(made, _READABLE):
        raise wrong_result(query, made, query.returns)
    if isinstance(made, (list, tuple)) and type(made) in (list, tuple):  # a subclass has operations of its own
        return collections.Q(made)
    return made


def _type(view: models.ModelView, name: str) -> TypeHandle | None:
    try:
        return view[name]
    except ModelError:
        return None


_GET, _CALL, _FORMAT = "an attribute", "a call", "a format"
"""The names of the functions that read attributes, call, and look at formats; no expression can say them."""
_GUARDS: dict[str, Any] = {
    _GET: attribute,
    _FORMAT: check_format,
    **{f"a {n}": f for n, f in OPERATORS.items()},
}


def _checked(expression: str) -> ast.Expression:
    try:
        tree = ast.parse(expression.strip(), mode="eval")
        for node in ast.walk(tree):
            _check(node)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        reason = error.msg if isinstance(error, SyntaxError) else str(error) or "it is nested too deep"
        raise UsageError(f"not an expression: {reason}", fix="write one as Book.all.select(lambda b: b.year > 2000)") from error
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
        return _asked(node, f"a {operator}", node.left, node.right) if operator in OPERATORS else node

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
