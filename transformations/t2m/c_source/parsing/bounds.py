"""Removes from a text what libclang cannot take: deep nesting, macros that expand without bound, names declared again and again.

libclang crashes on deep nesting, and takes the process with it; its own limit on brackets does not count operators, casts,
branches and `else if`. So what nests too deep is found in the tokens, cut out of the copy that is parsed, and reported; the
rest of the file is read. Real programs are far below the limits. `error_recovery` applies the edits to the copy.

libclang compares each declaration of a name with all before it in the scope. C allows a name one definition, and a text with
hundreds was made by a tool; parsing it would take minutes. So those beyond `MOST_DECLARED` are cut out and reported in the same
way.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence

from msgspec import Struct

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import TooLargeError
from robosmi.model.elements.ordering import post_order
from robosmi.transformations.knowledge.lexer import KEYWORDS, Token, definition_parts, directive_parts, tokens as tokenise
from robosmi.transformations.knowledge.replacements import Replacement

MAX_BRACKETS = 180
"""Nesting of brackets; libclang gives up a file at 256."""
MAX_RUN = 2000
"""Tokens in a row without brackets or separators, each of which may nest by an operator, cast or branch.

libclang crashes at some 10,000 unary operators.
"""
MAX_BRANCHES = 1000
"""`else` branches in one `else if` chain."""
MAX_EXPANDED = 4_000_000
"""Tokens of a file after macro expansion."""
_BRACKET = MAX_RUN // MAX_BRACKETS
"""How many tokens a bracket in the body of a macro counts for, so that both limits are reached at once."""
MAX_GROWN = 60_000
"""Tokens that the large macro uses of one file may expand to; further ones are cut, since parsing them takes seconds."""
_LARGE_USE = 200
"""Tokens of an expansion above which a macro use is a large one; programs written by people have few of them."""
MOST_ELEMENTS = 1_000_000
"""Elements up to which the designators of a file reach (`[N] =`); libclang takes memory for each."""
LARGEST = inputs.SOURCE.most
"""Bytes of a source file or header; none of a microcontroller's program is that large."""
_OPEN, _CLOSE = frozenset("([{"), frozenset(")]}")
_BRACKETS = re.compile(rb"[()\[\]{}]")
_PREFIX = re.compile(rb"[;{}]")
_CONDITION = re.compile(rb"#[ \t]*(?:el)?if[^\n]{180}")
"""A condition so long that it may nest too deep; a shorter one goes on in the next line, and has a backslash."""
_UNARY = frozenset("!~+-")


def cuts(path: str, data: bytes, tokens: Sequence[Token]) -> list[Replacement]:
    """Edits that remove what nests too deep for libclang's stack; an empty list for programs written by people.

    Args:
        path: path of the file, for the error.
        data: its bytes.
        tokens: its tokens, comments and directives included.

    Raises:
        TooLargeError: its macros expand to more than `MAX_EXPANDED` tokens, or its initialisers have more than `MOST_ELEMENTS`.
    """
    if b"[" in data and b"{" in data and (far := _too_far(tokens)) is not None:
        line = data.count(b"\n", 0, far) + 1
        raise TooLargeError(
            f"its initialisers reach beyond {MOST_ELEMENTS:,} elements", location=Location(path, line),
            fix="give the array a size that fits into the board's memory, and fill it in a loop",
        )  # fmt: skip
    weights = _macro_weights(tokens) if data.count(b"#") and b"define" in data else {}
    harmless = (
        not weights
        and data.count(b"else") < MAX_BRANCHES
        and sum(data.count(bracket) for bracket in (b"(", b"[", b"{")) < MAX_BRACKETS
        and (len(tokens) < MAX_RUN or max(len(each) for each in _PREFIX.split(data)) < MAX_RUN)
    )
    conditions = [each for each in tokens if each[0] == "directive" and _nests(each[3], weights)]
    deep = [Replacement(start, end, f"#{directive_parts(text)[0]} 0") for _, start, end, text in conditions]
    if harmless and len(tokens) < MOST_DECLARED:
        return deep
    plain = [t for t in tokens if t[0] != "comment" and t[0] != "directive"]
    repeated = repeats(plain)
    if harmless:
        return [*deep, *repeated]
    scan = _Scan(plain, weights)
    scan.run()
    if scan.total > MAX_EXPANDED:
        raise TooLargeError(
            f"its macros expand to more than {MAX_EXPANDED:,} tokens",
            location=Location(path), fix="remove the macros that expand each other",
        )  # fmt: skip
    return [*scan.edits, *deep, *repeated]


