"""XMI files to models: a file and everything it refers to; proxies stand for what is not there.

The way in to the reader. Opens files, finds metamodels (also by xsi:schemaLocation), collects the problems of all files and
reports them together. One file is `xmi_parser`'s part, references `xmi_linker`'s, and what a class demands is in its plan.
"""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple
from urllib.parse import unquote

from robosmi import inputs
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import ModelError, RobosmiError, SourceError
from robosmi.model.ecore.metamodels import OWN_NAMESPACES, Metamodels, built_in
from robosmi.model.ecore.xmi_document import Document, ForeignRoot, Oddities, Unreadable
from robosmi.model.elements import ecore
from robosmi.model.elements.compact_slots import (
    UNBOXED_TYPES,
    collector_at_rest,
)
from robosmi.model.elements.ecore import DynamicEObject, EObject
from robosmi.model.elements.features import class_in
from robosmi.model.elements.proxies import new_proxy, preserve_link
from robosmi.model.elements.pyecore_internals import (
    is_value,
)
from robosmi.model.elements.xmi_plan import FeatureEntry, Plans
from robosmi.model.xmi.json_parser import parse_json
from robosmi.model.xmi.text_forms import is_json, is_yaml
from robosmi.model.xmi.xmi_linker import LEADS_NOWHERE, XmiLinker, resolve
from robosmi.model.xmi.xmi_parser import parse

if TYPE_CHECKING:
    from robosmi.model.xmi.open_files import OpenDocuments


__all__ = ["DamagedModelError", "Document", "UnreadableModelError", "read_documents", "read_models", "resolve"]
_SHOWN = 20
_PLATFORM = re.compile("platform:/(?:resource|plugin)/(.+)")
BOUNDS, UNRESOLVED, FOREIGN, SHARED_ID = "RS608", "RS609", "RS610", "RS613"
UNRESOLVED_FIX = "put the file at its place, or give the session its place or a hook: Session(uris=..., resolve=...)"
_LOCAL_FIX = "correct the reference in this file, or give the session a hook: Session(resolve=...)"
_SCHEME = re.compile("([A-Za-z][A-Za-z0-9+.-]*):")
Problems = list[tuple[Location, str]]


class DamagedModelError(ModelError):
    """Files that contradict their metamodels; `problems` has place and text of everything that is wrong.

    Args:
        problems: of these.
        unsupported: whether a file uses what RoboSMi cannot read, and which is no fault of the file.
    """

    def __init__(self, problems: Problems, unsupported: bool = False) -> None:
        self.problems = problems
        repair = "repair the file, or make it again with the tool that wrote it"
        other = "process the model with Eclipse EMF, or remove what is not supported from the metamodel"
        super().__init__(
            f"the model contradicts its metamodel in {len(problems)} place(s):\n{_listed(problems)}",
            location=problems[0][0],
            fix=other if unsupported else repair,
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


def _nearest(uri: str, known: Sequence[str]) -> str:
    """Known namespaces for a message: of many those that are most like the one that is not known."""
    if len(known) <= _SHOWN:
        return ", ".join(known)
    import difflib  # wanted only when something is wrong

    close = difflib.get_close_matches(uri, known, n=5) or known[:5]
    return f"{', '.join(close)}, and {len(known) - len(close):,} more"


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
    strict: bool = True,
    inside: Path | None = None,
    opened: OpenDocuments | None = None,
    made: Callable[[type], Any] = object.__new__,
) -> dict[Path, Document]:
    """Read a model file and those that it refers to, whatever the number of their roots.

    Cyclic garbage collection of this process rests meanwhile: elements are full of cycles, and none of them is garbage yet.

    Args:
        path: the .xmi file.
        metamodels: the metamodels the files may use; a file may name others by xsi:schemaLocation, for this read only.
        strict: whether an element that lacks a required value or has more than allowed, and a reference that leads nowhere, are
            problems; if not, they are findings of the first document, and proxies stand for what is not there.
        inside: the folder that no file is read outside of, after links are resolved; None for any.
        opened: files that are open: a reference to one leads to its elements; None for none.
        made: makes the elements of a class, of the given file and in its order.

    Returns:
        Absolute path -> document with `roots` and `ids`; the given file comes first. Metamodel files that were referred to
        and open files are not in it.

    Raises:
        UnreadableModelError: a file is missing, is no XML or no XMI.
        DamagedModelError: a file contradicts its metamodel, or a reference leads nowhere. Both list all problems.
    """
    with collector_at_rest(makes_models=True):
        reader = _Reader(metamodels, inside, opened, strict)
        reader.plans.made = made
        reader.open(Path(os.path.realpath(path)), None)
        reader.plans.made = object.__new__
        reader.link()
        reader.count()
    if reader.fatal is not None:
        raise UnreadableModelError(reader.sorted_problems(), *reader.fatal)
    if reader.problems:
        raise DamagedModelError(reader.sorted_problems(), any(each.unsupported for each in reader.documents.values()))
    if (first := next(iter(reader.documents.values()), None)) is not None:
        first.findings = reader.odd.findings()
        if opened is not None and reader.unresolved:
            reader.findings = first.findings
            reader.told = [*first.findings]
            opened.waiting = reader
    return reader.documents


