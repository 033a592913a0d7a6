"""The script of cases/egl/protected_comments: an end of a comment that is null in EGL is an empty text or `none` here."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {
    "script.egl": """\
{{ out.start_preserve("/*", "*/", "one two.three", true) }}
c body
{{ out.stop_preserve() }}
    {{ out.start_preserve("<!--", "-->", "x/y", true) }}
    html body
    {{ out.stop_preserve() }}
{{ out.start_preserve("//", "", "a.b#1", false) }}
{{ out.stop_preserve() }}
{{ out.start_preserve("--", none, "dash", true) }}
dash
{{ out.stop_preserve() }}
""",
}


def port(folder: Path, L: Any, script: str, target: str) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    @g.rule(template=script, target=target)
    def Script() -> None: ...

    return g
