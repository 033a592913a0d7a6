"""Model to text: the counterpart of EGL and EGX on Jinja2, with protected regions, three-way merge and atomic writing.

`Gen` holds rules and runs them; `region_id` derives the ids of regions from the model; `formatters` indent. The application
writes texts together with its models in one commit, using `merge_edits` and `manifest`. Nothing here knows what is generated.
docs/reference/egl.md compares it with EGL and EGX construct by construct.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from robosmi.generate.generator import Gen
    from robosmi.generate.result import FileChange, Generation, TextLink, TextTrace
    from robosmi.generate.templates import region_id

_PLACES = {
    "Gen": "generator",
    "region_id": "templates",
    "FileChange": "result",
    "Generation": "result",
    "TextLink": "result",
    "TextTrace": "result",
}

__all__ = ["FileChange", "Gen", "Generation", "TextLink", "TextTrace", "region_id"]


def __getattr__(name: str) -> Any:
    if name in _PLACES:
        from importlib import import_module

        return getattr(import_module(f"robosmi.generate.{_PLACES[name]}"), name)
    raise AttributeError(f"module 'robosmi.generate' has no attribute '{name}'")
