"""Chains: workflows of load, validate, transform, migrate, generate and plain functions, with what each reads and makes explicit.

`Chain` is written in Python, `read_chain` reads one from a TOML file; a run does only the steps whose inputs have changed. The
languages of the steps are in the rooms below (`validate`, `transform`, `generate`); here is only what holds them together.
docs/reference/chains.md has the format.
"""

from __future__ import annotations

from pathlib import Path

from robosmi.chain.chain import Chain
from robosmi.chain.run import ChainResult, ChainRun
from robosmi.chain.steps import Step, StepResult

__all__ = ["Chain", "ChainResult", "ChainRun", "Step", "StepResult", "read_chain"]


def read_chain(path: str | Path) -> Chain:
    """A chain from a TOML file (docs/reference/chains.md).

    Args:
        path: the file; paths in it are relative to its folder.

    Raises:
        SourceError: it cannot be read, is no TOML, or has a step or key that means nothing.
        RuleError: the code of a function cannot be imported.
    """
    from robosmi.chain.reading import read_chain as read  # needed for chains in files only

    return read(path)
