"""What a plan's program needs of its board before it is compiled: pins, timers, and the time that each pass of its loop waits.

All is read off the models: the plan's bindings, the board with its microcontroller, the adapter pieces and the libraries of the
program. What the board cannot give is listed separately, so that a report can begin with it.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from msgspec import Struct

from robosmi.base.quantities import quantity
from robosmi.metamodels import migration, platform
from robosmi.transformations.knowledge.board_models import load_board, mapped_boards
from robosmi.transformations.queries.plans.motors import pins_for_motors
from robosmi.transformations.queries.plans.plan import platform_of
from robosmi.transformations.queries.plans.plan_adapters import closure, emitted
from robosmi.transformations.queries.plans.port_pins import bound_pin
from robosmi.transformations.queries.ports.idle_ports import is_idle
from robosmi.transformations.queries.ports.split_wires import answering_pin
from robosmi.transformations.queries.resources.loop_time import Time, loop_time
from robosmi.transformations.queries.resources.memory import Memory, memory

_MILLION = 1e6


class PinNeeds(Struct, frozen=True):
    """How many pins a program needs.

    Attributes:
        of_board: pins that the board has.
        used: pins that ports of the program are bound to.
        drawn: pins that something is wired to and no port is bound to.
        wanted: open ports, each of which may need one.
    """

    of_board: int
    used: int
    drawn: int
    wanted: int

    @property
    def missing(self) -> int:
        """How many pins there are too few when each open port needs one, be it a drawn pin that no port uses."""
        return max(0, self.used + self.wanted - self.of_board) if self.of_board else 0


class TimerNeeds(Struct, frozen=True):
    """Who takes a timer: pieces of adapters, by the functions that need them, and libraries."""

    timer: str
    takers: tuple[str, ...]

    @property
    def contested(self) -> bool:
        """Whether more than one takes it."""
        return len(self.takers) > 1


class BoardNeeds(NamedTuple):
    """What a program needs of its board.

    Attributes:
        pins: of pins.
        timers: of each timer that anything takes, by name.
        loop: how long each pass of its loop waits; None for a program that runs once.
        memory: what is estimated of its data memory.
        build: what the compiled program takes; None before it is compiled.
        roomier: title of a board of the platform that has the memory which this one lacks; empty where none is wanted or known.
    """

    pins: PinNeeds
    timers: tuple[TimerNeeds, ...]
    loop: Time | None
    memory: Memory
    build: migration.Build | None = None
    roomier: str = ""

    @property
    def stack(self) -> int:
        """Bytes of stack: the upper bound read off the compiled program if there is one, else the estimate from the models."""
        return int(self.build.stackBytes) if self.build is not None and self.build.stackBytes else self.memory.depth

    def to_json(self) -> dict[str, Any]:
        """The contract's form."""
        return {
            "pins": {
                "of_board": self.pins.of_board, "used": self.pins.used, "drawn": self.pins.drawn,
                "wanted": self.pins.wanted, "missing": self.pins.missing,
            },
            "timers": [{"timer": t.timer, "takers": list(t.takers)} for t in self.timers],
            "stacks": {"bytes": self.memory.stacks, "ram_bytes": self.memory.limit},
            "memory": self.memory.to_json(),
            "compiled": None if self.build is None else {
                "board": self.build.board, "flash_bytes": self.build.flashBytes, "flash_limit": self.build.flashLimit,
                "ram_bytes": self.build.ramBytes, "ram_limit": self.build.ramLimit,
                "stack_bytes": self.build.stackBytes or None,
            },
            "loop": None if self.loop is None else {
                "waits_low_ms": round(self.loop.low / 1000, 3), "waits_high_ms": round(self.loop.high / 1000, 3),
                "unbounded": [{"what": w.what, "line": w.line} for w in self.loop.unbounded],
            },
        }  # fmt: skip


def board_needs(plan: migration.MigrationPlan) -> BoardNeeds:
    """What a plan's program needs of its board.

    Args:
        plan: the plan; what is not compiled yet counts as what the models say.
    """
    needs = BoardNeeds(_pins(plan), tuple(_timers(plan)), loop_time(plan), memory(plan), plan.build)
    return needs._replace(roomier=_roomier(plan, needs)) if _lacking(needs) else needs


