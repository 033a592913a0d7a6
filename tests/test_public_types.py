"""What `robosmi` and its rooms offer has no explicit `Any` in its signature. Aliases are resolved."""

from __future__ import annotations

import ast
import importlib
import inspect
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import robosmi

PACKAGE = Path(robosmi.__file__).parent


@cache
def tree_of(module: str) -> ast.Module:
    """The syntax tree of a module of the package; empty for what is not of it."""
    path = PACKAGE.joinpath(*module.split(".")[1:]) if module.split(".")[0] == "robosmi" else Path("-")
    source = next((p for p in (path.with_suffix(".py"), path / "__init__.py") if p.is_file()), None)
    return ast.parse(source.read_text(encoding="utf-8") if source is not None else "")


@cache
def aliases_of(module: str) -> dict[str, ast.expr]:
    """The values of a module's global names that are expressions, as aliases of types are."""
    found: dict[str, ast.expr] = {}
    for node in tree_of(module).body:
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.value is not None:
            found[node.target.id] = node.value
        elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            found[node.targets[0].id] = node.value
    return found


@cache
def imported(module: str) -> dict[str, tuple[str, str]]:
    """Name -> the module and the name there that it was imported from."""
    found: dict[str, tuple[str, str]] = {}
    for node in ast.walk(tree_of(module)):
        if isinstance(node, ast.ImportFrom) and node.module is not None:
            found |= {one.asname or one.name: (node.module, one.name) for one in node.names}
    return found


def has_any(module: str, annotation: ast.expr, seen: frozenset[tuple[str, str]] = frozenset()) -> bool:
    """Whether an annotation of a module says `Any`, itself or by an alias."""
    for node in ast.walk(annotation):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            try:
                inner = ast.parse(node.value, mode="eval").body
            except SyntaxError:  # a text of `Literal`
                continue
            if has_any(module, inner, seen):
                return True
        elif isinstance(node, ast.Name):
            place = imported(module).get(node.id, (module, node.id))
            if place == ("typing", "Any"):
                return True
            value = aliases_of(place[0]).get(place[1])
            if value is not None and place not in seen and has_any(place[0], value, seen | {place}):
                return True
    return False


def of_function(module: str, function: ast.FunctionDef) -> Iterator[str]:
    """The parameters of a function whose annotation says `Any`, and `return`."""
    given = function.args
    for one in (*given.posonlyargs, *given.args, *given.kwonlyargs, given.vararg, given.kwarg):
        if one is not None and one.annotation is not None and has_any(module, one.annotation):
            yield one.arg
    if function.returns is not None and has_any(module, function.returns):
        yield "return"


def signatures(body: list[ast.stmt]) -> Iterator[ast.FunctionDef]:
    """The functions of a body as callers see them: of an overloaded one its overloads, without what they share."""
    overloaded = {node.name for node in body if isinstance(node, ast.FunctionDef) and is_overload(node)}
    for node in body:
        if isinstance(node, ast.FunctionDef) and (node.name not in overloaded or is_overload(node)):
            yield node


def is_overload(function: ast.FunctionDef) -> bool:
    """Whether a function is one of several signatures."""
    return any(isinstance(mark, ast.Name) and mark.id == "overload" for mark in function.decorator_list)


def offered() -> set[str]:
    """`room.name.method(parameter)` of all that is offered and says `Any`."""
    found = set()
    for room in ("robosmi", *(f"robosmi.{path.parent.name}" for path in PACKAGE.glob("*/__init__.py"))):
        names = importlib.import_module(room)
        for name in getattr(names, "__all__", ()):
            thing = getattr(names, name)
            module = getattr(thing, "__module__", "")
            if inspect.isfunction(thing):
                for function in signatures(tree_of(module).body):
                    if function.name == thing.__name__:
                        found |= {f"{room}.{name}({one})" for one in of_function(module, function)}
            elif inspect.isclass(thing):
                (kind,) = (n for n in tree_of(module).body if isinstance(n, ast.ClassDef) and n.name == thing.__name__)
                for function in signatures(kind.body):
                    if function.name[0] != "_" or function.name in ("__init__", "__call__"):
                        found |= {f"{room}.{name}.{function.name}({one})" for one in of_function(module, function)}
                for node in kind.body:
                    if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name) and node.target.id[0] != "_":
                        found |= {f"{room}.{name}.{node.target.id}"} if has_any(module, node.annotation) else set()
    return found


def test_what_is_offered_says_no_any() -> None:
    assert sorted(offered()) == []


def test_an_any_is_found_in_a_text_and_a_class_is_none() -> None:
    annotated = ast.parse("x: Mapping[str, 'Any']\ny: Function\nz: Function | None").body
    found = [isinstance(one, ast.AnnAssign) and has_any("robosmi.base.functions", one.annotation) for one in annotated]
    assert found == [True, False, False]
