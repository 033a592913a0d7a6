"""The script of cases/egl/controlled."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {
    "script.egl": """\
hand
{{ out.start_control("//", "", "c", true) }}
generated {{ L.Book.all.first().name }}
{{ out.stop_control() }}
{{ out.start_control("//", "", "d", false) }}
off {{ L.Book.all.first().name }}
{{ out.stop_control() }}
""",
}


def port(folder: Path, L: Any, script: str, target: str) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    @g.rule(template=script, target=target)
    def Script() -> None: ...

    return g
