"""The encoding form of a text file: byte order mark and line ends. Texts are merged without it and written with it.

The last line's end is part of the text itself.
"""

from __future__ import annotations

import codecs
import re
from collections import Counter

from msgspec import Struct

from robosmi.files.files import digest

_END = re.compile(r"\r\n|\r|\n")


class FileText(Struct, frozen=True):
    """The text of a file and its form.

    Attributes:
        text: the text, with a line feed for each line end, whatever the file has, and without a byte order mark.
        marked: whether the file begins with the byte order mark of UTF-8.
        ends: the file's line ends in their order, each a line feed, a carriage return or both; None where the text was read as it
            is, with whatever carriage returns it has.
    """

    text: str
    marked: bool = False
    ends: tuple[str, ...] | None = None

    def written(self, text: str) -> bytes:
        """Another text in this form.

        Args:
            text: with line feeds. Lines that the file has keep the end they have there, wherever they stand now; the others get
                the one that most lines have.
        """
        return (codecs.BOM_UTF8 if self.marked else b"") + self._ended(text).encode(errors="surrogateescape")

    def _ended(self, text: str) -> str:
        if not self.ends:
            return text
        ((usual, count),) = Counter(self.ends).most_common(1)
        if count == len(self.ends):
            return text if usual == "\n" else text.replace("\n", usual)
        from robosmi.generate.three_way import line_map  # few files have several endings

        *lines, last = text.split("\n")
        there = self.text.split("\n")[: len(self.ends)]
        own = {new: self.ends[old] for old, new in line_map(there, lines).items()}
        moved = dict(zip(there, self.ends, strict=False))
        return "".join(f"{line}{own.get(number) or moved.get(line, usual)}" for number, line in enumerate(lines)) + last


def read(data: bytes, *, as_it_is: bool = False, errors: str = "strict") -> FileText:
    """The text of a file.

    Args:
        data: the bytes of the file.
        as_it_is: leave carriage returns in the text: for files whose template writes some itself.
        errors: what to do with bytes that are no UTF-8; `surrogateescape` brings them unchanged into what `written` gives.

    Raises:
        UnicodeDecodeError: the bytes are no UTF-8, and `errors` is `strict`.
    """
    marked = data.startswith(codecs.BOM_UTF8)
    text = data[len(codecs.BOM_UTF8) if marked else 0 :].decode("utf-8", errors)
    if as_it_is:
        return FileText(text, marked)
    if "\r" not in text:
        return FileText(text, marked, ("\n",) * text.count("\n"))
    return FileText(_END.sub("\n", text), marked, tuple(_END.findall(text)))


def same_text(one: bytes, other: bytes | None) -> bool:
    """Whether two files hold the same text, in whatever form."""
    if one == other or other is None:
        return one == other
    return read(one, errors="surrogateescape").text == read(other, errors="surrogateescape").text


def has_digest(data: bytes, wanted: str) -> bool:
    """Whether a file holds the text with this SHA-256, written with line feeds or in any other form."""
    if digest(data) == wanted:
        return True
    text = read(data, errors="surrogateescape").text.encode(errors="surrogateescape")
    return text != data and digest(text) == wanted
