"""The binding of a verification: where ports are on both boards, which device plays each, and what a scenario makes of them."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest
from msgspec.structs import replace

import robosmi
from robosmi.diagnostics import Location
from robosmi.errors import UsageError
from robosmi.transformations.chains.stages.models import load_models
from robosmi.transformations.verification.bound_devices.played_devices import brief_pins, played, signals_of
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort, bound_ports, resting_pins
from robosmi.transformations.verification.bound_devices.simulated_kinds import device_facts
from robosmi.transformations.verification.judgement.side_effects import foreign_pin
from robosmi.transformations.verification.search.scenario_inputs import reads_console, texts_understood
from robosmi.verify.scenario import Points, Scenario
from robosmi.verify.simulation import DeviceUse, PinChange, PinTrace

EXAMPLES = Path(__file__).resolve().parents[3] / "docs" / "examples"


def ports(name: str) -> dict[str, BoundPort]:
    """The bound ports of a case study by their pin on the source."""
    return {port.source: port for port in bound_ports(robosmi.plan_migration([EXAMPLES / name / f"{name}.c"]).plan)}


def test_the_ports_of_the_line_follower() -> None:
    found = ports("line_follower")
    assert {source: port.target for source, port in found.items() if port.target} == {
        "P6": "D10", "P7": "D11", "P8": "D12", "P12": "D8", "P13": "D9"
    }  # fmt: skip
    assert [found[pin].device for pin in ("P6", "P7", "P8", "P12")] == ["capacitor", "capacitor", "", ""]
    assert found["P8"].watched
    assert not found["P6"].watched
    assert "drive_speed" in found["P12"].functions
    assert found["P6"].component == "HIH4030 2"


def test_the_ports_of_the_monitoring_robot() -> None:
    found = ports("environmental_monitoring")
    assert {port.device for port in found.values()} == {"levels", "dht22", ""}
    assert found["P5"].pin == "signal"
    assert all(kind in device_facts() for kind in ("levels", "dht22", "capacitor", "ranger", "voltages"))


def test_the_ports_of_a_console_that_is_usb_have_no_pin(tmp_path: Path) -> None:
    program = tmp_path / "talk.c"
    program.write_text('#include "simpletext.h"\nint main() { simpleterm_reopen(31, 30, 0, 9600); print("hello"); }\n')
    for target, pins, console in (("pico", ("", ""), True), ("uno", ("D0", "D1"), False)):
        found = {port.source: port for port in bound_ports(robosmi.plan_migration([program], target=target).plan)}
        assert (found["P31"].target, found["P30"].target) == pins
        assert [found[port].console for port in ("P31", "P30")] == [console] * 2


def test_pins_that_no_channel_shows_are_brief() -> None:
    matrix = [
        BoundPort(name, f"P{n}", f"D{n + 2}", device="keypad", pin=name, group="P0") for n, name in enumerate(("row0", "column0"))
    ]
    lamp = BoundPort("lamp", "P2", "D4")
    driven = BoundPort("button", "P3", "D5", device="levels", pin="pin")
    assert brief_pins([*matrix, lamp, driven], target=False) == ["P0", "P1"]
    assert brief_pins([*matrix, lamp, driven], target=True) == ["D2", "D3"]
    assert brief_pins([*matrix, BoundPort("row's lamp", "P0", "D2")], target=False) == ["P1"]
    assert brief_pins([replace(matrix[0], shown=True), matrix[1]], target=False) == ["P1"]


PORTS = [
    BoundPort("eye", "P6", "D10", "Sensor", "1035", ("input",), "levels", "pin"),
    BoundPort("air", "P5", "D7", "DHT22", "7", ("dht22_read",), "dht22", "signal"),
    BoundPort("lamp", "P8", "D12", "LED", "9", ("high",)),
    BoundPort("far", "P9", "", device="levels", pin="pin"),
]


def test_devices_are_at_the_pins_of_either_board_and_rest_where_nothing_is_said() -> None:
    scenario = Scenario("s", 1000.0, {"Sensor": {"points": ((500.0, 1),)}, "air": {"humidity": ((0.0, 90),)}})
    assert played(PORTS, scenario, target=True) == [
        DeviceUse("levels", {"pin": "D10"}, {"points": [[0.0, 0], [500.0, 1]]}),
        DeviceUse("dht22", {"signal": "D7"}, {"humidity": [[0.0, 90]], "celsius": [[0.0, 21]]}),
    ]
    assert [use.pins for use in played(PORTS, None, target=False)] == [{"pin": "P6"}, {"signal": "P5"}, {"pin": "P9"}]
    typed = played(PORTS, Scenario("s", 1000.0, {"console": {"points": ((100.0, "go"),)}}), target=True)
    assert typed[-1] == DeviceUse("typing", {}, {"points": [[100.0, "go"]]})


@pytest.mark.parametrize("name", ["Sensor", "eye", "#1035", "P6", "D10"])
def test_a_signal_is_named_by_component_port_or_pin(name: str) -> None:
    assert [*signals_of(PORTS, Scenario("s", 1.0, {name: {"points": ((0.0, 1),)}}))] == [0]


def test_two_signals_of_one_device_are_refused() -> None:
    signals = {"eye": {"points": ((0.0, 1),)}, "Sensor": {"points": ((5.0, 0),)}}
    with pytest.raises(UsageError, match="a signal for 'eye' and for 'Sensor', but both are the same device"):
        signals_of(PORTS, Scenario("s", 1.0, signals))


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("Sensr", r"but there is no such component, port or pin \(did you mean 'Sensor'\?\)"),
        ("LED", "the program does not read it"),
    ],
)
def test_a_signal_of_nothing_is_wrong_usage(name: str, message: str) -> None:
    with pytest.raises(UsageError, match=message):
        signals_of(PORTS, Scenario("s", 1.0, {name: {"points": ((0.0, 1),)}}))


@pytest.mark.parametrize(
    "signals",
    [
        {"nope": {"points": ((0.0, 1),)}},
        {"LED": {"points": ((0.0, 1),)}},
        {"Sensor": {"points": ((0.0, 7),)}},
        {"Sensor": {"points": ((0.0, 1),)}, "eye": {"points": ((0.0, 1),)}},
        {"console": {"text": ((0.0, "go"),)}},
        {"console": {"points": ((0.0, 5),)}},
    ],
)
def test_what_is_wrong_with_a_signal_is_told_with_the_file_of_the_scenario(signals: dict[str, dict[str, Points]]) -> None:
    with pytest.raises(UsageError) as caught:
        signals_of(PORTS, Scenario("s", 1.0, signals, path=Path("dark.toml")))
    assert caught.value.location == Location("dark.toml")


TWO_ON_ONE = """#include "simpletools.h"
#include "abdrive.h"
int lamp = 13;
int main() { high(lamp); drive_speed(10, 10); }
"""


def test_two_ports_of_the_target_that_are_one_pin_of_the_source_are_not_compared(tmp_path: Path) -> None:
    source = tmp_path / "rover.c"
    source.write_text(TWO_ON_ONE)
    bind = {"abdrive.left_servo": "D8", "abdrive.right_servo": "D9", "lamp": "D4"}
    found = bound_ports(robosmi.plan_migration([source], bind=bind).plan)
    at_13 = [port for port in found if port.source == "P13"]
    assert {(port.name, port.target, port.shares_with) for port in at_13} == {
        ("abdrive.right_servo", "D9", "lamp"), ("lamp", "D4", "abdrive.right_servo")
    }  # fmt: skip
    assert not any(port.watched or port.compared for port in at_13)
    assert next(port for port in found if port.source == "P12").watched


def bodied(tmp_path: Path, body: str) -> dict[str, tuple[str, str, bool]]:
    """Port -> the device there, the device's name for it, and whether the program's actions there are compared as well."""
    source = tmp_path / "robot.c"
    source.write_text(f'#include "simpletools.h"\n{body}\n')
    plan = robosmi.plan_migration([source], bind={f"P{n}": f"D{n}" for n in (3, 4, 5, 6) if f"({n}" in body}).plan
    return {port.source: (port.device, port.pin, port.watched) for port in bound_ports(plan)}


@pytest.mark.parametrize(
    ("body", "found"),
    [
        ("int main() { set_direction(3, 0); while (1) if (input(3)) high(4); }", {"P3": ("levels", "pin", False)}),
        ("int main() { while (1) { low(3); if (input(3)) high(4); } }", {"P3": ("levels", "pin", False)}),
        ("int main() { while (1) { high(3); pause(1); if (input(3)) high(4); } }", {"P3": ("capacitor", "pin", False)}),
        ("int main() { set_output(3, 1); set_direction(3, 1); while (input(3)) ; }", {"P3": ("capacitor", "pin", False)}),
        ("int main() { low(3); high(3); pause(1); low(3); return pulse_in(3, 1); }", {"P3": ("ranger", "signal", False)}),
        ("int main() { low(3); return pulse_in(3, 1); }", {"P3": ("levels", "pin", False)}),
    ],
)  # fmt: skip
def test_what_a_program_does_to_a_port_tells_the_device_there(
    tmp_path: Path, body: str, found: dict[str, tuple[str, str, bool]]
) -> None:
    assert bodied(tmp_path, body).items() >= found.items()


ASKED = ("two_pin_ranger", "trigger", True)
HEARD = ("two_pin_ranger", "echo", False)


@pytest.mark.parametrize(
    ("body", "found"),
    [
        ("int main() { low(3); low(4); while (1) { pulse_out(3, 10); high(5); print(\"%d\", pulse_in(4, 1)); } }",
            {"P5": ASKED, "P4": HEARD, "P3": ("", "", True)}),
        ("int main() { while (1) { low(4); pulse_out(3, 10); print(\"%d\", pulse_in(4, 1)); } }", {"P3": ASKED, "P4": HEARD}),
        ("int main() { while (1) { low(3); high(3); pause(1); low(3); print(\"%d\", pulse_in(4, 1)); } }",
            {"P3": ASKED, "P4": HEARD}),
        ("long cm(int t, int e) { pulse_out(t, 10); return pulse_in(e, 1) / 58; }\nint main() { return cm(3, 4) + cm(5, 6); }",
            {"P3": ASKED, "P4": HEARD, "P5": ASKED, "P6": HEARD}),
        ("void ask() { pulse_out(3, 10); }\nint main() { ask(); return pulse_in(4, 1); }",
            {"P3": ("", "", True), "P4": ("levels", "pin", False)}),
    ],
)  # fmt: skip
def test_a_device_that_is_asked_at_one_port_answers_at_the_next_one_that_is_heard(
    tmp_path: Path, body: str, found: dict[str, tuple[str, str, bool]]
) -> None:
    assert bodied(tmp_path, body).items() >= found.items()


READS = re.compile(
    r"(get|read)(Char|Byte|Str|Dec|Float|Bin|Hex)|[df]?scan[if]?|f?gets|f?getc|getchar|"
    r"\w+_rx(Char|Check|Time|Peek|Ready|Count)"
)
TEXTS = ("simpletext", "fdserial", "serial", "stdio")


def test_every_function_that_reads_what_is_typed_is_known_to_do_so() -> None:
    """All adapters of the headers for texts, by their names: what is read through a device may be the console, too."""
    folder = Path(robosmi.__file__).parents[1] / "platform_repo" / "arduino" / "adapters" / "propeller"
    names = {name for header in TEXTS for name in re.findall(r"(?m)^//# adapter (\w+)", (folder / f"{header}.cpp").read_text())}
    reading = {name for name in names if READS.fullmatch(name)}
    assert len(reading) > 25
    devices = tomllib.loads((folder.parents[2] / "propeller" / "devices.toml").read_text())
    assert reading <= set(devices["console"]["reads"])


def test_a_console_that_the_program_opens_itself_is_typed_at(tmp_path: Path) -> None:
    source = tmp_path / "keys.c"
    opens = "fdserial *term; int main() { simpleterm_close(); term = fdserial_open(31, 30, 0, 115200); %s }"
    for body, reads in (("if (fdserial_rxTime(term, 50) == 'w') high(4);", True), ("fdserial_txChar(term, 'w');", False)):
        source.write_text('#include "simpletools.h"\n#include "fdserial.h"\n' + opens % body)
        assert reads_console(robosmi.plan_migration([source]).plan) is reads


def test_pins_that_are_held_at_rest_are_told_with_their_levels(tmp_path: Path) -> None:
    (tmp_path / "p.c").write_text('#include "simpletools.h"\nint main() { print("on"); }')
    (tmp_path / "h.csv").write_text("pin,part,title,connector\nD9,Continuous Servo,wheel,pulse\nD7,Button,key,1\n")
    plan = robosmi.plan_migration([tmp_path / "p.c"], hardware=tmp_path / "h.csv").plan
    assert resting_pins(plan) == {"D9": 0}


GATE = """//# header gate.h

