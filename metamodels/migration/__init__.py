"""The migration plan, the hub of a migration: every decision as data, with its options, evidence, choice and who made it. It refers to the code, hardware and platform models and copies nothing of them.

Generated from migration.ecore by robosmi metamodels generate. Do not edit.
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
    abstract,
    enumeration,
    find_classifier,
    package,
)

if TYPE_CHECKING:
    from robosmi.model.strict import EnumLiteral
    from robosmi.model.strict_package import Classifier, GeneratedModule

    from ..ccode import (
        Call,
        Declaration,
        Function,
        Located,
        NameReference,
        Program,
        SourceUnit,
    )
    from ..hardware import Circuit, Component, Connector
    from ..platform import (
        Adapter,
        ApiFunction,
        ApiSymbol,
        Board,
        ConventionalPort,
        Library,
        Pin,
        PinConvention,
        Platform,
        Target,
    )
    from ..trace import Trace

name = "migration"
nsURI = "http://robosmi.org/migration/2"
nsPrefix = "migration"

eClass = package(name, nsURI, nsPrefix)
eClassifiers: dict[str, Classifier] = {}
eSubpackages: list[GeneratedModule] = []
eSuperPackage: GeneratedModule | None = None
getEClassifier = find_classifier(eClassifiers)

if TYPE_CHECKING:

    class ChosenBy(EnumLiteral):
        """Who made a choice."""

        nobody: ClassVar[ChosenBy]
        rule: ClassVar[ChosenBy]
        history: ClassVar[ChosenBy]
        person: ClassVar[ChosenBy]
        defaultValue: ClassVar[ChosenBy]

    class Action(EnumLiteral):
        """What happens to an element of the program."""

        retain: ClassVar[Action]
        adapt: ClassVar[Action]
        drop: ClassVar[Action]
        hoist: ClassVar[Action]
        rewrite: ClassVar[Action]
        unsupported: ClassVar[Action]

    class Step(EnumLiteral):
        """The step of the method a decision belongs to (paper sections 3.1 to 3.4)."""

        none: ClassVar[Step]
        code: ClassVar[Step]
        hardware: ClassVar[Step]
        libraries: ClassVar[Step]
        generation: ClassVar[Step]

    class AdapterStatus(EnumLiteral):
        """State of an adapter."""

        todo: ClassVar[AdapterStatus]
        filled: ClassVar[AdapterStatus]
        care: ClassVar[AdapterStatus]
        unsupported: ClassVar[AdapterStatus]

    class SignatureSource(EnumLiteral):
        """The source of an adapted function's declaration."""

        inferred: ClassVar[SignatureSource]
        repository: ClassVar[SignatureSource]
        program: ClassVar[SignatureSource]

    class SeverityLevel(EnumLiteral):
        """Severity of a finding."""

        info: ClassVar[SeverityLevel]
        warning: ClassVar[SeverityLevel]
        error: ClassVar[SeverityLevel]

    class ProgramStructure(EnumLiteral):
        """Whether the main function of the program has an endless loop of its own."""

        loopForever: ClassVar[ProgramStructure]
        runOnce: ClassVar[ProgramStructure]

    class Widths(EnumLiteral):
        """What to do with numbers that are narrower on the target: `keep` leaves the text, `fix` changes it so that the values stay those of the source."""

        keep: ClassVar[Widths]
        fix: ClassVar[Widths]

    class Signal(EnumLiteral):
        """Direction of a connection as seen from the board."""

        read: ClassVar[Signal]
        write: ClassVar[Signal]
        bus: ClassVar[Signal]

    class ChangeKind(EnumLiteral):
        """What became of a choice when the program was moved to another board."""

        kept: ClassVar[ChangeKind]
        proposed: ClassVar[ChangeKind]
        decided: ClassVar[ChangeKind]
        open: ClassVar[ChangeKind]
        lost: ClassVar[ChangeKind]

else:
    ChosenBy = enumeration(
        "ChosenBy",
        {"nobody": 0, "rule": 1, "history": 2, "person": 3, "defaultValue": 4},
    )
    Action = enumeration(
        "Action",
        {
            "retain": 0,
            "adapt": 1,
            "drop": 2,
            "hoist": 3,
            "rewrite": 4,
            "unsupported": 5,
        },
    )
    Step = enumeration(
        "Step",
        {"none": 0, "code": 1, "hardware": 2, "libraries": 3, "generation": 4},
    )
    AdapterStatus = enumeration(
        "AdapterStatus",
        {"todo": 0, "filled": 1, "care": 2, "unsupported": 3},
    )
    SignatureSource = enumeration(
        "SignatureSource",
        {"inferred": 0, "repository": 1, "program": 2},
    )
    SeverityLevel = enumeration("SeverityLevel", {"info": 0, "warning": 1, "error": 2})
    ProgramStructure = enumeration("ProgramStructure", {"loopForever": 0, "runOnce": 1})
    Widths = enumeration("Widths", {"keep": 0, "fix": 1})
    Signal = enumeration("Signal", {"read": 0, "write": 1, "bus": 2})
    ChangeKind = enumeration(
        "ChangeKind",
        {"kept": 0, "proposed": 1, "decided": 2, "open": 3, "lost": 4},
    )


