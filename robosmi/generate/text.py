"""Generated text that knows where each line comes from.

A `Part` is a piece of a file with the elements and the step of the method it comes from; a `GeneratedFile` is a path
and its parts. Together they give the text and one text trace for each run of lines. No template and no file here.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Part:
    """A piece of generated text.

    Attributes:
        text: whole lines, each ending in a line feed.
        step: the step of the method that made it (code, hardware, libraries, generation).
        rule: which part of the template or transformation.
        elements: the model elements it comes from.
    """

    text: str
    step: str
    rule: str
    elements: Sequence[Any] = ()


@dataclass
class GeneratedFile:
    """A file in the making: its path relative to the output folder, and its parts in order."""

    path: str
    parts: list[Part] = field(default_factory=list)

    def add(self, text: str, step: str, rule: str, elements: Iterable[Any] = ()) -> None:
        """Append a part; a missing line feed at its end is added, an empty text is left out."""
        if text:
            self.parts.append(Part(text if text.endswith("\n") else text + "\n", step, rule, tuple(elements)))

    def text(self) -> str:
        """The whole text."""
        return "".join(part.text for part in self.parts)

    def lines(self) -> Iterable[tuple[int, int, Part]]:
        """First and last line (from 1) of each part."""
        line = 1
        for part in self.parts:
            count = part.text.count("\n")
            yield line, line + count - 1, part
            line += count
