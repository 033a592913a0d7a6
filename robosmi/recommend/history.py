"""History of earlier choices: which library the user took for which part, and how often (paper, section 3.3, phase two).

The key of a part is its identifier in the catalogue and its title, together and letter for letter; version of the library,
target and the component's name are kept beside it. Reading never makes a file; every write is one transaction, so that
several runs may write at once. Where it is kept is in `history_database`, how it is exchanged in `history_exchange`, how
counts change a ranking in `ranking` and `device_ranker`.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from datetime import date
from decimal import Decimal
from pathlib import Path

from msgspec import Struct
from msgspec.structs import replace

from robosmi import resources
from robosmi.errors import RobosmiError, UsageError
from robosmi.recommend.history_database import Collision, Database, Statements, Values, database, unusable
from robosmi.recommend.ranking import Choices
from robosmi.recommend.tokens import models

_KEY = "part_id = :part_id AND title = :title AND library = :library AND version = :version AND target = :target"
_LATER = "last_used = CASE WHEN last_used < :last_used THEN :last_used ELSE last_used END"
_INSERT = "INSERT INTO {table} VALUES (:part_id, :title, :library, :version, :target, :component, :count, :last_used)"
_TRIES = 20
_SHOWN = 40  # characters of a value that does not belong where it is
_Row = tuple[Sequence[str], int]


class HistoryEntry(Struct, frozen=True, order=True):
    """How often one library was chosen for one part.

    Attributes:
        part_id: identifier of the part in its catalogue; may be empty.
        title: title of the part.
        library: name of the library.
        count: how often, >= 1.
        last_used: day of the last choice, ISO 8601 (`2026-11-21`).
        version: version of the library, or empty.
        target: the target board, or empty.
        component: what the drawing called the component last, or empty.
    """

    part_id: str
    title: str
    library: str
    count: int
    last_used: str
    version: str = ""
    target: str = ""
    component: str = ""


class Targets(Struct, frozen=True):
    """The targets whose earlier choices count for one: those for itself; where there are none, those for its like.

    Attributes:
        name: the target.
        alike: whether a target takes the same libraries; a choice that names no target always counts.
    """

    name: str
    alike: Callable[[str], bool]


def default_place() -> Path | str:
    """Where the history is: the file or URL that ROBOSMI_HISTORY names, else `history.sqlite` in the user's data folder."""
    own = os.environ.get("ROBOSMI_HISTORY")
    if own:
        return own if "://" in own else Path(own)
    return resources.user_data() / "history.sqlite"


def chosen_from_history(part_id: str, title: str, history: Choices) -> str | None:
    """The library that history alone chooses for a part: the one chosen most often. A tie is no choice, nor is nothing.

    Raises:
        SourceError: the history is damaged.
    """
    counts = history.choices(part_id, title)
    most = max(counts.values(), default=0)
    first = [library for library, count in counts.items() if count == most]
    return first[0] if len(first) == 1 else None