//# adapter gate_open
//#   for: int gate_open(int number)
//#   kind: oneToOne
//#   port: GATE_SWITCH = gate.switch 7 digital in
//#   fidelity: one switch, whatever its number
inline int32_t gate_open(int32_t number) {
  (void)number;
  pinMode(GATE_SWITCH, INPUT);
  return digitalRead(GATE_SWITCH);
}
"""


@pytest.mark.processes
def test_a_port_at_which_an_own_adapter_reads_is_played(tmp_path: Path) -> None:
    (tmp_path / "adapters").mkdir()
    (tmp_path / "adapters" / "gate.cpp").write_text(GATE)
    (tmp_path / "robosmi.toml").write_text('[bind]\n"gate.switch" = "D4"\nP5 = "D5"\n')
    (tmp_path / "robot.c").write_text(
        '#include "simpletools.h"\n#include "gate.h"\nint main() { while (1) { if (gate_open(1)) high(5); else low(5); } }\n'
    )
    robosmi.migrate([tmp_path / "robot.c"], tmp_path / "out")
    found = {port.name: port for port in bound_ports(load_models(tmp_path / "out" / "models" / "plan.xmi").plan)}
    assert [(found[name].target, found[name].device) for name in ("gate.switch", "P5")] == [("D4", "levels"), ("D5", "")]


KNOB = """//# header knob.h