class MigrationPlan(Element, metaclass=MetaEClass):
    """One migration of one program to one board."""

    name: str = EAttribute(eType=EString, lower=1)
    """Name of the sketch."""
    toolVersion: str = EAttribute(eType=EString, default_value="")
    """Version of the tool that made the plan."""
    structure: ProgramStructure = EAttribute(eType=ProgramStructure)
    """How main is divided."""
    program: Program | None = EReference()
    """The program."""
    circuit: Circuit | None = EReference()
    """The circuit of the target, if a drawing was given."""
    source: Platform | None = EReference()
    """The source platform."""
    target: Platform | None = EReference()
    """The target platform."""
    targetDescription: Target | None = EReference()
    """The target: its board and platform, how its programs are built, and the generator that writes for it."""
    board: Board | None = EReference()
    """The target board."""
    boardComponent: Component | None = EReference()
    """The board in the drawing."""
    move: Move | None = EReference(containment=True)
    """What changed since the plan for another board from which this one was made; none if it was made from the sources alone."""
    inputs: MutableSequence[Input] = EReference(upper=-1, containment=True)
    """The input files of the plan."""
    dispositions: MutableSequence[Disposition] = EReference(upper=-1, containment=True)
    """What happens to each element of the program."""
    connections: MutableSequence[Connection] = EReference(upper=-1, containment=True)
    """Which board pin is connected to which component (paper, MAPPINGS)."""
    concurrency: Concurrency | None = EReference(containment=True)
    """How code runs that the program starts on other cores; none if it starts none, or the target has cores."""
    portBindings: MutableSequence[PortBinding] = EReference(upper=-1, containment=True)
    """Which connection of the target replaces each port of the source."""
    motorChannels: MutableSequence[MotorChannel] = EReference(
        upper=-1,
        containment=True,
    )
    """The channels of the motor drivers that are wired to the board."""
    portFlows: MutableSequence[PortFlow] = EReference(upper=-1, containment=True)
    """How port numbers flow from the text to the platform functions."""
    libraryChoices: MutableSequence[LibraryChoice] = EReference(
        upper=-1,
        containment=True,
    )
    """Which library drives which component."""
    ownLibraries: MutableSequence[Library] = EReference(upper=-1)
    """The libraries whose headers the user has included in the generated program."""
    adapterUses: MutableSequence[AdapterUse] = EReference(upper=-1, containment=True)
    """The platform functions that are called, and how each is adapted."""
    symbolUses: MutableSequence[SymbolUse] = EReference(upper=-1, containment=True)
    """The platform symbols that are used, with their placeholders."""
    helpers: MutableSequence[Adapter] = EReference(upper=-1)
    """Pieces of adapter text that the changed text of the program uses beyond those of functions and symbols, such as the look-up of ports."""
    widths: Widths = EAttribute(eType=Widths)
    """Whether the program's numbers keep the widths of the source."""
    widenings: MutableSequence[Widening] = EReference(upper=-1, containment=True)
    """Width changes: one for each declaration or macro."""
    edits: MutableSequence[TextChange] = EReference(upper=-1, containment=True)
    """Text edits that a user added to the plan; those of decisions belong to the decisions."""
    tasks: MutableSequence[PlanTask] = EReference(upper=-1, containment=True)
    """Open tasks."""
    checks: MutableSequence[PlanTask] = EReference(upper=-1, containment=True)
    """Bench tests, one for each component that the program uses, to do before the robot runs on its own."""
    findings: MutableSequence[PlanFinding] = EReference(upper=-1, containment=True)
    """Notes for the user."""
    build: Build | None = EReference(containment=True)
    """Sizes of the last compiled program; none if it was not compiled or has changed since."""
    trace: Trace | None = EReference(containment=True)
    """The elements from which each decision and each generated line is derived."""
    bench: bool = EAttribute(eType=EBoolean)
    """Whether a sketch that tests one component at a time is generated too."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            toolVersion: str | None = None,
            structure: ProgramStructure | None = None,
            program: Program | None = None,
            circuit: Circuit | None = None,
            source: Platform | None = None,
            target: Platform | None = None,
            targetDescription: Target | None = None,
            board: Board | None = None,
            boardComponent: Component | None = None,
            move: Move | None = None,
            inputs: Iterable[Input] | None = None,
            dispositions: Iterable[Disposition] | None = None,
            connections: Iterable[Connection] | None = None,
            concurrency: Concurrency | None = None,
            portBindings: Iterable[PortBinding] | None = None,
            motorChannels: Iterable[MotorChannel] | None = None,
            portFlows: Iterable[PortFlow] | None = None,
            libraryChoices: Iterable[LibraryChoice] | None = None,
            ownLibraries: Iterable[Library] | None = None,
            adapterUses: Iterable[AdapterUse] | None = None,
            symbolUses: Iterable[SymbolUse] | None = None,
            helpers: Iterable[Adapter] | None = None,
            widths: Widths | None = None,
            widenings: Iterable[Widening] | None = None,
            edits: Iterable[TextChange] | None = None,
            tasks: Iterable[PlanTask] | None = None,
            checks: Iterable[PlanTask] | None = None,
            findings: Iterable[PlanFinding] | None = None,
            build: Build | None = None,
            trace: Trace | None = None,
            bench: bool | None = None,
        ) -> None: ...


class Move(Element, metaclass=MetaEClass):
    """The changes between a plan for one board and the plan made from it for another."""

    target: str | None = EAttribute(eType=EString)
    """Name of the other plan's target."""
    board: str = EAttribute(eType=EString, default_value="")
    """Title of the other plan's board."""
    pinsProposed: bool = EAttribute(eType=EBoolean, default_value=False)
    """Whether the pins come from a proposed pin table that nobody has approved yet."""
    changes: MutableSequence[PlanChange] = EReference(upper=-1, containment=True)
    """The choices, ports first."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            target: str | None = None,
            board: str | None = None,
            pinsProposed: bool | None = None,
            changes: Iterable[PlanChange] | None = None,
        ) -> None: ...


class PlanChange(Element, metaclass=MetaEClass):
    """What became of one choice when the program was moved to another board."""

    kind: ChangeKind = EAttribute(eType=ChangeKind)
    """What became of it."""
    subject: str | None = EAttribute(eType=EString)
    """What the choice is about: the name of a port, the title of a component."""
    before: str = EAttribute(eType=EString, default_value="")
    """What was chosen for the other board, with its pin; empty if nothing was."""
    after: str = EAttribute(eType=EString, default_value="")
    """What is chosen for this board, with its pin; empty if nothing is."""
    why: str = EAttribute(eType=EString, default_value="")
    """Why it does not fit, or who has chosen it."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            kind: ChangeKind | None = None,
            subject: str | None = None,
            before: str | None = None,
            after: str | None = None,
            why: str | None = None,
        ) -> None: ...


