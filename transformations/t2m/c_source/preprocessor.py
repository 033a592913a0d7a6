"""Builders of the preprocessor's elements of a unit: includes, macros, conditional directives, comments.

All from the tokens; what was compiled and what was not comes from the parser's skipped ranges. Uses of macros are in
`macros`, since they need the parser.
"""

from __future__ import annotations

import os
import re
from collections import defaultdict
from collections.abc import Iterable

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import definition_parts, directive_comments, directive_parts
from robosmi.transformations.t2m.c_source.context import UnitContext
from robosmi.transformations.t2m.c_source.parsing.invocation import HEADERS

_INCLUDE = re.compile(r'(?P<form>[<"])(?P<name>[^>"]*)[>"]')
_WORD = re.compile(r"[A-Za-z_$][\w$]*")
CONDITIONALS = frozenset({"if", "ifdef", "ifndef", "elif", "elifdef", "elifndef", "else", "endif"})


def read(
    context: UnitContext,
) -> tuple[list[ccode.Include], list[ccode.Macro], list[ccode.PreprocessorConditional], list[ccode.Comment]]:
    """Includes, macros, conditionals and comments in text order; directives in text that was not compiled are left out."""
    includes: list[ccode.Include] = []
    macros: list[ccode.Macro] = []
    conditionals: list[ccode.PreprocessorConditional] = []
    comments: list[ccode.Comment] = []
    gone: dict[str, int] = {}
    headers = _Headers(context)
    place = context.source.place
    for kind, start, end, text in context.source.tokens:
        if kind == "comment":
            comments.append(ccode.Comment(text=context.source.text(start, end), **place(start, end)))
        if kind != "directive":
            continue
        last = end = start + len(text.rstrip())
        word, rest = directive_parts(context.source.text(start, start + len(text)))  # a token has a character for each byte
        inner = [(start + first, start + behind) for first, behind in directive_comments(text)]
        comments += [ccode.Comment(text=context.source.text(*span), **place(*span)) for span in inner]
        for first, behind in reversed(inner):  # a comment at its end is no part of a directive
            if behind >= end:  # the end of its line may count as part of the comment
                end = start + len(text[: first - start].rstrip())
        if word in CONDITIONALS:
            active = context.active(last) if word != "endif" else context.active(start)
            conditionals.append(
                ccode.PreprocessorConditional(directive=word, condition=rest or None, active=active or None, **place(start, end))
            )
        elif not context.active(start):
            continue
        elif word in ("include", "include_next", "import"):
            match = _INCLUDE.match(rest)
            name = match["name"].strip() if match else rest
            system = bool(match and match["form"] == "<")
            includes.append(
                ccode.Include(header=name, system=system or None, resolvedPath=headers.path(name), **place(start, end))
            )
        elif word == "define":
            name, parameters, body = definition_parts(rest)
            if name:
                context.user_macros[name] = parameters is not None
                like = parameters is not None or None
                macros.append(
                    ccode.Macro(name=name, functionLike=like, parameters=parameters, body=body or None, **place(start, end))
                )
        elif word == "undef":
            gone.update(dict.fromkeys(context.user_macros.keys() & rest.split()[:1], start))
    used = {text: start for _, start, _, text in context.tokens if text in gone} if gone else {}
    context.changing = _changing(macros, [name for name, start in gone.items() if used.get(name, -1) > start])
    return includes, macros, conditionals, comments


def _changing(macros: Iterable[ccode.Macro], gone: Iterable[str]) -> set[str]:
    """Names of macros whose meaning changes within a file, directly or by a macro that their text names.

    Args:
        macros: of the file, in text order.
        gone: names of those that are undefined and then used.
    """
    texts: dict[str, tuple[tuple[str, ...], str | None]] = {}
    found, namers = set(gone), defaultdict[str, set[str]](set)
    for macro in macros:
        name, text = str(macro.name), (tuple(macro.parameters), macro.body)
        if texts.setdefault(name, text) != text:
            found.add(name)
        for word in _WORD.findall(str(macro.body or "")):
            namers[word].add(name)
    waiting = list(found)
    while waiting:
        more = namers[waiting.pop()] - found
        found |= more
        waiting += more
    return found


class _Headers:
    """Resolves includes to files; our own standard headers have no path."""

    def __init__(self, context: UnitContext) -> None:
        own = os.path.dirname(os.path.abspath(context.source.path))
        self._folders = (own, *context.include_dirs)
        self._read = {os.path.abspath(p): p for p in context.parsed.inclusions[1:] if not p.startswith(HEADERS)}
        self._names = {os.path.basename(p) for p in self._read}

    def path(self, name: str) -> str | None:
        """The path of the file that was read for a name, None when none was."""
        if os.path.basename(name) not in self._names:
            return None
        plain = not any(part in ("", ".", "..") for part in name.split("/"))
        places = (os.path.join(folder, name) for folder in self._folders)
        candidates = places if plain else (os.path.abspath(place) for place in places)
        return next((self._read[c] for c in candidates if c in self._read), None)
