"""Facts about source and target platforms: APIs, boards, targets, toolchains, parts, libraries, adapters. Loaded from the platform repository.

Generated from platform.ecore by robosmi metamodels generate. Do not edit.
"""

from __future__ import annotations

from collections.abc import Iterable, MutableSequence
from typing import TYPE_CHECKING, ClassVar

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
)
from robosmi.model.strict_package import package as _package

if TYPE_CHECKING:
    from robosmi.model.strict import EnumLiteral
    from robosmi.model.strict_package import Classifier, GeneratedModule

name = "platform"
nsURI = "http://robosmi.org/platform/2"
nsPrefix = "platform"

eClass = _package(name, nsURI, nsPrefix)
eClassifiers: dict[str, Classifier] = {}
eSubpackages: list[GeneratedModule] = []
eSuperPackage: GeneratedModule | None = None
getEClassifier = find_classifier(eClassifiers)

if TYPE_CHECKING:

    class HeaderKind(EnumLiteral):
        """Where a header comes from: the platform, the C standard library, or POSIX."""

        platform: ClassVar[HeaderKind]
        standard: ClassVar[HeaderKind]
        posix: ClassVar[HeaderKind]

    class Meaning(EnumLiteral):
        """The meaning of a parameter for migration: a mask has a bit for each port, and a handed value is passed to code that a function starts."""

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
        mask: ClassVar[Meaning]
        handed: ClassVar[Meaning]

    class Direction(EnumLiteral):
        """Direction of a pin as seen from the board."""

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

    class UserKind(EnumLiteral):
        """What occupies a resource of a microcontroller; a part is an object, a class or a function of the core or of a library that is linked once a program names it."""

        function: ClassVar[UserKind]
        library: ClassVar[UserKind]
        part: ClassVar[UserKind]

    class EntryStructure(EnumLiteral):
        """The entry point of a target's programs."""

        setupLoop: ClassVar[EntryStructure]
        mainFunction: ClassVar[EntryStructure]

    class PieceKind(EnumLiteral):
        """What a piece of adapter text implements."""

        adaptedFunction: ClassVar[PieceKind]
        constant: ClassVar[PieceKind]
        register: ClassVar[PieceKind]
        variable: ClassVar[PieceKind]
        dataType: ClassVar[PieceKind]
        helper: ClassVar[PieceKind]

    class PinCapability(EnumLiteral):
        """The ability that a pin must have."""

        digital: ClassVar[PinCapability]
        pwm: ClassVar[PinCapability]
        interrupt: ClassVar[PinCapability]
        analog: ClassVar[PinCapability]

    class Relation(EnumLiteral):
        """Comparison of an argument with a value."""

        equals: ClassVar[Relation]
        different: ClassVar[Relation]
        below: ClassVar[Relation]

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
            "mask": 11,
            "handed": 12,
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
    UserKind = enumeration("UserKind", {"function": 0, "library": 1, "part": 2})
    EntryStructure = enumeration("EntryStructure", {"setupLoop": 0, "mainFunction": 1})
    PieceKind = enumeration(
        "PieceKind",
        {
            "adaptedFunction": 0,
            "constant": 1,
            "register": 2,
            "variable": 3,
            "dataType": 4,
            "helper": 5,
        },
    )
    PinCapability = enumeration(
        "PinCapability",
        {"digital": 0, "pwm": 1, "interrupt": 2, "analog": 3},
    )
    Relation = enumeration("Relation", {"equals": 0, "different": 1, "below": 2})


