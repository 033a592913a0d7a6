"""Chooses the adapter for each call of a platform function, and the declaration for each other platform name (paper 3.4).

The candidates are pieces of adapter text from the platform repository, some of them variants for one microcontroller. Where
none fits, the plan says what is missing. Which functions and names a program uses is found by `adapter_uses` and
`placeholders`; the generators write the text into the program.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence

from msgspec import Struct

from robosmi.base.quantities import quantity
from robosmi.errors import UsageError, did_you_mean
from robosmi.metamodels import ccode, migration, platform
from robosmi.transformations.knowledge.adapters.adapter_index import AdapterIndex
from robosmi.transformations.knowledge.adapters.adapter_model import adapter_element
from robosmi.transformations.knowledge.adapters.adapter_records import AdapterPiece
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.platform_model import split_parameters
from robosmi.transformations.queries.adapter_signature import spelling
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces
from robosmi.transformations.queries.plans.plan_adapters import closure, emitted
from robosmi.transformations.queries.signature_text import parameter_type, split_signature

Status = migration.AdapterStatus
_LONG = re.compile(r"(?<!long )\blong(?! long)(?: int)?\b")
_UNSIGNED = re.compile(r"\bunsigned(?! int| char| short| long)\b")
_WORDS = re.compile(r"\b(?:extern|register|signed)\b")
ADAPTERS = ("filled", "placeholders")
"""The kinds of adapters that can be asked for: with bodies where the repository has them, or all left to be written by a
person.
"""
NO_ADAPTER = "no adapter file has it"
FUNCTIONS = ("adapter",)
VALUES = ("constant", "register", "variable")
TYPES = ("type",)
HELPERS = ("helper",)

_WAIT = re.compile(r"(while \(!Serial && millis\(\) < )\d+(\) \{\})")
"""The statement, with its milliseconds after the start."""


class UnservedHeader(Struct):
    """A header of the source platform whose contents the target cannot provide, and the reason."""

    name: str
    reason: str


class AdapterChoice:
    """The adapters of one plan; a model element for an adapter is made when a use first needs it.

    Args:
        index: the adapter files.
        api: the source platform.
        mcu: the microcontroller.
        filled: whether functions get bodies; constants have their values in any case.
        widened: whether the program's numbers are written with the widths of the source, which are those of adapters.
        members: of the platform's records, which the program uses by name.
        calls: the functions that the program calls and does not define.
        architecture: of the microcontroller.
        drawn: the kinds of the parts on the board's pins, as the marker `drawn` has them.

    Attributes:
        chosen_pieces: the pieces that elements were made of.
    """

    def __init__(
        self,
        index: AdapterIndex,
        api: ApiIndex,
        mcu: str,
        *,
        filled: bool = True,
        widened: bool = False,
        members: Collection[str] = (),
        calls: Collection[str] = (),
        architecture: str = "",
        drawn: Collection[str] = (),
    ) -> None:
        self.index, self.api, self.mcu, self.filled, self.widened = index, api, mcu, filled, widened
        self.pieces = AdapterPieces(index, members, calls, architecture, drawn)
        self._made: dict[tuple[str, str], platform.Adapter] = {}
        self.chosen_pieces: list[AdapterPiece] = []
        self._unserved: dict[str, UnservedHeader] = {}
        self._interrupts: dict[str, tuple[AdapterPiece, str]] = {}

    @property
    def elements(self) -> list[platform.Adapter]:
        """The adapters that uses refer to and those that these need, in order of dependency: each after the ones it needs."""
        return list(self._made.values())

    @property
    def unserved(self) -> list[UnservedHeader]:
        """Headers that the program uses and the target cannot serve."""
        return list(self._unserved.values())

    def adapts(self, name: str, header: str) -> bool:
        """Whether a function that the target's own library has is replaced by an adapter nevertheless."""
        return self.filled and self._key(name, header, FUNCTIONS) is not None

    def choose(self, use: migration.AdapterUse, header: str, *, handed: bool = False) -> None:
        """Give the use of a function its adapter and status, or the reason why it has none.

        Args:
            use: the use of a function; its status, reason and adapter are set.
            header: the header that declares the function, empty if unknown.
            handed: the function is also used as a value (a function pointer), so its types must match exactly.
        """
        if not self.filled:
            return
        reason = self.index.unsupported(header) if header else ""
        if reason:
            self._unserved.setdefault(header, UnservedHeader(header, reason))
            use.status, use.reason = Status.unsupported, reason
            return
        key = self._key(use.name, header, FUNCTIONS)
        if key is None:
            places = (self.index.task(str(use.name), place) for place in self._places(str(use.name), header))
            use.reason = next((reason for reason in places if reason), NO_ADAPTER)
            return
        needed = self.pieces.needed([key], self.mcu)
        if why := needed.unserved.get(key):
            use.reason = f"its adapter cannot be used here: {why}"
            return
        taken = needed.pieces[-1].signatures
        if misfit := _misfit(use.calls, taken):
            use.reason = misfit
            return
        own = use.signatureSource is migration.SignatureSource.program
        mine = _plain(spelling(p) for p in _types_of(use))
        one = _one_width if self.widened else list
        other = one(mine) not in [one(_types(signature)) for signature in taken]
        if own and other:
            use.reason = f"the program declares it as '{use.signature}', but its adapter is for '{taken[0]}'"
            return
        if handed and (other or not self.widened or "template" in needed.pieces[-1].text):
            use.reason = "the program uses it as a value, but its adapter has other types"
            return
        if conflict := self._conflict(needed.pieces):
            use.reason = conflict
            return
        for piece in needed.pieces:
            for vector in (*piece.vectors, *piece.taken):
                self._interrupts.setdefault(vector, (piece, str(use.name)))
        use.adapter = self._element(key)
        use.targetName = use.adapter.targetName or use.adapter.name
        if use.function is not None and use.function not in use.adapter.functions:
            use.adapter.functions.append(use.function)
        settle_use(use)

    def declare(self, name: str, header: str, kinds: Sequence[str]) -> platform.Adapter | None:
        """The adapter piece that declares a name other than a function's, such as a constant or type; None if there is none.

        Args:
            name: the name.
            header: the header that declares it, empty if unknown.
            kinds: the kinds of pieces to look among, as adapter files call them.
        """
        key = self._key(name, header, kinds if self.filled else [kind for kind in kinds if kind == "constant"])
        return self._element(key) if key is not None and not self.pieces.needed([key], self.mcu).unserved else None

    def _key(self, name: str, header: str, kinds: Sequence[str]) -> tuple[str, str] | None:
        """The key of the adapter piece for a name, which a related header may hold (see `_places`); None if there is none."""
        for place in self._places(name, header):
            key = self.pieces.key(f"{place}/{name}")
            variants = self.pieces.variants(key) if key is not None else []
            if variants and variants[0].kind in kinds:
                return key
        return None

    def _places(self, name: str, header: str) -> list[str]:
        """The headers whose adapter files may have a name of the given header, nearest first; all headers if it is unknown.

        These are the header itself, those it includes and those that include it, unless these declare it with another signature.
        The function of that name in any other header drives other hardware.
        """
        if not header:
            return list(self.index.headers)
        declared = {entry.header: self.api.signature(name, entry) for entry in self.api.entries(name)}
        included = self.api.closure((header,))
        below = [other for other in declared if other in included]
        closures = {other: self.api.closure((other,)) for other in self.index.headers}
        above = [other for other, below_it in closures.items() if header in below_it]
        above.sort(key=lambda other: len(closures[other]))  # the nearest ones first; those of further ones need not be read
        same = declared.get(header)
        return list(dict.fromkeys((header, *below, *(other for other in above if declared.get(other, same) == same))))

    def _conflict(self, pieces: Iterable[AdapterPiece]) -> str:
        """The message about an interrupt that a piece needs and another function's adapter has; empty if there is none."""
        for piece in pieces:
            for vector in (*piece.vectors, *piece.taken):
                holder, user = self._interrupts.get(vector, (piece, ""))
                if holder is not piece:
                    return f"its adapter and that of '{user}' both need the interrupt {vector}, but only one can use it"
        return ""

    def _element(self, key: tuple[str, str]) -> platform.Adapter:
        for piece in self.pieces.needed([key], self.mcu).pieces:
            own = piece.header, piece.name
            if own not in self._made:
                made = self._made[own] = adapter_element(piece)
                self.chosen_pieces.append(piece)
                needs = (self.pieces.key(name, piece.header) for name in piece.needs)
                made.needs.extend([self._made[need] for need in needs if need is not None])
        return self._made[key]


