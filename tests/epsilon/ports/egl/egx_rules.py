"""The script of cases/egl/egx_rules."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {
    "book.egl": """\
{{ title }} {{ extra | join(", ") }} by {{ b.authors | map(attribute="name") | join(" and ") }}
""",
    "item.egl": "item {{ i.name }}",
    "index.egl": """\
{% for b in books %}
* {{ b.name }}
{% endfor %}
""",
}


def port(folder: Path, L: Any, script: str, target: str | None) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    @g.pre
    def before() -> None:
        print("pre")

    @g.rule(L.Book, guard=lambda b: b.year > 1900, template="book.egl", target=lambda b: f"b/{b.name}.txt")
    def Books(b: Any) -> dict[str, Any]:
        return {"title": b.name.upper(), "extra": [1, 2]}

    @g.rule(L.Item, greedy=True, template=lambda i: "item.egl", target=lambda i: f"{i.eClass.name}/{i.name}.txt")
    def Items(i: Any) -> None: ...

    @g.rule(template="index.egl", target="index.txt")
    def Index() -> dict[str, Any]:
        return {"books": L.Book.all}

    @g.post
    def after() -> None:
        print("post")

    return g