class PlatformRepository(Element, metaclass=MetaEClass):
    """The part of the platform repository that a model refers to."""

    platforms: MutableSequence[Platform] = EReference(upper=-1, containment=True)
    """The platforms."""
    boards: MutableSequence[Board] = EReference(upper=-1, containment=True)
    """Boards, as hardware; platforms map them."""
    microcontrollers: MutableSequence[Microcontroller] = EReference(
        upper=-1,
        containment=True,
    )
    """The microcontrollers of the boards."""
    toolchains: MutableSequence[Toolchain] = EReference(upper=-1, containment=True)
    """The toolchains of targets."""
    targets: MutableSequence[Target] = EReference(upper=-1, containment=True)
    """The targets."""
    parts: MutableSequence[PartFact] = EReference(upper=-1, containment=True)
    """Facts about hardware parts."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            platforms: Iterable[Platform] | None = None,
            boards: Iterable[Board] | None = None,
            microcontrollers: Iterable[Microcontroller] | None = None,
            toolchains: Iterable[Toolchain] | None = None,
            targets: Iterable[Target] | None = None,
            parts: Iterable[PartFact] | None = None,
        ) -> None: ...


class Platform(Element, metaclass=MetaEClass):
    """A source or target platform."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its name."""
    title: str = EAttribute(eType=EString, default_value="")
    """Its full name."""
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
    """True if plain char is signed."""
    losesLevel: bool = EAttribute(eType=EBoolean)
    """True if a level that a program writes before it makes the pin an output may be lost."""
    hasCogs: bool = EAttribute(eType=EBoolean)
    """True if programs can start code on several cores."""
    portCount: int = EAttribute(eType=EInt)
    """The number of ports of its boards, numbered from 0; 0 if unknown."""
    portPrefix: str = EAttribute(eType=EString, default_value="P")
    """What stands in front of a port's number where no board names its pins."""
    architecture: str = EAttribute(eType=EString, default_value="")
    """Name of the processor architecture as libraries declare it."""
    coreVersion: str = EAttribute(eType=EString, default_value="")
    """Version of the target's core that a project names."""
    coreLibraries: MutableSequence[str] = EAttribute(eType=EString, upper=-1)
    """Libraries of the index that the core of the board brings itself."""
    coreName: str = EAttribute(eType=EString, default_value="")
    """Name of the core with that version, as boards name it (arduino:avr); empty if every board has that core."""
    mainHeader: str = EAttribute(eType=EString, default_value="")
    """Header that every program of the platform includes."""
    pinFunctions: MutableSequence[str] = EAttribute(
        eType=EString,
        upper=-1,
        unique=False,
    )
    """Functions or registers by which programs of a target platform use pins and time, named in advice."""
    standardHeaders: MutableSequence[str] = EAttribute(
        eType=EString,
        upper=-1,
        unique=False,
    )
    """Headers of the C standard library that a target platform has."""
    ownHeaders: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Headers of a target platform itself and of the libraries that come with it, whose names a program's own header cannot have."""
    widths: MutableSequence[TypeWidth] = EReference(upper=-1, containment=True)
    """Types that keep the width of the source on a target platform."""
    widerNames: MutableSequence[TypeWidth] = EReference(upper=-1, containment=True)
    """Functions, types and macros of the standard library with an int in their type, and their counterparts on a target platform with the width of the source."""
    names: ReservedNames | None = EReference(containment=True)
    """Names that a program shares with the core of a target platform."""
    attributeMacros: MutableSequence[str] = EAttribute(
        eType=EString,
        upper=-1,
        unique=False,
    )
    """Macros that stand for attributes of declarations."""
    boardMappings: MutableSequence[BoardMapping] = EReference(
        upper=-1,
        containment=True,
    )
    """The platform's names for boards and their pins."""
    headers: MutableSequence[Header] = EReference(upper=-1, containment=True)
    """Headers of its API."""
    libraries: MutableSequence[Library] = EReference(upper=-1, containment=True)
    """Its libraries."""
    adapters: MutableSequence[Adapter] = EReference(upper=-1, containment=True)
    """Pieces of adapters for another platform: those that a plan refers to, and those that they need."""
    unsupportedHeaders: MutableSequence[UnsupportedHeader] = EReference(
        upper=-1,
        containment=True,
    )
    """Headers of the source platform that this platform cannot support."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            title: str | None = None,
            language: str | None = None,
            intBits: int | None = None,
            longBits: int | None = None,
            pointerBits: int | None = None,
            doubleBits: int | None = None,
            charSigned: bool | None = None,
            losesLevel: bool | None = None,
            hasCogs: bool | None = None,
            portCount: int | None = None,
            portPrefix: str | None = None,
            architecture: str | None = None,
            coreVersion: str | None = None,
            coreLibraries: Iterable[str] | None = None,
            coreName: str | None = None,
            mainHeader: str | None = None,
            pinFunctions: Iterable[str] | None = None,
            standardHeaders: Iterable[str] | None = None,
            ownHeaders: Iterable[str] | None = None,
            widths: Iterable[TypeWidth] | None = None,
            widerNames: Iterable[TypeWidth] | None = None,
            names: ReservedNames | None = None,
            attributeMacros: Iterable[str] | None = None,
            boardMappings: Iterable[BoardMapping] | None = None,
            headers: Iterable[Header] | None = None,
            libraries: Iterable[Library] | None = None,
            adapters: Iterable[Adapter] | None = None,
            unsupportedHeaders: Iterable[UnsupportedHeader] | None = None,
        ) -> None: ...


class Header(Element, metaclass=MetaEClass):
    """A header of a platform's API."""

    platform: Platform | None = EReference()
    """The platform."""
    name: str = EAttribute(eType=EString, lower=1)
    """Its name in an include directive."""
    kind: HeaderKind = EAttribute(eType=HeaderKind)
    """Where it comes from."""
    includes: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Headers it includes itself."""
    functions: MutableSequence[ApiFunction] = EReference(upper=-1, containment=True)
    """Functions and function-like macros it declares."""
    symbols: MutableSequence[ApiSymbol] = EReference(upper=-1, containment=True)
    """Other names it declares."""
    types: MutableSequence[ApiType] = EReference(upper=-1, containment=True)
    """Types it declares."""

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
            types: Iterable[ApiType] | None = None,
        ) -> None: ...


class ApiFunction(Element, metaclass=MetaEClass):
    """A function of a platform's API."""

    header: Header | None = EReference()
    """The header that declares it."""
    name: str = EAttribute(eType=EString, lower=1)
    """Its name."""
    signature: str = EAttribute(eType=EString, default_value="")
    """Return type, name and parameters as declared."""
    parameterList: str = EAttribute(eType=EString, default_value="")
    """Its parameters as declared, with their parentheses."""
    returnType: str = EAttribute(eType=EString, default_value="")
    """Type of its result."""
    variadic: bool = EAttribute(eType=EBoolean)
    """True if it is variadic."""
    functionLikeMacro: bool = EAttribute(eType=EBoolean)
    """True for a function-like macro."""
    blocking: bool = EAttribute(eType=EBoolean)
    """True if it blocks for a relevant time."""
    longestMicroseconds: int = EAttribute(eType=EInt)
    """The longest time that it takes if its arguments do not determine it, in microseconds; 0 if unknown or unbounded."""
    startsCog: bool = EAttribute(eType=EBoolean)
    """True if it starts code on another core."""
    codeArgument: int = EAttribute(eType=EInt, default_value=-1)
    """Index of the argument with the code that it starts on another core; -1 for none."""
    parameters: MutableSequence[ApiParameter] = EReference(upper=-1, containment=True)
    """Its parameters."""
    conventions: MutableSequence[PinConvention] = EReference(upper=-1, containment=True)
    """Pins that it uses without an argument."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            header: Header | None = None,
            name: str | None = None,
            signature: str | None = None,
            parameterList: str | None = None,
            returnType: str | None = None,
            variadic: bool | None = None,
            functionLikeMacro: bool | None = None,
            blocking: bool | None = None,
            longestMicroseconds: int | None = None,
            startsCog: bool | None = None,
            codeArgument: int | None = None,
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
    """Its meaning for migration."""
    direction: Direction = EAttribute(eType=Direction)
    """For a pin, its direction."""
    isPort: bool = EAttribute(eType=EBoolean)
    """True if an argument is a port of the program, so that direction, span and range apply."""
    rangeWith: int = EAttribute(eType=EInt, default_value=-1)
    """Index of the parameter that is the other end of a range of pins; -1 for none."""
    span: int = EAttribute(eType=EInt, default_value=1)
    """The number of consecutive pins from the argument on."""
    numberAt: int = EAttribute(eType=EInt, default_value=-1)
    """Index of the parameter with the number of elements in an array of pins; -1 for none."""
    numbering: str = EAttribute(eType=EString, default_value="")
    """What its numbers are, if they are not those of pins: `channel` of the converter, or `interrupt`."""
    none: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Constants that mean no pin."""
    componentRole: str = EAttribute(eType=EString, default_value="")
    """Kind of component it addresses, empty if it does not matter."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            spelling: str | None = None,
            meaning: Meaning | None = None,
            direction: Direction | None = None,
            isPort: bool | None = None,
            rangeWith: int | None = None,
            span: int | None = None,
            numberAt: int | None = None,
            numbering: str | None = None,
            none: Iterable[str] | None = None,
            componentRole: str | None = None,
        ) -> None: ...


class PinConvention(Element, metaclass=MetaEClass):
    """A pin that an API function uses without an argument."""

    pin: int = EAttribute(eType=EInt)
    """Its number on the source board."""
    direction: Direction = EAttribute(eType=Direction)
    """Its direction."""
    what: str = EAttribute(eType=EString, default_value="")
    """The component that is connected there."""
    setBy: str = EAttribute(eType=EString, default_value="")
    """Function that replaces the convention if the program calls it."""
    conditions: MutableSequence[ArgumentCondition] = EReference(
        upper=-1,
        containment=True,
    )
    """Arguments that a call must have for the convention to apply; none for every call."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            pin: int | None = None,
            direction: Direction | None = None,
            what: str | None = None,
            setBy: str | None = None,
            conditions: Iterable[ArgumentCondition] | None = None,
        ) -> None: ...


