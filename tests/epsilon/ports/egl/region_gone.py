"""The script of cases/egl/region_gone, with the tag `protected`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {
    "script.egl": """\
head
{% for b in L.Item.all %}
{% protected b.name, start="//" %}
text of {{ b.name }}
{% endprotected %}
{% endfor %}
tail
""",
}


def port(folder: Path, L: Any, script: str, target: str) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    @g.rule(template=script, target=target)
    def Script() -> None: ...

    return g
