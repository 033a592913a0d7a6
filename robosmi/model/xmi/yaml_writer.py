"""Models to YAML text: what `json_writer` writes, in block style, with texts in quotation marks as Jackson's YAML has them."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence

from robosmi.base.data_text import Json
from robosmi.base.located_json import NumberText
from robosmi.errors import ModelError
from robosmi.model.elements.ecore import EObject
from robosmi.model.xmi.json_writer import number_text, tree_of
from robosmi.model.xmi.xmi_locations import XmiLocations

_PLAIN_KEY = re.compile(r"[A-Za-z_$][A-Za-z0-9_$]*")
_WORDS = ("true", "false", "null", "yes", "no", "on", "off", "y", "n")
_NOT_PRINTABLE = re.compile("[\x7f-\x9f\u2028\u2029\ufeff\ufffe\uffff]")
_SURROGATE = re.compile("[\ud800-\udfff]")


def to_yaml(name: str, roots: Sequence[EObject], places: XmiLocations) -> bytes:
    """The text of one file: one root, or a list of none or several.

    Args:
        name: the file's name as `places` has it.
        roots: its root elements.
        places: where the elements of this model, and of those that it refers to, are.

    Raises:
        ModelError: as `to_json`, or a text has half a character.
    """
    text = "".join(_lines(tree_of(name, roots, places)))
    if _SURROGATE.search(text) is not None:
        raise ModelError(f"{name}: a text has half a character, which YAML cannot have", fix="correct the text, or save JSON")
    return text.encode()


def _lines(whole: Json) -> Iterator[str]:
    """The lines of a value; outer values before inner ones, with a stack."""
    stack: list[tuple[str, str, Json]] = [("", "", whole)]
    while stack:
        start, indent, value = stack.pop()
        if isinstance(value, dict) and value:
            if start and not start.endswith("- "):
                yield f"{start.rstrip()}\n"
                start = indent
            items = [(f"{start if index == 0 else indent}{_key(key)}: ", each) for index, (key, each) in enumerate(value.items())]
            stack += [(begin, f"{indent}  ", each) for begin, each in reversed(items)]
        elif isinstance(value, list) and value:
            if start and not start.endswith("- "):
                yield f"{start.rstrip()}\n"
                start = indent
            begins = [f"{start if index == 0 else indent}- " for index in range(len(value))]
            stack += [(begin, f"{indent}  ", each) for begin, each in reversed(list(zip(begins, value, strict=True)))]
        else:
            yield f"{start}{_flow(value)}\n"


def _key(key: str) -> str:
    return key if _PLAIN_KEY.fullmatch(key) and key.lower() not in _WORDS else _quoted(key)


def _flow(value: Json) -> str:
    return _quoted(value) if isinstance(value, str) and not isinstance(value, NumberText) else number_text(value)


def _quoted(text: str) -> str:
    return _NOT_PRINTABLE.sub(lambda found: f"\\u{ord(found[0]):04X}", json.dumps(text, ensure_ascii=False))