class ApiSymbol(Element, metaclass=MetaEClass):
    """A constant, register, variable or macro of a platform's API."""

    header: Header | None = EReference()
    """The header that declares it."""
    name: str = EAttribute(eType=EString, lower=1)
    """Its name."""
    symbolKind: SymbolKind = EAttribute(eType=SymbolKind)
    """Its kind."""
    form: str = EAttribute(eType=EString, default_value="")
    """How it is declared: macro, variable, constant."""
    typeName: str = EAttribute(eType=EString, default_value="")
    """Its type."""
    meaning: str = EAttribute(eType=EString, default_value="")
    """Its value."""
    portDirection: str = EAttribute(eType=EString, default_value="")
    """How the bits of a register affect the ports of their numbers: in, out or unknown; empty if bits are no ports."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            header: Header | None = None,
            name: str | None = None,
            symbolKind: SymbolKind | None = None,
            form: str | None = None,
            typeName: str | None = None,
            meaning: str | None = None,
            portDirection: str | None = None,
        ) -> None: ...


class ArgumentCondition(Element, metaclass=MetaEClass):
    """A condition on an argument of a call."""

    position: int = EAttribute(eType=EInt)
    """Index of the argument."""
    relation: Relation = EAttribute(eType=Relation)
    """The comparison."""
    value: int = EAttribute(eType=EInt)
    """The value."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            position: int | None = None,
            relation: Relation | None = None,
            value: int | None = None,
        ) -> None: ...


