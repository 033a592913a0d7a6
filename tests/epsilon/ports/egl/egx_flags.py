"""The script of cases/egl/egx_flags."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {
    "t.egl": """\
{{ w }}
{{ out.start_preserve("//", "", "r", true) }}
default
{{ out.stop_preserve() }}
"""
}


def port(folder: Path, L: Any, script: str, target: str | None) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    @g.rule(template="t.egl", target="default.txt")
    def Default() -> dict[str, Any]:
        return {"w": "default"}

    @g.rule(template="t.egl", target="keep.txt", overwrite=False)
    def Keep() -> dict[str, Any]:
        return {"w": "keep"}

    @g.rule(template="t.egl", target="nomerge.txt", merge=False)
    def NoMerge() -> dict[str, Any]:
        return {"w": "nomerge"}

    @g.rule(template="t.egl", target="append.txt", append=True)
    def Append() -> dict[str, Any]:
        return {"w": "append"}

    @g.rule(template="t.egl", target="both.txt", overwrite=False, merge=True)
    def Both() -> dict[str, Any]:
        return {"w": "both"}

    return g
