"""For every constraint an example that satisfies it and one that does not: rule -> (passing model, failing model)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from robosmi.metamodels import ccode, hardware, migration, platform


def a_plan(**features: Any) -> migration.MigrationPlan:
    """A plan with a program of one statement, a board with two pins, a target platform with one library."""
    board = platform.Board(name="b", title="Board", pins=[platform.Pin(label="D1"), platform.Pin(label="D2")])
    target = platform.Platform(name="target", libraries=[platform.Library(name="Servo")])
    unit = ccode.SourceUnit(path="a.c", size=100, declarations=[ccode.Variable(name="v", line=1, startOffset=0, endOffset=5)])
    program = ccode.Program(name="p", units=[unit])
    made = migration.MigrationPlan(name="p", toolVersion="0", program=program, target=target, board=board)
    for name, value in features.items():
        getattr(made, name).extend(value(made))
    return made


def pins(plan: migration.MigrationPlan) -> list[platform.Pin]:
    """The pins of the plan's board."""
    assert plan.board is not None
    return list(plan.board.pins)


def variable(plan: migration.MigrationPlan) -> Any:
    """The one declaration of the plan's program."""
    assert plan.program is not None
    return plan.program.units[0].declarations[0]


def bound(*numbers: int) -> migration.MigrationPlan:
    """A plan whose source ports 0, 1 ... are bound to pins of these numbers."""
    return a_plan(
        portBindings=lambda p: [
            migration.PortBinding(name=f"n{i}", sourcePin=i, pin=pins(p)[n], choice="x") for i, n in enumerate(numbers)
        ]
    )


def also_called(*numbers: int) -> migration.MigrationPlan:
    """A plan whose source port 12, under several names, is bound to pins of these numbers."""
    return a_plan(
        portBindings=lambda p: [
            migration.PortBinding(name=f"n{i}", sourcePin=12, pin=pins(p)[n], choice="x", origin="convention" if i else "")
            for i, n in enumerate(numbers)
        ]
    )


def decided(*numbers: int) -> migration.MigrationPlan:
    """A plan with flows and a binding for each of these source ports."""
    return a_plan(
        portFlows=lambda p: [migration.PortFlow(name="f", choice="target")],
        portBindings=lambda p: [migration.PortBinding(name=f"n{i}", sourcePin=n, choice="none") for i, n in enumerate(numbers)],
    )


def on_one_pin(count: int) -> migration.MigrationPlan:
    """A plan whose first pin reaches so many components."""

    def made(plan: migration.MigrationPlan) -> list[migration.Connection]:
        parts = [hardware.Component(elementId=str(i), title=f"Led{i}") for i in range(count)]
        signal = migration.Signal.write
        return [migration.Connection(name=p.title, component=p, pin=pins(plan)[0], signal=signal) for p in parts]

    return a_plan(connections=made)


def decided_on(element: Callable[[migration.MigrationPlan], Any]) -> migration.MigrationPlan:
    """A plan with a decision about an element."""
    return a_plan(dispositions=lambda p: [migration.Disposition(element=element(p), rules=["r"])])


def of_a_board(pin: Callable[[migration.MigrationPlan], platform.Pin]) -> migration.MigrationPlan:
    """A plan whose port is bound to a pin."""
    return a_plan(portBindings=lambda p: [migration.PortBinding(name="n", pin=pin(p), choice="x")])


def connected(number: int) -> migration.MigrationPlan:
    """A plan whose port is bound to a connection of the first pin, and to a pin of that number."""

    def binding(plan: migration.MigrationPlan) -> list[migration.PortBinding]:
        connection = migration.Connection(name="LedP1", pin=pins(plan)[0])
        plan.connections.append(connection)
        return [migration.PortBinding(name="n", pin=pins(plan)[number], connection=connection, choice="x")]

    return a_plan(portBindings=binding)


def chosen_as(choice: str, text: str) -> migration.MigrationPlan:
    """A plan whose port is bound to the first pin, with this recorded choice and this text in place of its number."""

    def binding(plan: migration.MigrationPlan) -> list[migration.PortBinding]:
        change = migration.TextChange(rule="port", replacement=text, endOffset=1)
        return [migration.PortBinding(name="n", pin=pins(plan)[0], choice=choice, changes=[change])]

    return a_plan(portBindings=binding)


def beside_the_console(function: str) -> migration.MigrationPlan:
    """A plan whose port a person put on a pin of the console's serial line, with a program that calls a function."""
    made = a_plan(portBindings=lambda p: [migration.PortBinding(name="n", pin=pins(p)[0], choice="D1")])
    made.portBindings[0].chosenBy = migration.ChosenBy.person
    pins(made)[0].reserved = "serial line"
    pins(made)[0].abilities.append("uart")
    meaning = platform.Meaning.text if function == "print" else platform.Meaning.pin
    declared = platform.ApiFunction(name=function, parameters=[platform.ApiParameter(name="a", meaning=meaning)])
    made.source = platform.Platform(name="source", headers=[platform.Header(name="h.h", functions=[declared])])
    made.adapterUses.append(migration.AdapterUse(name=function, function=declared, calls=[ccode.Call(calleeName=function)]))
    return made


