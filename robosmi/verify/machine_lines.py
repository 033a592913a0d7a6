"""Which lines of the user's files the instructions of a linked program belong to, and which of them decide between two ways.

The linker inlines functions across files, so that an instruction belongs to a line of each function that is inlined there. The
commands and the forms of what they print are data of the toolchain (`[original]`).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path

from msgspec import Struct

from robosmi.base.data_tables import DataTable
from robosmi.errors import VerificationError
from robosmi.verify.toolchains.temporary import temporary_folder
from robosmi.verify.toolchains.toolchain_data import Toolchain, fill
from robosmi.verify.toolchains.tools import Installed

Line = tuple[str, int]
_PLACE = re.compile(r"^(?P<path>.+):(?P<line>\d+)(?: \(discriminator \d+\))?$")


class MachineLines(Struct, frozen=True):
    """The instructions of the user's lines.

    Attributes:
        lines: (file, line) -> addresses of its instructions, those of inlined functions included.
        decisions: (file, line) -> addresses of its own conditional jumps and skips.
    """

    lines: Mapping[Line, tuple[int, ...]]
    decisions: Mapping[Line, tuple[int, ...]]


def machine_lines(elf: Path, toolchain: Toolchain, installed: Installed, own: Callable[[str], str | None]) -> MachineLines:
    """Read the lines of a program with debugging information.

    Args:
        elf: the linked program.
        toolchain, installed: with which it was built.
        own: path of a file as the debugging information has it -> its name if it is the user's, else None.

    Raises:
        VerificationError: the toolchain has no data for this, or a tool fails.
    """
    data = toolchain.original
    if not data.values:
        raise VerificationError(f"nothing tells which lines of a program for {toolchain.title} run")
    conditional, pattern = data.pattern("conditional"), data.pattern("pattern")
    listing = _run(data, "instructions", installed, {"elf": str(elf)})
    kinds = {int(found["address"], 16): found["mnemonic"] for line in listing.splitlines() if (found := pattern.match(line))}
    lines: dict[Line, list[int]] = {}
    decisions: dict[Line, list[int]] = {}
    with temporary_folder("lines") as place:
        addresses = Path(place) / "addresses"
        addresses.write_text("\n".join(f"{address:#x}" for address in kinds))
        told = _run(data, "places", installed, {"elf": str(elf), "addresses": str(addresses)})
    address, depth = 0, 0
    for text in told.splitlines():
        if text.startswith("0x"):
            address, depth = int(text, 16), 0
        elif (found := _PLACE.match(text)) and (name := own(found["path"])) is not None and int(found["line"]):
            at = name, int(found["line"])
            lines.setdefault(at, []).append(address)
            if depth == 0 and conditional.fullmatch(kinds[address]):
                decisions.setdefault(at, []).append(address)
            depth += 1
        else:
            depth += 1
    return MachineLines(
        {at: tuple(dict.fromkeys(each)) for at, each in lines.items()}, {at: tuple(each) for at, each in decisions.items()}
    )


def _run(data: DataTable, key: str, installed: Installed, values: Mapping[str, str]) -> str:
    """What the command of an entry prints.

    Raises:
        VerificationError: it fails.
    """
    entry = data.table(key)
    done = installed.run(entry.text("tool"), fill(entry.texts("arguments"), values))
    if done.returncode != 0:
        said = (done.stderr or done.stdout).strip().splitlines()
        raise VerificationError(f"the lines of the program cannot be read: {said[-1] if said else entry.text('tool')}")
    return done.stdout