def adapter_choice(
    index: AdapterIndex,
    api: ApiIndex,
    board: platform.Board,
    how: str,
    *,
    widened: bool,
    members: Collection[str],
    calls: Collection[str],
    drawn: Collection[str] = (),
) -> AdapterChoice:
    """Make the choice of adapters for a plan.

    Args:
        index: the adapter files.
        api: the source platform.
        board: the target board.
        how: one of `ADAPTERS`.
        widened: whether the program's numbers are written with the widths of the source.
        members: of the platform's records, which the program uses by name.
        calls: the functions that the program calls and does not define.
        drawn: the kinds of the parts on the board's pins, as the marker `drawn` has them.

    Raises:
        UsageError: adapters are neither filled nor placeholders.
    """
    if how not in ADAPTERS:
        raise UsageError(f"adapters cannot be '{how}'{did_you_mean(how, ADAPTERS)}", fix=f"use one of: {', '.join(ADAPTERS)}")
    chip = board.microcontroller
    mcu, architecture = (str(chip.name), str(chip.architecture)) if chip is not None else ("", "")
    return AdapterChoice(
        index, api, mcu, filled=how == ADAPTERS[0], widened=widened, members=members, calls=calls, architecture=architecture,
        drawn=drawn,
    )  # fmt: skip


