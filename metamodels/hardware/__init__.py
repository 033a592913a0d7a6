"""A circuit as drawn, independent of the drawing tool: components, connectors, nets and wires, with the catalogue's facts about each component.

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
        """Direction of a signal as seen from the board, derived from the connector's name."""

        unstated: ClassVar[NamedDirection]
        read: ClassVar[NamedDirection]
        write: ClassVar[NamedDirection]
        bus: ClassVar[NamedDirection]

    class PullUps(EnumLiteral):
        """Whether a device has the pull-up resistors of its bus."""

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
    """Path relative to the model's own folder once saved, else as given."""
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
    """All parts of the drawing except wires."""
    nets: MutableSequence[Net] = EReference(upper=-1, containment=True)
    """Sets of connectors that are one electrical node."""
    wires: MutableSequence[Wire] = EReference(upper=-1, containment=True)
    """The drawn wires."""
    described: bool = EAttribute(eType=EBoolean)
    """True if the facts about its parts are in the model: devices of components, meanings of connectors, supply limits."""
    supplyLimits: MutableSequence[SupplyLimit] = EReference(upper=-1, containment=True)
    """The limits of a board's supplies."""

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
    """Short name of the board in the platform repository (uno), also for a bare microcontroller; empty for other parts."""
    role: Role = EAttribute(eType=Role)
    """Its role for the software."""
    roleEvidence: str = EAttribute(eType=EString, default_value="")
    """Why it has that role."""
    driver: bool = EAttribute(eType=EBoolean)
    """True if it drives a load of its own (motor driver, transistor, shift register)."""
    properties: MutableSequence[Property] = EReference(upper=-1, containment=True)
    """Properties of this instance and its part."""
    connectors: MutableSequence[Connector] = EReference(upper=-1, containment=True)
    """Its connectors, in the part's order."""
    buses: MutableSequence[Bus] = EReference(upper=-1, containment=True)
    """Groups of connectors that the part connects internally."""
    device: DeviceFacts | None = EReference(containment=True)
    """Facts about its kind of device; none if unknown."""
    joinsByBusOnly: bool = EAttribute(eType=EBoolean)
    """True if it connects only the connectors of its buses, as a breadboard or a header does."""
    eitherSide: bool = EAttribute(eType=EBoolean)
    """True for a chip that is an input or an output depending on its wiring, such as an amplifier."""
    positional: bool = EAttribute(eType=EBoolean)
    """True for a servo that turns to an angle and cannot turn on, by the names of its model."""

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
            positional: bool | None = None,
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
    """The kind of signal it carries."""
    pin: str = EAttribute(eType=EString, default_value="")
    """For a board the normalised label of its pin (D9, A0), else empty."""
    net: Net | None = EReference()
    """Its net."""
    meanings: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """The meaning of its name in the table of electrical facts (sda, output, common)."""
    namedDirection: NamedDirection = EAttribute(eType=NamedDirection)
    """The direction that its name implies."""

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
    """Connectors connected inside a component."""

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
    """Derived from the smallest connector in it, stable between runs."""
    title: str = EAttribute(eType=EString, default_value="")
    """The name in the drawing; empty if there is none, or only a number."""
    rail: bool = EAttribute(eType=EBoolean)
    """True if it distributes a supply or ground."""
    railEvidence: str = EAttribute(eType=EString, default_value="")
    """Why it is a rail."""
    voltage: str = EAttribute(eType=EString, default_value="")
    """Label of the supply, empty if unknown."""
    connectors: MutableSequence[Connector] = EReference(upper=-1)
    """Its connectors."""

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
    """A drawn wire."""

    elementId: str = EAttribute(eType=EString, lower=1)
    """Identity in the drawing."""
    color: str = EAttribute(eType=EString, default_value="")
    """Its colour."""
    ends: MutableSequence[Connector] = EReference(upper=-1)
    """The connectors of components at its ends; fewer than two if it ends at another wire."""
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
    """Electrical requirements and limits of a kind of device, as the table of electrical facts had them when the drawing was read."""

    kind: str = EAttribute(eType=EString, lower=1)
    """Its name in messages."""
    volts: MutableSequence[float] = EAttribute(eType=EDouble, upper=2, unique=False)
    """Minimum and maximum supply voltage in volts; empty if unknown."""
    signalVolts: float = EAttribute(eType=EDouble)
    """Maximum voltage of its signals in volts; 0 if unknown."""
    peakMilliamperes: int = EAttribute(eType=EInt)
    """Maximum operating current in mA; 0 if unknown."""
    needsDriver: bool = EAttribute(eType=EBoolean)
    """True if a pin cannot drive it."""
    inductive: bool = EAttribute(eType=EBoolean)
    """True if it needs a flyback diode with a bare transistor."""
    terminals: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Names of the connectors that the two facts above are about; empty for all."""
    isSwitch: bool = EAttribute(eType=EBoolean)
    """True for a transistor."""
    seriesResistor: bool = EAttribute(eType=EBoolean)
    """True if it needs a series resistor."""
    limitsCurrent: bool = EAttribute(eType=EBoolean)
    """True if the current through its outputs is limited, or they are contacts."""
    analog: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Names of the connectors with an analogue output voltage; * for all."""
    wants: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Abilities that a pin must have for it."""
    output: str = EAttribute(eType=EString, default_value="")
    """push-pull if its output cannot share a wire."""
    addresses: MutableSequence[int] = EAttribute(eType=EInt, upper=-1, unique=False)
    """Its possible I2C addresses, the factory setting first."""
    pullUps: PullUps = EAttribute(eType=PullUps)
    """Whether it has the pull-up resistors of its bus."""
    isolated: bool = EAttribute(eType=EBoolean)
    """True if it needs no common ground."""
    sounds: bool = EAttribute(eType=EBoolean)
    """True if the target's function tone drives it."""
    rest: str = EAttribute(eType=EString, default_value="")
    """The inactive level of its signals, low or high; empty if it needs none at the start."""
    bench: str = EAttribute(eType=EString, default_value="")
    """How to test it alone on the bench; empty if its role determines it."""

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
    """The maximum current of a board's supply."""

    volts: float = EAttribute(eType=EDouble)
    """Voltage of the supply."""
    milliamperes: int = EAttribute(eType=EInt)
    """Maximum current in mA."""

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
