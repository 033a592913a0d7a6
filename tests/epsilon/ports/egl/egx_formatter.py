"""The script of cases/egl/egx_formatter.

In the engine a formatter stays with the cached template, so that rule P is formatted as well; here a formatter belongs to one
rule, so P names it itself.
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
