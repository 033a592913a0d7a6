"""Compiles all adapters of each header that a board can serve, for every board of the repository, and prints what is said.

`python -m tests.adapters.boards [TEXT]` takes the headers that contain that text. Boards with the same microcontroller, clock,
variant and macro are one. `alone` compiles each adapter by itself; here boards differ in how many pins they have, and which.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from robosmi.transformations.knowledge.board_models import load_board, load_mapping, mapped_boards
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces
from tests.adapters.bench import pieces
from tests.adapters.test_files import CORE, DEFINES, HEADERS, KEYS, folders, program


def kinds_of_boards() -> dict[tuple[str, int, str, str], list[str]]:
    """Microcontroller, clock, variant and macro -> the boards that have them."""
    found: dict[tuple[str, int, str, str], list[str]] = {}
    for name in sorted(mapped_boards("arduino")):
        board = load_board(name)
        mapping = load_mapping("arduino", board)
        assert board.microcontroller is not None
        key = (str(board.microcontroller.name), int(board.clockHertz), str(mapping.variant), str(mapping.define))
        found.setdefault(key, []).append(name)
    return found


def said(header: str, mcu: str, clock: int, variant: str, define: str, folder: Path) -> str:
    """The compiler's messages about all adapters of a header that a kind of board can serve."""
    wanted = {key for key in KEYS if key[0] == header}
    needed = AdapterPieces(pieces(), architecture="avr").needed(sorted(wanted), mcu)
    (folder / "adapters.cpp").write_text(program(needed.pieces, wanted - needed.unserved.keys()))
    options = [word for word in DEFINES if not word.startswith("-DF_CPU")]
    options += [f"-DF_CPU={clock}L", f"-DARDUINO_{define}", f"-mmcu={mcu}", f"-I{CORE / 'variants' / variant}", *folders(mcu)]
    command = ["avr-g++", *options, "-Os", "-Wall", "-Wextra", "-c", "adapters.cpp", "-o", "adapters.o"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
    return "\n".join(line for line in done.stderr.splitlines() if line.startswith("adapters.cpp:") or "error" in line)


def main(only: str = "") -> int:
    """Compile the headers whose names contain a text; 1 if the compiler complains."""
    wrong = tried = 0
    kinds = kinds_of_boards()
    with tempfile.TemporaryDirectory() as folder:
        for kind, names in kinds.items():
            for header in (header for header in HEADERS if only in header):
                tried += 1
                if text := said(header, *kind, Path(folder)):
                    wrong += 1
                    print(f"{header} for {', '.join(names)}:\n{text}", flush=True)
    boards = sum(map(len, kinds.values()))
    print(f"{boards} boards of {len(kinds)} kinds, {tried} files compiled, {wrong} with a warning or an error")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
