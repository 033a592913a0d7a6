"""Text to model: the headers of a folder become the API of a source platform in the form of `api.json` (`platform_api`).

Only facts are kept: which header declares which function, macro, variable, constant and type, with its form. Headers are read
like programs (`c_source`), so that text behind false conditions is left out. No header tells what the declarations mean for a
migration; that is written by hand (`meanings.toml`). The chain decides where the result is stored.
"""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, TooLargeError
from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.api_data import HeaderContent
from robosmi.transformations.knowledge.lexer import TYPE_WORDS, definition_parts, directive_parts, tokens
from robosmi.transformations.knowledge.platforms.api_spelling import tidy
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.t2m.c_source import read_unit

ENDINGS = (".h", ".hh", ".hpp")
LARGEST = 4_000_000
MOST = 5000
_SOURCES = (*ENDINGS, ".c", ".cc", ".cpp", ".cxx", ".ino")
_INCLUDE = re.compile(rb"^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"\n]+)[>\"]", re.MULTILINE)
_RECORDS = {"structType": "struct", "unionType": "union", "classType": "class"}
_ADDRESS = re.compile(r"\*\s*+\(\s*+(?:\(\s*+)?(?=[\w\s]*\bvolatile\b)[\w\s]*+\*")


class ApiFound:
    """What the headers of a folder declare.

    Attributes:
        headers: name as it is included -> its entry, in the form of `api.json`.
        paths: the same name -> the file that was read.
        skipped: path -> why it was left out.
        missing: headers that are included and are neither in the folder nor standard ones.
    """

    def __init__(self) -> None:
        self.headers: dict[str, HeaderContent] = {}
        self.paths: dict[str, str] = {}
        self.skipped: dict[str, str] = {}
        self.missing: list[str] = []


class _Declared:
    """What one header declares.

    Attributes:
        aliases: macro -> the one name that it stands for.
        volatile: variables that are declared `volatile`.
    """

    def __init__(self) -> None:
        self.kind = ""
        self.includes: list[str] = []
        self.functions: dict[str, list[str]] = {}
        self.macros: dict[str, int] = {}
        self.vars: dict[str, str] = {}
        self.consts: set[str] = set()
        self.types: dict[str, str] = {}
        self.registers: list[str] = []
        self.aliases: dict[str, str] = {}
        self.volatile: list[str] = []

    def content(self, registers: Collection[str]) -> HeaderContent:
        """The header's entry in `api.json` with those of the given registers that it declares; empty parts are left out."""
        content: HeaderContent = {"kind": self.kind, "source": "import"}
        if self.includes:
            content["includes"] = self.includes
        if self.functions:
            content["functions"] = dict(sorted(self.functions.items()))
        if self.macros:
            content["macros"] = dict(sorted(self.macros.items()))
        if self.vars:
            content["vars"] = dict(sorted(self.vars.items()))
        if self.consts:
            content["consts"] = sorted(self.consts)
        if self.types:
            content["types"] = dict(sorted(self.types.items()))
        if own := sorted(name for name in {*self.macros, *self.vars} if name in registers):
            content["registers"] = own
        return content


def read_headers(folder: Path, api: ApiIndex, include_dirs: Sequence[Path] = (), defines: Sequence[str] = ()) -> ApiFound:
    """The API that the headers below a folder declare.

    Args:
        folder: the platform's headers; sources beside them only tell how the headers are included.
        api: a platform whose settings say how they are parsed and which headers are standard.
        include_dirs: further folders that the headers include from.
        defines: macros from outside, `NAME` or `NAME=VALUE`.

    Raises:
        SourceError: there is no such folder, or no header in it can be read.
        MissingToolError: libclang is not installed.
    """
    if not folder.is_dir():
        raise SourceError("no such folder", location=Location(str(folder)), fix="give the folder of the headers")
    found = ApiFound()
    files = _files(folder, found)
    names = _names(folder, files, found)
    roots = list(dict.fromkeys(_root(path, name) for name, paths in names.items() for path in paths[:1]))
    folders = [*roots, *(str(d) for d in include_dirs)]
    missing: set[str] = set()
    read: dict[str, _Declared] = {}
    by_path = {os.path.realpath(path): name for name, paths in names.items() for path in paths}
    for name, paths in sorted(names.items()):
        for path in paths:
            if name in found.paths:
                found.skipped[str(path)] = f"another header has the same name: {found.paths[name]}"
                continue
            try:
                unit, _ = read_unit(path, api, folders, defines, api.settings.get("language") == "C++")
            except SourceError as error:
                found.skipped[str(path)] = error.message
                continue
            entry = _entry(unit, by_path)
            if lost := _damaged(unit, entry):
                found.skipped[str(path)] = f"syntax errors: RoboSMi reads the rest, but not {', '.join(lost)}"
            missing.update(n for n in entry.includes if n not in names and api.header_kind(n) is None and not _resolved(unit, n))
            entry.kind = api.raw_kind(name) or "platform"
            read[name] = entry
            found.paths[name] = str(path)
    if not read:
        causes = "; ".join(sorted(set(found.skipped.values()))[:3])
        raise SourceError(
            f"no header in this folder could be read{f': {causes}' if causes else ''}",
            location=Location(str(folder)), fix=f"give a folder with headers ({', '.join(ENDINGS)})",
        )  # fmt: skip
    registers = _registers(read, found.paths)
    found.headers = {name: entry.content(registers) for name, entry in read.items()}
    found.missing = sorted(missing)
    return found


