"""The script of cases/egl/egx_formatter.

The engine's formatter sticks to the cached template, so that its rule P is formatted too; here a formatter is its rule's
alone, and P says for itself that it has one.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from robosmi.generate import Gen, formatters

TEMPLATES = {
    "j.egl": """\
class A {
      int x;
void f() {
if (x) {
y();
}
}
{{ out.start_preserve("//", "", "k", true) }}
      z();
{{ out.stop_preserve() }}
}
""",
    "q.egl": """\
class Q {
      int x;
void f() {
}
}
""",
}


def port(folder: Path, L: Any, script: str, target: str | None) -> Gen:
    g = Gen(folder, TEMPLATES, [L])

    @g.rule(template="j.egl", target="a.java", formatter=formatters.java)
    def J() -> None: ...

    @g.rule(template="j.egl", target="plain.java", formatter=formatters.java)
    def P() -> None: ...

    @g.rule(template="q.egl", target="other.java")
    def Q() -> None: ...

    return g
