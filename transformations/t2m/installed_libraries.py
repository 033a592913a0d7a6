"""Text to model: folders of installed libraries become rows of facts for `library_index`.

A folder of libraries (one folder each), a single library, or a PlatformIO project (`.pio/libdeps/*/`, `lib/`) is accepted.
Declared metadata come from library.properties or library.json, else the folder's name is the library's. Files that cannot be
read, folders without headers, duplicates and cyclic links are left out, each with its reason. Only facts are kept, see
`library_index`; declarations in headers are found by `library_declarations`. A library that is for all processors by what it
declares, and whose source writes registers of one without asking for it, has the names of these registers.
"""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Collection, Iterator
from pathlib import Path

from msgspec import Struct

from robosmi import inputs
from robosmi.base.data_text import Json, json_of
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.recommend.tokens import chunks, words
from robosmi.transformations.t2m.library_declarations import declarations
from robosmi.transformations.t2m.library_rows import HeaderRow, LibraryRow

HEADERS = (".h", ".hpp", ".hh")
_SOURCES = (*HEADERS, ".c", ".cpp", ".ino")
_MOST_HEADERS, _MOST_WORDS, _LARGEST, _LONGEST_NAME = 40, 700, 4_000_000, 200
_NOT_CODE = re.compile(r"//[^\n]*|/\*.*?(?:\*/|\Z)|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'", re.DOTALL)
_COMMENT = re.compile(r"//[^\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
_INCLUDE = re.compile(r"^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"\n]+)[>\"]", re.MULTILINE)
_DIRECTIVE = re.compile(r"[ \t]*#[ \t]*(if|ifdef|ifndef|elif|else|endif|define)\b(.*)")
_NAME = re.compile(r"[A-Za-z_]\w*")
_EVERYWHERE = frozenset({"defined", "ARDUINO", "__cplusplus"})
"""Names in conditions that hold on all processors."""
_SHORTEST, _MOST_SOURCES, _NAMED = 4, 200, 4
_CLASS = re.compile(r"\b(?:class|struct)\s+([A-Za-z_]\w*)\s*(?::[^;{]*)?\{")
_KEYWORDS = frozenset(  # of C++, and of its preprocessor
    re.findall(
        r"\w+",
        """if else for while do switch case default break continue return goto sizeof static const volatile inline extern virtual
        public private protected class struct union enum typedef template typename namespace using new delete this operator void
        bool char short int long float double signed unsigned auto register define ifdef ifndef endif elif undef include pragma
        true false""",
    )
)


class Found(Struct):
    """What a folder gave.

    Attributes:
        rows: a row of facts for each library.
        skipped: path -> why it was left out.
    """

    rows: list[LibraryRow] = []
    skipped: dict[str, str] = {}


def read_libraries(folder: Path, registers: Collection[str] = ()) -> Found:
    """The libraries in a folder, each once, in its newest version.

    Args:
        folder: the folder.
        registers: names of registers that the processors of one architecture have.

    Raises:
        SourceError: there is no such folder.
    """
    if not folder.is_dir():
        raise SourceError("no such folder", location=Location(str(folder)), fix="give a folder of libraries")
    found, seen, known = Found(), set[Path](), dict[str, tuple[LibraryRow, Path]]()
    for path in _folders(folder, found):
        real = path.resolve()
        if real in seen:
            found.skipped[str(path)] = "it is a link to a folder that is already read"
            continue
        seen.add(real)
        row = _library(path, found)
        if row is None:
            continue
        row["registers"] = _registers(path, registers)
        if (other := known.get(row["name"])) is None:
            known[row["name"]] = row, path
            continue
        older, newest = sorted(((row, path), other), key=lambda each: _version(each[0]))  # of equals the first stays
        known[row["name"]] = newest
        version = f" in version {newest[0]['version']}" * bool(newest[0]["version"])
        found.skipped[str(older[1])] = f"the library '{row['name']}' is already read from {newest[1]}{version}"
    found.rows += [row for row, _ in known.values()]
    return found


def _version(row: LibraryRow) -> list[int]:
    """The version of a library, to be compared with that of another."""
    return [int(number) for number in re.findall(r"\d+", row["version"])]


def _folders(folder: Path, found: Found) -> Iterator[Path]:
    """The folders of single libraries."""
    if _is_library(folder):
        yield folder
        return
    platformio = [*sorted(folder.glob(".pio/libdeps/*")), folder / "lib"]
    roots = [root for root in platformio if root.is_dir()] if (folder / "platformio.ini").is_file() else [folder]
    for root in roots:
        for path in _entries(root, found):
            if path.is_dir() and not path.name.startswith("."):
                yield path


def _is_library(folder: Path) -> bool:
    declared = any((folder / name).is_file() for name in ("library.properties", "library.json"))
    return declared or any(path.is_file() for pattern in HEADERS for path in folder.glob(f"*{pattern}"))


