"""The chain `history`: list, forget, export and import earlier choices of libraries.

The ending of a file decides its form: .xmi (a model, `migration.EarlierChoices`), .csv or .json. The model is for exchange with
other tools. The database stays authoritative; an export is a copy of one moment.
`robosmi.recommend.history_exchange` defines what a damaged entry is.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, UsageError
from robosmi.files.files import refuse_link, write_atomic
from robosmi.metamodels import migration
from robosmi.model import load_model, save_model
from robosmi.recommend.history import History, HistoryEntry
from robosmi.recommend.history_exchange import entry_of, from_csv, from_json, to_csv, to_json

FORMS = (".xmi", ".csv", ".json")


def export_history(history: History, path: Path) -> list[HistoryEntry]:
    """Write the whole history into a file. Returns what is in it.

    Raises:
        UsageError: the file's ending is no form.
        SourceError: the history cannot be read, or the file not be written.
        StoppedError: the file is a link.
    """
    form, entries = _form(path), history.entries()
    refuse_link(path)
    if form == ".xmi":
        save_model(history_to_model(entries), path)
    else:
        write_atomic(path, (to_csv(entries) if form == ".csv" else to_json(entries)).encode())
    return entries


def import_history(history: History, path: Path) -> tuple[int, int]:
    """Take over what a file has. Returns how many entries it has, and how many of them are new or changed.

    Raises:
        UsageError: the file's ending is no form.
        SourceError: the file cannot be read or is damaged, or the history cannot be written.
    """
    form, location = _form(path), Location(str(path))
    if form == ".xmi":
        entries = model_to_history(load_model(path), location)
    else:
        try:
            text = inputs.read_bytes(path, inputs.HISTORY).decode("utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise SourceError(f"cannot be read: {error}", location=location, fix="give an exported file, in UTF-8") from error
        entries = from_csv(text, location) if form == ".csv" else from_json(text, location)
    return len(entries), history.take_over(entries)


def _form(path: Path) -> str:
    form = path.suffix.lower()
    if form not in FORMS:
        raise UsageError(f"'{path.name}' has none of the endings {', '.join(FORMS)}", fix="give the file one of these endings")
    return form


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
        raise SourceError("this model is not a library history", location=location, fix="use an exported file")
    values = ({name: getattr(choice, feature) or "" for name, feature in _FEATURES.items()} for choice in root.choices)
    return [entry_of(item, f"choice {number}", location) for number, item in enumerate(values, 1)]
