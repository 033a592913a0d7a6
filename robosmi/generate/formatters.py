"""Formatters of generated text: indentation derived from the text's brackets, like EGL's language formatters.

A formatter is a function from text to text that is given to a rule and applies to that rule only. (In Epsilon it stays with the
template, so that later rules with the same template are formatted, too.)
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable


def by_brackets(increase: str, decrease: str) -> Callable[[str], str]:
    """Make a formatter that replaces all indentation by tabs.

    Args:
        increase: regular expression for text that indents the lines after it (`^` and `$` match at lines).
        decrease: regular expression for text that unindents its own line and those after it.
    """
    deeper, back = re.compile(increase, re.MULTILINE), re.compile(decrease, re.MULTILINE)

    def format_text(text: str) -> str:
        plain = re.sub(r"^[ \t]+(?=[\s\S])", "", text, flags=re.MULTILINE)
        ups = deque(match.end() for match in deeper.finditer(plain))
        downs = deque(match.start() for match in back.finditer(plain))
        lines, depth, position = [], 0, 0
        for line in re.findall(r"[^\n]*\n|[^\n]+", plain):
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
