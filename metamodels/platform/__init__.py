"""What is known of source and target platforms: APIs, boards, parts, libraries, adapters. Loaded from the platform repository.

Generated from platform.ecore by robosmi metamodels generate. Do not edit.
"""

from __future__ import annotations

from collections.abc import Iterable, MutableSequence
from typing import TYPE_CHECKING, Any, ClassVar

from robosmi.model.strict import Element
from robosmi.model.strict_package import (
    EAttribute,
    EBoolean,
    EDouble,
    EInt,
    EReference,
    EString,
    MetaEClass,
    enumeration,
    find_classifier,
    package,
)

if TYPE_CHECKING:
    from robosmi.model.strict import EnumLiteral

name = "platform"
nsURI = "http://robosmi.org/platform/1"
nsPrefix = "platform"

eClass = package(name, nsURI, nsPrefix)
eClassifiers: dict[str, Any] = {}
eSubpackages: list[Any] = []
eSuperPackage: Any = None
getEClassifier = find_classifier(eClassifiers)

if TYPE_CHECKING:

    class HeaderKind(EnumLiteral):
        """Where a header comes from: the platform, the C standard library, or POSIX."""

        platform: ClassVar[HeaderKind]
        standard: ClassVar[HeaderKind]
        posix: ClassVar[HeaderKind]

    class Meaning(EnumLiteral):
        """What a parameter means for migration."""

        plain: ClassVar[Meaning]
        pin: ClassVar[Meaning]
        milliseconds: ClassVar[Meaning]
        microseconds: ClassVar[Meaning]
        ticks: ClassVar[Meaning]
        hertz: ClassVar[Meaning]
        level: ClassVar[Meaning]
        angle: ClassVar[Meaning]
        speed: ClassVar[Meaning]
        text: ClassVar[Meaning]
        channel: ClassVar[Meaning]

    class Direction(EnumLiteral):
        """Direction of a pin seen from the board."""

        unknown: ClassVar[Direction]
        input: ClassVar[Direction]
        output: ClassVar[Direction]
        both: ClassVar[Direction]

    class SymbolKind(EnumLiteral):
        """Kind of a name that is no function."""

        constant: ClassVar[SymbolKind]
        register: ClassVar[SymbolKind]
        variable: ClassVar[SymbolKind]
        macro: ClassVar[SymbolKind]

    class AdapterKind(EnumLiteral):
        """How source calls correspond to target calls (paper 5.3)."""

        oneToOne: ClassVar[AdapterKind]
        oneToMany: ClassVar[AdapterKind]
        manyToOne: ClassVar[AdapterKind]
        semantic: ClassVar[AdapterKind]

else:
    HeaderKind = enumeration("HeaderKind", {"platform": 0, "standard": 1, "posix": 2})
    Meaning = enumeration(
        "Meaning",
        {
            "plain": 0,
            "pin": 1,
            "milliseconds": 2,
            "microseconds": 3,
            "ticks": 4,
            "hertz": 5,
            "level": 6,
            "angle": 7,
            "speed": 8,
            "text": 9,
            "channel": 10,
        },
    )
    Direction = enumeration(
        "Direction",
        {"unknown": 0, "input": 1, "output": 2, "both": 3},
    )
    SymbolKind = enumeration(
        "SymbolKind",
        {"constant": 0, "register": 1, "variable": 2, "macro": 3},
    )
    AdapterKind = enumeration(
        "AdapterKind",
        {"oneToOne": 0, "oneToMany": 1, "manyToOne": 2, "semantic": 3},
    )