def _entries(folder: Path, found: Found) -> list[Path]:
    try:
        return sorted(folder.iterdir(), key=lambda path: (path.is_symlink(), path.name))  # what is there before what points there
    except OSError as error:
        found.skipped[str(folder)] = f"cannot be read: {error.strerror}"
        return []


def _library(folder: Path, found: Found) -> LibraryRow | None:
    said = _declared(folder, found)
    inner = folder / "src"
    files = [path for path in _entries(inner if inner.is_dir() else folder, found) if path.suffix.lower() in HEADERS]
    headers = []
    for path in files:
        if path.name.isprintable():
            headers += [path] if path.is_file() else []
        else:
            found.skipped[_clean(str(path))] = "its name has characters that cannot be stored"
    if not headers:
        found.skipped.setdefault(str(folder), "it has no header")
        return None
    name = said.get("name") or _clean(folder.name) or "library"
    wanted = [part.strip() for part in said.get("includes", "").split(",") if part.strip()]
    main = [path.name for path in headers if path.name in wanted]
    main = main or [path.name for path in headers if _bears(path.stem, name) or _bears(path.stem, folder.name)]
    main = main or [path.name for path in headers if len(headers) <= 3] or [headers[0].name]
    read = [_header(path, path.name in main, found) for path in sorted(headers, key=lambda p: (p.name not in main, p.name))]
    known = [each for each in read[:_MOST_HEADERS] if each is not None]
    facts = [header for header, _ in known]
    if not any(header["main"] for header in facts):
        found.skipped[str(folder)] = "none of its main headers can be read"
        return None
    classes = {each for header, names in known for each in names if header["main"]}
    keywords, declared = _keywords(folder)
    start = [path for path in headers if any(header["main"] and header["file"] == path.name for header in facts)]
    return {
        "name": name, "version": said.get("version", ""), "author": said.get("author", ""), "category": said.get("category", ""),
        "architectures": _listed(said.get("architectures", "")), "depends": _listed(said.get("depends", "")),
        "license": said.get("license", ""), "url": said.get("url", ""),
        "main": [header["file"] for header in facts if header["main"]], "headers": facts, "installed": True,
        "meta_terms": dict(Counter(chunks(f"{said.get('sentence', '')} {said.get('paragraph', '')}".lower()))),
        "keyword_terms": dict(keywords), "keyword_classes": sorted(classes | declared), "copies": 1,
        "api": _api(start, inner if inner.is_dir() else folder, found),
    }  # fmt: skip


def _declared(folder: Path, found: Found) -> dict[str, str]:
    """The metadata that a library declares, in either file; empty if there are none or they are damaged."""
    properties, manifest = folder / "library.properties", folder / "library.json"
    if properties.is_file() and (text := _text(properties, found)) is not None:
        pairs = (line.partition("=") for line in text.splitlines() if not line.startswith("#"))
        said = {key.strip(): _clean(value) for key, equals, value in pairs if equals}
        if not 0 < len(said.get("name", "")) <= _LONGEST_NAME:
            found.skipped[str(properties)] = "it names no library; RoboSMi uses the folder's name"
            said.pop("name", None)
        return said
    if manifest.is_file() and (text := _text(manifest, found)) is not None:
        try:
            data = json_of(text)
        except ValueError:
            data = None
        if isinstance(data, dict):
            said = {key: _clean(value) for key, value in _from_manifest(data).items()}
            return said if len(said["name"]) <= _LONGEST_NAME else {**said, "name": ""}
        found.skipped[str(manifest)] = "it is not a JSON object; RoboSMi uses the folder's name"
    return {}


def _from_manifest(data: dict[str, Json]) -> dict[str, str]:
    """PlatformIO's library.json converted to the keys of library.properties."""

    def joined(value: object) -> str:
        if isinstance(value, dict):
            return ", ".join(str(each) for each in value)
        if isinstance(value, list):
            return ", ".join(str(item.get("name", "")) if isinstance(item, dict) else str(item) for item in value)
        return str(value or "")

    platforms = joined(data.get("platforms")).replace("atmelavr", "avr")
    return {
        "name": joined(data.get("name")), "version": joined(data.get("version")), "author": joined(data.get("authors")),
        "sentence": f"{joined(data.get('description'))} {joined(data.get('keywords'))}", "architectures": platforms,
        "depends": joined(data.get("dependencies")), "includes": joined(data.get("headers")),
        "license": joined(data.get("license")), "url": joined(data.get("homepage")),
    }  # fmt: skip


def _header(path: Path, main: bool, found: Found) -> tuple[HeaderRow, list[str]] | None:
    """The facts of a header, and the names of its classes."""
    text = _text(path, found)
    if text is None:
        return None
    code = _NOT_CODE.sub(" ", text)
    identifiers = Counter(word for word in words(code) if not word.isdigit() and word not in _KEYWORDS)
    row: HeaderRow = {
        "file": path.name, "main": main, "includes": sorted(set(_INCLUDE.findall(text))),
        "raw": dict(Counter(chunks(text.lower())).most_common(_MOST_WORDS)),
        "idents": dict(identifiers.most_common(_MOST_WORDS)),
    }  # fmt: skip
    return row, _CLASS.findall(code)


