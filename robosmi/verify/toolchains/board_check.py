"""Compares a board's file with the core with which its programs are compiled (RS810).

The compiler evaluates the core's headers: a small file with the expressions of interest (`[board_check]` of the toolchain's
data) is compiled to assembler, and the values are read from there. A core may also list its boards in a file of its own. The
claims of a board are content (`Board.claims`); whether they hold is checked here. Results are cached by everything that they
depend on.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from robosmi import inputs
from robosmi.base.data_tables import DataTable
from robosmi.base.data_text import as_table, json_of, json_written
from robosmi.base.user_cache import read_cached, write_cached
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import did_you_mean
from robosmi.verify.toolchains import archives
from robosmi.verify.toolchains.boards import Board, Claim
from robosmi.verify.toolchains.compile_report import OTHER_FACTS
from robosmi.verify.toolchains.temporary import temporary_folder
from robosmi.verify.toolchains.toolchain_data import Toolchain, fill
from robosmi.verify.toolchains.tools import Installed

_ELEMENT = re.compile(r"(\w+)\[(.+)\]")
_LABEL = re.compile(r"^(\w+):$")
_DATA = re.compile(r"^\s+\.(byte|word|short|long|zero|skip)\s+(\S(?:.*\S)?)\s*$")
_SIZES = {"byte": 1, "word": 2, "short": 2, "long": 4}
_TOLD = "told_of_board"
_LONGEST = 200
_INCLUDED = re.compile(r'^[ \t]*+#[ \t]*+include[ \t]++"([^"\n]+)"', re.MULTILINE)
_CONSTANT = re.compile(
    r"^[ \t]*+(?:#[ \t]*+define[ \t]++(\w++)[ \t]|(?:(?:static|constexpr|const)[ \t]++)++\w++[ \t]++(\w++)[ \t]*+=)"
    r"[ \t(]*+(\w++)[ \t);]*+(?:/[/*].*)?$",
    re.MULTILINE,
)
_NUMBER = re.compile(r"(0[xX][0-9a-fA-F]+|0|[1-9]\d*)[uUlL]*")
_STEPS = 8
"""How many constants may stand for one another."""

Arrays = Mapping[str, bytes]
"""Name of an array -> its bytes, in little-endian order."""


def board_findings(board: Board, toolchain: Toolchain, installed: Installed) -> list[Finding]:
    """The contradictions between a board's file and the core; none if the toolchain has no such check.

    Raises:
        PlatformDataError: the toolchain's data is damaged.
    """
    check = toolchain.board_check
    claims = board.claims() if check.values else ()
    if not claims:
        return []
    return [*_pin_findings(board, claims, check, toolchain, installed), *_list_findings(board, check, installed)]


def size_findings(board: Board, told: Board) -> list[Finding]:
    """The sizes in which a board's file contradicts the core that builds its programs.

    Args:
        board: the board as its file has it.
        told: the board as the core has it, which may know no sizes.
    """
    found = []
    for name in ("flash_bytes", "ram_bytes"):
        own, of_core = getattr(board, name), getattr(told, name)
        if of_core is not None and own != of_core:
            found.append(_other_value(board, name, str(own), str(of_core), told.name))
    return found


def version_finding(board: Board, version: str) -> list[Finding]:
    """What is said where a board's file is of another version of its core than the one that builds its programs."""
    own = board.values.get("core_version", "")
    if own in ("", version):
        return []
    cause = f"the file of the board '{board.name}' is of version {own} of its core; {version} builds the program"
    fix = f"install version {own}, or compare the board's file with version {version} and correct 'core' in it"
    return [Finding(OTHER_FACTS, Severity.info, cause, _place(board.file, "core ="), fix=fix)]


def constant_findings(board: Board, toolchain: Toolchain, folders: Sequence[Path]) -> list[Finding]:
    """The pins in which a board's file contradicts the constants in the headers of its core, read without a compiler.

    Args:
        board: the board as its file has it.
        toolchain: its data says which header of a core has numbers of pins.
        folders: the folder of the core, and that of the board's variant.
    """
    header = toolchain.board_check.text("core_header", "")
    core = [path for path in (folders[0] / header,) if path.is_file()] if header else []
    named = _constants([*(file for folder in folders[1:] for file in sorted(folder.glob("*.h"))), *core])
    found = []
    for claim in board.claims():
        asked = claim.label if _NUMBER.fullmatch(claim.ask) else claim.ask  # programs may write a pin's number without its name
        told, own = _constant(asked, named), _constant(claim.answer, named)
        if None not in (told, own) and told != own:
            found.append(_contradiction(board, claim, str(told), folders[-1].name))
    return found


