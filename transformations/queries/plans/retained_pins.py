"""How the text of a program whose platform stays writes a pin of the other board.

What a number or name in the text already means there is not changed. A number can be that of a pin, of a channel of the
converter or of an interrupt; which one it is follows from the source board and from the port that it means.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from msgspec import Struct

from robosmi.metamodels import ccode, migration, platform
from robosmi.query import all_of_kind, ancestor_of_kind, root_of
from robosmi.transformations.knowledge.platforms.board_pins import BoardPins, board_pins
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.portability_facts import MoveFacts, portability_facts
from robosmi.transformations.queries.circuits.circuit import pin_literal

AS_WRITTEN = "port-as-written"
"""The rule of a place whose text means the bound pin on the target, too."""
OF_INTERRUPT = "interrupt-of-port"
"""The rule of the number of an interrupt that is replaced by the interrupt of a pin."""
PROPOSED = 0.5
"""The confidence of a pin that is proposed and that the user has to approve."""
UNWIRED = "unwired_pin"
"""The kind of places that give the number of a port without a pin to a core that does not check it."""
_ENUMERATOR = re.compile(r"\s*([A-Za-z_]\w*)\s*(?:=|\Z)")


def retains_platform(plan: object) -> bool:
    """Whether a plan moves a program to another board of its platform, so that the text stays as it is."""
    return (
        isinstance(plan, migration.MigrationPlan)
        and plan.source is not None
        and plan.target is not None
        and plan.source.name == plan.target.name
    )


class RetainedPins(Struct, frozen=True):
    """The pins of the two boards of a move.

    Attributes:
        source, target: the boards.
        alike: whether numbers of channels are counted alike on both.
        interrupt_of: the function that gives the interrupt of a pin.
        constants: constant of the platform that is a pin of the source board -> its number.
    """

    source: BoardPins
    target: BoardPins
    alike: bool
    interrupt_of: str
    constants: Mapping[str, int]

    def written(self, binding: migration.PortBinding, pin: platform.Pin, original: str) -> tuple[str, str]:
        """The rule and the text of a place.

        Args:
            binding: the port.
            pin: the pin that it is bound to.
            original: the text of the place; of an enumerator all of it.
        """
        literal, label, number = pin_literal(pin), str(pin.label), int(binding.sourcePin)
        word = original.strip()
        if word not in self.source.names and (enumerator := _ENUMERATOR.match(original)) is not None:
            same = self.target.labels.get(number) == label
            return (AS_WRITTEN, original) if same else ("port", f"{enumerator[1]} = {literal}")
        means, there = self.source.names.get(word), self.target.labels.get(self.target.names.get(word, -1))
        digits = int(word) if word.isdecimal() else -1
        if means != number and digits >= 0 and self.source.interrupts.get(digits) == number:
            there = self.target.labels.get(self.target.interrupts.get(digits, -1))
            return (AS_WRITTEN, original) if there == label else (OF_INTERRUPT, f"{self.interrupt_of}({literal})")
        if means != number and digits >= 0 and self.source.channels.get(digits) == number:
            there = self.target.labels.get(self.target.channels.get(digits, -1)) if self.alike else None
        return (AS_WRITTEN, original) if there == label else ("port", literal)


def proposed(plan: migration.MigrationPlan) -> list[migration.PortBinding]:
    """The ports whose pins are proposed."""
    by_rule = (b for b in plan.portBindings if b.chosenBy is migration.ChosenBy.rule and b.pin is not None)
    return [b for b in by_rule if b.connection is None and b.confidence == PROPOSED]


def retained_calls(plan: migration.MigrationPlan) -> int:
    """How many calls in the text run functions of the platform or of its libraries."""
    units = list(plan.program.units) if plan.program is not None else []
    calls = (call for unit in units for call in all_of_kind(unit, ccode.Call) if not call.viaMacro)
    return sum(call.callee is None or ancestor_of_kind(call.callee, ccode.SourceUnit) is None for call in calls)


def lost_pin_calls(plan: migration.MigrationPlan) -> set[tuple[str, int]] | None:
    """The places of calls that could not be read and whose function takes a pin; None for a plan of two platforms.

    In a program whose platform stays, the text of any other such call means the same as before.
    """
    if not retains_platform(plan) or plan.source is None or plan.program is None:
        return None
    taking = {function for function, _ in ApiIndex.load(str(plan.source.name)).functions_with_pins()}
    lost = ((unit, each) for unit in plan.program.units for each in unit.unresolved)
    return {(str(unit.path), int(each.line)) for unit, each in lost if each.name in taking}


def ignores_unwired(plan: migration.MigrationPlan) -> bool:
    """Whether calls do nothing that are given the number of a port without a pin.

    Adapters see to it. A program whose platform stays has none, so it depends on the target's core.
    """
    if not retains_platform(plan) or plan.source is None:
        return True
    return UNWIRED in move_facts(plan).same


def move_facts(plan: migration.MigrationPlan) -> MoveFacts:
    """What is different for a program whose platform stays on the board of a plan."""
    facts = portability_facts(str(plan.source.name)) if plan.source is not None else None
    chip = plan.board.microcontroller if plan.board is not None else None
    return facts.move_to(str(chip.name), str(chip.architecture)) if facts is not None and chip is not None else MoveFacts()


def whole_source_api(plan: migration.MigrationPlan) -> ApiIndex:
    """The API of the platform of a plan's source, on its board: all of it, and not what the plan stores of it."""
    assert plan.source is not None
    return ApiIndex.load(str(plan.source.name)).on_board(board_pins(plan.source.boardMappings))


def retained_pins(plan: object) -> RetainedPins | None:
    """The pins of the boards of a plan whose platform stays; None for any other plan."""
    if not isinstance(plan, migration.MigrationPlan) or not retains_platform(plan):
        return None
    assert plan.source is not None
    assert plan.target is not None
    source, target = board_pins(plan.source.boardMappings), board_pins(plan.target.boardMappings)
    if source is None or target is None:
        return None
    api = whole_source_api(plan)
    settings = api.settings.get("ports", {})
    boards = [next((m.board for m in each.boardMappings if m.board is not None), None) for each in (plan.source, plan.target)]
    kinds = [str(b.microcontroller.architecture) if b is not None and b.microcontroller is not None else "" for b in boards]
    return RetainedPins(source, target, kinds[0] == kinds[1], str(settings.get("interrupt_of", "")), api.pin_constants)


def retained_pins_of(binding: migration.PortBinding) -> RetainedPins | None:
    """The pins of the boards of a binding's plan, if its platform stays."""
    return retained_pins(root_of(binding))
