"""The .ecore files of one run: each is read once and found by namespace, by relative path, or beside the given files.

A reference from one metamodel to another may be a namespace, a relative path, or a place in an Eclipse workspace
(`platform:/resource/...`). Tried in this order: the namespaces of the files read so far, the path, the file's path below a
folder above the referring file, a file of that name beside it, the namespaces of all .ecore files beside it, and the only
file read so far that lies in folders of these names. Nothing is downloaded. The content is interpreted by `ecore_loader`.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path
from urllib.parse import unquote

from robosmi import inputs
from robosmi.errors import SourceError
from robosmi.files.files import read_input
from robosmi.model.ecore.ecore_description import ECORE, KNOWN, XML_NAMESPACE, XML_TYPES, Package
from robosmi.model.ecore.ecore_xml import EcoreNode, read_nodes
from robosmi.model.ecore.xmi_document import XMI_NAMESPACES

_PLATFORM = re.compile(r"platform:/(?:resource|plugin)/(.+)")
_OWN_FILES = {"Ecore.ecore": ECORE, "XMLType.ecore": XML_TYPES, "XMLNamespace.ecore": XML_NAMESPACE}


CLASSIFIERS = ("EClass", "EDataType", "EEnum")
"""What a file may hold instead of packages."""


def no_package(path: Path, roots: list[EcoreNode]) -> SourceError:
    """The error for a file with a root that is no EPackage."""
    from robosmi.diagnostics import Location

    wrong = next((node for node in roots if node.tag != "EPackage"), roots[0])
    alone = "keep EPackages alone in an .ecore file, and other elements in files of their own"
    return SourceError(
        f"the root '{wrong.tag}' is no EPackage" if len(roots) > 1 else f"the file holds a '{wrong.tag}', no EPackage",
        location=Location(str(path), wrong.line),
        fix=alone if len(roots) > 1 else "put it into an EPackage" if wrong.tag in CLASSIFIERS else "give an .ecore file",
    )


class EcoreFile:
    """One .ecore file: its root packages, what has an `xmi:id`, and its packages by namespace."""

    def __init__(self, path: Path, roots: list[EcoreNode]) -> None:
        self.path = path
        self.roots = roots
        self.idents: dict[str, EcoreNode] = {}
        self.by_uri: dict[str, EcoreNode] = {}

    def find(self, fragment: str, start: EcoreNode | None = None) -> EcoreNode | None:
        """The node at an EMF fragment: `//Class/feature`, `/1/Class`, `//@eClassifiers.2` or an `xmi:id`.

        Args:
            fragment: the fragment, without `#`.
            start: the node that `//` stands for; the first root if None.
        """
        if not fragment.startswith("/"):
            return self.idents.get(fragment) or (start or self.roots[0] if not fragment else None)
        first, *steps = fragment[1:].split("/")
        node: EcoreNode | None = start or self.roots[0]
        if first:
            node = self.roots[int(first)] if first.isdecimal() and int(first) < len(self.roots) else None
        for step in steps:
            if node is None:
                return None
            node = _step(node, step)
        return node


def _step(node: EcoreNode, step: str) -> EcoreNode | None:
    if step.startswith("@"):
        tag, _, index = step[1:].partition(".")
        children = node.tagged(tag)
        position = int(index) if index.isdecimal() else 0
        return children[position] if position < len(children) else None
    return node.named(step) or node.named(unquote(step))


class EcoreFiles:
    """The .ecore files that a run has read, each once.

    Args:
        texts: the bytes of files that are not as they are stored, by absolute path.
    """

    def __init__(self, texts: Mapping[Path, bytes] | None = None) -> None:
        self._texts = texts or {}
        self._files: dict[Path, EcoreFile] = {}
        self._by_uri: dict[str, tuple[EcoreFile, EcoreNode]] = {}
        self._beside: dict[Path, dict[str, Path]] = {}

    def load(self, path: Path) -> EcoreFile:
        """Read a file, or give it again.

        Raises:
            SourceError: it cannot be read, is no XML, or has other roots than EPackages alone or classifiers alone.
        """
        place = Path(os.path.realpath(path))
        if place in self._files:
            return self._files[place]
        text = self._texts.get(place)
        root = read_nodes(read_input(path, "metamodel", inputs.MODEL) if text is None else text, path)
        roots = [n for n in root.children if not XMI_NAMESPACES.fullmatch(n.namespace)] if root.tag == "XMI" else [root]
        for node in roots:
            if node.tag in CLASSIFIERS:
                node.kind = node.tag
        tags = {node.tag for node in roots}
        if not tags or tags - {"EPackage", *CLASSIFIERS} or ("EPackage" in tags and len(tags) > 1):
            raise no_package(path, roots or [root])
        file = self._files[place] = EcoreFile(path, roots)
        for top in roots:
            for node in top.walk():
                if node.ident:
                    file.idents.setdefault(node.ident, node)
                if node.tag in ("EPackage", "eSubpackages") and node.get("nsURI"):
                    file.by_uri.setdefault(node.get("nsURI"), node)
                    self._by_uri.setdefault(node.get("nsURI"), (file, node))
        return file

    def find(self, uri: str, referrer: EcoreFile) -> tuple[EcoreFile, EcoreNode] | Package | None:
        """Where a reference leads: a file with the package that `//` stands for in it, one of Ecore's own packages, or None.

        Args:
            uri: what stands before `#`.
            referrer: the file with the reference.

        Raises:
            SourceError: the file that it leads to cannot be read.
        """
        if uri in KNOWN:
            return KNOWN[uri]
        if uri in referrer.by_uri:  # another version of the namespace may have been read before
            return referrer, referrer.by_uri[uri]
        if uri in self._by_uri:
            return self._by_uri[uri]
        name = unquote(uri.rpartition("/")[2])
        own = _OWN_FILES.get(name)
        for candidate in _candidates(uri, name, referrer.path):
            if candidate.is_file():
                file = self.load(candidate)
                if own is not None and file.roots[0].get("nsURI") == own.uri:
                    return own
                return file, file.roots[0]
        if own is not None:
            return own
        found = self._namespaces_beside(referrer.path.parent).get(uri)
        if found is not None:
            self.load(found)
            return self._by_uri.get(uri)
        return self._read_elsewhere(unquote(uri))

    def _read_elsewhere(self, uri: str) -> tuple[EcoreFile, EcoreNode] | None:
        """The only file that was read and lies in folders of the names that a path or a place in a workspace says."""
        workspace = _PLATFORM.fullmatch(uri)
        path = workspace[1] if workspace is not None else "" if ":" in uri else uri
        names = [part for part in path.split("/") if part not in (".", "..", "")]
        found = [file for file in self._files.values() if file.path.absolute().parts[-len(names) :] == tuple(names)]
        return (found[0], found[0].roots[0]) if len(names) > 1 and len(found) == 1 else None

    def _namespaces_beside(self, folder: Path) -> dict[str, Path]:
        """The namespaces of the .ecore files in a folder; files that cannot be read have none."""
        known = self._beside.get(folder)
        if known is None:
            known = self._beside[folder] = {}
            for path in sorted(folder.glob("*.ecore")):
                try:
                    root = read_nodes(inputs.read_bytes(path, inputs.MODEL), path)
                except (SourceError, OSError):
                    continue
                for node in root.walk():
                    if node.tag in ("EPackage", "eSubpackages") and node.get("nsURI"):
                        known.setdefault(node.get("nsURI"), path)
        return known


def _candidates(uri: str, name: str, referrer: Path) -> list[Path]:
    """The places where a file may lie, best first."""
    folder = referrer.parent
    text = unquote(uri)
    found = []
    if platform := _PLATFORM.fullmatch(text):
        place = Path(platform[1])
        inner = Path(*place.parts[1:])
        for parent in Path(os.path.abspath(folder)).parents:
            found.append(parent / place)
        found += [p / inner for p in (folder, *Path(os.path.abspath(folder)).parents) if p.name == place.parts[0]]
    elif text.startswith("file:"):
        found.append(Path(re.sub("^file:/+", "/", text)))
    elif ":" not in text:
        found.append(folder / text)
    if name:
        found.append(folder / name)
    return found
