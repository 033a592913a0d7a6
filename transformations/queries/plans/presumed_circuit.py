"""The circuit that a plan without a drawing presumes: the target's board, and at its pins what the program uses.

Nothing but the program says what is there: a component bears the name of its port, or of the object whose constructor or methods
take the pins (`LiquidCrystal lcd(12, 11, 5, 4, 3, 2)` is one component), and below it what drives it. Where neither names a kind,
it is of the kind that these functions are usually used with. A port without a pin is a
component without a wire. Supplies are not known and not drawn. The circuit is for pictures only: it is no part of the plan, and
no check reads it.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.metamodels import ccode, hardware, migration, platform
from robosmi.query import all_contents
from robosmi.transformations.queries.circuits.drawn_symbols import UNKNOWN, symbol_of
from robosmi.transformations.queries.plans.port_pins import WITHOUT_PIN, bound_pin, source_name

PRESUMED = "the program"
"""The tool of such a circuit: no drawing tool made it."""
_FUNCTIONS = 3
_ROLES = {"read": hardware.Role.Input, "write": hardware.Role.Output}


def presumed_circuit(plan: migration.MigrationPlan) -> hardware.Circuit | None:
    """The circuit that a plan presumes; None where it has a drawing, or no board, or its program uses no port.

    Args:
        plan: the plan; it is not changed.
    """
    board = plan.board
    bindings = [binding for binding in plan.portBindings if binding.choice not in WITHOUT_PIN]
    if plan.circuit is not None or board is None or not bindings:
        return None
    drawn = _board(board)
    pins = {str(connector.pin): connector for connector in drawn.connectors}
    nets: dict[str, hardware.Net] = {}
    parts: dict[tuple[str, str], hardware.Component] = {}
    constructed = dict(_constructed(plan))
    for binding in bindings:
        owner = _owner(plan, binding, constructed)
        title, kind = owner or (str(binding.name), str(binding.what) or _functions(plan, binding))
        part = parts.get((title, kind))
        if part is None:
            number = str(len(parts) + 2)
            part = parts[title, kind] = hardware.Component(elementId=number, title=title, partTitle=kind, role=_role(binding))
        wire = hardware.Connector(
            connectorId=str(len(part.connectors) + 1), name=_wire_name(binding, owned=owner is not None),
            kind=hardware.ConnectorKind.signal,
        )  # fmt: skip
        part.connectors.append(wire)
        if symbol_of(part)[0] == UNKNOWN:
            part.family = str(binding.usualKind)
        if len(part.connectors) > 1:
            part.role = hardware.Role.Both
        if (pin := bound_pin(binding)) is not None and (label := str(pin.label)) in pins:
            net = nets.setdefault(label, hardware.Net(name=label, connectors=[pins[label]]))
            net.connectors.append(wire)
    return hardware.Circuit(name=str(plan.name), tool=PRESUMED, components=[drawn, *parts.values()], nets=[*nets.values()])


def _board(board: platform.Board) -> hardware.Component:
    connectors = [
        hardware.Connector(connectorId=pin.label, name=pin.label, kind=hardware.ConnectorKind.signal, pin=pin.label)
        for pin in board.pins
    ]
    return hardware.Component(
        elementId="1", title=board.title, partId=board.name, boardName=board.name, partTitle=board.title,
        role=hardware.Role.Board, connectors=connectors,
    )  # fmt: skip


def _role(binding: migration.PortBinding) -> hardware.Role:
    return _ROLES.get(str(binding.signal), hardware.Role.Both)


def _wire_name(binding: migration.PortBinding, owned: bool) -> str:
    """The port's name where the part does not bear it, else its number on the source board."""
    return str(binding.name) if owned else source_name(binding) or str(binding.signal)


def _calls(plan: migration.MigrationPlan, binding: migration.PortBinding) -> Iterator[ccode.Call]:
    """The calls of platform functions that take the port, its own first."""
    around = binding.element.eContainer() if binding.element is not None else None
    if isinstance(around, ccode.Call):
        yield around
    for flow in plan.portFlows:
        if binding in flow.bindings:
            yield from flow.calls


def _functions(plan: migration.MigrationPlan, binding: migration.PortBinding) -> str:
    """The first functions that take the port, else its name on the source board."""
    names = list(dict.fromkeys(str(call.calleeName) for call in _calls(plan, binding) if call.calleeName))
    more = ", ..." if len(names) > _FUNCTIONS else ""
    return ", ".join(names[:_FUNCTIONS]) + more or source_name(binding)


def _owner(
    plan: migration.MigrationPlan, binding: migration.PortBinding, constructed: dict[int, tuple[str, str]]
) -> tuple[str, str] | None:
    """Name and class of the object that takes the port, if one does."""
    if (made := constructed.get(id(binding.element))) is not None:
        return made
    for call in _calls(plan, binding):
        called = call.calleeExpression
        if isinstance(called, ccode.Member) and isinstance(called.object, ccode.NameReference):
            owner = called.object.target
            if isinstance(owner, ccode.Variable) and owner.valueType is not None:
                return str(owner.name), str(owner.valueType.spelling)
    return None


def _constructed(plan: migration.MigrationPlan) -> Iterator[tuple[int, tuple[str, str]]]:
    """For each literal or variable that a constructor takes: its id(), and the name and class of the object."""
    units = plan.program.units if plan.program is not None else ()
    for made in (each for unit in units for each in all_contents(unit) if isinstance(each, ccode.ConstructorCall)):
        around = made.eContainer()
        name = str(around.name) if isinstance(around, ccode.Variable) else str(made.className)
        for argument in made.arguments:
            taken = argument.target if isinstance(argument, ccode.NameReference) else argument
            yield id(taken), (name, str(made.className))
