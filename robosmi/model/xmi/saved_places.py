"""What a model that is saved keeps of the files it was read with: references into them, and the places of its metamodels.

EMF keeps both: a reference leads to the resource of its target, and a file with xsi:schemaLocation is saved with one.
"""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path, PurePath
from types import MappingProxyType
from typing import TYPE_CHECKING
from urllib.parse import unquote

from robosmi import inputs
from robosmi.errors import ModelError, RobosmiError
from robosmi.files.files import free_name, write_atomic
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.ecore.metamodels import Metamodels, built_in
from robosmi.model.elements.ecore import EObject, EPackage
from robosmi.model.elements.home import home_of
from robosmi.model.elements.pyecore_internals import own_resource_of
from robosmi.model.xmi.json_writer import to_json
from robosmi.model.xmi.preserved_layout import NotPreservedError, preserve_layout
from robosmi.model.xmi.text_forms import is_json, is_yaml
from robosmi.model.xmi.xmi_locations import XmiLocations, relative
from robosmi.model.xmi.xmi_reader import read_alone
from robosmi.model.xmi.xmi_writer import roots_in, text_with, to_xmi
from robosmi.model.xmi.xml_comments import comments, comments_lost, qualified_names
from robosmi.model.xmi.yaml_writer import to_yaml

if TYPE_CHECKING:
    from robosmi.model.xmi.open_files import OpenFiles
    from robosmi.model.xmi.xmi_layout import Root
    from robosmi.model.xmi.xmi_locations import Neighbour

_METAMODEL = re.compile(rb"<ecore:E\w+ ")
_HEAD = 1000
_INDENTED = re.compile(rb"\n([ \t]+)")
_SCHEME = re.compile("[A-Za-z][A-Za-z0-9+.-]*:")


def text_of(
    target: Path,
    roots: Sequence[EObject],
    read: Mapping[Path, Sequence[EObject]],
    source: Path | None = None,
    schema_locations: Iterable[tuple[str, str]] = (),
    given: Mapping[str, Root] = MappingProxyType({}),
) -> bytes:
    """The text of a model as a file has it at a place.

    Args:
        target: the file that it is for.
        roots: its root elements.
        read: the root elements of other files, by absolute path.
        source: the file that it was read from.
        schema_locations: namespaces and places of metamodels as that file has them.
        given: models that the caller names.

    Raises:
        ModelError: it cannot be written.
    """
    models = models_around(target, roots, given, read)
    locations = XmiLocations(models, neighbour_finder(target, models), target.parent)
    if is_json(target):
        return to_json(target.name, models[target.name], locations)
    if is_yaml(target):
        return to_yaml(target.name, models[target.name], locations)
    places = metamodel_places(source or target, schema_locations, target)
    return to_xmi(models, [target.name], locations, schema_locations=places)[target.name]


def texts_of(files: OpenFiles) -> dict[Path, bytes]:
    """The texts of all files of a session, open or read with an open one, as they would be saved.

    Raises:
        ModelError: one cannot be written.
    """
    around, models = files.places(), files.models()
    packages = [package for model in models.values() for package in model.packages]
    made: dict[Path, bytes] = {}
    for path, (document, digest) in files.read().items():
        text = text_of(path, still_roots(document.roots), around, path, document.schema_locations)
        made[path] = in_its_layout(text, path, digest, packages, path, has_more=document.has_more)
    return made | {path: model.to_bytes() for path, model in models.items()}


def in_its_layout(
    text: bytes,
    source: Path,
    digest: str,
    packages: Sequence[EPackage],
    target: Path,
    anywhere: bool = False,
    has_more: bool = False,
) -> bytes:
    """The new text of a model in the layout of the file it was read from, if that is as it was and can be followed.

    Comments, encoding, the order of attributes and what is of no metamodel's namespace stay; a change is a change of few lines.
    In another file a model without comments and foreign parts is as EMF writes it.

    Args:
        text: the text that is to be saved.
        source: the file.
        digest: that of its bytes when it was read.
        packages: the packages of the model.
        target: where it is saved.
        anywhere: whether another file gets the layout too if there are neither comments nor foreign parts.
        has_more: whether the file is known to have parts that are not in the model.
    """
    try:
        original = inputs.read_bytes(source, inputs.MODEL)
    except OSError:
        return text
    if original == text or hashlib.sha256(original).hexdigest() != digest or (not has_more and _is_nearly(original, text)):
        return text
    known = Metamodels([*packages, *built_in().packages])
    if is_json(source) and is_json(target):
        return _in_its_json(text, source, original, known)
    if is_yaml(source) and is_yaml(target):
        return original if _says_the_same(text, source, original, known) else text
    if any(is_json(path) or is_yaml(path) for path in (source, target)):
        return text
    is_elsewhere = not (anywhere or has_more) and os.path.realpath(target) != os.path.realpath(source)
    if is_elsewhere and not _has_more(original, text):
        return text
    before = _as_written(source, original, known, target)
    if before is None or before == original:  # the file's layout is ours
        return text
    if is_elsewhere and not _has_more(original, before):
        return text
    is_metamodel = _METAMODEL.search(text[:_HEAD]) is not None  # the namespaces that its text refers to may be found nowhere
    now = text if is_metamodel else _as_written(target, text, known, target)
    if now is None:
        return text
    try:
        made = preserve_layout(original, before, now)
    except NotPreservedError:
        return text
    return made if _as_written(target, made, known, target) == now else text


