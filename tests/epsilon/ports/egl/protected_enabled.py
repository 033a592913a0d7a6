"""The script of cases/egl/protected_enabled."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {
    "script.egl": """\
start {{ L.Book.all.size() }} {{ L.Book.all.first().name }}
{{ out.start_preserve("#", "", "a", true) }}
default {{ L.Book.all.first().name }}
{{ out.stop_preserve() }}
mid
{{ out.start_preserve("#", "", "b", L.Book.all.size() > 100) }}
b default {{ L.Book.all.first().name }}
{{ out.stop_preserve() }}
""",
}


def port(folder: Path, L: Any, script: str, target: str) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    @g.rule(template=script, target=target)
    def Script() -> None: ...

    return g