class Input(Element, metaclass=MetaEClass):
    """An input file of the plan."""

    path: str = EAttribute(eType=EString, lower=1)
    """Its copy, relative to the plan."""
    digest: str = EAttribute(eType=EString, lower=1)
    """SHA-256 of its bytes, hexadecimal."""
    kind: str = EAttribute(eType=EString, default_value="")
    """source, drawing, code, hardware or platform."""
    origin: str = EAttribute(eType=EString, default_value="")
    """Base name of the file as given."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            path: str | None = None,
            digest: str | None = None,
            kind: str | None = None,
            origin: str | None = None,
        ) -> None: ...


@abstract
class Decision(Element, metaclass=MetaEClass):
    """A decision with several options."""

    confidence: float = EAttribute(eType=EDouble)
    """Between 0 and 1."""
    chosenBy: ChosenBy = EAttribute(eType=ChosenBy)
    """Who chose."""
    evidence: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Evidence for the choice."""
    open: bool = EAttribute(eType=EBoolean)
    """True if nothing is chosen."""
    choice: str = EAttribute(eType=EString, default_value="")
    """The choice: the label of an option, a user's own value, or the action of a disposition; empty if open."""
    chosenAt: str = EAttribute(eType=EString, default_value="")
    """When a user chose, in UTC (2026-05-01T12:00:00Z); empty if not recorded, as for flags and project files."""
    options: MutableSequence[Option] = EReference(upper=-1, containment=True)
    """The options, best first."""
    changes: MutableSequence[TextChange] = EReference(upper=-1, containment=True)
    """Text edits of the decision."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            confidence: float | None = None,
            chosenBy: ChosenBy | None = None,
            evidence: Iterable[str] | None = None,
            open: bool | None = None,
            choice: str | None = None,
            chosenAt: str | None = None,
            options: Iterable[Option] | None = None,
            changes: Iterable[TextChange] | None = None,
        ) -> None: ...


class Option(Element, metaclass=MetaEClass):
    """One way to decide."""

    label: str = EAttribute(eType=EString, lower=1)
    """Its label."""
    score: float = EAttribute(eType=EDouble)
    """Its score; comparable within one decision."""
    reasons: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Why."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            label: str | None = None,
            score: float | None = None,
            reasons: Iterable[str] | None = None,
        ) -> None: ...


class Disposition(Decision):
    """What happens to an element of the program (paper 3.1)."""

    action: Action = EAttribute(eType=Action)
    """The action."""
    rules: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Ids of the rules that decided; more than one if several change the element's text."""
    reasons: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """The reasons, one sentence for each rule."""
    element: Located | None = EReference()
    """The element."""
    inLoop: bool = EAttribute(eType=EBoolean)
    """True for a statement of main that belongs to the repeated part."""
    runsIn: str = EAttribute(eType=EString, default_value="")
    """Function of the target's program for a statement of main after its loop; empty for other statements."""
    goesOnIn: str = EAttribute(eType=EString, default_value="")
    """Function of the target's program that continues after a break or return leaves main's loop or main; empty for other statements."""
    hoisted: TextCopy | None = EReference(containment=True)
    """The text of a declaration that moves out of main."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            confidence: float | None = None,
            chosenBy: ChosenBy | None = None,
            evidence: Iterable[str] | None = None,
            open: bool | None = None,
            choice: str | None = None,
            chosenAt: str | None = None,
            options: Iterable[Option] | None = None,
            changes: Iterable[TextChange] | None = None,
            action: Action | None = None,
            rules: Iterable[str] | None = None,
            reasons: Iterable[str] | None = None,
            element: Located | None = None,
            inLoop: bool | None = None,
            runsIn: str | None = None,
            goesOnIn: str | None = None,
            hoisted: TextCopy | None = None,
        ) -> None: ...


class Widening(Decision):
    """How a declaration or macro keeps the widths that its numbers have on the source: `fix` with the text edits, `keep` without."""

    element: Located | None = EReference()
    """The declaration or macro; none for text outside of both, in code that is not compiled."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            confidence: float | None = None,
            chosenBy: ChosenBy | None = None,
            evidence: Iterable[str] | None = None,
            open: bool | None = None,
            choice: str | None = None,
            chosenAt: str | None = None,
            options: Iterable[Option] | None = None,
            changes: Iterable[TextChange] | None = None,
            element: Located | None = None,
        ) -> None: ...


