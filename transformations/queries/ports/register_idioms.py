"""Idioms of AVR registers that are for pins: pin change interrupts, and the converter with one channel.

Each is understood only if the whole program sets its registers to constants and uses them for nothing else. Source: ATmega328P
data sheet DS40002061, sections 13 and 24.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.query import all_contents, ancestor_of_kind
from robosmi.transformations.knowledge.platforms.avr_bits import avr_bits
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_text import expression_text
from robosmi.transformations.queries.flows.pin_uses import PinUse
from robosmi.transformations.queries.ports.bit_values import bits_of
from robosmi.transformations.queries.ports.port_statements import (
    INPUT,
    IS_CLEAR,
    IS_SET,
    PULL_UP,
    READ,
    WAIT_CLEAR,
    WAIT_SET,
    PinStep,
    PortStatement,
    is_statement,
    port_statements,
)  # fmt: skip
from robosmi.transformations.queries.ports.register_values import register_value
from robosmi.transformations.queries.ports.timer_outputs import timer_outputs

CHANGE, CONVERT = "change", "convert"
_IN = frozenset([CHANGE, CONVERT, INPUT, READ, PULL_UP, IS_SET, IS_CLEAR, WAIT_SET, WAIT_CLEAR])


def port_uses(views: Sequence[CodeView]) -> list[PinUse]:
    """The pins that statements with registers use."""
    return [
        PinUse(
            step.number, expression_text(each.element), "literal", each.register, "in" if step.what in _IN else "out",
            int(each.element.line), each.element,
        )
        for each in (*port_statements(views), *idiom_statements(views))
        for step in each.steps
    ]  # fmt: skip


class PinChangeIdiom(Struct, frozen=True):
    """A pin change interrupt whose registers are only set to constants.

    Attributes:
        view: the unit of its function.
        handler: its function.
        enables: the statements that enable it, each with its unit.
        masks: the statements that say which pins it is for.
    """

    view: CodeView
    handler: ccode.Function
    enables: tuple[tuple[CodeView, ccode.Assignment], ...]
    masks: tuple[PortStatement, ...]


def pin_changes(views: Sequence[CodeView]) -> list[PinChangeIdiom]:
    """The pin change interrupts of a program that are understood."""
    pins = views[0].api.board.ports if views and views[0].api.board is not None else {}
    handlers = [(view, f) for view in views for f in view.of_kind(ccode.Function) if f.name in avr_bits().pin_changes and f.body]
    enabled = _constants(views, _ENABLES)
    groups = {avr_bits().pin_changes[str(f.name)].enable for _, f in handlers}
    if enabled is None or any(set(bits_of(value)) - groups for _, _, value in enabled):
        return []
    found = []
    for view, handler in handlers:
        facts = avr_bits().pin_changes[str(handler.name)]
        masks = _constants(views, facts.mask)
        if not masks:
            continue
        statements = [
            PortStatement(
                seen, element,
                tuple(PinStep(bit, n, CHANGE) for bit in bits_of(value) if (n := pins.get(f"P{facts.port}{bit}")) is not None),
                facts.mask,
                change_handler(handler),
            )
            for seen, element, value in masks
        ]  # fmt: skip
        if all(each.steps for each in statements):
            own = tuple((seen, element) for seen, element, _ in enabled)
            found.append(PinChangeIdiom(view, handler, own, tuple(statements)))
    return found


def change_handler(handler: ccode.Function) -> str:
    """The name of the function that takes the place of an interrupt function for changes of pins."""
    return f"onPinChange{re.sub('[^0-9]', '', str(handler.name))}"


def _constants(views: Sequence[CodeView], register: str) -> list[tuple[CodeView, ccode.Assignment, int]] | None:
    """The statements that set a register, or bits of it, to constants; None if the program uses it in any other way."""
    found = []
    for view in views:
        for reference in view.of_kind(ccode.NameReference):
            if reference.name != register:
                continue
            outer = reference.eContainer()
            if not isinstance(outer, ccode.Assignment) or outer.left is not reference or outer.operator not in ("=", "|="):
                return None
            value = register_value(outer.right, view.values) if is_statement(outer) else None
            if value is None:
                return None
            found.append((view, outer, value))
    return found


class ConverterIdiom(Struct, frozen=True):
    """A program that reads one channel of the converter by its registers, with the supply as reference.

    Attributes:
        reads: where it reads results.
        rest: the statements that prepare a conversion or wait for it, each with its unit.
    """

    reads: tuple[PortStatement, ...]
    rest: tuple[tuple[CodeView, ccode.Located], ...]


def converter_reads(views: Sequence[CodeView]) -> ConverterIdiom | None:
    """The reads of a channel of the converter; None if the program uses the converter's registers in any other way."""
    facts, board = avr_bits().converter, views[0].api.board if views else None
    selects = _constants(views, facts.select)
    if not selects or board is None or any(value & facts.left for _, _, value in selects):
        return None
    channels = {value & facts.channel_mask for _, _, value in selects if value & facts.reference_mask == facts.supply}
    pin = board.channels.get(channels.pop(), -1) if len(channels) == 1 else -1
    if pin < 0 or any(value & facts.reference_mask != facts.supply for _, _, value in selects):
        return None
    rest: list[tuple[CodeView, ccode.Located]] = [(view, element) for view, element, _ in selects]
    reads = []
    for view in views:
        for reference in view.of_kind(ccode.NameReference):
            outer = reference.eContainer()
            if reference.name == facts.control:
                done = _prepares(reference, view)
                if done is None:
                    return None
                rest.append((view, done))
            elif reference.name in facts.results:
                if isinstance(outer, ccode.Assignment) and outer.left is reference:
                    return None
                reads.append(PortStatement(view, reference, (PinStep(0, pin, CONVERT),), str(reference.name)))
    return ConverterIdiom(tuple(reads), tuple(rest)) if reads else None


def _prepares(reference: ccode.NameReference, view: CodeView) -> ccode.Located | None:
    """The statement that sets the control register to a constant, or waits for one of its bits; None for any other."""
    outer = reference.eContainer()
    if isinstance(outer, ccode.Assignment) and outer.left is reference:
        return outer if is_statement(outer) and register_value(outer.right, view.values) is not None else None
    loop = ancestor_of_kind(reference, ccode.While)
    if loop is None or loop.condition is None or not any(each is reference for each in all_contents(loop.condition)):
        return None
    body = loop.body
    empty = isinstance(body, ccode.EmptyStatement) or (isinstance(body, ccode.Block) and not body.statements)
    return loop if empty else None


def idiom_statements(views: Sequence[CodeView]) -> list[PortStatement]:
    """The statements of the idioms that are for pins."""
    converted = converter_reads(views)
    changes = (mask for each in pin_changes(views) for mask in each.masks)
    timers = (each for timer in timer_outputs(views) for each in (*timer.writes, *([timer.attaches] if timer.attaches else [])))
    return [*changes, *(converted.reads if converted is not None else ()), *timers]


_ENABLES = "PCICR"
"""The register that enables pin change interrupts."""
