"""The states of a program of a corpus, as the column `state` of the table `programs` has them."""

from __future__ import annotations

DONE, FAILED, TIMEOUT, TOO_LARGE, SKIPPED = "done", "failed", "timeout", "too-large", "skipped"
STATES = (DONE, FAILED, TIMEOUT, TOO_LARGE, SKIPPED)
FAILURES = (FAILED, TIMEOUT, TOO_LARGE)
"""The states that make the exit code of a run 1."""
