"""Looking for objects of a test's own in a process that holds millions of others."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def only_new_objects() -> Iterator[None]:
    """Context manager: `gc.collect` and `gc.get_objects` pass over the objects that exist when the block begins.

    In a process that has run thousands of tests, each call would otherwise take seconds. The objects stay frozen afterwards: to
    thaw them would thaw all tests, too (`tests/tiers.py`), and each full collection would look at them from then on.
    """
    gc.collect()  # what is garbage by now would stay for ever
    gc.freeze()
    yield