class PlatformRepository(Element, metaclass=MetaEClass):
    """The part of the platform repository that a model refers to."""

    platforms: MutableSequence[Platform] = EReference(upper=-1, containment=True)
    """The platforms."""
    parts: MutableSequence[PartFact] = EReference(upper=-1, containment=True)
    """Facts about hardware parts."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            platforms: Iterable[Platform] | None = None,
            parts: Iterable[PartFact] | None = None,
        ) -> None: ...


class Platform(Element, metaclass=MetaEClass):
    """A source or target platform."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its name."""
    language: str = EAttribute(eType=EString, default_value="C")
    """Language of its programs."""
    intBits: int = EAttribute(eType=EInt)
    """Width of int in bits."""
    longBits: int = EAttribute(eType=EInt)
    """Width of long in bits."""
    pointerBits: int = EAttribute(eType=EInt)
    """Width of a pointer in bits."""
    doubleBits: int = EAttribute(eType=EInt)
    """Width of double in bits."""
    charSigned: bool = EAttribute(eType=EBoolean)
    """True when plain char is signed."""
    hasCogs: bool = EAttribute(eType=EBoolean)
    """True when it runs several cores that a program starts itself."""
    architecture: str = EAttribute(eType=EString, default_value="")
    """Name of the processor architecture as libraries declare it."""
    coreVersion: str = EAttribute(eType=EString, default_value="")
    """Version of the target's core that a project names."""
    mainHeader: str = EAttribute(eType=EString, default_value="")
    """Header that every program of the platform includes."""
    headers: MutableSequence[Header] = EReference(upper=-1, containment=True)
    """Headers of its API."""
    boards: MutableSequence[Board] = EReference(upper=-1, containment=True)
    """Its boards."""
    libraries: MutableSequence[Library] = EReference(upper=-1, containment=True)
    """Its libraries."""
    adapters: MutableSequence[Adapter] = EReference(upper=-1, containment=True)
    """Adapters for functions of other platforms."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            language: str | None = None,
            intBits: int | None = None,
            longBits: int | None = None,
            pointerBits: int | None = None,
            doubleBits: int | None = None,
            charSigned: bool | None = None,
            hasCogs: bool | None = None,
            architecture: str | None = None,
            coreVersion: str | None = None,
            mainHeader: str | None = None,
            headers: Iterable[Header] | None = None,
            boards: Iterable[Board] | None = None,
            libraries: Iterable[Library] | None = None,
            adapters: Iterable[Adapter] | None = None,
        ) -> None: ...


class Header(Element, metaclass=MetaEClass):
    """A header of a platform's API."""

    platform: Platform | None = EReference()
    """The platform."""
    name: str = EAttribute(eType=EString, lower=1)
    """As it is included."""
    kind: HeaderKind = EAttribute(eType=HeaderKind)
    """Where it comes from."""
    includes: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Headers it includes itself."""
    functions: MutableSequence[ApiFunction] = EReference(upper=-1, containment=True)
    """Functions and function-like macros it declares."""
    symbols: MutableSequence[ApiSymbol] = EReference(upper=-1, containment=True)
    """Other names it declares."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            platform: Platform | None = None,
            name: str | None = None,
            kind: HeaderKind | None = None,
            includes: Iterable[str] | None = None,
            functions: Iterable[ApiFunction] | None = None,
            symbols: Iterable[ApiSymbol] | None = None,
        ) -> None: ...


class ApiFunction(Element, metaclass=MetaEClass):
    """A function of a platform's API."""

    header: Header | None = EReference()
    """The header that declares it."""
    name: str = EAttribute(eType=EString, lower=1)
    """Its name."""
    signature: str = EAttribute(eType=EString, default_value="")
    """Return type, name and parameters as declared."""
    returnType: str = EAttribute(eType=EString, default_value="")
    """Type of its value."""
    variadic: bool = EAttribute(eType=EBoolean)
    """True when it takes further arguments."""
    functionLikeMacro: bool = EAttribute(eType=EBoolean)
    """True for a function-like macro."""
    blocking: bool = EAttribute(eType=EBoolean)
    """True when it returns only after a time that matters."""
    startsCog: bool = EAttribute(eType=EBoolean)
    """True when it starts code on another core."""
    parameters: MutableSequence[ApiParameter] = EReference(upper=-1, containment=True)
    """Its parameters."""
    conventions: MutableSequence[PinConvention] = EReference(upper=-1, containment=True)
    """Pins it uses without an argument."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            header: Header | None = None,
            name: str | None = None,
            signature: str | None = None,
            returnType: str | None = None,
            variadic: bool | None = None,
            functionLikeMacro: bool | None = None,
            blocking: bool | None = None,
            startsCog: bool | None = None,
            parameters: Iterable[ApiParameter] | None = None,
            conventions: Iterable[PinConvention] | None = None,
        ) -> None: ...


class ApiParameter(Element, metaclass=MetaEClass):
    """A parameter of an API function."""

    name: str = EAttribute(eType=EString, default_value="")
    """Its name."""
    spelling: str = EAttribute(eType=EString, default_value="")
    """Its type as declared."""
    meaning: Meaning = EAttribute(eType=Meaning)
    """What it means for migration."""
    direction: Direction = EAttribute(eType=Direction)
    """For a pin, its direction."""
    componentRole: str = EAttribute(eType=EString, default_value="")
    """Kind of component it addresses, empty when it does not matter."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            spelling: str | None = None,
            meaning: Meaning | None = None,
            direction: Direction | None = None,
            componentRole: str | None = None,
        ) -> None: ...


