"""Compares the results of two runs, program by program: what is better, what is worse, what fails that did not.

A program is as good as its state, then whether it compiles and fits, its verdict, and how many calls still have no body; in this
order the first difference decides. All failures are alike; one that is skipped now, or was skipped, is worse, as nothing is known
of one of its results. Programs that only one run has are counted and not judged. A pair of runs of the tool in two versions over
one corpus is a regression check of the tool.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import msgspec
from msgspec import Struct

from robosmi.corpus.states import DONE, FAILURES
from robosmi.corpus.store import Store

_VERDICTS = ("not-compiled", "different", "not-decidable", "no-difference-found")
"""From the worst to the best."""
_SHOWN = 20


class OutcomeChange(Struct, frozen=True):
    """A difference between two results of one program.

    Attributes:
        program: its id.
        what: what differs: `state`, `compiles`, `fits`, `verdict`, `open_calls`, `errors` or `findings of RULE`.
        before, after: what it was and is.
        message: why it is not done now, if it is not.
    """

    program: str
    what: str
    before: str
    after: str
    message: str | None = None


class Comparison(Struct):
    """What two runs differ in.

    Attributes:
        better, worse: programs whose result changed, by their ids.
        new_failures: programs that were done and fail.
        same: programs with equal results, and those that fail in another way.
        only_before, only_after: programs that only one run has.
    """

    better: list[OutcomeChange] = []
    worse: list[OutcomeChange] = []
    new_failures: list[OutcomeChange] = []
    same: int = 0
    only_before: list[str] = []
    only_after: list[str] = []

    def to_json(self) -> Mapping[str, Any]:
        """The contract's result of `corpus compare`."""
        found: Mapping[str, Any] = msgspec.to_builtins(self)
        return found


class _Outcome(Struct):
    """The result of a program, as far as it is compared."""

    state: str
    message: str | None
    facts: dict[str, tuple[int | None, str]] = {}  # what -> how good it is (None: not known), and in words


def compare(before: Store, after: Store) -> Comparison:
    """Compare two runs.

    Args:
        before: the store of the earlier run.
        after: that of the later one.
    """
    old, new = _outcomes(before), _outcomes(after)
    found = Comparison(only_before=sorted(old.keys() - new.keys()), only_after=sorted(new.keys() - old.keys()))
    for program in sorted(old.keys() & new.keys()):
        was, now = old[program], new[program]
        if was.state != now.state:
            change = OutcomeChange(program, "state", was.state, now.state, now.message if now.state != DONE else None)
            if was.state == DONE and now.state in FAILURES:
                found.new_failures.append(change)
            elif now.state == DONE:
                found.better.append(change)
            elif was.state in FAILURES and now.state in FAILURES:
                found.same += 1
            else:
                found.worse.append(change)
            continue
        for what in (*was.facts, *(each for each in now.facts if each not in was.facts)):
            (good, said), (good_now, said_now) = was.facts.get(what, (None, "")), now.facts.get(what, (None, ""))
            if good is not None and good_now is not None and good != good_now:
                (found.better if good_now > good else found.worse).append(OutcomeChange(program, what, said, said_now))
                break
        else:
            found.same += 1
    return found


def _outcomes(store: Store) -> dict[str, _Outcome]:
    """The results of all programs that are listed."""
    found = {row[0]: _Outcome(row[1], row[2]) for row in store.query("SELECT id, state, message FROM programs WHERE listed").rows}
    for program, ok, fits in store.query("SELECT program, ok, fits FROM compiles").rows:
        if program in found:
            found[program].facts["compiles"] = (int(bool(ok)), "yes" if ok else "no")
            if fits is not None:
                found[program].facts["fits"] = (int(bool(fits)), "yes" if fits else "no")
    for program, verdict in store.query("SELECT program, verdict FROM verdicts").rows:
        if program in found:
            found[program].facts["verdict"] = (_VERDICTS.index(verdict) if verdict in _VERDICTS else None, str(verdict))
    counted = (
        ("open_calls", "SELECT program, call_sites - with_body FROM plans"),
        ("calls", "SELECT program, count(*) FROM calls GROUP BY program"),
        ("errors", "SELECT program, count(*) FROM findings WHERE severity = 'error' GROUP BY program"),
    )
    for what, sql in counted:
        for program, count in store.query(sql).rows:
            if program in found and found[program].state == DONE:
                sign = 1 if what == "calls" else -1
                found[program].facts[what] = (sign * int(count), str(count))
    for one in found.values():
        if one.state == DONE:
            one.facts.setdefault("calls", (0, "0"))
            one.facts.setdefault("errors", (0, "0"))
    return found


def comparison_lines(found: Comparison) -> list[str]:
    """The comparison as text for a terminal."""
    lines = [
        f"{len(found.better)} better, {len(found.worse)} worse, {len(found.new_failures)} newly failing, {found.same} the same"
    ]
    for title, changes in (("newly failing", found.new_failures), ("worse", found.worse), ("better", found.better)):
        for change in changes[:_SHOWN]:
            why = f" ({change.message})" if change.message else ""
            lines.append(f"  {title}: {change.program}: {change.what} {change.before} -> {change.after}{why}")
        if len(changes) > _SHOWN:
            lines.append(f"  ... and {len(changes) - _SHOWN} more {title}")
    for when, names in (("A", found.only_before), ("B", found.only_after)):
        if names:
            lines.append(f"  only in {when}: {len(names)} programs")
    return lines
