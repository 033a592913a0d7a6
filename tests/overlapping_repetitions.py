r"""Finds regular expressions that may take more than linear time, since two of their repetitions can match the same text.

A pattern becomes an automaton whose states are the characters of the pattern. Some text can be split in ever more ways where
a word leads from a state p to p, from p to q and from q to q, with p and q not the same (Weber and Seidl, On the degree of
ambiguity of finite automata, 1991): `\s*x?\s*`, `(a*)*`. Where a search may begin anywhere, p may also be the text before it:
`\w+\(` looks at each part of a long word. What follows has to be able to fail; else there is nothing to go back for.

Left out: lookaheads and backreferences are taken to match always; a repetition with a limit counts as two.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import product
from re import _constants as sre, _parser as parser  # type: ignore[attr-defined]
from typing import Any

_ALPHABET = [chr(code) for code in range(128)] + ["\x85", "\xa0", "é", "²", "λ", "漢", "\u2028"]
"""Each ASCII character, and one of each class of the others that patterns tell apart."""
_NUMBER = {letter: number for number, letter in enumerate(_ALPHABET)}
_ALL = (1 << len(_ALPHABET)) - 1
_BEFORE = 0
"""The state of the text before a match."""
_ONE_CHARACTER = (sre.LITERAL, sre.NOT_LITERAL, sre.ANY, sre.IN)
_LARGE = 65
"""Repetitions with a limit beyond this count as unbounded."""

Letters = int
"""A set of characters of `_ALPHABET`, a bit for each."""


@dataclass
class _Part:
    """A part of a pattern: the states that it begins and ends with, and whether it matches the empty text.

    Attributes:
        first: states with the characters that may not be next for the part to begin there.
        last: states with the characters that may not be next for the part to end there.
        empty: what may not be next where it matches the empty text; None if it never does.
    """

    first: list[tuple[int, Letters]] = field(default_factory=list)
    last: list[tuple[int, Letters]] = field(default_factory=list)
    empty: Letters | None = 0


class Automaton:
    """The automaton of a pattern.

    Args:
        pattern: the pattern.
        anywhere: whether a match may begin anywhere in a text.
        whole: whether it has to end where the text does.
    """

    def __init__(self, pattern: re.Pattern[Any], *, anywhere: bool, whole: bool) -> None:
        text = pattern.pattern if isinstance(pattern.pattern, str) else pattern.pattern.decode("latin-1")
        self.flags = pattern.flags & ~re.DEBUG
        if isinstance(pattern.pattern, bytes):
            self.flags |= re.ASCII
        parsed = parser.parse(text, self.flags & ~re.UNICODE if self.flags & re.ASCII else self.flags)
        self.accepting: set[int] = set()
        made = self.build(parsed)
        if anywhere:
            self.next[_BEFORE].append((_BEFORE, 0))
        self.next[_BEFORE] += made.first
        if whole:  # only what takes any character reaches the end of any text
            self.accepting = {state for state in self.accepting if self.letters[state] == _ALL}

    def build(self, items: Any) -> _Part:
        """Make the states of a pattern's items."""
        self.letters: list[Letters] = [_ALL]
        self.next: list[list[tuple[int, Letters]]] = [[]]
        self.inner: list[Automaton] = []
        self.may_fail: set[int] = set()
        self.atomic: set[int] = set()
        made = self._sequence(items)
        self.accepting = {state for state, forbidden in made.last if not forbidden} - self.may_fail
        return made

    # ---- parts

    def _sequence(self, items: Iterable[Any]) -> _Part:
        made = _Part()
        for op, argument in items:
            made = self._joined(made, self._part(op, argument, made))
        return made

    def _joined(self, one: _Part, two: _Part) -> _Part:
        for (state, forbidden), (other, also) in product(one.last, two.first):
            self.next[state].append((other, forbidden | also))
        first = [*one.first]
        if one.empty is not None:
            first += [(state, forbidden | one.empty) for state, forbidden in two.first]
        last = [*two.last]
        if two.empty is not None:
            last += [(state, forbidden | two.empty) for state, forbidden in one.last]
        empty = None if one.empty is None or two.empty is None else one.empty | two.empty
        return _Part(first, last, empty)

    def _part(self, op: Any, argument: Any, before: _Part) -> _Part:
        if op in _ONE_CHARACTER:
            return self._state(self._set(op, argument))
        if op is sre.SUBPATTERN:
            _, added, removed, items = argument
            outside, self.flags = self.flags, (self.flags | added) & ~removed
            part = self._sequence(items)
            self.flags = outside
            return part
        if op is sre.ATOMIC_GROUP:
            return self._atomic(argument, argument)
        if op is sre.BRANCH:
            parts = [self._sequence(each) for each in argument[1]]
            empty = [part.empty for part in parts if part.empty is not None]
            return _Part(
                [x for part in parts for x in part.first],
                [x for part in parts for x in part.last],
                min(empty) if empty else None,
            )
        if op is sre.POSSESSIVE_REPEAT:
            return self._atomic([(sre.MAX_REPEAT, argument)], argument[2])
        if op in (sre.MAX_REPEAT, sre.MIN_REPEAT):
            return self._repeated(argument)
        if op in (sre.AT, sre.ASSERT, sre.ASSERT_NOT):
            # What it asks for may fail behind all that was matched before it.
            self.may_fail.update(state for state, _ in before.last)
            return _Part()
        if op in (sre.GROUPREF, sre.GROUPREF_EXISTS):
            return self._state(_ALL)
        raise NotImplementedError(op)

    def _atomic(self, items: Any, repeated: Any) -> _Part:
        """A part into which nobody goes back; what is ambiguous within it is looked for in an automaton of its own."""
        inner = Automaton.__new__(Automaton)
        inner.flags = self.flags
        inner.build(items)
        self.inner += [inner, *inner.inner]
        begin = len(self.letters)
        part = self._sequence(items)
        self.atomic.update(range(begin, len(self.letters)))
        if len(repeated) == 1 and repeated[0][0] in _ONE_CHARACTER:  # it takes all that it can
            forbidden = self.letters[-1]
            part.last = [(state, forbidden) for state, _ in part.last]
            part.empty = None if part.empty is None else part.empty | forbidden
        return part

    def _repeated(self, argument: tuple[int, int, Any]) -> _Part:
        least, most, items = argument
        unbounded = most is sre.MAXREPEAT or most > _LARGE
        required = min(least, 2)
        optional = 0 if unbounded and least else 1 if unbounded else min(most, 2) - required
        made = _Part()
        for number in range(required + optional):
            part = self._sequence(items)
            if unbounded and number == required + optional - 1:
                for (state, forbidden), (other, also) in product(part.last, part.first):
                    self.next[state].append((other, forbidden | also))
            if number >= required:
                part.empty = part.empty or 0
            made = self._joined(made, part)
        return made

    def _state(self, letters: Letters) -> _Part:
        self.letters.append(letters)
        self.next.append([])
        state = len(self.letters) - 1
        return _Part([(state, 0)], [(state, 0)], None)

    # ---- characters

    def _set(self, op: Any, argument: Any) -> Letters:
        """The characters that a part of one character matches, by the module `re` itself."""
        tree = parser.SubPattern(parser.State(), [(op, argument)])
        tree.state.flags = self.flags
        tree.state.str = ""
        compiled = _compiled(tree, self.flags)
        return sum(1 << number for number, letter in enumerate(_ALPHABET) if compiled.match(letter))

    # ---- what is ambiguous

    def ambiguous(self) -> Iterator[tuple[int, int, Letters]]:
        """Pairs of states that one text can go on in, with a character of it."""
        count = len(self.letters)
        edges: list[dict[int, list[Letters]]] = [{} for _ in range(count)]
        for state, following in enumerate(self.next):
            for other, forbidden in following:
                if letters := self.letters[other] & ~forbidden:
                    edges[state].setdefault(other, []).append(letters)
        merged = [{other: _union(each) for other, each in following.items()} for following in edges]
        reached = [_reached(state, merged) for state in range(count)]
        looping = [state for state in range(count) if state in reached[state] and state not in self.atomic]
        for p in looping:
            for q, all_letters in edges[p].items():
                if (
                    p in reached[q]
                    and q not in self.accepting
                    and any(one & two for n, one in enumerate(all_letters) for two in all_letters[:n])
                ):
                    yield p, q, all_letters[0]
        for p in looping:
            for q in looping:
                if p != q and q in reached[p] and q not in self.accepting:
                    inner_p = {s for s in reached[p] if p in reached[s]}
                    inner_q = {s for s in reached[q] if q in reached[s]}
                    between = {s for s in reached[p] if q in reached[s]} | {p, q}
                    if letters := self._common_word(p, q, merged, inner_p, between, inner_q):
                        yield p, q, letters

    def _common_word(
        self, p: int, q: int, edges: list[dict[int, Letters]], inner_p: set[int], between: set[int], inner_q: set[int]
    ) -> Letters:
        """Letters with which a word ends that leads from p to p, from p to q and from q to q; 0 if there is no such word."""
        todo, seen = [(p, p, q)], {(p, p, q)}
        while todo:
            one, two, three = todo.pop()
            for a, with_a in edges[one].items():
                if a not in inner_p:
                    continue
                for c, with_c in edges[three].items():
                    if c not in inner_q or not with_a & with_c:
                        continue
                    for b, with_b in edges[two].items():
                        if b not in between or not (common := with_a & with_b & with_c):
                            continue
                        if (a, b, c) == (p, q, q):
                            return common
                        if (a, b, c) not in seen:
                            seen.add((a, b, c))
                            todo.append((a, b, c))
        return 0


