"""XMI files to models: a file and everything it refers to, as plain elements with no proxies left.

Reads what EMF and pyecore write: both forms of many-valued attributes, references as attributes or as elements with
`href`, comments, any prefix. External entities and DOCTYPE are refused. Problems are collected with their lines and
reported together. Which metamodels there are is `metamodels`' business.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from ordered_set import OrderedSet

from robosmi.diagnostics import Location
from robosmi.errors import ModelError, SourceError, did_you_mean
from robosmi.model.metamodels import Metamodels

XSI = "{http://www.w3.org/2001/XMLSchema-instance}"
XMI = "{http://www.omg.org/XMI}"
_MISSING: Any = object()
_WHOLE = re.compile(r"[+-]?[0-9]+")


def read_models(path: Path, metamodels: Metamodels) -> dict[Path, Any]:
    """Read a model file and the model files that it refers to, directly or through others.

    Args:
        path: the .xmi file.
        metamodels: the metamodels the files may use.

    Returns:
        Absolute path -> root element; the given file comes first.

    Raises:
        SourceError: a file is missing, is no XML or no XMI.
        ModelError: a file contradicts its metamodel, or a reference leads nowhere; all problems in one message.
    """
    loader = _Loader(metamodels)
    loader.load(Path(os.path.realpath(path)), None)
    loader.link()
    if loader.problems:
        shown = "\n".join(f"  {location}: {text}" for location, text in loader.problems[:20])
        more = f"\n  ... and {len(loader.problems) - 20} more" if len(loader.problems) > 20 else ""
        raise ModelError(
            f"the model contradicts its metamodel in {len(loader.problems)} place(s):\n{shown}{more}",
            location=loader.problems[0][0],
            fix="repair the file, or make it again with migrate",
        )
    return loader.roots


class _Loader:
    def __init__(self, metamodels: Metamodels) -> None:
        self.metamodels = metamodels
        self.roots: dict[Path, Any] = {}
        self.problems: list[tuple[Location, str]] = []
        self.pending: list[tuple[Path, int, Any, Any, list[str]]] = []  # file, line, element, feature, URIs

    def load(self, path: Path, referrer: Location | None) -> None:
        if path in self.roots:
            return
        from lxml import etree

        fix = "check the path; a sketch folder keeps its models together in its folder 'models'"
        try:
            data = path.read_bytes()
        except OSError as error:
            raise SourceError(
                f"the model '{path.name}' cannot be read: {error.strerror}", location=referrer or Location(str(path)), fix=fix
            ) from error
        parser = etree.XMLParser(resolve_entities=False, no_network=True, huge_tree=True, remove_comments=True, remove_pis=True)
        try:
            root = etree.fromstring(data, parser)
        except etree.XMLSyntaxError as error:
            raise SourceError(
                f"not well-formed XML: {error.msg}", location=Location(str(path), error.lineno), fix="give a model in XMI"
            ) from error
        if getattr(root.getroottree().docinfo, "doctype", ""):
            raise SourceError("a model with a DOCTYPE is refused", location=Location(str(path), 1), fix="remove the DOCTYPE")
        eclass = self._root_class(root, path)
        self.roots[path] = _MISSING
        self.roots[path] = self._build(root, eclass, path)

    def _root_class(self, node: Any, path: Path) -> Any:
        uri, _, name = str(node.tag).rpartition("}")
        if name == "XMI":
            raise SourceError(
                "a model with several roots cannot be used here",
                location=Location(str(path), node.sourceline),
                fix="keep one root in a file",
            )
        package = self.metamodels.get(uri[1:])
        found = package and package.getEClassifier(name)
        if not found:
            raise SourceError(
                f"the root element '{name}' of the namespace '{uri[1:]}' belongs to no metamodel known here",
                location=Location(str(path), node.sourceline),
                fix=f"known namespaces: {', '.join(self.metamodels.uris())}",
            )
        return found

    def _problem(self, path: Path, line: int, text: str) -> None:
        self.problems.append((Location(str(path), line), text))

    def _build(self, node: Any, cls: Any, path: Path) -> Any:
        element = cls()
        line = node.sourceline
        for name, value in node.attrib.items():
            if name.startswith((XSI, XMI)):
                continue
            feature = _feature(cls, name)
            if feature is None:
                self._problem(path, line, f"{cls.__name__} has no feature '{name}'{did_you_mean(name, _feature_names(cls))}")
            elif feature.is_attribute:
                values = value.split() if feature.many else [value]
                self._set_attribute(element, feature, values, path, line)
            else:
                self.pending.append((path, line, element, feature, value.split()))
        children: dict[str, list[Any]] = {}
        for child in node:
            if not isinstance(child.tag, str):
                continue  # an entity reference: nothing is resolved
            children.setdefault(child.tag, []).append(child)
        for name, nodes in children.items():
            feature = _feature(cls, name)
            if feature is None:
                self._problem(
                    path, nodes[0].sourceline, f"{cls.__name__} has no feature '{name}'{did_you_mean(name, _feature_names(cls))}"
                )
            elif feature.is_attribute:
                self._set_attribute(element, feature, [n.text or "" for n in nodes], path, nodes[0].sourceline)
            elif feature.containment:
                built = [b for n in nodes if (b := self._child(n, feature, path)) is not None]
                if built:
                    setattr(element, feature.name, built if feature.many else built[0])
            else:
                links = [str(n.get("href") or n.text or "") for n in nodes]
                self.pending.append((path, nodes[0].sourceline, element, feature, links))
        for name in _required(cls):
            if name not in node.attrib and name not in children:
                self._problem(path, line, f"{cls.__name__} has no '{name}', which it needs")
        return element

    def _child(self, node: Any, feature: Any, path: Path) -> Any:
        cls = getattr(feature.eType, "python_class", feature.eType)
        if type_name := node.get(XSI + "type"):
            prefix, _, name = type_name.rpartition(":")
            package = self.metamodels.get(node.nsmap.get(prefix or None, ""))
            cls = package and package.getEClassifier(name)
            if not cls:
                self._problem(path, node.sourceline, f"'{type_name}' is no class of a metamodel known here")
                return None
        if cls.eClass.abstract:
            self._problem(path, node.sourceline, f"{cls.__name__} is abstract: the element needs an xsi:type")
            return None
        return self._build(node, cls, path)

    def _set_attribute(self, element: Any, feature: Any, texts: list[str], path: Path, line: int) -> None:
        try:
            values = [_value(feature.eType, text) for text in texts]
        except ValueError as error:
            self._problem(path, line, f"{type(element).__name__}.{feature.name}: {error}")
            return
        setattr(element, feature.name, values if feature.many else values[-1])

    def link(self) -> None:
        """Resolve all references, reading further files as they are met."""
        done = 0
        listed: list[tuple[Any, list[Any]]] = []
        while done < len(self.pending):
            path, line, element, feature, links = self.pending[done]
            done += 1
            targets = []
            for link in links:
                file, _, fragment = link.partition("#") if "#" in link else ("", "", link)
                target_path = Path(os.path.realpath(path.parent / unquote(file))) if file else path
                self.load(target_path, Location(str(path), line))
                target = resolve(self.roots[target_path], fragment)
                if target is None:
                    self._problem(path, line, f"{type(element).__name__}.{feature.name}: '{link}' leads to nothing")
                else:
                    targets.append(target)
            if not targets:
                continue
            try:
                if not feature.many:
                    setattr(element, feature.name, targets[0])
                    continue
                current = getattr(element, feature.name)
                for target in targets:
                    if target not in current:
                        current.append(target)
                listed.append((current, targets))
            except (ModelError, TypeError) as error:
                self._problem(path, line, str(error).splitlines()[0])
        for current, targets in listed:
            _put_in_order(current, targets)


def _put_in_order(collection: Any, listed: list[Any]) -> None:
    """Give a collection the order of the file, whatever order its opposites were met in."""
    wanted = [*dict.fromkeys(listed), *(e for e in collection if e not in listed)]
    if isinstance(collection, OrderedSet) and collection.items != wanted:
        collection.items[:] = wanted
        collection.map.update({element: index for index, element in enumerate(wanted)})


def resolve(root: Any, fragment: str) -> Any:
    """The element at an EMF fragment path (`//@units.0/@body`), or None."""
    element = root
    for step in fragment.split("/")[2:] if fragment != "/" else []:
        name, _, index = step[1:].partition(".")
        value = getattr(element, name, None) if step[:1] == "@" and _feature(type(element), name) is not None else None
        try:
            element = value[int(index)] if index and value is not None else value
        except (IndexError, ValueError):
            return None
        if element is None:
            return None
    return element


_FEATURES: dict[type, Mapping[str, Any]] = {}


def _features(cls: type) -> Mapping[str, Any]:
    found = _FEATURES.get(cls)
    if found is None:
        found = _FEATURES[cls] = {f.name: f for f in cls.eClass.eAllStructuralFeatures()}  # type: ignore[attr-defined]
    return found


def _feature(cls: type, name: str) -> Any:
    return _features(cls).get(name)


def _feature_names(cls: type) -> list[str]:
    return sorted(_features(cls))


_REQUIRED: dict[type, list[str]] = {}


def _required(cls: type) -> list[str]:
    """The features that an element must have, as EMF has it: a lower bound, and no default value to fall back on."""
    found = _REQUIRED.get(cls)
    if found is None:
        features = _features(cls).values()
        found = _REQUIRED[cls] = [
            f.name
            for f in features
            if f.lowerBound > 0
            and not f.derived
            and not f.transient
            and not (f.is_attribute and f.get_default_value() is not None)
        ]
    return found


def _value(kind: Any, text: str) -> Any:
    """The value of an attribute's text.

    Raises:
        ValueError: the text is none of that type.
    """
    from pyecore.ecore import EEnum

    if isinstance(kind, EEnum):
        literal = kind.getEEnumLiteral(name=text)
        if literal is None:
            raise ValueError(f"'{text}' is no literal of {kind.name}{did_you_mean(text, [x.name for x in kind.eLiterals])}")
        return literal
    name = kind.name
    if name in ("EInt", "ELong", "EShort"):
        if not _WHOLE.fullmatch(text):
            raise ValueError(f"'{text}' is no whole number")
        return int(text)
    if name == "EBoolean":
        if text not in ("true", "false"):
            raise ValueError(f"'{text}' is neither true nor false")
        return text == "true"
    if name in ("EDouble", "EFloat"):
        try:
            return float(text.replace("Infinity", "inf"))
        except ValueError:
            raise ValueError(f"'{text}' is no number") from None
    return text