def shallow(data: bytes) -> bool:
    """Whether the bytes alone show that nothing nests too deep."""
    depth = 0
    for bracket in _BRACKETS.findall(data) if sum(data.count(bracket) for bracket in (b"(", b"[", b"{")) >= MAX_BRACKETS else ():
        depth += 1 if bracket in b"([{" else -1
        if depth >= MAX_BRACKETS:
            return False
    if b"..." in data and b"[" in data:  # perhaps the range of a designator
        return False
    few = data.count(b"else") < MAX_BRANCHES and data.count(b"(") < MAX_RUN  # each `for (;;)` within another has one
    return few and _CONDITION.search(data) is None and max(len(each) for each in _PREFIX.split(data)) < 5 * MAX_RUN


def _nests(directive: str, weights: Mapping[str, Weight]) -> bool:
    """Whether the condition of a directive nests too deep, by brackets, unary operators, `?` or what its macros expand to."""
    if len(directive) < MAX_BRACKETS and not weights:
        return False
    word, condition = directive_parts(directive)
    if word not in ("if", "elif"):
        return False
    words = [text for kind, _, _, text in tokenise(condition.encode("utf-8", "replace")) if kind != "comment"]
    if words.count("?") >= MAX_BRACKETS or sum(weights[each].size for each in words if each in weights) >= MAX_RUN:
        return True
    depth = unary = 0
    for text in words:
        depth += (text == "(") - (text == ")")
        unary = unary + 1 if text in _UNARY else 0
        if depth + unary >= MAX_BRACKETS:
            return True
    return False


def _too_far(tokens: Sequence[Token]) -> int | None:
    """The offset of the designator with which the initialisers of a file have too many elements; None if they have not.

    A list has as many elements as its furthest designator says; a range makes what it is given for each of its elements.
    """
    words = [each for each in tokens if each[0] not in ("comment", "directive")]
    macros: dict[str, list[str]] | None = None
    lists, total, i, behind = [[1, 0]], 0, 0, -1  # (how often a list is made, its elements), and where a designator may go on
    made = 1
    while i < len(words):
        text, first = words[i][3], i > 0 and words[i - 1][3] in ("{", ",")
        if text == "{":
            lists.append([lists[-1][0] * made, 0])
        elif text == "}" and len(lists) > 1:
            total += lists.pop()[1]
        made = made if text in ("=", "{") or i == behind else 1
        i += 1
        if text == "." and (first or i - 1 == behind):
            behind = i + 1
        elif text == "[" and (first or i - 1 == behind):
            opening = i - 1
            while i < len(words) and words[i][3] not in ("]", ";", "{"):
                i += 1
            if macros is None:
                macros = _numbers(tokens)
            index = [each[3] for each in words[opening + 1 : i]]
            elements = made * lists[-1][0] * (max(0, _value(index, macros)) + 1)
            if first:
                lists[-1][1] = max(lists[-1][1], elements)
            else:
                total += elements
            made = made * (max(0, _value(index, macros)) + 1) if "..." in index else made
            i += 1
            behind = i
            if total + lists[-1][1] > MOST_ELEMENTS:
                return words[opening][1]
    return None


def _numbers(tokens: Sequence[Token]) -> dict[str, list[str]]:
    """The macros and the constants of enumerations of a file that stand for a short expression, with its tokens."""
    found = dict(_constants([text for kind, _, _, text in tokens if kind not in ("comment", "directive")]))
    for kind, _, _, text in tokens:
        if kind == "directive" and "define" in text and len(text) < 200:
            word, rest = directive_parts(text)
            name, parameters, body = definition_parts(rest) if word == "define" else ("", None, "")
            if name and parameters is None:
                found[name] = [each[3] for each in tokenise(body.encode("utf-8", "replace"))]
    return found


