"""Texts in HTML, XML and SVG, in Graphviz and in PlantUML. Markdown is `markdown_text`'s."""

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


_ACTS = re.compile(r"""["]|<(?=[A-Za-z/&$#:])|%(?=\w)|\$(?=\w)|\[(?=\[)|(?<=/)'|@(?=start|end)""")
_BEGINS = re.compile(rf"^[^\w\s]|{_ACTS.pattern}")  # directives, comments, separators and braces begin their line