def _api(main: list[Path], root: Path, found: Found) -> list[dict[str, Json]]:
    """The declarations of the main headers, and of the library's headers that they include, directly or not."""
    rows: list[dict[str, Json]] = []
    known: dict[Path, str] = {path.resolve(): path.name for path in main}  # header -> the main one that leads to it
    waiting = list(main)
    for path in waiting:  # grows while it is walked: breadth first
        text = _text(path, found)
        if text is None:
            continue
        leads = known[path.resolve()]
        rows.append({"header": path.name, "main": leads} | declarations(text.encode("utf-8", "replace")))
        names: list[str] = _INCLUDE.findall(_COMMENT.sub(" ", text))
        for name in names:
            for place in (path.parent / name, root / name):
                if len(waiting) < _MOST_HEADERS and os.path.isfile(place):  # False for what is no name of a file, too
                    real = place.resolve()
                    if real not in known and real.is_relative_to(root.resolve()):
                        known[real] = leads
                        waiting.append(place)
    return rows


def _registers(folder: Path, names: Collection[str]) -> list[str]:
    """Some of the registers that a library's source uses on every processor; a name that it defines itself is none."""
    usable = [name for name in names if len(name) >= _SHORTEST]
    if not usable:
        return []
    root = folder / "src" if (folder / "src").is_dir() else folder
    files = sorted(path for path in root.glob("**/*" if root != folder else "*") if path.suffix.lower() in _SOURCES)
    inside = [path for path in files if path.is_file() and "avr" not in path.relative_to(root).as_posix().lower().split("/")]
    texts = [_NOT_CODE.sub(" ", text) for path in inside[:_MOST_SOURCES] if (text := _text(path, Found())) is not None]
    used = re.compile(rf"(?<![\w.>:])(?<!\w )({'|'.join(usable)})\b\s*(?:[|&^]?=(?!=)|[|&;])|\bISR\s*\(\s*(\w+_vect)")
    own = {name for text in texts for name in re.findall(r"#[ \t]*define[ \t]+(\w+)", text)}
    seen = [match[1] or match[2] for text in texts for match in used.finditer(_unconditional(text))]
    return [name for name in dict.fromkeys(seen) if name not in own][:_NAMED]


def _unconditional(text: str) -> str:
    """The lines of a source that are compiled on every processor: outside of conditions, but for guards of headers."""
    kept: list[str] = []
    asked: list[bool] = []
    lines = text.splitlines()
    for number, line in enumerate(lines):
        directive = _DIRECTIVE.match(line)
        if directive is None:
            kept += [line] if not any(asked) else []
            continue
        kind, condition = directive[1], directive[2]
        if kind in ("if", "ifdef", "ifndef"):
            guarded = next((rest for rest in lines[number + 1 :] if rest.strip()), "")
            guard = kind == "ifndef" and (defined := _DIRECTIVE.match(guarded)) and defined[1] == "define"
            asked.append(not guard and not {*_NAME.findall(condition)} <= _EVERYWHERE)
        elif kind == "elif" and asked:
            asked[-1] = asked[-1] or not {*_NAME.findall(condition)} <= _EVERYWHERE
        elif kind == "endif" and asked:
            asked.pop()
    return "\n".join(kept)


def _keywords(folder: Path) -> tuple[Counter[str], set[str]]:
    """Words of the identifiers in keywords.txt, and its classes (KEYWORD1)."""
    counts: Counter[str] = Counter()
    classes = set()
    path = folder / "keywords.txt"
    text = _text(path, Found()) if path.is_file() else None
    for line in (text or "").splitlines():
        cells = line.split("#")[0].split()
        if len(cells) >= 2:
            counts.update(words(cells[0]))
            if cells[1] == "KEYWORD1":
                classes.add(cells[0])
    return counts, classes


def _text(path: Path, found: Found) -> str | None:
    """The text of a file, as UTF-8 or else as Latin-1, which fits everything."""
    try:
        if path.stat().st_size > _LARGEST:
            found.skipped[str(path)] = f"it is larger than {_LARGEST} bytes"
            return None
        data = inputs.read_bytes(path, inputs.SOURCE)
    except OSError as error:
        found.skipped[str(path)] = f"cannot be read: {error.strerror}"
        return None
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def _clean(text: str) -> str:
    """Text without characters that cannot be printed or stored: line ends, NULs, surrogates."""
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())


def _bears(stem: str, name: str) -> bool:
    return re.sub(r"[\W_]+", "", stem).casefold() == re.sub(r"[\W_]+", "", name).casefold()


def _listed(text: str) -> list[str]:
    return [part.strip() for part in text.split(",") if part.strip()]