def _constants(headers: Sequence[Path]) -> dict[str, str]:
    """Name -> text of the constants in headers and in those that these include; none that is defined in several ways."""
    texts = [inputs.read_text(file, inputs.DATA, "utf-8", "replace") for file in headers]
    for file, text in zip(headers, [*texts], strict=True):  # what a variant shares with others
        shared = [(file.parent / name).resolve() for name in _INCLUDED.findall(text)]
        texts += [inputs.read_text(path, inputs.DATA, "utf-8", "replace") for path in shared if path.is_file()]
    found: dict[str, set[str]] = {}
    for text in texts:
        for macro, constant, value in _CONSTANT.findall(text):
            found.setdefault(macro or constant, set()).add(value)
    return {name: values.pop() for name, values in found.items() if len(values) == 1}


def _constant(text: str, named: Mapping[str, str]) -> int | None:
    """The number that a text is or, through constants, names; None for another text."""
    for _ in range(_STEPS):
        if (number := _NUMBER.fullmatch(text)) is not None:
            return int(number[1], 0)
        if text not in named:
            return None
        text = named[text]
    return None


# ---- what the core's headers say


def _pin_findings(
    board: Board, claims: Sequence[Claim], check: DataTable, toolchain: Toolchain, installed: Installed
) -> Iterator[Finding]:
    """A finding for each claim that the headers contradict, or a single one if they cannot be compiled for the board."""
    asked = [_asked(claim) for claim in claims]
    wanted = dict.fromkeys(expression for each in asked for _, expression in each)
    found = _answers([*wanted], board, check, toolchain, installed)
    if isinstance(found, str):
        fix = "correct 'variant', 'mcu' or 'define' in the board's file"
        cause = f"the core's files cannot be compiled as the file of the board '{board.name}' says: {found}"
        yield Finding(OTHER_FACTS, Severity.error, cause, _place(board.file, "variant ="), fix=fix)
        return
    numbers = dict(zip(wanted, _numbers(found.get(_TOLD, b""), _SIZES["long"]), strict=True))
    for claim, each in zip(claims, asked, strict=True):
        values = [_value(table, numbers[expression], found) for table, expression in each]
        if values[0] == values[1]:
            continue
        others = zip(claim.choices, values[2:], strict=True)
        told = next((choice for choice, value in others if value == values[0]), "no such pin" if values[0] is None else values[0])
        yield _contradiction(board, claim, str(told), board.values.get("variant", ""))


def _contradiction(board: Board, claim: Claim, told: str, variant: str) -> Finding:
    return Finding(
        OTHER_FACTS, Severity.error,
        f"the file of the board '{board.name}' says that {claim.says}; in the core that programs are compiled with"
        f" (variant '{variant}') it is {told}",
        _place(claim.file, claim.beside), fix=f"correct {claim.key} in that file, or give the matching variant",
        evidence={"claim": claim.says, "core": told},
    )  # fmt: skip


def _asked(claim: Claim) -> list[tuple[str, str]]:
    """For a claim's question, answer and choices: the array (empty for none) and the expression of the index or value."""
    found = []
    for text in (claim.ask, claim.answer, *claim.choices):
        element = _ELEMENT.fullmatch(text)
        found.append((element[1], element[2]) if element is not None else ("", text))
    return found


def _value(table: str, number: int, found: Arrays) -> int | None:
    if not table:
        return number
    values = found.get(table, b"")
    return values[number] if 0 <= number < len(values) else None


def _answers(wanted: Sequence[str], board: Board, check: DataTable, toolchain: Toolchain, installed: Installed) -> Arrays | str:
    """The arrays of the compiled file, or why it does not compile."""
    text = check.text("source").replace("{told}", ", ".join(f"(long)({each})" for each in wanted)).replace("{name}", _TOLD)
    files = [*_headers(installed.core, toolchain, board)]
    kept = f"boards/{archives.digest(files, text, board, installed)}.json"
    with suppress(ValueError, TypeError):
        record = as_table(json_of((read_cached(kept) or b"").decode()))
        return {name: bytes.fromhex(str(data)) for name, data in record.items()}
    with temporary_folder("board") as folder:
        source, made = Path(folder) / f"board{check.text('suffix')}", Path(folder) / "board.s"
        source.write_text(text, encoding="utf-8")
        values = board.fill() | {"core": str(installed.core)}
        arguments = [*toolchain.flags.texts("common"), *check.texts("arguments")]
        arguments = fill(arguments, values, {"extra_flags": board.extra_flags})
        said = installed.run(check.text("tool"), [*arguments, "-o", str(made), str(source)], Path(folder))
        if said.returncode:
            error = next((line for line in said.stderr.splitlines() if "error" in line), said.stderr.strip())
            return error.partition("error: ")[2][:_LONGEST] or error[:_LONGEST]
        found = arrays(inputs.read_text(made, inputs.OUTPUT).splitlines())
    write_cached(kept, json_written({name: data.hex() for name, data in found.items()}).encode())
    return found