class Concurrency(Decision):
    """How code that ran on cores of its own runs on a target with one core: as coroutines, which switch when one of them waits. Its text edits make loops yield that would otherwise wait for the others forever."""

    slots: int = EAttribute(eType=EInt)
    """How many run at the same time as main."""
    stackBytes: int = EAttribute(eType=EInt)
    """Stack of each in bytes."""
    loopGivesWay: bool = EAttribute(eType=EBoolean)
    """True if each pass of main's loop waits, so that no yield has to be added."""
    starts: MutableSequence[Call] = EReference(upper=-1)
    """The calls that start code on another core."""
    functions: MutableSequence[Function] = EReference(upper=-1)
    """The functions that they start."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            confidence: float | None = None,
            chosenBy: ChosenBy | None = None,
            evidence: Iterable[str] | None = None,
            open: bool | None = None,
            choice: str | None = None,
            chosenAt: str | None = None,
            options: Iterable[Option] | None = None,
            changes: Iterable[TextChange] | None = None,
            slots: int | None = None,
            stackBytes: int | None = None,
            loopGivesWay: bool | None = None,
            starts: Iterable[Call] | None = None,
            functions: Iterable[Function] | None = None,
        ) -> None: ...


class Connection(Element, metaclass=MetaEClass):
    """A connection between a connector of the board and a component (paper 3.2)."""

    name: str = EAttribute(eType=EString, lower=1)
    """Identifier, unique in the plan (BasicServo2WriteP1)."""
    signal: Signal = EAttribute(eType=Signal)
    """Direction."""
    pin: Pin | None = EReference()
    """The board's pin."""
    boardConnectors: MutableSequence[Connector] = EReference(upper=-1)
    """The connectors of the board that are this pin."""
    component: Component | None = EReference()
    """The component."""
    connectors: MutableSequence[Connector] = EReference(upper=-1)
    """Its connectors."""
    via: MutableSequence[Component] = EReference(upper=-1)
    """Passive components between them."""
    restLevel: str = EAttribute(eType=EString, default_value="")
    """The inactive level, low or high, that its pin gets first; empty for none."""
    neutralMicroseconds: int = EAttribute(eType=EInt)
    """Pulse width at which the servo on it stands still, in microseconds, as measured by the user; 0 if not measured."""
    speeds: MutableSequence[ServoSpeed] = EReference(upper=-1, containment=True)
    """Pulses of the servo on it by ascending speed, as measured by the user."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            signal: Signal | None = None,
            pin: Pin | None = None,
            boardConnectors: Iterable[Connector] | None = None,
            component: Component | None = None,
            connectors: Iterable[Connector] | None = None,
            via: Iterable[Component] | None = None,
            restLevel: str | None = None,
            neutralMicroseconds: int | None = None,
            speeds: Iterable[ServoSpeed] | None = None,
        ) -> None: ...


class ServoSpeed(Element, metaclass=MetaEClass):
    """The pulse that turns a servo at a speed."""

    speed: int = EAttribute(eType=EInt)
    """The speed, in the units of the function's argument."""
    microseconds: int = EAttribute(eType=EInt)
    """Pulse width in microseconds."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            speed: int | None = None,
            microseconds: int | None = None,
        ) -> None: ...


class MotorChannel(Element, metaclass=MetaEClass):
    """One channel of a motor driver: the pins of the board at its inputs."""

    component: Component | None = EReference()
    """The motor driver."""
    enable: Pin | None = EReference()
    """The pin at its PWM input; none if PWM goes to the two direction inputs."""
    first: Pin | None = EReference()
    """The pin at its first direction input, which is high for forward."""
    second: Pin | None = EReference()
    """The pin at its second direction input, which is high for backward."""
    awake: Pin | None = EReference()
    """The pin at the standby or sleep input, which is high while the driver works; none if no pin controls it."""
    missing: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """What is missing to drive a motor with this channel, one sentence each; empty if it is complete."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            component: Component | None = None,
            enable: Pin | None = None,
            first: Pin | None = None,
            second: Pin | None = None,
            awake: Pin | None = None,
            missing: Iterable[str] | None = None,
        ) -> None: ...


