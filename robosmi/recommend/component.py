"""The query of a ranker: one hardware component as a plain value, and its validated JSON form.

The ranking uses the title of the PART ("Basic Servo"), which names the device; the name of one placed instance ("BasicServo2")
is its label and says nothing about libraries. Making such values from a drawing is content; `tfidf` uses the words.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

from msgspec import Struct

from robosmi import inputs
from robosmi.base.data_text import json_of
from robosmi.diagnostics import Location
from robosmi.errors import SourceError

_FORM = 'a component is {"id": ..., "title": ...} with label, family, tags, properties, description, connectors if known'


class ComponentQuery(Struct, frozen=True):
    """One component for which a library is sought.

    Attributes:
        id: what the recommendation is called by; unique among the components asked together.
        title: title of the part, e.g. "Basic Servo"; the paper's "name of a component". May be empty.
        label: what the drawing calls this instance.
        family: the part's family.
        tags: the part's tags.
        properties: the part's properties, all as text.
        description: the part's description.
        connectors: names of its connectors.
        part_id: identifier of the part in its catalogue; with the title, the key in the history.
    """

    id: str
    title: str
    label: str = ""
    family: str = ""
    tags: tuple[str, ...] = ()
    properties: Mapping[str, str] = {}
    description: str = ""
    connectors: tuple[str, ...] = ()
    part_id: str = ""

    @classmethod
    def from_json(cls, value: object, *, location: Location | None = None, number: int | None = None) -> ComponentQuery:
        """The component behind the contract's JSON form. Keys that are not known are left alone; null is "not given".

        Args:
            value: what `json.load` gave.
            location: the file it came from, for messages.
            number: which component of that file it is, counted from 1, for messages.

        Raises:
            SourceError: not an object, `id` or `title` missing, or a value of the wrong kind.
        """
        where = "the component" if number is None else f"component {number}"
        if not isinstance(value, dict):
            raise SourceError(f"{where} is not an object but {_kind(value)}", location=location, fix=_FORM)
        given = {key: item for key, item in value.items() if item is not None}
        reader = _Reader(given, where, location)
        return cls(
            id=reader.scalar("id", required=True),
            title=reader.text("title", required=True),
            label=reader.text("label"),
            family=reader.text("family"),
            tags=reader.texts("tags"),
            properties=reader.mapping("properties"),
            description=reader.text("description"),
            connectors=reader.texts("connectors"),
            part_id=reader.text("part_id"),
        )


def read_components(path: Path) -> tuple[ComponentQuery, ...]:
    """The components of a JSON file (contract: `recommend --components FILE`), in their order.

    Raises:
        SourceError: the file cannot be read, is no JSON list of components, or two of them have one id.
    """
    place = Location(str(path))
    try:
        document = json_of(inputs.read_text(path, inputs.TABLE))
    except OSError as error:
        raise SourceError(f"cannot be read: {error.strerror}", location=place, fix="give a file of components") from error
    except json.JSONDecodeError as error:
        raise SourceError(
            f"is not JSON: {error.msg}", location=Location(str(path), error.lineno, error.colno), fix="correct it there"
        ) from error
    except ValueError as error:
        raise SourceError("is not JSON in UTF-8", location=place, fix="save it as UTF-8") from error
    if not isinstance(document, list):
        raise SourceError(f"is not a list of components but {_kind(document)}", location=place, fix=f"write [...]; {_FORM}")
    result = tuple(ComponentQuery.from_json(item, location=place, number=n) for n, item in enumerate(document, 1))
    seen: dict[str, int] = {}
    for number, query in enumerate(result, 1):
        if query.id in seen:
            message = f"components {seen[query.id]} and {number} have the same id '{query.id}'"
            raise SourceError(message, location=place, fix="give each component a unique id")
        seen[query.id] = number
    return result


def _kind(value: object) -> str:
    names = {dict: "an object", list: "a list", str: "a text", bool: "true or false", type(None): "null"}
    return names.get(value.__class__, "a number")


class _Reader(Struct, frozen=True):
    """Reads typed values from a JSON object; an error names the wrong key."""

    given: dict[str, object]
    where: str
    location: Location | None

    def _wrong(self, key: str, expected: str, value: object) -> SourceError:
        message = f"'{key}' of {self.where} is {_kind(value)}, not {expected}"
        return SourceError(message, location=self.location, fix=f"write {expected} there")

    def scalar(self, key: str, *, required: bool = False) -> str:
        value = self.given.get(key, "")
        if isinstance(value, int) and not isinstance(value, bool):
            return str(value)
        return self.text(key, required=required)

    def text(self, key: str, *, required: bool = False) -> str:
        if required and key not in self.given:
            raise SourceError(f"{self.where} has no '{key}'", location=self.location, fix=_FORM)
        value = self.given.get(key, "")
        if not isinstance(value, str):
            raise self._wrong(key, "a text", value)
        if any("\ud800" <= letter <= "\udfff" for letter in value):  # JSON can write half a character, nothing can store it
            message = f"'{key}' of {self.where} contains a lone surrogate"
            raise SourceError(message, location=self.location, fix="write the text again")
        return value

    def texts(self, key: str) -> tuple[str, ...]:
        value = self.given.get(key, [])
        if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
            raise self._wrong(key, "a list of texts", value)
        return tuple(value)

    def mapping(self, key: str) -> Mapping[str, str]:
        value = self.given.get(key, {})
        if not isinstance(value, dict) or not all(isinstance(item, str | int | float) for item in value.values()):
            raise self._wrong(key, "an object of texts", value)
        return {name: str(item) for name, item in value.items()}
