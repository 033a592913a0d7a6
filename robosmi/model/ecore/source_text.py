"""Pieces of Python source as a formatter writes them: strings, docstrings, imports, calls that are too long for a line.

Lines stay within 88 columns where they can be split, and a call that was split has its last comma, so that `ruff format`
leaves the text alone at any line length from 88 on. Nothing of metamodels here.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

from robosmi.base.data_text import json_written
from robosmi.quoting import visible

WIDTH = 88


def string(text: str) -> str:
    """A text as a Python literal; what cannot be seen, or turns the direction of text, is an escape."""
    if '"' in text and "'" not in text:
        return repr(text)
    return visible(json_written(text, ensure_ascii=False))


def docstring(text: str, indent: str) -> str:
    """A text as a docstring, without the indentation of its first line; whatever it says, it ends where the docstring does."""
    lines = [line.rstrip() for line in text.expandtabs(4).replace("\r\n", "\n").replace("\r", "\n").strip().split("\n")]
    if len(lines) > 1:
        lines = [lines[0], *textwrap.dedent("\n".join(lines[1:])).split("\n")]
    body = "\n".join(lines)
    begun = body.rstrip('"')  # quotes at the end are escaped one by one: three of them and the docstring's own make others
    safe = begun.replace("\\", "\\\\").replace('"""', '\\"\\"\\"') + '\\"' * (len(body) - len(begun))
    parts = [visible(line) for line in safe.split("\n")]
    body = "\n".join([parts[0], *(f"{indent}{line}" if line else "" for line in parts[1:])])
    return f'"""{body}\n{indent}"""' if len(parts) > 1 else f'"""{body}"""'


def call(head: str, arguments: Sequence[str], indent: str, tail: str = "", brackets: str = "()") -> str:
    """`head(arguments)tail`, without the indentation of its first line; split where it is too long."""
    line = f"{head}{brackets[0]}{', '.join(arguments)}{brackets[1]}{tail}"
    if not arguments or (len(indent) + len(line) <= WIDTH and "\n" not in line):
        return line
    inner = "".join(f"{indent}    {argument},\n" for argument in arguments)
    return f"{head}{brackets[0]}\n{inner}{indent}{brackets[1]}{tail}"


def assignment(target: str, value: str, indent: str) -> str:
    """`target = value`, with the value in parentheses of its own where the line is too long."""
    line = f"{target} = {value}"
    if len(indent) + len(line) <= WIDTH or len(indent) + len(target) + 4 > WIDTH or len(indent) + 4 + len(value) > WIDTH:
        return line
    return f"{target} = (\n{indent}    {value}\n{indent})"


def imports(modules: Mapping[str, Iterable[tuple[str, str]]], indent: str = "") -> list[str]:
    """Lines `from module import name as alias`, modules and names in a formatter's order; an empty text is an empty line.

    Args:
        modules: module -> (name, local name) pairs.
        indent: what stands before each line; it is not part of the result's first lines.
    """
    lines: list[str] = []
    ordered = sorted((m for m in modules if modules[m]), key=_module_key)
    for previous, module in pairwise(["", *ordered]):
        if previous and previous[0] != "." and module[0] == ".":
            lines.append("")
        pairs = set(modules[module])
        plain = sorted((name for name, local in pairs if name == local), key=_name_key)
        groups = [([name], f"{name} as {local}") for name, local in pairs if name != local]
        groups += [(plain, ", ".join(plain))] if plain else []
        for group, text in sorted(groups, key=lambda one: (_name_key(one[0][0]), one[1])):
            line = f"from {module} import {text}"
            if len(indent) + len(line) > WIDTH:
                inner = group if group is plain else [text]
                line = f"from {module} import (\n" + "".join(f"{indent}    {one},\n" for one in inner) + f"{indent})"
            lines.append(line)
    return lines


def _module_key(module: str) -> tuple[int, list[str | tuple[int, str]]]:
    dots = len(module) - len(module.lstrip("."))
    return (-dots if dots else -99, _natural(module))


def _name_key(name: str) -> tuple[int, list[str | tuple[int, str]], str]:
    kind = 0 if name.isupper() and len(name) > 1 else 1 if name[:1].isupper() else 2
    return (kind, _natural(name), name)


def _natural(text: str) -> list[str | tuple[int, str]]:
    """Letters without case, numbers (of any length) by their value; texts and numbers alternate, so that they compare."""
    parts: list[str | tuple[int, str]] = [*re.split(r"([0-9]+)", text.lower())]
    for number in range(1, len(parts), 2):
        digits = str(parts[number]).lstrip("0")
        parts[number] = (len(digits), digits)
    return parts
