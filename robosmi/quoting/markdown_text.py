"""Texts in Markdown as CommonMark and GitHub read it: shown letter by letter, never a link, an image, a tag or a heading.

A text that is shown as it is stays as it is: a `*` that ends no emphasis, the `<` of `<stdio.h>`, an underscore inside a word.
"""

from __future__ import annotations

import re

from robosmi.quoting.text import one_line, visible

_TAG = r"<(?=[A-Za-z][A-Za-z0-9-]*(?:[\s/>]|$)|/[A-Za-z]|[!?]|[A-Za-z][A-Za-z0-9.+-]{1,31}:|[^\s<>]+@)"
_SCHEMES = "|".join(rf"(?<=\b{scheme})" for scheme in ("mailto", "xmpp", "javascript", "data", "vbscript"))
_ADDRESS = rf"(?<=[A-Za-z]):(?=//)|(?i:(?<=\bwww))\.|(?i:{_SCHEMES}):|(?<=\S)@(?=\S)"
_ACTIVE = re.compile(
    rf"(?P<tag>{_TAG})|(?P<entity>&(?=\#?\w+;))|(?P<address>{_ADDRESS})|(?P<backslash>\\(?=[!-/:-@\[-`{{-~]|$))|(?P<tick>`)"
    r"|(?P<bracket>\](?=[(\[:]))|(?P<run>\*+|~+|_+)|(?P<close>(?<=\s)\#(?=\#*\s*$))"
)
_PLAIN = re.compile(r"[A-Za-z0-9 ,;'()/+=-]*+")
_BACKSLASH_AT_END = re.compile(r"\\(?=\||$)")
"""What acts nowhere within a line."""
_BLOCK = re.compile(
    r"(?:\#{1,6}(?:\s|$)|>|[-+*](?:\s|$)|`{3}|~{3}|=+\s*$|-+\s*$|(?:[-*_]\s*){3,}$|\[[^\]]*\]|[|:]|-+\s*[|:])"
    r"|(?P<number>\d{1,9})[.)](?:\s|$)"
)


def markdown(text: str) -> str:
    r"""A text within a line.

    >>> markdown("int *p"), markdown("<script>"), markdown("[a](javascript:x)"), markdown("**b**"), markdown("port a[0]: read")
    ('int *p', '&lt;script>', '[a\\](javascript&#58;x)', '**b\\*\\*', 'port a[0]: read')
    """
    if _PLAIN.fullmatch(text):
        return text
    line = visible(one_line(text))
    return _ACTIVE.sub(lambda found: _literal(found, line), line)


def _literal(found: re.Match[str], line: str) -> str:
    if found["tag"]:
        return "&lt;"
    if found["entity"]:
        return "&amp;"
    if found["address"]:
        return f"&#{ord(found[0])};"
    if found["run"] and not _may_close(line, found.start(), found.end()):
        return found[0]
    if found["bracket"] and line[found.end()] == ":" and not line.startswith("["):  # only a line's first brackets define a link
        return found[0]
    return "".join(f"\\{letter}" for letter in found[0])


def _may_close(line: str, start: int, end: int) -> bool:
    """Whether a run of `*`, `_` or `~` may end an emphasis, whatever stands around the text."""
    before, after = line[start - 1 : start] if start else "", line[end : end + 1]
    blank_after = not after or after.isspace()
    if before.isspace():
        return False
    mark_before, mark_after = not before or not before.isalnum(), blank_after or not after.isalnum()
    closes = not mark_before or mark_after
    opens = not blank_after and (not mark_after or mark_before)
    return closes and (line[start] != "_" or not opens or mark_after)


def markdown_block(text: str) -> str:
    r"""A text that begins a line, a list's item or a paragraph.

    >>> markdown_block("# no heading"), markdown_block("1. one"), markdown_block("--bind P1=D2")
    ('\\# no heading', '1\\. one', '--bind P1=D2')
    """
    line = visible(one_line(text)).lstrip()
    found = _BLOCK.match(line)
    quoted = markdown(line)
    if not found or quoted.startswith("\\"):
        return quoted
    place = len(found["number"]) if found["number"] else 0
    return f"{quoted[:place]}\\{quoted[place:]}"


def markdown_cell(text: str) -> str:
    r"""A text in a cell of a table, runs of blanks as one.

    >>> markdown_cell("a | b"), markdown_cell("a\n\n b")
    ('a \\| b', 'a b')
    """
    return " ".join(markdown(text).replace("|", "\\|").split())


def markdown_code(text: str) -> str:
    """A text between two backticks; its own become apostrophes, and an empty one a blank.

    >>> markdown_code("int x[3] | <b>"), markdown_code("a`b"), markdown_code("")
    ('int x[3] | <b>', "a'b", ' ')
    """
    return visible(one_line(text)).replace("`", "'") or " "


def markdown_code_cell(text: str) -> str:
    """As `markdown_code`, in a cell of a table.

    >>> markdown_code_cell("a|b")
    'a\\\\|b'
    """
    return " ".join(_BACKSLASH_AT_END.sub(r"\\ ", markdown_code(text)).replace("|", "\\|").split()) or " "