class History:
    """The choices at one place.

    All methods raise SourceError if the place is damaged, is not a history, is locked for over 5 s by somebody who does not
    write, or cannot be written.

    Args:
        place: a file, which need not exist, or an SQLAlchemy URL; None for `default_place()`.

    Raises:
        MissingToolError: a URL is given and SQLAlchemy or the driver is not installed.
    """

    def __init__(self, place: Path | str | None = None) -> None:
        self._database: Database = database(default_place() if place is None else place)

    @property
    def place(self) -> str:
        """The file, or the URL without its password."""
        return self._database.place

    def choices(self, part_id: str, title: str, among: Targets | None = None) -> dict[str, int]:
        """How often each library was chosen for that very part; most often first, then by name.

        Args:
            part_id: identifier of the part.
            title: its title.
            among: the targets whose choices count; all if None.
        """
        sql = (
            "SELECT library, target, SUM(count) FROM {table} WHERE part_id = :part_id AND title = :title GROUP BY library, target"
        )
        return _counted(self._read(sql, {"part_id": part_id, "title": title}), among)

    def choices_for_model(self, model: str, among: Targets | None = None) -> dict[str, int]:
        """How often each library was chosen for parts whose title has this model number; most often first, then by name.

        Args:
            model: the model number, lower case, letters and digits.
            among: the targets whose choices count; all if None.
        """
        rows = self._read("SELECT title, library, target, SUM(count) FROM {table} GROUP BY title, library, target", {})
        return _counted([(texts, count) for (title, *texts), count in rows if model in models(title)], among)

    def entries(self) -> list[HistoryEntry]:
        """All choices, by part identifier, title and library."""
        rows = self._read("SELECT part_id, title, library, last_used, version, target, component, count FROM {table}", {})
        return sorted(HistoryEntry(part_id, title, library, count, *more) for (part_id, title, library, *more), count in rows)

    def _read(self, sql: str, values: Values) -> list[_Row]:
        """The rows of a question whose last column is a count and whose others are texts.

        Raises:
            SourceError: a value is of another kind. SQLite keeps any in any column, whatever the table says.
        """
        found: list[_Row] = []
        for *texts, count in self._database.read(sql, values):
            if odd := [value for value in texts if not isinstance(value, str)]:
                raise unusable(self.place, f"a row of it has {str(odd[0])[:_SHOWN]} where a text belongs")
            if not isinstance(count, (int, Decimal)) or count < 1:  # some databases add whole numbers up to a Decimal
                raise unusable(self.place, f"a row of it has {str(count)[:_SHOWN]} where a count belongs")
            found.append((texts, int(count)))
        return found

    def record(
        self,
        part_id: str,
        title: str,
        library: str,
        *,
        version: str = "",
        target: str = "",
        component: str = "",
        day: date | None = None,
    ) -> None:
        """Count one more choice of a library for a part. The place is made if need be.

        Args:
            part_id: identifier of the part; may be empty.
            title: title of the part.
            library: name of the chosen library.
            version: its version.
            target: the target board.
            component: what the drawing calls the component.
            day: when; today if None.

        Raises:
            UsageError: no library is named, or neither identifier nor title of a part.
        """
        self.record_all([HistoryEntry(part_id, title, library, 1, (day or date.today()).isoformat(), version, target, component)])

    def record_all(self, entries: Iterable[HistoryEntry]) -> None:
        """Count one more choice for each entry, all or nothing. The place is made if need be; without entries nothing is done.

        Args:
            entries: what was chosen; their counts say nothing here.

        Raises:
            UsageError: an entry names no library, or neither identifier nor title of a part.
        """
        listed = [replace(entry, count=1) for entry in entries]
        if any(not entry.library or not (entry.part_id or entry.title) for entry in listed):
            raise UsageError("a choice needs a part and a library", fix="give both")

        def count(statements: Statements) -> int:
            more = f"UPDATE {{table}} SET count = count + 1, component = :component, {_LATER} WHERE {_KEY}"
            return sum(
                statements.run(more, _key(entry, "component", "last_used"))
                or statements.run(_INSERT, _key(entry, "component", "count", "last_used"))
                for entry in listed
            )

        if listed:
            self._write(count)

    def take_over(self, entries: Iterable[HistoryEntry]) -> int:
        """Take over choices kept elsewhere, all or nothing. Returns how many entries are new or changed.

        Where an entry is there already, the higher count and the later day are kept: a second time changes nothing.
        """
        listed = list(entries)

        def merge(statements: Statements) -> int:
            changed = 0
            for entry in listed:
                there = statements.run(f"UPDATE {{table}} SET count = count WHERE {_KEY}", _key(entry))
                higher = f"UPDATE {{table}} SET count = :count WHERE {_KEY} AND count < :count"
                later = f"UPDATE {{table}} SET {_LATER} WHERE {_KEY} AND last_used < :last_used"
                if there:
                    changed += bool(
                        statements.run(higher, _key(entry, "count")) + statements.run(later, _key(entry, "last_used"))
                    )
                else:
                    changed += statements.run(_INSERT, _key(entry, "component", "count", "last_used"))
            return changed

        return self._write(merge)

    def forget(
        self, part_id: str | None = None, title: str | None = None, library: str | None = None, *, everything: bool = False
    ) -> int:
        """Remove the entries that agree with all that is given. Returns how many there were.

        Raises:
            UsageError: nothing is given, and not `everything` either.
        """
        given = {"part_id": part_id, "title": title, "library": library}
        wanted = {name: value for name, value in given.items() if value is not None}
        if not wanted and not everything:
            raise UsageError("nothing to forget is given", fix="give a part or a library, or everything")
        if not self._database.read("SELECT 1 FROM {table} LIMIT 1", {}):
            return 0
        condition = " AND ".join(f"{name} = :{name}" for name in wanted) or "1 = 1"
        return self._write(lambda statements: statements.run(f"DELETE FROM {{table}} WHERE {condition}", wanted))

    def _write(self, change: Callable[[Statements], int]) -> int:
        """Run a change in one transaction; again where another run wrote the same at that moment."""
        for _ in range(_TRIES - 1):
            try:
                with self._database.writing() as statements:
                    return change(statements)
            except Collision:
                continue
        with self._database.writing() as statements:
            return change(statements)


class ForgivingHistory:
    """A history that may be unusable: it then has no choices, and says once why. Implements `ranking.Choices`.

    Args:
        place: see `History`.
        among: the targets whose choices count; all if None.

    Attributes:
        trouble: why it cannot be used, or None.
    """

    def __init__(self, place: Path | str | None = None, among: Targets | None = None) -> None:
        self._among = among
        self.trouble: RobosmiError | None = None
        self._history: History | None = None
        try:
            self._history = History(place)
            self._history.choices("", "")
        except RobosmiError as error:
            self.trouble, self._history = error, None

    def choices(self, part_id: str, title: str) -> dict[str, int]:
        """See `ranking.Choices`."""
        try:
            return self._history.choices(part_id, title, self._among) if self._history is not None else {}
        except RobosmiError as error:
            self.trouble, self._history = error, None
            return {}

    def choices_for_model(self, model: str) -> dict[str, int]:
        """See `ranking.Choices`."""
        try:
            return self._history.choices_for_model(model, self._among) if self._history is not None else {}
        except RobosmiError as error:
            self.trouble, self._history = error, None
            return {}


def _key(entry: HistoryEntry, *more: str) -> Values:
    return {name: getattr(entry, name) for name in ("part_id", "title", "library", "version", "target", *more)}


def _counted(rows: Sequence[_Row], among: Targets | None) -> dict[str, int]:
    """Counts of libraries and targets, added up for the targets that count."""
    listed = [(library, target, count) for (library, target), count in rows]
    if among is not None:
        own = [row for row in listed if row[1] == among.name]
        listed = own or [row for row in listed if not row[1] or among.alike(row[1])]
    counts: dict[str, int] = {}
    for library, _, count in listed:
        counts[library] = counts.get(library, 0) + count
    return dict(sorted(counts.items(), key=lambda pair: (-pair[1], pair[0])))