def _constants(words: Sequence[str]) -> Iterator[tuple[str, list[str]]]:
    """The constants of enumerations that have a value of their own, with its tokens."""
    inside = False
    for number, text in enumerate(words):
        if text == "enum":
            inside = True
        elif text in (";", "}"):
            inside = False
        elif text == "=" and inside:
            end = next((i for i, each in enumerate(words[number + 1 : number + 100]) if each in (",", "}", ";")), 0)
            yield words[number - 1], list(words[number + 1 : number + 1 + end])


def _value(words: Sequence[str], macros: Mapping[str, Sequence[str]]) -> int:
    """The value of an index, or the end of a range: sums, products and shifts of numbers; brackets count for nothing."""
    for _ in range(8):  # macros of macros
        if len(words) > 100 or not any(each in macros for each in words):
            break
        words = [word for each in words for word in macros.get(each, (each,))]
    words = words[len(words) - list(reversed(words)).index("...") if "..." in words else 0 :]
    total, term, operator = 0, 0, "+"
    for word in words[:100]:
        if word[0].isdigit():
            number = _literal(word)
            if operator == "*":
                term *= number
            elif operator == "<<":
                term <<= min(number, 64)
            elif operator in ("+", "|"):
                total, term = total + term, number
            term = min(term, 1 << 64)
        elif word not in ("(", ")"):
            operator = word
    return total + term


def _literal(word: str) -> int:
    plain = word.lower().rstrip("ul")
    try:
        return int(plain, 8 if plain[:1] == "0" and plain.isdigit() else 0) if len(plain) < 20 else 1 << 64
    except ValueError:
        return 0


def _is_list_of(tokens: Sequence[Token], number: int) -> bool:
    """Whether a round bracket opens the arguments or parameters of something, whose commas do not nest."""
    kind, _, _, before = tokens[number - 1] if number else ("punct", 0, 0, "")
    return (kind == "name" and before not in KEYWORDS) or before in (")", "]")