def _misfit(calls: Iterable[ccode.Call], signatures: Iterable[str]) -> str:
    """The message about a call with a number of arguments that no signature takes; empty if all calls fit."""
    taken = [_count(signature) for signature in signatures]
    for call in calls:
        given = len(call.arguments)
        if not any(given == count or (more and given > count) for count, more in taken):
            counts = " or ".join(str(count) for count in sorted({count for count, _ in taken}))
            return f"line {call.line} calls it with {quantity(given, 'argument')}, but its adapter takes {counts}"
    return ""


def _count(signature: str) -> tuple[int, bool]:
    """The number of parameters of a function, and whether it is variadic."""
    start = signature.find("(")
    parts = [part for part in split_parameters(signature[start:]) if part != "void"] if start >= 0 else []
    return len(parts) - ("..." in parts), "..." in parts


def _types(signature: str) -> list[str]:
    """The return type and parameter types of a signature in normalized spelling, so that they can be compared."""
    returned, _, parameters = split_signature(signature)
    return _plain([returned, *(parameter_type(parameter) for parameter in parameters)])


def _types_of(use: migration.AdapterUse) -> list[migration.TargetType | None]:
    return [use.result, *(parameter.valueType for parameter in use.parameters)]


def _plain(types: Iterable[str]) -> list[str]:
    return [" ".join(_WORDS.sub(" ", each).replace("*", " * ").split()) for each in types]


def _one_width(types: Iterable[str]) -> list[str]:
    """Replace `long` by `int` in types: both have 32 bits on the source, and the program's text is written with that width."""
    alike = (_LONG.sub("int", each) for each in types)
    return [_UNSIGNED.sub("unsigned int", each) for each in alike]


def settle_use(use: migration.AdapterUse, unserved: Collection[str] = ()) -> None:
    """Bring the status of a use in line with its adapter, which the user may have removed, added or written in a stored plan.

    Args:
        use: the use of a function.
        unserved: the reasons why headers cannot be provided on the target.
    """
    if use.adapter is not None:
        use.status = Status.care if any(piece.limits for piece in closure([use.adapter])) else Status.filled
        use.reason = ""
    elif use.written:
        use.status = Status.filled
    elif use.status in (Status.filled, Status.care):
        use.status = Status.unsupported if use.reason in unserved else Status.todo
        use.reason = use.reason or "its adapter was removed from the plan"


def settle_libraries(plan: migration.MigrationPlan) -> None:
    """Record for each chosen library whether the sketch includes it: where an adapter uses it.

    Where all bodies are placeholders, each chosen library is included: the bodies to write are to use it (paper 3.4). A plan
    without adapters and placeholders stays as it is.
    """
    if plan.target is None:
        return
    empty = bool(plan.adapterUses) and all(use.adapter is None for use in plan.adapterUses)
    if not plan.target.adapters and not empty:
        return
    used = {str(name) for piece in emitted(plan) for name in piece.libraries}
    for choice in plan.libraryChoices:
        choice.included = choice.chosen is not None and (empty or choice.chosen.name in used)


def serve(uses: Iterable[migration.AdapterUse], headers: Mapping[str, str], choice: AdapterChoice, handed: Iterable[str]) -> None:
    """Choose the adapter of each use of a function.

    Args:
        uses: of functions.
        headers: name of a function -> the header that declares it.
        choice: the adapters of the plan.
        handed: functions that are also handed on as values.
    """
    values = set(handed)
    for use in uses:
        choice.choose(use, headers.get(str(use.name), ""), handed=str(use.name) in values)


def set_console_wait(pieces: Iterable[platform.Adapter], milliseconds: int) -> None:
    """Set how long a program waits for its console, where the console is USB and a computer has to open it first.

    The wait is a statement of the adapter that has the console (`setup`); a robot without a computer must start all the same.

    Args:
        pieces: of the adapters of a plan.
        milliseconds: the time; 0 for no wait.
    """
    for piece in pieces:
        waits = [_WAIT.sub(rf"\g<1>{milliseconds}\2", str(statement)) for statement in piece.setup]
        statements = [statement for statement in waits if milliseconds or not _WAIT.fullmatch(statement)]
        if statements != list(piece.setup):
            piece.setup.clear()
            piece.setup.extend(statements)