class PortBinding(Decision):
    """The connection that replaces a port of the source. A port is a number of the source board, whatever the text calls it; a port that a library uses by convention is separate. If it is open, or the choice is none (not wired), it has no pin of the target."""

    name: str = EAttribute(eType=EString, lower=1)
    """Name of the first constant or variable that holds it, P12 for a bare number, or the role of a convention (abdrive.left_servo)."""
    names: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Other names of the port: those of other constants that hold it, and P12 if the number means this port only."""
    sourcePin: int = EAttribute(eType=EInt, default_value=-1)
    """Its number on the source board, -1 if unknown."""
    signal: Signal = EAttribute(eType=Signal)
    """Direction of its uses in the program."""
    origin: str = EAttribute(eType=EString, default_value="")
    """declaration (a constant or variable holds it), literal, runtime (reached by a loop, a range or the bits of a register), given (only the user says that the program reaches it), or convention."""
    what: str = EAttribute(eType=EString, default_value="")
    """What the source says is connected to it."""
    element: Located | None = EReference()
    """The declaration or the first use."""
    role: str = EAttribute(eType=EString, default_value="")
    """The kind of component that the functions expect there (servo, ranger), empty if they do not imply one."""
    usualKind: str = EAttribute(eType=EString, default_value="")
    """The kind of component that such functions are most often used with, as which a picture without a drawing shows it; empty if they disagree or say nothing."""
    convention: PinConvention | None = EReference()
    """The convention of an API, if it is one."""
    conventionalPort: ConventionalPort | None = EReference()
    """The pin of the adapter that uses the port by convention, if there is one."""
    discharges: bool = EAttribute(eType=EBoolean)
    """Whether functions measure there how long a capacitor takes to discharge."""
    mirrored: bool = EAttribute(eType=EBoolean)
    """Whether the servo there is mounted the other way round, so that a wheel moves the robot forward at less than 1500 us."""
    answer: Connection | None = EReference()
    """The pin at which the component answers, if it has a wire for each direction and the functions support both; none for one wire."""
    connection: Connection | None = EReference()
    """The connection chosen."""
    pin: Pin | None = EReference()
    """The chosen pin if no connection has it."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            confidence: float | None = None,
            chosenBy: ChosenBy | None = None,
            evidence: Iterable[str] | None = None,
            open: bool | None = None,
            choice: str | None = None,
            chosenAt: str | None = None,
            options: Iterable[Option] | None = None,
            changes: Iterable[TextChange] | None = None,
            name: str | None = None,
            names: Iterable[str] | None = None,
            sourcePin: int | None = None,
            signal: Signal | None = None,
            origin: str | None = None,
            what: str | None = None,
            element: Located | None = None,
            role: str | None = None,
            usualKind: str | None = None,
            convention: PinConvention | None = None,
            conventionalPort: ConventionalPort | None = None,
            discharges: bool | None = None,
            mirrored: bool | None = None,
            answer: Connection | None = None,
            connection: Connection | None = None,
            pin: Pin | None = None,
        ) -> None: ...


class PortFlow(Decision):
    """Values that can reach each other on their way to pin parameters of platform functions, by assignment, parameters, results or macros. With the choice target, the constants become pins of the target in the text (by the port bindings); with source, all numbers stay and each call looks up the pin. Never both."""

    name: str = EAttribute(eType=EString, default_value="")
    """Its name: the first names in the text, or the first call."""
    bindings: MutableSequence[PortBinding] = EReference(upper=-1)
    """The port numbers that can flow through it."""
    calls: MutableSequence[Call] = EReference(upper=-1)
    """The calls of platform functions that it reaches, including those that macros expand to."""
    anything: bool = EAttribute(eType=EBoolean)
    """Whether a number from outside the text can flow through it, so that a user may bind any port of the source."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            confidence: float | None = None,
            chosenBy: ChosenBy | None = None,
            evidence: Iterable[str] | None = None,
            open: bool | None = None,
            choice: str | None = None,
            chosenAt: str | None = None,
            options: Iterable[Option] | None = None,
            changes: Iterable[TextChange] | None = None,
            name: str | None = None,
            bindings: Iterable[PortBinding] | None = None,
            calls: Iterable[Call] | None = None,
            anything: bool | None = None,
        ) -> None: ...


class LibraryChoice(Decision):
    """Which library drives a component (paper 3.3)."""

    component: Component | None = EReference()
    """The component."""
    chosen: Library | None = EReference()
    """The library chosen."""
    candidates: MutableSequence[Library] = EReference(upper=-1)
    """The candidates, best first."""
    recommendation: str = EAttribute(eType=EString, default_value="")
    """library, optional or none."""
    included: bool = EAttribute(eType=EBoolean)
    """True if the program includes the chosen library because something in it uses it."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            confidence: float | None = None,
            chosenBy: ChosenBy | None = None,
            evidence: Iterable[str] | None = None,
            open: bool | None = None,
            choice: str | None = None,
            chosenAt: str | None = None,
            options: Iterable[Option] | None = None,
            changes: Iterable[TextChange] | None = None,
            component: Component | None = None,
            chosen: Library | None = None,
            candidates: Iterable[Library] | None = None,
            recommendation: str | None = None,
            included: bool | None = None,
        ) -> None: ...


