"""What a model that is saved keeps of the files it was read with: references into them, and the places of its metamodels.

EMF keeps both: a reference leads to the resource of its target, and a file with xsi:schemaLocation is saved with one.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path, PurePath
from typing import TYPE_CHECKING
from urllib.parse import unquote

from robosmi.model.elements.ecore import DynamicEObject
from robosmi.model.xmi.xmi_locations import relative

if TYPE_CHECKING:
    from robosmi.model.xmi.xmi_layout import Root

_SCHEME = re.compile("[A-Za-z][A-Za-z0-9+.-]*:")


def neighbouring_models(
    target: Path, own: Iterable[DynamicEObject], given: Mapping[str, Root], read: Mapping[Path, Sequence[DynamicEObject]]
) -> dict[str, Root]:
    """The models that references of a model may lead to, by their file names seen from its folder.

    Args:
        target: the file that is written.
        own: its root elements.
        given: models that the caller names.
        read: the root elements of other files, by absolute path.
    """
    found: dict[str, Root] = dict(given)
    taken = {id(root) for root in own}
    for roots in given.values():
        taken.update(id(root) for root in (roots if isinstance(roots, Sequence) else [roots]))
    for place, others in read.items():
        name = _seen_from(target, str(place))
        if name not in found and name != target.name and not any(id(root) in taken for root in others):
            found[name] = others
            taken.update(id(root) for root in others)
    return found


def metamodel_places(file: Path, locations: Iterable[tuple[str, str]], target: Path) -> dict[str, str]:
    """Namespace -> place of its metamodel, seen from the file that is written.

    Args:
        file: the file that was read.
        locations: namespaces and places as it has them.
        target: the file that is written.
    """
    found: dict[str, str] = {}
    for uri, place in locations:
        path, mark, fragment = place.partition("#")
        if not _SCHEME.match(path):
            path = relative(target.name, _seen_from(target, str(file.parent / unquote(path))))
        found[uri] = f"{path}{mark}{fragment}"
    return found


def _seen_from(target: Path, path: str) -> str:
    return PurePath(os.path.relpath(os.path.realpath(path), os.path.realpath(target.parent))).as_posix()
