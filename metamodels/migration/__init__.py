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
        """What says how an adapted function is declared."""

        inferred: ClassVar[SignatureSource]
        repository: ClassVar[SignatureSource]
        program: ClassVar[SignatureSource]

    class SeverityLevel(EnumLiteral):
        """How bad a finding is."""

        info: ClassVar[SeverityLevel]
        warning: ClassVar[SeverityLevel]
        error: ClassVar[SeverityLevel]

    class ProgramStructure(EnumLiteral):
        """Whether the main function of the program has an endless loop of its own."""

        loopForever: ClassVar[ProgramStructure]
        runOnce: ClassVar[ProgramStructure]

    class Widths(EnumLiteral):
        """What becomes of numbers that are narrower on the target: `keep` leaves the text as it is, `fix` writes it so that values stay what they are on the source."""

        keep: ClassVar[Widths]
        fix: ClassVar[Widths]

    class Signal(EnumLiteral):
        """Direction of a connection seen from the board."""

        read: ClassVar[Signal]
        write: ClassVar[Signal]
        bus: ClassVar[Signal]

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


class MigrationPlan(Element, metaclass=MetaEClass):
    """One migration of one program to one board."""

    name: str = EAttribute(eType=EString, lower=1)
    """Name of the sketch to be made."""
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
    inputs: MutableSequence[Input] = EReference(upper=-1, containment=True)
    """The files the plan was made from."""
    dispositions: MutableSequence[Disposition] = EReference(upper=-1, containment=True)
    """What happens to each element of the program."""
    connections: MutableSequence[Connection] = EReference(upper=-1, containment=True)
    """Which board pin reaches which component (paper, MAPPINGS)."""
    concurrency: Concurrency | None = EReference(containment=True)
    """How code runs that the program starts on other cores; none where it starts none, or the target has cores."""
    portBindings: MutableSequence[PortBinding] = EReference(upper=-1, containment=True)
    """Which port of the source is which connection of the target."""
    portFlows: MutableSequence[PortFlow] = EReference(upper=-1, containment=True)
    """Where numbers of ports go from the text to the platform functions that take them."""
    libraryChoices: MutableSequence[LibraryChoice] = EReference(
        upper=-1,
        containment=True,
    )
    """Which library drives which component."""
    adapterUses: MutableSequence[AdapterUse] = EReference(upper=-1, containment=True)
    """The platform functions that are called, and how each is adapted."""
    symbolUses: MutableSequence[SymbolUse] = EReference(upper=-1, containment=True)
    """The platform symbols that are used, and their placeholders."""
    helpers: MutableSequence[Adapter] = EReference(upper=-1)
    """Pieces of adapter text that the changed text of the program uses beyond those of functions and symbols, such as the look-up of ports."""
    widths: Widths = EAttribute(eType=Widths)
    """Whether the program's numbers keep the widths of the source."""
    widenings: MutableSequence[Widening] = EReference(upper=-1, containment=True)
    """What is written otherwise so that numbers keep the widths of the source: one for each declaration or macro."""
    edits: MutableSequence[TextChange] = EReference(upper=-1, containment=True)
    """Changes of the carried-over text that a person added to the plan; those of decisions belong to the decisions."""
    tasks: MutableSequence[PlanTask] = EReference(upper=-1, containment=True)
    """Work that is left for a person."""
    checks: MutableSequence[PlanTask] = EReference(upper=-1, containment=True)
    """What a person should see on the bench, one for each component that the program uses, before the robot runs on its own."""
    findings: MutableSequence[PlanFinding] = EReference(upper=-1, containment=True)
    """What is worth knowing."""
    build: Build | None = EReference(containment=True)
    """What the program took when it was compiled last, as it stands; none where it was not, or was changed since."""
    trace: Trace | None = EReference(containment=True)
    """Which elements each decision and each generated line comes from."""
    bench: bool = EAttribute(eType=EBoolean)
    """Whether a sketch that tries one component at a time is made beside the program."""

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
            inputs: Iterable[Input] | None = None,
            dispositions: Iterable[Disposition] | None = None,
            connections: Iterable[Connection] | None = None,
            concurrency: Concurrency | None = None,
            portBindings: Iterable[PortBinding] | None = None,
            portFlows: Iterable[PortFlow] | None = None,
            libraryChoices: Iterable[LibraryChoice] | None = None,
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