def overlaps(pattern: re.Pattern[Any], *, anywhere: bool = True, whole: bool = False) -> list[str]:
    """For each pair of overlapping repetitions the characters that both match; empty if the pattern takes linear time.

    Args:
        pattern: the pattern.
        anywhere: whether it is searched for, and not matched at one place only.
        whole: whether it has to match a text to its end.
    """
    automaton = Automaton(pattern, anywhere=anywhere, whole=whole)
    found = [_shown(p, letters) for each in (automaton, *automaton.inner) for p, _, letters in each.ambiguous()]
    return list(dict.fromkeys(found))


def _shown(p: int, letters: Letters) -> str:
    shown = "".join(letter for letter in _ALPHABET if letters >> _NUMBER[letter] & 1)
    return f"{'the text before' if p == _BEFORE else 'two repetitions'}: {shown[:12]!r}"


def _union(sets: Iterable[Letters]) -> Letters:
    result = 0
    for each in sets:
        result |= each
    return result


def _reached(state: int, edges: list[dict[int, Letters]]) -> set[int]:
    found: set[int] = set()
    todo = [state]
    while todo:
        for other in edges[todo.pop()]:
            if other not in found:
                found.add(other)
                todo.append(other)
    return found


def _compiled(tree: Any, flags: int) -> re.Pattern[str]:
    from re import _compiler  # type: ignore[attr-defined]

    code = _compiler._code(tree, flags)
    import _sre  # type: ignore[import-not-found]

    return _sre.compile("", flags, code, 0, {}, (None,))  # type: ignore[no-any-return]
