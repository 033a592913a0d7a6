"""Text to model: what one header of a C++ library declares for its users: classes, functions, constants, enumerations.

The text is read as it stands. No header that it includes is needed, no macro is expanded, comments and directives are dropped. Of
a condition all branches count; if one holds a piece of a declaration, only the first that is not empty. So an installed library
gives facts wherever it lies, of the same kind as the facts that ship. Bodies are skipped; what is not understood is skipped up to
the next declaration. Nothing here nests: open brackets and scopes are kept in lists.
"""

from __future__ import annotations

import re
from typing import Any

from msgspec import Struct
from msgspec.structs import asdict

from robosmi.transformations.knowledge.lexer import definition_parts, directive_parts, tokens
from robosmi.transformations.knowledge.platforms.api_spelling import joined, literal

_MOST_SCOPES = 64
_CLASSES = ("class", "struct", "union")
_ACCESS = ("public", "private", "protected")
_SPECIFIERS = frozenset(
    ["virtual", "static", "inline", "explicit", "constexpr", "extern", "friend", "__inline", "__inline__", "typename"]
)
_ATTRIBUTES = frozenset(["__attribute__", "__attribute", "alignas", "__declspec", "noexcept", "throw", "decltype", "_Alignas"])
_AFTER = frozenset(["const", "volatile", "override", "final", "noexcept", "throw", "try", "__attribute__", "requires", "mutable"])
_NO_NAMES = frozenset(["if", "for", "while", "switch", "return", "sizeof", "defined", "else", "do", "case", "new", "delete"])


class _Class(Struct):
    """A class: the parameters of each constructor, and name, parameters, type and perhaps `static` of each method."""

    name: str
    kind: str
    bases: list[str]
    constructors: list[str] = []
    methods: list[list[str]] = []


class _Scope(Struct):
    """An open `{`: a namespace or `extern "C"` block, or a class with its record."""

    name: str
    entry: _Class | None = None
    public: bool = True
    own: str = ""


class _Scan(Struct):
    """The declarations found so far, and the open scopes."""

    classes: list[_Class] = []
    functions: list[list[str]] = []
    constants: dict[str, str] = {}
    enums: dict[str, list[str]] = {}
    scopes: list[_Scope] = []

    def visible(self) -> bool:
        """Whether a declaration at this point is accessible from outside."""
        return all(scope.public for scope in self.scopes)

    def qualified(self, name: str) -> str:
        """A name with those of the scopes around it."""
        return "::".join([*(scope.name for scope in self.scopes if scope.name), name])


def declarations(data: bytes) -> dict[str, Any]:
    """What a header declares, in the form of a row of facts: `classes`, `functions`, `constants`, `enums`.

    Args:
        data: the header; any bytes will do.
    """
    scan = _Scan()
    parts = compiled(data, scan.constants)
    at = 0
    while at < len(parts):
        at = _statement(parts, at, scan)
    used = [c for c in scan.classes if c.kind == "class" or c.methods or c.constructors]
    return {"classes": [asdict(c) for c in used], "functions": scan.functions, "constants": scan.constants, "enums": scan.enums}


def _opened(parts: list[Part], opening: int, scope: _Scope, scan: _Scan) -> int:
    """Open a scope, or skip one that nests too deep; returns the index after its `{` or its `}`."""
    if len(scan.scopes) >= _MOST_SCOPES:
        return closing_of(parts, opening)
    scan.scopes.append(scope)
    return opening + 1


def _statement(parts: list[Part], at: int, scan: _Scan) -> int:
    """Read one declaration, or the opening or end of a scope; returns the index after it."""
    text = parts[at][1]
    following = parts[at + 1][1] if at + 1 < len(parts) else ""
    if text == "}":
        if scan.scopes:
            scan.scopes.pop()
        return at + 1
    if text == ";":
        return at + 1
    if text in _ACCESS and scan.scopes and scan.scopes[-1].entry is not None:
        end = at + 1 if following == ":" else at + 2  # Qt's `public slots:`
        if end < len(parts) and parts[end][1] == ":":
            scan.scopes[-1].public = text == "public"
            return end + 1
    if text == "template" and following == "<":
        return after_angles(parts, at + 1)
    if text == "[" and following == "[":
        return closing_of(parts, at)
    if text == "extern" and at + 2 < len(parts) and parts[at + 1][0] == "string" and parts[at + 2][1] == "{":
        return _opened(parts, at + 2, _Scope(""), scan)
    if text == "extern" and following.startswith('"'):
        return at + 2
    head = 1 if text == "inline" and following == "namespace" else 0
    if parts[at + head][1] == "namespace":
        return _namespace(parts, at + head + 1, scan)
    if text in ("using", "static_assert"):
        return after_statement(parts, at)
    if text == "friend":
        return after_variable(parts, at)
    if (marked := _marked(parts, at)) is not None:
        return marked
    first = at + 1 if text == "typedef" else at
    if first < len(parts) and parts[first][1] in (*_CLASSES, "enum"):
        opening = _opening(parts, first)
        if opening is not None:
            return (_enumeration if parts[first][1] == "enum" else _class)(parts, first, opening, scan)
    if text == "typedef":
        return after_statement(parts, at)
    return _declaration(parts, at, scan)


