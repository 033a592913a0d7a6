"""Converts the history of choices to a model (`migration.EarlierChoices`) for exchange with other tools, and back.

The database stays authoritative; the model is a copy of one moment. `robosmi.recommend.history_exchange` defines what a damaged
entry is.
"""

from __future__ import annotations

from collections.abc import Iterable

from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.metamodels import migration
from robosmi.recommend.history import HistoryEntry
from robosmi.recommend.history_exchange import entry_of

_FEATURES = {
    "part_id": "partId", "title": "title", "library": "library", "count": "count", "last_used": "lastUsed", "version": "version",
    "target": "target", "component": "component",
}  # fmt: skip


def history_to_model(entries: Iterable[HistoryEntry]) -> migration.EarlierChoices:
    """The model of some entries, in their order."""
    choices = []
    for entry in entries:
        choice = migration.EarlierChoice(library=entry.library)
        for name, feature in _FEATURES.items():
            setattr(choice, feature, getattr(entry, name))
        choices.append(choice)
    return migration.EarlierChoices(choices=choices)


def model_to_history(root: object, location: Location | None = None) -> list[HistoryEntry]:
    """The entries of a model.

    Raises:
        SourceError: it is another model, or an entry is damaged.
    """
    if not isinstance(root, migration.EarlierChoices):
        raise SourceError("this model is no history of choices", location=location, fix="take one that was exported")
    values = ({name: getattr(choice, feature) or "" for name, feature in _FEATURES.items()} for choice in root.choices)
    return [entry_of(item, f"choice {number}", location) for number, item in enumerate(values, 1)]
