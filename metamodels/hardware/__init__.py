"""A circuit as its drawing says it, whatever drawing tool made it: components, connectors, nets, wires; and what the catalogue of parts says of each component.

Generated from hardware.ecore by robosmi metamodels generate. Do not edit.
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
    package,
)

if TYPE_CHECKING:
    from robosmi.model.strict import EnumLiteral
    from robosmi.model.strict_package import Classifier, GeneratedModule

name = "hardware"
nsURI = "http://robosmi.org/hardware/1"
nsPrefix = "hardware"

eClass = package(name, nsURI, nsPrefix)
eClassifiers: dict[str, Classifier] = {}
eSubpackages: list[GeneratedModule] = []
eSuperPackage: GeneratedModule | None = None
getEClassifier = find_classifier(eClassifiers)

if TYPE_CHECKING:

    class Role(EnumLiteral):
        """What a component is for the software: the board itself, gives input, takes output, both, is walked through, supplies, or does not matter (paper 3.2, "auxiliary" is Passive)."""

        Unknown: ClassVar[Role]
        Board: ClassVar[Role]
        Input: ClassVar[Role]
        Output: ClassVar[Role]
        Both: ClassVar[Role]
        Passive: ClassVar[Role]
        Power: ClassVar[Role]
        Decoration: ClassVar[Role]

    class ConnectorKind(EnumLiteral):
        """What a connector carries."""

        unknown: ClassVar[ConnectorKind]
        signal: ClassVar[ConnectorKind]
        supply: ClassVar[ConnectorKind]
        ground: ClassVar[ConnectorKind]

    class NamedDirection(EnumLiteral):
        """Which way a signal goes as seen by the board, told by the name of a connector."""

        unstated: ClassVar[NamedDirection]
        read: ClassVar[NamedDirection]
        write: ClassVar[NamedDirection]
        bus: ClassVar[NamedDirection]

    class PullUps(EnumLiteral):
        """Whether a device brings the pull-up resistors of its bus."""

        notKnown: ClassVar[PullUps]
        absent: ClassVar[PullUps]
        present: ClassVar[PullUps]

else:
    Role = enumeration(
        "Role",
        {
            "Unknown": 0,
            "Board": 1,
            "Input": 2,
            "Output": 3,
            "Both": 4,
            "Passive": 5,
            "Power": 6,
            "Decoration": 7,
        },
    )
    ConnectorKind = enumeration(
        "ConnectorKind",
        {"unknown": 0, "signal": 1, "supply": 2, "ground": 3},
    )
    NamedDirection = enumeration(
        "NamedDirection",
        {"unstated": 0, "read": 1, "write": 2, "bus": 3},
    )
    PullUps = enumeration("PullUps", {"notKnown": 0, "absent": 1, "present": 2})


class Circuit(Element, metaclass=MetaEClass):
    """A whole drawing."""

    name: str = EAttribute(eType=EString, default_value="")
    """Base name of the file, without extension."""
    path: str = EAttribute(eType=EString, default_value="")
    """Path relative to the model's own folder once stored, else as given."""
    digest: str = EAttribute(eType=EString, default_value="")
    """SHA-256 of the file's bytes, hexadecimal."""
    tool: str = EAttribute(eType=EString, default_value="")
    """Name of the drawing tool."""
    toolVersion: str = EAttribute(eType=EString, default_value="")
    """Its version as written in the file."""
    view: str = EAttribute(eType=EString, default_value="")
    """The view of the drawing from which the connections were read."""
    companions: MutableSequence[str] = EAttribute(eType=EString, upper=-1)
    """Further files of the drawing that were read (sheets, libraries), relative to the folder of its file, with forward slashes."""
    components: MutableSequence[Component] = EReference(upper=-1, containment=True)
    """Everything placed in the drawing but wires."""
    nets: MutableSequence[Net] = EReference(upper=-1, containment=True)
    """Sets of connectors that are one node electrically."""
    wires: MutableSequence[Wire] = EReference(upper=-1, containment=True)
    """The wires drawn."""
    described: bool = EAttribute(eType=EBoolean)
    """True when what is known of its parts is written in: devices of components, meanings of connectors, supply limits."""
    supplyLimits: MutableSequence[SupplyLimit] = EReference(upper=-1, containment=True)
    """What a board gives at most at its supplies."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            path: str | None = None,
            digest: str | None = None,
            tool: str | None = None,
            toolVersion: str | None = None,
            view: str | None = None,
            companions: Iterable[str] | None = None,
            components: Iterable[Component] | None = None,
            nets: Iterable[Net] | None = None,
            wires: Iterable[Wire] | None = None,
            described: bool | None = None,
            supplyLimits: Iterable[SupplyLimit] | None = None,
        ) -> None: ...


class Component(Element, metaclass=MetaEClass):
    """A part placed in the drawing."""

    circuit: Circuit | None = EReference()
    """The drawing."""
    elementId: str = EAttribute(eType=EString, lower=1)
    """Identity in the drawing (for Fritzing the model index)."""
    title: str = EAttribute(eType=EString, default_value="")
    """Its label in the drawing, not unique."""
    partId: str = EAttribute(eType=EString, default_value="")
    """Identity of the part in the tool's catalogue (for Fritzing the module id)."""
    partTitle: str = EAttribute(eType=EString, default_value="")
    """Title of the part."""
    family: str = EAttribute(eType=EString, default_value="")
    """Family of the part."""
    tags: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Tags of the part."""
    boardName: str = EAttribute(eType=EString, default_value="")
    """Short name of the board of the platform repository that it is drawn as (uno), also for a bare microcontroller; empty for all else."""
    role: Role = EAttribute(eType=Role)
    """What it is for the software."""
    roleEvidence: str = EAttribute(eType=EString, default_value="")
    """Why it has that role."""
    driver: bool = EAttribute(eType=EBoolean)
    """True when it drives a load of its own (motor driver, transistor, shift register)."""
    properties: MutableSequence[Property] = EReference(upper=-1, containment=True)
    """Properties of this instance and its part."""
    connectors: MutableSequence[Connector] = EReference(upper=-1, containment=True)
    """Its connectors, in the part's order."""
    buses: MutableSequence[Bus] = EReference(upper=-1, containment=True)
    """Connectors joined inside the part."""
    device: DeviceFacts | None = EReference(containment=True)
    """What is known of the kind of device that it is; none where nothing is known."""
    joinsByBusOnly: bool = EAttribute(eType=EBoolean)
    """True when it joins connectors only where one of its buses does, as a breadboard or a header."""
    eitherSide: bool = EAttribute(eType=EBoolean)
    """True for a chip that is an input or an output by what is wired to it, such as an amplifier."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            circuit: Circuit | None = None,
            elementId: str | None = None,
            title: str | None = None,
            partId: str | None = None,
            partTitle: str | None = None,
            family: str | None = None,
            tags: Iterable[str] | None = None,
            boardName: str | None = None,
            role: Role | None = None,
            roleEvidence: str | None = None,
            driver: bool | None = None,
            properties: Iterable[Property] | None = None,
            connectors: Iterable[Connector] | None = None,
            buses: Iterable[Bus] | None = None,
            device: DeviceFacts | None = None,
            joinsByBusOnly: bool | None = None,
            eitherSide: bool | None = None,
        ) -> None: ...


class Property(Element, metaclass=MetaEClass):
    """A named value."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its name."""
    value: str = EAttribute(eType=EString, default_value="")
    """Its value."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            value: str | None = None,
        ) -> None: ...


class Connector(Element, metaclass=MetaEClass):
    """A connector of a component."""

    component: Component | None = EReference()
    """The component."""
    connectorId: str = EAttribute(eType=EString, lower=1)
    """Identity in the part."""
    name: str = EAttribute(eType=EString, default_value="")
    """Its name in the drawing."""
    kind: ConnectorKind = EAttribute(eType=ConnectorKind)
    """What it carries."""
    pin: str = EAttribute(eType=EString, default_value="")
    """For a board the normalised label of its pin (D9, A0), else empty."""
    net: Net | None = EReference()
    """The net it is in."""
    meanings: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """What its name says, by the words of the table of electrical facts (sda, output, common)."""
    namedDirection: NamedDirection = EAttribute(eType=NamedDirection)
    """The direction that its name says."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            component: Component | None = None,
            connectorId: str | None = None,
            name: str | None = None,
            kind: ConnectorKind | None = None,
            pin: str | None = None,
            net: Net | None = None,
            meanings: Iterable[str] | None = None,
            namedDirection: NamedDirection | None = None,
        ) -> None: ...


