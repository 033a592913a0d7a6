"""Texts as values of TOML, YAML, CSV and JSON."""

from __future__ import annotations

import re

from robosmi.base.data_text import Json, json_written
from robosmi.quoting.text import one_line, replace_unseen, visible

_PLAIN = re.compile(r"[A-Za-z0-9_/(][\w./()+:@,;=<>~^*&!?$%-]*(?: +[\w./()+:@,;=<>~^*&!?$%-]+)*")
_OTHER = re.compile(
    r"(?i)(?:y|n|yes|no|true|false|on|off|null|~|-?\.?inf|\.nan|[-+]?[0-9][0-9_,.:e+-]*|0x[0-9a-f_]+|0o[0-7_]+"
    r"|\d{4}-\d\d?-\d\d?.*|=|<<)"
)
_FORMULA = re.compile(r"'*[=+\-@\t\r]")
_HARMLESS = re.compile(r"[-+]?\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?|[-+]+")
"""A number, or a sign alone, such as the name of a supply's pin."""


def toml(text: str) -> str:
    r"""A text as a basic string of TOML, with its quotation marks; half characters, which TOML has none of, as U+FFFD.

    >>> toml('5" \x7f')
    '"5\\" \\u007f"'
    """
    whole = text.encode("utf-16", "surrogatepass").decode("utf-16", "replace")
    return _unseen_as_escapes(json_written(whole, ensure_ascii=False), long="U")


def yaml(text: str) -> str:
    r"""A text as a scalar of YAML 1.1 and 1.2: plain where that means the same text, else between quotation marks.

    >>> yaml("Servo (1.2.1)"), yaml("maker:chip:board"), yaml("no"), yaml("a: b"), yaml("x\n- y")
    ('Servo (1.2.1)', 'maker:chip:board', '"no"', '"a: b"', '"x\\n- y"')
    """
    plain = _PLAIN.fullmatch(text) and not text.endswith(":") and ": " not in text and not _OTHER.fullmatch(text)
    return text if plain and text == visible(one_line(text)) else toml(text)


def yaml_line(text: str) -> str:
    r"""A text in a line of a block of text of YAML (behind `|` or `>`): one line that begins with no blank.

    >>> yaml_line("  a: b\n- c")
    'a: b - c'
    """
    return visible(one_line(text)).lstrip()


def csv_cell(text: str) -> str:
    """A text in a cell of a table: before what a spreadsheet takes for a formula comes an apostrophe (`csv_text` undoes it).

    >>> csv_cell("=1+1"), csv_cell("-5"), csv_cell("LED")
    ("'=1+1", '-5', 'LED')
    """
    return f"'{text}" if _FORMULA.match(text) and not _HARMLESS.fullmatch(text) else text


def csv_record_cell(text: str) -> str:
    """As `csv_cell`, with quotation marks where a comma, a semicolon, a tab, a line break or a quotation mark asks for them.

    >>> csv_record_cell('5" disk, red')
    '"5"" disk, red"'
    """
    cell = csv_cell(text)
    return '"{}"'.format(cell.replace('"', '""')) if re.search(r'[",;\t\n\r|]', cell) else cell


def csv_text(cell: str) -> str:
    """The text behind a cell that `csv_cell` made.

    >>> csv_text("'=1+1"), csv_text("'tis")
    ('=1+1', "'tis")
    """
    return cell[1:] if cell.startswith("'") and csv_cell(cell[1:]) == cell else cell


def json_text(document: Json, *, ascii_only: bool = False) -> str:
    """A document as JSON that a terminal may show: what acts there is written as an escape of JSON.

    Args:
        document: what `json.dumps` takes.
        ascii_only: whether all that is not ASCII is written as an escape.
    """
    return _unseen_as_escapes(json_written(document, indent=1, ensure_ascii=ascii_only), lines=True)


def _unseen_as_escapes(text: str, *, lines: bool = False, long: str = "") -> str:
    r"""The text with the characters that `visible` shows written as `\uXXXX`, beyond 16 bits as `long` or as a surrogate pair."""

    def escape(letter: str) -> str:
        code = ord(letter)
        if lines and letter == "\n":
            return letter
        if code < 0x10000:
            return f"\\u{code:04x}"
        return f"\\{long}{code:08x}" if long else json_written(letter)[1:-1]

    return replace_unseen(text, escape)
