"""Predicts from a text's tokens, before anything is parsed, which names it uses without a declaration.

Each parse costs more than all that is done with its result. What libclang would complain about after a first parse is mostly
plain to see: a name that no declaration, macro or header of the text has. These names are declared for the first parse already
(`prelude`), and if that leaves no complaint it is the only parse. Only what is certain is predicted: where a text has
conditionals, or a name may be declared or not, libclang is asked first (`parsing`).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence

from msgspec import Struct

from robosmi.transformations.knowledge.lexer import (
    KEYWORDS,
    QUALIFIERS,
    STORAGE_WORDS,
    TYPE_WORDS,
    Token,
    definition_parts,
    directive_parts,
)
from robosmi.transformations.knowledge.lexer import tokens as tokenise

_OF_TYPES = TYPE_WORDS | QUALIFIERS | STORAGE_WORDS
_WORDS = KEYWORDS | _OF_TYPES
_TAGS = frozenset(["struct", "union", "enum"])
_RESERVED = re.compile(r"_[_A-Z]|(?:L|[uU]8?)$")
_STARTS = frozenset(["", ";", "{", "}", "(", ","]) | _OF_TYPES
_UNTOLD = frozenset(["__attribute__", "__attribute", "asm", "__asm__", "__asm", "_Pragma"])
"""Keywords whose operands contain words that are no names of C."""
_PLAIN_DIRECTIVES = frozenset(["include", "define", "pragma", "line", ""])


class Foreseen(Struct):
    """What the tokens of a text tell about its names.

    Attributes:
        undeclared: names that nothing declares, in text order.
        functions: names of functions that the text declares at file scope.
    """

    undeclared: list[str] = []
    functions: set[str] = set()


def foresee(tokens: Sequence[Token], known: Callable[[str], bool]) -> Foreseen | None:
    """The names that a text uses without a declaration.

    Args:
        tokens: tokens of the text.
        known: whether a name may be declared outside of the text.

    Returns:
        The names, or None where the tokens alone do not tell.
    """
    scan = _Scan()
    macros: dict[str, tuple[frozenset[str], list[tuple[str, str]]]] = {}
    plain: list[tuple[str, str]] = []
    for kind, _, _, text in tokens:
        if kind == "comment":
            continue
        if kind != "directive":
            plain.append((kind, text))
            continue
        word, rest = directive_parts(text)
        if word not in _PLAIN_DIRECTIVES:
            return None
        if word == "define":
            name, parameters, body = definition_parts(rest)
            if not name or "#" in body or name in macros:
                return None
            words = [(k, t) for k, _, _, t in tokenise(body.encode("latin-1", "replace")) if k != "comment"]
            macros[name] = frozenset(parameters or ()), words
    scan.read(plain)
    for apart, inner in _expanded(scan.seen, macros):
        scan.read([("punct", ";"), *inner, ("punct", ";")], apart)
    if scan.early or not _UNTOLD.isdisjoint(scan.seen):
        return None
    declared = scan.declared
    found = [
        name
        for name in scan.used
        if name not in declared and name not in macros and not _RESERVED.match(name) and not known(name)
    ]
    if not scan.sizes.isdisjoint(found):  # their numbers, which we make up, are in the types of arrays
        return None
    return Foreseen(found, scan.functions)


def _expanded(
    seen: set[str], macros: dict[str, tuple[frozenset[str], list[tuple[str, str]]]]
) -> Iterator[tuple[frozenset[str], list[tuple[str, str]]]]:
    """The parameters and body of each macro that is used in the text or in the body of another such macro."""
    pending = [name for name in macros if name in seen]
    done = set(pending)
    while pending:
        parameters, body = macros[pending.pop()]
        yield parameters, body
        further = {t for k, t in body if k == "name" and t in macros} - done
        done |= further
        pending += further


class _Scan:
    """Collects the names of a text and how they are used.

    Attributes:
        seen: all names.
        used: names where a declaration is required, in text order; calls in C require none.
        declared: names that are, or may be, declared somewhere.
        functions: names of functions at file scope.
        sizes: names within the brackets of a declared array.
        early: whether a function is used as a value before it is declared.
    """

    def __init__(self) -> None:
        self.seen: set[str] = set()
        self.used: dict[str, None] = {}
        self.declared: set[str] = set()
        self.functions: set[str] = set()
        self.sizes: set[str] = set()
        self.early = False

    def read(self, plain: list[tuple[str, str]], apart: frozenset[str] = frozenset()) -> None:
        """Read the tokens of a text or of a macro's body; `apart` are the macro's parameters, which do not count."""
        texts = [text for _, text in plain]
        texts += ["", ""]
        levels: list[tuple[str, bool]] = []  # what is open (a bracket, `enum`, or `size` of an array), and whether it declares
        opened, declares = "", False
        before = ""
        sized = -1  # the token that would open the size of an array
        for i, (kind, text) in enumerate(plain):
            if kind == "name":
                if text in _UNTOLD:
                    self.seen.add(text)
                elif text not in _WORDS and text not in apart:
                    self.seen.add(text)
                    if self._name(texts, i, before, opened, declares):
                        self.declared.add(text)
                        declares, sized = True, i + 1
                elif text in TYPE_WORDS:
                    sized = i + 1
            elif text == ";":
                declares = False
            elif text in ("(", "[", "{"):
                levels.append((opened, declares))
                if opened == "size" or (text == "[" and sized == i):
                    opened = "size"
                else:
                    opened = "enum" if text == "{" and "enum" in texts[max(0, i - 2) : i] else text
                declares = False
            elif text in (")", "]", "}") and levels:
                closed = opened
                opened, declares = levels.pop()
                if closed == "size" and opened != "size":
                    sized = i + 1
                elif text == "}" and not opened and texts[i + 1] not in (",", ";"):
                    declares = False  # a function's body
            before = text

    def _name(self, texts: list[str], i: int, before: str, opened: str, declares: bool) -> bool:
        """Record the use of a name; returns whether it is declared here, or may be."""
        text, following = texts[i], texts[i + 1]
        if before in (".", "->", "goto") or before in _TAGS:
            return False
        typed = before in TYPE_WORDS or _word(before)
        if before in QUALIFIERS or before in STORAGE_WORDS:
            typed = following != "*" and not _word(following)
        if following == "(":
            if not opened and not declares and (typed or before in ("*", "", ";", "}")):
                self.functions.add(text)
                self.early |= text in self.used and text not in self.declared
                self.declared.add(text)
            if text not in self.used:
                self.declared.add(text)  # the first call declares it
            return False
        if following == ":" and before in (";", "{", "}", ":"):
            self.declared.add(text)  # a label
            return False
        if typed or (before == "}" and following in (";", ",", "=", "[")):
            return True
        if before in ("{", ",") and opened == "enum":
            return True
        if before == "," and declares and not (_word(following) or (opened == "(" and following == "*")):
            return True
        if before == "*" and self._pointed(texts, i, declares):
            return True
        if opened == "size":
            self.sizes.add(text)
        self.used.setdefault(text)
        return False

    def _pointed(self, texts: list[str], i: int, declares: bool) -> bool:
        """Whether a name after `*` may be a declared pointer, and not a factor of a product."""
        j = i - 1
        while j >= 0 and (texts[j] == "*" or texts[j] in QUALIFIERS):
            j -= 1
        owner = texts[j] if j >= 0 else ""
        earlier = texts[j - 1] if j > 0 else ""
        if owner in TYPE_WORDS or owner in STORAGE_WORDS:
            return True
        if owner == "(":
            return earlier in _OF_TYPES or _word(earlier) or earlier == "*"
        if owner == ",":
            return declares
        if owner == "}" or earlier in _TAGS:
            return True
        return _word(owner) and earlier in _STARTS and owner not in self.declared


def _word(text: str) -> bool:
    return text not in _WORDS and (text[:1].isalpha() or text[:1] == "_")
