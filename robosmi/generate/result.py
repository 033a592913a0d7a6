"""What a generation made: files with their changes as a unified diff, messages and findings, and where each line comes from."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias, cast

from msgspec import Struct

from robosmi.diagnostics import Finding
from robosmi.generate.output import Text
from robosmi.generate.regions import CommentStyle, partition

if TYPE_CHECKING:
    from robosmi.model.elements.driver import Item
    from robosmi.model.elements.dynamic import Dynamic


class Write(Struct, eq=False):
    """A text to be written to a file.

    Attributes:
        name: path of the file, relative to the output folder, with slashes.
        text: the whole new text, or the text to append.
        overwrite: whether an existing file is replaced.
        merging: whether protected regions of the file are kept.
        append: whether the text is appended to the existing file.
        rule: the rule's name.
        elements: the elements that the rule generated it for.
        styles: the comment styles of markers known when the text was made.
        line: the number of lines of the file before it.
    """

    name: str
    text: Text
    overwrite: bool
    merging: bool
    append: bool
    rule: str
    elements: tuple[Item, ...]
    styles: tuple[CommentStyle, ...]
    line: int = 0


class TextLink(Struct, frozen=True):
    """Lines of a generated file and the elements they come from.

    Attributes:
        path: the file, relative to the output folder.
        line: the first line, from 1.
        end_line: the last line.
        rule: the rule that made the file.
        elements: for a whole text the elements of its rule, for other lines those that the template accessed there.
        region: the id of the region that these lines are, "" for other lines.
        part: the part of the template that made them, "" if it names none.
        step: the step of a method that this part belongs to, or "".
    """

    path: str
    line: int
    end_line: int
    rule: str
    elements: tuple[Item, ...]
    region: str = ""
    part: str = ""
    step: str = ""


class FileChange(Struct):
    """A file that a run made, changed or not.

    Attributes:
        name: relative to the output folder.
        before: its text before the run, None if it was not there.
        after: its text after the run.
        origins: what was written into it, in order.
    """

    name: str
    before: str | None
    after: str | None
    origins: tuple[Write, ...] = ()

    @property
    def changed(self) -> bool:
        """Whether there is anything to write."""
        return self.before != self.after

    @property
    def state(self) -> str:
        """`new`, `changed` or `unchanged`."""
        return "unchanged" if not self.changed else "new" if self.before is None else "changed"

    def diff(self) -> str:
        """The change as a unified diff; empty if there is none."""
        if not self.changed:
            return ""
        from difflib import unified_diff  # only some runs show changes

        lines = unified_diff(
            (self.before or "").splitlines(keepends=True),
            (self.after or "").splitlines(keepends=True),
            f"a/{self.name}" if self.before is not None else "/dev/null",
            f"b/{self.name}",
        )
        return "".join(line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in lines)

    def links(self) -> Iterator[TextLink]:
        """The sources of its lines, for the text in the file."""
        there = _lines(self.after or "")
        stops = [origin.line for origin in self.origins[1:]] + [max(len(there), 1)]
        for origin, stop in zip(self.origins, stops, strict=True):
            yield from self._links(origin, there, stop)

    def _links(self, origin: Write, there: list[str], stop: int) -> Iterator[TextLink]:
        """The links of one text, which is in these lines of the file up to a line (exclusive), perhaps with changes."""
        made, own = _lines(origin.text), there[origin.line : stop]
        places = None
        if made != own:
            from robosmi.generate.three_way import line_map  # few texts stand in their file with changes

            places = line_map(made, own)
        if origin.elements:
            yield TextLink(self.name, origin.line + 1, stop, origin.rule, origin.elements)
        runs = list(_by_parts(origin.text) if origin.text.named else _by_lines(origin.text))
        looked_at = _at_regions(origin, runs)
        for first, final, elements, part, step in runs:
            there_now = [(first, final)] if places is None else _runs(_moved(first, final, places))
            for start, end in there_now:
                line = origin.line + start + 1
                yield TextLink(self.name, line, origin.line + end + 1, origin.rule, elements, "", part, step)
        for region in partition("\n".join([*own, ""]), origin.styles).regions() if origin.text.regions else ():
            if region.identity in origin.text.regions:
                found = {id(e): e for e in (*origin.elements, *looked_at.get(region.identity, ()))}
                first = origin.line + region.line
                end = first + region.text().count("\n")
                yield TextLink(self.name, first, end, origin.rule, tuple(found.values()), region.identity)


class TextTrace:
    """Maps lines of files to elements and back."""

    def __init__(self, links: Sequence[TextLink]) -> None:
        self.links = list(links)
        self._by_path: dict[str, list[TextLink]] = {}
        self._by_element: dict[int, list[TextLink]] = {}
        for link in self.links:
            self._by_path.setdefault(link.path, []).append(link)
            for element in link.elements:
                self._by_element.setdefault(id(element), []).append(link)

    def elements(self, path: str, line: int | None = None) -> list[Dynamic]:
        """The elements that a line of a file comes from, the narrowest run of lines first; without a line all of the file."""
        links = [k for k in self._by_path.get(path, ()) if line is None or k.line <= line <= k.end_line]
        links.sort(key=lambda k: k.end_line - k.line)
        return list({id(e): cast("Dynamic", e) for link in links for e in link.elements}.values())

    def links_of(self, element: Item) -> list[TextLink]:
        """All lines that come from an element."""
        return list(self._by_element.get(id(element), ()))

    def region(self, path: str, identity: str) -> TextLink | None:
        """The region of that id in a file."""
        return next((k for k in self._by_path.get(path, ()) if k.region == identity), None)


class Generation(Struct, dict=True):
    """What a run made.

    Attributes:
        folder: the output folder.
        files: its files in the order they were made.
        messages: what EGL's engine says of them.
        findings: what was kept, lost, or needs the user.
        written: relative paths of all that was written (or would be, in a dry run), records and saved old files included.
        removed: relative paths of what was removed.
        done: whether it was written; false for a dry run.
    """

    folder: Path
    files: Sequence[FileChange]
    messages: list[str] = []
    findings: list[Finding] = []
    written: list[str] = []
    removed: list[str] = []
    done: bool = True

    def file(self, name: str) -> FileChange:
        """The file of that name.

        Raises:
            KeyError: the run made no such file.
        """
        return {file.name: file for file in self.files}[name]

    def diff(self) -> str:
        """All changes as one unified diff."""
        return "".join(file.diff() for file in self.files)

    @cached_property
    def trace(self) -> TextTrace:
        """Which lines come from which elements."""
        return TextTrace([link for file in self.files for link in file.links()])


_LineRun: TypeAlias = "tuple[int, int, tuple[Item, ...], str, str]"
"""First line, last line (from 0), their elements, the part of the template and its step."""


def _at_regions(origin: Write, runs: list[_LineRun]) -> dict[str, tuple[Item, ...]]:
    """Id of a region -> the elements that the line of its first marker comes from."""
    if not origin.text.regions:
        return {}
    lines = {region.line - 1: region.identity for region in partition(origin.text, origin.styles).regions()}
    return {lines[n]: run[2] for run in runs for n in range(run[0], run[1] + 1) if n in lines}


def _lines(text: str) -> list[str]:
    lines = text.split("\n")
    return lines if lines[-1] else lines[:-1]


def _moved(first: int, final: int, places: dict[int, int]) -> list[int]:
    """The current positions of those of the given lines that still exist."""
    return sorted(places[n] for n in range(first, final + 1) if n in places)


def _by_parts(text: Text) -> Iterator[_LineRun]:
    """The runs of lines of a text whose template names its parts."""
    return ((first, final, part.elements, part.name, part.step) for first, final, part in text.lines_of_parts)


def _runs(numbers: list[int]) -> Iterator[tuple[int, int]]:
    """First and last of each run of consecutive numbers."""
    start: int | None = None
    previous = 0
    for number in numbers:
        if start is not None and number > previous + 1:
            yield start, previous
            start = number
        start = number if start is None else start
        previous = number
    if start is not None:
        yield start, previous


def _by_lines(text: Text) -> Iterator[_LineRun]:
    """The runs of lines that come from the same elements, those that the template looked at."""
    ends = [match.start() for match in re.finditer("\n", text)]
    found: dict[int, dict[int, Item]] = {}
    position = 0
    for start, stop, elements in text.sources:
        while position < len(ends) and ends[position] < start:
            position += 1
        line = position
        while True:
            found.setdefault(line, {}).update((id(e), e) for e in elements)
            if line >= len(ends) or ends[line] >= stop - 1:
                break
            line += 1
    run: tuple[int, int, tuple[int, ...]] | None = None
    for line in sorted(found):
        key = tuple(found[line])
        if run is not None and run[1] == line - 1 and run[2] == key:
            run = (run[0], line, key)
            continue
        if run is not None:
            yield run[0], run[1], tuple(found[run[0]].values()), "", ""
        run = (line, line, key)
    if run is not None:
        yield run[0], run[1], tuple(found[run[0]].values()), "", ""
