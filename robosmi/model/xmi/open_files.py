"""The open model files of a session: a reference to one of them resolves to the elements that are loaded already.

EMF's resource set has the same effect by loading each file once. `opening` selects drivers, and `xmi_reader` resolves
references.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Protocol, TypeAlias

from robosmi import inputs
from robosmi.model.ecore.metamodels import Metamodels, built_in
from robosmi.model.ecore.xmi_document import Document
from robosmi.model.elements.ecore import DynamicEObject, EPackage, Package
from robosmi.model.elements.features import as_package
from robosmi.model.elements.fragments import own_id
from robosmi.model.elements.pyecore_internals import container_of


class OpenModel(Protocol):
    """A model that is open, as far as references of other files need it."""

    @property
    def packages(self) -> Sequence[EPackage]:
        """The packages of its elements' classes."""

    @property
    def roots(self) -> list[DynamicEObject]:
        """Its root elements."""

    def to_bytes(self) -> bytes:
        """Its text, as it would be saved in its file."""

    def all_contents(self) -> Iterable[DynamicEObject]:
        """All of its elements."""


class UnresolvedLinks(Protocol):
    """References that lead nowhere yet."""

    def ask_again(self) -> bool:
        """Ask the hook again for each; returns whether something is left."""


Hook: TypeAlias = Callable[[str, Path, list[DynamicEObject]], DynamicEObject | None]
"""The URI of a reference that leads nowhere, the file that has it, its root elements -> the element that is meant, or None."""


class OpenFiles:
    """The open models and the files that were read with them, by their absolute paths.

    Args:
        resolve: finds what references lead to that lead nowhere.
        uris: beginnings of URIs -> the file or folder that they stand for.
    """

    def __init__(self, resolve: Hook | None = None, uris: Mapping[str, str | Path] | None = None) -> None:
        self.hook = resolve
        self.uris = dict(uris or {})
        self.openings = 0
        self._models: dict[Path, OpenModel] = {}
        self._read: dict[Path, tuple[Document, str]] = {}
        self._waiting: list[OpenDocuments] = []
        self._asks = False

    def documents(self, path: Path) -> OpenDocuments:
        """What a file that is opened now may refer to; nothing when it is open already, as it is then read a second time."""
        made = OpenDocuments(self if path not in self._models else OpenFiles(self.hook, self.uris))
        made.asked = self.openings
        return made

    def packages(self) -> Metamodels:
        """The built-in metamodels, and those of the models that are open."""
        own: list[Package] = [package for model in self._models.values() for package in model.packages]
        return Metamodels([*dict.fromkeys([*reversed(own), *built_in().packages])])

    def read_before(self, path: Path, known: Metamodels) -> Document | None:
        """The document of a file that was read with another one and is to be a model now, or None to read it."""
        if path in self._models or path not in self._read or (found := self._document(path)) is None:
            return None
        packages = [(root.eClass.ePackage, known.get(root.eClass.ePackage.nsURI)) for root in found.roots]
        return found if all(own is not None and as_package(own) is package for package, own in packages) else None

    def add(self, path: Path, model: OpenModel, documents: Mapping[Path, Document], opened: OpenDocuments | None = None) -> None:
        """Note a model and the files that were read with it."""
        self._models[path] = model
        self._read.pop(path, None)
        for place, document in documents.items():
            if place not in self._models:
                self._read[place] = document, _digest(place)
        self.openings += 1
        if opened is not None and opened.waiting is not None:
            if opened.asked == self.openings - 1:  # no other file came between
                opened.asked = self.openings
            self._waiting.append(opened)

    def ask_again(self) -> None:
        """Ask the hook again for what it did not find before further files were opened."""
        if self._asks:  # the hook has opened a file, and the loop that asks it goes on
            return
        self._asks = True
        try:
            while behind := [each for each in self._waiting if each.asked < self.openings]:
                for each in behind:
                    each.asked = self.openings
                    if each.waiting is None or not each.waiting.ask_again():
                        self._waiting.remove(each)
        finally:
            self._asks = False

    def forget(self, path: Path) -> OpenModel | None:
        """Let a file be none of the open ones; returns its last model."""
        return self._models.pop(path, None)

    def places(self) -> dict[Path, list[DynamicEObject]]:
        """The root elements of all files that are open or were read with them."""
        return {path: document.roots for path, (document, _) in self._read.items()} | {
            path: model.roots for path, model in self._models.items()
        }

    def models(self) -> dict[Path, OpenModel]:
        """The open models."""
        return dict(self._models)

    def read(self) -> dict[Path, tuple[Document, str]]:
        """The documents that were read with them, and the digests of their files."""
        return dict(self._read)

    def find(self, path: Path) -> Document | None:
        """The elements of a file that is open, as they are now, or None."""
        if (model := self._models.get(path)) is None:
            return self._document(path)
        ids: dict[str, DynamicEObject] = {}
        for element in model.all_contents():
            if (own := own_id(element)) is not None:
                ids.setdefault(own, element)
        return Document(path, model.roots, ids)

    def _document(self, path: Path) -> Document | None:
        """The document read from a file, if the file is unchanged since."""
        document, digest = self._read.get(path, (None, ""))
        return document if document is not None and _digest(path) == digest else None


class OpenDocuments:
    """Files that are open, for one file that is read.

    Args:
        files: the open files.
    """

    def __init__(self, files: OpenFiles | None = None) -> None:
        self._files = files if files is not None else OpenFiles()
        self.hook, self.uris = self._files.hook, self._files.uris
        self._found: dict[Path, Document | None] = {}
        self.asked = 0
        """How many files had been opened when the hook was asked last."""
        self.waiting: UnresolvedLinks | None = None
        """What asks it again, where references are left that lead nowhere."""

    def get(self, path: Path) -> Document | None:
        """The elements of an open file, or None."""
        if path not in self._found:
            self._found[path] = self._files.find(path)
        return self._found[path]

    def leave(self, paths: Iterable[Path]) -> None:
        """Read those of these files again whose open models cannot be contained, since their roots are contained elsewhere."""
        for path in paths:
            document = self.get(path)
            if document is not None and any(container_of(root) is not None for root in document.roots):
                self._found[path] = None


def _digest(path: Path) -> str:
    try:
        return hashlib.sha256(inputs.read_bytes(path, inputs.MODEL)).hexdigest()
    except OSError:
        return ""
