"""The declarations of a platform's API as plain values: entries of names, pins of functions, and `ApiFacts`, which holds all.

Facts come from the repository (`platform_folder`) or from stored models (`platform_model`). `ApiIndex` in `platform_api`
answers questions about them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple, Protocol

from msgspec import Struct

from robosmi.transformations.knowledge.api_data import FunctionMeaning, HeaderContent, PlatformSettings

HEADER_KINDS = {"platform": "platform", "standard": "standard", "posix": "posix", "std-internal": "standard"}
COMPILER = "(compiler)"
"""What a stored platform calls the header of the compiler's own functions."""
DIRECTIONS = {"in": "input", "out": "output", "both": "both", "unknown": "unknown"}
"""Direction of a pin in the data -> literal of the platform metamodel."""
RELATIONS = {"equals": "equals", "not": "different", "below": "below"}
"""Condition of a convention in the data -> literal of the platform metamodel."""


class ApiEntry(NamedTuple):
    """One declaration of a name in one header.

    Attributes:
        header: as it is included.
        kind: function, function_macro, macro, variable, constant or type.
        detail: of a function its return type, of a variable its type, of a type its form (typedef, struct ...).
        parameters: of a function, from the opening to the closing parenthesis.
    """

    header: str
    kind: str
    detail: str = ""
    parameters: str = ""

    @property
    def callable(self) -> bool:
        """True for functions and function-like macros."""
        return self.kind in ("function", "function_macro")


class PinParameter(NamedTuple):
    """A parameter that is a pin, as `pins.json` has it.

    Attributes:
        position: which argument, from 0.
        name: as declared.
        direction: in, out, both, unknown.
        range_with: position of the other end, where two arguments give a range.
        span: how many pins follow each other from the argument on.
        number: position of the argument that says how many elements of an array of pins count.
        none: constants that mean no pin.
        numbering: what its numbers are, if they are not those of pins: `channel` or `interrupt` (`board_pins`).
        numbers: of such a parameter, (number, number of the pin) on the board of the program.
    """

    position: int
    name: str
    direction: str
    range_with: int | None = None
    span: int = 1
    number: int | None = None
    none: tuple[str, ...] = ()
    numbering: str = ""
    numbers: tuple[tuple[int, int], ...] = ()

    def pin_of(self, number: int) -> int | None:
        """The number of the pin that a number means; None if it means none."""
        return dict(self.numbers).get(number) if self.numbering and self.numbers else number


class Convention(Struct, frozen=True):
    """A pin that a function uses without an argument for it; `when` restricts it to calls with a certain argument."""

    pin: int
    direction: str
    what: str
    set_by: str | None = None
    when: dict[str, int] | None = None


class PinFacts(Struct, frozen=True):
    """The pins of one function of one header."""

    parameters: tuple[PinParameter, ...]
    conventions: tuple[Convention, ...]


class ApiFacts(Protocol):
    """The facts about one platform's API."""

    @property
    def origin(self) -> str:
        """Where the facts come from; two platforms have two origins."""

    @property
    def settings(self) -> PlatformSettings:
        """`name`, widths of types, and in the table `parser` how programs are parsed."""

    @property
    def headers(self) -> Mapping[str, HeaderContent]:
        """Name -> `kind` and `includes`."""

    @property
    def entries(self) -> Mapping[str, Sequence[ApiEntry]]:
        """Name -> its declarations, in the order of their headers' names."""

    @property
    def registers(self) -> frozenset[str]:
        """Names that are registers."""

    @property
    def pins(self) -> Mapping[tuple[str, str], PinFacts]:
        """Function and header -> its pins."""

    @property
    def functions(self) -> Mapping[str, FunctionMeaning]:
        """Function -> what it means: `parameters`, `blocking`, `startsCog`."""

    @property
    def symbols(self) -> Mapping[str, Mapping[str, str]]:
        """Another name -> `kind`, `type`, `meaning`."""

    @property
    def library_cores(self) -> Mapping[str, Sequence[str]]:
        """Header -> functions that start code of their library on another core."""

    @property
    def code_arguments(self) -> Mapping[str, int]:
        """Function -> which argument is the code that it starts on another core."""

    @property
    def virtual_headers(self) -> Mapping[str, bytes]:
        """Our own text of standard headers, by the name a program includes."""
