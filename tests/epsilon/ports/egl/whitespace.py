"""The script of cases/egl/whitespace: `-%]` outdents the body of its block, here the tag `outdent`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {
    "script.egl": """\
a
  {% for i in [1, 2, 3] %}
  x{{ i }}
  {% endfor %}
b
{% for i in [1, 2] %}
{% outdent %}
    y{{ i }}
    {% if i > 1 %}
    {% outdent %}
        z
    {% endoutdent %}
    {% endif %}
{% endoutdent %}
{% endfor %}
c d
{%
  set v = 1
%}
e{{ v }}f"""
    "   \n",
}


def port(folder: Path, L: Any, script: str, target: str) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    @g.rule(template=script, target=target)
    def Script() -> None: ...

    return g
