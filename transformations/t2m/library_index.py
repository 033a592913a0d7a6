"""Text to model: a file of facts about libraries (JSON lines) becomes the index that ships with RoboSMi.

    python -m robosmi.transformations.t2m.library_index index.jsonl.gz platform_repo/arduino/libraries/index.sqlite api.jsonl.gz

The index has declared metadata, header names, how often each word occurs in a header (the 700 commonest words of each: the
source has no more), and from a second file what the headers declare. All other text is left out. The file format is in
`robosmi.recommend.index`, the ranking in `transformations.knowledge.libraries.library_ranking`.

What a header declares becomes a value of `robosmi.recommend.library_api`. Its row comes from the file of facts or, for installed
headers (`installed_libraries`), from `library_declarations`. Both are brought to one spelling, and what only looks like a
declaration (a macro call, which has no type) is left out.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from robosmi.base.data_text import Json, json_of
from robosmi.diagnostics import Location
from robosmi.errors import RobosmiError, SourceError, UsageError
from robosmi.files.packed_lines import packed_lines
from robosmi.recommend.library_api import ApiClass, ApiFunction, HeaderApi
from robosmi.recommend.library_record import HeaderRecord, LibraryRecord, write_index
from robosmi.transformations.knowledge.platforms.api_spelling import spelled
from robosmi.transformations.t2m.library_rows import LibraryRow

_ADDRESS = re.compile(r"\s*[<(][^<>()@]*@[^<>()]*[>)]|[^\s@]+@\S+")
_FIX = "use a file with one library per line; the README next to the index has the format"


def build(index_jsonl_gz: Path, target: Path, api_jsonl_gz: Path | None = None) -> tuple[int, int]:
    """Build the index from facts; the same facts give the same bytes. A target that is there is replaced.

    Args:
        index_jsonl_gz: JSON lines, gzip; one library a line with `name`, `main`, `headers` (`file`, `main`, `raw`: word ->
            count) and perhaps version, author, category, architectures, depends, license, url, repo, commit, path,
            copies, in_registry, and `api`: rows like those of the other file.
        target: the SQLite file to write; its folder is made.
        api_jsonl_gz: JSON lines, gzip; one header a line with `library`, `header`, `main`, `classes`, `functions`,
            `constants`, `enums`; libraries that the first file does not name are left out.

    Returns:
        How many libraries and headers are in it.

    Raises:
        SourceError: the facts cannot be read, a library is given twice, has no main header or an unfit value.
    """
    target.parent.mkdir(parents=True, exist_ok=True)
    api = read_api(api_jsonl_gz) if api_jsonl_gz is not None else {}
    try:
        return write_index(target, (_library(row, [*own, *api.get(row["name"], ())]) for row, own in _rows(index_jsonl_gz)))
    except UsageError as error:
        raise SourceError(error.message, location=Location(str(index_jsonl_gz)), fix=_FIX) from error


def _rows(path: Path) -> Iterator[tuple[LibraryRow, list[HeaderApi]]]:
    place = Location(str(path))
    number = 0
    try:
        with packed_lines(path) as lines:
            for number, line in enumerate(lines, 1):
                yield _checked(json_of(line), Location(str(path), number))
    except json.JSONDecodeError as error:
        raise SourceError(f"is not JSON: {error.msg}", location=Location(str(path), number, error.colno), fix=_FIX) from error
    except (OSError, EOFError, UnicodeDecodeError) as error:
        raise SourceError(f"cannot be read: {error}", location=place, fix=_FIX) from error


def _checked(row: Any, place: Location) -> tuple[LibraryRow, list[HeaderApi]]:
    """The row, checked for the values that an index needs, and the declarations of its headers."""
    library: LibraryRow = row
    if not isinstance(row, dict) or not isinstance(row.get("name"), str) or not row["name"]:
        raise SourceError("this line is not a library with a name", location=place, fix=_FIX)
    if not _texts(row.get("main")) or not row["main"]:
        raise SourceError(f"the library '{row['name']}' has no main header", location=place, fix=_FIX)
    headers = row.get("headers")
    if not isinstance(headers, list) or not all(
        isinstance(item, dict) and isinstance(item.get("file"), str) and "main" in item and isinstance(item.get("raw"), dict)
        for item in headers
    ):
        raise SourceError(f"a header of '{row['name']}' lacks file, main or raw", location=place, fix=_FIX)
    if not all(isinstance(tf, int) and tf > 0 for item in headers for tf in item["raw"].values()):
        raise SourceError(f"a count of a word of '{row['name']}' is not a whole number above 0", location=place, fix=_FIX)
    try:
        return library, [header_api(item) for item in row.get("api") or ()]
    except (ValueError, TypeError) as error:
        raise SourceError(f"the declarations of '{row['name']}' are malformed: {error}", location=place, fix=_FIX) from error


def _texts(value: object) -> bool:
    return isinstance(value, list) and all(isinstance(item, str) and "\n" not in item for item in value)


def _library(row: LibraryRow, api: Sequence[HeaderApi]) -> LibraryRecord:
    repo, commit, folder = row.get("repo") or "", row.get("commit") or "", row.get("path") or ""
    headers = [
        HeaderRecord(item["file"], bool(item["main"]), item["raw"], item.get("idents") or {}, item.get("includes") or [])
        for item in row["headers"]
    ]
    return LibraryRecord(
        name=row["name"],
        version=str(row.get("version") or ""),
        author=_ADDRESS.sub("", str(row.get("author") or "")).strip(" ,"),  # people's addresses are nobody's business here
        category=str(row.get("category") or ""),
        architectures=tuple(row.get("architectures") or []),
        depends=tuple(row.get("depends") or []),
        url=str(row.get("url") or ""),
        license=str(row.get("license") or ""),
        origin=f"{repo}@{commit}:{folder}" if repo else "",
        main=tuple(row["main"]),
        headers=headers,
        said=row.get("meta_terms") or {},
        keywords=row.get("keyword_terms") or {},
        classes=tuple(row.get("keyword_classes") or []),
        copies=int(row.get("copies") or 1),
        in_registry=bool(row.get("in_registry")),
        installed=bool(row.get("installed")),
        api=[header for header in api if header],
        registers=tuple(row.get("registers") or []),
    )


def main(arguments: list[str]) -> int:
    """The command line: SOURCE, TARGET and perhaps a second source with what headers declare. Returns the exit code."""
    try:
        if len(arguments) not in (2, 3):
            raise UsageError("give a source and a target", fix="library_index index.jsonl.gz index.sqlite [api.jsonl.gz]")
        libraries, headers = build(Path(arguments[0]), Path(arguments[1]), *(Path(more) for more in arguments[2:]))
    except RobosmiError as error:
        print(error, file=sys.stderr)
        return error.exit_code
    print(f"{arguments[1]}: {libraries} libraries, {headers} headers")
    return 0


# ---- what headers declare

_KIND = re.compile(r"^(enum|struct|class|union):(?!:)")
_API_FIX = "use a file with one header per line; the README next to the index has the format"


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
        raise SourceError(f"cannot be read: {error}", location=Location(str(api_jsonl_gz)), fix=_API_FIX) from error
    return found


def _row(line: str, place: Location) -> tuple[str, HeaderApi]:
    try:
        row = json_of(line)
        if not isinstance(row, dict) or not isinstance(row.get("library"), str):
            raise ValueError("it names no library")
        return row["library"], header_api(row)
    except ValueError as error:
        raise SourceError(f"this line does not list a header's declarations: {error}", location=place, fix=_API_FIX) from error


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


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
