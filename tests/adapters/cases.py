"""Finds the cases: importing their modules registers them."""

from __future__ import annotations

import importlib
from pathlib import Path


def load_cases() -> None:
    """Import every module of cases."""
    for module in sorted(Path(__file__).parent.glob("cases_*.py")):
        importlib.import_module(f"tests.adapters.{module.stem}")
