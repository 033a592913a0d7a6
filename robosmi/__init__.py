"""RoboSMi moves robot software between microcontroller boards with models, and is a model-driven engineering framework.

It is neither a compiler nor an emulator: it reads a program and a drawing as models, makes its decisions in a plan that a
person can read and edit, and writes a sketch with a truthful list of what is left to do. The functions below correspond to the
commands of the command line; they are imported when first used, so `import robosmi` stays fast.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from robosmi import corpus as corpus
    from robosmi.api import (
        check_model,
        compare,
        compile_sketch,
        generate_sketch,
        load_code,
        load_hardware,
        merge,
        migrate,
        plan_migration,
        recommend_libraries,
        upload_sketch,
        verify_migration,
    )
    from robosmi.model import load_model, save_model

__version__ = "0.1.0"

# A source checkout keeps the content folders beside the package; in a wheel they are inside it and this does nothing.
_here = Path(__file__).resolve().parent
if not (_here / "transformations").is_dir() and (_here.parent / "transformations" / "__init__.py").is_file():
    __path__.append(str(_here.parent))

__all__ = [
    "check_model",
    "compare",
    "compile_sketch",
    "generate_sketch",
    "load_code",
    "load_hardware",
    "load_model",
    "merge",
    "migrate",
    "plan_migration",
    "recommend_libraries",
    "save_model",
    "upload_sketch",
    "verify_migration",
]

_PLACES = dict.fromkeys(__all__, "robosmi.api") | {"load_model": "robosmi.model", "save_model": "robosmi.model"}


def __getattr__(name: str) -> Any:
    if name in _PLACES:
        from importlib import import_module

        return getattr(import_module(_PLACES[name]), name)
    if name == "corpus":
        from importlib import import_module

        return import_module("robosmi.corpus")
    raise AttributeError(f"module 'robosmi' has no attribute '{name}'")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__, "corpus"})
