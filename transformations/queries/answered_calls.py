"""Calls of the platform's functions that do nothing as the plan stands, and what they give: no body yet, or no pin.

A body that is still to be written gives 0. At a pin that is none an adapter does nothing and reads 0; where its text leaves at
once and gives another number, that one. Where other things come first in the text, nothing is said of the call.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from robosmi.metamodels import ccode, migration, platform
from robosmi.typed import matches

_UNUSED = re.compile(r"\(void\)\s*\w+\s*;")
_BEGINNING = (
    r"\{\s*(?:\w+ \w+\(\w+\);\s*)?(?:\w+(?:\(\w+\))?\.(?:drive|set)\([^;]*\);\s*)*"
    r"(?:if \([^;]*\.wired\(\)[^;]*\) return(?: (?P<given>-?\d+)| [^;]+)?;|return \w+(?:\(\w+\))?\.\w+\(\);|(?P<end>\}))"
)
"""How a body begins that does nothing at a pin that is none: it leaves, or asks that pin only."""
_HANDED_ON = re.compile(r"\{\s*(?:return )?(?P<name>\w+)\([^;]*\);\s*\}")


def unwritten_calls(plan: migration.MigrationPlan) -> dict[int, int]:
    """Identities of the calls of functions without a body, and what they give: 0."""
    return {id(call): 0 for use in plan.adapterUses if use.adapter is None for call in use.calls}


def calls_at_no_pin(plan: migration.MigrationPlan) -> dict[int, int]:
    """Identities of the calls that do nothing since their pin is none, and what they give.

    Args:
        plan: the plan.
    """
    found: dict[int, int] = {}
    open_ = {id(call) for flow in plan.portFlows if _nowhere(flow) for call in flow.calls}
    wired = {id(call) for flow in plan.portFlows if not _nowhere(flow) for call in flow.calls}
    for use in plan.adapterUses:
        calls = [call for call in use.calls if id(call) in open_ - wired]
        given = _given_without_pin(use.adapter) if calls and use.adapter is not None else None
        if given is not None:
            found |= {id(call): given for call in calls}
    return found


def _nowhere(flow: migration.PortFlow) -> bool:
    """Whether all numbers of a flow stand for no pin of the target where they are."""
    return flow.choice == "target" and not flow.anything and bool(flow.bindings) and all(_no_pin(b) for b in flow.bindings)


def _no_pin(binding: migration.PortBinding) -> bool:
    return binding.pin is None and (binding.connection is None or binding.connection.pin is None)


def _given_without_pin(piece: platform.Adapter) -> int | None:
    """What a piece gives at a pin that is none, where it does nothing else."""
    name, text = re.escape(str(piece.targetName or piece.name)), str(piece.text)
    found = re.search(rf"\b{name}\([^{{;]*\)\s*{_BEGINNING}", text)
    if found is not None:
        return int(found["given"] or 0)
    handed = re.search(rf"\b{name}\([^{{;]*\)\s*{_HANDED_ON.pattern}", text)
    needed = next((each for each in piece.needs if handed is not None and each.name == handed["name"]), None)
    return _given_without_pin(needed) if needed is not None else None


def ignored_arguments(use: migration.AdapterUse, answers: Mapping[int, int]) -> Iterator[ccode.Expression]:
    """The arguments of which an adapter makes nothing: all of a call that does nothing, else those whose
    parameters it never names.

    Args:
        use: of the adapter.
        answers: the calls that do nothing.
    """
    names = None if use.adapter is None else _parameters(str(use.adapter.text), str(use.adapter.targetName or use.adapter.name))
    for call in use.calls:
        for number, argument in enumerate(call.arguments):
            if id(call) in answers or names is None or (number < len(names) and not names[number]):
                yield argument


def _parameters(text: str, name: str) -> list[bool]:
    """Whether the text of an adapter names each parameter that it has."""
    found = re.search(rf"\b{re.escape(name)}\((?P<parameters>[^{{;]*)\)[^{{;]*\{{(?P<body>.*)", text, re.DOTALL)
    if found is None:
        return []
    body = set(matches(r"\w+", _UNUSED.sub("", found["body"])))
    depth, parts = 0, [""]
    for character in found["parameters"]:
        depth += (character == "(") - (character == ")")
        if character == "," and not depth:
            parts.append("")
        else:
            parts[-1] += character
    return [bool(body & set(matches(r"\w+", part))) for part in parts]
