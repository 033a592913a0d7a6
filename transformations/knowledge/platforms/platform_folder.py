"""Reads a platform's folder as `ApiFacts`: `platform.toml`, `api.json`, `pins.json`, `meanings.toml`, `cogs.toml`.

A platform inherits the C library of the platform named by its `standard`, and pins and meanings of the one named by its `like`.
Rarely used files are read on demand.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache, cached_property
from pathlib import Path
from typing import Any, cast

from robosmi import inputs, resources
from robosmi.base.data_text import Json, as_table, as_texts, data_toml, json_of
from robosmi.errors import PlatformDataError
from robosmi.transformations.knowledge.api_data import FunctionMeaning, FunctionPins, HeaderContent, PlatformSettings
from robosmi.transformations.knowledge.api_facts import ApiEntry, Convention, PinFacts, PinParameter

_BUILTIN = "builtin"


class FolderFacts:
    """The facts of one folder; see `ApiFacts` for the attributes.

    Args:
        folder: the platform's folder in the repository.

    Raises:
        PlatformDataError: a file is missing or damaged.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.origin = str(folder)
        self.settings = cast(PlatformSettings, _toml(folder / "platform.toml"))
        self._standard = _other(self.settings.get("standard"), folder)
        self._like = _other(self.settings.get("like"), folder)
        own = cast("dict[str, HeaderContent]", _json(folder / "api.json").get("headers", {}))
        inherited = self._standard.headers if self._standard is not None else {}
        self.headers: dict[str, HeaderContent] = {h: c for h, c in inherited.items() if c["kind"] != "platform"} | own
        self.entries: Mapping[str, Sequence[ApiEntry]] = _Entries(
            self.headers, self.settings["parser"].get("builtins", {}), self.settings.get("type_names", {})
        )
        registers = set(self.settings.get("registers", {}).get("names", []))
        self.registers = frozenset(registers.union(*(content.get("registers", []) for content in self.headers.values())))

    @cached_property
    def pins(self) -> Mapping[tuple[str, str], PinFacts]:
        """Function and header -> its pins."""
        found: dict[tuple[str, str], PinFacts] = {}
        path = self._file("pins.json")
        listed = cast("list[FunctionPins]", _json(path).get("functions", []) if path.is_file() else [])
        for fact in listed:
            facts = _pin_facts(fact)
            found.update({(fact["function"], h): facts for h in fact["headers"]})
        return found

    @property
    def functions(self) -> Mapping[str, FunctionMeaning]:
        """Function -> what it means: `parameters`, `blocking`, `startsCog`."""
        found: Mapping[str, FunctionMeaning] = self._meanings.get("functions", {})
        return found

    @property
    def symbols(self) -> Mapping[str, Mapping[str, str]]:
        """Another name -> `kind`, `type`, `meaning`."""
        found: Mapping[str, Mapping[str, str]] = self._meanings.get("symbols", {})
        return found

    @cached_property
    def library_cores(self) -> Mapping[str, Sequence[str]]:
        """Header -> functions that start code of their library on another core."""
        path = self._file("cogs.toml")
        return (
            {name: as_texts(listed) for name, listed in as_table(_toml(path).get("headers", {})).items()}
            if path.is_file()
            else {}
        )

    @property
    def code_arguments(self) -> Mapping[str, int]:
        """Function -> which argument is the code that it starts on another core."""
        return self.settings.get("cogs", {})

    @property
    def virtual_headers(self) -> Mapping[str, bytes]:
        """Our own text of standard headers, by the name a program includes."""
        own = _virtual_headers(str(self.folder / "include"))
        return {**self._standard.virtual_headers, **own} if self._standard is not None else own

    @cached_property
    def _meanings(self) -> dict[str, Any]:
        path = self._file("meanings.toml")
        return _toml(path) if path.is_file() else {}

    def _file(self, name: str) -> Path:
        """A file of the platform's own folder, or of the platform that it is like; it need not exist."""
        path = self.folder / name
        return path if self._like is None or path.is_file() else self._like._file(name)


