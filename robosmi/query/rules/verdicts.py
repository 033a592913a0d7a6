"""What checks and guards may return: truth values, and not values that are true merely because they exist.

A text, a list or tuple that was just made, a function that was not called and a generator are true for every element, whatever
their author meant. Collections of a model and of EOL are allowed: whether they are empty depends on the model.
"""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from typing import TypeVar

from robosmi.errors import UsageError

T = TypeVar("T")


def verdict_of(answer: T, says: str, fix: str) -> T:
    """What a check or guard answered, if it is a verdict: a truth value, `Fail`, a number, an element, None, or a collection of a
    model or of EOL (whether it holds something).

    Args:
        answer: what the function gave.
        says: the meaning of the verdict, "whether the rule applies".
        fix: what to write instead.

    Raises:
        UsageError: it is a text, a plain Python collection, a function, a class, a generator or a coroutine.
    """
    if answer is True or answer is False or answer is None:
        return answer
    if isinstance(answer, (str, bytes)):
        given = f"the text {answer!r}"
    elif inspect.iscoroutine(answer):
        answer.close()  # or Python warns that nobody waits for it
        given = "a coroutine (it is an `async def`)"
    elif isinstance(answer, Iterator):
        given = "a generator or another iterator (it has a `yield`?)"
    elif answer.__class__ in (list, tuple, dict, set, frozenset):
        given = f"a plain {type(answer).__name__}"
    elif isinstance(answer, type) and not hasattr(answer, "eClass"):  # classes of a metamodel are its elements
        given = f"the class {answer.__name__!r}, which was not called"
    elif inspect.isroutine(answer):
        given = f"the function {answer.__name__!r}, which was not called"
    else:
        return answer
    raise UsageError(f"it gives {given}, which is no verdict on {says}", fix=fix)


def guarded(answer: object) -> bool:
    """The truth value of a guard's result.

    Raises:
        UsageError: the result is not a truth value, see `verdict_of`.
    """
    fix = 'write a comparison (`x.name != ""`, `len(x.books) > 0`), and call what is a method'
    return bool(verdict_of(answer, "whether the guard holds", fix))
