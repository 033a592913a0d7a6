r"""Detects template text that could combine with a printed value into something else: the end of a comment, an escape, a URL.

The functions of `robosmi.quoting` quote a value for its place, independently of the text beside it. This module checks the
template's text directly before and after a value, which become adjacent if the value is empty. Dangerous places are refused
when the template is read. Texts are the template's own, with `VALUE` for each value in them.
"""

from __future__ import annotations

import re

VALUE = "\ue000"
"""The placeholder for a printed value in the text of a template."""

_ESCAPE = (re.compile(rf"(?<!\\)(?:\\\\)*\\(?:x[0-9A-Fa-f]*|[0-7]{{0,2}}|[uU][0-9A-Fa-f]*){VALUE}"), "would go on with an escape")
_COMMENT = (
    (re.compile(rf"{VALUE}\?{VALUE}*/|\?{VALUE}+\?*{VALUE}*/|\?{VALUE}*\?{VALUE}*/{VALUE}"), "could make a trigraph"),
    (re.compile(rf"(?:\\|\?\?/)[ \t]*{VALUE}[ \t{VALUE}]*\n"), "could join the line to the next where it is empty"),
)
_STRING = (
    _ESCAPE,
    (re.compile(rf"{VALUE}\?[{VALUE}/?]|\?\?{VALUE}|\?{VALUE}+\?"), "could make a trigraph"),
)
_RULES: dict[str, tuple[tuple[re.Pattern[str], str], ...]] = {
    "c_word": (
        (re.compile(rf"{VALUE}[\"']"), "could be the prefix of a string"),
        (re.compile(rf"/{VALUE}+[/*]"), "could begin a comment where it is empty"),
    ),
    "c_comment": _COMMENT,
    "c_block_comment": (*_COMMENT, (re.compile(rf"\*{VALUE}+/"), "could end the comment where it is empty")),
    "c_string": _STRING,
    "c_char": _STRING,
    "dot_string": ((re.compile(rf"(?<!\\)(?:\\\\)*\\{VALUE}"), "would be part of an escape"),),
    "html": ((re.compile(rf"&#?\w*{VALUE}"), "would be part of a character's reference"),),
    "html_attribute": (
        (re.compile(rf"&#?\w*{VALUE}"), "would be part of a character's reference"),
        (re.compile(rf"(?i)<meta\b[^>]*{VALUE}[^>]*\bhttp-equiv"), "would be what the tag does"),
    ),
    "html_url": (
        (re.compile(rf"&#?\w*{VALUE}"), "would be part of a character's reference"),
        (re.compile(rf"[\"'][^\"'/?#:]*{VALUE}[^\"'/?#:]*:"), "could be the scheme of an address"),
        (
            re.compile(rf"(?i)[\"']\s*(?!(?:https?|mailto|ftp):)[^\"'/?#:{VALUE}]*:[^\"']*{VALUE}"),
            "would go on such an address",
        ),
    ),
    "html_comment": ((re.compile(rf"-{VALUE}+[->!]"), "could end the comment where it is empty"),),
}
_RULES |= {
    place: ((re.compile(rf"{VALUE}(?!{VALUE}|\Z|{behind})(?=((?s:.{{1,12}})))"), "would be no whole value"),)
    for place, behind in {
        "yaml": r"[ \t]*\n|[ \t]+#|:(?:\s|\Z)",
        "yaml_key": r":(?:\s|\Z)",
        "yaml_flow": r"[ \t]*[,\]}\n]|:(?:\s|\Z)",
        "toml": r"[ \t]*(?:[\n#,\]}=.]|\Z)",
        "csv": r"[,;\t|\r\n]",
    }.items()
}
_REACH = 400  # characters before a value that can matter


def fault(place: str, before: str, text: str) -> str:
    """What could go wrong with a value between the template's texts; empty if nothing.

    Args:
        place: the kind of place of the value (`c_comment`).
        before: the template's text up to and including the value.
        text: the template's text after it, up to and including the next value.
    """
    whole = before[-_REACH:] + text
    end = min(len(before), _REACH)
    for pattern, problem in _RULES.get(place, ()):
        for found in pattern.finditer(whole):
            if found.end() >= end and VALUE in found[0]:
                beside = "".join([found[0], *found.groups("")]).replace(VALUE, "")
                return f"a value beside '{beside}' {problem}"
    return ""
