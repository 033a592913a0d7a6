"""Driver for plain XML without a metamodel, with the names of Epsilon's driver: `t_book`, `a_title`, `e_author`, `c_author`.

A type `t_tag` is all elements of a tag, `Element` all elements. Of an element `a_x` and `s_x` are an attribute's text, `i_x`,
`f_x`, `d_x`, `b_x` its value as a number or Boolean, `e_x` the first child element of a tag, `c_x` all of them, `x_x` what an
attribute refers to (`bind`); also `text`, `tagName`, `namespaceURI`, `children`, `parentNode`, `line`. Tags and attributes go by
their local names. Source: the PlainXML driver of Epsilon. Different on purpose: a number that is missing is None and a text that
is no number an error, where Epsilon gives 0. Entities are never expanded; a file that declares some is refused.

Also: texts of XML attributes as the values that the driver of plain XML gives for its prefixes (`i_x`, `b_x`), and back.

Also: protects lxml from XML files that expand entities without limit.

Entities can expand to any size, even inside attributes, where lxml expands them regardless of its options; so the beginning of
a file is examined first. Nothing here interprets elements.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, TypeAlias, cast
from xml.parsers import expat

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import ModelError, SourceError, did_you_mean
from robosmi.files.files import read_input
from robosmi.model.elements.driver import FeatureValue, Item, Kind, Model, ModelElement, Node, Type
from robosmi.model.elements.strict import FeatureValueError, UnknownFeatureError

if TYPE_CHECKING:
    from lxml.etree import _Element


_PLAIN = ("tagName", "namespaceURI", "text", "children", "parentNode", "line")
_TYPED = "abdfis"

Feature: TypeAlias = "bool | int | float | str | XmlElement | list[XmlElement] | None"
"""What a feature of an element gives."""


class XmlElement(ModelElement):
    """An element of an XML document; the module says what its features are."""

    __slots__ = ("_model", "_node")
    _model: XmlModel
    _node: _Element

    def __init__(self, model: XmlModel, node: _Element) -> None:
        object.__setattr__(self, "_model", model)
        object.__setattr__(self, "_node", node)

    # Structure

    def eContainer(self) -> XmlElement | None:
        """The parent element, or None."""
        parent = self._node.getparent()
        return None if parent is None else self._model._wrap(parent)

    parentNode = property(eContainer)

    @property
    def children(self) -> list[XmlElement]:
        """The child elements, in order."""
        wrap = self._model._wrap
        return [wrap(child) for child in self._node if isinstance(child.tag, str)]

    def _contents(self) -> list[ModelElement]:
        return list(self.children)

    def _features(self) -> list[str]:
        attributes = [f"a_{_local(name)}" for name in self._node.attrib]
        tags = dict.fromkeys(f"c_{_local(child.tag)}" for child in self._node if isinstance(child.tag, str))
        return [*attributes, *_PLAIN, *tags]

    def appendChild(self, child: XmlElement) -> XmlElement:
        """Append an element to this one's children, removing it from its previous parent.

        Raises:
            ModelError: it is no element of this model, or contains this one.
        """
        self._model._move(child, self)
        return child

    # Features

    @property
    def tagName(self) -> str:
        """The tag as the file writes it, with its prefix."""
        prefix = self._node.prefix
        return f"{prefix}:{_local(self._node.tag)}" if prefix else _local(self._node.tag)

    @property
    def namespaceURI(self) -> str | None:
        """The namespace of the tag, or None."""
        return str(self._node.tag)[1:].rpartition("}")[0] or None

    @property
    def line(self) -> int | None:
        """The line of the start tag in the file that was read, None for elements that were created."""
        return cast("int | None", self._node.sourceline)

    @property
    def text(self) -> str:
        """All text in the element, that of the elements in it included."""
        return "".join(str(text) for text in self._node.itertext())

    def __getattr__(self, name: str) -> Feature:
        kind, _, rest = name.partition("_")
        if rest and kind in _TYPED and len(kind) == 1:
            value = self._attribute(rest)
            if value is None and rest == "text":
                value = self.text
            return typed(kind, value, self, name)
        if rest and kind == "c":
            return [child for child in self.children if _local(child._node.tag) == rest]
        if rest and kind == "e":
            return next((self._model._wrap(c) for c in self._node if isinstance(c.tag, str) and _local(c.tag) == rest), None)
        if rest and kind == "x":
            return self._model._referred(self, rest)
        raise self._unknown(name)

    def __setattr__(self, name: str, value: FeatureValue) -> None:
        kind, _, rest = name.partition("_")
        if name == "text":
            text = checked("" if value is None else str(value), self, name)
            self._model._change()
            for child in list(self._node):
                self._node.remove(child)
            self._node.text = text
        elif rest and kind in _TYPED and len(kind) == 1:
            place = self._place(rest)
            if value is None:
                if place in self._node.attrib:
                    del self._node.attrib[place]
            else:
                self._node.set(place, checked(written(kind, value, self, name), self, name))
        elif name in _PLAIN or (rest and kind in "cex"):
            raise FeatureValueError(f"{self!r}.{name} cannot be set", fix="use appendChild, delete, or set the attribute")
        else:
            raise self._unknown(name)

    def _unknown(self, name: str) -> UnknownFeatureError:
        known = self._features()
        near = [feature for feature in known if feature.partition("_")[2] == name]
        hint = f" (did you mean '{near[0]}'?)" if near else did_you_mean(name, known)
        return UnknownFeatureError(f"{self!r} has no feature '{name}'{hint}", fix=f"use one of: {', '.join(known)}")

    def _place(self, name: str) -> str:
        """The full name of the attribute with that local name; the name itself if there is none."""
        attributes = self._node.attrib
        return name if name in attributes else next((str(n) for n in attributes if _local(n) == name), name)

    def _attribute(self, name: str) -> str | None:
        found = self._node.get(self._place(name))
        return None if found is None else str(found)

    def __repr__(self) -> str:
        shown = "".join(f" {_local(n)}={v!r}" for n, v in self._node.attrib.items() if _local(n) in ("id", "name", "title"))
        return f"<{type(self).__name__}{shown}>"


class XmlModel(Model):
    """An XML document.

    Args:
        root: lxml's root element.
        name: what `M!t_book` calls it.
        path: the file it was read from.
    """

    def __init__(self, root: _Element, name: str = "M", path: Path | None = None) -> None:
        super().__init__(name, path)
        self._root = root
        self._head: bytes | None = None
        self._created: list[_Element] = []
        self._wrapped: dict[_Element, XmlElement] = {}
        self._kinds: dict[str, type[XmlElement]] = {}
        self._base = type("Element", (XmlElement,), {"__slots__": (), "__doc__": "Any element."})
        self._bindings: list[tuple[str, str, str, str, bool]] = []
        self._all: list[XmlElement] | None = None

    @classmethod
    def load(cls, path: str | Path, name: str | None = None) -> Self:
        """Read an XML file.

        Raises:
            SourceError: it cannot be read, is not well-formed, or declares entities.
        """
        file = Path(path)
        return cls.parse(read_input(file, "XML file", inputs.MODEL), name or file.stem, file)

    @classmethod
    def parse(cls, data: bytes, name: str = "M", path: Path | None = None) -> Self:
        """Read an XML text; see `load`."""
        place = str(path) if path is not None else name
        start = root_offset(data, place)
        model = cls(read_tree(data, place, deep=start >= 0), name, path)
        model._head = data[:start] if start >= 0 else None
        return model

    def save(self, path: str | Path | None = None) -> None:
        """Write the current document, without elements that have no parent; see `Model.save`."""
        from robosmi.files.files import write_atomic

        write_atomic(self._target(path), self.to_bytes())

    def to_bytes(self) -> bytes:
        """The document as it would be saved."""
        from lxml import etree

        encoding = self._root.getroottree().docinfo.encoding or "UTF-8"
        head = f'<?xml version="1.0" encoding="{encoding}"?>\n' if self._head is None else self._head.decode(encoding)
        nodes = [self._root, *self._root.itersiblings()]
        parts = [str(etree.tostring(node, encoding="unicode", with_tail=False)) for node in nodes]
        return "".join([head, "\n".join(parts), "\n"]).encode(encoding, "xmlcharrefreplace")

    # Types

    def types(self) -> Iterator[tuple[str, Type]]:
        """`Element`, and a type for each tag that occurs."""
        yield "Element", self._base
        for tag in dict.fromkeys(_local(element._node.tag) for element in self._everything()):
            yield f"t_{tag}", self._kind(tag)

    def find_type(self, name: str) -> type[XmlElement] | None:
        """`Element`, or any `t_tag`: without a metamodel a tag need not occur."""
        if name == "Element":
            return self._base
        return self._kind(name[2:]) if name[:2] == "t_" and len(name) > 2 else None

    def _kind(self, tag: str) -> type[XmlElement]:
        found = self._kinds.get(tag)
        if found is None:
            described = {"__slots__": (), "__doc__": f"An element <{tag}>."}
            found = self._kinds[tag] = type(f"t_{tag}", (self._base,), described)
        return found

    # Extents

    def _wrap(self, node: _Element) -> XmlElement:
        found = self._wrapped.get(node)
        if found is None:
            found = self._wrapped[node] = self._kind(_local(node.tag))(self, node)
        return found

    def _change(self) -> None:
        self._all = None

    def _everything(self) -> list[XmlElement]:
        if self._all is None:
            wrap = self._wrap
            tops = [*(node for node in reversed(self._created) if node.getparent() is None), self._root]
            self._all = []
            while tops:  # lxml's own iterator takes quadratic time in depth
                node = tops.pop()
                self._all.append(wrap(node))
                tops.extend(child for child in reversed(node) if isinstance(child.tag, str))
        return self._all

    def all_contents(self) -> Iterator[XmlElement]:
        """All elements in document order, then those that were created and put nowhere yet."""
        return iter(list(self._everything()))

    # Identity

    def element(self, identity: str) -> XmlElement | None:
        """The element at a path such as `/instances/instance[3]`, or None."""
        number, slash, path = identity.partition("/")
        if not slash or (number and not number.isdecimal()):
            return None
        created = [node for node in self._created if node.getparent() is None]
        top = self._root if not number else created[int(number)] if int(number) < len(created) else None
        if top is None:
            return None
        try:
            found = top.find(path) if path else top
        except SyntaxError:
            return None
        return None if found is None else self._wrap(found)

    def id_of(self, element: Node) -> str:
        """The path of an element from the root: tags with their positions."""
        node = self._node_of(element)
        top = _top(node)
        path = top.getroottree().getelementpath(node)
        created = [node for node in self._created if node.getparent() is None]
        number = "" if top is self._root else str(created.index(top))
        return f"{number}/{'' if path == '.' else path}"

    def owns(self, element: Item) -> bool:
        """Whether the element is in this document, or was created and put nowhere yet."""
        if not isinstance(element, XmlElement) or element._model is not self:
            return False
        top = _top(element._node)
        return top is self._root or any(top is node for node in self._created)

    def _node_of(self, element: Node) -> _Element:
        """lxml's own for an element of this document; any other is refused."""
        self._check_owned(element)
        assert isinstance(element, XmlElement)
        return element._node

    def bind(self, tag: str, attribute: str, target: str, target_attribute: str, many: bool = False) -> None:
        """Say what an attribute refers to, for `x_attribute` (the driver's `bind` and `bindMany` in Epsilon).

        Args:
            tag: of the elements that refer.
            attribute: of theirs, with the identity; with `many` several, separated by commas.
            target: tag of the elements referred to.
            target_attribute: of theirs, with their identity.
            many: whether it refers to several.
        """
        self._bindings.append((tag, attribute, target, target_attribute, many))

    def _referred(self, element: XmlElement, attribute: str) -> XmlElement | list[XmlElement] | None:
        for tag, name, target, by, many in self._bindings:
            if name == attribute and tag == _local(element._node.tag):
                value = element._attribute(attribute) or ""
                ids = [part.strip() for part in value.split(",")] if many else [value.strip()]
                found = [x for x in self.all_of_kind(self._kind(target)) if isinstance(x, XmlElement) and x._attribute(by) in ids]
                return found if many else (found[0] if found else None)
        raise UnknownFeatureError(
            f"{element!r} has no reference 'x_{attribute}'", fix="say with bind() what the attribute refers to"
        )

    # Change

    def create(self, kind: Kind, /, **features: FeatureValue) -> XmlElement:
        """A new element `t_tag`, in the namespace of the root; put it somewhere with `appendChild`. See `Model.create`."""
        from lxml import etree

        wanted = self.type_named(kind) if isinstance(kind, str) else kind
        tag = next((t for t, cls in self._kinds.items() if cls is wanted), None)
        if tag is None:
            raise ModelError("an Element needs a tag", fix='create a type such as "t_book"')
        namespace = str(self._root.tag).rpartition("}")[0]
        prefixes = cast("dict[str, str]", self._root.nsmap)  # with None for the namespace that needs no prefix
        try:
            node = etree.Element(f"{namespace}}}{tag}" if namespace else tag, nsmap=prefixes if namespace else None)
        except ValueError as error:
            raise ModelError(f"'{tag}' is no tag: {error}", fix="use letters, digits, '-', '.' and '_'") from error
        made = self._wrap(node)
        for name, value in features.items():
            setattr(made, name, value)
        self._created.append(node)
        self._change()
        return made

    def delete(self, element: Node) -> None:
        """Take an element with all it contains out of the document; the text behind it stays. See `Model.delete`."""
        node = self._node_of(element)
        if node is self._root:
            raise ModelError("the root of a document cannot be deleted", fix="delete what it contains")
        _detach(node)
        self._created = [one for one in self._created if one is not node]
        self._change()

    def _move(self, child: XmlElement, parent: XmlElement) -> None:
        self._check_owned(child)
        self._check_owned(parent)
        if child._node is self._root or any(child._node is one for one in (parent._node, *parent._node.iterancestors())):
            raise ModelError(f"{child!r} contains {parent!r} and cannot be put into it", fix="put it somewhere else")
        _detach(child._node)
        parent._node.append(child._node)
        self._created = [node for node in self._created if node is not child._node]
        self._change()