class PinConvention(Element, metaclass=MetaEClass):
    """A pin that an API function uses without an argument."""

    pin: int = EAttribute(eType=EInt)
    """Its number on the source board."""
    direction: Direction = EAttribute(eType=Direction)
    """Its direction."""
    what: str = EAttribute(eType=EString, default_value="")
    """What is connected there."""
    setBy: str = EAttribute(eType=EString, default_value="")
    """Function that replaces the convention when the program calls it."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            pin: int | None = None,
            direction: Direction | None = None,
            what: str | None = None,
            setBy: str | None = None,
        ) -> None: ...


class ApiSymbol(Element, metaclass=MetaEClass):
    """A constant, register, variable or macro of a platform's API."""

    header: Header | None = EReference()
    """The header that declares it."""
    name: str = EAttribute(eType=EString, lower=1)
    """Its name."""
    symbolKind: SymbolKind = EAttribute(eType=SymbolKind)
    """Its kind."""
    typeName: str = EAttribute(eType=EString, default_value="")
    """Its type."""
    meaning: str = EAttribute(eType=EString, default_value="")
    """What it stands for."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            header: Header | None = None,
            name: str | None = None,
            symbolKind: SymbolKind | None = None,
            typeName: str | None = None,
            meaning: str | None = None,
        ) -> None: ...


class Board(Element, metaclass=MetaEClass):
    """A board."""

    name: str = EAttribute(eType=EString, lower=1)
    """Short name."""
    title: str = EAttribute(eType=EString, default_value="")
    """Full name."""
    fqbn: str = EAttribute(eType=EString, default_value="")
    """Fully qualified board name of the target's tools."""
    mcu: str = EAttribute(eType=EString, default_value="")
    """Its processor."""
    flashBytes: int = EAttribute(eType=EInt)
    """Program memory in bytes."""
    ramBytes: int = EAttribute(eType=EInt)
    """Data memory in bytes."""
    volts: float = EAttribute(eType=EDouble)
    """Logic level in volts."""
    pins: MutableSequence[Pin] = EReference(upper=-1, containment=True)
    """Its pins."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            title: str | None = None,
            fqbn: str | None = None,
            mcu: str | None = None,
            flashBytes: int | None = None,
            ramBytes: int | None = None,
            volts: float | None = None,
            pins: Iterable[Pin] | None = None,
        ) -> None: ...


class Pin(Element, metaclass=MetaEClass):
    """A pin of a board."""

    board: Board | None = EReference()
    """The board."""
    label: str = EAttribute(eType=EString, lower=1)
    """Normalised label (D9, A0)."""
    literal: str = EAttribute(eType=EString, default_value="")
    """How a program of the platform writes it."""
    aliases: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Other labels."""
    abilities: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """What it can do: digital, pwm, analog_in, interrupt, uart, i2c, spi."""
    timer: str = EAttribute(eType=EString, default_value="")
    """Timer that makes its PWM, empty for none."""
    reserved: str = EAttribute(eType=EString, default_value="")
    """What it is reserved for, empty for nothing."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            board: Board | None = None,
            label: str | None = None,
            literal: str | None = None,
            aliases: Iterable[str] | None = None,
            abilities: Iterable[str] | None = None,
            timer: str | None = None,
            reserved: str | None = None,
        ) -> None: ...


class PartFact(Element, metaclass=MetaEClass):
    """What the catalogue says of a hardware part."""

    partId: str = EAttribute(eType=EString, lower=1)
    """Identity in the drawing tool's catalogue."""
    title: str = EAttribute(eType=EString, default_value="")
    """Its title."""
    family: str = EAttribute(eType=EString, default_value="")
    """Its family."""
    tags: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Its tags."""
    role: str = EAttribute(eType=EString, default_value="")
    """Its role, a literal of hardware Role."""
    driver: bool = EAttribute(eType=EBoolean)
    """True when it drives a load of its own."""
    source: str = EAttribute(eType=EString, default_value="")
    """Where the fact comes from."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            partId: str | None = None,
            title: str | None = None,
            family: str | None = None,
            tags: Iterable[str] | None = None,
            role: str | None = None,
            driver: bool | None = None,
            source: str | None = None,
        ) -> None: ...


