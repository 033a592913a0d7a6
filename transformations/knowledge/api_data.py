"""The data types of a platform's own files: `platform.toml`, `api.json`, `pins.json`, `meanings.toml`.

The files of the built-in platforms explain the keys. Nothing is read here.
"""

from __future__ import annotations

from typing import Required, TypedDict


class SketchSettings(TypedDict):
    """`[parser.sketch]`: programs whose main files are one text, joined by the platform's tools.

    Attributes:
        endings: of the files that are joined.
        include: the header that the tools include before the text.
        sources: the folder beside them whose sources belong to the program, too.
        board: the board of a program of which nobody says it.
    """

    endings: list[str]
    include: str
    sources: str
    board: str


class ParserSettings(TypedDict, total=False):
    """`[parser]`: how programs are parsed."""

    target: str
    standard: str
    defines: list[str]
    predefined: list[str]
    undefined: list[str]
    attribute_macros: list[str]
    builtins: dict[str, str]
    sketch: SketchSettings


class BoardPort(TypedDict):
    """An entry of `[ports.board]`: where a port leads that is wired on the source board itself."""

    pin: str
    what: str
    functions: list[str]


class PortSettings(TypedDict, total=False):
    """`[ports]`: how many ports there are, what stands in front of their numbers in names, and what is known of them."""

    count: int
    prefix: str
    look_up: dict[str, str]
    names: dict[str, str]
    channels: dict[str, int]
    registers: dict[str, str]
    board: dict[str, BoardPort]
    roles: dict[str, str]
    usual: dict[str, list[str]]
    tones: dict[str, int]
    own: dict[str, str]
    mirrored: list[str]
    discharges: list[str]
    interrupt_of: str
    abilities: dict[str, str]
    buses: dict[str, list[str]]


class RegisterSettings(TypedDict, total=False):
    """`[registers]`."""

    names: list[str]
    read_only: list[str]


class PlatformSettings(TypedDict, total=False):
    """`platform.toml` of a source platform."""

    name: Required[str]
    title: str
    language: str
    architecture: str
    like: str
    standard: str
    int_bits: Required[int]
    long_bits: Required[int]
    pointer_bits: Required[int]
    double_bits: Required[int]
    char_signed: Required[bool]
    has_cogs: Required[bool]
    parser: Required[ParserSettings]
    cogs: dict[str, int]
    registers: RegisterSettings
    ports: PortSettings
    type_names: dict[str, str]


class HeaderContent(TypedDict, total=False):
    """A header of `api.json`: of a function its return type and its parameters, of a macro whether it takes arguments."""

    kind: Required[str]
    source: str
    includes: list[str]
    functions: dict[str, list[str]]
    macros: dict[str, int]
    vars: dict[str, str]
    consts: list[str]
    types: dict[str, str]
    registers: list[str]


class FunctionMeaning(TypedDict, total=False):
    """A function of `meanings.toml`."""

    parameters: list[str]
    blocking: bool
    longest_us: int
    startsCog: bool


class PinOfParameter(TypedDict, total=False):
    """A parameter of `pins.json` that is a pin (see `api_facts.PinParameter`)."""

    index: Required[int]
    name: Required[str]
    direction: Required[str]
    range_with: int
    span: int
    count: int
    none: list[str]
    numbering: str


class PinOfConvention(TypedDict, total=False):
    """A pin of `pins.json` that a function uses without an argument (see `api_facts.Convention`)."""

    pin: Required[int]
    direction: Required[str]
    what: Required[str]
    set_by: str
    when: dict[str, int]


class FunctionPins(TypedDict, total=False):
    """A function of `pins.json`."""

    function: Required[str]
    headers: Required[list[str]]
    parameters: list[PinOfParameter]
    conventions: list[PinOfConvention]