def read_alone(path: Path, data: bytes, metamodels: Metamodels) -> Document | None:
    """The document of one text as if its file had it; what it refers to in other files stays proxies, and no file is read.

    Returns:
        None if it cannot be read, or is a metamodel.
    """
    with collector_at_rest(makes_models=True):
        reader = _Reader(metamodels, None, None, False)
        reader.texts = {path: data}
        document = reader.open(path, None)
        reader.link()
    return document if isinstance(document, Document) and reader.fatal is None and not reader.problems else None


class _Unresolved(NamedTuple):
    """A reference for which the hook found nothing, and the finding about it."""

    document: Document
    link: str
    line: int
    owner: EObject
    entry: FeatureEntry
    proxy: EObject
    kind: tuple[str, ...]
    text: str


class _Reader:
    texts: dict[Path, bytes] | None = None
    """The only files that are read, where not all are."""

    def __init__(self, metamodels: Metamodels, inside: Path | None, opened: OpenDocuments | None, strict: bool) -> None:
        self.metamodels = metamodels
        self.strict = strict
        self.odd = Oddities()
        self.opened = opened
        self._hook = opened.hook if opened is not None else None
        self.inside = os.path.realpath(inside) if inside is not None else None
        self.plans = Plans()
        self.documents: dict[Path, Document] = {}
        self.packages: dict[str, Any] = {}  # by namespace: found by xsi:schemaLocation
        self.problems: Problems = []
        self.fatal: tuple[str, Location, str] | None = None
        self._ecore_files: dict[Path, Any] = {}
        self._refused: set[Path] = set()
        self._opened: dict[tuple[Path, str], Any] = {}
        self._mapped: set[tuple[Path, str]] = set()
        self._not_there: dict[tuple[Path, str], Callable[[], object]] = {}
        """What says that a file which a link names is not there, if the hook does not find what the link leads to."""
        self._led: set[tuple[Path, str]] = set()
        self._lost: set[tuple[Path, str]] = set()
        self._of_files: dict[str, list[tuple[str, tuple[str, ...]]]] = {}
        self.unresolved: list[_Unresolved] = []
        self.findings: list[Finding] = []
        self.told: list[Finding] = []

    def sorted_problems(self) -> Problems:
        """The problems of each file in the order of its lines, files in the order in which they were opened."""
        order = {str(path): index for index, path in enumerate([*self.documents, *self._refused])}
        return sorted(self.problems, key=lambda p: (order.get(p[0].path, -1), p[0].line or 0))

    def give_up(self, location: Location, text: str, fix: str) -> None:
        """Note that a file cannot be read at all."""
        if not self.strict and self.documents:  # a file beside the one that is read: proxies stand for what is in it
            self.odd.add(UNRESOLVED, ("file", text), location, text, "check the path, or give the metamodel of that file")
            return
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
            if self.texts is not None and path not in self.texts:
                return None
            data = inputs.read_bytes(path, inputs.MODEL) if self.texts is None else self.texts[path]
        except OSError as error:
            self._refused.add(path)
            why = error.strerror or str(error)
            folder = Path(os.path.realpath(referrer.path)).parent if referrer is not None else path.parent
            tried = path.relative_to(folder) if path.is_relative_to(folder) else path
            self.give_up(
                referrer or Location(str(path)),
                f"the model '{tried}' cannot be read: {why}",
                inputs.fix_of(error, "check the path; files that refer to each other must keep their places"),
            )
            return None
        place = str(path)
        try:
            document = self.parsed(path, data)
        except ForeignRoot:
            return self.ecore(path, referrer or Location(place))
        except Unreadable as error:
            self._refused.add(path)
            if error.sure_to is not None:  # what an unclosed element seems to contain is not its own
                self.problems = [each for each in self.problems if each[0].path != place or (each[0].line or 0) <= error.sure_to]
            text, fix = (error.text, error.fix) if error.fix else self._unknown(error)
            self.give_up(Location(place, error.line), text, fix)
            return None
        self.documents[path] = document
        document.digest = hashlib.sha256(data).hexdigest()
        return document

    def parsed(self, path: Path, data: bytes) -> Document:
        """The document of a file's bytes, XMI, JSON or YAML by its name.

        Raises:
            Unreadable, ForeignRoot: as `parse`.
        """
        place = str(path)

        def problem(line: int, text: str) -> None:
            self.problems.append((Location(place, line), text))

        def foreign(line: int, text: str, uri: str) -> None:
            where, kind = Location(place, line), (place, uri or text)
            if uri:
                self.odd.add(FOREIGN, kind, where, text, "give the metamodel of that namespace, if there is one")
            else:
                self.odd.add(FOREIGN, kind, where, text, "none is needed: it stays as text in the file", Severity.info)
            more.append(line)

        def illegal(line: int, feature: str, text: str) -> None:
            said = f"{feature}: {text}, so it is not in the model"
            self.odd.add(
                FOREIGN, (place, feature), Location(place, line), said, "correct the value; until then it stays in the file"
            )
            more.append(line)

        more: list[int] = []
        apart, wrong = (None, None) if self.strict else (foreign, illegal)
        if is_json(path) or is_yaml(path):
            document = parse_json(path, data, self.plans, self.package, problem, apart, wrong)
        else:
            locate = partial(self.locate, path)
            document = parse(path, data, self.plans, self.package, locate, problem, apart, wrong)
        document.has_more = bool(more)
        for identity, line in document.shared_ids.items():
            if self.strict:
                problem(line, f"the id '{identity}' is used twice")
            else:
                said = f"the id '{identity}' is used twice: references lead to the first element, in Eclipse EMF to the last"
                fix = "give each element an id of its own"
                self.odd.add(SHARED_ID, (place,), Location(place, line), said, fix)
        return document

    def _unknown(self, error: Unreadable) -> tuple[str, str]:
        """What is wrong with a file whose root has an unknown namespace, and what to do about it."""
        uri = error.namespace
        if self.package(uri) is not None:
            fix = "give the metamodel of the version that wrote the file; names of classes that annotations say are not read"
            return error.text, fix
        if uri.startswith(OWN_NAMESPACES) and uri not in (current := built_in().uris()):
            family = uri.rpartition("/")[0]
            for known in (each for each in current if each.rpartition("/")[0] == family):
                return f"the model is of '{uri}', and this version of RoboSMi reads '{known}'", "migrate the program again"
        ways = "--metamodel X.ecore in a command, Metamodel.load('X.ecore') in Python"
        return error.text, f"give its metamodel ({ways}); known namespaces: {_nearest(uri, self.metamodels.uris())}"

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
        from robosmi.model.ecore.ecore_classes import make_packages
        from robosmi.model.ecore.ecore_loader import load_metamodels
        from robosmi.model.ecore.metamodel import Metamodel

        try:
            loaded = Metamodel(make_packages(load_metamodels([path], classifiers=True, stand_ins=True)))
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
            self.find,
            lambda document, line, text: self.problems.append((Location(str(document.path), line), text)),
            self.missing if not self.strict or self._hook is not None else None,
            self.preserve_mapped,
        )
        opened = 0
        while opened < len(self.documents):
            document = list(self.documents.values())[opened]
            opened += 1
            if self.opened is not None:
                files = (self._local(document.path, uri.partition("#")[0]) for _, _, uri, *_ in document.parts)
                self.opened.leave(file for file in files if file is not None)
            linker.contain(document)
        for document in self.documents.values():
            linker.link(document)
        linker.finish()
        for key, report in self._not_there.items():
            if key in self._lost or key not in self._led:
                before = self.odd.kinds()
                report()
                self._of_files[key[1]] = [kind for kind in self.odd.kinds() if kind not in before]
        self._linker = linker

    def ask_again(self) -> bool:
        """Ask the session's hook again for what it did not find, as more files are open; returns whether something is left."""
        left = []
        kinds_gone: set[tuple[str, ...]] = set()
        gone: set[tuple[Location, str]] = set()
        for each in self.unresolved:
            if not self._linker.has_target(each.owner, each.entry, each.proxy):
                continue  # it was edited
            found = self._hook(each.link, each.document.path, each.document.roots) if self._hook is not None else None
            if found is None or not self._linker.replace(each.document, each.line, each.owner, each.entry, each.proxy, found):
                left.append(each)
                continue
            self._linker.finish()  # at once: the next may want the same opposite
            preserve_link(each.owner, each.entry.key, found, each.proxy, True)
            gone.add((Location(str(each.document.path), each.line), each.text))
            kinds_gone.add(each.kind)
        self.odd.drop(UNRESOLVED, kinds_gone, gone)
        wanted = {each.link.partition("#")[0] for each in left}
        for file, kinds in self._of_files.items():
            if file not in wanted:
                for rule, kind in kinds:
                    self.odd.drop_kind(rule, kind)
        told, self.told = self.told, self.odd.findings()
        self.findings[:] = [*self.told, *(each for each in self.findings if all(each is not one for one in told))]
        self.unresolved = left
        return bool(left)

    def find(self, document: Document, uri: str, line: int) -> Any:
        """The document or package that the file part of a reference names, or None with the problem noted."""
        key = (document.path, uri)
        if key in self._opened:
            return self._opened[key]

        location = Location(str(document.path), line)
        found = ecore.EString.ePackage if uri == ecore.nsURI else self.package(uri)
        if found is None:
            path = self.mapped(document.path, uri)
            if path is not None:
                self._mapped.add(key)
            path = path or self._local(document.path, uri)
            found = self.opened.get(path) if self.opened is not None and path is not None else None
            if found is None:
                report = partial(self.open, path, location) if path is not None else partial(self._no_file, uri, location)
                if self._hook is not None and (path is None or not path.exists()):
                    self._not_there[key] = report
                else:
                    found = report()
        self._opened[key] = found
        return found

    def _no_file(self, uri: str, location: Location) -> None:
        text = f"'{uri}' is no file and no known metamodel"
        if self.strict:
            self.problems.append((location, text))
        else:
            self.odd.add(UNRESOLVED, ("uri", uri), location, text, UNRESOLVED_FIX)

    def mapped(self, path: Path, uri: str) -> Path | None:
        """The file of a URI by the session's mapping, or of `platform:/...` by the folders above the file; None for none."""
        for start, place in sorted(self.opened.uris.items(), key=lambda pair: -len(pair[0])) if self.opened is not None else ():
            if uri.startswith(start):
                rest = unquote(uri[len(start) :])
                return Path(os.path.realpath(Path(place) / rest if rest else place))
        if (workspace := _PLATFORM.fullmatch(uri)) is not None:
            inner = unquote(workspace[1])
            return next((above / inner for above in path.parents if (above / inner).is_file()), None)
        return None

    def missing(
        self, document: Document, link: str, line: int, owner: EObject, entry: FeatureEntry, why: str
    ) -> DynamicEObject | None:
        """What stands for the target of a reference that leads nowhere: what the session's hook gives, or a proxy."""
        hook = self._hook if why in ("", LEADS_NOWHERE) else None
        if hook is not None:
            found: DynamicEObject | None = hook(link, document.path, document.roots)
            (self._lost if found is None else self._led).add((document.path, link.partition("#")[0]))
            if found is not None:
                preserve_link(owner, entry.key, found, self.proxy(document, link, entry), True)
                return found
        place, name = Location(str(document.path), line), f"{type(owner).__name__}.{entry.feature.name}"
        if self.strict:
            if why:
                self.problems.append((place, f"{name}: '{link}' {why}"))
            return None
        kind = link.partition("#")[0] if "#" in link else ""
        text = f"{name}: '{link}' {why}"
        if why:  # else why its file was not read is reported already
            fix = UNRESOLVED_FIX if kind and why == LEADS_NOWHERE else _LOCAL_FIX
            self.odd.add(UNRESOLVED, (name, kind), place, text, fix, element=owner)
        proxy = self.proxy(document, link, entry)
        if hook is not None and not entry.feature.containment:
            self.unresolved.append(_Unresolved(document, link, line, owner, entry, proxy, (name, kind), text))
        return proxy

    def preserve_mapped(self, document: Document, link: str, owner: EObject, entry: FeatureEntry, found: EObject) -> bool:
        """Keep the text of a link whose file was found by a mapping: the file's own path says less than it."""
        if not self._mapped or (document.path, link.partition("#")[0]) not in self._mapped:
            return False
        preserve_link(owner, entry.key, found, self.proxy(document, link, entry), False)
        return True

    def proxy(self, document: Document, link: str, entry: FeatureEntry) -> DynamicEObject:
        """What stands for the target of a link, of the class that the file names, else of the feature's."""
        cls = document.types.get(link)
        if cls is None and (named := document.named.get(link)) is not None:
            prefix, _, name = named.rpartition(":")
            eclass = class_in(self.package(document.prefixes.get(prefix, "")), name)
            if eclass is not None and entry.takes(eclass.python_class):
                cls = self.plans.of(eclass).cls
        proxy: DynamicEObject = new_proxy(cls or entry.declared.python_class, link, document.path.parent)
        return proxy

    def count(self) -> None:
        """Hold the elements against the bounds of their features."""
        for document in self.documents.values():
            place = str(document.path)
            for element, plan, line in document.counted:
                slots = element.__dict__
                for key, name, lower, upper in plan.bounds:
                    slot = slots.get(key)
                    number = 0 if slot is None else 1 if slot.__class__ in UNBOXED_TYPES or is_value(slot) else len(slot)
                    if number < lower:
                        wanted = "which it needs" if lower == 1 else f"of which it needs {lower}, but {number}"
                        text = f"{plan.name} has no '{name}', which it needs" if not number else f"{plan.name}.{name}: {wanted}"
                        self.out_of_bounds(Location(place, line), (plan.name, name, "few"), text, element)
                    elif 1 < upper < number:
                        text = f"{plan.name}.{name} takes {upper} values, not {number}"
                        self.out_of_bounds(Location(place, line), (plan.name, name, "many"), text, element)

    def out_of_bounds(self, place: Location, kind: tuple[str, ...], text: str, element: EObject) -> None:
        """Note that an element has too few or too many values."""
        if self.strict:
            self.problems.append((place, text))
        else:
            self.odd.add(BOUNDS, kind, place, text, "correct the model, or the bounds in its metamodel", element=element)
