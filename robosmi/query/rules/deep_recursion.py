"""Calls that nest as deep as a model is long: a rule that asks for the equivalent of the next element, whose rule asks for its
next ...

Python's stack has 1,000 frames for each thread. `in_thread` continues in a thread with a stack of its own and waits for it, so
that every `LEVELS` levels of nesting one thread is added and no chain is too long. The order of evaluation is that of plain
calls.
"""

from __future__ import annotations

import contextvars
import threading
from typing import TYPE_CHECKING, Any

from robosmi.errors import UsageError

if TYPE_CHECKING:
    from robosmi.base.functions import Function


LEVELS = 80
"""Levels of nesting in one thread; a level is about six frames of ours and what the user's functions add."""
_STACK_BYTES = 2 << 20
_starting = threading.Lock()


def in_thread(function: Function, *arguments: Any) -> Any:
    """Call a function on a fresh stack, in a new thread, and return its result; its exceptions are raised here.

    Raises:
        UsageError: the system provides no more threads.
    """
    context = contextvars.copy_context()
    outcome: list[Any] = []
    errors: list[BaseException] = []

    def work() -> None:
        try:
            outcome.append(context.run(function, *arguments))
        except BaseException as error:
            errors.append(error)

    thread = threading.Thread(target=work, name="robosmi-nested", daemon=True)
    with _starting:  # the size of new stacks is a setting of the process
        before = threading.stack_size(_STACK_BYTES)
        try:
            thread.start()
        except RuntimeError as error:
            raise UsageError(
                f"rules ask for each other {threading.active_count() * LEVELS} levels deep, and the system gives no more threads",
                fix="set references in a rule that asks for targets only, or raise the limit of threads",
            ) from error
        finally:
            threading.stack_size(before)
    thread.join()
    if errors:
        raise errors[0]
    return outcome[0]