//# adapter knob_is
//#   for: int knob_is(int level, int pin)
//#   kind: oneToOne
//#   pin: at digital {way}
//#   fidelity: whether the pin has that level
inline int32_t knob_is(int32_t level, int32_t at) {{
  pinMode(at, INPUT);
  return digitalRead(at) == level;
}}
"""


@pytest.mark.processes
@pytest.mark.parametrize(("way", "device"), [("in", "levels"), ("out", ""), ("both", ""), ("in ranger", "")])
def test_a_port_that_an_own_adapter_reads_by_its_argument_is_played(tmp_path: Path, way: str, device: str) -> None:
    (tmp_path / "adapters").mkdir()
    (tmp_path / "adapters" / "knob.cpp").write_text(KNOB.format(way=way))
    (tmp_path / "robosmi.toml").write_text('[bind]\nP4 = "D4"\nP5 = "D5"\n')
    (tmp_path / "robot.c").write_text(
        '#include "simpletools.h"\n#include "knob.h"\nint main() { while (1) { if (knob_is(1, 4)) high(5); else low(5); } }\n'
    )
    robosmi.migrate([tmp_path / "robot.c"], tmp_path / "out")
    found = {port.name: port for port in bound_ports(load_models(tmp_path / "out" / "models" / "plan.xmi").plan)}
    assert [(found[name].target, found[name].device) for name in ("P4", "P5")] == [("D4", device), ("D5", "")]
    if device:
        signals_of(list(found.values()), Scenario("pressed", 1_000.0, {"D4": {"points": ((0.0, 0), (700.0, 1))}}))


def test_the_texts_of_tables_are_typed_where_a_program_compares_with_variables(tmp_path: Path) -> None:
    (tmp_path / "menu.c").write_text("""#include "simpletools.h"
