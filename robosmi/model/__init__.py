"""Models: strict elements, metamodels, XMI in and out, whole-or-nothing files.

A first part (models over any technology are their own issue). `load_model` and `save_model` are the simple way in; the
modules beneath do one thing each. Nothing here knows what the models are about.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any


def load_model(path: str | Path) -> Any:
    """Read an XMI file, with the files it refers to, and return its root element.

    Raises:
        SourceError: a file cannot be read as XMI.
        ModelError: it contradicts its metamodel.
    """
    from robosmi.model.metamodels import built_in
    from robosmi.model.xmi_reader import read_models

    return next(iter(read_models(Path(path), built_in()).values()))


def save_model(root: Any, path: str | Path, others: Mapping[str, Any] | None = None) -> None:
    """Write a model as XMI, atomically.

    Args:
        root: its root element.
        path: the file.
        others: models in the same folder that it refers to, file name -> root; they are not written.

    Raises:
        ModelError: a reference leads to none of these models.
    """
    from robosmi.model.files import write_atomic
    from robosmi.model.xmi_writer import to_xmi

    target = Path(path)
    write_atomic(target, to_xmi({target.name: root, **(others or {})})[target.name])
