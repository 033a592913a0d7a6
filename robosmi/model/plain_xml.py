"""Driver for plain XML without a metamodel, with the names of Epsilon's driver: `t_book`, `a_title`, `e_author`, `c_author`.

A type `t_tag` is all elements of a tag, `Element` all elements. Of an element `a_x` and `s_x` are an attribute's text, `i_x`,
`f_x`, `d_x`, `b_x` its value as a number or Boolean, `e_x` the first child element of a tag, `c_x` all of them, `x_x` what an
attribute refers to (`bind`); also `text`, `tagName`, `namespaceURI`, `children`, `descendants`, `parentNode`, `parent`, `line`,
and `name`, the local name. Tags and attributes go by their local names; `M["t_dc:creator"]` is those with that prefix.
`children`, `c_x` and an `x_x` of several are lists whose changes are changes of the document, `M.root` is its root. Source: the
PlainXML driver of Epsilon. Different on purpose: a number that is missing is None and a text that is no number an error, where
Epsilon gives 0; an attribute takes no collection; a document with elements that were put nowhere is not saved.
Entities are never expanded; a file that declares some is refused.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Self, TypeAlias, cast

from robosmi import inputs
from robosmi.errors import ModelError, did_you_mean
from robosmi.files.files import read_input, write_atomic
from robosmi.model.elements.driver import FeatureValue, Item, Kind, Model, ModelElement, Node, Type, refuse_unknown_attribute
from robosmi.model.elements.strict import FeatureValueError, UnknownFeatureError
from robosmi.model.xml_features import ChildList, LiveList, ReferredList, checked, typed, written
from robosmi.model.xml_tree import read_tree, root_offset

if TYPE_CHECKING:
    from lxml.etree import _Element


_PLAIN = ("tagName", "namespaceURI", "text", "children", "parentNode", "line")
_SAME = ("name", "parent", "descendants")
"""Epsilon's other names of what the features above give."""
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

    parentNode = parent = property(eContainer)

    @property
    def children(self) -> ChildList[XmlElement]:
        """The child elements, in order; changes of the list are changes of the document."""
        return self._list(None)

    @property
    def descendants(self) -> list[XmlElement]:
        """All elements in this one, in document order."""
        return self._model._below(self._node)[1:]

    def _children(self, tag: str | None = None) -> list[XmlElement]:
        wrap = self._model._wrap
        return [wrap(child) for child in self._node if isinstance(child.tag, str) and (tag is None or _is_called(child, tag))]

    def _contents(self) -> list[ModelElement]:
        return list[ModelElement](self._children())

    def _features(self) -> list[str]:
        attributes = [f"a_{_local(name)}" for name in self._node.attrib]
        tags = dict.fromkeys(f"c_{_local(child.tag)}" for child in self._node if isinstance(child.tag, str))
        return [*attributes, *_PLAIN, *tags]

    def appendChild(self, child: XmlElement) -> XmlElement:
        """Append an element to this one's children, removing it from its previous parent.

        Raises:
            ModelError: it is no element of this model, or contains this one.
        """
        self._model._move(child, self, None, None)
        return child

    def _list(self, tag: str | None) -> ChildList[XmlElement]:
        move = self._model._move
        return ChildList(self._children(tag), self, lambda child, before: move(child, self, before, tag), self._model._take_out)

    # Features

    @property
    def tagName(self) -> str:
        """The tag as the file writes it, with its prefix."""
        return _name_of(self._node)

    @property
    def name(self) -> str:
        """The tag without its prefix."""
        return _local(self._node.tag)

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
            return self._list(rest)
        if rest and kind == "e":
            return next(iter(self._children(rest)), None)
        if rest and kind == "x":
            return self._model._referred(self, rest)
        raise self._unknown(name)

    def __setattr__(self, name: str, value: FeatureValue) -> None:
        kind, _, rest = name.partition("_")
        if name == "text":
            text = checked("" if value is None else written("s", value, self, name), self, name)
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
                self._model._set(self._node, place, checked(written(kind, value, self, name), self, name))
        elif isinstance(value, LiveList) and value.belongs_to(self):  # `children += [...]`, which has changed them
            return
        elif rest and kind == "x":
            self._model._refer(self, rest, value)
        elif name in (*_PLAIN, *_SAME) or (rest and kind in "ce"):
            raise FeatureValueError(f"{self!r}.{name} cannot be set", fix="use appendChild, delete, or set the attribute")
        else:
            raise self._unknown(name)

    def _unknown(self, name: str) -> UnknownFeatureError:
        known = self._features()
        near = [feature for feature in known if feature.partition("_")[2] == name]
        hint = f" (did you mean '{near[0]}'?)" if near else did_you_mean(name, known)
        return UnknownFeatureError(f"{self!r} has no feature '{name}'{hint}", fix=f"use one of: {', '.join(known)}")

    def _place(self, name: str) -> str:
        """The full name of the attribute with that local name, or name with a prefix; the name itself if there is none."""
        attributes = self._node.attrib
        if name in attributes:
            return name
        prefix, colon, local = name.rpartition(":")
        if colon and (uri := self._model._namespace(prefix, self._node)) is not None:
            return f"{{{uri}}}{local}"
        return next((str(n) for n in attributes if _local(n) == name), name)

    def _attribute(self, name: str) -> str | None:
        found = self._node.get(self._place(name))
        return None if found is None else str(found)

    def __repr__(self) -> str:
        shown = "".join(f" {_local(n)}={v!r}" for n, v in self._node.attrib.items() if _local(n) in ("id", "name", "title"))
        return f"<{type(self).__name__}{shown}>"