def _local(name: str | bytes) -> str:
    return str(name).rpartition("}")[2]


def _top(node: _Element) -> _Element:
    return next(reversed(list(node.iterancestors())), node)


def _detach(node: _Element) -> None:
    """Take a node out of its parent; the text behind it stays."""
    parent, tail = node.getparent(), node.tail
    if parent is None:
        return
    before = node.getprevious()
    if tail and before is not None:
        before.tail = (before.tail or "") + tail
    elif tail:
        parent.text = (parent.text or "") + tail
    parent.remove(node)
    node.tail = None


def open_xml(path: Path, name: str | None = None) -> XmlModel:
    """Open an XML file; see `XmlModel.load`."""
    return XmlModel.load(path, name)


_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def typed(kind: str, value: str | None, element: ModelElement, name: str) -> bool | int | float | str | None:
    """The value of an attribute as that prefix asks for it: text, Boolean, whole number or number."""
    if kind in "as":
        return value or ""
    if kind == "b":
        return (value or "").strip().lower() == "true"
    if value is None:
        return None
    try:
        return int(value) if kind == "i" else float(value)
    except ValueError:
        raise FeatureValueError(
            f"{element!r}.{name}: '{value}' is no {'whole ' if kind == 'i' else ''}number", fix="use a_..."
        ) from None