class _Scan:
    """One pass over the tokens that finds what to cut.

    A level is an open bracket; for each level the tokens since its last separator are counted.
    """

    def __init__(self, tokens: Sequence[Token], weights: dict[str, Weight]) -> None:
        self.tokens = tokens
        self.weights = weights
        self.edits: list[Replacement] = []
        self.total = self.grown = 0

    def run(self) -> None:
        """Fill `edits` and `total`."""
        tokens = self.tokens
        counts, starts, lists, factors, repeated, chains = [0], [0], [False], [1], [1], [0]
        depth_sum, i = 0, 0
        while i < len(tokens):
            kind, _, _, text = tokens[i]
            whole, peak, weight = factors[-1], 0, repeated[-1]
            if kind == "name" and (made := self.weights.get(text)) is not None:
                whole, peak, weight = whole * made.size, weight * made.peak, weight * made.tail
                self.grown += whole if whole > _LARGE_USE else 0
                peak = MAX_RUN + 1 if self.grown > MAX_GROWN and whole > _LARGE_USE else peak
            self.total = min(self.total + whole, MAX_EXPANDED * 10)
            if kind == "punct" and text in _OPEN:
                if len(counts) >= MAX_BRACKETS:
                    i = self._cut_brackets(i)
                    continue
                named = i > 0 and tokens[i - 1][0] == "name" and tokens[i - 1][3] in self.weights and text == "("
                before = tokens[i - 1][3] if i else ""
                inherits = text == "{" and (before in ("=", ",", "(", "return") or (before == "{" and lists[-1]))
                of_type = text == "{" and i > 0 and tokens[i - 1][0] == "name" and before not in ("else", "do")
                counts.append(0)
                starts.append(i + 1)
                lists.append(inherits or of_type if text == "{" else text == "(" and _is_list_of(tokens, i))
                factors.append(min(factors[-1] * self.weights[before].repeats, MAX_EXPANDED * 2) if named else factors[-1])
                repeated.append(min(repeated[-1] * self.weights[before].at_once, MAX_EXPANDED * 2) if named else repeated[-1])
                chains.append(0)
            elif kind == "punct" and text in _CLOSE and len(counts) > 1:
                depth_sum -= counts.pop()
                for stack in (starts, lists, factors, repeated, chains):
                    stack.pop()
                counts[-1] += 1
                depth_sum += 1
            if text == ";" or (text == "," and lists[-1]) or (text == "}" and not lists[-1]):
                following = tokens[i + 1][3] if i + 1 < len(tokens) else ""
                if following == "else":
                    chains[-1] += 1
                    if chains[-1] > MAX_BRANCHES:
                        i = self._cut_chain(i + 1)
                        continue
                else:
                    chains[-1] = 0
                depth_sum -= counts[-1]
                counts[-1], starts[-1] = 0, i + 1
            elif text not in _OPEN and text not in _CLOSE:
                counts[-1] += weight
                depth_sum += weight
                if max(depth_sum, depth_sum - weight + peak) > MAX_RUN:
                    level = max(range(len(counts)), key=counts.__getitem__)
                    i = self._cut_run(starts[level], i)
                    while len(counts) > level + 1:
                        depth_sum -= counts.pop()
                        for stack in (starts, lists, factors, repeated, chains):
                            stack.pop()
                    depth_sum -= counts[-1]
                    counts[-1], starts[-1] = 0, i
                    continue
            i += 1

    def _cut_brackets(self, number: int) -> int:
        """Cut the text between a bracket and its closing one; returns the index of the closing token."""
        close = self._closing(number)
        start = self.tokens[number][2]
        end = self.tokens[close][1] if close < len(self.tokens) else self.tokens[-1][2]
        if end > start:
            self.edits.append(Replacement(start, end, " " if self.tokens[number][3] == "{" else "0"))
        return close if close > number else number + 1

    def _cut_run(self, first: int, number: int) -> int:
        """Cut a run of tokens, or only the value that it assigns or returns; returns the index of the token after it."""
        tokens, depth, i = self.tokens, 0, first
        value: int | None = None
        while i < len(tokens):
            text = tokens[i][3]
            if text in _OPEN and (i < number or depth or text != "{"):
                depth += 1
            elif text in _CLOSE:
                depth -= 1
            elif depth == 0 and value is None and text in ("=", "return"):
                value = i + 1
            if depth < 0 or (depth == 0 and (text == ";" or (i > number and text in (",", "{")))):
                break
            i += 1
        start = tokens[value if value is not None and value < i else first][1]
        self.edits.append(Replacement(start, max(start, tokens[i - 1][2]), " 0" if value is not None else " "))
        return i

    def _cut_chain(self, number: int) -> int:
        """Cut the rest of an `else if` chain; returns the index of the token after it."""
        tokens, depth, i = self.tokens, 0, number
        while i < len(tokens):
            text = tokens[i][3]
            depth += (text in _OPEN) - (text in _CLOSE)
            if depth < 0:
                break
            ends = depth == 0 and text in (";", "}")
            i += 1
            if ends and not (i < len(tokens) and tokens[i][3] == "else"):
                break
        start = tokens[number][1]
        self.edits.append(Replacement(start, tokens[i - 1][2], " "))
        return i

    def _closing(self, number: int) -> int:
        depth = 0
        for i in range(number, len(self.tokens)):
            text = self.tokens[i][3]
            depth += (text in _OPEN) - (text in _CLOSE)
            if depth == 0:
                return i
        return len(self.tokens)


class Weight(Struct, frozen=True):
    """How a macro use weighs on the parser.

    Attributes:
        size: tokens of its expansion.
        repeats: how often the argument that it repeats most occurs in its expansion.
        peak: greatest nesting depth within the expansion, in tokens: the unfinished runs of all open levels together, with a
            bracket counted as `_BRACKET` tokens.
        tail: tokens of the unfinished run that the expansion ends with.
        at_once: how often arguments occur at most in what is unfinished at one place.
    """

    size: int
    repeats: int
    peak: int
    tail: int
    at_once: int


