"""Protected and controlled regions in a text, by the marker text of EGL, so that either tool reads the other's files.

A region stands between `START protected region ID on|off begin END` and `START protected region ID end END`, where START and END
are the two parts of a comment. `partition` takes a text apart, `merge` puts what the user wrote into a newly made text. Who
writes files, and what becomes of text outside regions, is not decided here.
Source: Epsilon, EGL: Merge Engine; the engine's answers are in tests/epsilon/cases/egl.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from functools import cache, cached_property

from msgspec import Struct
from msgspec.structs import replace

PROTECTED, CONTROLLED = "protected", "controlled"

CONTENT_TYPES: dict[str, tuple[tuple[str, str], ...]] = {
    "Java": (("//", ""), ("/*", "*/")),
    "HTML": (("<!--", "-->"),),
    "VisualBasic": (("'", ""),),
    "EGL": (("--", ""),),
    "Perl": (("#", ""),),
}
"""The comments of EGL's content types, as start and end; the first one is that of `start_preserve(id, enabled)`."""


class CommentStyle(Struct, frozen=True, dict=True):
    """The two parts of a comment; the second is empty where a comment ends with its line."""

    start: str = ""
    end: str = ""

    def begin_line(self, kind: str, identity: str, enabled: bool) -> str:
        """The marker that begins a region, without a line break."""
        before, after = self._around
        return f"{before}{kind} region {identity} {'on' if enabled else 'off'} begin{after}"

    def end_line(self, kind: str, identity: str) -> str:
        """The marker that ends a region, without a line break."""
        before, after = self._around
        return f"{before}{kind} region {identity} end{after}"

    @cached_property
    def _around(self) -> tuple[str, str]:
        return (f"{self.start} " if self.start else "", f" {self.end}" if self.end else "")


class Region(Struct, frozen=True):
    """A region of a text.

    Attributes:
        identity: its id.
        kind: `protected` or `controlled`.
        enabled: whether its marker says `on`.
        contents: the text between the marker lines, byte for byte.
        style: the comment style of its markers.
        line: the line of its first marker, from 1.
        opening: its first marker as written, with the line break; "" for the usual form.
        closing: its last marker as written; "" for the usual form.
    """

    identity: str
    kind: str
    enabled: bool
    contents: str
    style: CommentStyle
    line: int = 0
    opening: str = ""
    closing: str = ""

    def text(self) -> str:
        """The region with both markers; no line break after the last one."""
        opening = self.opening or f"{self.style.begin_line(self.kind, self.identity, self.enabled)}\n"
        return f"{opening}{self.contents}{self.closing or self.style.end_line(self.kind, self.identity)}"

    def with_contents(self, contents: str, enabled: bool) -> Region:
        """The same region with other contents, on or off."""
        same = enabled == self.enabled and self.opening.endswith("\n")
        return replace(self, contents=contents, enabled=enabled, opening=self.opening if same else "")

    def as_in(self, other: Region) -> Region:
        """The region with the user's contents, state and marker formatting from the existing file."""
        if (other.kind, other.style) != (self.kind, self.style):
            return self.with_contents(other.contents, other.enabled)
        return replace(other, line=self.line)


class BrokenMarker(Struct, frozen=True):
    """A marker that belongs to no region: its line, its region's id, and what is wrong with it.

    Attributes:
        crowded: whether the fault is text after it on its line, so that the user sees a region there but the engine does not.
    """

    line: int
    identity: str
    what: str
    crowded: bool = False


class Parts(Struct):
    """A text split into plain texts and regions in order, and the markers that belong to no region."""

    pieces: list[str | Region] = []
    broken: list[BrokenMarker] = []

    def regions(self) -> list[Region]:
        """All regions in their order."""
        return [piece for piece in self.pieces if isinstance(piece, Region)]

    def by_id(self) -> dict[str, Region]:
        """The regions by id; the first of several with one id."""
        found: dict[str, Region] = {}
        for region in self.regions():
            found.setdefault(region.identity, region)
        return found

    def twice(self) -> list[Region]:
        """Regions with the id of an earlier one."""
        first = self.by_id()
        return [region for region in self.regions() if first[region.identity] is not region]

    def text(self) -> str:
        """The text of all pieces."""
        return "".join(piece.text() if isinstance(piece, Region) else piece for piece in self.pieces)


def partition(text: str, styles: Iterable[CommentStyle]) -> Parts:
    """Take a text apart into plain texts and regions.

    Args:
        text: with line feeds.
        styles: the comments that markers may be; each is looked for in what the ones before it left over.

    Returns:
        Its parts. A marker without its counterpart is plain text (the engine drops it), and listed as broken; so is one that
        begins a region and has text behind it in its line.
    """
    parts = Parts([text] if text else [])
    if " region " not in text:
        return parts
    for style in styles:
        pieces: list[str | Region] = []
        line = 1
        for piece in parts.pieces:
            if isinstance(piece, Region):
                pieces.append(piece)
                line += piece.text().count("\n")
            else:
                pieces += _partition(piece, style, line, parts.broken)
                line += piece.count("\n")
        parts.pieces = pieces
    return parts