class XmlModel(Model):
    """An XML document.

    Args:
        root: lxml's root element; None for a document that has none yet.
        name: what `M!t_book` calls it.
        path: the file it was read from.
    """

    def __init__(self, root: _Element | None, name: str = "M", path: Path | None = None) -> None:
        super().__init__(name, path)
        self._root = root
        self._encoding = "UTF-8" if root is None else root.getroottree().docinfo.encoding or "UTF-8"
        self._before = [] if root is None else list(root.itersiblings(preceding=True))[::-1]
        self._behind = [] if root is None else list(root.itersiblings())
        self._namespaces: dict[str | None, str] = {}
        self._taken_out: list[_Element] = []
        self._head: bytes | None = None
        self._line_end = "\n"
        self._is_new = root is None  # what was read keeps its own layout
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
        if 0 < data.count(b"\r\n") == data.count(b"\n"):
            model._line_end = "\r\n"
        return model

    @classmethod
    def new(cls, path: str | Path | None = None, name: str | None = None, namespaces: Mapping[str, str] | None = None) -> Self:
        """A document without elements: `M.root = M.t_feed()` gives it its first.

        Args:
            path: where it will be saved.
            name: what `M!t_book` calls it; the file's name without its ending if None.
            namespaces: prefix -> namespace, "" for that of tags without prefix; for `M["t_dc:creator"]()`.
        """
        file = None if path is None else Path(path)
        model = cls(None, name or (file.stem if file is not None else "M"), file)
        model._namespaces = {prefix or None: uri for prefix, uri in (namespaces or {}).items()}
        return model

    @property
    def root(self) -> XmlElement | None:
        """The root element; another may be put in its place, which takes it out of the document (Epsilon's `M.root`)."""
        return None if self._root is None else self._wrap(self._root)

    @root.setter
    def root(self, element: XmlElement) -> None:
        """Put another element in the place of the root."""
        node = self._node_of(element)
        if node is self._root:
            return
        self._lift(node)
        if self._root is not None:
            self._taken_out.append(self._root)
        self._root = node
        self._change()

    def __setattr__(self, name: str, value: object) -> None:
        refuse_unknown_attribute(self, name)
        super().__setattr__(name, value)

    def save(self, path: str | Path | None = None) -> None:
        """Write the current document; see `Model.save`.

        Raises:
            ModelError: it has no root, or elements were created and put nowhere.
        """
        write_atomic(self._target(path), self.to_bytes())

    def to_bytes(self) -> bytes:
        """The document as it would be saved."""
        from lxml import etree

        if self._root is None:
            raise ModelError(f"the document {self.name} has no root", fix=f"make one: {self.name}.root = {self.name}.t_tag()")
        if lost := self._loose():
            shown = ", ".join(repr(self._wrap(node)) for node in lost[:3])
            raise ModelError(
                f"{len(lost)} element(s) of {self.name} were created and put nowhere, so that they would be lost: {shown}",
                fix=f"put them somewhere (appendChild, children.append), {self.name}.root = one of them, or delete them",
            )
        head = f'<?xml version="1.0" encoding="{self._encoding}"?>\n' if self._head is None else self._head.decode(self._encoding)
        nodes = [*(self._before if self._head is None else ()), self._root, *self._behind]
        parts = [str(etree.tostring(node, encoding="unicode", with_tail=False, pretty_print=self._is_new)) for node in nodes]
        body = "\n".join([*(part.rstrip("\n") for part in parts), ""]).replace("\n", self._line_end)
        return f"{head}{body}".encode(self._encoding, "xmlcharrefreplace")

    # Types

    def types(self) -> Iterator[tuple[str, Type]]:
        """`Element`, and a type for each tag that occurs."""
        yield "Element", self._base
        for name in dict.fromkeys(_name_of(element._node) for element in self._everything()):
            yield f"t_{name}", self._kind(name)
            if ":" in name:
                yield f"t_{name.rpartition(':')[2]}", self._kind(name.rpartition(":")[2])

    def find_type(self, name: str) -> type[XmlElement] | None:
        """`Element`, or any `t_tag`: without a metamodel a tag need not occur."""
        if name == "Element":
            return self._base
        return self._kind(name[2:]) if name[:2] == "t_" and len(name) > 2 else None

    def _kind(self, tag: str) -> type[XmlElement]:
        found = self._kinds.get(tag)
        if found is None:
            described = {"__slots__": (), "__doc__": f"An element <{tag}>."}
            base = self._kind(tag.rpartition(":")[2]) if ":" in tag else self._base  # the local name finds every prefix
            found = self._kinds[tag] = type(f"t_{tag}", (base,), described)
        return found

    # Extents

    def _wrap(self, node: _Element) -> XmlElement:
        found = self._wrapped.get(node)
        if found is None:
            found = self._wrapped[node] = self._kind(_name_of(node))(self, node)
        return found

    def _change(self) -> None:
        self._all = None

    def _everything(self) -> list[XmlElement]:
        if self._all is None:
            self._all = self._below(*([] if self._root is None else [self._root]), *self._loose())
        return self._all

    def _below(self, *tops: _Element) -> list[XmlElement]:
        """These elements with all in them, in document order."""
        found, left = [], list(reversed(tops))
        while left:  # lxml's own iterator takes quadratic time in depth
            node = left.pop()
            found.append(self._wrap(node))
            left.extend(child for child in reversed(node) if isinstance(child.tag, str))
        return found

    def _loose(self) -> list[_Element]:
        """What was created and put nowhere yet."""
        return [node for node in self._created if node.getparent() is None]

    def all_of_type(self, kind: Kind) -> Sequence[Node]:
        """As `all_of_kind`: without a metamodel there are no subtypes, and a prefix makes no type of its own (Epsilon's rule)."""
        return self.all_of_kind(kind)

    def all_contents(self) -> Iterator[XmlElement]:
        """All elements in document order, then those that were created and put nowhere yet."""
        return iter(list(self._everything()))

    # Identity

    def element(self, identity: str) -> XmlElement | None:
        """The element at a path such as `/instances/instance[3]`, or None."""
        number, slash, path = identity.partition("/")
        if not slash or (number and not number.isdecimal()):
            return None
        created = self._loose()
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
        created = self._loose()
        number = "" if top is self._root else str(created.index(top))
        return f"{number}/{'' if path == '.' else path}"

    def owns(self, element: Item) -> bool:
        """Whether the element is in this document, or was created and put nowhere yet."""
        if not isinstance(element, XmlElement) or element._model is not self:
            return False
        top = _top(element._node)
        return top is self._root or any(top is node for node in self._created)

    def _has(self, element: XmlElement) -> bool:
        """Whether the element is in this document, or was and may be put into it again."""
        return self.owns(element) or (element._model is self and any(_top(element._node) is one for one in self._taken_out))

    def _node_of(self, element: Node) -> _Element:
        """lxml's own for an element of this document; any other is refused."""
        if not isinstance(element, XmlElement) or not self._has(element):
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
            if name == attribute and _is_called(element._node, tag):
                value = element._attribute(attribute) or ""
                ids = [part.strip() for part in value.split(",")] if many else [value.strip()]
                found = [x for x in self.all_of_kind(self._kind(target)) if isinstance(x, XmlElement) and x._attribute(by) in ids]
                if many:
                    return ReferredList(found, element, lambda wanted: self._refer(element, attribute, wanted))
                return found[0] if found else None
        raise _no_reference(element, attribute)

    def _refer(self, element: XmlElement, attribute: str, value: FeatureValue) -> None:
        """Write the identities of the elements that an attribute refers to."""
        for tag, name, target, by, many in self._bindings:
            if name != attribute or not _is_called(element._node, tag):
                continue
            given = [] if value is None else list(value) if many and isinstance(value, Iterable) else [value]
            ids = []
            for one in given:
                own = one._attribute(by) if isinstance(one, XmlElement) and _is_called(one._node, target) else None
                if not own:
                    what = f"{element!r}.x_{attribute} does not take {one!r}: it takes <{target}> with '{by}'"
                    raise FeatureValueError(what, fix="give what bind() says, with an identity")
                ids.append(own)
            setattr(element, f"a_{attribute}", ", ".join(ids) if ids else None)
            return
        raise _no_reference(element, attribute)

    # Change

    def create(self, kind: Kind, /, **features: FeatureValue) -> XmlElement:
        """A new element `t_tag`, in the namespace of the root; put it somewhere with `appendChild`. See `Model.create`."""
        from lxml import etree

        wanted = self.type_named(kind) if isinstance(kind, str) else kind
        tag = next((t for t, cls in self._kinds.items() if cls is wanted), None)
        if tag is None:
            raise ModelError("an Element needs a tag", fix='create a type such as "t_book"')
        spaces = self._namespaces if self._root is None else self._root.nsmap
        prefix, colon, local = tag.rpartition(":")
        if colon:
            namespace = self._namespace(prefix, self._root)
            if namespace is None:
                fix = f'setattr(M.root, "a_xmlns:{prefix}", "URI"), or XmlModel.new(namespaces={{"{prefix}": "URI"}})'
                raise ModelError(f"no namespace has the prefix '{prefix}' of the tag '{tag}'", fix=f"declare it: {fix}")
        else:
            own = self._namespaces.get(None, "") if self._root is None else str(self._root.tag).rpartition("}")[0][1:]
            namespace = own or None
        try:
            node = etree.Element(
                f"{{{namespace}}}{local}" if namespace else local, nsmap=cast("Mapping[str, str]", spaces) if namespace else None
            )
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
            raise ModelError("the root of a document cannot be deleted", fix="delete what it contains, or give it another root")
        self._lift(node)

    def _lift(self, node: _Element) -> None:
        """Take a node out of where it is."""
        _detach(node)
        self._created = [one for one in self._created if one is not node]
        self._taken_out = [one for one in self._taken_out if one is not node]
        self._change()

    def _take_out(self, element: XmlElement) -> None:
        """Take an element out of where it is; it may be put somewhere else later."""
        self._lift(element._node)
        self._taken_out.append(element._node)

    def _move(self, child: Node, parent: XmlElement, before: XmlElement | None, tag: str | None) -> None:
        """Make an element the child of another, before one of its children or as the last; `tag` is what it must be called."""
        if not isinstance(child, XmlElement):
            raise FeatureValueError(f"{parent!r} does not take {child!r}: it takes elements", fix="make one: M.t_tag()")
        if tag is not None and not _is_called(child._node, tag):
            raise FeatureValueError(f"{parent!r}.c_{tag} does not take {child!r}", fix="use children, or c_ with its tag")
        for each in (child, parent):
            self._node_of(each)
        if child._node is self._root or any(child._node is one for one in (parent._node, *parent._node.iterancestors())):
            raise ModelError(f"{child!r} contains {parent!r} and cannot be put into it", fix="put it somewhere else")
        self._lift(child._node)
        if before is None:
            parent._node.append(child._node)
        else:
            before._node.addprevious(child._node)
        self._change()

    def _namespace(self, prefix: str, node: _Element | None) -> str | None:
        """The namespace of a prefix at a node, in the document, or as the document was made; or None."""
        spaces = [each.nsmap for each in (node, self._root) if each is not None]
        return next((str(each[prefix]) for each in (*spaces, self._namespaces) if prefix in each), None)

    def _set(self, node: _Element, place: str, text: str) -> None:
        """Set an attribute; `xmlns` and `xmlns:p` declare namespaces, as in a document of DOM."""
        if place.startswith("xmlns:"):
            self._declare(node, place[len("xmlns:") :], text)
            return
        if place == "xmlns" and None in node.nsmap:
            raise ModelError(f"{self._wrap(node)!r} has a namespace, which cannot be changed", fix="make a new element")
        try:
            node.set(place, text)
        except ValueError as error:
            what = f"'{place}' is no name of an attribute: {error}"
            raise FeatureValueError(what, fix='declare its prefix first: setattr(M.root, "a_xmlns:PREFIX", "URI")') from error

    def _declare(self, node: _Element, prefix: str, uri: str) -> None:
        """Declare a namespace at an element; lxml's elements have theirs from the beginning, so it gets a new one."""
        from lxml import etree

        if node.nsmap.get(prefix) == uri:
            return
        try:
            made = etree.Element(node.tag, nsmap=cast("Mapping[str, str]", {**node.nsmap, prefix: uri}))
        except ValueError as error:
            raise FeatureValueError(f"'{prefix}' cannot stand for '{uri}': {error}", fix="use letters for the prefix") from error
        made.attrib.update(node.attrib)
        made.text, made.tail = node.text, node.tail
        made.extend(list(node))
        parent = node.getparent()
        if parent is not None:
            parent.replace(node, made)
        wrapper = self._wrap(node)
        del self._wrapped[node]
        self._wrapped[made] = wrapper
        object.__setattr__(wrapper, "_node", made)
        self._created = [made if one is node else one for one in self._created]
        self._taken_out = [made if one is node else one for one in self._taken_out]
        if node is self._root:
            self._root = made


def _no_reference(element: XmlElement, attribute: str) -> UnknownFeatureError:
    return UnknownFeatureError(
        f"{element!r} has no reference 'x_{attribute}'", fix="say with bind() what the attribute refers to"
    )


def _local(name: str | bytes) -> str:
    return str(name).rpartition("}")[2]


def _name_of(node: _Element) -> str:
    """The tag as the file writes it, with its prefix."""
    return f"{node.prefix}:{_local(node.tag)}" if node.prefix else _local(node.tag)


def _is_called(node: _Element, tag: str) -> bool:
    """Whether an element has that tag, given with its prefix or without."""
    return _local(node.tag) == tag or (":" in tag and _name_of(node) == tag)


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