def ranged(*signals: migration.Signal) -> migration.MigrationPlan:
    """A plan with a distance sensor of one or more wires, whose port is bound for a function that uses one wire."""
    sensor = hardware.Component(elementId="1", title="eye")

    def wired(plan: migration.MigrationPlan) -> list[migration.Connection]:
        return [
            migration.Connection(name=f"eye{n}", component=sensor, pin=pins(plan)[n], signal=signal)
            for n, signal in enumerate(signals)
        ]

    made = a_plan(connections=wired, portBindings=lambda p: [migration.PortBinding(name="n", pin=pins(p)[0], choice="D0")])
    assert made.target is not None
    wire = platform.AdapterPin(name="pin", direction=platform.Direction.both, componentRole="ranger")
    adapter = platform.Adapter(name="ping_cm", pins=[wire])
    made.target.adapters.append(adapter)
    call = ccode.Call(calleeName="ping_cm")
    made.adapterUses.append(migration.AdapterUse(name="ping_cm", adapter=adapter, calls=[call]))
    made.portFlows.append(migration.PortFlow(name="n", bindings=list(made.portBindings), calls=[call]))
    return made


def expecting(role: str, title: str) -> migration.MigrationPlan:
    """A plan whose port a person binds to a component of that title, and whose functions expect a kind of component."""

    def binding(plan: migration.MigrationPlan) -> list[migration.PortBinding]:
        part = hardware.Component(elementId="1", title=title, role=hardware.Role.Output)
        connection = migration.Connection(name="x", component=part, pin=pins(plan)[0], signal=migration.Signal.write)
        plan.connections.append(connection)
        return [
            migration.PortBinding(
                name="n", role=role, chosenBy=migration.ChosenBy.person, connection=connection, pin=pins(plan)[0], choice="x",
                signal=migration.Signal.write,
            )
        ]  # fmt: skip

    return a_plan(portBindings=binding)


def dimmed(timer: str, taken: str) -> migration.MigrationPlan:
    """A plan with `dac_ctr` on a pin whose PWM uses a timer, if any, beside an adapter that takes a timer."""
    made = a_plan(portBindings=lambda p: [migration.PortBinding(name="n", sourcePin=4)])
    assert made.target is not None
    assert made.board is not None
    pin = platform.Pin(label="D9", abilities=["digital", *["pwm"] * bool(timer)], timer=timer)
    made.board.pins.append(pin)
    made.portBindings[0].pin = pin
    adapter = platform.Adapter(
        name="dac_ctr", signatures=["void dac_ctr(int pin, int channel, int dacVal)"],
        pins=[platform.AdapterPin(name="pin", capability=platform.PinCapability.pwm)],
    )  # fmt: skip
    other = platform.Adapter(name="servo_angle", timers=[taken])
    made.target.adapters.extend([adapter, other])
    call = ccode.Call(calleeName="dac_ctr")
    made.adapterUses.append(migration.AdapterUse(name="dac_ctr", adapter=adapter, calls=[call]))
    made.adapterUses.append(migration.AdapterUse(name="servo_angle", adapter=other))
    made.portFlows.append(migration.PortFlow(name="n", bindings=list(made.portBindings), calls=[call]))
    return made


def moving(servos: int) -> migration.MigrationPlan:
    """A plan with so many servos, each on a pin of its own, on a target that makes pulses for two."""
    made = a_plan()
    assert made.target is not None
    assert made.board is not None
    adapter = platform.Adapter(name="servo_angle", needs=[platform.Adapter(name="ServoPin", mostServos=2)])
    made.target.adapters.extend([*adapter.needs, adapter])
    made.adapterUses.append(migration.AdapterUse(name="servo_angle", adapter=adapter))
    for number in range(servos):
        pin = platform.Pin(label=f"D{number + 3}")
        made.board.pins.append(pin)
        made.portBindings.append(
            migration.PortBinding(name=f"n{number}", sourcePin=number, pin=pin, choice=pin.label, role="servo")
        )
    return made


def talking(other: str) -> migration.MigrationPlan:
    """A plan with a serial line whose first port is the console and whose second port is there, too, or on a pin."""
    made = a_plan(
        portBindings=lambda p: [
            migration.PortBinding(name="rx", sourcePin=31, choice="console"),
            migration.PortBinding(name="tx", sourcePin=30, choice=other, pin=pins(p)[0] if other != "console" else None),
        ]
    )
    call = ccode.Call(calleeName="fdserial_open")
    made.portFlows.extend(migration.PortFlow(name=b.name, bindings=[b], calls=[call]) for b in list(made.portBindings))
    return made


