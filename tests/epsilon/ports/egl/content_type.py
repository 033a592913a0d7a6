"""The script of cases/egl/content_type."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {
    "script.egl": """\
{% do out.set_content_type("Java") %}
{{ out.start_preserve("j", true) }}
int a;
{{ out.stop_preserve() }}
""",
    "h.egl": """\
{% do out.set_content_type("HTML") %}
<b>
{{ out.start_preserve("h", false) }}
hello
{{ out.stop_preserve() }}
</b>
""",
}


def port(folder: Path, L: Any, script: str, target: str) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    @g.rule(template=script, target=target)
    def Script() -> None: ...

    return g
