"""Decides whether a text that was parsed is C at all.

libclang makes some tree of any text. A text is refused when it has syntax errors and nothing of it survives as C: no function
with a body, no declaration whose type C or the text knows.
"""

from __future__ import annotations

from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.transformations.t2m.c_source.parsing import clang, cursor_kinds
from robosmi.transformations.t2m.c_source.parsing.translation_unit import Parsed

_HINTS = {
    ".py": "Python",
    ".spin": "Spin",
    ".xml": "XML",
    ".html": "HTML",
    ".json": "JSON",
}


def refuse_other_languages(parsed: Parsed) -> None:
    """Refuse a text that is not C.

    Raises:
        SourceError: the text is not C.
    """
    both = [*parsed.first_diagnostics, *parsed.diagnostics]
    errors = [d for d in both if d.offset >= 0 and not d.message.endswith("file not found")]
    syntax = [d for d in errors if d.syntax]
    if not syntax:
        return
    damaged = sorted(d.offset for d in errors)
    unknown = {
        d.offset for d in errors if d.message.startswith(("unknown type name", "type specifier missing", "a type specifier"))
    }

    def survives(start: int, end: int, kind: int) -> bool:
        return kind in (
            cursor_kinds.STRUCT_DECL,
            cursor_kinds.UNION_DECL,
            cursor_kinds.ENUM_DECL,
            cursor_kinds.FUNCTION_DECL,
            cursor_kinds.VAR_DECL,
            cursor_kinds.TYPEDEF_DECL,
        ) and not any(start <= o <= end for o in unknown)

    bodies = [
        n
        for n in parsed.nodes
        if n.kind == cursor_kinds.FUNCTION_DECL
        and any(c.kind == cursor_kinds.COMPOUND_STMT for c in n.children)
        and survives(n.start, n.start + 1, n.kind)
    ]
    reader, location = parsed.reader, clang.library().getCursorLocation
    typed = [
        n for n in parsed.nodes if n.kind != cursor_kinds.VAR_DECL or reader.offset(location(n.cursor)) > n.start
    ]  # `x = 3` alone is no C
    whole = [n for n in typed if survives(n.start, n.end, n.kind) and not any(n.start <= o <= n.end for o in damaged)]
    if bodies or whole:
        return
    source = parsed.source
    place = source.place(syntax[0].offset, syntax[0].offset)
    hint = next((f" (it looks like {name})" for ending, name in _HINTS.items() if source.path.lower().endswith(ending)), "")
    raise SourceError(
        f"this is not C source text{hint}: {syntax[0].message}",
        location=Location(source.path, place["line"], place["column"]),
        fix="give a C source file",
    )
