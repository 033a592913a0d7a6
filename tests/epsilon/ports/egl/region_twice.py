"""The script of cases/egl/region_twice."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {
    "script.egl": """\
{{ out.start_preserve("//", "", "same", true) }}
first
{{ out.stop_preserve() }}
between
{{ out.start_preserve("//", "", "same", true) }}
second
{{ out.stop_preserve() }}
""",
}


def port(folder: Path, L: Any, script: str, target: str) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    @g.rule(template=script, target=target)
    def Script() -> None: ...

    return g
