"""Report how often our own annotations contain an explicit `Any`, by room: `python tests/any_count.py`.

An alias such as `Document = dict[str, Any]` counts where an annotation spells out `Any`, not where it uses the alias.
"""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
FOLDERS = ("robosmi", "transformations")


def annotations_of(tree: ast.AST) -> Iterator[ast.expr]:
    """The annotations of parameters, results and variables; those written as texts are parsed."""
    for node in ast.walk(tree):
        found = node.returns if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)) else getattr(node, "annotation", None)
        if isinstance(found, ast.Constant) and isinstance(found.value, str):
            yield ast.parse(found.value, mode="eval").body
        elif found is not None:
            yield found


def any_count(source: str) -> int:
    """How often the annotations of a module contain `Any` of `typing`, whatever the module calls it."""
    tree = ast.parse(source)
    names = set[str]()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module == "typing":
            names |= {each.asname or each.name for each in node.names if each.name == "Any"}
        elif isinstance(node, ast.Import):
            names |= {f"{each.asname or each.name}.Any" for each in node.names if each.name == "typing"}
    parts = (part for annotation in annotations_of(tree) for part in ast.walk(annotation))
    return sum(isinstance(part, (ast.Name, ast.Attribute)) and ast.unparse(part) in names for part in parts)


def main() -> None:
    """Print the counts, the largest first."""
    found = Counter[str]()
    for folder in FOLDERS:
        for path in (ROOT / folder).rglob("*.py"):
            room = ".".join(path.relative_to(ROOT).parts[:-1][:2])
            found[room] += any_count(path.read_text(encoding="utf-8"))
    for room, number in [*(+found).most_common(), ("in all", found.total())]:
        print(f"{number:6,} {room}")


if __name__ == "__main__":
    main()
