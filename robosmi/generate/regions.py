"""Protected and controlled regions in a text, by the marker text of EGL, so that either tool reads the other's files.

A region stands between `START protected region ID on|off begin END` and `START protected region ID end END`, where START and END
are the two parts of a comment. `partition` takes a text apart, `merge` puts what a person wrote into a newly made text. Who
writes files, and what becomes of text outside regions, is not decided here.
Source: Epsilon, EGL: Merge Engine; the engine's answers are in tests/epsilon/cases/egl.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property

PROTECTED, CONTROLLED = "protected", "controlled"

CONTENT_TYPES: dict[str, tuple[tuple[str, str], ...]] = {
    "Java": (("//", ""), ("/*", "*/")),
    "HTML": (("<!--", "-->"),),
    "VisualBasic": (("'", ""),),
    "EGL": (("--", ""),),
    "Perl": (("#", ""),),
}
"""The comments of EGL's content types, as start and end; the first one is that of `start_preserve(id, enabled)`."""


@dataclass(frozen=True)
class CommentStyle:
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


@dataclass(frozen=True)
class Region:
    """A region of a text.

    Attributes:
        identity: its id.
        kind: `protected` or `controlled`.
        enabled: whether its marker says `on`.
        contents: what stands between the marker lines, byte for byte.
        style: the comment that its markers are.
        line: where its first marker stands, from 1.
    """

    identity: str
    kind: str
    enabled: bool
    contents: str
    style: CommentStyle
    line: int = 0

    def text(self) -> str:
        """The region with both markers; no line break after the last one."""
        begin = self.style.begin_line(self.kind, self.identity, self.enabled)
        return f"{begin}\n{self.contents}{self.style.end_line(self.kind, self.identity)}"


@dataclass(frozen=True)
class BrokenMarker:
    """A marker without its counterpart: where it stands, its region's id, and what is missing."""

    line: int
    identity: str
    what: str


@dataclass
class Parts:
    """A text taken apart: plain texts and regions in their order, and markers that belong to no region."""

    pieces: list[str | Region] = field(default_factory=list)
    broken: list[BrokenMarker] = field(default_factory=list)

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
        """Regions whose id an earlier one has."""
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
        Its parts. A marker without its counterpart is plain text (the engine drops it), and listed as broken.
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
def _patterns(style: CommentStyle) -> tuple[re.Pattern[str], re.Pattern[str]]:
    """What a marker begins with, and what follows: the id and whether the region begins or ends."""
    start = re.escape(style.start) + r"[^\S\n]*" if style.start else ""
    end = r"[^\S\n]*" + re.escape(style.end) if style.end else ""
    return (
        re.compile(start + r"(controlled|protected) region "),
        re.compile(rf"(?P<id>.*) (?:end\b{end}|(?P<state>on|off) begin{end}\s*$)"),
    )


def _partition(text: str, style: CommentStyle, first_line: int, broken: list[BrokenMarker]) -> list[str | Region]:
    start_pattern, id_pattern = _patterns(style)
    starts = list(start_pattern.finditer(text))
    pieces: list[str | Region] = []
    done, line_at, line = 0, 0, first_line  # text before `done` is in a piece; `line` is that of `line_at`
    opened: tuple[str, str, bool, int, int, int] | None = None
    for number, start in enumerate(starts):
        stop = text.find("\n", start.end()) + 1 or len(text)
        if number + 1 < len(starts):
            stop = min(stop, starts[number + 1].start())
        marker = id_pattern.match(text[start.end() : stop])
        if marker is None:
            continue
        line, line_at = line + text.count("\n", line_at, start.start()), start.start()
        if marker["state"]:
            if opened is not None:
                broken.append(BrokenMarker(opened[5], opened[0], "it is never ended"))
            opened = (marker["id"], start[1], marker["state"] == "on", start.start(), start.end() + marker.end(), line)
        elif opened is None:
            broken.append(BrokenMarker(line, marker["id"], "it is ended but never begun"))
        else:
            identity, kind, enabled, outer, inner, begun = opened
            if outer > done:
                pieces.append(text[done:outer])
            pieces.append(Region(identity, kind, enabled, text[inner : start.start()], style, begun))
            done, opened = start.end() + marker.end(), None
    if opened is not None:
        broken.append(BrokenMarker(opened[5], opened[0], "it is never ended"))
    if done < len(text):
        pieces.append(text[done:])
    return pieces


@dataclass(frozen=True)
class Merged:
    """What `merge` gives: the text, and the ids of regions that the new text no longer has."""

    text: str
    lost: Sequence[str]


def merge(generated: str, existing: str, styles: Sequence[CommentStyle]) -> Merged:
    """A newly made text with the regions that a person turned on in an existing one (EGL's merge).

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
        return Merged(old.text(), ())
    new.pieces = [_kept(piece, there) for piece in new.pieces]
    return Merged(new.text(), [region.identity for region in old.regions() if region.identity not in made])


def _refreshed(piece: str | Region, made: dict[str, Region]) -> str | Region:
    if isinstance(piece, str) or not piece.enabled or piece.kind != CONTROLLED or piece.identity not in made:
        return piece
    return replace(piece, contents=made[piece.identity].contents)


def _kept(piece: str | Region, there: dict[str, Region]) -> str | Region:
    if isinstance(piece, str):
        return piece
    old = there.get(piece.identity)
    if old is None or not old.enabled or old.kind != PROTECTED:
        return piece
    return replace(piece, contents=old.contents, enabled=True)


def styles_in(text: str) -> list[CommentStyle]:
    """The comments that the regions of a text have, judged by the text alone."""
    found: dict[CommentStyle, None] = {}
    for begin in re.finditer(r"^(.*?)(controlled|protected) region (.*) (?:on|off) begin(.*)$", text, re.MULTILINE):
        style = CommentStyle(begin[1].strip(), begin[4].strip())
        if style.end_line(begin[2], begin[3]) in text:
            found[style] = None
    return list(found)
