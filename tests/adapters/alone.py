"""Compiles every adapter by itself, with only what it declares, for every microcontroller, and prints the compiler's messages.

`python -m tests.adapters.alone [TEXT]` takes the adapters whose `header/name` contains that text.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from tests.adapters import bench_c
from tests.adapters.test_files import KEYS, VARIANTS, alone


def main(only: str = "") -> int:
    """Compile the adapters whose names contain a text; 1 if the compiler complains about one."""
    tried = wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        keys_in_c = [(piece.header, piece.name) for piece in bench_c.pieces() if piece.kind != "helper"]
        for compiled, keys in ((alone, KEYS), (bench_c.alone, keys_in_c)):
            for mcu in VARIANTS:
                for key in keys:
                    if only not in "/".join(key):
                        continue
                    tried += 1
                    if said := compiled(key, mcu, Path(folder)):
                        wrong += 1
                        print(f"{'/'.join(key)} for {mcu}:\n{said}", flush=True)
    print(f"{tried} adapters compiled alone, {wrong} with a warning or an error")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