struct cmd { const char *name; int step; } cmds[] = { {"faster", 5}, {"slower", -5}, {0, 0} };
char line[20];
int main() {
  int n, speed = 0;
  while (1) {
    scan("%s %d\\n", line, &n);
    for (int i = 0; cmds[i].name; i++)
      if (!strcmp(line, cmds[i].name)) speed += n * cmds[i].step;
    print("%d\\n", speed);
  }
}
""")
    texts = texts_understood(robosmi.plan_migration([tmp_path / "menu.c"]).plan)
    assert {"faster\r", "slower\r", "faster 50\r", "slower 70000\r"} <= set(texts)


def test_a_light_of_the_core_is_no_pin_of_the_sketch(tmp_path: Path) -> None:
    (tmp_path / "p.c").write_text('#include "simpletools.h"\nint main() { high(5); }')
    plan = robosmi.plan_migration([tmp_path / "p.c"], target="micro").plan
    trace = PinTrace("e", "running", 1e6, tuple(PinChange(at, "D17", level) for at, level in ((9.0, 1), (1100.0, 0))), (), (), ())
    nothing = PinTrace("e", "running", 1e6, (), (), (), ())
    assert foreign_pin(nothing, trace, [], resting_pins(plan)) is None
    found = foreign_pin(nothing, trace, [], {})
    assert found is not None
    assert found.channel == "D17"
