"""Which files hold models as JSON or YAML."""

from __future__ import annotations

import re
from pathlib import Path

_NAMED_CLASS = re.compile(rb'"eClass"\s*:\s*"')


def is_json(path: Path) -> bool:
    """Whether a file's model is JSON, by its name."""
    return path.suffix.lower() == ".json"


def is_yaml(path: Path) -> bool:
    """Whether a file's model is YAML, by its name."""
    return path.suffix.lower() in (".yaml", ".yml")


def names_classes(head: bytes) -> bool:
    """Whether a JSON text that begins so is a model: an object or a list in which an element names its class."""
    return _NAMED_CLASS.search(head) is not None
