"""Calls of platform functions that have no effect in the current plan, and the value that each of them returns.

A placeholder, whose body is still to be written, returns 0. An adapter that is called for a port without a pin does nothing and
returns 0, or the number that its text returns early with. An adapter whose text does anything else first is left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from robosmi.metamodels import ccode, migration, platform

_UNUSED = re.compile(r"\(void\)\s*\w+\s*;")
_BEGINNING = (
    r"\{\s*(?:\w+ \w+\(\w+\);\s*)?(?:\w+(?:\(\w+\))?\.(?:drive|set)\([^;]*\);\s*)*"
    r"(?:if \([^;]*\.wired\(\)[^;]*\) return(?: (?P<given>-?\d+)| [^;]+)?;|return \w+(?:\(\w+\))?\.\w+\(\);|(?P<end>\}))"
)
"""How a body begins that does nothing when its port has no pin: it returns early, or only reads that pin."""
_CALLED = re.compile(r"\w+(?=\()")
_DEFINED = re.compile(r"\((?P<parameters>[^{;]*)\)[^{;]*\{(?P<body>.*)", re.DOTALL)
"""The rest of a function's definition behind its name."""
_HANDED_ON = re.compile(r"\{\s*(?:return )?(?P<name>\w+)\([^;]*\);\s*\}")


def unwritten_calls(plan: migration.MigrationPlan) -> dict[int, int]:
    """The `id` of each call of a function that has no body yet -> the value that it returns, 0."""
    return {id(call): 0 for use in plan.adapterUses if use.adapter is None for call in use.calls}


def calls_at_no_pin(plan: migration.MigrationPlan) -> dict[int, int]:
    """The `id` of each call that does nothing because its port has no pin -> the value that it returns."""
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
    """Whether no port of a flow has a pin of the target; False when the flow may carry other numbers too."""
    return flow.choice == "target" and not flow.anything and bool(flow.bindings) and all(_no_pin(b) for b in flow.bindings)


def _no_pin(binding: migration.PortBinding) -> bool:
    return binding.pin is None and (binding.connection is None or binding.connection.pin is None)


def _given_without_pin(piece: platform.Adapter) -> int | None:
    """What an adapter returns when its port has no pin, if it does nothing else then; None if it may do more."""
    name, text = re.escape(str(piece.targetName or piece.name)), str(piece.text)
    found = re.search(rf"\b{name}\([^{{;]*\)\s*{_BEGINNING}", text)
    if found is not None:
        return int(found["given"] or 0)
    handed = re.search(rf"\b{name}\([^{{;]*\)\s*{_HANDED_ON.pattern}", text)
    needed = next((each for each in piece.needs if handed is not None and each.name == handed["name"]), None)
    return _given_without_pin(needed) if needed is not None else None


def ignored_arguments(use: migration.AdapterUse, answers: Mapping[int, int]) -> Iterator[ccode.Expression]:
    """The arguments that an adapter ignores: all of a call without effect, else those whose parameter its text never names.

    Args:
        use: the use of the adapter.
        answers: the `id` of each call without effect -> what it returns.
    """
    names = None if use.adapter is None else _parameters(str(use.adapter.text), str(use.adapter.targetName or use.adapter.name))
    for call in use.calls:
        for number, argument in enumerate(call.arguments):
            if id(call) in answers or names is None or (number < len(names) and not names[number]):
                yield argument


def _parameters(text: str, name: str) -> list[bool]:
    """For each parameter of an adapter, whether its body names it; empty if the text does not define the function."""
    found = next(
        filter(None, (_DEFINED.match(text, word.end()) for word in _CALLED.finditer(text) if word.group() == name)), None
    )
    if found is None:
        return []
    body = set(re.findall(r"\w+", _UNUSED.sub("", found["body"])))
    depth, parts = 0, [""]
    for character in found["parameters"]:
        depth += (character == "(") - (character == ")")
        if character == "," and not depth:
            parts.append("")
        else:
            parts[-1] += character
    return [bool(body & set(re.findall(r"\w+", part))) for part in parts]