def _macro_weights(tokens: Sequence[Token]) -> dict[str, Weight]:
    """The weight of each macro whose use could grow by expansion; empty if no combination of macros can exceed the limits."""
    bodies: dict[str, tuple[list[str], list[str] | None]] = {}
    for kind, _, _, text in tokens:
        if kind == "directive" and "define" in text:
            word, rest = directive_parts(text)
            name, parameters, body = definition_parts(rest) if word == "define" else ("", None, "")
            if name:
                words = [t for k, _, _, t in tokenise(body.encode("utf-8", "replace")) if k not in ("comment", "directive")]
                if name not in bodies or len(words) > len(bodies[name][0]):
                    bodies[name] = (words, parameters)
    bound = 1.0
    for words, parameters in bodies.values():
        bound = min(bound * max(1, len(words)), 1e12)
        if any(words.count(parameter) > 1 for parameter in parameters or ()):
            bound = 1e12
    if bound < MAX_RUN / 2:
        return {}
    found: dict[str, Weight] = {}
    for name in _inner_first(bodies):
        words, parameters = bodies[name]
        found[name] = _weigh(words, parameters or (), found)
    return {name: weight for name, weight in found.items() if weight.size > 1 or weight.repeats > 1}


def _inner_first(bodies: dict[str, tuple[list[str], list[str] | None]]) -> Iterator[str]:
    """The macros, each after those that its body uses; cycles are cut anywhere, since C expands no macro within itself."""
    return post_order(bodies, lambda name: [word for word in reversed(bodies[name][0]) if word in bodies])


def _weigh(words: Sequence[str], parameters: Sequence[str], known: dict[str, Weight]) -> Weight:
    """The weight of a macro with this body, given the weights of the macros in it."""
    most = MAX_EXPANDED * 2
    size, uses = 0, dict.fromkeys(parameters, 0)
    factors = [1]
    for i, word in enumerate(words):
        if word in uses:
            uses[word] = min(uses[word] + factors[-1], most)
        if word == "(":
            before = words[i - 1] if i else ""
            factors.append(min(factors[-1] * max(1, known[before].repeats if before in known else 1), most))
        elif word == ")" and len(factors) > 1:
            factors.pop()
        size = min(size + factors[-1] * (known[word].size if word in known else 1), most)
    size, repeats = max(1, size), max([1, *uses.values()])
    return Weight(size, repeats, *_open_at_once(words, uses, known, size, repeats))


def _open_at_once(
    words: Sequence[str], parameters: Collection[str], known: dict[str, Weight], size: int, repeats: int
) -> tuple[int, int, int]:
    """The nesting of a macro's body as `Weight.peak`, `Weight.tail` and `Weight.at_once`.

    If the brackets of the body do not match, everything in it counts as nested.
    """
    most = MAX_EXPANDED * 2
    unmatched = (min(size * _BRACKET, most),) * 2 + (repeats,)
    levels, given, factors, brackets = [0], [0], [1], [""]
    peak, most_given = 1, 1
    for i, word in enumerate(words):
        if word in _OPEN:
            before = words[i - 1] if i else ""
            levels.append(_BRACKET)
            given.append(0)
            brackets.append(word)
            factors.append(min(factors[-1] * (known[before].at_once if word == "(" and before in known else 1), most))
            if len(levels) > MAX_BRACKETS:
                return unmatched
        elif word in _CLOSE:
            if len(levels) == 1:
                return unmatched
            for stack in (levels, factors, brackets):
                stack.pop()
            inner = given.pop()
            given[-1] += inner if word != "}" else 0
            levels[-1] += 1
        elif word == ";" and brackets[-1] != "(":
            levels[-1] = given[-1] = 0
        else:
            made = known.get(word)
            given[-1] += factors[-1] * (word in parameters)
            peak = max(peak, sum(levels) + factors[-1] * (made.peak if made is not None else 1))
            levels[-1] += factors[-1] * (made.tail if made is not None else 1)
        peak, most_given = max(peak, sum(levels)), max(most_given, sum(given))
    return (min(peak, most), min(max(1, levels[0]), most), min(most_given, repeats)) if len(levels) == 1 else unmatched


