"""Texts in C and C++ (and what is close to it), and names made from texts: identifiers and file names.

What a comment or a string may hold is C's translation phases: trigraphs, then lines joined by a backslash, then comments.
"""

from __future__ import annotations

import re

from robosmi.quoting.text import one_line, visible

C_WORDS = frozenset({
    "alignas", "alignof", "and", "and_eq", "asm", "auto", "bitand", "bitor", "bool", "break", "case", "catch", "char",
    "char8_t", "char16_t", "char32_t", "class", "co_await", "co_return", "co_yield", "compl", "concept", "const",
    "const_cast", "consteval", "constexpr", "constinit", "continue", "decltype", "default", "delete", "do", "double",
    "dynamic_cast", "else", "enum", "explicit", "export", "extern", "false", "final", "float", "for", "friend", "goto", "if",
    "import", "inline", "int", "long", "main", "module", "mutable", "namespace", "new", "noexcept", "not", "not_eq",
    "nullptr", "operator", "or", "or_eq", "override", "private", "protected", "public", "register", "reinterpret_cast",
    "requires", "restrict", "return", "short", "signed", "sizeof", "static", "static_assert", "static_cast", "struct",
    "switch", "template", "this", "thread_local", "throw", "true", "try", "typedef", "typeid", "typename", "typeof", "union",
    "unsigned", "using", "virtual", "void", "volatile", "wchar_t", "while", "xor", "xor_eq",
})  # fmt: skip
"""What no identifier of C or C++ may be, `main` included."""

_WORD = re.compile(r"[A-Za-z_][A-Za-z0-9_]*|[0-9][A-Za-z0-9_.]*|")
_DEVICES = re.compile(r"(?i)(con|prn|aux|nul|com\d|lpt\d)(\.|$)")
_SLASHES = re.compile(r"//+")
_ENDS_HEADER = re.compile(r'[<>"#?*\\\x00-\x1f]+(?: \\[xu])?')
_UNDERSCORES = re.compile(r"_{2,}")
_NOT_OF_WORDS = re.compile(r"[^A-Za-z0-9_]")
_LENGTH = 200
"""Limit on a file name in bytes; file systems allow 255, and endings are appended."""


def c_comment(text: str) -> str:
    r"""A text inside a comment: on one line, without what ends a comment, begins one, or joins the line to the next.

    >>> c_comment("LED\nint evil=42; //"), c_comment("a */ b"), c_comment("C:\\")
    ('LED int evil=42; //', 'a * / b', 'C:\\ .')
    """
    line = visible(one_line(text)).replace("*/", "* /").replace("/*", "/ *").replace("??/", "? ?/")
    if line.rstrip().endswith(("\\", "?/")):
        return f"{line.rstrip()} ."
    if line == "/":  # could end a trigraph that others begin
        return " /"
    return f"{line} " if line.endswith("??") or (line and not line.strip("?")) else line


def c_block_comment(text: str) -> str:
    """As `c_comment`, where a `*` may stand before the text and a `/` behind it.

    >>> c_block_comment("/ evil"), c_block_comment("*")
    (' / evil', '* ')
    """
    line = c_comment(text)
    line = f" {line}" if line.startswith("/") else line
    return f"{line} " if line.endswith("*") else line


def c_string(text: str) -> str:
    r"""What stands between the quotation marks of a string literal for this text, encoded as UTF-8.

    >>> c_string('say "hi"\n??/'), c_string("\x1b1")
    ('say \\"hi\\"\\n?\\?/', '\\0331')
    """
    return re.sub(r"\?(?=\?)|^(?=\?)", lambda found: f"{found[0]}\\", "".join(_string_letter(letter) for letter in text))


def _string_letter(letter: str) -> str:
    if letter in '"\\':
        return f"\\{letter}"
    if letter == "\n":
        return r"\n"
    if letter == "\t" or visible(letter) != letter:
        return "".join(f"\\{byte:03o}" for byte in letter.encode("utf-8", "surrogateescape" if _is_byte(letter) else "replace"))
    return letter


def _is_byte(letter: str) -> bool:
    """Whether a character stands for a byte that is not valid UTF-8."""
    return "\udc80" <= letter <= "\udcff"


def c_char(text: str) -> str:
    """As `c_string`, between single quotation marks."""
    return c_string(text).replace("'", r"\'")


def c_header(text: str) -> str:
    """A header's name between `<` and `>` or quotation marks, with `_` for what would end it.

    >>> c_header("Servo.h"), c_header('x.h>\\n#include "evil.h')
    ('Servo.h', 'x.h_ _include _evil.h')
    """
    return _SLASHES.sub("/", _ENDS_HEADER.sub("_", visible(one_line(text)))) if text else text


def c_word(text: str) -> str:
    """One word of code, an identifier or a number; of any other text its `identifier`, or `_` where nothing is left of it.

    >>> c_word("LEDWriteP1"), c_word("13"), c_word("x; int evil")
    ('LEDWriteP1', '13', 'xintevil')
    """
    return text if _WORD.fullmatch(text) else identifier(text) or "_"


def identifier(text: str, *, begins: bool = False) -> str:
    """An identifier of C and C++: the text without what none may hold, `_` before a leading digit; empty if nothing is left.

    It is no keyword (`_` is put behind one) and nothing that is reserved to compilers: no two `_` in a row, no `_` before a
    leading capital.

    Args:
        text: the text.
        begins: whether something is put behind it, so that the beginning itself may be a keyword.

    >>> identifier("Red (633nm)-LED1"), identifier("9V"), identifier("int"), identifier("__AVR__")
    ('Red633nmLED1', '_9V', 'int_', 'AVR_')
    """
    word = _UNDERSCORES.sub("_", _NOT_OF_WORDS.sub("", text))
    if word[:1] == "_" and word[1:2].isupper():
        word = word[1:]
    if word == "_":
        return ""
    if word in C_WORDS and not begins:
        return f"{word}_"
    return f"_{word}" if word[:1].isdigit() else word


def file_name(text: str) -> str:
    """The name of one file or folder on any system: no separator, no character that some system refuses; `_` if nothing is left.

    >>> file_name("line follower"), file_name("../../etc/passwd"), file_name("a\\nb"), file_name("nul.txt")
    ('line follower', '_.._etc_passwd', 'a b', '_nul.txt')
    """
    name = re.sub(r'[/\\:*?"<>|\x00-\x1f\x7f]', "_", visible(one_line(text)).replace("\\", "_"))
    name = re.sub(r"^[\s.~-]+(?=[^.]|$)|[\s.]+$", "", name)
    name = name.encode("utf-8", "replace")[:_LENGTH].decode("utf-8", "ignore").rstrip(" .")
    return f"_{name}" if not name or _DEVICES.match(name) else name