class ApiType(Element, metaclass=MetaEClass):
    """A type of a platform's API."""

    header: Header | None = EReference()
    """The header that declares it."""
    name: str = EAttribute(eType=EString, lower=1)
    """Its name."""
    form: str = EAttribute(eType=EString, default_value="")
    """How it is declared: typedef, struct, union, enum, class."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            header: Header | None = None,
            name: str | None = None,
            form: str | None = None,
        ) -> None: ...


class TypeWidth(Element, metaclass=MetaEClass):
    """A type of a target that holds the values of a type of the source, by value only; or a name of its library that stands for another."""

    sourceType: str = EAttribute(eType=EString, lower=1)
    """Spelling of the type in the source."""
    targetType: str = EAttribute(eType=EString, lower=1)
    """Spelling on the target."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            sourceType: str | None = None,
            targetType: str | None = None,
        ) -> None: ...


class ReservedNames(Element, metaclass=MetaEClass):
    """Names that a program shares with the core of its target."""

    declared: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Functions, variables and types that every program sees."""
    macros: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Macros that every program sees."""
    same: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Those macros that have the same meaning in any C program."""
    absent: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Standard functions that the target's library does not have."""
    keywords: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Keywords of the target's language that are identifiers in C."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            declared: Iterable[str] | None = None,
            macros: Iterable[str] | None = None,
            same: Iterable[str] | None = None,
            absent: Iterable[str] | None = None,
            keywords: Iterable[str] | None = None,
        ) -> None: ...


class BoardMapping(Element, metaclass=MetaEClass):
    """A platform's names for a board and its pins."""

    board: Board | None = EReference()
    """The board."""
    boardId: str = EAttribute(eType=EString, default_value="")
    """Full name of the board in the platform's own tools, empty if they do not support it."""
    otherIds: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Other full names of the same board, with options that change nothing here."""
    variant: str = EAttribute(eType=EString, default_value="")
    """Name of the board's variant in the platform's core."""
    define: str = EAttribute(eType=EString, default_value="")
    """Macro that identifies the board in a program."""
    extraFlags: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Further compiler arguments."""
    flashBytes: int = EAttribute(eType=EInt)
    """Program memory in bytes that is available to a program."""
    ramBytes: int = EAttribute(eType=EInt)
    """Data memory in bytes."""
    coreVersion: str = EAttribute(eType=EString, default_value="")
    """Version of the board's core if it is not the platform's; empty if it is, or is unknown."""
    platformioId: str = EAttribute(eType=EString, default_value="")
    """Name of the board in PlatformIO, empty if it does not support it."""
    platformioPlatform: str = EAttribute(eType=EString, default_value="")
    """PlatformIO's name of the board's platform, empty for the usual one."""
    platformioSettings: MutableSequence[str] = EAttribute(
        eType=EString,
        upper=-1,
        unique=False,
    )
    """Further lines for the board in platformio.ini."""
    coreIndex: str = EAttribute(eType=EString, default_value="")
    """Address of the index with the board's core, empty if tools know it."""
    pinNames: MutableSequence[PinName] = EReference(upper=-1, containment=True)
    """The platform's names for the pins."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            board: Board | None = None,
            boardId: str | None = None,
            otherIds: Iterable[str] | None = None,
            variant: str | None = None,
            define: str | None = None,
            extraFlags: Iterable[str] | None = None,
            flashBytes: int | None = None,
            ramBytes: int | None = None,
            coreVersion: str | None = None,
            platformioId: str | None = None,
            platformioPlatform: str | None = None,
            platformioSettings: Iterable[str] | None = None,
            coreIndex: str | None = None,
            pinNames: Iterable[PinName] | None = None,
        ) -> None: ...


class PinName(Element, metaclass=MetaEClass):
    """A platform's names for a pin."""

    pin: Pin | None = EReference()
    """The pin."""
    literal: str = EAttribute(eType=EString, lower=1)
    """Its spelling in a program."""
    interrupt: int = EAttribute(eType=EInt, default_value=-1)
    """Number of its external interrupt, -1 for none."""
    number: int = EAttribute(eType=EInt, default_value=-1)
    """Its number, where neither the literal nor another name of the pin tells it; -1 else."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            pin: Pin | None = None,
            literal: str | None = None,
            interrupt: int | None = None,
            number: int | None = None,
        ) -> None: ...


class Target(Element, metaclass=MetaEClass):
    """A target of migrations: a board of a platform, with the generator for its programs."""

    name: str = EAttribute(eType=EString, lower=1)
    """Name that users give."""
    platform: Platform | None = EReference()
    """The platform."""
    board: Board | None = EReference()
    """The board."""
    toolchain: Toolchain | None = EReference()
    """Its toolchain; none if there is none."""
    generator: str = EAttribute(eType=EString, lower=1)
    """Name of the registered generator."""
    structure: EntryStructure = EAttribute(eType=EntryStructure)
    """The entry point of its programs."""
    language: str = EAttribute(eType=EString, default_value="")
    """Language of its programs: C or C++."""
    fileSuffix: str = EAttribute(eType=EString, default_value="")
    """Suffix of the main file, with its dot."""
    moduleSuffix: str = EAttribute(eType=EString, default_value="")
    """Suffix of further files, with its dot."""
    projectFile: str = EAttribute(eType=EString, default_value="")
    """Name of the file that declares the program's board, empty for none."""
    libraryIndex: str = EAttribute(eType=EString, default_value="")
    """Platform whose index of libraries it uses, empty for none."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            platform: Platform | None = None,
            board: Board | None = None,
            toolchain: Toolchain | None = None,
            generator: str | None = None,
            structure: EntryStructure | None = None,
            language: str | None = None,
            fileSuffix: str | None = None,
            moduleSuffix: str | None = None,
            projectFile: str | None = None,
            libraryIndex: str | None = None,
        ) -> None: ...


class Toolchain(Element, metaclass=MetaEClass):
    """A target's toolchain, as far as a plan needs it."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its name."""
    title: str = EAttribute(eType=EString, default_value="")
    """Full name."""
    architecture: str = EAttribute(eType=EString, default_value="")
    """Processor architecture that libraries must declare."""
    tools: MutableSequence[Tool] = EReference(upper=-1, containment=True)
    """Its tools."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            title: str | None = None,
            architecture: str | None = None,
            tools: Iterable[Tool] | None = None,
        ) -> None: ...


class Tool(Element, metaclass=MetaEClass):
    """A tool of a toolchain."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its purpose."""
    command: str = EAttribute(eType=EString, lower=1)
    """Its command."""
    package: str = EAttribute(eType=EString, default_value="")
    """The system package that contains it."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            command: str | None = None,
            package: str | None = None,
        ) -> None: ...


class Microcontroller(Element, metaclass=MetaEClass):
    """A microcontroller."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its name for the compiler."""
    title: str = EAttribute(eType=EString, default_value="")
    """Full name."""
    architecture: str = EAttribute(eType=EString, default_value="")
    """Processor architecture."""
    flashBytes: int = EAttribute(eType=EInt)
    """Program memory in bytes."""
    ramBytes: int = EAttribute(eType=EInt)
    """Data memory in bytes."""
    signature: str = EAttribute(eType=EString, default_value="")
    """Its device signature as six hexadecimal digits, by which programmers identify it; empty if unknown."""
    pinMilliamperes: int = EAttribute(eType=EInt)
    """Maximum current of one pin, in mA."""
    totalMilliamperes: int = EAttribute(eType=EInt)
    """Maximum current of its supply pins, in mA."""
    pinVolts: float = EAttribute(eType=EDouble)
    """Maximum voltage of a pin in volts, 0 if unknown."""
    timers: MutableSequence[Timer] = EReference(upper=-1, containment=True)
    """Its timers."""
    buses: MutableSequence[PinBus] = EReference(upper=-1, containment=True)
    """Its buses."""
    uses: MutableSequence[ResourceUse] = EReference(upper=-1, containment=True)
    """Resources that functions and libraries occupy."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            title: str | None = None,
            architecture: str | None = None,
            flashBytes: int | None = None,
            ramBytes: int | None = None,
            signature: str | None = None,
            pinMilliamperes: int | None = None,
            totalMilliamperes: int | None = None,
            pinVolts: float | None = None,
            timers: Iterable[Timer] | None = None,
            buses: Iterable[PinBus] | None = None,
            uses: Iterable[ResourceUse] | None = None,
        ) -> None: ...


class Timer(Element, metaclass=MetaEClass):
    """A timer of a microcontroller."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its name."""
    bits: int = EAttribute(eType=EInt)
    """Its width in bits."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            bits: int | None = None,
        ) -> None: ...


class PinBus(Element, metaclass=MetaEClass):
    """A bus of a microcontroller."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its kind: spi, i2c, uart."""
    signals: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Its signals, in the order of the ports."""
    ports: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """The microcontroller's pins of these signals."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            signals: Iterable[str] | None = None,
            ports: Iterable[str] | None = None,
        ) -> None: ...


