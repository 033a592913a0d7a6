"""What the modules of the product import, read from their text (ast), so that imports inside functions count."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
CONTENT = ("transformations", "templates", "metamodels", "platform_repo")
"""The folders beside `robosmi/` that are sub-packages of it when installed."""
PUBLIC = ("errors", "diagnostics", "resources", "plugin_contracts", "plugins", "project", "inputs")
"""The modules of the foundation that users import; they lie beside its room, `robosmi/base`."""
FACES = (
    "robosmi.model.codegen",
    "robosmi.model.driver",
    "robosmi.model.metamodel",
    "robosmi.model.show",
    "robosmi.model.strict",
    "robosmi.query.anything",
    "robosmi.verify.toolchain",
)
"""Modules of documented paths that only hand on what is in a room."""


def modules(*folders: str) -> list[Path]:
    """The Python files below these folders."""
    found = [path for folder in folders for path in sorted((ROOT / folder).rglob("*.py")) if "__pycache__" not in path.parts]
    assert found
    return found


@cache
def tree_of(path: Path) -> ast.Module:
    """The syntax tree of a module."""
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def nodes_of_module(path: Path) -> tuple[ast.AST, ...]:
    """Everything in a module, as `ast.walk` gives it."""
    return tuple(ast.walk(tree_of(path)))


def statements_of(node: ast.AST, run: bool = False) -> Iterator[ast.AST]:
    """The statements within a node; if only what runs is asked for, without what stands under `if TYPE_CHECKING`."""
    for child in ast.iter_child_nodes(node):
        if run and isinstance(child, ast.If) and ast.unparse(child.test) in ("TYPE_CHECKING", "typing.TYPE_CHECKING"):
            for other in child.orelse:
                yield other
                yield from statements_of(other, run)
        elif isinstance(child, (ast.stmt, ast.excepthandler, ast.match_case)):
            yield child
            yield from statements_of(child, run)


@cache
def imported(path: Path, run: bool = False) -> tuple[tuple[int, str], ...]:
    """Line and full name of everything that a module imports, wherever in it; with `run` without what only type checkers see."""
    package = (
        ["robosmi", *path.relative_to(ROOT).parts[:-1]]
        if path.relative_to(ROOT).parts[0] in CONTENT
        else list(path.relative_to(ROOT).parts[:-1])
    )
    return (*names_imported(tree_of(path), package, run),)


def names_imported(tree: ast.AST, package: list[str], run: bool) -> Iterator[tuple[int, str]]:
    """Line and full name of everything that a tree of this package imports."""
    for node in statements_of(tree, run):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = (
                ".".join([*package[: len(package) - node.level + 1], *([node.module] if node.module else [])])
                if node.level
                else node.module or ""
            )
            yield from ((node.lineno, f"{base}.{alias.name}") for alias in node.names)


def module_name(path: Path) -> str:
    """The name by which a module is imported."""
    parts = [*path.relative_to(ROOT).with_suffix("").parts]
    names = parts if parts[0] == "robosmi" else ["robosmi", *parts]
    return ".".join(names[:-1] if names[-1] == "__init__" else names)