def _marked(parts: list[Part], at: int) -> int | None:
    """The index of `class`, `enum` and the like if a definition follows macros or `static const`; None otherwise."""
    place = at
    while place < len(parts) and parts[place][0] == "name" and parts[place][1] not in ("typedef", "enum", *_CLASSES):
        place += 1
    defines = at < place < len(parts) and parts[place][1] in (*_CLASSES, "enum") and _opening(parts, place) is not None
    return place if defines else None


def _namespace(parts: list[Part], at: int, scan: _Scan) -> int:
    start = at
    while at < len(parts) and parts[at][1] not in ("{", ";"):
        at += 1
    if at >= len(parts) or parts[at][1] == ";":
        return at + 1
    name = "".join(text for kind, text in parts[start:at] if kind == "name" or text == "::")
    return _opened(parts, at, _Scope(name), scan)


def _opening(parts: list[Part], at: int) -> int | None:
    """The index of the `{` of a class or enumeration; None if the words here do not define one."""
    while at < len(parts):
        text = parts[at][1]
        if text == "{":
            return at
        if text == "(" and parts[at - 1][1] not in _ATTRIBUTES:
            return None
        if text in (";", "=", ")", "}"):
            return None
        at = closing_of(parts, at) if text in ("(", "[") else after_angles(parts, at) if text == "<" else at + 1
    return None


def _class(parts: list[Part], at: int, opening: int, scan: _Scan) -> int:
    """Record a class and open its scope; returns the index after its `{`."""
    kind, name, place = parts[at][1], "", at + 1
    while place < opening and parts[place][1] != ":":
        text = parts[place][1]
        if text == "<":
            place = after_angles(parts, place)
            continue
        if text in ("(", "["):
            place = closing_of(parts, place)
            continue
        if parts[place][0] == "name" and text not in ("final", *_ATTRIBUTES):
            name = text
        place += 1
    bases: list[str] = []
    current: list[Part] = []
    depth = 0
    for part in parts[place + 1 : opening]:
        depth += (part[1] in ("<", "(")) - (part[1] in (">", ")")) - 2 * (part[1] == ">>")
        if part[1] == "," and depth == 0:
            bases.append(joined(current))
            current = []
        elif part[1] not in (*_ACCESS, "virtual"):
            current.append(part)
    bases += [joined(current)] if current else []
    shown = bool(name) and scan.visible() and len(scan.classes) < MOST_NAMES
    entry = _Class(scan.qualified(name), kind, bases)
    if shown and kind != "union":
        scan.classes.append(entry)
    return _opened(parts, opening, _Scope(name, entry, kind != "class", name), scan)


def _enumeration(parts: list[Part], at: int, opening: int, scan: _Scan) -> int:
    head = parts[at + 1 : opening]
    names = [text for kind, text in head if kind == "name" and text not in ("class", "struct", *_ATTRIBUTES)]
    colon = next((n for n, (_, text) in enumerate(head) if text == ":"), len(head))
    if colon < len(head):
        names = [text for kind, text in head[:colon] if kind == "name" and text not in ("class", "struct")]
    end = closing_of(parts, opening)
    behind = parts[end][1] if end < len(parts) and parts[end][0] == "name" and parts[at - 1][1] == "typedef" else ""
    if scan.visible() and len(scan.enums) < MOST_NAMES:
        name = names[-1] if names else behind
        listed = scan.enums.setdefault(scan.qualified(name) if name else "", [])
        place = opening + 1
        expected = True
        while place < end - 1:
            kind, text = parts[place]
            if text in OPEN:
                place = closing_of(parts, place)
                continue
            if expected and kind == "name" and len(listed) < MOST_NAMES:
                listed.append(text)
            expected = text == ","
            place += 1
    return after_statement(parts, end)


def _declaration(parts: list[Part], at: int, scan: _Scan) -> int:
    """Read the declaration of a function or a variable; returns the index after it."""
    place = at
    while place < len(parts):
        text = parts[place][1]
        if text == "operator":
            opening = place + 1
            while opening < len(parts) and (parts[opening][1] != "(" or opening == place + 1):
                if parts[opening][1] in (";", "{", "}"):
                    return after_statement(parts, at)
                opening += 1
            return _function(parts, at, place, opening, scan)
        if text == "(":
            if parts[place - 1][1] in _ATTRIBUTES or place == at:
                place = closing_of(parts, place)
                continue
            return _function(parts, at, place - 1, place, scan)
        if text in (";", "=", "{", "}", ":"):
            break
        place = closing_of(parts, place) if text == "[" else after_angles(parts, place) if text == "<" else place + 1
    return place + 1 if place < len(parts) and parts[place][1] == ":" else after_variable(parts, place)