def _roomier(plan: migration.MigrationPlan, needs: BoardNeeds) -> str:
    """The title of the board with the least memory that should have enough; empty where none has.

    It is one of the platform with a processor of the same architecture: others take the program only by another migration.

    The stack counts twice: of 234 compiled programs five needed more than twice what the models say, 90 bytes at most.
    """
    flash = needs.build.flashBytes if needs.build is not None else 0
    ram = (needs.build.ramBytes if needs.build is not None else needs.memory.total) + 2 * needs.stack
    boards = (load_board(name) for name in mapped_boards(str(platform_of(plan).name)))
    own = plan.board.microcontroller.architecture if plan.board is not None and plan.board.microcontroller is not None else ""
    alike = [b for b in boards if (chip := b.microcontroller) is not None and chip.architecture == own]
    enough = [b for b in alike if (chip := b.microcontroller) is not None and chip.ramBytes >= ram and chip.flashBytes > flash]
    return min(((int(b.microcontroller.ramBytes), str(b.title)) for b in enough if b.microcontroller), default=(0, ""))[1]


def _pins(plan: migration.MigrationPlan) -> PinNeeds:
    used = [b for b in plan.portBindings if not is_idle(plan, b)]
    bound = {id(pin) for b in used for pin in (bound_pin(b), answering_pin(b)) if pin is not None}
    bound |= {id(pin) for pin in pins_for_motors(plan)}
    drawn = {id(c.pin) for c in plan.connections if c.pin is not None} - bound
    wanted = sum(b.open for b in plan.portBindings)
    return PinNeeds(len(plan.board.pins) if plan.board is not None else 0, len(bound), len(drawn), wanted)


def _timers(plan: migration.MigrationPlan) -> Iterable[TimerNeeds]:
    """Who takes which timer: the included libraries, and the families of the pieces that the program gets."""
    takers: dict[str, list[str]] = {}
    for choice in plan.libraryChoices:
        if choice.included and choice.chosen is not None:
            for timer in choice.chosen.timers:
                takers.setdefault(str(timer), []).append(str(choice.chosen.name))
    pieces = emitted(plan)
    for timer in sorted({str(timer) for piece in pieces for timer in piece.timers}):
        takers.setdefault(timer, []).extend(_families(timer, pieces))
    return (TimerNeeds(timer, tuple(dict.fromkeys(takers[timer]))) for timer in sorted(takers))


def _families(timer: str, pieces: list[platform.Adapter]) -> list[str]:
    """Who takes a timer independently of the others: one name for each family of pieces that share it.

    Two pieces are of one family if they are written to share the timer: one depends on the other, both depend on a third one
    that takes it, or both use the same library. A family is named after its library, else after the first function that needs
    it.

    Args:
        timer: the timer's name.
        pieces: all pieces of the program, each after the pieces it depends on.
    """
    families: list[tuple[set[int], str]] = []
    for piece in pieces:
        if timer in piece.timers:
            needed = closure([piece])
            library = next((str(name) for each in needed for name in each.libraries), "")
            members = {id(each) for each in needed if timer in each.timers}
            joined = [family for family in families if family[0] & members or family[1] == library != ""]
            families = [family for family in families if family not in joined]
            named = library or next((name for _, name in joined if name), "")
            families.append((members.union(*(own for own, _ in joined)), named))
    return [name or _first_user(members, pieces) for members, name in families]


def _first_user(members: set[int], pieces: list[platform.Adapter]) -> str:
    """The name of the first function that needs one of some pieces; of the last of these where no function does."""
    users = (p for p in pieces if p.pieceKind == platform.PieceKind.adaptedFunction and members & {id(e) for e in closure([p])})
    last = [p for p in pieces if id(p) in members][-1]
    return str(next(users, last).name)


# ---- in words


