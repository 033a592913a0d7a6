"""The values that templates show of adapters: pieces with bodies, and a placeholder for each platform function without one.

An adapter keeps the function's signature, so that the calls of the retained code stay as they are (adapter pattern, paper 3.4).
A placeholder contains a TODO; what is left to do is in the task list.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import Any

from msgspec import Struct

from robosmi.metamodels import ccode, migration, platform
from robosmi.query import all_contents, ancestor_of_kind
from robosmi.transformations.m2t.adapter_text import comment, declarations, includes, is_separated, shared
from robosmi.transformations.queries.adapter_signature import target_signature
from robosmi.transformations.queries.circuits.circuit import pin_literal
from robosmi.transformations.queries.plans.motors import servo_pins
from robosmi.transformations.queries.plans.plan import is_at_declaration, needs_own_types, target_of
from robosmi.transformations.queries.plans.plan_adapters import emitted
from robosmi.transformations.queries.plans.port_pins import UNBOUND, port_literals
from robosmi.transformations.queries.ports.split_wires import answering_pin, written_pin
from robosmi.transformations.queries.programs.main_function import main_of
from robosmi.transformations.queries.source_text import is_header


class Adapter(Struct, frozen=True):
    """A placeholder as templates show it.

    Attributes:
        use: the adapter's use in the plan.
        name: its name in the sketch.
        signature: the function's signature on the source.
        header: the header that declares the function, empty if unknown.
        notes: its comments.
        prefix: the specifiers before its signature.
        target_signature: its signature in the sketch.
        parameters: the names of its parameters.
        result: the expression that it returns, empty for void.
    """

    use: migration.AdapterUse
    name: str
    signature: str
    header: str
    notes: list[str]
    prefix: str
    target_signature: str
    parameters: list[str]
    result: str


def adapters(plan: migration.MigrationPlan, uses: Iterable[migration.AdapterUse]) -> list[Adapter]:
    """The placeholders for some uses, as templates show them."""
    prefix = "static inline " if target_of(plan).language == "C" else "inline " if several_units(plan) else ""
    return [_adapter(plan, use, prefix) for use in uses]


def _adapter(plan: migration.MigrationPlan, use: migration.AdapterUse, prefix: str) -> Adapter:
    header = ancestor_of_kind(use.function, platform.Header) if use.function else None
    return Adapter(
        use, use.targetName, use.signature, header.name if header else "", [*use.notes, *_pin_notes(plan, use)], prefix,
        target_signature(use), [p.name for p in use.parameters], use.result.emptyValue if use.result is not None else "",
    )  # fmt: skip


class PieceText(Struct, frozen=True):
    """A piece of adapter text as templates show it.

    Attributes:
        element: the piece.
        uses: the uses in the plan that it serves.
        apart: whether a blank line separates it from the piece above.
        comment: the lines of its comment.
        text: its text.
    """

    element: platform.Adapter
    uses: list[migration.AdapterUse | migration.SymbolUse]
    apart: bool
    comment: list[str]
    text: str


def adapter_pieces(plan: migration.MigrationPlan) -> dict[str, Any]:
    """The values that templates show of the adapters with bodies: `headers`, `declarations`, `pieces`."""
    pieces = emitted(plan)
    users: dict[platform.Adapter, list[migration.AdapterUse | migration.SymbolUse]] = {}
    named: list[migration.AdapterUse | migration.SymbolUse] = [*plan.symbolUses, *plan.adapterUses]
    for use in named:
        if use.adapter is not None:
            users.setdefault(use.adapter, []).append(use)
    in_c = target_of(plan).language == "C"
    pins, numbers = port_literals(plan, by_name=not in_c)  # in C the constants of connections need a macro of the adapters
    written = shared if several_units(plan) else str
    storage = "static " if in_c else ""
    changed = _changed_names(plan)
    return {
        "headers": includes(pieces),
        "declarations": [
            *_cores(plan),
            *_servos(plan, pieces),
            *_motors(plan, pieces),
            *_split_wires(plan, pieces),
            *declarations(pieces, pins, UNBOUND, numbers, storage),
        ],
        "pieces": [
            PieceText(piece, users.get(piece, []), is_separated(piece, above), comment(piece), written(_text(piece, changed)))
            for piece, above in zip(pieces, (None, *pieces), strict=False)
        ],
    }


def _changed_names(plan: migration.MigrationPlan) -> set[str]:
    """Names of the platform that the program assigns to."""
    units = plan.program.units if plan.program is not None else ()
    elements = [element for unit in units for element in all_contents(unit)]
    places = [each.left for each in elements if isinstance(each, ccode.Assignment)]
    places += [each.operand for each in elements if isinstance(each, ccode.Unary) and each.operator in _COUNTING]
    names = (place for place in places if isinstance(place, ccode.NameReference))
    return {str(name.name) for name in names if name.target is None or isinstance(name.target, ccode.ExternalSymbol)}


_COUNTING = frozenset(["++", "--"])


def _text(piece: platform.Adapter, changed: Collection[str]) -> str:
    """The text of a piece; a constant that stands for a variable of the platform becomes one if the program assigns to it."""
    text = str(piece.text)
    own = piece.name in changed and piece.pieceKind is platform.PieceKind.variable and piece.fidelity.startswith("exact")
    return f"static {text.removeprefix('const ')}" if own and text.startswith("const ") else text


def several_units(plan: migration.MigrationPlan) -> bool:
    """Whether several files of the program are compiled, each of which includes the adapters."""
    return plan.program is not None and sum(not is_header(unit) for unit in plan.program.units) > 1


def handles_interrupts(plan: migration.MigrationPlan, unit: ccode.SourceUnit) -> bool:
    """Whether a file is the one of several that compiles the interrupt handlers: the one with main, else the first."""
    if plan.program is None or not several_units(plan) or not any(piece.vectors for piece in emitted(plan)):
        return False
    units = [each for each in plan.program.units if not is_header(each)]
    return unit is next((each for each in units if main_of(each) is not None), units[0])


def _cores(plan: migration.MigrationPlan) -> list[str]:
    """Macros for the pieces that run code of other cores: how many coroutines at once, and the bytes of each stack."""
    said = plan.concurrency
    if said is None:
        return []
    about = "// Code of other cores runs in turns: so many beside main at once, each with a stack of so many bytes"
    return ["", about, f"#define COG_SLOTS {said.slots}", f"#define COG_STACK {said.stackBytes}"]


def _servos(plan: migration.MigrationPlan, pieces: Iterable[platform.Adapter]) -> list[str]:
    """Tables for the servo pieces of the pulse widths (us) that the user has measured."""
    trimmed = {c.pin: c for c in plan.connections if c.pin is not None and (c.neutralMicroseconds or c.speeds)}
    if not trimmed or not any(piece.name == SERVO_TRIMS for piece in pieces):
        return []
    lines = ["", "// Pulses of servos as robosmi.toml has them: at a stand, and by speed (speed and microseconds of each point)"]
    rows = []
    for number, (pin, connection) in enumerate(trimmed.items()):
        points = ", ".join(f"{each.speed}, {each.microseconds}" for each in connection.speeds)
        if points:
            lines.append(f"static const int16_t servo_speeds_{number}[] = {{{points}}};")
        count, table = len(connection.speeds), f"servo_speeds_{number}" if points else "0"
        rows.append(f"  {{{pin_literal(pin)}, {connection.neutralMicroseconds or 1500}, {count}, {table}}},")
    kinds = "uint8_t pin; int16_t neutral; uint8_t points; const int16_t *speeds;"
    return [*lines, "#define SERVO_TRIMS", f"static const struct {{ {kinds} }} servo_trims[] = {{", *rows, "};"]


SERVO_TRIMS = "servo_us"
"""The piece that gives servos the measured pulse widths."""


def _motors(plan: migration.MigrationPlan, pieces: Iterable[platform.Adapter]) -> list[str]:
    """A table for the pieces that drive motors: the pins of each complete channel, and the pin that stands for its servo."""
    if not any(piece.name == MOTORS for piece in pieces):
        return []
    rows = [
        f"  {{{', '.join(pin_literal(pin) if pin is not None else 'NO_PIN' for pin in pins)}}},"
        for pins in (servo_pins(channel, plan.portBindings) for channel in plan.motorChannels if not channel.missing)
    ]
    about = (
        "// Channels of motor drivers: the pin that stands for the servo, those for PWM (none: PWM at the directions), forward,"
    )
    kinds = "uint8_t port, enable, first, second, awake;"
    return [
        "", about, "// backward, and the pin that is high while the driver works", f"#define NO_PIN {UNBOUND}",
        f"static const struct MotorPins {{ {kinds} }} motor_pins[] = {{", *rows, "};",
    ]  # fmt: skip


MOTORS = "motors"
"""The piece that drives motors through the channels of motor drivers."""


def _split_wires(plan: migration.MigrationPlan, pieces: Iterable[platform.Adapter]) -> list[str]:
    """A table for the pieces that serve components with one wire per direction: the writing and the reading pin of each."""
    pairs = [
        (asked, heard)
        for b in plan.portBindings
        if (asked := written_pin(b, list(plan.connections))) and (heard := answering_pin(b))
    ]
    if not pairs or not any(piece.name == SPLIT_WIRES for piece in pieces):
        return []
    rows = [f"  {{{pin_literal(asked)}, {pin_literal(heard)}}}," for asked, heard in dict.fromkeys(pairs)]
    about = "// Components with a wire for each direction: the pin that asks, and the one that answers"
    kinds = "uint8_t asks, answers;"
    return ["", about, "#define SPLIT_WIRES", f"static const struct {{ {kinds} }} split_wires[] = {{", *rows, "};"]


SPLIT_WIRES = "asking"
"""The piece that looks up the two pins of a component with one wire per direction."""


def separate_placeholders(plan: migration.MigrationPlan) -> list[migration.AdapterUse]:
    """The placeholders that are emitted as functions of their own, not in place of the program's declaration."""
    return [use for use in plan.adapterUses if use.adapter is None and not is_at_declaration(use)]


def with_own_types(plan: migration.MigrationPlan) -> list[migration.AdapterUse]:
    """The placeholders whose signature needs types of the program, so that they must come after their declarations."""
    return [use for use in plan.adapterUses if needs_own_types(use)]


def _pin_notes(plan: migration.MigrationPlan, adapter: migration.AdapterUse) -> list[str]:
    """Notes on the target pins that a function uses by convention, which no argument shows."""
    conventions = list(adapter.function.conventions) if adapter.function is not None else []
    return [
        f"{binding.name} ({binding.what}) is {binding.choice or 'not bound'}"
        for binding in plan.portBindings
        if binding.convention is not None and any(c is binding.convention for c in conventions)
    ]