class ResourceUse(Element, metaclass=MetaEClass):
    """Resources of a microcontroller that a function or a library occupies."""

    name: str = EAttribute(eType=EString, lower=1)
    """The function, the library or the part."""
    userKind: UserKind = EAttribute(eType=UserKind)
    """What it is."""
    timers: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Names of timers."""
    pins: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Labels of pins."""
    buses: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Names of buses."""
    condition: str = EAttribute(eType=EString, default_value="")
    """When it occupies them, empty for always."""
    ramBytes: int = EAttribute(eType=EInt)
    """RAM of its variables and buffers in bytes; 0 if unknown."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            userKind: UserKind | None = None,
            timers: Iterable[str] | None = None,
            pins: Iterable[str] | None = None,
            buses: Iterable[str] | None = None,
            condition: str | None = None,
            ramBytes: int | None = None,
        ) -> None: ...


class Board(Element, metaclass=MetaEClass):
    """A board as hardware; it belongs to no platform."""

    name: str = EAttribute(eType=EString, lower=1)
    """Short name."""
    title: str = EAttribute(eType=EString, default_value="")
    """Full name."""
    microcontroller: Microcontroller | None = EReference()
    """Its microcontroller."""
    clockHertz: int = EAttribute(eType=EInt)
    """Clock of the microcontroller in Hz."""
    volts: float = EAttribute(eType=EDouble)
    """Logic level in volts."""
    led: str = EAttribute(eType=EString, default_value="")
    """Label of the pin with the built-in LED, empty for none."""
    bootLoader: BootLoader | None = EReference(containment=True)
    """Its boot loader, if it has one."""
    pins: MutableSequence[Pin] = EReference(upper=-1, containment=True)
    """Its pins."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            title: str | None = None,
            microcontroller: Microcontroller | None = None,
            clockHertz: int | None = None,
            volts: float | None = None,
            led: str | None = None,
            bootLoader: BootLoader | None = None,
            pins: Iterable[Pin] | None = None,
        ) -> None: ...


class BootLoader(Element, metaclass=MetaEClass):
    """The boot loader of a board, which receives programs."""

    programmer: str = EAttribute(eType=EString, lower=1)
    """The upload tool's name of its protocol."""
    bauds: MutableSequence[int] = EAttribute(eType=EInt, upper=-1, unique=False)
    """Its possible baud rates, the likeliest first."""
    bytes: int = EAttribute(eType=EInt)
    """The greatest program size in bytes that it accepts."""
    touchBaud: int = EAttribute(eType=EInt)
    """Baud rate at which opening and closing the port starts it; 0 if a reset does."""
    tool: str = EAttribute(eType=EString, default_value="")
    """Name of the uploader that sends programs to it, empty for the toolchain's."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            programmer: str | None = None,
            bauds: Iterable[int] | None = None,
            bytes: int | None = None,
            touchBaud: int | None = None,
            tool: str | None = None,
        ) -> None: ...


class Pin(Element, metaclass=MetaEClass):
    """A pin of a board."""

    board: Board | None = EReference()
    """The board."""
    label: str = EAttribute(eType=EString, lower=1)
    """Normalised label (D9, A0)."""
    port: str = EAttribute(eType=EString, default_value="")
    """Name of the pin on the microcontroller."""
    aliases: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Other labels."""
    abilities: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Its abilities: digital, pwm, analog_in, interrupt, uart, i2c, spi."""
    timer: str = EAttribute(eType=EString, default_value="")
    """Timer of its PWM, empty for none."""
    channel: str = EAttribute(eType=EString, default_value="")
    """Output of that timer."""
    reserved: str = EAttribute(eType=EString, default_value="")
    """What it is reserved for, empty for nothing."""
    drivenByCore: bool = EAttribute(eType=EBoolean)
    """Whether the core drives it by itself, as for a light of the serial line: a program that leaves it alone changes it, too."""
    bearsVolts: float = EAttribute(eType=EDouble)
    """Maximum voltage of this pin in volts, if it differs from the microcontroller's; else 0."""
    interruptLine: str = EAttribute(eType=EString, default_value="")
    """Line of the interrupt that this pin shares with others: one of them at a time has its interrupt. Empty if it shares none."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            board: Board | None = None,
            label: str | None = None,
            port: str | None = None,
            aliases: Iterable[str] | None = None,
            abilities: Iterable[str] | None = None,
            timer: str | None = None,
            channel: str | None = None,
            reserved: str | None = None,
            drivenByCore: bool | None = None,
            bearsVolts: float | None = None,
            interruptLine: str | None = None,
        ) -> None: ...


class PartFact(Element, metaclass=MetaEClass):
    """A fact of the catalogue about a hardware part."""

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
    """True if it drives a load of its own."""
    source: str = EAttribute(eType=EString, default_value="")
    """Source of the fact."""

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
    """Headers for programs to include."""
    architectures: MutableSequence[str] = EAttribute(
        eType=EString,
        upper=-1,
        unique=False,
    )
    """Architectures it declares."""
    depends: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Libraries it needs."""
    timers: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Timers of the processor that it occupies."""
    pins: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Labels of the pins that it occupies."""
    takesWhen: str = EAttribute(eType=EString, default_value="")
    """When it occupies its timers and pins, empty for always."""
    installed: bool = EAttribute(eType=EBoolean)
    """True if it is installed on this machine."""
    url: str = EAttribute(eType=EString, default_value="")
    """Its web page."""

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
            takesWhen: str | None = None,
            installed: bool | None = None,
            url: str | None = None,
        ) -> None: ...


