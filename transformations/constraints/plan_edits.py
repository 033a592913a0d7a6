"""Constraints that a stored plan must satisfy before anything is generated from it, since the user may have edited it.

`generate` refuses a plan that violates them; `check` evaluates them with all others (`plan`).
"""

from __future__ import annotations

from robosmi.diagnostics import Severity
from robosmi.errors import ModelError
from robosmi.metamodels import migration
from robosmi.model import EmfModel
from robosmi.query import root_of
from robosmi.transformations.constraints.plan_ports import named, plan_of
from robosmi.transformations.queries.plans.binding_edits import only_the_choice_was_edited, referred
from robosmi.transformations.queries.plans.port_pins import bound_pin
from robosmi.transformations.queries.text_changes import all_changes
from robosmi.validate import EVL, Fail

edits = EVL()
"""The constraints on an edited plan; evaluate them on its model."""

bindings = edits.context(migration.PortBinding)
dispositions = edits.context(migration.Disposition)
libraries = edits.context(migration.LibraryChoice)
plans = edits.context(migration.MigrationPlan)
uses = edits.context(migration.AdapterUse)


def refuse_nonsense(edited: migration.MigrationPlan) -> None:
    """Ensure that a plan that the user may have edited is consistent.

    Raises:
        ModelError: it contradicts itself.
    """
    faults = [f for f in edits.run(EmfModel(edited, name="plan")).findings() if f.severity is Severity.error]
    if faults:
        more = f"; and {len(faults) - 1} more: robosmi check lists them" if len(faults) > 1 else ""
        raise ModelError(f"{faults[0].message} [{faults[0].rule}]{more}", location=faults[0].location, fix=faults[0].fix)


@dispositions.constraint(id="RS701", advice="run migrate again")
def DecidesOnTheProgram(d: migration.Disposition) -> bool | Fail:
    """A decision about code refers to an element of the plan's program."""
    inside = d.element is not None and root_of(d.element) is plan_of(d).program
    return inside or Fail(f"a decision ({d.action.name}, {', '.join(d.rules)}) refers to nothing in the plan's program")


@bindings.constraint(
    id="RS703", guard=lambda b: bound_pin(b) is not None and plan_of(b).board is not None, advice="bind it to a pin of the board"
)
def PinIsOfTheBoard(b: migration.PortBinding) -> bool | Fail:
    """A port is bound to a pin of the plan's board."""
    pin, board = bound_pin(b), plan_of(b).board
    assert pin is not None
    assert board is not None
    return pin.board is board or Fail(
        f"the {named(b)} is bound to {pin.label}, which is not a pin of {board.title or board.name}"
    )


@bindings.constraint(id="RS716", advice="correct one of them in plan.xmi, or use --bind")
def ChoiceIsWhatItRefersTo(b: migration.PortBinding) -> bool | Fail:
    """The recorded choice of a port agrees with the binding's reference, unless the user edited the reference."""
    now = referred(b) or "nothing"
    return not only_the_choice_was_edited(b) or Fail(
        f"the choice of the {named(b)} is {b.choice}, but the plan binds it to {now}"
    )


@uses.constraint(id="RS717", guard=lambda u: u.adapter is not None, advice="give it the adapter of its function, or none")
def AdapterIsOfItsFunction(u: migration.AdapterUse) -> bool | Fail:
    """The adapter of a use is one for the used function."""
    adapter = u.adapter
    assert adapter is not None
    own = adapter.name == u.name or any(function is u.function for function in adapter.functions)
    return own or Fail(f"'{u.name}' has the adapter of '{adapter.name}'")


@uses.constraint(id="RS718", advice="keep one of them")
def FunctionIsAdaptedOnce(u: migration.AdapterUse) -> bool | Fail:
    """A function of the source platform has a single adapter use."""
    first = next(other for other in plan_of(u).adapterUses if other.name == u.name)
    return first is u or Fail(f"the plan has two adapter uses of '{u.name}'")


@bindings.constraint(id="RS719", guard=lambda b: b.sourcePin >= 0, advice="correct its number, or run migrate again")
def NumberIsAPort(b: migration.PortBinding) -> bool | Fail:
    """The number of a port is below the source platform's number of ports."""
    source = plan_of(b).source
    count = source.portCount if source is not None else 0
    return (
        not count or b.sourcePin < count or Fail(f"the {named(b)} has the number {b.sourcePin}; the source has 0 to {count - 1}")
    )


@plans.constraint(id="RS709", advice="correct the offsets, or run migrate again")
def ChangesAreInTheirUnits(p: migration.MigrationPlan) -> bool | Fail:
    """The byte range of each text change is inside its unit."""
    wrong = [
        f"a change of {unit.path} replaces bytes {c.startOffset} to {c.endOffset} of {unit.size}"
        for c in all_changes(p)
        if (unit := c.unit) is not None and not 0 <= c.startOffset <= c.endOffset <= unit.size
    ]
    return not wrong or Fail("; ".join(wrong))


@uses.constraint(
    id="RS728", guard=lambda u: u.adapter is not None and bool(u.adapter.pins),
    advice="restore the flow (portFlows), or run migrate again",
)  # fmt: skip
def CallsAreInAFlow(u: migration.AdapterUse) -> bool | Fail:
    """Each call of an adapter that takes pins belongs to a port flow, which says whether its numbers are ports or pins."""
    inside = {id(call) for flow in plan_of(u).portFlows for call in flow.calls}
    lines = sorted({int(call.line) for call in u.calls if id(call) not in inside})
    where = f"line{'s' * (len(lines) > 1)} {', '.join(str(each) for each in lines)}"
    return not lines or Fail(f"no flow of the plan has the call of '{u.name}' in {where}: nothing says what its numbers are")


@libraries.critique(
    id="RS729",
    guard=lambda c: bool(c.choice and c.chosen),
    advice="correct one of them in plan.xmi, or use --library",
)
def LibraryIsTheOneThatIsRecorded(c: migration.LibraryChoice) -> bool | Fail:
    """The recorded choice of a library agrees with the library that is referred to, if both are given."""
    assert c.chosen is not None
    now = str(c.chosen.name)
    return str(c.choice).lower() == now.lower() or Fail(
        f"the choice of the {named(c)} is {c.choice}, but the plan has {now}, which counts"
    )


@libraries.constraint(id="RS707", guard=lambda c: c.chosen is not None, advice="choose a library of the target platform")
def LibraryIsOfTheTarget(c: migration.LibraryChoice) -> bool | Fail:
    """A chosen library belongs to the plan's target platform."""
    target, chosen = plan_of(c).target, c.chosen
    assert chosen is not None
    return chosen.eContainer() is target or Fail(
        f"the {named(c)} is {chosen.name}, which is not a library of the target platform"
    )
