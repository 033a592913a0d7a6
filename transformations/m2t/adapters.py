"""`adapters.h`: one adapter for each platform function that is called, one placeholder for each platform symbol (paper 3.4).

An adapter keeps the function's signature, so that the calls of the retained code stay as they are (adapter pattern).
Bodies are placeholders with a TODO; what is left is in the task list.
"""

from __future__ import annotations

from robosmi.generate.environment import render
from robosmi.generate.text import GeneratedFile
from robosmi.metamodels import migration, platform
from robosmi.query import ancestor_of_kind

FILE = "adapters.h"


def adapters_file(plan: migration.MigrationPlan) -> GeneratedFile:
    """The adapter file of a plan."""
    file = GeneratedFile(f"{plan.name}/{FILE}")
    assert plan.board is not None
    source = plan.source.name if plan.source else "the source platform"
    include = plan.target.mainHeader if plan.target else ""
    file.add(
        render("arduino/adapters_header.j2", source=source, board=plan.board.title, include=include), "generation", "adapter file", [plan]
    )
    for symbol in plan.symbolUses:
        meaning = symbol.symbol.meaning if symbol.symbol else ""
        file.add(
            render("arduino/placeholder.j2", meaning=meaning, declaration=symbol.placeholder), "code", "placeholder", [symbol, *symbol.uses]
        )
    prefix = "inline " if plan.program and len(plan.program.units) > 1 else ""
    for adapter in plan.adapterUses:
        returned, names = signature_parts(adapter)
        header = ancestor_of_kind(adapter.function, platform.Header) if adapter.function else None
        file.add(
            render(
                "arduino/adapter.j2", signature=adapter.signature, header=header.name if header else "", notes=list(adapter.notes),
                prefix=prefix, target_signature=adapter.targetSignature, parameters=names, result=_nothing(returned),
            ),
            "code", "adapter", [adapter, *adapter.calls],
        )  # fmt: skip
    return file


def _nothing(returned: str) -> str:
    """What a body without a result gives back; empty for void."""
    if returned == "void":
        return ""
    return "0" if "*" in returned or returned.removeprefix("const ").split()[0] in _ARITHMETIC else "{}"


_ARITHMETIC = {
    "bool", "char", "double", "float", "int", "long", "short", "signed", "size_t", "unsigned", "int8_t", "int16_t", "int32_t", "int64_t",
    "uint8_t", "uint16_t", "uint32_t", "uint64_t",
}  # fmt: skip


def signature_parts(adapter: migration.AdapterUse) -> tuple[str, list[str]]:
    """What an adapter returns, and the names of its parameters, read from its signature for the target."""
    head, _, rest = adapter.targetSignature.partition("(")
    returned = head.strip()[: -len(adapter.name)].strip()
    return returned, [name for name in map(_name, _split(rest.rpartition(")")[0])) if name]


def _split(parameters: str) -> list[str]:
    parts, depth = [""], 0
    for character in parameters:
        depth += (character in "([") - (character in ")]")
        if character == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return [p.strip() for p in parts if p.strip() not in ("", "...", "void")]


def _name(parameter: str) -> str:
    if "(*" in parameter:
        return parameter.partition("(*")[2].partition(")")[0].strip()
    words = parameter.partition("[")[0].replace("*", " ").split()
    return words[-1] if words else ""
