"""XMI files to models: a file and everything it refers to, as plain elements with no proxies left.

The way in to the reader. Opens files, finds metamodels (also by xsi:schemaLocation), collects the problems of all files and
reports them together. One file is `xmi_parser`'s part, references `xmi_links`', and what a class demands is in its plan.
"""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import unquote

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import ModelError, RobosmiError, SourceError
from robosmi.model.lean import BARE, collector_at_rest
from robosmi.model.metamodels import OWN_NAMESPACES, Metamodels, built_in
from robosmi.model.pyecore_internals import is_value
from robosmi.model.xmi_document import Document, ForeignRoot, Unreadable
from robosmi.model.xmi_links import XmiLinker, resolve
from robosmi.model.xmi_parser import parse
from robosmi.model.xmi_plan import Plans

if TYPE_CHECKING:
    from robosmi.model.open_files import OpenDocuments

__all__ = ["DamagedModelError", "Document", "UnreadableModelError", "read_documents", "read_models", "resolve"]
_SHOWN = 20
_SCHEME = re.compile("([A-Za-z][A-Za-z0-9+.-]*):")
Problems = list[tuple[Location, str]]


class DamagedModelError(ModelError):
    """Files that contradict their metamodels; `problems` has place and text of everything that is wrong."""

    def __init__(self, problems: Problems) -> None:
        self.problems = problems
        super().__init__(
            f"the model contradicts its metamodel in {len(problems)} place(s):\n{_listed(problems)}",
            location=problems[0][0],
            fix="repair the file, or make it again with the tool that wrote it",
        )


class UnreadableModelError(SourceError):
    """Files that cannot be read as models at all; `problems` has them, and what else was wrong in what could be read."""

    def __init__(self, problems: Problems, text: str, location: Location, fix: str) -> None:
        self.problems = problems
        more = f"; there are {len(problems)} problems:\n{_listed(problems)}" if len(problems) > 1 else ""
        super().__init__(f"{text}{more}", location=location, fix=fix)


def _listed(problems: Problems) -> str:
    shown = "\n".join(f"  {location}: {text}" for location, text in problems[:_SHOWN])
    return f"{shown}\n  ... and {len(problems) - _SHOWN} more" if len(problems) > _SHOWN else shown


def read_models(path: Path, metamodels: Metamodels, *, inside: Path | None = None) -> dict[Path, Any]:
    """Read a model file and the model files that it refers to, directly or through others; each has one root.

    Args:
        path: the .xmi file.
        metamodels: the metamodels the files may use.
        inside: the folder that no file is read outside of, after links are resolved; None for any.

    Returns:
        Absolute path -> root element; the given file comes first.

    Raises:
        SourceError: a file is missing, is no XML or no XMI, or has several roots.
        ModelError: a file contradicts its metamodel, or a reference leads nowhere; all problems in one message.
    """
    documents = read_documents(path, metamodels, inside=inside)
    for document in documents.values():
        if len(document.roots) != 1:
            raise SourceError(
                f"a model with {'several roots' if document.roots else 'no root'} cannot be used here",
                location=Location(str(document.path), 1),
                fix="keep one root in a file",
            )
    return {file: document.roots[0] for file, document in documents.items()}


def read_documents(
    path: Path,
    metamodels: Metamodels,
    *,
    bounds: bool = True,
    inside: Path | None = None,
    opened: OpenDocuments | None = None,
) -> dict[Path, Document]:
    """Read a model file and those that it refers to, whatever the number of their roots.

    Cyclic garbage collection of this process rests meanwhile: elements are full of cycles, and none of them is garbage yet.

    Args:
        path: the .xmi file.
        metamodels: the metamodels the files may use; a file may name others by xsi:schemaLocation, for this read only.
        bounds: whether an element that lacks a required value, or has more than allowed, is a problem.
        inside: the folder that no file is read outside of, after links are resolved; None for any.
        opened: files that are open: a reference to one leads to its elements; None for none.

    Returns:
        Absolute path -> document with `roots` and `ids`; the given file comes first. Metamodel files that were referred to
        and open files are not in it.

    Raises:
        UnreadableModelError: a file is missing, is no XML or no XMI.
        DamagedModelError: a file contradicts its metamodel, or a reference leads nowhere. Both list all problems.
    """
    with collector_at_rest():
        reader = _Reader(metamodels, inside, opened)
        reader.open(Path(os.path.realpath(path)), None)
        reader.link()
        if bounds:
            reader.count()
    if reader.fatal is not None:
        raise UnreadableModelError(reader.sorted_problems(), *reader.fatal)
    if reader.problems:
        raise DamagedModelError(reader.sorted_problems())
    return reader.documents


