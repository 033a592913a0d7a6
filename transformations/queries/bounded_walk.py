"""Memoised evaluation of names that may be defined by each other, with bounds on recursion and on repetition.

What a name stands for is computed in `values`; this module decides only in which order names are evaluated and when one is
given up as unknown.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

A = TypeVar("A")
B = TypeVar("B")
Question = Callable[[], A]

DEEPEST = 60
"""Depth of nested names; a longer chain is restarted from its deepest name, so that Python's own stack suffices."""
MOST_REPEATS = 1000
"""How often one question may evaluate names again that depend on themselves and whose answer is therefore not kept."""


class _TooDeep(Exception, Generic[A]):
    def __init__(self, key: Hashable, again: Question[A]) -> None:
        super().__init__()
        self.key = key
        self.again = again


class _TooOften(Exception):
    pass


class BoundedWalk(Generic[A]):
    """Evaluates names recursively; a name that is asked for while it is being evaluated is unknown.

    The answer for a name that depends on itself therefore depends on the path by which it was reached. Only such names are
    evaluated more than once; where there are too many paths through them, they are unknown altogether.

    Args:
        unknown: the answer for what is given up.
    """

    def __init__(self, unknown: A) -> None:
        self._unknown = unknown
        self._known: dict[Hashable, A] = {}
        self._active: dict[Hashable, int] = {}
        self._lowest = 0
        self._begin()

    def _begin(self) -> None:
        self._asked: set[Hashable] = set()
        self._looped: set[Hashable] = set()
        self._repeats = 0

    def ask(self, question: Question[B]) -> B:
        """Answer a question that evaluates names by calling `name`; questions may be nested.

        Args:
            question: computes the answer; it may be called more than once.
        """
        if self._active:
            return question()
        first: list[_TooDeep[A]] = []
        while True:
            self._begin()
            try:
                if not first:
                    return question()
                self._known[first[-1].key] = first[-1].again()
                first.pop()
            except _TooDeep as deep:
                if any(deep.key == other.key for other in first):
                    self._known[deep.key] = self._unknown
                else:
                    first.append(deep)
            except _TooOften:
                self._known |= dict.fromkeys(self._looped, self._unknown)

    def name(self, guard: Hashable, key: Hashable, answer: Question[A]) -> A:
        """The answer for a name, from memory if it was found before.

        Args:
            guard: identifies the evaluation: asked for again while it is active, it is answered with unknown.
            key: identifies the answer in memory; questions with one key have the same answer.
            answer: computes it.
        """
        if guard in self._active:
            self._looped.add(key)
            self._lowest = min(self._lowest, self._active[guard])
            return self._unknown
        if key in self._known:
            return self._known[key]
        depth = len(self._active)
        if depth >= DEEPEST:
            raise _TooDeep(key, lambda: self.name(guard, key, answer))
        self._repeats += key in self._asked
        self._asked.add(key)
        if self._repeats > MOST_REPEATS:
            raise _TooOften
        around, self._lowest = self._lowest, depth + 1
        self._active[guard] = depth
        try:
            found = answer()
        finally:
            del self._active[guard]
            own, self._lowest = self._lowest, min(around, self._lowest)
        if own > depth:
            self._known[key] = found  # it does not depend on itself, so that each way to it gives the same
        return found