def written(kind: str, value: FeatureValue, element: ModelElement, name: str) -> str:
    """The text of a value that an attribute is given by that prefix; of another kind it is refused."""
    wanted = {"b": (bool,), "i": (int,), "f": (int, float), "d": (int, float)}.get(kind)
    if wanted is not None and (not isinstance(value, wanted) or (kind != "b" and isinstance(value, bool))):
        raise FeatureValueError(f"{element!r}.{name} does not take {value!r}", fix="give a value of its kind, or use a_...")
    return str(value).lower() if isinstance(value, bool) else str(value)


def checked(text: str, element: ModelElement, name: str) -> str:
    """The text itself, if XML can hold it."""
    if bad := _FORBIDDEN.search(text):
        raise FeatureValueError(f"{element!r}.{name}: XML cannot hold U+{ord(bad.group()):04X}", fix="remove the character")
    return text


_TOO_DEEP = re.compile(r"Excessive depth in document: (\d+)")
"""libxml2's message about a file that is nested deeper than it reads."""


class _Found(Exception):
    """Raised when the root element has been reached."""


def root_offset(data: bytes, place: str) -> int:
    """Where the root element begins in a file that declares no entities, so that a parser may go without its limits.

    Args:
        data: the file.
        place: its path, for the message.

    Returns:
        The offset; -1 if the head cannot be read here, because of its encoding or an error: let a parser with limits look at it.

    Raises:
        SourceError: it has a DOCTYPE with declarations of its own.
    """
    parser = expat.ParserCreate()

    def doctype(name: str, system: str | None, public: str | None, declares: bool) -> None:
        if declares:
            where = Location(place, parser.CurrentLineNumber)
            raise SourceError("a file that declares entities is refused", location=where, fix="remove the DOCTYPE")

    def start(name: str, attributes: Any) -> None:
        raise _Found(parser.CurrentByteIndex)

    parser.StartDoctypeDeclHandler = doctype
    parser.StartElementHandler = start
    try:
        parser.Parse(data, True)
    except _Found as found:
        return int(found.args[0])
    except (expat.ExpatError, LookupError, ValueError):  # the real parser says what is wrong, or knows the encoding
        pass
    return -1


def read_tree(data: bytes, place: str, deep: bool) -> Any:
    """The root of lxml's tree for a file.

    Args:
        data: the file.
        place: its path, for the message.
        deep: whether it is known to declare no entity, so that it may be of any size, and 2,048 levels deep instead of 256.

    Raises:
        SourceError: it is not well-formed, or nested too deeply.
    """
    from lxml import etree

    parser = etree.XMLParser(resolve_entities=False, no_network=True, huge_tree=deep, strip_cdata=False)
    try:
        return etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        where = Location(place, error.lineno or None)
        if match := _TOO_DEEP.search(error.msg or ""):
            raise SourceError(
                f"elements are nested more than {match[1]} levels deep",
                location=where,
                fix="nest the elements of the file less deeply",
            ) from error
        raise SourceError(f"not well-formed XML: {error.msg}", location=where, fix="repair the file") from error
