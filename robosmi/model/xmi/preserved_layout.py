"""A model's new text in the layout of its file: what did not change keeps its bytes, and comments and foreign parts stay.

Three texts are compared: the file, what we would write for the file as it was read, and what we would write now. Of an element
that is the same in the last two the file's own bytes are taken; of another one only the attributes and children that differ are
changed. The result is only used if it reads as the same model (`saved_places`).
"""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterator
from difflib import SequenceMatcher
from xml.parsers import expat

from msgspec import Struct

_DECLARED = re.compile(r"""^\s*<\?xml[^>]*?encoding\s*=\s*["']([A-Za-z][A-Za-z0-9._-]*)["']""")
_ATTRIBUTE = re.compile(rb"""(\s+)([^\s=/>]+)(\s*=\s*)("[^"]*"|'[^']*')""")
_KEYS = (b"xmi:id", b"xmi:uuid", b"id", b"name", b"key", b"href", b"xmi:type", b"xsi:type")
_LARGE = 4_000
"""How many children of one name are compared closely."""


class NotPreservedError(Exception):
    """The layout of a file cannot be preserved."""


class TextElement(Struct, eq=False):
    """An element of an XML text: where its start tag and its end tag begin and end."""

    tag: bytes
    start: int
    inner: int
    outer: int = 0
    end: int = 0
    attributes: dict[bytes, tuple[int, int, bytes]] = {}
    """Name -> where its text with the blanks before it begins and ends, and its value with the quotes."""
    children: list[TextElement] = []

    @property
    def local(self) -> bytes:
        """The tag without its prefix."""
        return self.tag.rpartition(b":")[2]

    @property
    def is_empty(self) -> bool:
        """Whether it has no end tag of its own."""
        return self.inner == self.end


def preserve_layout(original: bytes, before: bytes, now: bytes) -> bytes:
    """The new text of a model in the layout of its file.

    Args:
        original: the file.
        before: the text that we write for the model as the file has it.
        now: the text that we write for the model as it is.

    Raises:
        NotPreservedError: the file is laid out in a way that cannot be followed.
    """
    if before == now:
        return original
    text, encoding, mark = _decoded(original)
    file, old, new = (ElementText(each) for each in (text.encode(), before, now))
    root = file.root
    if root.local == b"XMI" and old.root.local != b"XMI":  # one root in an element around all
        inside = [child for child in root.children if child.local == old.root.local]
        if len(inside) != 1:
            raise NotPreservedError
        root = inside[0]
    if old.root.local != new.root.local or root.local != old.root.local:
        raise NotPreservedError
    merged = _Merge(file, old, new).element(root, old.root, new.root)
    whole = file.data[: root.start] + merged + file.data[root.end :]
    return mark + whole.decode().encode(encoding, "xmlcharrefreplace")


def _decoded(data: bytes) -> tuple[str, str, bytes]:
    """A text, its encoding, and the mark before it."""
    for mark, name in ((codecs.BOM_UTF8, "utf-8"), (codecs.BOM_UTF16_LE, "utf-16-le"), (codecs.BOM_UTF16_BE, "utf-16-be")):
        if data.startswith(mark):
            return data[len(mark) :].decode(name), name, mark
    declared = _DECLARED.match(data[:200].decode("latin-1"))
    name = declared[1] if declared else "utf-8"
    try:
        return data.decode(name), name, b""
    except (LookupError, UnicodeDecodeError):
        raise NotPreservedError from None