def _in_its_json(text: bytes, source: Path, original: bytes, metamodels: Metamodels) -> bytes:
    """The new text of a model in JSON: the file's own bytes if it says the same, else with the file's indentation."""
    if _says_the_same(text, source, original, metamodels):
        return original
    indented = _INDENTED.search(original)
    return _INDENTED.sub(lambda found: b"\n" + indented[1] * (len(found[1]) // 2), text) if indented is not None else text


def _says_the_same(text: bytes, source: Path, original: bytes, metamodels: Metamodels) -> bool:
    """Whether the model of a file in JSON or YAML is written as this text."""
    document = read_alone(source, original, metamodels)
    if document is None:
        return False
    with suppress(ModelError):
        locations = XmiLocations({source.name: document.roots}, None, source.parent)
        locations.shared_ids.update(document.shared_ids)
        write = to_yaml if is_yaml(source) else to_json
        return write(source.name, document.roots, locations) == text
    return False


def back_up_comments(target: Path, text: bytes) -> Path | None:
    """Keep the file that is to be overwritten beside it, as NAME.orig, if it has comments that the new text lacks.

    Returns:
        The copy, or None if nothing is lost.
    """
    old = inputs.read_bytes(target, inputs.MODEL) if target.is_file() else b""
    if not lost_comment_lines(target, old, text):
        return None
    copy = target.with_name(free_name(target.parent, f"{target.name}.orig"))
    write_atomic(copy, old)
    return copy


_YAML_COMMENT = re.compile(rb"^[ \t]*#|[ \t]#", re.MULTILINE)


def lost_comment_lines(target: Path, old: bytes, new: bytes) -> list[int]:
    """The lines of a file of a model with comments that what is written in its place lacks.

    Args:
        target: the file, whose name says the form.
        old: its bytes.
        new: what is written.
    """
    if is_json(target):
        return []
    if not is_yaml(target):
        return comments_lost(old, new)
    if len(_YAML_COMMENT.findall(old)) <= len(_YAML_COMMENT.findall(new)):  # a `#` in a value counts in both
        return []
    staying = set(new.splitlines())
    lines = enumerate(old.splitlines(), 1)
    return [number for number, line in lines if _YAML_COMMENT.search(line) and line not in staying]


def _has_more(original: bytes, written: bytes) -> bool:
    """Whether a file has comments, or parts of other namespaces, that are not in what is written for its model."""
    return bool(comments(original) or qualified_names(original) - qualified_names(written))


_LARGE = 4_000_000


def _is_nearly(original: bytes, text: bytes) -> bool:
    """Whether nearly all lines of a large file stay as they are, so that its layout is ours."""
    if len(original) < _LARGE or b"<!--" in original:
        return False
    new = set(text.splitlines())
    lines = original.splitlines()
    return sum(line not in new for line in lines) * 100 < len(lines)


def _as_written(path: Path, data: bytes, metamodels: Metamodels, target: Path) -> bytes | None:
    """What is written for the model in a text, whatever its layout; None if it cannot be read alone."""
    document = read_alone(path, data, metamodels)
    try:
        models: dict[str, list[EObject]] = {
            target.name: list(document.roots if document is not None else Metamodel.packages_of(path, data))
        }
    except RobosmiError:
        return None
    try:
        locations = XmiLocations(models, None, target.parent)
        locations.names_more_types = False  # what the target of a link turns out to be is no difference
        locations.shared_ids.update(document.shared_ids if document is not None else ())
        places = metamodel_places(path, document.schema_locations if document is not None else (), target)
        return text_with(target.name, models[target.name], locations, places)
    except ModelError:
        return None


def models_around(
    target: Path, own: Iterable[EObject], given: Mapping[str, Root], read: Mapping[Path, Sequence[EObject]]
) -> dict[str, list[EObject]]:
    """The model that is written and those that its references may lead to, by their file names seen from its folder.

    Args:
        target: the file that is written.
        own: its root elements.
        given: models that the caller names.
        read: the root elements of other files, by absolute path.
    """
    found: dict[str, list[EObject]] = {target.name: list(own)}
    found |= {name: roots_in(root) for name, root in given.items()}
    taken = {id(root) for roots in found.values() for root in roots}
    for place, known in read.items():
        name = _seen_from(target, str(place))
        others = still_roots(known)
        if name not in found and not any(id(root) in taken for root in others):
            found[name] = others
            taken.update(id(root) for root in others)
    return found


def still_roots(roots: Iterable[EObject]) -> list[EObject]:
    """Those roots of a file that were not put into a container since, of another file or this one."""
    return [root for root in roots if own_resource_of(root) is not None]


def neighbour_finder(target: Path, models: dict[str, list[EObject]]) -> Neighbour:
    """What finds the file of a root that is in none of these models, and adds that file to them if it is not there.

    Args:
        target: the file that is written.
        models: file names seen from its folder -> roots.
    """

    def find(root: EObject) -> tuple[str, list[EObject]] | None:
        home = home_of(root)
        if home is None or home.place is None:
            return None
        name = _seen_from(target, str(home.place))
        if name == target.name:  # another copy of the file that is written, in which a reference would lead elsewhere
            return None
        roots = list(home.contents)
        models.setdefault(name, roots)
        return name, roots

    return find


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