def _function(parts: list[Part], at: int, named: int, opening: int, scan: _Scan) -> int:
    """Read what looks like a function, with those declared in the same declaration; returns the index after its body."""
    head = _without_attributes(parts[at:named])
    while True:
        closing = closing_of(parts, opening)
        behind, constant, trailing = _behind_parameters(parts, closing)
        if behind < 0:
            return closing  # a macro's call without a semicolon; the declaration comes behind it
        deleted = parts[behind : behind + 2] == [("punct", "="), ("name", "delete")]
        if not deleted and scan.visible() and _is_function(parts, named, opening, closing):
            returned = joined(trailing or (part for part in head if part[1] not in _SPECIFIERS))
            parameters = joined(parts[opening:closing]) + (" const" if constant else "")
            _note(scan, joined(parts[named:opening]), parameters, returned, ("name", "static") in head)
        if parts[behind : behind + 1] != [("punct", ",")]:
            return _behind_body(parts, behind)
        named = behind + 1  # `int first(), *second();`
        while named < len(parts) and parts[named][1] in ("*", "&", "const"):
            named += 1
        opening = named + 1
        if opening >= len(parts) or parts[opening][1] != "(":
            return after_statement(parts, behind)
        while head and head[-1][1] in ("*", "&"):
            head = head[:-1]
        head = [*head, *parts[behind + 1 : named]]


def _behind_parameters(parts: list[Part], at: int) -> tuple[int, bool, list[Part]]:
    """The index after a parameter list's suffixes, whether they contain `const`, and a type after `->`.

    The index is -1 if what follows belongs to another declaration.
    """
    constant = False
    while at < len(parts):
        kind, text = parts[at]
        if text in (";", "{", "}", ":", "=", ","):
            break
        if text == "->":
            start = at + 1
            while at < len(parts) and parts[at][1] not in (";", "{", "="):
                at += 1
            return at, constant, parts[start:at]
        constant = constant or text == "const"
        following = parts[at + 1][1] if at + 1 < len(parts) else ";"
        if kind == "name" and text not in _AFTER and following not in (";", "{", ":", "=", "const", "override"):
            return -1, False, []
        at = closing_of(parts, at) if text in ("(", "[") else at + 1
    return at, constant, []


def _is_function(parts: list[Part], named: int, opening: int, closing: int) -> bool:
    """Whether `name(` begins a parameter list, not the initialiser of a variable or a pointer to a function."""
    kind, text = parts[named]
    if kind != "name" or text in _NO_NAMES or (named and parts[named - 1][1] in ("::", "~", ".")):
        return False
    if parts[closing - 1][1] != ")" or ("punct", ";") in parts[opening:closing] or opening + 1 >= len(parts):
        return False  # the bracket is never closed, or never opened
    kind, inside = parts[opening + 1]
    return text == "operator" or (inside not in ("*", "&") and kind not in ("number", "string", "char"))


def _note(scan: _Scan, name: str, parameters: str, returned: str, static: bool) -> None:
    """Record a function in its class or among the free ones.

    A macro call is skipped: it has neither a return type nor the name of its class.
    """
    around = scan.scopes[-1] if scan.scopes else _Scope("")
    if around.entry is None:
        if returned and len(scan.functions) < MOST_NAMES:
            scan.functions.append([scan.qualified(name), parameters, returned])
        return
    if len(around.entry.methods) >= MOST_NAMES:
        return
    if name == around.own and not returned:
        around.entry.constructors.append(parameters)
    elif returned or name.startswith("operator"):
        around.entry.methods.append([name, parameters, returned, *(["static"] if static else [])])


def _without_attributes(head: list[Part]) -> list[Part]:
    kept: list[Part] = []
    place = 0
    while place < len(head):
        kind, text = head[place]
        if text in _ATTRIBUTES:
            place += 1
            if place < len(head) and head[place][1] == "(":
                place = closing_of(head, place)
        elif text == "[":
            place = closing_of(head, place)
        else:
            kept.append((kind, text))
            place += 1
    return kept


def _behind_body(parts: list[Part], at: int) -> int:
    """The index after a function, given the index after its parameters: after its `;`, or its initialisers and body."""
    if at >= len(parts) or parts[at][1] == "}":
        return at
    if parts[at][1] == "{":
        return closing_of(parts, at)
    if parts[at][1] != ":":
        return after_statement(parts, at)
    at += 1
    while at < len(parts) and parts[at][1] not in (";", "}"):
        if parts[at][1] == "{" and parts[at - 1][1] in (")", "}"):
            return closing_of(parts, at)
        at = closing_of(parts, at) if parts[at][1] in OPEN else at + 1
    return at


