"""Reference pages that are made from the code: the options of each command, and the public Python names with their docstrings."""

from __future__ import annotations

import importlib
import inspect
import os
import re
from collections.abc import Iterator
from unittest.mock import patch

from msgspec import Struct

from robosmi.cli.main import COMMANDS, build_parser

PUBLIC = ("robosmi", "robosmi.model", "robosmi.model.emf", "robosmi.model.opening", "robosmi.model.driver", "robosmi.model.show",
          "robosmi.query", "robosmi.validate", "robosmi.transform", "robosmi.generate", "robosmi.chain", "robosmi.quoting",
          "robosmi.report", "robosmi.plugins", "robosmi.plugin_contracts", "robosmi.diagnostics", "robosmi.errors")  # fmt: skip
"""The modules whose names users import, in the order of the page."""
_SECTION = re.compile(r"^(Args|Returns|Raises|Attributes|Yields):$", re.MULTILINE)


def command_page() -> str:
    """A page with the help of every command."""
    parts = [
        "# Options of the commands\n",
        "`robosmi COMMAND --help` prints the same. [The command line](command-line.md) describes results and exit codes.\n",
    ]
    with patch.dict(os.environ, {"COLUMNS": "100"}):
        for name in COMMANDS:
            parser = build_parser(name)
            text = next(action.choices[name].format_help() for action in parser._actions if action.dest == "command")  # type: ignore[index]
            parts.append(f"## {name}\n\n```text\n{text.rstrip()}\n```\n")
    return "\n".join(parts)


def python_page() -> str:
    """A page with the public names of the Python interface: signature and docstring."""
    parts = ["# Python reference\n", "The names that programs import; internal modules may change with any release.\n"]
    for module_name in PUBLIC:
        module = importlib.import_module(module_name)
        parts.append(f"## {module_name}\n\n{_text(module)}\n")
        for name, value in _names(module):
            parts.append(f"### {module_name}.{name}\n\n{_signature(name, value)}{_text(value)}\n")
    return "\n".join(parts)


def _names(module: object) -> Iterator[tuple[str, object]]:
    """The public functions and classes of a module: those of `__all__`, else those that it defines."""
    listed = getattr(module, "__all__", None)
    if listed is None:
        module_name = getattr(module, "__name__", "")
        listed = [name for name, value in vars(module).items()
                  if name[0] != "_" and getattr(value, "__module__", None) == module_name]  # fmt: skip
    for name in listed:
        value = getattr(module, name)
        if inspect.isclass(value) or inspect.isroutine(value):
            yield name, value


def _signature(name: str, value: object) -> str:
    """A call as code; of a struct its fields, since evaluating their types may need names that only type checkers import."""
    if isinstance(value, type) and issubclass(value, Struct):
        call = f"({', '.join(value.__struct_fields__)})"
    else:
        try:
            call = str(inspect.signature(value))  # type: ignore[arg-type]
        except (TypeError, ValueError):  # of what is written in C
            return ""
    return f"```python\n{'class ' if inspect.isclass(value) else ''}{name}{call}\n```\n\n"


def _text(value: object) -> str:
    """A docstring as Markdown: its sections become bold headings with lists."""
    text = inspect.getdoc(value) or ""
    if inspect.isclass(value) and value.__doc__ is None:
        text = ""
    out: list[str] = []
    within = False
    for line in text.splitlines():
        if _SECTION.match(line):
            out += ["", f"**{line}**", ""]
            within = True
        elif within and re.match(r" {4}\S", line):
            out.append(f"- {line.strip()}")
        else:
            within = within and (not line or line.startswith(" "))
            out.append(f"  {line.strip()}" if within and line else line)
    return _escaped("\n".join(out)).strip() + "\n"


def _escaped(text: str) -> str:
    """Text without tags that Markdown would take for HTML, except in code."""
    pieces = re.split(r"(`[^`]*`)", text)
    return "".join(piece if piece.startswith("`") else piece.replace("<", "&lt;") for piece in pieces)