class Bus(Element, metaclass=MetaEClass):
    """Connectors joined inside a component."""

    name: str = EAttribute(eType=EString, default_value="")
    """Its identity in the part."""
    connectors: MutableSequence[Connector] = EReference(upper=-1)
    """The connectors."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            connectors: Iterable[Connector] | None = None,
        ) -> None: ...


class Net(Element, metaclass=MetaEClass):
    """One electrical node."""

    circuit: Circuit | None = EReference()
    """The drawing."""
    name: str = EAttribute(eType=EString, lower=1)
    """Made of the smallest connector in it, stable between runs."""
    title: str = EAttribute(eType=EString, default_value="")
    """The name that the drawing gives it; empty where it gives none, or only a number."""
    rail: bool = EAttribute(eType=EBoolean)
    """True when it distributes a supply or ground."""
    railEvidence: str = EAttribute(eType=EString, default_value="")
    """Why it is a rail."""
    voltage: str = EAttribute(eType=EString, default_value="")
    """Label of the supply, empty when unknown."""
    connectors: MutableSequence[Connector] = EReference(upper=-1)
    """The connectors in it."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            circuit: Circuit | None = None,
            name: str | None = None,
            title: str | None = None,
            rail: bool | None = None,
            railEvidence: str | None = None,
            voltage: str | None = None,
            connectors: Iterable[Connector] | None = None,
        ) -> None: ...


