"""Texts in HTML, XML and SVG, in Graphviz, in PlantUML and in Markdown.

Markdown is as CommonMark and GitHub read it. A text is shown letter by letter, never as a link, an image, a tag or a heading.
Only characters that would act are escaped: a `*` that ends no emphasis, the `<` of `<stdio.h>`, an underscore inside a word stay.
"""

from __future__ import annotations

import re

from robosmi.quoting.text import one_line, visible

_SCHEMES = ("http", "https", "mailto", "ftp")
_BETWEEN_TAGS = {ord("&"): "&amp;", ord("<"): "&lt;", ord(">"): "&gt;"}
_IN_QUOTES = {**_BETWEEN_TAGS, ord('"'): "&quot;", ord("'"): "&#x27;"}
"""As in Python's `html`, which takes long to load with its list of all entities."""
_NOT_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def html(text: str) -> str:
    """A text between tags.

    >>> html("<script>"), html('5" & more')
    ('&lt;script&gt;', '5" &amp; more')
    """
    return _NOT_XML.sub("\ufffd", text).translate(_BETWEEN_TAGS)


def html_attribute(text: str) -> str:
    """A text in an attribute between quotation marks."""
    return _NOT_XML.sub("\ufffd", text).translate(_IN_QUOTES)


def html_url(text: str) -> str:
    """An address in an attribute (`href`, `src`): relative, or of a scheme that runs nothing; `about:invalid` for any other.

    >>> html_url("authors/x.html"), html_url("java\\nscript:alert(1)")
    ('authors/x.html', 'about:invalid')
    """
    bare = re.sub(r"[\x00-\x20\x7f-\x9f]", "", text)
    scheme, colon, _ = bare.partition(":")
    named = bool(colon) and not re.search(r"[/?#]", scheme)
    return "about:invalid" if named and scheme.lower() not in _SCHEMES else html_attribute(text)


def html_comment(text: str) -> str:
    """A text in a comment of HTML or XML: no `--`, and no `>` or `-` at its ends.

    >>> html_comment("--><script>")
    ' - -><script>'
    """
    line = re.sub(r"-(?=-)", "- ", _NOT_XML.sub("\ufffd", text))
    return f"{' ' if line[:1] in ('-', '>') else ''}{line}{' ' if line[-1:] in ('-', '<', '!') else ''}"


xml, xml_attribute, xml_comment = html, html_attribute, html_comment


def dot_string(text: str) -> str:
    r"""What stands between the quotation marks of a string of Graphviz, shown as it is.

    >>> dot_string('a "b"\\n')
    'a \\"b\\"\\\\n'
    """
    return html(visible(one_line(text))).replace("\\", "\\\\").replace('"', '\\"')


def dot_label(text: str) -> str:
    """A text in an HTML-like label of Graphviz."""
    return html(visible(one_line(text)))


def plantuml(text: str, *, begins: bool = False) -> str:
    """A text in a line or a quoted name of PlantUML: no tag, link, function or directive of its own.

    Args:
        text: the text.
        begins: whether it begins its line.

    >>> plantuml("!include x", begins=True), plantuml('<img:x> [[y]] "'), plantuml("a < b")
    ('<U+0021>include x', '<U+003C>img:x> <U+005B>[y]] <U+0022>', 'a < b')
    """
    line = visible(one_line(text))
    line = line.lstrip() if begins else line
    return (_BEGINS if begins else _ACTS).sub(lambda found: f"<U+{ord(found[0]):04X}>", line)


# ---- Markdown

_ACTS = re.compile(r"""["]|<(?=[A-Za-z/&$#:])|%(?=\w)|\$(?=\w)|\[(?=\[)|(?<=/)'|@(?=start|end)""")
_BEGINS = re.compile(rf"^[^\w\s]|{_ACTS.pattern}")  # directives, comments, separators and braces begin their line


_TAG = r"<(?=[A-Za-z][A-Za-z0-9-]*(?:[\s/>]|$)|/[A-Za-z]|[!?]|[A-Za-z][A-Za-z0-9.+-]{1,31}:|[^\s<>]+@)"
_SCHEME_PATTERN = "|".join(rf"(?<=\b{scheme})" for scheme in ("mailto", "xmpp", "javascript", "data", "vbscript"))
_ADDRESS = rf"(?<=[A-Za-z]):(?=//)|(?i:(?<=\bwww))\.|(?i:{_SCHEME_PATTERN}):|(?<=\S)@(?=\S)"
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