def _files(folder: Path, found: ApiFound) -> list[Path]:
    """The headers and sources below a folder; links to a folder that was visited already are not followed."""
    files: list[Path] = []
    seen: set[str] = set()

    def unreadable(error: OSError) -> None:
        found.skipped[str(error.filename)] = f"the folder cannot be read: {error.strerror}"

    for place, folders, names in os.walk(folder, onerror=unreadable, followlinks=True):
        real = os.path.realpath(place)
        if real in seen:
            folders.clear()
            continue
        seen.add(real)
        folders[:] = sorted(f for f in folders if not f.startswith("."))
        files += [Path(place, name) for name in sorted(names) if name.lower().endswith(_SOURCES)]
    return files


def _names(folder: Path, files: Iterable[Path], found: ApiFound) -> dict[str, list[Path]]:
    """How each header is included -> the files of that name: those in folders `include` first, then the least deep.

    A header's name is relative to a folder `include` above it, or as long as some file of the folder writes it, or bare.
    """
    headers: list[Path] = []
    written: set[str] = set()
    for path in files:
        try:
            if path.stat().st_size > LARGEST:
                raise ValueError("it is too large for a header")
            data = inputs.read_bytes(path, inputs.SOURCE)
        except (OSError, ValueError) as error:
            if path.suffix.lower() in ENDINGS:
                found.skipped[str(path)] = (error.strerror if isinstance(error, OSError) else None) or str(error)
            continue
        written.update(os.path.normpath(n.decode("latin-1")).replace("\\", "/") for n in _INCLUDE.findall(data))
        if path.suffix.lower() in ENDINGS:
            headers.append(path)
    if len(headers) > MOST:
        raise TooLargeError(
            f"this folder has {len(headers)} headers, but the limit is {MOST}",
            location=Location(str(folder)), fix="give the folder of the platform's own headers",
        )  # fmt: skip
    names: dict[str, list[Path]] = {}
    ranked: list[tuple[bool, int, str, str, Path]] = []
    for path in headers:
        parts = path.relative_to(folder).parts
        whole = [*folder.resolve().parts[-1:], *parts]
        above = max((i for i, part in enumerate(whole[:-1]) if part in ("include", "inc")), default=None)
        tails = ("/".join(parts[i:]) for i in range(len(parts)))
        name = "/".join(whole[above + 1 :]) if above is not None else next((t for t in tails if t in written), parts[-1])
        ranked.append((above is None, len(parts), str(path), name, path))
    for _, _, _, name, path in sorted(ranked):
        names.setdefault(name, []).append(path)
    return names


def _root(path: Path, name: str) -> str:
    """The folder that the header's name is relative to."""
    return str(path.parents[len(PurePosixPath(name).parts) - 1])


def _resolved(unit: ccode.SourceUnit, name: str) -> bool:
    return any(i.resolvedPath for i in unit.includes if str(i.header) == name)


