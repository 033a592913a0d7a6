"""Joins the objects of the original to one, in which no name is one of this machine's, and finds its coverage counters.

What may stay as it is decides `linked_names`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Protocol

from msgspec import Struct

from robosmi import inputs
from robosmi.errors import VerificationError
from robosmi.verify.elf_reader import LOCAL, ElfFile, read_elf
from robosmi.verify.host_model import HostModel
from robosmi.verify.linked_names import HOOKS, JOINING, AllowedNames, Names, check_named, check_object, names_of, renamed_sections

_COUNTERS_OF = "__gcov0."
_COUNTERS = re.compile(rf"{re.escape(_COUNTERS_OF)}(.+)")
_MADE = inputs.Kind("file that a compiler has made of the program", 64 * 1024 * 1024)


class RunTool(Protocol):
    """Runs one of the tools of a host model and returns what it prints."""

    def __call__(self, role: str, /, *arguments: str) -> str:
        """Run the tool with a role in `host.toml`."""


class Counters(Struct, frozen=True):
    """The coverage counters of a function: the notes of its object, its name, and their place and size in bytes."""

    notes: Path
    function: str
    begin: int
    size: int


class JoinedObjects(Struct, frozen=True):
    """A program as one object.

    Attributes:
        path: the object.
        unmodelled: functions that it uses and that neither it nor the model has.
        counters: where its coverage counters are in its data.
    """

    path: Path
    unmodelled: tuple[str, ...]
    counters: tuple[Counters, ...]


def read_tool_file(path: Path) -> bytes:
    """The content of a file that a tool has made of the program.

    Raises:
        VerificationError: it is too large.
    """
    try:
        return inputs.read_bytes(path, _MADE)
    except OSError as error:
        raise VerificationError(
            f"the program is too large for this machine: {error.strerror}", fix="reduce the program's data"
        ) from error


def elf_at(path: Path) -> ElfFile:
    """An object or program that tools have made.

    Raises:
        VerificationError: it cannot be read.
    """
    return read_elf(read_tool_file(path))


def joined(objects: Sequence[Path], folder: Path, model: HostModel, known: frozenset[str], run: RunTool) -> JoinedObjects:
    """Join the objects of a program, and give all that it defines a name of its own.

    Args:
        objects: the objects, with their compiler's notes in their folder.
        folder: where files are made.
        model: the host model.
        known: the names that the model defines.
        run: runs a tool.

    Raises:
        VerificationError: the program has names or sections that could replace this machine's.
    """
    script, path, named = folder / "joining.ld", folder / "joined.o", folder / "program.o"
    elves = [elf_at(each) for each in objects]
    for elf in elves:
        check_object(elf)
    script.write_text(JOINING)
    words = ["-r", "-m", model.compiler.text("linker_machine"), "--force-group-allocation", "-T", str(script), "-o", str(path)]
    run("linker", *words, *(str(each) for each in objects))
    whole = elf_at(path)
    names, allowed = names_of(whole), AllowedNames(model.same, known)
    if "main" not in names.defined:
        raise VerificationError("the program has no main function", fix="also give the file that has it")
    if taken := sorted(names.defined & HOOKS):
        raise VerificationError(f"the program defines names that its compiler uses: {', '.join(taken)}", fix="rename it")
    renamed, removed = renamed_sections(whole)
    more = [word for old, new in renamed.items() for word in ("--rename-section", f"{old}={new}")]
    more += [word for name in removed for word in ("--remove-section", name)]
    rename(path, named, names, allowed, model.prefix, run, *more)
    check_named(elf_at(named), model.prefix, allowed)
    own = {model.prefix + name for name in names.defined} | known
    unmodelled = sorted(name for name in names.used if name not in allowed and model.prefix + name not in own)
    return JoinedObjects(named, tuple(unmodelled), tuple(_counters(objects, elves, whole)))


def rename(path: Path, target: Path, names: Names, allowed: AllowedNames, prefix: str, run: RunTool, *more: str) -> None:
    """Give the names of an object a prefix.

    Args:
        path: the object.
        target: the object that is made, which may be the same.
        names: its names.
        allowed: those that it uses and that stay.
        prefix: the prefix.
        run: runs a tool.
        more: further arguments.
    """
    own = names.defined | {name for name in names.used if name not in allowed}
    table = target.with_suffix(".names")
    table.write_text("".join(f"{name} {prefix}{name}\n" for name in sorted(own)), encoding="utf-8")
    run("rename", f"--redefine-syms={table}", *more, str(path), str(target))


def _counters(objects: Sequence[Path], elves: Sequence[ElfFile], whole: ElfFile) -> list[Counters]:
    """The counters of all functions: a linker keeps the order of the objects' local symbols."""
    listed = [
        (path.with_suffix(".gcno"), found[1])
        for path, elf in zip(objects, elves, strict=True)
        for symbol in elf.symbols
        if (found := _COUNTERS.fullmatch(symbol.name)) and symbol.binding == LOCAL
    ]
    places = [symbol for symbol in whole.symbols if _COUNTERS.fullmatch(symbol.name) and symbol.binding == LOCAL]
    if [name for _, name in listed] != [symbol.name.removeprefix(_COUNTERS_OF) for symbol in places]:
        raise VerificationError("the counters of coverage cannot be read", fix="remove assembler text from the program")
    return [Counters(notes, name, symbol.value, symbol.size) for (notes, name), symbol in zip(listed, places, strict=True)]