class AdapterUse(Element, metaclass=MetaEClass):
    """A platform function that the program calls (paper 3.4)."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its name."""
    signature: str = EAttribute(eType=EString, default_value="")
    """Its raw signature: as declared by the source platform or the program, or as inferred from the calls."""
    targetName: str = EAttribute(eType=EString, default_value="")
    """The adapter's name: the function's own, or another if the target already uses it."""
    result: TargetType | None = EReference(containment=True)
    """The type of its result on the target."""
    parameters: MutableSequence[AdapterParameter] = EReference(
        upper=-1,
        containment=True,
    )
    """Its parameters on the target, with types of the same widths as on the source platform."""
    variadic: bool = EAttribute(eType=EBoolean)
    """True if it is variadic."""
    signatureSource: SignatureSource = EAttribute(eType=SignatureSource)
    """The source of its declaration: the platform repository, the program itself (the adapter's body replaces that declaration), or none, so that it is inferred from the calls."""
    status: AdapterStatus = EAttribute(eType=AdapterStatus)
    """Its state."""
    notes: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Notes about it."""
    function: ApiFunction | None = EReference()
    """The function."""
    adapter: Adapter | None = EReference()
    """The adapter that implements it, if any."""
    reason: str = EAttribute(eType=EString, default_value="")
    """Why no adapter implements it and what is missing; empty if one does."""
    written: bool = EAttribute(eType=EBoolean)
    """True if a user wrote its body in the previous program."""
    calls: MutableSequence[Call] = EReference(upper=-1)
    """The calls."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            signature: str | None = None,
            targetName: str | None = None,
            result: TargetType | None = None,
            parameters: Iterable[AdapterParameter] | None = None,
            variadic: bool | None = None,
            signatureSource: SignatureSource | None = None,
            status: AdapterStatus | None = None,
            notes: Iterable[str] | None = None,
            function: ApiFunction | None = None,
            adapter: Adapter | None = None,
            reason: str | None = None,
            written: bool | None = None,
            calls: Iterable[Call] | None = None,
        ) -> None: ...


class AdapterParameter(Element, metaclass=MetaEClass):
    """A parameter of an adapter."""

    name: str = EAttribute(eType=EString, default_value="")
    """Its name."""
    valueType: TargetType | None = EReference(containment=True)
    """Its type."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            valueType: TargetType | None = None,
        ) -> None: ...


class TargetType(Element, metaclass=MetaEClass):
    """A type as the target's program writes it."""

    spelling: str = EAttribute(eType=EString, lower=1)
    """The type, written without a name: unsigned char *, int [4], void (*)(int)."""
    emptyValue: str = EAttribute(eType=EString, default_value="")
    """The value that an unwritten body returns: 0, {}, or nothing for void."""
    declarations: MutableSequence[Declaration] = EReference(upper=-1)
    """The program's own types in it."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            spelling: str | None = None,
            emptyValue: str | None = None,
            declarations: Iterable[Declaration] | None = None,
        ) -> None: ...


class SymbolUse(Element, metaclass=MetaEClass):
    """A platform symbol that the program uses."""

    name: str = EAttribute(eType=EString, lower=1)
    """Its name."""
    placeholder: str = EAttribute(eType=EString, default_value="")
    """The generated declaration."""
    status: AdapterStatus = EAttribute(eType=AdapterStatus)
    """Its state."""
    symbol: ApiSymbol | None = EReference()
    """The symbol."""
    adapter: Adapter | None = EReference()
    """The piece of adapter text that declares it, if any."""
    uses: MutableSequence[NameReference] = EReference(upper=-1)
    """The uses."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str | None = None,
            placeholder: str | None = None,
            status: AdapterStatus | None = None,
            symbol: ApiSymbol | None = None,
            adapter: Adapter | None = None,
            uses: Iterable[NameReference] | None = None,
        ) -> None: ...


