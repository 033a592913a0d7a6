"""The chain `platform import`: the headers of a folder become a source platform of the user's own.

It is stored in the user's data folder, where every command finds it by its name; a second import of the same name adds to the
first. Its settings (`platform.toml`) are those of another platform, with the macros given, and are the user's to change: an
import does not overwrite them. Reading the headers is `t2m.platform_headers`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, cast

from msgspec import Struct

from robosmi import inputs, resources
from robosmi.base.data_text import as_table, json_of, json_written
from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import PlatformDataError, UsageError, did_you_mean
from robosmi.files.files import write_atomic
from robosmi.project import default_text
from robosmi.transformations.knowledge.api_data import HeaderContent, PlatformSettings
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex, forget_platforms
from robosmi.transformations.t2m.platform_headers import read_headers

_NAME = re.compile(r"[A-Za-z][\w-]{0,63}")
_KINDS = ("functions", "macros", "vars", "consts", "types", "registers")


class PlatformImport(Struct, frozen=True):
    """What an import did: the platform's folder, the contract's result, what was left out, and the files written."""

    folder: Path
    result: dict[str, Any]
    findings: list[Finding]
    written: list[str]

    def lines(self) -> list[str]:
        """What the user reads."""
        totals = self.result["totals"]
        lines = [
            f"{quantity(len(self.result['added']), 'header')} to {self.folder}: " + ", ".join(f"{totals[k]} {k}" for k in totals)
        ]
        if self.result["missing"]:
            lines.append(f"  headers not found: {', '.join(self.result['missing'][:10])}")
        return [*lines, f"use it: --source-platform {self.result['platform']}"]


def import_platform(
    folder: Path, name: str, like: str | None = None, include_dirs: Sequence[Path] = (), defines: Sequence[str] = ()
) -> PlatformImport:
    """Add the headers of a folder to a source platform of the user's own.

    Args:
        folder: holds the headers, below it too.
        name: of the platform; new, or one that was imported before.
        like: a known platform that gives the settings of the parser, widths of types, the C library, and the meaning of the
            functions that both have; one of which nothing is known if None.
        include_dirs: further folders that the headers include from.
        defines: macros from outside, for its programs too.

    Raises:
        UsageError: the name cannot be used, or there is no platform to be like.
        SourceError: there is no such folder, or no header in it can be read.
        PlatformDataError: what was imported before is damaged.
    """
    base = _base(name, like)
    found = read_headers(folder, base, include_dirs, defines)
    target = resources.user_data() / "platform_repo" / name
    before = _headers(target / "api.json")
    headers = before | found.headers
    rows = ",\n".join(f"{_line(header)}:{_line(entry)}" for header, entry in sorted(headers.items()))
    write_atomic(target / "api.json", ('{"headers":{\n' + rows + "\n}}\n").encode())
    written = [target / "api.json"]
    if not (target / "platform.toml").is_file():
        write_atomic(target / "platform.toml", _settings(name, base, defines).encode())
        written.append(target / "platform.toml")
    forget_platforms()
    counts = [_counts(entry) for entry in found.headers.values()]
    names = [str(path) for path in written]
    result = {
        "platform": name,
        "like": base.name,
        "added": [
            {"header": header, "path": found.paths[header], "kind": entry["kind"], "replaced": header in before} | _counts(entry)
            for header, entry in sorted(found.headers.items())
        ],
        "skipped": [{"path": path, "why": why} for path, why in sorted(found.skipped.items())],
        "missing": found.missing,
        "written": names,
        "totals": {kind: sum(each[kind] for each in counts) for kind in _KINDS},
        "known": len(headers),
    }
    return PlatformImport(target, result, _findings(found.skipped, found.missing), names)


def _base(name: str, like: str | None) -> ApiIndex:
    own = resources.user_data() / "platform_repo" / name
    if not _NAME.fullmatch(name):
        raise UsageError(f"'{name}' is not a valid platform name", fix="use letters, digits, _ and -; start with a letter")
    if (resources.built_in("platform_repo") / name).exists():
        raise UsageError(f"'{name}' is a built-in platform", fix=f"give another name, and --like {name} for its settings")
    if own.exists() and not (own / "api.json").is_file():
        raise UsageError(f"'{name}' is taken: {own} has other data", fix="give another name")
    if like is None and (own / "platform.toml").is_file():
        return ApiIndex.load(name)  # as at the first import
    known = sorted({api.parent.name for place in resources.folders("platform_repo") for api in place.glob("*/api.json")})
    like = like or default_text("platform_import", "like")
    if like not in known or like == name:
        raise UsageError(f"--like: unknown platform '{like}'{did_you_mean(like, known)}", fix=f"use one of: {', '.join(known)}")
    return ApiIndex.load(like)


def _counts(entry: HeaderContent) -> dict[str, int]:
    """The number of declarations of each kind in a header."""
    return {
        "functions": len(entry.get("functions", {})),
        "macros": len(entry.get("macros", {})),
        "vars": len(entry.get("vars", {})),
        "consts": len(entry.get("consts", [])),
        "types": len(entry.get("types", {})),
        "registers": len(entry.get("registers", [])),
    }


def _headers(path: Path) -> dict[str, HeaderContent]:
    """The headers of earlier imports.

    Raises:
        PlatformDataError: the file is damaged.
    """
    if not path.is_file():
        return {}
    try:
        headers = as_table(json_of(inputs.read_bytes(path, inputs.DATA)))["headers"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise PlatformDataError(f"{path} is damaged: {error}", fix="delete the file and import again") from error
    if not isinstance(headers, dict):
        raise PlatformDataError(f"{path} is damaged: it has no table of headers", fix="delete the file and import again")
    return cast("dict[str, HeaderContent]", headers)


def _settings(name: str, base: ApiIndex, defines: Sequence[str]) -> str:
    """The text of `platform.toml`: the settings of another platform under the new name."""
    parser = base.settings["parser"].copy()
    parser["defines"] = list(dict.fromkeys([*parser.get("defines", []), *defines]))
    settings: PlatformSettings = {
        **base.settings,
        "name": name,
        "title": name,
        "standard": base.settings.get("standard", base.name),
        "like": base.name,
        "parser": parser,
    }
    lines = [
        f"# Made by `robosmi platform import` after the settings of '{base.name}'. Yours to change; another import keeps it.",
        "",
    ]
    lines += [f"{key} = {_value(value)}" for key, value in settings.items() if not isinstance(value, dict)]
    for key, value in settings.items():
        if isinstance(value, dict):
            lines += ["", f"[{key}]", *(f"{_key(k)} = {_value(v)}" for k, v in value.items())]
    return "\n".join(lines) + "\n"


def _key(key: str) -> str:
    return key if re.fullmatch(r"[\w-]+", key) else json_written(key)


def _value(value: Any) -> str:
    """A TOML value made of the types that settings have: texts, numbers, booleans, lists and tables."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(v) for v in value) + "]"
    return json_written(value, ensure_ascii=False)


def _line(value: Any) -> str:
    return json_written(value, ensure_ascii=True, separators=(",", ":"))


def _findings(skipped: dict[str, str], missing: Sequence[str]) -> list[Finding]:
    found = [Finding("RS110", Severity.info, f"skipped: {why}", Location(path)) for path, why in sorted(skipped.items())]
    return found + [
        Finding("RS111", Severity.info, f"a header includes {name}, but it was not found", None, fix="give its folder with -I")
        for name in missing
    ]