MOST_TOKENS, MOST_NAMES = 400_000, 4_000

# ---- tokens

Part = tuple[str, str]
"""Kind and text of a token."""

_MOST_CONDITIONS = 64  # within each other

OPEN, _CLOSE = {"(": ")", "[": "]", "{": "}"}, frozenset(")]}")


class _Condition(Struct):
    """An open `#if`: the tokens before it, its branches so far, and whether the current branch is never compiled."""

    around: list[Part]
    branches: list[list[Part]]
    never: bool


def compiled(data: bytes, constants: dict[str, str]) -> list[Part]:
    """The tokens without comments and directives; constants (name -> value, the last one counts) are noted on the way."""
    parts: list[Part] = []
    opened: list[_Condition] = []
    deeper = 0
    colon = -1  # where the last colon ends: two that touch are one sign
    for kind, start, end, text in tokens(re.sub(rb"\r(?!\n)", b"\n", data), MOST_TOKENS):
        if kind == "comment":
            continue
        if kind != "directive":
            if text == ":" and start == colon and parts and parts[-1][1] == ":":
                parts[-1] = ("punct", "::")
            else:
                parts.append((kind, text))
            colon = end if text == ":" else -1
            continue
        word, rest = directive_parts(text)
        if word == "define":
            if len(constants) < MOST_NAMES and not any(condition.never for condition in opened):
                _constant(rest, constants)
        elif word in ("if", "ifdef", "ifndef"):
            if len(opened) < _MOST_CONDITIONS:
                opened.append(_Condition(parts, [], rest == "0"))
                parts = []
            else:
                deeper += 1
        elif word == "endif" and deeper:
            deeper -= 1
        elif word in ("elif", "else", "elifdef", "elifndef", "endif") and opened and not deeper:
            condition = opened[-1]
            condition.branches += [] if condition.never else [parts]
            condition.never = False
            parts = []
            if word == "endif":
                opened.pop()
                parts = condition.around
                parts += _kept(condition.branches)
    for condition in reversed(opened):  # never closed
        parts = condition.around + _kept([*condition.branches, parts])
    return parts


def _constant(rest: str, constants: dict[str, str]) -> None:
    name, parameters, body = definition_parts(rest)
    if name and parameters is None and (value := literal(body)) is not None:
        constants[name] = value.encode("latin-1").decode("utf-8", "replace")


def _kept(branches: list[list[Part]]) -> list[Part]:
    """All branches of a condition if each consists of whole declarations, else the first non-empty one."""
    if all(_whole(branch) for branch in branches):
        return [part for branch in branches for part in branch]
    return next((branch for branch in branches if branch), [])


def _whole(branch: list[Part]) -> bool:
    depth = 0
    for kind, text in branch:
        if kind == "punct":
            depth += (text in OPEN) - (text in _CLOSE)
            if depth < 0:
                return False
    return depth == 0 and (not branch or branch[-1][1] in (";", "}", ":", ","))


def closing_of(parts: list[Part], at: int) -> int:
    """The index after the bracket that closes the one at this index; the end if it is never closed."""
    depth = 0
    for place in range(at, len(parts)):
        kind, text = parts[place]
        if kind == "punct":
            depth += (text in OPEN) - (text in _CLOSE)
            if depth <= 0:
                return place + 1
    return len(parts)


def after_angles(parts: list[Part], at: int) -> int:
    """The index after the `<...>` that begins here."""
    depth, place = 0, at
    while place < len(parts):
        text = parts[place][1]
        if text in OPEN:
            place = closing_of(parts, place)
            continue
        if text in (";", "}"):
            return place
        depth += (text == "<") - (text == ">") - 2 * (text == ">>")
        place += 1
        if depth <= 0:
            return place
    return place


def after_statement(parts: list[Part], at: int) -> int:
    """The index after the `;` of the statement that begins here, or of the `}` that closes its scope."""
    while at < len(parts):
        text = parts[at][1]
        if text == ";":
            return at + 1
        if text == "}":
            return at
        at = closing_of(parts, at) if text in OPEN else at + 1
    return at


def after_variable(parts: list[Part], at: int) -> int:
    """The index after a variable, or after a body without a head."""
    while at < len(parts):
        text = parts[at][1]
        if text == ";":
            return at + 1
        if text == "}":
            return at
        if text == "{":
            at = closing_of(parts, at)
            if at < len(parts) and parts[at][1] not in (";", ",", "=", "["):
                return at
            continue
        at = closing_of(parts, at) if text in OPEN else at + 1
    return at
