"""RoboSMi moves robot software between microcontroller boards with models (scratch docstring)."""
from pathlib import Path

_here = Path(__file__).resolve().parent
if not (_here / "transformations").is_dir() and (_here.parent / "transformations" / "__init__.py").is_file():
    __path__.append(str(_here.parent))
__version__ = "0.1.0"