def driven(encoder: str) -> migration.MigrationPlan:
    """A plan with `drive_goto`, whose adapter requires an encoder, and with this choice for the encoder's port."""
    made = a_plan(portBindings=lambda p: [migration.PortBinding(name="left_encoder", sourcePin=14, choice=encoder, open=False)])
    assert made.target is not None
    port = platform.ConventionalPort(constant="left", name="left_encoder", componentRole="encoder")
    adapter = platform.Adapter(name="drive_goto", componentRole="encoder", ports=[port])
    made.target.adapters.append(adapter)
    if encoder != "none":
        assert made.board is not None
        pin = platform.Pin(label=encoder, abilities=["digital"])
        made.board.pins.append(pin)
        made.portBindings[0].pin = pin
    made.portBindings[0].conventionalPort = port
    made.portBindings[0].signal = migration.Signal.read
    made.adapterUses.append(migration.AdapterUse(name="drive_goto", adapter=adapter, calls=[ccode.Call(calleeName="drive_goto")]))
    return made


def flowing(inside: bool) -> migration.MigrationPlan:
    """A plan with a call of an adapter that takes a pin, in a flow or in none."""
    made = a_plan()
    assert made.target is not None
    adapter = platform.Adapter(name="high", pins=[platform.AdapterPin(name="pin")])
    made.target.adapters.append(adapter)
    call = ccode.Call(calleeName="high", line=3)
    made.adapterUses.append(migration.AdapterUse(name="high", adapter=adapter, calls=[call]))
    made.portFlows.append(migration.PortFlow(name="n", calls=[call] if inside else []))
    return made


def recorded(choice: str) -> migration.MigrationPlan:
    """A plan in which a library is chosen, with this recorded choice."""
    return a_plan(libraryChoices=lambda p: [migration.LibraryChoice(chosen=own_library(p), choice=choice)])


def adapted(*names: str) -> migration.MigrationPlan:
    """A plan whose function `f` is adapted by adapters of these names, one use each."""

    def used(plan: migration.MigrationPlan) -> list[migration.AdapterUse]:
        assert plan.target is not None
        made = [platform.Adapter(name=name) for name in names]
        plan.target.adapters.extend(made)
        return [migration.AdapterUse(name="f", adapter=adapter) for adapter in made]

    return a_plan(adapterUses=used)


def numbered(number: int) -> migration.MigrationPlan:
    """A plan of a source with eight ports that binds the port of this number to nothing."""
    made = a_plan(portBindings=lambda p: [migration.PortBinding(name="n", sourcePin=number, choice="none")])
    made.source = platform.Platform(name="source", portCount=8)
    return made


def with_library(chosen: Callable[[migration.MigrationPlan], platform.Library]) -> migration.MigrationPlan:
    """A plan in which a library is chosen for a component."""
    return a_plan(libraryChoices=lambda p: [migration.LibraryChoice(chosen=chosen(p), choice=str(chosen(p).name))])


def confident(confidence: float, is_open: bool = False) -> migration.MigrationPlan:
    """A plan with one binding."""
    return a_plan(portBindings=lambda p: [migration.PortBinding(name="n", confidence=confidence, open=is_open)])


def edited(*ranges: tuple[int, int]) -> migration.MigrationPlan:
    """A plan with edits of its unit."""

    def made(plan: migration.MigrationPlan) -> list[migration.TextChange]:
        assert plan.program is not None
        return [migration.TextChange(unit=plan.program.units[0], startOffset=a, endOffset=b) for a, b in ranges]

    return a_plan(edits=made)


def a_program(*declarations: ccode.Declaration) -> ccode.Program:
    """A program of one unit."""
    return ccode.Program(name="p", units=[ccode.SourceUnit(path="a.c", declarations=list(declarations))])


def function(name: str, parameters: int = 0, calls: tuple[ccode.Call, ...] = (), **features: Any) -> ccode.Function:
    """A function that is defined."""
    statements = [ccode.ExpressionStatement(expression=call) for call in calls]
    taken = [ccode.Parameter(name=f"p{i}") for i in range(parameters)]
    return ccode.Function(name=name, definition=True, parameters=taken, body=ccode.Block(statements=statements), **features)


def calling(arguments: int) -> ccode.Program:
    """A program with a call of a function of one parameter."""
    called = function("f", 1)
    call = ccode.Call(calleeName="f", callee=called, arguments=[ccode.IntegerLiteral(value=i) for i in range(arguments)])
    return a_program(called, function("main", calls=(call,)))


