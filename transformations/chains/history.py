"""The chain `history`: list, forget, export and import earlier choices of libraries.

The ending of a file decides its form: .xmi (a model, `migration.EarlierChoices`), .csv or .json. The model is for exchange with
other tools. JSON and CSV are read back with every mistake named. The database stays authoritative; an export is a copy of one
moment.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping
from datetime import date
from pathlib import Path

from msgspec.structs import asdict, astuple

from robosmi import inputs
from robosmi.base.data_text import json_of, json_written
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, UsageError
from robosmi.files.files import refuse_link, write_atomic
from robosmi.metamodels import migration
from robosmi.model import load_model, save_model
from robosmi.quoting import csv_cell, csv_text
from robosmi.recommend.history import History, HistoryEntry

FORMS = (".xmi", ".csv", ".json")

SCHEMA = "robosmi/history/1"
"""Names the JSON form."""

_COLUMNS = HistoryEntry.__struct_fields__
_TEXTS = tuple(name for name in _COLUMNS if name != "count")
_NEEDED = ("part_id", "title", "library", "count", "last_used")


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
    return [_entry_of(item, f"choice {number}", location) for number, item in enumerate(values, 1)]


def to_json(entries: Iterable[HistoryEntry]) -> str:
    """`{"schema", "entries": [{part_id, title, library, count, last_used, version, target, component}]}`."""
    return json_written({"schema": SCHEMA, "entries": [asdict(entry) for entry in entries]}, indent=1, ensure_ascii=False) + "\n"


def to_csv(entries: Iterable[HistoryEntry]) -> str:
    """A table with a heading; lines end in CRLF (RFC 4180). Formulas are quoted by `csv_cell`."""
    out = io.StringIO()
    writer = csv.writer(out)
    writer.writerow(_COLUMNS)
    writer.writerows([csv_cell(str(value)) for value in astuple(entry)] for entry in entries)
    return out.getvalue()


def from_json(text: str, location: Location | None = None) -> list[HistoryEntry]:
    """The entries of a document that `to_json` wrote.

    Raises:
        SourceError: not of that form; the first wrong entry is named.
    """
    fix = f'use an exported document: {{"schema": "{SCHEMA}", "entries": [...]}}'
    try:
        document = json_of(text)
    except ValueError as error:
        raise SourceError(f"this is not JSON: {error}", location=location, fix=fix) from error
    if not isinstance(document, dict) or document.get("schema") != SCHEMA or not isinstance(document.get("entries"), list):
        raise SourceError("this is not an exported history", location=location, fix=fix)
    return [_entry_of(item, f"entry {number}", location) for number, item in enumerate(document["entries"], 1)]


def from_csv(text: str, location: Location | None = None) -> list[HistoryEntry]:
    """What `to_csv` gave; columns in any order, those beyond `part_id, title, library, count, last_used` may be missing.

    Raises:
        SourceError: not of that form; the first wrong line is named.
    """
    try:
        csv.field_size_limit(max(csv.field_size_limit(), len(text)))  # 131,072 characters, and the same for all readers
        table = csv.DictReader(io.StringIO(text.removeprefix("\ufeff")), strict=True)
        missing = [name for name in _NEEDED if name not in (table.fieldnames or ())]
        if missing:
            raise SourceError(f"the column '{missing[0]}' is missing", location=location, fix=f"begin with {','.join(_COLUMNS)}")
        found = []
        for row in table:
            item = {name: csv_text(row.get(name) or "") for name in _COLUMNS}
            text_of_count = item.pop("count")
            count = int(text_of_count) if text_of_count.isascii() and text_of_count.isdigit() else None
            found.append(_entry_of(item | {"count": count}, f"line {table.line_num}", location))
        return found
    except csv.Error as error:
        raise SourceError(f"this is not CSV: {error}", location=location, fix="correct the quotes") from error


def _entry_of(item: object, where: str, location: Location | None) -> HistoryEntry:
    """The entry behind plain values.

    Raises:
        SourceError: a value is missing or of the wrong kind.
    """
    wrong = _wrong(item)
    if wrong or not isinstance(item, dict):
        fix = "an entry has a part (part_id or title), a library, a count above 0 and a day such as 2026-11-21"
        raise SourceError(f"{where} of the history is damaged: {wrong}", location=location, fix=fix)
    return HistoryEntry(**{name: item.get(name, "") for name in _COLUMNS})


def _wrong(item: object) -> str:
    if not isinstance(item, Mapping):
        return "it is not an entry"
    texts = [item.get(name, "" if name not in _NEEDED else None) for name in _TEXTS]
    if not all(isinstance(text, str) and not any("\ud800" <= letter <= "\udfff" for letter in text) for text in texts):
        return "a text is missing or is none"
    if not item["library"] or not (item["part_id"] or item["title"]):
        return "it names no part or no library"
    count = item.get("count")
    if not isinstance(count, int) or isinstance(count, bool) or not 0 < count < 2**31:
        return "its count is not a whole number above 0"
    try:
        return (
            "" if date.fromisoformat(item["last_used"]).isoformat() == item["last_used"] else "its day is not written YYYY-MM-DD"
        )
    except ValueError:
        return "its day is not written YYYY-MM-DD"
