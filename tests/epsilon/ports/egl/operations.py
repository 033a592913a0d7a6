"""The script of cases/egl/operations: template operations are macros; text is printed within the output by `{% print %}`.

A macro must be defined before its first use; EGL's operations may follow it.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {
    "script.egl": """\
{% macro card(self) %}
name {{ self.name }}
books {{ self.books | length }}
{% endmacro %}
{% macro list(self) %}
{% for b in self.books %}
{% print b.name ~ ";" %}
{% endfor %}
{% endmacro %}
{% macro wrap(t) %}<{{ t }}>{% endmacro %}
{{ card(L.Author.all.first()) }}
ab {% print card(L.Author.all.last()) | trim %}

cd {{ card(L.Author.all.last()) | trim }}
{% print list(L.Author.all.first()) %}
{% print out.print("abcdef") %}
{% print out.chop(2) %}
{% print out.println() %}
{% print out.println("line") %}
{{ "{" }}{{ wrap("x") }}{{ "}" }}
""",
}


def port(folder: Path, L: Any, script: str, target: str) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    @g.rule(template=script, target=target)
    def Script() -> None: ...

    return g
