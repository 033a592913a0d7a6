"""`adapters.h`: one adapter for each platform function that is called, one placeholder for each platform symbol (paper 3.4).

An adapter keeps the function's signature, so that the calls of the retained code stay as they are (adapter pattern).
Bodies are placeholders with a TODO; what is left is in the task list.
"""

from __future__ import annotations

from robosmi.generate.environment import render
from robosmi.generate.text import GeneratedFile
from robosmi.metamodels import migration, platform
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.plan import needs_own_types
from robosmi.transformations.queries.signature_text import OWN_PROTOTYPE, nothing, parameter_name, taken_apart
from robosmi.transformations.queries.source_text import is_header

FILE = "adapters.h"


def adapters_file(plan: migration.MigrationPlan) -> GeneratedFile:
    """The adapter file of a plan."""
    file = GeneratedFile(f"{plan.name}/{FILE}")
    assert plan.board is not None
    source = plan.source.name if plan.source else "the source platform"
    include = plan.target.mainHeader if plan.target else ""
    file.add(
        render("arduino/adapters_header.j2", source=source, board=plan.board.title, include=include),
        "generation",
        "adapter file",
        [plan],
    )
    for symbol in plan.symbolUses:
        meaning = symbol.symbol.meaning if symbol.symbol else ""
        todo = symbol.status is migration.AdapterStatus.todo
        text = render("arduino/placeholder.j2", meaning=meaning, declaration=symbol.placeholder, todo=todo)
        file.add(text, "code", "placeholder", [symbol, *symbol.uses])
    renamed: list[tuple[migration.AdapterUse, str]] = []
    for adapter in plan.adapterUses:
        if adapter.signatureSource == OWN_PROTOTYPE:
            continue  # its body stands where the program declares it
        if not needs_own_types(plan, adapter):
            file.add(adapter_text(plan, adapter), "code", "adapter", [adapter, *adapter.calls])
        _, name, _ = taken_apart(adapter.targetSignature)
        if name and name != adapter.name:
            renamed.append((adapter, name))
    for number, (adapter, name) in enumerate(renamed):
        text = render("arduino/renamed.j2", name=adapter.name, new=name)
        file.add(text if number else "\n" + text, "code", "adapter's name", [adapter])
    return file


def adapter_text(plan: migration.MigrationPlan, adapter: migration.AdapterUse) -> str:
    """An adapter with its comments."""
    several = plan.program is not None and sum(not is_header(u) for u in plan.program.units) > 1
    returned, _, parameters = taken_apart(adapter.targetSignature)
    header = ancestor_of_kind(adapter.function, platform.Header) if adapter.function else None
    return render(
        "arduino/adapter.j2",
        signature=adapter.signature,
        header=header.name if header else "",
        notes=[*adapter.notes, *_pin_notes(plan, adapter)],
        prefix="inline " if several else "",
        target_signature=adapter.targetSignature,
        result=nothing(returned),
        parameters=[n for n in map(parameter_name, parameters) if n],
    )


def _pin_notes(plan: migration.MigrationPlan, adapter: migration.AdapterUse) -> list[str]:
    """Which target pins the function's conventions mean, since no text of the program says so."""
    conventions = list(adapter.function.conventions) if adapter.function is not None else []
    return [
        f"{binding.name} ({binding.what}) is {binding.choice or 'not bound'}"
        for binding in plan.portBindings
        if binding.convention is not None and any(c is binding.convention for c in conventions)
    ]