class Adapter(Element, metaclass=MetaEClass):
    """A piece of adapter text, which replaces a function or another name of the source platform on this platform; or a helper of such pieces."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its name on the source platform; for a helper, the name that the text defines."""
    pieceKind: PieceKind = EAttribute(eType=PieceKind)
    """What it implements."""
    sourceHeader: str = EAttribute(eType=EString, default_value="")
    """Header of the source platform that it belongs to."""
    functions: MutableSequence[ApiFunction] = EReference(upper=-1)
    """The functions of the source platform that it replaces, as far as the program uses them."""
    symbols: MutableSequence[ApiSymbol] = EReference(upper=-1)
    """The other names of the source platform that it replaces, as far as the program uses them."""
    signatures: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Signatures of the source functions that it replaces."""
    adapterKind: AdapterKind = EAttribute(eType=AdapterKind)
    """How the calls correspond."""
    targetName: str = EAttribute(eType=EString, default_value="")
    """Its name in the text if the target already uses the original one; else empty."""
    text: str = EAttribute(eType=EString, default_value="")
    """Its text in the language of the target."""
    stackBytes: int = EAttribute(eType=EInt, default_value=-1)
    """Measured stack of a call in bytes; -1 if not measured."""
    inlinedStackBytes: int = EAttribute(eType=EInt, default_value=-1)
    """The same if the program calls it at a single place, so that the compiler inlines it."""
    ramBytes: int = EAttribute(eType=EInt)
    """RAM of its own variables in bytes, without those of its needs and of libraries."""
    mostServos: int = EAttribute(eType=EInt)
    """Most servos that get pulses at a time; 0 where the source's library has no more."""
    fidelity: str = EAttribute(eType=EString, default_value="")
    """How faithfully it reproduces the original."""
    limits: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Its limits, as sentences for the user."""
    includes: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Headers it needs, in angle brackets or quotes."""
    setup: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Statements for the start of the program."""
    libraries: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Names of the target's libraries that it needs."""
    componentRole: str = EAttribute(eType=EString, default_value="")
    """Kind of component it needs."""
    timers: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Timers of the microcontroller that it occupies."""
    vectors: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Interrupts that it handles."""
    takenVectors: MutableSequence[str] = EAttribute(
        eType=EString,
        upper=-1,
        unique=False,
    )
    """Interrupts that a library which it includes handles."""
    mcus: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Microcontrollers that this variant is for; empty for all."""
    symmetric: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Parameters that can be swapped without effect."""
    pins: MutableSequence[AdapterPin] = EReference(upper=-1, containment=True)
    """Its parameters that are pins of the target."""
    ports: MutableSequence[ConventionalPort] = EReference(upper=-1, containment=True)
    """Pins that it uses by convention."""
    ranges: MutableSequence[ArgumentRange] = EReference(upper=-1, containment=True)
    """Argument values that it supports."""
    tables: MutableSequence[PortTable] = EReference(upper=-1, containment=True)
    """Tables in which it looks up ports of the source."""
    interrupts: MutableSequence[InterruptStack] = EReference(upper=-1, containment=True)
    """Measured stacks of the interrupts that occur once it has been called."""
    source: str = EAttribute(eType=EString, default_value="")
    """Path of its file, relative to its platform in the repository."""
    needs: MutableSequence[Adapter] = EReference(upper=-1)
    """Other pieces it needs."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            pieceKind: PieceKind | None = None,
            sourceHeader: str | None = None,
            functions: Iterable[ApiFunction] | None = None,
            symbols: Iterable[ApiSymbol] | None = None,
            signatures: Iterable[str] | None = None,
            adapterKind: AdapterKind | None = None,
            targetName: str | None = None,
            text: str | None = None,
            stackBytes: int | None = None,
            inlinedStackBytes: int | None = None,
            ramBytes: int | None = None,
            mostServos: int | None = None,
            fidelity: str | None = None,
            limits: Iterable[str] | None = None,
            includes: Iterable[str] | None = None,
            setup: Iterable[str] | None = None,
            libraries: Iterable[str] | None = None,
            componentRole: str | None = None,
            timers: Iterable[str] | None = None,
            vectors: Iterable[str] | None = None,
            takenVectors: Iterable[str] | None = None,
            mcus: Iterable[str] | None = None,
            symmetric: Iterable[str] | None = None,
            pins: Iterable[AdapterPin] | None = None,
            ports: Iterable[ConventionalPort] | None = None,
            ranges: Iterable[ArgumentRange] | None = None,
            tables: Iterable[PortTable] | None = None,
            interrupts: Iterable[InterruptStack] | None = None,
            source: str | None = None,
            needs: Iterable[Adapter] | None = None,
        ) -> None: ...


class AdapterPin(Element, metaclass=MetaEClass):
    """A parameter of an adapter that is a pin of the target."""

    name: str = EAttribute(eType=EString, lower=1)
    """The parameter."""
    capability: PinCapability = EAttribute(eType=PinCapability)
    """The ability that the pin must have."""
    direction: Direction = EAttribute(eType=Direction)
    """Its direction."""
    signed: bool = EAttribute(eType=EBoolean)
    """True if a negative value has a meaning of its own."""
    split: bool = EAttribute(eType=EBoolean)
    """True if the component may have a wire for each direction: the pin is either of them, and the adapter finds the other."""
    componentRole: str = EAttribute(eType=EString, default_value="")
    """Kind of component that is expected there, empty for any."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            capability: PinCapability | None = None,
            direction: Direction | None = None,
            signed: bool | None = None,
            split: bool | None = None,
            componentRole: str | None = None,
        ) -> None: ...