def _entry(unit: ccode.SourceUnit, by_path: dict[str, str]) -> _Declared:
    """What one header declares."""
    entry = _Declared()
    for include in unit.includes:
        name = by_path.get(os.path.realpath(str(include.resolvedPath)), "") if include.resolvedPath else ""
        entry.includes.append(name or str(include.header))
    for name, like in _defaults(str(unit.path)):
        entry.macros[name] = int(like)
    for macro in unit.macros:
        entry.macros[str(macro.name)] = int(bool(macro.functionLike))
        if not macro.functionLike and _ADDRESS.search(str(macro.body or "")):
            entry.registers.append(str(macro.name))
        elif not macro.functionLike and re.fullmatch(r"[A-Za-z_]\w*", str(macro.body or "")):
            entry.aliases[str(macro.name)] = str(macro.body)
    pending: list[tuple[ccode.Declaration, str]] = [(d, "") for d in reversed(unit.declarations)]
    while pending:
        declaration, scope = pending.pop()
        name = str(declaration.name or "")
        if isinstance(declaration, ccode.Namespace):
            pending += [(d, f"{scope}{name}::") for d in reversed(declaration.declarations)]
        elif isinstance(declaration, ccode.Function):
            entry.functions[scope + name] = _function(declaration)
        elif isinstance(declaration, ccode.Variable):
            entry.vars[scope + name] = _variable(declaration)
            if declaration.valueType is not None and "volatile" in str(declaration.valueType.spelling).split():
                entry.volatile.append(scope + name)
        elif isinstance(declaration, ccode.Enumeration):
            entry.consts |= {scope + str(literal.name) for literal in declaration.literals}
            if name:
                entry.types.setdefault(scope + name, "enum")
        elif isinstance(declaration, ccode.Record):
            if name:
                entry.types.setdefault(scope + name, _RECORDS[declaration.recordKind.name])
                pending += [(m, f"{scope}{name}::") for m in reversed(declaration.methods)]
        elif isinstance(declaration, ccode.Typedef) and name:
            entry.types.setdefault(scope + name, _aliased(declaration))
    return entry


def _aliased(declaration: ccode.Typedef) -> str:
    """The kind of a typedef: `typedef`, followed by the name of the type that it renames, if any."""
    said = str(declaration.aliased.spelling) if declaration.aliased is not None and not declaration.aliased.arrayDims else ""
    named = re.fullmatch(r"[A-Za-z_]\w*", said) and said != declaration.name
    return f"typedef {said}" if named and said not in {*TYPE_WORDS, "enum", "struct", "union"} else "typedef"


def _damaged(unit: ccode.SourceUnit, entry: _Declared) -> list[str]:
    """Remove declarations with syntax errors from a header's entry; returns their names."""
    places = [int(p.startOffset) for p in unit.problems if p.fatal]
    lost = []
    for declaration in unit.declarations if places else ():
        name = str(declaration.name or "")
        if any(int(declaration.startOffset) <= place <= int(declaration.endOffset) for place in places):
            for kind in (entry.functions, entry.vars, entry.types):
                if name in kind:
                    del kind[name]
                    lost.append(name)
    return sorted(lost)


def _defaults(path: str) -> Iterator[tuple[str, bool]]:
    """Macros that the header defines if they are undefined (`#ifndef X`, `#define X`), and whether each has parameters."""
    open_: list[str] = []
    for kind, _, _, text in tokens(inputs.read_bytes(path, inputs.SOURCE)):
        if kind != "directive":
            continue
        word, rest = directive_parts(text)
        if word in ("if", "ifdef", "ifndef"):
            open_.append(rest if word == "ifndef" else "")
        elif word in ("else", "elif") and open_:
            open_[-1] = ""
        elif word == "endif" and open_:
            open_.pop()
        elif word == "define" and open_:
            name, parameters, _ = definition_parts(rest)
            if name and name == open_[-1] and all(len(open_) - i == 1 or outer for i, outer in enumerate(open_)):
                yield name, parameters is not None


def _function(function: ccode.Function) -> list[str]:
    """The return type and the parameter list of a function, in the spelling of `api.json`."""
    text = str(function.signature or "")
    match = re.search(rf"\b{re.escape(str(function.name))}\s*(\(.*\))", text, re.DOTALL)
    result = str(function.returnType.spelling) if function.returnType is not None else "int"
    return [_form(result), _form(match[1]) if match else "()"]


def _form(text: str) -> str:
    """A type or parameter list in the spelling of `api.json`."""
    return tidy(re.sub(r"(?<=\w)\*", " *", re.sub(r"\s+\)", ")", re.sub(r"\(\s+", "(", text))))


def _variable(variable: ccode.Variable) -> str:
    use = variable.valueType
    return _form(f"{use.spelling}{'[]' if use.arrayDims else ''}") if use is not None else "int"


def _registers(read: Mapping[str, _Declared], paths: Mapping[str, str]) -> set[str]:
    """The names of registers: memory at fixed addresses, variables with an assembler name, and aliases of these.

    A variable that is only volatile is none: programs share such variables between cores and with interrupts.
    """
    registers: set[str] = set()
    aliases: dict[str, str] = {}
    for name, entry in read.items():
        registers.update(entry.registers)
        aliases.update(entry.aliases)
        if entry.volatile:
            text = inputs.read_text(paths[name], inputs.SOURCE, errors="replace")
            registers.update(n for n in entry.volatile if re.search(rf"\b{re.escape(n)}\s+(?:__asm__|asm|__asm)\s*\(", text))
    for _ in range(len(aliases)):
        more = {name for name, target in aliases.items() if target in registers} - registers
        if not more:
            break
        registers |= more
    return registers