def a_circuit(*titles: str, nets: int = 1, **features: Any) -> hardware.Circuit:
    """A circuit with components of these titles and some nets."""
    components = [
        hardware.Component(elementId=str(i), title=t, connectors=[hardware.Connector(connectorId="c", name="C")])
        for i, t in enumerate(titles)
    ]
    return hardware.Circuit(name="c", components=components, nets=[hardware.Net(name=f"n{i}") for i in range(nets)], **features)


def on_a_net(own: bool) -> hardware.Circuit:
    """A circuit with a connector on a net, its own or another circuit's."""
    made, other = a_circuit("a"), a_circuit("b")
    made.components[0].connectors[0].net = (made if own else other).nets[0]
    return made


def wired(same: bool) -> hardware.Circuit:
    """A circuit with a wire, whose end is on the wire's net or on another."""
    made = a_circuit("a", nets=2)
    end = made.components[0].connectors[0]
    end.net = made.nets[0]
    made.wires.append(hardware.Wire(elementId="w", ends=[end], net=made.nets[0 if same else 1]))
    return made


def foreign_pin(_: migration.MigrationPlan) -> platform.Pin:
    """A pin of another board."""
    return platform.Board(name="other", pins=[platform.Pin(label="X")]).pins[0]


def own_library(plan: migration.MigrationPlan) -> platform.Library:
    """The library of the plan's target platform."""
    assert plan.target is not None
    return plan.target.libraries[0]


def at(start: int, end: int) -> ccode.Program:
    """A program with an element at these bytes."""
    return a_program(ccode.Variable(name="v", startOffset=start, endOffset=end))


EXAMPLES: dict[str, tuple[Callable[[], Any], Callable[[], Any]]] = {
    "RS701": (lambda: decided_on(variable), lambda: decided_on(lambda p: ccode.Variable(name="elsewhere"))),
    "RS702": (lambda: bound(0, 1), lambda: bound(0, 0)),
    "RS731": (lambda: also_called(0, 0), lambda: also_called(0, 1)),
    "RS703": (lambda: of_a_board(lambda p: pins(p)[0]), lambda: of_a_board(foreign_pin)),
    "RS704": (lambda: connected(0), lambda: connected(1)),
    "RS705": (lambda: confident(0.5), lambda: confident(1.5)),
    "RS706": (lambda: confident(1.0), lambda: confident(0.0, True)),
    "RS707": (lambda: with_library(own_library), lambda: with_library(lambda p: platform.Library(name="Foreign"))),
    "RS727": (lambda: expecting("servo", "Servo1"), lambda: expecting("servo", "LED1")),
    "RS708": (lambda: edited((0, 5), (5, 9)), lambda: edited((0, 5), (4, 9))),
    "RS711": (lambda: at(3, 9), lambda: at(9, 3)),
    "RS712": (lambda: calling(1), lambda: calling(2)),
    "RS709": (lambda: edited((0, 100)), lambda: edited((90, 101))),
    "RS717": (lambda: adapted("f"), lambda: adapted("g")),
    "RS718": (lambda: adapted("f"), lambda: adapted("f", "f")),
    "RS719": (lambda: numbered(7), lambda: numbered(8)),
    "RS716": (lambda: chosen_as("D2", "7"), lambda: chosen_as("D2", "D1")),
    "RS720": (lambda: beside_the_console("high"), lambda: beside_the_console("print")),
    "RS725": (lambda: ranged(migration.Signal.bus), lambda: ranged(migration.Signal.write, migration.Signal.read)),
    "RS726": (lambda: dimmed("Timer1", "Timer2"), lambda: dimmed("Timer1", "Timer1")),
    "RS733": (lambda: talking("console"), lambda: talking("D1")),
    "RS732": (lambda: moving(2), lambda: moving(4)),
    "RS730": (lambda: driven("D4"), lambda: driven("none")),
    "RS728": (lambda: flowing(True), lambda: flowing(False)),
    "RS729": (lambda: recorded("Servo"), lambda: recorded("DHT")),
    "RS724": (lambda: on_one_pin(1), lambda: on_one_pin(2)),
    "RS715": (lambda: on_one_pin(1), lambda: on_one_pin(3)),
    "RS714": (lambda: decided(1, 2, -1, -1), lambda: decided(1, 2, 1)),
    "RS713": (
        lambda: a_program(function("f"), function("f", storage=ccode.Storage.staticStorage), function("g")),
        lambda: a_program(function("f"), function("f")),
    ),
    "RS721": (lambda: a_circuit("Servo1", "Servo2"), lambda: a_circuit("Servo1", "Servo1")),
    "RS722": (lambda: on_a_net(True), lambda: on_a_net(False)),
    "RS723": (lambda: wired(True), lambda: wired(False)),
}
