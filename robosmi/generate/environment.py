"""`render`: a template of this package, or the user's of the same name, as text.

A template in `.robosmi/templates` or `ROBOSMI_PATH` replaces the built-in one of the same name. For generators that put files
together line by line and need no rules; the templates are the same as those of `Gen`.
"""

from __future__ import annotations

from functools import cache
from typing import Any

from robosmi.generate.templates import Templates


@cache
def _templates() -> Templates:
    return Templates()


def render(template: str, **values: Any) -> str:
    """The text of a template.

    Args:
        template: its name below the templates folder, e.g. `report/migration.md.j2`.
        values: what it shows.

    Raises:
        RuleError: it does not parse, or uses a name that is not defined.
    """
    return str(_templates().text(template, values))
