"""The script of cases/egl/text."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {
    "script.egl": """\
{# a comment #}
{% set l = L.Library.all[0] %}
Library {{ l.name }} has {{ l.sections | length }} sections.
{% for s in l.sections %}
- {{ loop.index }}: {{ s.name }}{% if not loop.last %},{% endif +%}
{% endfor %}
{{ L.Book.all.collect(price).concat(", ") }} {{ none }} {{ 1 // 2 }} {{ 1.0 }} {{ true }} {{ L.Book.all[0].genre }}
end {{ "no newline" }}""",
}


def port(folder: Path, L: Any, script: str, target: str) -> Gen:
    g = Gen(folder, TEMPLATES, [L], values={"price": lambda b: b.price})

    @g.rule(template=script, target=target)
    def Script() -> None: ...

    return g