class Input(Element, metaclass=MetaEClass):
    """A file the plan was made from."""

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
    """Something that can be decided in more than one way."""

    confidence: float = EAttribute(eType=EDouble)
    """Between 0 and 1."""
    chosenBy: ChosenBy = EAttribute(eType=ChosenBy)
    """Who chose."""
    evidence: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """What speaks for the choice."""
    open: bool = EAttribute(eType=EBoolean)
    """True when nothing is chosen."""
    choice: str = EAttribute(eType=EString, default_value="")
    """What is chosen: the label of an option, what a person named instead, or the action of a disposition; empty when open."""
    chosenAt: str = EAttribute(eType=EString, default_value="")
    """When a person chose, in UTC (2026-05-01T12:00:00Z); empty where that is not recorded, as for flags and project files."""
    options: MutableSequence[Option] = EReference(upper=-1, containment=True)
    """The options, best first."""
    changes: MutableSequence[TextChange] = EReference(upper=-1, containment=True)
    """What the decision changes in the carried-over text."""

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
    """How well it does; comparable within one decision."""
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
    """What is done."""
    rules: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Ids of the rules that decided; more than one where several change the element's text."""
    reasons: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Why, one sentence for each rule."""
    element: Located | None = EReference()
    """The element."""
    inLoop: bool = EAttribute(eType=EBoolean)
    """True for a statement of main that belongs to the repeated part."""
    runsIn: str = EAttribute(eType=EString, default_value="")
    """Function of the target's program that is made for a statement of main behind its loop; empty for any other statement."""
    goesOnIn: str = EAttribute(eType=EString, default_value="")
    """Function of the target's program that goes on where a break or return leaves main's loop or main; empty for any other statement."""
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
    """How a declaration or macro keeps the widths that its numbers have on the source: `fix` with the changes of its text, `keep` without."""

    element: Located | None = EReference()
    """The declaration or macro; none for text that is in none, of code that is not compiled."""

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
    """How code that ran on cores of its own runs on a target with one core: as coroutines, which take turns when one of them waits. Its changes of text let loops give way that would wait for the others without end."""

    slots: int = EAttribute(eType=EInt)
    """How many run beside main at once."""
    stackBytes: int = EAttribute(eType=EInt)
    """Bytes of the stack of each."""
    loopGivesWay: bool = EAttribute(eType=EBoolean)
    """True when what main repeats waits each time, so that nothing has to be added for the others to get on."""
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
    """A connector of the board reaches a component (paper 3.2)."""

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
    """Passive components on the way."""
    restLevel: str = EAttribute(eType=EString, default_value="")
    """The level, low or high, that its pin gets before all else, so that what it drives does nothing; empty for none."""
    neutralMicroseconds: int = EAttribute(eType=EInt)
    """Width of the pulse at which the servo on it stands still, as a person has measured it; 0 where nobody has."""
    speeds: MutableSequence[ServoSpeed] = EReference(upper=-1, containment=True)
    """Pulses of the servo on it by speed, by ascending speeds, as a person has measured them."""

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
    """The pulse that a servo turns at a speed with."""

    speed: int = EAttribute(eType=EInt)
    """The speed, in the units of the function that is given it."""
    microseconds: int = EAttribute(eType=EInt)
    """Width of the pulse."""

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            speed: int | None = None,
            microseconds: int | None = None,
        ) -> None: ...