@cache
def _patterns(style: CommentStyle) -> tuple[re.Pattern[str], re.Pattern[str], re.Pattern[str]]:
    """Regular expressions for a marker: its beginning; its id and kind after that; the same followed by other text."""
    start = re.escape(style.start) + r"[^\S\n]*" if style.start else ""
    end = r"[^\S\n]*" + re.escape(style.end) if style.end else ""
    return (
        re.compile(start + r"(controlled|protected) region "),
        re.compile(rf"(?P<id>.*) (?:end\b{end}|(?P<state>on|off) begin{end}\s*$)"),
        re.compile(rf"(?P<id>.*) (?:on|off) begin\b{end}"),
    )


def _partition(text: str, style: CommentStyle, first_line: int, broken: list[BrokenMarker]) -> list[str | Region]:
    start_pattern, id_pattern, crowded_pattern = _patterns(style)
    starts = list(start_pattern.finditer(text))
    pieces: list[str | Region] = []
    done, line_at, line = 0, 0, first_line  # text before `done` is in a piece; `line` is that of `line_at`
    opened: Region | None = None
    outer = inner = 0
    for number, start in enumerate(starts):
        stop = text.find("\n", start.end()) + 1 or len(text)
        if number + 1 < len(starts):
            stop = min(stop, starts[number + 1].start())
        behind = text[start.end() : stop]
        marker, crowded = id_pattern.match(behind), crowded_pattern.match(behind)
        line, line_at = line + text.count("\n", line_at, start.start()), start.start()
        if marker is None:
            if crowded is not None:
                broken.append(BrokenMarker(line, crowded["id"], "text follows it in the same line", True))
            continue
        if marker["state"]:
            if opened is not None:
                broken.append(BrokenMarker(opened.line, opened.identity, "it is never ended"))
            outer, inner = start.start(), start.end() + marker.end()
            opened = Region(marker["id"], start[1], marker["state"] == "on", "", style, line, text[outer:inner])
        elif opened is None:
            broken.append(BrokenMarker(line, marker["id"], "it is ended but never begun"))
        else:
            if outer > done:
                pieces.append(text[done:outer])
            done = start.end() + marker.end()
            pieces.append(replace(opened, contents=text[inner : start.start()], closing=text[start.start() : done]))
            opened = None
    if opened is not None:
        broken.append(BrokenMarker(opened.line, opened.identity, "it is never ended"))
    if done < len(text):
        pieces.append(text[done:])
    return pieces


class Merged(Struct, frozen=True):
    """What `merge` gives.

    Attributes:
        text: the merged text.
        lost: the ids of regions that the new text no longer has.
        broken: markers of the file that no region has, though the new text makes such a region: what the user wrote there is not
            in the merged text.
        owned: whether the file is the user's and only its controlled regions were made anew.
    """

    text: str
    lost: Sequence[str]
    broken: Sequence[BrokenMarker] = ()
    owned: bool = False


def merge(generated: str, existing: str, styles: Sequence[CommentStyle]) -> Merged:
    """A newly made text with the regions that the user turned on in an existing one (EGL's merge).

    If the first region of the new text is a controlled one it is the other way round: the existing text stays and its
    controlled regions that are on are made anew.

    Args:
        generated: the new text.
        existing: the text in the file, with line feeds.
        styles: the comments that markers may be.
    """
    new, old = partition(generated, styles), partition(existing, styles)
    made, there = new.by_id(), old.by_id()
    first = next(iter(new.regions()), None)
    if first is not None and first.kind == CONTROLLED:
        old.pieces = [_refreshed(piece, made) for piece in old.pieces]
        return Merged(old.text(), (), owned=True)
    broken = [marker for marker in old.broken if marker.identity in made and marker.identity not in there]
    new.pieces = [_kept(piece, there) for piece in new.pieces]
    return Merged(new.text(), [region.identity for region in old.regions() if region.identity not in made], broken)


def _refreshed(piece: str | Region, made: dict[str, Region]) -> str | Region:
    if isinstance(piece, str) or not piece.enabled or piece.kind != CONTROLLED or piece.identity not in made:
        return piece
    return piece.with_contents(made[piece.identity].contents, True)


def _kept(piece: str | Region, there: dict[str, Region]) -> str | Region:
    if isinstance(piece, str):
        return piece
    old = there.get(piece.identity)
    if old is None or not old.enabled or old.kind != PROTECTED:
        return piece
    return piece.with_contents(old.contents, True)


_BEGIN = re.compile(
    r"^((?>.*?(?=(?:controlled|protected) region )))(controlled|protected) region (.*) (?:on|off) begin(.*)", re.MULTILINE
)


def styles_in(text: str) -> list[CommentStyle]:
    """The comments that the regions of a text have, judged by the text alone."""
    found: dict[CommentStyle, None] = {}
    if not any(f"{kind} region " in text for kind in (CONTROLLED, PROTECTED)):
        return []  # which most texts have not, and the expression tries each of their characters
    for begin in _BEGIN.finditer(text):
        style = CommentStyle(begin[1].strip(), begin[4].strip())
        if style.end_line(begin[2], begin[3]) in text:
            found[style] = None
    return list(found)