# ---- declarations of one name

MOST_DECLARED = 400
"""Declarations of one name in one scope, each alternative of `#if` and `#else` counted."""

_BEHIND = frozenset("=;,[(")
_NO_TYPE = frozenset(["return", "goto", "else", "case", "do", "sizeof", "typeof", "__typeof__", "__extension__", "default"])

_NO_NAME = frozenset(["__attribute__", "__attribute", "__declspec", "asm", "__asm", "__asm__", "_Alignas"])
"""Words that stand before parentheses within a declaration without being the declared name."""


def repeats(tokens: Sequence[Token]) -> list[Replacement]:
    """Edits that remove the declarations beyond the limit.

    Args:
        tokens: tokens of a file without comments and directives.
    """
    often = _often(tokens)
    return _cuts(tokens, often) if often else []


def _often(tokens: Sequence[Token]) -> set[str]:
    """The names that may be declared more often than the limit, judged over the whole file."""
    if len(tokens) < 3 * MOST_DECLARED:
        return set()
    names = Counter(text for kind, _, _, text in tokens if kind == "name")
    many = {name for name, count in names.items() if count > MOST_DECLARED}
    if not many:
        return set()
    declared = Counter(
        token[3]
        for before, token, behind in zip(tokens, tokens[1:], tokens[2:], strict=False)
        if token[3] in many and _declares(before, token, behind)
    )
    return {name for name, count in declared.items() if count > MOST_DECLARED}


def _declares(before: Token, token: Token, behind: Token) -> bool:
    of_type = (before[0] == "name" and before[3] not in _NO_TYPE) or before[3] == "*"
    return token[0] == "name" and token[3] not in _NO_NAME and of_type and behind[3] in _BEHIND


def _cuts(tokens: Sequence[Token], often: set[str]) -> list[Replacement]:
    scopes: list[Counter[str]] = [Counter()]
    edits: list[Replacement] = []
    first, round_, i = 0, 0, 0  # of the declaration, and round brackets that are open
    while i < len(tokens):
        text = tokens[i][3]
        if text == "{":
            scopes.append(Counter())
            first = i + 1
        elif text == "}":
            if len(scopes) > 1:
                scopes.pop()
            first, round_ = i + 1, 0
        elif text == ";" and not round_:
            first = i + 1
        elif text in "()":
            round_ = max(0, round_ + (1 if text == "(" else -1))
        elif text in often and not round_ and 0 < i < len(tokens) - 1 and _declares(tokens[i - 1], tokens[i], tokens[i + 1]):
            scopes[-1][text] += 1
            if scopes[-1][text] > MOST_DECLARED:
                i = _end(tokens, i)
                _take_out(edits, tokens[first][1], tokens[i][2], tokens[first - 1][2] if first else 0)
                first = i + 1
        i += 1
    return edits


def _end(tokens: Sequence[Token], number: int) -> int:
    """The index of a declaration's last token: its semicolon, or the brace that closes the body of a function."""
    depth = 0
    for i in range(number, len(tokens)):
        text = tokens[i][3]
        depth += (text in ("(", "[", "{")) - (text in (")", "]", "}"))
        if depth < 0:
            return i - 1
        if depth == 0 and (text == ";" or (text == "}" and (i + 1 == len(tokens) or tokens[i + 1][3] not in (",", ";")))):
            return i
    return len(tokens) - 1


def _take_out(edits: list[Replacement], start: int, end: int, behind: int) -> None:
    """Add a cut, merged with the previous one if it directly follows it, so that both are reported as one."""
    if edits and edits[-1].end == behind:
        start = edits.pop().start
    edits.append(Replacement(start, end, " "))