class _Reader:
    def __init__(self, metamodels: Metamodels, inside: Path | None, opened: OpenDocuments | None) -> None:
        self.metamodels = metamodels
        self.opened = opened
        self.inside = os.path.realpath(inside) if inside is not None else None
        self.plans = Plans()
        self.documents: dict[Path, Document] = {}
        self.packages: dict[str, Any] = {}  # by namespace: found by xsi:schemaLocation
        self.problems: Problems = []
        self.fatal: tuple[str, Location, str] | None = None
        self._ecore_files: dict[Path, Any] = {}
        self._refused: set[Path] = set()
        self._opened: dict[tuple[Path, str], Any] = {}

    def sorted_problems(self) -> Problems:
        """The problems of each file in the order of its lines, files in the order in which they were opened."""
        order = {str(path): index for index, path in enumerate([*self.documents, *self._refused])}
        return sorted(self.problems, key=lambda p: (order.get(p[0].path, -1), p[0].line or 0))

    def give_up(self, location: Location, text: str, fix: str) -> None:
        """Note that a file cannot be read at all."""
        self.problems.append((location, text))
        if self.fatal is None:
            self.fatal = (text, location, fix)

    # --- files

    def open(self, path: Path, referrer: Location | None) -> Any:
        """The document or package of a file, or None with the problem noted."""
        if path in self.documents:
            return self.documents[path]
        if path in self._ecore_files:
            return self._ecore_files[path]
        if path in self._refused:
            return None
        if not self._may_read(path):
            self._refused.add(path)
            self.give_up(
                referrer or Location(str(path)), f"the model refers to '{path.name}', which lies outside of its folder",
                "keep the models that refer to each other in one folder, without links out of it",
            )  # fmt: skip
            return None
        try:
            data = inputs.read_bytes(path, inputs.MODEL)
        except OSError as error:
            self._refused.add(path)
            why = error.strerror or str(error)
            self.give_up(
                referrer or Location(str(path)),
                f"the model '{path.name}' cannot be read: {why}",
                inputs.fix_of(error, "check the path; files that refer to each other must keep their places"),
            )
            return None
        place = str(path)
        try:
            document = parse(
                path, data, self.plans, self.package, lambda text: self.locate(path, text),
                lambda line, text: self.problems.append((Location(place, line), text)),
            )  # fmt: skip
        except ForeignRoot:
            return self.ecore(path, referrer or Location(place))
        except Unreadable as error:
            self._refused.add(path)
            text, fix = (error.text, error.fix) if error.fix else self._unknown(error)
            self.give_up(Location(place, error.line), text, fix)
            return None
        self.documents[path] = document
        return document

    def _unknown(self, error: Unreadable) -> tuple[str, str]:
        """What is wrong with a file whose root has an unknown namespace, and what to do about it."""
        uri = error.namespace
        if uri.startswith(OWN_NAMESPACES) and uri not in (current := built_in().uris()):
            family = uri.rpartition("/")[0]
            for known in (each for each in current if each.rpartition("/")[0] == family):
                return f"the model is of '{uri}', and this version of RoboSMi reads '{known}'", "migrate the program again"
        ways = "--metamodel X.ecore in a command, Metamodel.load('X.ecore') in Python"
        return error.text, f"give its metamodel ({ways}); known namespaces: {', '.join(self.metamodels.uris())}"

    def package(self, uri: Any) -> Any:
        """The package of a namespace, or None; the built-in metamodels are known beside those that were given."""
        found = self.metamodels.get(uri)
        found = found if found is not None else self.packages.get(uri)
        return built_in().get(uri) if found is None and str(uri).startswith(OWN_NAMESPACES) else found

    def locate(self, path: Path, text: str) -> None:
        """Load the metamodels that a file names by xsi:schemaLocation, as far as they are files and not known."""
        words = text.split()
        for uri, place in zip(words[::2], words[1::2], strict=False):
            file = self._local(path, place.partition("#")[0])
            if self.package(uri) is None and file is not None and self._may_read(file) and file.is_file():
                self.ecore(file, Location(str(path), 1))

    def ecore(self, path: Path, referrer: Location) -> Any:
        """The package of an .ecore file: the one that is known under its namespace, else a new one."""
        from robosmi.model.metamodel import Metamodel

        try:
            loaded = Metamodel.load(path)
        except RobosmiError as error:
            self._refused.add(path)
            self.give_up(error.location or referrer, error.message, error.fix or "")
            return None
        for package in loaded.packages:
            for uri in Metamodels([package]).uris():
                self.packages.setdefault(uri, loaded.get(uri))
        first = loaded.packages[0]
        self._ecore_files[path] = self.package(first.nsURI) or first
        return self._ecore_files[path]

    def _may_read(self, path: Path) -> bool:
        return self.inside is None or path.is_relative_to(self.inside)

    @staticmethod
    def _local(path: Path, uri: str) -> Path | None:
        """The file that a URI names, seen from another file; None if it is none."""
        scheme = _SCHEME.match(uri)
        if "%00" in uri or (scheme and scheme[1].lower() != "file"):
            return None
        name = unquote(uri[scheme.end() :] if scheme else uri)
        return Path(os.path.realpath(path.parent / (re.sub("^//[^/]*", "", name) if scheme else name)))

    # --- references

    def link(self) -> None:
        """Resolve all references, reading further files as they are met."""
        linker = XmiLinker(
            self.find, lambda document, line, text: self.problems.append((Location(str(document.path), line), text))
        )
        linked = 0
        while linked < len(self.documents):
            document = list(self.documents.values())[linked]
            linked += 1
            if self.opened is not None:
                files = (self._local(document.path, uri.partition("#")[0]) for _, _, uri, *_ in document.parts)
                self.opened.leave(file for file in files if file is not None)
            linker.link(document)
        linker.finish()

    def find(self, document: Document, uri: str, line: int) -> Any:
        """The document or package that the file part of a reference names, or None with the problem noted."""
        key = (document.path, uri)
        if key in self._opened:
            return self._opened[key]
        from robosmi.model import ecore

        location = Location(str(document.path), line)
        found = ecore.EString.ePackage if uri == ecore.nsURI else self.package(uri)
        if found is None:
            path = self._local(document.path, uri)
            if path is not None:
                found = (self.opened.get(path) if self.opened is not None else None) or self.open(path, location)
            else:
                self.problems.append((location, f"'{uri}' is no file and no known metamodel"))
        self._opened[key] = found
        return found

    def count(self) -> None:
        """Hold the elements against the bounds of their features."""
        for document in self.documents.values():
            place = str(document.path)
            for element, plan, line in document.counted:
                slots = element.__dict__
                for key, name, lower, upper in plan.bounds:
                    slot = slots.get(key)
                    number = 0 if slot is None else 1 if slot.__class__ in BARE or is_value(slot) else len(slot)
                    if number < lower:
                        wanted = "which it needs" if lower == 1 else f"of which it needs {lower}, but {number}"
                        text = f"{plan.name} has no '{name}', which it needs" if not number else f"{plan.name}.{name}: {wanted}"
                        self.problems.append((Location(place, line), text))
                    elif 1 < upper < number:
                        self.problems.append((Location(place, line), f"{plan.name}.{name} takes {upper} values, not {number}"))
