"""A platform's folder of the repository as `ApiFacts`: `platform.toml`, `api.json`, `pins.json`, `meanings.toml`, `cogs.toml`.

A platform takes over the C library of the one that its `standard` names, pins and meanings of the one that its `like` names. What
is rarely asked for is read when it is asked for.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache, cached_property
from pathlib import Path
from typing import Any

from robosmi import inputs, resources
from robosmi.data_text import json_of, toml_of
from robosmi.errors import PlatformDataError
from robosmi.transformations.knowledge.api_facts import ApiEntry, Convention, PinFacts, PinParameter


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
        self.settings: dict[str, Any] = _toml(folder / "platform.toml")
        self._standard = _other(self.settings.get("standard"), folder)
        self._like = _other(self.settings.get("like"), folder)
        own: dict[str, dict[str, Any]] = _json(folder / "api.json").get("headers", {})
        inherited = self._standard.headers if self._standard is not None else {}
        self.headers: dict[str, dict[str, Any]] = {h: c for h, c in inherited.items() if c["kind"] != "platform"} | own
        self.entries: dict[str, list[ApiEntry]] = {}
        registers: set[str] = set(self.settings.get("registers", {}).get("names", ()))
        for header, content in self.headers.items():
            registers.update(content.get("registers", ()))
            for name, entry in _entries(header, content):
                self.entries.setdefault(name, []).append(entry)
        for name, result in self.settings["parser"].get("builtins", {}).items():
            self.entries[name] = [ApiEntry("", "function", result, "()")]
        self.registers = frozenset(registers)

    @cached_property
    def pins(self) -> Mapping[tuple[str, str], PinFacts]:
        """Function and header -> its pins."""
        found: dict[tuple[str, str], PinFacts] = {}
        path = self._file("pins.json")
        for fact in _json(path).get("functions", []) if path.is_file() else ():
            facts = _pin_facts(fact)
            found.update({(fact["function"], h): facts for h in fact["headers"]})
        return found

    @property
    def functions(self) -> Mapping[str, Mapping[str, Any]]:
        """Function -> what it means: `parameters`, `blocking`, `startsCog`."""
        found: Mapping[str, Mapping[str, Any]] = self._meanings.get("functions", {})
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
        return _toml(path).get("headers", {}) if path.is_file() else {}

    @property
    def code_arguments(self) -> Mapping[str, int]:
        """Function -> which argument is the code that it starts on another core."""
        found: Mapping[str, int] = self.settings.get("cogs", {})
        return found

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
    """The platform that another one builds on; None without a name.

    Raises:
        PlatformDataError: there is none of that name, or they build on each other in a ring.
    """
    if not name:
        return None
    place = resources.find("platform_repo", name)
    pending, seen = [place], {place}
    while pending:
        current = pending.pop()
        if current == folder:
            fix = f"correct `like` or `standard` in {folder / 'platform.toml'}"
            raise PlatformDataError(f"the platform '{folder.name}' builds on itself", fix=fix)
        settings = _toml(current / "platform.toml")
        further = {resources.find("platform_repo", str(settings[key])) for key in ("like", "standard") if settings.get(key)}
        pending += further - seen
        seen |= further
    return _facts_of(str(place))


@cache
def _virtual_headers(folder: str) -> dict[str, bytes]:
    root = Path(folder)
    return {path.relative_to(root).as_posix(): inputs.read_bytes(path, inputs.SOURCE) for path in sorted(root.rglob("*.h"))}


def _json(path: Path) -> dict[str, Any]:
    try:
        content: dict[str, Any] = json_of(inputs.read_bytes(path, inputs.DATA))
        return content
    except (OSError, ValueError) as error:
        raise PlatformDataError(f"the platform data {path.name} cannot be read: {error}", fix="repair or reinstall it") from error


def _toml(path: Path) -> dict[str, Any]:
    try:
        return toml_of(inputs.read_text(path, inputs.DATA))
    except (OSError, ValueError) as error:
        raise PlatformDataError(f"the platform data {path.name} cannot be read: {error}", fix="repair or reinstall it") from error


def _entries(header: str, content: dict[str, Any]) -> Iterable[tuple[str, ApiEntry]]:
    for name, (result, parameters) in content.get("functions", {}).items():
        yield name, ApiEntry(header, "function", result, parameters)
    for name, function_like in content.get("macros", {}).items():
        yield name, ApiEntry(header, "function_macro" if function_like else "macro")
    for name, of_type in content.get("vars", {}).items():
        yield name, ApiEntry(header, "variable", of_type)
    for name in content.get("consts", ()):
        yield name, ApiEntry(header, "constant")
    for name, form in content.get("types", {}).items():
        yield name, ApiEntry(header, "type", form)


def _pin_facts(fact: dict[str, Any]) -> PinFacts:
    return PinFacts(
        tuple(
            PinParameter(
                p["index"],
                p["name"],
                p["direction"],
                p.get("range_with"),
                p.get("span", 1),
                p.get("count"),
                tuple(p.get("none", ())),
            )
            for p in fact.get("parameters", ())
        ),
        tuple(Convention(**c) for c in fact.get("conventions", ())),
    )
