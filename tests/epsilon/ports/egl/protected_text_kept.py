"""The script of cases/egl/protected_text_kept."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {
    "script.egl": """\
class {{ L.Library.all.first().name }} {
{{ out.start_preserve("//", "", "body", false) }}
  // default of {{ L.Book.all.size() }}
{{ out.stop_preserve() }}
}
""",
}


def port(folder: Path, L: Any, script: str, target: str) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    @g.rule(template=script, target=target)
    def Script() -> None: ...

    return g
