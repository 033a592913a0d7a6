"""Formatters of generated text: indentation by the lines' own brackets, as EGL's language formatters do it.

A formatter is a function from text to text, given to a rule; it holds for that rule alone. (In the engine it sticks to the
template, so that later rules with the same template are formatted too.)
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable

from robosmi.typed import matches


def by_brackets(increase: str, decrease: str) -> Callable[[str], str]:
    """A formatter that throws indentation away and makes it anew with tabs.

    Args:
        increase: what makes the lines behind it deeper, a regular expression over the whole text (`^` and `$` are lines').
        decrease: what makes its line and those behind it less deep.
    """
    deeper, back = re.compile(increase, re.MULTILINE), re.compile(decrease, re.MULTILINE)

    def format_text(text: str) -> str:
        plain = re.sub(r"^[ \t]+(?=[\s\S])", "", text, flags=re.MULTILINE)
        ups = deque(match.end() for match in deeper.finditer(plain))
        downs = deque(match.start() for match in back.finditer(plain))
        lines, depth, position = [], 0, 0
        for line in matches(r"[^\n]*\n|[^\n]+", plain):
            begin, position = position, position + len(line)
            margin = depth
            while ups and position > ups[0]:
                depth += 1
                ups.popleft()
            while downs and position > downs[0]:
                if downs[0] == begin:
                    margin -= 1
                depth -= 1
                downs.popleft()
            lines.append("\t" * max(margin, 0) + line)
        return "".join(lines)

    return format_text


java = by_brackets(r"\{\s*$", r"^\}")
"""For languages with curly brackets (EGL's JavaFormatter)."""

xml = by_brackets(r"<([^/]|([^?!/][^>]*[^/]))>", r"</[^>]*>")
"""For XML (EGL's XmlFormatter)."""
