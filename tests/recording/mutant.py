"""One changed module in place of the product's own, for the mutants of `tests/mutants`: the file itself stays as it is.

`ROBOSMI_MUTANT` names a JSON file: the path of a module, and its changed text. It holds for every Python that a test starts, too.
Nothing of the tests is imported here.
"""

from __future__ import annotations

import json
import os
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import CodeType

MUTANT = "ROBOSMI_MUTANT"
"""The environment variable that names the file."""


def start() -> None:
    """Let the module be loaded with its changed text from now on, if the environment says so."""
    if place := os.environ.get(MUTANT):
        changed = json.loads(Path(place).read_text(encoding="utf-8"))
        get_code = SourceFileLoader.get_code

        def of_mutant(loader: SourceFileLoader, fullname: str) -> CodeType | None:
            if os.path.realpath(loader.path) == changed["path"]:
                return compile(changed["text"], loader.path, "exec", dont_inherit=True)
            return get_code(loader, fullname)

        SourceFileLoader.get_code = of_mutant  # type: ignore[method-assign, assignment]