class Wire(Element, metaclass=MetaEClass):
    """A wire drawn."""

    elementId: str = EAttribute(eType=EString, lower=1)
    """Identity in the drawing."""
    color: str = EAttribute(eType=EString, default_value="")
    """Its colour."""
    ends: MutableSequence[Connector] = EReference(upper=-1)
    """The connectors of components at its ends; fewer than two where it ends at another wire."""
    net: Net | None = EReference()
    """The net it is part of."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            elementId: str | None = None,
            color: str | None = None,
            ends: Iterable[Connector] | None = None,
            net: Net | None = None,
        ) -> None: ...


class DeviceFacts(Element, metaclass=MetaEClass):
    """What a kind of device needs and bears electrically, as the table of electrical facts had it when the drawing was read."""

    kind: str = EAttribute(eType=EString, lower=1)
    """What messages call it."""
    volts: MutableSequence[float] = EAttribute(eType=EDouble, upper=2, unique=False)
    """Least and most at its supply; empty where it is unknown."""
    signalVolts: float = EAttribute(eType=EDouble)
    """The most that its signals bear; 0 where it is unknown."""
    peakMilliamperes: int = EAttribute(eType=EInt)
    """The most that it takes while it works; 0 where it is unknown."""
    needsDriver: bool = EAttribute(eType=EBoolean)
    """True when a pin cannot drive it."""
    inductive: bool = EAttribute(eType=EBoolean)
    """True when it needs a diode behind a bare transistor."""
    terminals: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Names of the connectors that these two are about; all where it is empty."""
    isSwitch: bool = EAttribute(eType=EBoolean)
    """True for a transistor."""
    seriesResistor: bool = EAttribute(eType=EBoolean)
    """True when it needs one."""
    limitsCurrent: bool = EAttribute(eType=EBoolean)
    """True when what flows through its outputs is limited, or they are contacts."""
    analog: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Names of the connectors that give a voltage to be measured; * stands for all."""
    wants: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Abilities of a pin that serve it."""
    output: str = EAttribute(eType=EString, default_value="")
    """push-pull where its output cannot share a wire."""
    addresses: MutableSequence[int] = EAttribute(eType=EInt, upper=-1, unique=False)
    """Addresses on an I2C bus that it can have; the first is that of its delivery."""
    pullUps: PullUps = EAttribute(eType=PullUps)
    """Whether it brings the pull-up resistors of its bus."""
    isolated: bool = EAttribute(eType=EBoolean)
    """True when it needs no common ground."""
    sounds: bool = EAttribute(eType=EBoolean)
    """True when it is sounded with the function tone of the target."""
    rest: str = EAttribute(eType=EString, default_value="")
    """The level of its signals, low or high, at which it does nothing; empty for a device that needs none at the start."""
    bench: str = EAttribute(eType=EString, default_value="")
    """How it is tried alone on the bench; empty where its role says it."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            kind: str | None = None,
            volts: Iterable[float] | None = None,
            signalVolts: float | None = None,
            peakMilliamperes: int | None = None,
            needsDriver: bool | None = None,
            inductive: bool | None = None,
            terminals: Iterable[str] | None = None,
            isSwitch: bool | None = None,
            seriesResistor: bool | None = None,
            limitsCurrent: bool | None = None,
            analog: Iterable[str] | None = None,
            wants: Iterable[str] | None = None,
            output: str | None = None,
            addresses: Iterable[int] | None = None,
            pullUps: PullUps | None = None,
            isolated: bool | None = None,
            sounds: bool | None = None,
            rest: str | None = None,
            bench: str | None = None,
        ) -> None: ...


class SupplyLimit(Element, metaclass=MetaEClass):
    """The most that a board gives at its supply of a voltage."""

    volts: float = EAttribute(eType=EDouble)
    """Voltage of the supply."""
    milliamperes: int = EAttribute(eType=EInt)
    """The most that it gives."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            volts: float | None = None,
            milliamperes: int | None = None,
        ) -> None: ...


if not TYPE_CHECKING:  # pyecore's descriptors, which the annotations above hide
    from robosmi.model.strict_package import classifier

    Circuit.components.eType = Component
    Circuit.nets.eType = Net
    Circuit.wires.eType = Wire
    Circuit.supplyLimits.eType = SupplyLimit
    Component.circuit.eType = Circuit
    Component.properties.eType = Property
    Component.connectors.eType = Connector
    Component.buses.eType = Bus
    Component.device.eType = DeviceFacts
    Connector.component.eType = Component
    Connector.net.eType = Net
    Bus.connectors.eType = Connector
    Net.circuit.eType = Circuit
    Net.connectors.eType = Connector
    Wire.ends.eType = Connector
    Wire.net.eType = Net
    Circuit.components.eOpposite = Component.circuit
    Circuit.nets.eOpposite = Net.circuit
    Component.connectors.eOpposite = Connector.component
    Connector.net.eOpposite = Net.connectors
    classifier(__name__, Role)
    classifier(__name__, ConnectorKind)
    classifier(__name__, NamedDirection)
    classifier(__name__, PullUps)