def needs_in_words(needs: BoardNeeds) -> str:
    """The needs as one line of a report."""
    pins = needs.pins
    said = []
    if (build := needs.build) is not None:
        said.append(
            f"flash {build.flashBytes} of {build.flashLimit} bytes, RAM {build.ramBytes} of {build.ramLimit} bytes (compiled)"
        )
    if pins.of_board and (pins.used or pins.drawn or pins.wanted):
        more = f", {pins.wanted} still to assign" if pins.wanted else ""
        spare = f", {quantity(pins.drawn, 'wired pin')} the program does not use yet" if pins.drawn else ""
        said.append(f"{pins.used} of {pins.of_board} pins{spare}{more}")
    said += [f"{timer.timer} for {' and '.join(timer.takers)}" for timer in needs.timers]
    known = needs.memory
    if build is not None and build.stackBytes:
        said.append(f"stack at most {build.stackBytes} bytes")
    elif known.limit:
        ram = f"RAM about {known.total} of {known.limit} bytes, stack" if needs.build is None else "stack"
        lines = ", ".join(str(each) for each in known.unfollowed)
        without = f", without calls through pointers (line {lines})" if known.unfollowed else ""
        said.append(f"{ram} about {known.depth} bytes{without}")
    if known.stacks:
        said.append(f"stacks of former other cores {known.stacks} of {known.limit} bytes of RAM")
    if needs.loop is not None:
        said.append(_loop_time(needs.loop))
    return "; ".join(said)


def _loop_time(time: Time) -> str:
    """The time of a pass of the loop in words; waits of unknown length are named."""
    waits = list(dict.fromkeys(wait.what for wait in time.unbounded))
    names = [f"{name}()" if name.isidentifier() else name for name in waits]
    places = sorted({wait.line for wait in time.unbounded})
    lines = f"line{'s' * (len(places) > 1)} {', '.join(str(each) for each in places[:4])}{' ...' if len(places) > 4 else ''}"
    shown = [*names[:3], "..."] if len(names) > 3 else names
    listed = f"{' and '.join(filter(None, [', '.join(shown[:-1]), shown[-1]]))} ({lines})" if names else ""
    if not time.high:
        return f"loop time depends on {listed}" if listed else "the loop never waits"
    low, high = _seconds(time.low), _seconds(time.high)
    known = high if low == high else f"{low} to {high}"
    return f"loop time {known}, plus {listed}" if listed else f"loop time {known}"


def _seconds(microseconds: float) -> str:
    if microseconds >= _MILLION:
        return f"{microseconds / _MILLION:.3g} s"
    return f"{microseconds / 1000:.3g} ms" if microseconds >= 1000 else f"{microseconds:.0f} us" if microseconds else "0"


def shortages(needs: BoardNeeds) -> list[str]:
    """What the board cannot give, as sentences without a full stop."""
    found = _lacking(needs)
    if found and needs.roomier:
        found[-1] += f"; '{needs.roomier}' may have enough"
    if needs.pins.missing:
        needed = needs.pins.used + needs.pins.wanted
        few = f"{quantity(needs.pins.missing, 'pin')} too few"
        found.append(f"{few}: the program needs {needed}, the board has {needs.pins.of_board}")
    found += [f"{timer.timer} is needed by {' and '.join(timer.takers)}" for timer in needs.timers if timer.contested]
    return found


def _lacking(needs: BoardNeeds) -> list[str]:
    """What memory the board lacks: as it is compiled, its stack read off it or estimated; before that, all as estimated."""
    known, build = needs.memory, needs.build
    if build is None:
        return _too_much(known)
    sizes = (("flash", build.flashBytes, build.flashLimit), ("RAM", build.ramBytes, build.ramLimit))
    found = [f"the program needs {size} bytes of {what}, the board has {limit}" for what, size, limit in sizes if size > limit]
    if build.ramBytes <= build.ramLimit < build.ramBytes + needs.stack:
        left = build.ramLimit - build.ramBytes
        most = f"up to {needs.stack}" if build.stackBytes else f"about {needs.stack}"
        found.append(f"the stack needs {most} bytes, but only {left} of {build.ramLimit} bytes of RAM are left")
    return found


def _too_much(known: Memory) -> list[str]:
    """What the memory lacks as it is estimated, and what takes most of it."""
    if not known.limit or known.total + known.depth <= known.limit:
        return []
    shares = [
        *((share.bytes, f"'{share.name}' {share.bytes}") for share in known.variables[:2]),
        (known.stacks, f"stacks of former other cores {known.stacks}"),
        (known.texts, f"texts {known.texts}"),
        (known.of_adapters, f"adapters and libraries {known.of_adapters}"),
    ]
    largest = ", ".join(said for size, said in sorted(shares, key=lambda each: -each[0])[:3] if size)
    return [
        f"the program needs about {known.total} bytes of RAM and {known.depth} of stack, the board has {known.limit} ({largest})"
    ]