class Library(Element, metaclass=MetaEClass):
    """A library for the platform."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its name in the index."""
    version: str = EAttribute(eType=EString, default_value="")
    """Its version."""
    headers: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Headers that a program includes."""
    architectures: MutableSequence[str] = EAttribute(
        eType=EString,
        upper=-1,
        unique=False,
    )
    """Architectures it declares."""
    depends: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Libraries it needs."""
    timers: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Timers of the processor that it takes."""
    pins: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Labels of the pins that it takes."""
    installed: bool = EAttribute(eType=EBoolean)
    """True when it was found on this machine."""
    url: str = EAttribute(eType=EString, default_value="")
    """Its page."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            version: str | None = None,
            headers: Iterable[str] | None = None,
            architectures: Iterable[str] | None = None,
            depends: Iterable[str] | None = None,
            timers: Iterable[str] | None = None,
            pins: Iterable[str] | None = None,
            installed: bool | None = None,
            url: str | None = None,
        ) -> None: ...


class Adapter(Element, metaclass=MetaEClass):
    """A way to do on this platform what a function of another platform does."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its name."""
    signatures: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Signatures of the source functions it stands for."""
    adapterKind: AdapterKind = EAttribute(eType=AdapterKind)
    """How the calls correspond."""
    fidelity: str = EAttribute(eType=EString, default_value="")
    """How faithful it is."""
    limits: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """What it does not do."""
    includes: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Headers it needs."""
    globals: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Global declarations it needs."""
    setup: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Statements it needs at start."""
    libraries: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Libraries it needs."""
    componentRole: str = EAttribute(eType=EString, default_value="")
    """Kind of component it needs."""
    source: str = EAttribute(eType=EString, default_value="")
    """Relative path of its text in the repository."""
    needs: MutableSequence[Adapter] = EReference(upper=-1)
    """Other adapters it needs."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            signatures: Iterable[str] | None = None,
            adapterKind: AdapterKind | None = None,
            fidelity: str | None = None,
            limits: Iterable[str] | None = None,
            includes: Iterable[str] | None = None,
            globals: Iterable[str] | None = None,
            setup: Iterable[str] | None = None,
            libraries: Iterable[str] | None = None,
            componentRole: str | None = None,
            source: str | None = None,
            needs: Iterable[Adapter] | None = None,
        ) -> None: ...


if not TYPE_CHECKING:  # pyecore's descriptors, which the annotations above hide
    from robosmi.model.strict_package import classifier

    PlatformRepository.platforms.eType = Platform
    PlatformRepository.parts.eType = PartFact
    Platform.headers.eType = Header
    Platform.boards.eType = Board
    Platform.libraries.eType = Library
    Platform.adapters.eType = Adapter
    Header.platform.eType = Platform
    Header.functions.eType = ApiFunction
    Header.symbols.eType = ApiSymbol
    ApiFunction.header.eType = Header
    ApiFunction.parameters.eType = ApiParameter
    ApiFunction.conventions.eType = PinConvention
    ApiSymbol.header.eType = Header
    Board.pins.eType = Pin
    Pin.board.eType = Board
    Adapter.needs.eType = Adapter
    Platform.headers.eOpposite = Header.platform
    Header.functions.eOpposite = ApiFunction.header
    Header.symbols.eOpposite = ApiSymbol.header
    Board.pins.eOpposite = Pin.board
    classifier(__name__, HeaderKind)
    classifier(__name__, Meaning)
    classifier(__name__, Direction)
    classifier(__name__, SymbolKind)
    classifier(__name__, AdapterKind)