class _Entries(Mapping[str, Sequence[ApiEntry]]):
    """Name -> its declarations, made when a name is asked for: a program asks for a hundred of the thousands.

    Args:
        headers: the headers, as `api.json` has them.
        builtins: function of the compiler itself -> its return type; it hides what headers say.
        type_names: type -> the type of the platform that it is another name of.
    """

    def __init__(self, headers: Mapping[str, HeaderContent], builtins: Mapping[str, str], type_names: Mapping[str, str]) -> None:
        self._headers, self._builtins, self._type_names = headers, builtins, type_names
        self._where: dict[str, list[tuple[str, str]]] = {}
        for header, content in headers.items():
            for kind, names in (
                ("functions", content.get("functions")),
                ("macros", content.get("macros")),
                ("vars", content.get("vars")),
                ("consts", content.get("consts")),
                ("types", content.get("types")),
            ):
                for name in names or ():
                    self._where.setdefault(name, []).append((header, kind))
        self._where.update((name, [("", _BUILTIN)]) for name in builtins)
        self._made: dict[str, Sequence[ApiEntry]] = {}

    def __getitem__(self, name: str) -> Sequence[ApiEntry]:
        made = self._made.get(name)
        if made is None:
            made = self._made[name] = [self._entry(name, header, kind) for header, kind in self._where[name]]
        return made

    def _entry(self, name: str, header: str, kind: str) -> ApiEntry:
        if kind == _BUILTIN:
            return ApiEntry("", "function", self._builtins[name], "()")
        if kind == "consts":
            return ApiEntry(header, "constant")
        content = self._headers[header]
        if kind == "functions":
            result, parameters = content["functions"][name]
            return ApiEntry(header, "function", result, parameters)
        if kind == "macros":
            return ApiEntry(header, "function_macro" if content["macros"][name] else "macro")
        if kind == "vars":
            return ApiEntry(header, "variable", content["vars"][name])
        form = content["types"][name]
        known = self._type_names.get(name) if form == "typedef" else None
        return ApiEntry(header, "type", form if known is None else f"typedef {known}")

    def __iter__(self) -> Iterator[str]:
        return iter(self._where)

    def __len__(self) -> int:
        return len(self._where)


def platform_folder(name: str) -> Path:
    """The folder with the settings of a platform; others of its name may add files to it, and count for those alone.

    Args:
        name: the platform.

    Raises:
        PlatformDataError: there is none of that name.
    """
    return resources.find("platform_repo", f"{name}/platform.toml").parent


def facts_of(folder: str) -> FolderFacts:
    """The facts of a folder, read once a process."""
    return _facts_of(folder)


def forget_folders() -> None:
    """Read every folder anew when it is asked for next."""
    _facts_of.cache_clear()


@cache
def _facts_of(folder: str) -> FolderFacts:
    return FolderFacts(Path(folder))


def _other(name: str | None, folder: Path) -> FolderFacts | None:
    """The platform that another one builds on; None if no name is given.

    Raises:
        PlatformDataError: there is none of that name, or they build on each other in a cycle.
    """
    if not name:
        return None
    place = platform_folder(name)
    pending, seen = [place], {place}
    while pending:
        current = pending.pop()
        if current == folder:
            fix = f"correct `like` or `standard` in {folder / 'platform.toml'}"
            raise PlatformDataError(f"the platform '{folder.name}' builds on itself", fix=fix)
        settings = _toml(current / "platform.toml")
        further = {platform_folder(str(settings[key])) for key in ("like", "standard") if settings.get(key)}
        pending += further - seen
        seen |= further
    return _facts_of(str(place))


@cache
def _virtual_headers(folder: str) -> dict[str, bytes]:
    root = Path(folder)
    return {path.relative_to(root).as_posix(): inputs.read_bytes(path, inputs.SOURCE) for path in sorted(root.rglob("*.h"))}


def _json(path: Path) -> dict[str, Json]:
    try:
        return as_table(json_of(inputs.read_bytes(path, inputs.DATA)))
    except (OSError, ValueError) as error:
        raise PlatformDataError(f"the platform data {path.name} cannot be read: {error}", fix="repair or reinstall it") from error


def _toml(path: Path) -> dict[str, Json]:
    try:
        return data_toml(inputs.read_text(path, inputs.DATA))
    except (OSError, ValueError) as error:
        raise PlatformDataError(f"the platform data {path.name} cannot be read: {error}", fix="repair or reinstall it") from error


def _pin_facts(fact: FunctionPins) -> PinFacts:
    return PinFacts(
        tuple(
            PinParameter(
                p["index"],
                p["name"],
                p["direction"],
                p.get("range_with"),
                p.get("span", 1),
                p.get("count"),
                tuple(p.get("none", [])),
                p.get("numbering", ""),
            )
            for p in fact.get("parameters", [])
        ),
        tuple(Convention(**c) for c in fact.get("conventions", [])),
    )