class PortBinding(Decision):
    """Which connection a port of the source becomes. A port is a number of the source board, whatever the text calls it; what a library uses by convention is a port of its own. Open, or with the choice none (not wired), it is no pin of the target."""

    name: str = EAttribute(eType=EString, lower=1)
    """Name of the first constant or variable that holds it, P12 for a bare number, or the role of a convention (abdrive.left_servo)."""
    names: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Further names of the port: of other constants that hold it, and P12 where the number means it alone."""
    sourcePin: int = EAttribute(eType=EInt, default_value=-1)
    """Its number on the source board, -1 when not known."""
    signal: Signal = EAttribute(eType=Signal)
    """Direction of its uses in the program."""
    origin: str = EAttribute(eType=EString, default_value="")
    """declaration (a constant or variable holds it), literal, runtime (reached by a loop, a range or the bits of a register), or convention."""
    what: str = EAttribute(eType=EString, default_value="")
    """What the source says is connected there."""
    element: Located | None = EReference()
    """The declaration or the first use."""
    role: str = EAttribute(eType=EString, default_value="")
    """The kind of component that the functions expect there (servo, ranger), empty where they do not say."""
    convention: PinConvention | None = EReference()
    """The convention of an API, if it is one."""
    conventionalPort: ConventionalPort | None = EReference()
    """The pin of an adapter that it says, if an adapter uses the port without being told."""
    answer: Connection | None = EReference()
    """Where the component answers, when it has a wire for each direction and the functions can serve both; none for one wire."""
    connection: Connection | None = EReference()
    """The connection chosen."""
    pin: Pin | None = EReference()
    """The pin chosen when no connection has it."""

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
            convention: PinConvention | None = None,
            conventionalPort: ConventionalPort | None = None,
            answer: Connection | None = None,
            connection: Connection | None = None,
            pin: Pin | None = None,
        ) -> None: ...


class PortFlow(Decision):
    """Values that can be exchanged on their way to pin parameters of platform functions, by assignment, parameters, results or macros. The choice is target: the constants are pins of the target, changed where they stand (by the port bindings); or source: all numbers stay as they are, and each call looks up the pin. Never both."""

    name: str = EAttribute(eType=EString, default_value="")
    """What the flow is called: its first names in the text, or the first call."""
    bindings: MutableSequence[PortBinding] = EReference(upper=-1)
    """The ports that the text can send through it, by number."""
    calls: MutableSequence[Call] = EReference(upper=-1)
    """The calls of platform functions that it reaches; those that macros make at each place where one is used."""
    anything: bool = EAttribute(eType=EBoolean)
    """Whether a number may go through it that the text does not say, so that a person may bind any port of the source."""

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
    """True when the program includes the chosen library, since something in it uses it."""

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
    """Its raw signature: as the source platform or the program declares it, or as the calls have it where nothing does."""
    targetName: str = EAttribute(eType=EString, default_value="")
    """What the adapter is called: its name, or another where the target has one of that name."""
    result: TargetType | None = EReference(containment=True)
    """The type of its value on the target."""
    parameters: MutableSequence[AdapterParameter] = EReference(
        upper=-1,
        containment=True,
    )
    """Its parameters on the target: types keep the width that they have on the source platform."""
    variadic: bool = EAttribute(eType=EBoolean)
    """True when it takes further arguments."""
    signatureSource: SignatureSource = EAttribute(eType=SignatureSource)
    """What says how it is declared: the platform repository, the program itself (the adapter's body stands where the program declares it), or nothing, so that it is inferred from the calls."""
    status: AdapterStatus = EAttribute(eType=AdapterStatus)
    """Its state."""
    notes: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """What is worth knowing about it."""
    function: ApiFunction | None = EReference()
    """The function."""
    adapter: Adapter | None = EReference()
    """The adapter that fills it, if any."""
    reason: str = EAttribute(eType=EString, default_value="")
    """Why nothing fills it: what is missing, for the person who does it; empty where an adapter does."""
    written: bool = EAttribute(eType=EBoolean)
    """True when a person has written its body in the program that was made before, so that it counts as filled."""
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
    """What a body that is still to be written gives back: 0, {}, or nothing for void."""
    declarations: MutableSequence[Declaration] = EReference(upper=-1)
    """The program's own types that it names."""

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
    """The declaration that is generated for it."""
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
    """A change of the carried-over text: new text takes the place of a range of a source unit. A change within the range that another one replaces has no effect; of two with the same range the first counts, in the order of the plan's edits, port bindings, dispositions, widenings."""

    unit: SourceUnit | None = EReference()
    """The unit."""
    startOffset: int = EAttribute(eType=EInt)
    """Offset of the first byte replaced."""
    endOffset: int = EAttribute(eType=EInt)
    """Offset behind the last byte replaced."""
    replacement: str = EAttribute(eType=EString, default_value="")
    """The new text."""
    rule: str = EAttribute(eType=EString, default_value="")
    """Id of the rule that wants it; empty for a person's edit."""
    reason: str = EAttribute(eType=EString, default_value="")
    """Why, one sentence."""
    step: Step = EAttribute(eType=Step)
    """The step of the method that wants it."""

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
    """Text that moves out of main: the range of a source unit with all changes in it that are not its disposition's own, then with changes that hold in the copy only. It stands at file scope, above main."""

    unit: SourceUnit | None = EReference()
    """The unit."""
    startOffset: int = EAttribute(eType=EInt)
    """Offset of the first byte copied."""
    endOffset: int = EAttribute(eType=EInt)
    """Offset behind the last byte copied."""
    changes: MutableSequence[TextChange] = EReference(upper=-1, containment=True)
    """Changes that hold in the copy only."""

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
    """Work that is left for a person."""

    rule: str = EAttribute(eType=EString, default_value="")
    """Id of the rule."""
    severity: SeverityLevel = EAttribute(eType=SeverityLevel)
    """How urgent."""
    message: str = EAttribute(eType=EString, default_value="")
    """What to do, one sentence."""
    path: str = EAttribute(eType=EString, default_value="")
    """File it is about, relative to the model's own folder."""
    line: int = EAttribute(eType=EInt)
    """Line in it, 0 for none."""
    column: int = EAttribute(eType=EInt)
    """Column in it, 0 for none."""
    effort: str = EAttribute(eType=EString, default_value="")
    """Rough effort: small, medium or large."""
    done: bool = EAttribute(eType=EBoolean)
    """True when a person has ticked it in the report that was made before."""
    fix: str = EAttribute(eType=EString, default_value="")
    """How, if known."""
    texts: MutableSequence[str] = EAttribute(eType=EString, upper=-1, unique=False)
    """Of a conflict: what a person has written, what was made last, what is made anew; else empty."""
    elements: MutableSequence[Element] = EReference(upper=-1)
    """Elements it is about."""

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
    """What a compiled program takes of its board."""

    board: str = EAttribute(eType=EString, lower=1)
    """Name of the board that it was compiled for."""
    flashBytes: int = EAttribute(eType=EInt)
    """Bytes of program memory."""
    flashLimit: int = EAttribute(eType=EInt)
    """Bytes of program memory that the board has for it."""
    ramBytes: int = EAttribute(eType=EInt)
    """Bytes of RAM without its stack and heap."""
    ramLimit: int = EAttribute(eType=EInt)
    """Bytes of RAM that the board has."""
    stackBytes: int = EAttribute(eType=EInt)
    """Bytes of stack that it takes at most, read off its code; 0 where no bound is known."""

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
    """Something worth knowing that needs no work."""

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
    """What the drawing called the component last."""
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
    MigrationPlan.inputs.eType = Input
    MigrationPlan.dispositions.eType = Disposition
    MigrationPlan.connections.eType = Connection
    MigrationPlan.concurrency.eType = Concurrency
    MigrationPlan.portBindings.eType = PortBinding
    MigrationPlan.portFlows.eType = PortFlow
    MigrationPlan.libraryChoices.eType = LibraryChoice
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
