"""The Jinja2 environment for all templates: strict about what is missing, found through `resources`.

A template of the user's in `.robosmi/templates` or `ROBOSMI_PATH` replaces the built-in one of the same name.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from robosmi import resources


@cache
def environment(project: Path | None = None) -> Any:
    """The environment (a `jinja2.Environment`); one for each project folder."""
    import jinja2

    return jinja2.Environment(
        loader=jinja2.ChoiceLoader([jinja2.FileSystemLoader(str(f)) for f in resources.folders("templates", project)]),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
        auto_reload=False,
        finalize=lambda value: "" if value is None else value,
    )


def render(template: str, **values: Any) -> str:
    """The text of a template.

    Args:
        template: its name below the templates folder, e.g. `report/migration.md.j2`.
        values: what it shows.
    """
    return str(environment().get_template(template).render(**values))