def _headers(core: Path, toolchain: Toolchain, board: Board) -> Iterator[Path]:
    """The files whose change makes kept answers stale."""
    named = toolchain.core.texts("board_files", ())
    places = [core / text for text in fill(named, board.fill(), {})]
    for place in (core / toolchain.core.text("sources"), *places, *board.folders):
        yield from sorted(place.glob("*.h"))


def arrays(lines: Iterable[str]) -> dict[str, bytes]:
    """The data below each label of a file in assembler.

    >>> arrays(["ports:", " .byte 4", " .zero 2", " .word 258"])
    {'ports': b'\\x04\\x00\\x00\\x02\\x01'}
    """
    found: dict[str, bytearray] = {}
    own: bytearray | None = None
    for line in lines:
        if (label := _LABEL.match(line)) is not None:
            own = found.setdefault(label[1], bytearray())
        elif own is not None and (data := _DATA.match(line)) is not None:
            own += _bytes(data[1], data[2])
    return {name: bytes(data) for name, data in found.items()}


def _bytes(kind: str, text: str) -> bytes:
    try:
        value = int(text, 0)
    except ValueError:  # an address, which no claim asks for
        return bytes(_SIZES.get(kind, 0))
    return (value % 2 ** (8 * _SIZES[kind])).to_bytes(_SIZES[kind], "little") if kind in _SIZES else bytes(value)


def _numbers(data: bytes, size: int) -> list[int]:
    return [int.from_bytes(data[at : at + size], "little", signed=True) for at in range(0, len(data), size)]


# ---- what the core's list of boards says


def _list_findings(board: Board, check: DataTable, installed: Installed) -> Iterator[Finding]:
    """What the core's own entry of the board contradicts; nothing for boards of other cores."""
    prefix, path = check.text("listed_prefix"), installed.core / check.text("listed_in")
    full = next((name for name in board.full_names if name.startswith(prefix)), "")
    if not full or not path.is_file():
        return
    text = inputs.read_text(path, inputs.OUTPUT, "utf-8", "replace")
    entries = {entry[1]: entry[2].rstrip() for entry in re.finditer(r"^([\w.]+)=(.*)", text, re.MULTILINE)}
    short, _, option = full.removeprefix(prefix).partition(":")
    known = {key.partition(".")[0] for key in entries if key.endswith(".name") and key.count(".") == 1}
    if short not in known:
        cause = f"the file of the board '{board.name}' calls it '{full}', but the core does not list that board"
        fix = f"correct the name{did_you_mean(short, known)}: upload tools need it"
        yield Finding(OTHER_FACTS, Severity.warning, cause, _place(board.file, full), fix=fix)
        return
    keys = check.table("listed")
    for key in keys.values:
        name = keys.text(key)
        own = board.values.get(name) or {"flash_bytes": str(board.flash_bytes), "ram_bytes": str(board.ram_bytes)}.get(name, "")
        told = _listed(entries, short, option, key)
        if told and own not in told:
            yield _other_value(board, name, own, " or ".join(told), full)


def _other_value(board: Board, name: str, own: str, told: str, full_name: str) -> Finding:
    cause = f"the file of the board '{board.name}' says {name} {own}; the core's list has {told} for '{full_name}'"
    fix = f"correct {name} in that file, or give the board its own full name"
    return Finding(OTHER_FACTS, Severity.warning, cause, _place(board.file, f"{name} ="), fix=fix)


def _listed(entries: Mapping[str, str], short: str, option: str, key: str) -> list[str]:
    """What a list of boards has for a key: of the option that is named, else of the board or of any of its options."""
    if option:
        menu, _, chosen = option.partition("=")
        found = [entries.get(f"{short}.menu.{menu}.{chosen}.{key}", entries.get(f"{short}.{key}", ""))]
    elif f"{short}.{key}" in entries:
        found = [entries[f"{short}.{key}"]]
    else:
        found = [value for name, value in entries.items() if re.fullmatch(rf"{short}\.menu\.\w+\.\w+\.{re.escape(key)}", name)]
    return [value.removesuffix("L") for value in dict.fromkeys(found) if value]


def _place(file: Path | None, beside: str) -> Location | None:
    """The line of a board's file that has a text, or the file."""
    if file is None:
        return None
    lines = inputs.read_text(file, inputs.SETTINGS).splitlines()
    return Location(str(file), next((number for number, line in enumerate(lines, 1) if beside and beside in line), None))