class ArgumentRange(Element, metaclass=MetaEClass):
    """The argument values of a parameter that an adapter supports."""

    name: str = EAttribute(eType=EString, lower=1)
    """The parameter's name in the source's signature."""
    position: int = EAttribute(eType=EInt)
    """The parameter's index."""
    least: int = EAttribute(eType=EInt, default_value=-2147483648)
    """The least supported value; above `most` where no constant is supported."""
    most: int = EAttribute(eType=EInt, default_value=2147483647)
    """The greatest supported value."""
    others: MutableSequence[int] = EAttribute(eType=EInt, upper=-1, unique=False)
    """Further supported values, such as 0 for off."""
    beside: str = EAttribute(eType=EString, default_value="")
    """The piece, with its header, in whose presence alone the range applies; empty for always."""
    awayFrom: str = EAttribute(eType=EString, default_value="")
    """Name of a pin of the target whose calls have no such range; empty for none."""
    effect: str = EAttribute(eType=EString, default_value="")
    """The effect of other values, as half a sentence."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            position: int | None = None,
            least: int | None = None,
            most: int | None = None,
            others: Iterable[int] | None = None,
            beside: str | None = None,
            awayFrom: str | None = None,
            effect: str | None = None,
        ) -> None: ...


class ConventionalPort(Element, metaclass=MetaEClass):
    """A pin that an adapter uses by convention: a generated constant with the pin to which the port is bound."""

    constant: str = EAttribute(eType=EString, lower=1)
    """The constant."""
    name: str = EAttribute(eType=EString, default_value="")
    """The port's name for users: abdrive.left_servo."""
    number: int = EAttribute(eType=EInt)
    """Its number on the source board."""
    capability: PinCapability = EAttribute(eType=PinCapability)
    """The ability that the pin must have."""
    direction: Direction = EAttribute(eType=Direction)
    """Its direction."""
    componentRole: str = EAttribute(eType=EString, default_value="")
    """Kind of component that is expected there, empty for any."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            constant: str | None = None,
            name: str | None = None,
            number: int | None = None,
            capability: PinCapability | None = None,
            direction: Direction | None = None,
            componentRole: str | None = None,
        ) -> None: ...


class PortTable(Element, metaclass=MetaEClass):
    """A table in which an adapter looks up ports of the source: an array with the pin of each port, from 0 on."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its name in the text."""
    count: int = EAttribute(eType=EInt)
    """The number of ports in it."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            count: int | None = None,
        ) -> None: ...


class InterruptStack(Element, metaclass=MetaEClass):
    """The stack of an interrupt that occurs once an adapter has been called."""

    vector: str = EAttribute(eType=EString, lower=1)
    """The interrupt."""
    stackBytes: int = EAttribute(eType=EInt)
    """Its stack in bytes, including the return address."""
    openBytes: int = EAttribute(eType=EInt, default_value=-1)
    """Its stack in bytes if it enables other interrupts; -1 if it does not."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            vector: str | None = None,
            stackBytes: int | None = None,
            openBytes: int | None = None,
        ) -> None: ...


