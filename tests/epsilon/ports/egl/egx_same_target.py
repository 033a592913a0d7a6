"""The script of cases/egl/egx_same_target."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {
    "b.egl": "book {{ b.name }}",
    "r.egl": """\
{{ b.name }}
{{ out.start_preserve("//", "", "x", true) }}
for {{ b.name }}
{{ out.stop_preserve() }}
""",
}


def port(folder: Path, L: Any, script: str, target: str | None) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    @g.rule(L.Book, template="b.egl", target="same.txt")
    def One(b: Any) -> None: ...

    @g.rule(L.Book, template="b.egl", target="log.txt", append=lambda b: b.name != "Propellers")
    def Two(b: Any) -> None: ...

    @g.rule(L.Member, template="r.egl", target="region.txt")
    def Three(b: Any) -> None: ...

    return g