class TextChange(Element, metaclass=MetaEClass):
    """An edit of the carried-over text: new text replaces a range of a source unit. An edit inside a range that another one replaces has no effect; of two with the same range the first counts, in the order of the plan's edits, port bindings, dispositions, width changes."""

    unit: SourceUnit | None = EReference()
    """The unit."""
    startOffset: int = EAttribute(eType=EInt)
    """Offset of the first byte replaced."""
    endOffset: int = EAttribute(eType=EInt)
    """Offset after the last byte replaced."""
    replacement: str = EAttribute(eType=EString, default_value="")
    """The new text."""
    rule: str = EAttribute(eType=EString, default_value="")
    """Id of the rule that makes it; empty for a user's edit."""
    reason: str = EAttribute(eType=EString, default_value="")
    """Why, one sentence."""
    step: Step = EAttribute(eType=Step)
    """The step of the method that makes it."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            unit: SourceUnit | None = None,
            startOffset: int | None = None,
            endOffset: int | None = None,
            replacement: str | None = None,
            rule: str | None = None,
            reason: str | None = None,
            step: Step | None = None,
        ) -> None: ...


class TextCopy(Element, metaclass=MetaEClass):
    """Text that moves out of main: the range of a source unit with all edits in it that are not its disposition's own, and the edits of the copy only. It goes to file scope, above main."""

    unit: SourceUnit | None = EReference()
    """The unit."""
    startOffset: int = EAttribute(eType=EInt)
    """Offset of the first byte copied."""
    endOffset: int = EAttribute(eType=EInt)
    """Offset after the last byte copied."""
    changes: MutableSequence[TextChange] = EReference(upper=-1, containment=True)
    """Edits of the copy only."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            unit: SourceUnit | None = None,
            startOffset: int | None = None,
            endOffset: int | None = None,
            changes: Iterable[TextChange] | None = None,
        ) -> None: ...


class PlanTask(Element, metaclass=MetaEClass):
    """An open task."""

    rule: str = EAttribute(eType=EString, default_value="")
    """Id of the rule."""
    severity: SeverityLevel = EAttribute(eType=SeverityLevel)
    """Its severity."""
    message: str = EAttribute(eType=EString, default_value="")
    """What to do, one sentence."""
    path: str = EAttribute(eType=EString, default_value="")
    """Its file, relative to the model's own folder."""
    line: int = EAttribute(eType=EInt)
    """Its line, 0 for none."""
    column: int = EAttribute(eType=EInt)
    """Its column, 0 for none."""
    effort: str = EAttribute(eType=EString, default_value="")
    """Rough effort: small, medium or large."""
    done: bool = EAttribute(eType=EBoolean)
    """True if the user has ticked it in the previous report."""
    fix: str = EAttribute(eType=EString, default_value="")
    """How to do it, if known."""
    texts: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Texts of a conflict: the user's, the last generated one, and the new one; else empty."""
    elements: MutableSequence[Element] = EReference(upper=-1)
    """The elements it is about."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            rule: str | None = None,
            severity: SeverityLevel | None = None,
            message: str | None = None,
            path: str | None = None,
            line: int | None = None,
            column: int | None = None,
            effort: str | None = None,
            done: bool | None = None,
            fix: str | None = None,
            texts: Iterable[str] | None = None,
            elements: Iterable[Element] | None = None,
        ) -> None: ...


class Build(Element, metaclass=MetaEClass):
    """The memory that a compiled program needs."""

    board: str = EAttribute(eType=EString, lower=1)
    """Name of the board that it was compiled for."""
    flashBytes: int = EAttribute(eType=EInt)
    """Program memory in bytes."""
    flashLimit: int = EAttribute(eType=EInt)
    """Program memory of the board in bytes."""
    ramBytes: int = EAttribute(eType=EInt)
    """RAM in bytes without stack and heap."""
    ramLimit: int = EAttribute(eType=EInt)
    """RAM of the board in bytes."""
    stackBytes: int = EAttribute(eType=EInt)
    """Maximum stack in bytes, determined from its machine code; 0 if no bound is known."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            board: str | None = None,
            flashBytes: int | None = None,
            flashLimit: int | None = None,
            ramBytes: int | None = None,
            ramLimit: int | None = None,
            stackBytes: int | None = None,
        ) -> None: ...


class PlanFinding(PlanTask):
    """A note that needs no work."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            rule: str | None = None,
            severity: SeverityLevel | None = None,
            message: str | None = None,
            path: str | None = None,
            line: int | None = None,
            column: int | None = None,
            effort: str | None = None,
            done: bool | None = None,
            fix: str | None = None,
            texts: Iterable[str] | None = None,
            elements: Iterable[Element] | None = None,
        ) -> None: ...


class EarlierChoices(Element, metaclass=MetaEClass):
    """The history of choices (paper 3.3), for exchange."""

    choices: MutableSequence[EarlierChoice] = EReference(upper=-1, containment=True)
    """The choices."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            choices: Iterable[EarlierChoice] | None = None,
        ) -> None: ...


