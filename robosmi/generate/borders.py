r"""What a template's own characters and a printed value could be together: the end of a comment, an escape, an address that runs.

The functions of `robosmi.quoting` quote a value for the place where it stands, whatever is beside it. What they cannot see is
told here: the template's text before and behind the value, which meet where the value is empty. Such a place is refused when the
template is read. Texts are the template's own, with `VALUE` for each value in them.
"""

from __future__ import annotations

import re

VALUE = "\ue000"
"""Stands for a printed value in the text of a template."""

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
    """What could go wrong where a value is beside the template's own characters; empty if nothing.

    Args:
        place: where the value stands (`c_comment`).
        before: the template up to a value, with it.
        text: the template behind it, up to the next value and with that.
    """
    whole = before[-_REACH:] + text
    end = min(len(before), _REACH)
    for pattern, problem in _RULES.get(place, ()):
        for found in pattern.finditer(whole):
            if found.end() >= end and VALUE in found[0]:
                beside = "".join([found[0], *found.groups("")]).replace(VALUE, "")
                return f"a value beside '{beside}' {problem}"
    return ""