class ElementText:
    """The elements of an XML text and where they lie in it.

    Args:
        data: the text in UTF-8, whatever it declares.
    """

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.newline = b"\r\n" if b"\r\n" in data else b"\n"
        parser = expat.ParserCreate("utf-8")
        stack: list[TextElement] = []
        tops: list[TextElement] = []

        def start(name: str, _: dict[str, str]) -> None:
            node = self._start_tag(name.encode(), parser.CurrentByteIndex)
            (stack[-1].children if stack else tops).append(node)
            stack.append(node)

        def end(_: str) -> None:
            node = stack.pop()
            if node.end:
                return
            node.outer = parser.CurrentByteIndex
            node.end = data.index(b">", node.outer) + 1

        parser.StartElementHandler, parser.EndElementHandler = start, end
        try:
            parser.Parse(data, True)
        except expat.ExpatError:
            raise NotPreservedError from None
        self.root = tops[0]

    def _start_tag(self, tag: bytes, at: int) -> TextElement:
        place = at + 1 + len(tag)
        attributes: dict[bytes, tuple[int, int, bytes]] = {}
        while (found := _ATTRIBUTE.match(self.data, place)) is not None:
            attributes[found[2]] = (found.start(), found.end(), found[4])
            place = found.end()
        inner = self.data.index(b">", place) + 1
        node = TextElement(tag, at, inner, attributes=attributes, children=[])
        if self.data[inner - 2 : inner] == b"/>":
            node.outer = node.end = inner
        return node

    def of(self, node: TextElement) -> bytes:
        """The text of an element."""
        return self.data[node.start : node.end]

    def value(self, node: TextElement, name: bytes) -> bytes | None:
        """The value of an attribute, without its quotes."""
        found = node.attributes.get(name)
        return None if found is None else found[2][1:-1]

    def blanks(self, node: TextElement) -> bytes:
        """What is between the last attribute, or the tag, and the end of the start tag."""
        start = max((end for _, end, _ in node.attributes.values()), default=node.start + 1 + len(node.tag))
        return self.data[start : node.inner - (2 if node.is_empty else 1)]

    def key(self, node: TextElement) -> tuple[bytes, ...]:
        """What an element is likely to be recognised by after it was changed."""
        found = next((value for name in _KEYS if (value := self.value(node, name)) is not None), b"")
        return node.tag, found if found or node.children else self.of(node)

    def indent(self, node: TextElement) -> bytes:
        """The blanks before an element in its line."""
        line = self.data.rfind(b"\n", 0, node.start) + 1
        before = self.data[line : node.start]
        return before if not before.strip() else b""


