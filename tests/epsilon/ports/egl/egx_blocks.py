"""The script of cases/egl/egx_blocks: a variable of `pre` that later blocks see is a function here."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen

TEMPLATES = {"a.egl": "{{ a.name }}/{{ s }}", "m.egl": "member {{ m.name }}"}


def port(folder: Path, L: Any, script: str, target: str | None) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    def said(block: str, a: Any, value: Any) -> Any:
        print(block, a.name)
        return value

    def suffix(a: Any) -> int:
        return len(a.name)

    @g.rule(
        L.Author,
        domain=lambda: L.Author.all.select(lambda x: x.mentor is not None).sort_by(lambda x: x.books[0].name),
        guard=lambda a: said("guard", a, True),
        pre=lambda a: said("pre", a, None),
        target=lambda a: said("target", a, f"{a.name}{suffix(a)}.txt"),
        template=lambda a: said("template", a, "a.egl"),
        post=lambda a, generated: print("post", a.name, generated.name),
    )
    def A(a: Any) -> dict[str, Any]:
        return {"s": said("parameters", a, suffix(a))}

    @g.rule(L.Member, template="m.egl", post=lambda m, generated: print("generated:", generated))
    def NoTarget(m: Any) -> None: ...

    return g
