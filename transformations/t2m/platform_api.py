"""What the repository knows of a platform's API: which header declares a name, as what, and what it means.

`ApiIndex` answers look-ups from the platform's folder (`platform.toml`, `api.json`, `pins.json`, `meanings.toml`) and
builds the part of the platform model that a program needs. A platform takes over the C library of the one that its
`standard` names, pins and meanings of the one that its `like` names. No platform is known by name here, no program is read
here; the queries in `queries.code` put both together.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from robosmi import inputs, resources
from robosmi.data_text import json_of, toml_of
from robosmi.errors import PlatformDataError

if TYPE_CHECKING:
    from robosmi.metamodels import platform as pf

HEADER_KINDS = {"platform": "platform", "standard": "standard", "posix": "posix", "std-internal": "standard"}


class Entry(NamedTuple):
    """One declaration of a name in one header.

    Attributes:
        header: as it is included.
        kind: function, function_macro, macro, variable, constant or type.
        detail: of a function its return type, of a variable its type, of a type its form (typedef, struct ...).
        parameters: of a function, from the opening to the closing parenthesis.
    """

    header: str
    kind: str
    detail: str = ""
    parameters: str = ""

    @property
    def callable(self) -> bool:
        """True for functions and function-like macros."""
        return self.kind in ("function", "function_macro")


class PinParameter(NamedTuple):
    """A parameter that is a pin, as `pins.json` has it.

    Attributes:
        position: which argument, from 0.
        name: as declared.
        direction: in, out, both, unknown.
        range_with: position of the other end, where two arguments give a range.
        span: how many pins follow each other from the argument on.
        number: position of the argument that says how many elements of an array of pins count.
        none: constants that mean no pin.
    """

    position: int
    name: str
    direction: str
    range_with: int | None = None
    span: int = 1
    number: int | None = None
    none: tuple[str, ...] = ()


class Convention(NamedTuple):
    """A pin that a function uses without an argument; `when` restricts it to calls with such an argument."""

    pin: int
    direction: str
    what: str
    set_by: str | None = None
    when: dict[str, int] | None = None


class PinFacts(NamedTuple):
    """The pins of one function of one header."""

    parameters: tuple[PinParameter, ...]
    conventions: tuple[Convention, ...]


class ApiIndex:
    """The API of one platform.

    Args:
        folder: the platform's folder in the repository.

    Raises:
        PlatformDataError: a file is missing or damaged.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.settings: dict[str, Any] = _toml(folder / "platform.toml")
        self._standard = _other(self.settings.get("standard"), folder)
        self._like = _other(self.settings.get("like"), folder)
        own: dict[str, dict[str, Any]] = _json(folder / "api.json").get("headers", {})
        inherited = self._standard._headers if self._standard is not None else {}
        self._headers: dict[str, dict[str, Any]] = {h: c for h, c in inherited.items() if c["kind"] != "platform"} | own
        self._entries: dict[str, list[Entry]] = {}
        self._registers: set[str] = set(self.settings.get("registers", {}).get("names", ()))
        for header, content in self._headers.items():
            self._registers.update(content.get("registers", ()))
            for name, entry in _entries(header, content):
                self._entries.setdefault(name, []).append(entry)
        self._closures: dict[tuple[str, ...], tuple[str, ...]] = {}
        self._pins: dict[tuple[str, str], PinFacts] | None = None
        self._meanings: dict[str, Any] | None = None
        self._cogs: dict[str, Sequence[str]] | None = None

    @staticmethod
    def load(name: str) -> ApiIndex:
        """The index of the platform of that name, one a process.

        Raises:
            PlatformDataError: the repository has no such platform, or its data is damaged.
        """
        return _load(str(resources.find("platform_repo", name)))

    @property
    def name(self) -> str:
        """The platform's name."""
        return str(self.settings["name"])

    def header_kind(self, header: str) -> str | None:
        """platform, standard or posix; None for a header that the repository does not know."""
        content = self._headers.get(header)
        if content is not None:
            return HEADER_KINDS[content["kind"]]
        return "standard" if header in self.virtual_headers() else None

    def raw_kind(self, header: str) -> str | None:
        """The kind of a header as `api.json` writes it (also std-internal); None for an unknown one."""
        content = self._headers.get(header)
        return str(content["kind"]) if content is not None else self.header_kind(header)

    def closure(self, includes: Iterable[str]) -> tuple[str, ...]:
        """The headers that these includes bring in, an including header before the ones it includes."""
        key = tuple(includes)
        known = self._closures.get(key)
        if known is None:
            order: dict[str, None] = {}
            pending = list(reversed(key))
            while pending:
                header = pending.pop()
                if header in self._headers and header not in order:
                    order[header] = None
                    pending.extend(reversed(self._headers[header].get("includes", ())))
            known = self._closures[key] = tuple(order)
        return known

    def entries(self, name: str) -> Sequence[Entry]:
        """All declarations of a name, in the order of their headers' names; empty for an unknown name."""
        if name in self.settings["parser"].get("builtins", {}):
            return [Entry("", "function", self.settings["parser"]["builtins"][name], "()")]
        return self._entries.get(name, ())

    def resolve(self, name: str, includes: Iterable[str]) -> Entry | None:
        """The one declaration that a program with these includes means.

        Headers that the includes bring in come first, those included earlier before later ones; then, for a program that forgot
        the include, any header of the platform before standard ones. None for a name that the repository does not know.
        """
        found = self.entries(name)
        if len(found) <= 1:
            return found[0] if found else None
        order = {header: i for i, header in enumerate(self.closure(includes))}
        outside = len(order)
        return min(found, key=lambda e: (order.get(e.header, outside), self.kind_of(e) != "platform", e.header))

    def kind_of(self, entry: Entry) -> str:
        """platform, standard or posix, as the entry's header is; builtins of the compiler are the platform's."""
        return self.header_kind(entry.header) or "platform" if entry.header else "platform"

    def signature(self, name: str, entry: Entry) -> str:
        """Return type, name and parameters of a function; `name(...)` for a function-like macro; type and name of others."""
        if entry.kind == "function":
            return f"{entry.detail}{'' if entry.detail.endswith('*') else ' '}{name}{entry.parameters}"
        if entry.kind == "function_macro":
            return f"{name}(...)"
        return f"{entry.detail} {name}".strip()

    def pins(self, function: str, header: str) -> PinFacts | None:
        """Pins of a function as the header declares it, or None where nothing is known."""
        if self._pins is None:
            self._pins = {}
            path = self._file("pins.json")
            for fact in _json(path).get("functions", []) if path.is_file() else ():
                facts = _pin_facts(fact)
                self._pins.update({(fact["function"], h): facts for h in fact["headers"]})
        return self._pins.get((function, header))

    def meaning(self, function: str) -> dict[str, Any]:
        """What `meanings.toml` says of a function: parameters, blocking, startsCog."""
        found: dict[str, Any] = self._meaning_tables().get("functions", {}).get(function, {})
        return found

    def symbol_meaning(self, symbol: str) -> dict[str, str]:
        """What `meanings.toml` says of another name: kind, type, meaning."""
        found: dict[str, str] = self._meaning_tables().get("symbols", {}).get(symbol, {})
        return found

    def symbol_kind(self, name: str, entry: Entry) -> str:
        """macro, constant, register or variable (contract: `platform_symbols[].kind`)."""
        if name in self._registers:
            return "register"
        return {"macro": "macro", "function_macro": "macro", "constant": "constant"}.get(entry.kind, "variable")

    def is_register(self, name: str) -> bool:
        """Whether the platform has a register of that name."""
        return name in self._registers

    def code_argument(self, function: str) -> int | None:
        """Which argument, from 0, is the code that a function starts on another core; None for a function that starts none."""
        position = self.settings.get("cogs", {}).get(function)
        return None if position is None else int(position)

    def starts_cog(self, function: str, header: str) -> bool:
        """Whether a function, as the header declares it, starts code on another core, its own or that of its library."""
        if self.code_argument(function) is not None or function in self._library_cogs().get(header, ()):
            return True
        return bool(self.meaning(function).get("startsCog", False))

    def virtual_headers(self) -> dict[str, bytes]:
        """Our own text of the standard headers, by the name a program includes."""
        own = _virtual_headers(str(self.folder / "include"))
        return self._standard.virtual_headers() | own if self._standard is not None else own

    def to_model(self, names: Iterable[str], includes: Iterable[str] = ()) -> pf.Platform:
        """The part of the platform model that has these names, each in the one header where it resolves."""
        from robosmi.transformations.t2m.platform_model import build

        return build(self, names, tuple(includes))

    def _library_cogs(self) -> dict[str, Sequence[str]]:
        if self._cogs is None:
            path = self._file("cogs.toml")
            self._cogs = _toml(path).get("headers", {}) if path.is_file() else {}
        return self._cogs

    def _meaning_tables(self) -> dict[str, Any]:
        if self._meanings is None:
            path = self._file("meanings.toml")
            self._meanings = _toml(path) if path.is_file() else {}
        return self._meanings

    def _file(self, name: str) -> Path:
        """A file of the platform's own folder, or of the platform that it is like; it need not exist."""
        path = self.folder / name
        return path if self._like is None or path.is_file() else self._like._file(name)


def forget_platforms() -> None:
    """Read every platform anew when it is asked for next: one was imported."""
    _load.cache_clear()


def _other(name: str | None, folder: Path) -> ApiIndex | None:
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
    return _load(str(place))


@cache
def _load(folder: str) -> ApiIndex:
    return ApiIndex(Path(folder))


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


def _entries(header: str, content: dict[str, Any]) -> Iterable[tuple[str, Entry]]:
    for name, (result, parameters) in content.get("functions", {}).items():
        yield name, Entry(header, "function", result, parameters)
    for name, function_like in content.get("macros", {}).items():
        yield name, Entry(header, "function_macro" if function_like else "macro")
    for name, of_type in content.get("vars", {}).items():
        yield name, Entry(header, "variable", of_type)
    for name in content.get("consts", ()):
        yield name, Entry(header, "constant")
    for name, form in content.get("types", {}).items():
        yield name, Entry(header, "type", form)


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
