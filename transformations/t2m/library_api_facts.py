"""Text to model: facts about what libraries declare, one header a row, become values of `robosmi.recommend.library_api`.

Rows come from a file of facts (JSON lines) or from `library_declarations`. Both are brought to one spelling, and what only
looks like a declaration (a macro call, which has no type) is left out. `installed_libraries` finds installed headers.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from msgspec.structs import replace

from robosmi.data_text import Json, json_of
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.model.packed_lines import packed_lines
from robosmi.recommend.library_api import ApiClass, ApiFunction, HeaderApi
from robosmi.transformations.knowledge.api_spelling import spelled

_KIND = re.compile(r"^(enum|struct|class|union):(?!:)")
_FIX = "take a file that has one header a line, as the README beside the index says"


def read_api(api_jsonl_gz: Path) -> dict[str, list[HeaderApi]]:
    """Name of a library -> what its headers declare, in the order of the file.

    Raises:
        SourceError: the facts cannot be read or have another form.
    """
    found: dict[str, list[HeaderApi]] = {}
    try:
        with packed_lines(api_jsonl_gz) as lines:
            for number, line in enumerate(lines, 1):
                library, api = _row(line, Location(str(api_jsonl_gz), number))
                found.setdefault(library, []).append(api)
    except (OSError, EOFError, UnicodeDecodeError) as error:
        raise SourceError(f"cannot be read: {error}", location=Location(str(api_jsonl_gz)), fix=_FIX) from error
    return found


def _row(line: str, place: Location) -> tuple[str, HeaderApi]:
    try:
        row = json_of(line)
        if not isinstance(row, dict) or not isinstance(row.get("library"), str):
            raise ValueError("it names no library")
        return row["library"], header_api(row)
    except ValueError as error:
        raise SourceError(f"this line does not say what a header declares: {error}", location=place, fix=_FIX) from error


def header_api(row: Mapping[str, Json]) -> HeaderApi:
    """What one header declares, in one spelling. Putting it into that spelling again changes nothing.

    Raises:
        ValueError: the row has another form.
    """
    api = HeaderApi.from_facts(row)
    return replace(
        api,
        classes=tuple(_class(each) for each in api.classes),
        functions=_functions(api.functions, conversions=False),
        constants={name: value.replace("\\\\", "\\") for name, value in api.constants.items()},
    )


def _class(declared: ApiClass) -> ApiClass:
    return replace(
        declared,
        bases=tuple(spelled(base) for base in _whole(declared.bases)),
        constructors=tuple(dict.fromkeys(spelled(parameters) for parameters in declared.constructors)),
        methods=_functions(declared.methods, conversions=True),
    )


def _functions(functions: Iterable[ApiFunction], *, conversions: bool) -> tuple[ApiFunction, ...]:
    """The functions, each once; functions without a type are dropped, except conversion operators where these are allowed."""
    known = (f for f in functions if f.returns or (conversions and f.name.startswith("operator")))
    spelt = (ApiFunction(spelled(f.name), spelled(f.parameters), _type(f.returns), f.static) for f in known)
    return tuple(dict.fromkeys(spelt))


def _type(text: str) -> str:
    return spelled(_KIND.sub(r"\1 ", text))


def _whole(bases: Iterable[str]) -> list[str]:
    """Base classes with template arguments that were split at a comma, joined again."""
    whole: list[str] = []
    for base in bases:
        if whole and whole[-1].count("<") > whole[-1].count(">"):
            whole[-1] = f"{whole[-1]},{base}"
        else:
            whole.append(base)
    return whole