class EarlierChoice(Element, metaclass=MetaEClass):
    """How often a library was chosen for a part."""

    partId: str = EAttribute(eType=EString, default_value="")
    """Identifier of the part in its catalogue."""
    title: str = EAttribute(eType=EString, default_value="")
    """Title of the part."""
    library: str = EAttribute(eType=EString, lower=1)
    """Name of the library."""
    version: str = EAttribute(eType=EString, default_value="")
    """Its version."""
    target: str = EAttribute(eType=EString, default_value="")
    """The target board."""
    component: str = EAttribute(eType=EString, default_value="")
    """The component's last label in a drawing."""
    count: int = EAttribute(eType=EInt)
    """How often."""
    lastUsed: str = EAttribute(eType=EString, default_value="")
    """Day of the last choice, ISO 8601."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            partId: str | None = None,
            title: str | None = None,
            library: str | None = None,
            version: str | None = None,
            target: str | None = None,
            component: str | None = None,
            count: int | None = None,
            lastUsed: str | None = None,
        ) -> None: ...


if not TYPE_CHECKING:  # pyecore's descriptors, which the annotations above hide
    from robosmi.model.strict_package import EObject, classifier

    from ..ccode import (
        Call,
        Declaration,
        Function,
        Located,
        NameReference,
        Program,
        SourceUnit,
    )
    from ..hardware import Circuit, Component, Connector
    from ..platform import (
        Adapter,
        ApiFunction,
        ApiSymbol,
        Board,
        ConventionalPort,
        Library,
        Pin,
        PinConvention,
        Platform,
        Target,
    )
    from ..trace import Trace

    MigrationPlan.program.eType = Program
    MigrationPlan.circuit.eType = Circuit
    MigrationPlan.source.eType = Platform
    MigrationPlan.target.eType = Platform
    MigrationPlan.targetDescription.eType = Target
    MigrationPlan.board.eType = Board
    MigrationPlan.boardComponent.eType = Component
    MigrationPlan.move.eType = Move
    MigrationPlan.inputs.eType = Input
    MigrationPlan.dispositions.eType = Disposition
    MigrationPlan.connections.eType = Connection
    MigrationPlan.concurrency.eType = Concurrency
    MigrationPlan.portBindings.eType = PortBinding
    MigrationPlan.motorChannels.eType = MotorChannel
    MigrationPlan.portFlows.eType = PortFlow
    MigrationPlan.libraryChoices.eType = LibraryChoice
    MigrationPlan.ownLibraries.eType = Library
    MigrationPlan.adapterUses.eType = AdapterUse
    MigrationPlan.symbolUses.eType = SymbolUse
    MigrationPlan.helpers.eType = Adapter
    MigrationPlan.widenings.eType = Widening
    MigrationPlan.edits.eType = TextChange
    MigrationPlan.tasks.eType = PlanTask
    MigrationPlan.checks.eType = PlanTask
    MigrationPlan.findings.eType = PlanFinding
    MigrationPlan.build.eType = Build
    MigrationPlan.trace.eType = Trace
    Move.changes.eType = PlanChange
    Decision.options.eType = Option
    Decision.changes.eType = TextChange
    Disposition.element.eType = Located
    Disposition.hoisted.eType = TextCopy
    Widening.element.eType = Located
    Concurrency.starts.eType = Call
    Concurrency.functions.eType = Function
    Connection.pin.eType = Pin
    Connection.boardConnectors.eType = Connector
    Connection.component.eType = Component
    Connection.connectors.eType = Connector
    Connection.via.eType = Component
    Connection.speeds.eType = ServoSpeed
    MotorChannel.component.eType = Component
    MotorChannel.enable.eType = Pin
    MotorChannel.first.eType = Pin
    MotorChannel.second.eType = Pin
    MotorChannel.awake.eType = Pin
    PortBinding.element.eType = Located
    PortBinding.convention.eType = PinConvention
    PortBinding.conventionalPort.eType = ConventionalPort
    PortBinding.answer.eType = Connection
    PortBinding.connection.eType = Connection
    PortBinding.pin.eType = Pin
    PortFlow.bindings.eType = PortBinding
    PortFlow.calls.eType = Call
    LibraryChoice.component.eType = Component
    LibraryChoice.chosen.eType = Library
    LibraryChoice.candidates.eType = Library
    AdapterUse.result.eType = TargetType
    AdapterUse.parameters.eType = AdapterParameter
    AdapterUse.function.eType = ApiFunction
    AdapterUse.adapter.eType = Adapter
    AdapterUse.calls.eType = Call
    AdapterParameter.valueType.eType = TargetType
    TargetType.declarations.eType = Declaration
    SymbolUse.symbol.eType = ApiSymbol
    SymbolUse.adapter.eType = Adapter
    SymbolUse.uses.eType = NameReference
    TextChange.unit.eType = SourceUnit
    TextCopy.unit.eType = SourceUnit
    TextCopy.changes.eType = TextChange
    PlanTask.elements.eType = EObject
    EarlierChoices.choices.eType = EarlierChoice
    classifier(__name__, ChosenBy)
    classifier(__name__, Action)
    classifier(__name__, Step)
    classifier(__name__, AdapterStatus)
    classifier(__name__, SignatureSource)
    classifier(__name__, SeverityLevel)
    classifier(__name__, ProgramStructure)
    classifier(__name__, Widths)
    classifier(__name__, Signal)
    classifier(__name__, ChangeKind)