class _Merge:
    """Puts what is new into the file's layout."""

    def __init__(self, file: ElementText, old: ElementText, new: ElementText) -> None:
        self.file = file
        self.old = old
        self.new = new

    def element(self, file: TextElement, old: TextElement, new: TextElement) -> bytes:
        """The text of an element that the file has."""
        if self.old.of(old) == self.new.of(new):
            return self.file.of(file)
        head, gone = self.head(file, old, new)
        blanks = self.file.blanks(file)
        if not new.children and not old.children:  # a value
            before, now = self.old.data[old.inner : old.outer], self.new.data[new.inner : new.outer]
            if not file.children and before != now:
                return b"%s>%s</%s>" % (head, now, file.tag)
        if not new.children and not file.children:
            return head + blanks + self.file.data[file.inner - (2 if file.is_empty else 1) : file.end]
        body = self.body(file, old, new, gone)
        if not body.strip():
            return head + blanks + b"/>"
        return b"%s%s>%s</%s>" % (head, b"" if file.is_empty else blanks, body, file.tag)

    def head(self, file: TextElement, old: TextElement, new: TextElement) -> tuple[bytes, set[bytes]]:
        """The start tag without its end, and the names of attributes that are no elements any more."""
        parts = [self.file.data[file.start : file.start + 1 + len(file.tag)]]
        gone: set[bytes] = set()
        last = b" "
        for name, (start, end, quoted) in file.attributes.items():
            before, now = self.old.value(old, name), self.new.value(new, name)
            raw = self.file.data[start:end]
            last = raw[: len(raw) - len(raw.lstrip())]
            if before is None and now is None and not self.same_children(name, old, new):
                continue  # references that are an attribute in the file, and elements in what we write
            if before == now:
                parts.append(raw)
            elif now is not None:
                parts.append(b'%s"%s"' % (raw[: -len(quoted)], now))
        for name in new.attributes:
            now = self.new.value(new, name)
            if name not in file.attributes and self.old.value(old, name) != now:
                parts.append(b'%s%s="%s"' % (last, name, now))
                gone.add(name)
        gone |= {name for name in old.attributes if name not in new.attributes and name not in file.attributes}
        return b"".join(parts), gone

    def body(self, file: TextElement, old: TextElement, new: TextElement, gone: set[bytes]) -> bytes:
        """What is between the tags."""
        of_old = self.aligned(file, old, new)
        matched = self.matched(old, new)
        pending: dict[bytes, list[TextElement]] = {}
        for child in new.children:
            if child.tag not in file.attributes or not self.same_children(child.local, old, new):
                pending.setdefault(child.tag, []).append(child)
        last_of = {child.local: child for child in file.children if id(child) in of_old}
        sample = file.children[0] if file.children else None
        indent = self.file.indent(sample) if sample is not None else self.file.indent(file) + b"  "
        out: list[bytes] = []
        coming: list[TextElement] = []
        place = file.inner
        for child in file.children:
            gap, place = self.file.data[place : child.start], child.end
            before = of_old.get(id(child))
            if before is None:
                if child.local in gone:
                    out.append(gap.rstrip())
                else:
                    out += [self.filled(gap, coming, indent), self.file.of(child)]
                    coming = []
                continue
            now = matched.get(id(before))
            if now is None:
                out.append(gap.rstrip() if gap.strip() else b"")
            else:
                waiting = pending[now.tag]
                while waiting[0] is not now:
                    coming.append(waiting.pop(0))
                waiting.pop(0)
                out += [self.filled(gap, coming, indent), self.element(child, before, now)]
                coming = []
            if last_of[child.local] is child:
                coming += pending.pop(before.tag, ())
        left = {id(child) for waiting in pending.values() for child in waiting}
        coming += [child for child in new.children if id(child) in left]
        rest = self.filled(self.file.data[place : file.outer], coming, indent)
        if coming and file.is_empty:
            return rest + self.file.newline + self.file.indent(file)
        if not rest.strip() and not any(out):
            return b""
        return b"".join(out) + rest

    def aligned(self, file: TextElement, old: TextElement, new: TextElement) -> dict[int, TextElement]:
        """The file's children -> what we write for them; by name and place among those of the name."""
        found: dict[int, TextElement] = {}
        for tag in dict.fromkeys(child.local for child in old.children):  # of several roots each has its prefix
            ours = [child for child in old.children if child.local == tag]
            theirs = [child for child in file.children if child.local == tag]
            if len(ours) == len(theirs):
                found |= {id(their): our for their, our in zip(theirs, ours, strict=True)}
            elif (theirs or tag not in file.attributes) and not self.same_children(tag, old, new):
                raise NotPreservedError
        return found

    def same_children(self, tag: bytes, old: TextElement, new: TextElement) -> bool:
        """Whether the children of a tag are the same before and now."""
        before = [self.old.of(child) for child in old.children if child.local == tag]
        return before == [self.new.of(child) for child in new.children if child.local == tag]

    def matched(self, old: TextElement, new: TextElement) -> dict[int, TextElement]:
        """The children as they were -> the same as they are."""
        found: dict[int, TextElement] = {}
        for tag in dict.fromkeys(child.tag for child in old.children):
            ours = [child for child in old.children if child.tag == tag]
            theirs = [child for child in new.children if child.tag == tag]
            found |= {id(our): their for our, their in self.pairs(ours, theirs)}
        return found

    def pairs(self, old: list[TextElement], new: list[TextElement]) -> Iterator[tuple[TextElement, TextElement]]:
        """Children that are the same, in the order of both."""
        start, stop = 0, 0
        while start < min(len(old), len(new)) and self.old.key(old[start]) == self.new.key(new[start]):
            start += 1
        while stop < min(len(old), len(new)) - start and self.old.key(old[-1 - stop]) == self.new.key(new[-1 - stop]):
            stop += 1
        yield from zip(old[:start], new[:start], strict=True)
        ours, theirs = old[start : len(old) - stop], new[start : len(new) - stop]
        if max(len(ours), len(theirs)) > _LARGE:
            raise NotPreservedError
        keys = [self.old.key(x) for x in ours], [self.new.key(x) for x in theirs]
        for what, a, b, c, d in SequenceMatcher(None, *keys, autojunk=False).get_opcodes():
            if what == "equal" or (what == "replace" and b - a == d - c):
                yield from zip(ours[a:b], theirs[c:d], strict=True)
        yield from zip(old[len(old) - stop :], new[len(new) - stop :], strict=True)

    def filled(self, gap: bytes, coming: list[TextElement], indent: bytes) -> bytes:
        """What is between two elements, with new ones behind the line of the first."""
        if not coming:
            return gap
        line, mark, rest = gap.partition(b"\n")
        return (
            line.rstrip(b"\r")
            + b"".join(self.inserted(child, indent) for child in coming)
            + (self.file.newline if mark else b"")
            + rest
        )

    def inserted(self, child: TextElement, indent: bytes) -> bytes:
        """The text of a new element in a line of its own."""
        text = self.new.of(child).replace(b"\n" + self.new.indent(child), b"\n" + indent)
        return self.file.newline + indent + text.replace(b"\n", self.file.newline)