class UnsupportedHeader(Element, metaclass=MetaEClass):
    """A header of the source platform that this platform cannot support."""

    name: str = EAttribute(eType=EString, lower=1)
    """The header, as it is included."""
    reason: str = EAttribute(eType=EString, default_value="")
    """What is missing here, as a sentence."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            reason: str | None = None,
        ) -> None: ...


if not TYPE_CHECKING:  # pyecore's descriptors, which the annotations above hide
    from robosmi.model.strict_package import classifier

    PlatformRepository.platforms.eType = Platform
    PlatformRepository.boards.eType = Board
    PlatformRepository.microcontrollers.eType = Microcontroller
    PlatformRepository.toolchains.eType = Toolchain
    PlatformRepository.targets.eType = Target
    PlatformRepository.parts.eType = PartFact
    Platform.widths.eType = TypeWidth
    Platform.widerNames.eType = TypeWidth
    Platform.names.eType = ReservedNames
    Platform.boardMappings.eType = BoardMapping
    Platform.headers.eType = Header
    Platform.libraries.eType = Library
    Platform.adapters.eType = Adapter
    Platform.unsupportedHeaders.eType = UnsupportedHeader
    Header.platform.eType = Platform
    Header.functions.eType = ApiFunction
    Header.symbols.eType = ApiSymbol
    Header.types.eType = ApiType
    ApiFunction.header.eType = Header
    ApiFunction.parameters.eType = ApiParameter
    ApiFunction.conventions.eType = PinConvention
    PinConvention.conditions.eType = ArgumentCondition
    ApiSymbol.header.eType = Header
    ApiType.header.eType = Header
    BoardMapping.board.eType = Board
    BoardMapping.pinNames.eType = PinName
    PinName.pin.eType = Pin
    Target.platform.eType = Platform
    Target.board.eType = Board
    Target.toolchain.eType = Toolchain
    Toolchain.tools.eType = Tool
    Microcontroller.timers.eType = Timer
    Microcontroller.buses.eType = PinBus
    Microcontroller.uses.eType = ResourceUse
    Board.microcontroller.eType = Microcontroller
    Board.bootLoader.eType = BootLoader
    Board.pins.eType = Pin
    Pin.board.eType = Board
    Adapter.functions.eType = ApiFunction
    Adapter.symbols.eType = ApiSymbol
    Adapter.pins.eType = AdapterPin
    Adapter.ports.eType = ConventionalPort
    Adapter.ranges.eType = ArgumentRange
    Adapter.tables.eType = PortTable
    Adapter.interrupts.eType = InterruptStack
    Adapter.needs.eType = Adapter
    Platform.headers.eOpposite = Header.platform
    Header.functions.eOpposite = ApiFunction.header
    Header.symbols.eOpposite = ApiSymbol.header
    Header.types.eOpposite = ApiType.header
    Board.pins.eOpposite = Pin.board
    classifier(__name__, HeaderKind)
    classifier(__name__, Meaning)
    classifier(__name__, Direction)
    classifier(__name__, SymbolKind)
    classifier(__name__, AdapterKind)
    classifier(__name__, UserKind)
    classifier(__name__, EntryStructure)
    classifier(__name__, PieceKind)
    classifier(__name__, PinCapability)
    classifier(__name__, Relation)
