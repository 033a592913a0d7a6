"""The regular expressions of the product: those of its modules, with how they are used, and those of its data files."""

from __future__ import annotations

import ast
import importlib
import re
import tomllib
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from tests.source_imports import ROOT, modules, nodes_of_module

_FLAGS_AT = {"compile": 1, "match": 2, "fullmatch": 2, "search": 2, "findall": 2, "finditer": 2, "split": 3, "sub": 4, "subn": 4}
"""Function of `re` -> the place of its argument for flags."""
_AT_ONE_PLACE = {"match", "fullmatch"}
_USES = {*_FLAGS_AT} - {"compile"}
_STANDS_IN = "x"
"""Stands for what a pattern takes from a variable, which is an escaped word in most cases."""


@dataclass(frozen=True)
class OwnPattern:
    """A regular expression of the product.

    Attributes:
        path: the file, relative to the checkout.
        line: the line; 0 in a data file.
        pattern: the expression.
        anywhere: whether it is searched for, and not matched at one place only.
        whole: whether it has to match a text to its end.
    """

    path: str
    line: int
    pattern: re.Pattern[Any]
    anywhere: bool
    whole: bool


@cache
def own_patterns() -> tuple[OwnPattern, ...]:
    """All of them whose text is in the product."""
    return (*(each for path in _sources() for each in _of_module(path) if isinstance(each, OwnPattern)), *_of_data())


@cache
def unreadable_patterns() -> frozenset[str]:
    """The calls whose pattern is only known when the program runs: file and function."""
    return frozenset(each for path in _sources() for each in _of_module(path) if isinstance(each, str))


def _sources() -> list[Path]:
    return [*modules("robosmi"), *modules("transformations"), *modules("platform_repo"), *modules("templates")]


@cache
def _uses() -> dict[str, set[str]]:
    """Name of a compiled pattern -> the methods that the product calls on it; `any` where it is handed on."""
    found: defaultdict[str, set[str]] = defaultdict(set)
    for path in _sources():
        called: set[int] = set()
        for node in nodes_of_module(path):
            if isinstance(node, ast.Attribute) and isinstance(node.value, (ast.Name, ast.Attribute)):
                name = node.value.id if isinstance(node.value, ast.Name) else node.value.attr
                if node.attr in {*_USES, "pattern"}:
                    found[name].add(node.attr)
                    called.add(id(node.value))
        for node in nodes_of_module(path):
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load) and id(node) not in called:
                found[node.id].add("any")
    return found


def _of_module(path: Path) -> Iterator[OwnPattern | str]:
    short = path.relative_to(ROOT)
    parts = short.with_suffix("").parts
    name = ".".join(parts if parts[0] == "robosmi" else ("robosmi", *parts)).removesuffix(".__init__")
    nodes = nodes_of_module(path)
    if not any(isinstance(node, ast.Name) and node.id == "re" for node in nodes):
        return
    namespace = vars(importlib.import_module(name))
    names = {
        id(node.value): target.id
        for node in nodes
        if isinstance(node, (ast.Assign, ast.AnnAssign)) and node.value is not None
        for target in (node.targets if isinstance(node, ast.Assign) else [node.target])
        if isinstance(target, ast.Name)
    }
    for node in nodes:
        function = node.func if isinstance(node, ast.Call) else None
        if not isinstance(node, ast.Call) or not isinstance(function, ast.Attribute) or function.attr not in _FLAGS_AT:
            continue
        if not isinstance(function.value, ast.Name) or function.value.id != "re":
            continue
        text = _text(node.args[0], namespace)
        if isinstance(text, re.Pattern):
            continue
        if text is None:
            yield f"{short}: {ast.unparse(node.args[0])}"
            continue
        at = _FLAGS_AT[function.attr]
        given = next((k.value for k in node.keywords if k.arg == "flags"), node.args[at] if len(node.args) > at else None)
        flags = 0 if given is None else int(eval(ast.unparse(given), dict(namespace)))
        uses = {function.attr} if function.attr != "compile" else _uses().get(names.get(id(node), ""), set()) - {"pattern"}
        anywhere = not uses or not uses <= _AT_ONE_PLACE
        yield OwnPattern(str(short), node.lineno, re.compile(text, flags), anywhere, "fullmatch" in uses)


def _text(node: ast.expr, namespace: dict[str, Any]) -> str | bytes | re.Pattern[Any] | None:
    """The value of an expression of a module, with `_STANDS_IN` for the parts of a text that only a run knows; None for none."""
    try:
        value = eval(ast.unparse(node), dict(namespace))
    except Exception:
        value = None
    if isinstance(value, (str, bytes, re.Pattern)):
        return value
    if isinstance(node, ast.JoinedStr):
        return "".join(str(_text(piece, namespace) or _STANDS_IN) for piece in node.values)
    if isinstance(node, ast.FormattedValue):
        found = _text(node.value, namespace)
        return found if isinstance(found, str) else _STANDS_IN
    if (
        isinstance(node, ast.BinOp)
        and isinstance(node.op, ast.Mod)
        and isinstance(text := _text(node.left, namespace), (str, bytes))
    ):
        return text.replace("%s", _STANDS_IN) if isinstance(text, str) else text.replace(b"%s", _STANDS_IN.encode())
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        one, two = (_text(side, namespace) for side in (node.left, node.right))
        if isinstance(one, bytes) or isinstance(two, bytes):
            return (one if isinstance(one, bytes) else b"x") + (two if isinstance(two, bytes) else b"x")
        if isinstance(one, str) or isinstance(two, str):
            return (one if isinstance(one, str) else "x") + (two if isinstance(two, str) else "x")
    return None


def _of_data() -> Iterator[OwnPattern]:
    for path in sorted((ROOT / "platform_repo").rglob("*.toml")):
        for key, text in _texts(tomllib.loads(path.read_text(encoding="utf-8"))):
            if "pattern" in key:
                yield OwnPattern(str(path.relative_to(ROOT)), 0, re.compile(text, re.MULTILINE), True, False)


def _texts(value: Any, key: str = "") -> Iterator[tuple[str, str]]:
    """The texts of a table with the keys that lead to them."""
    if isinstance(value, str):
        yield key, value
    elif isinstance(value, dict):
        for inner, each in value.items():
            yield from _texts(each, f"{key}.{inner}")
    elif isinstance(value, list):
        for each in value:
            yield from _texts(each, key)
