"""arlodrive.h: a motor controller on one line. Semantics of the library's sources (libarlodrive, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import pytest

from robosmi.verify.simulation import DeviceUse, PinTrace
from tests.adapters.bench import Uno, proves

SAY = "void say(int32_t number) { Serial.print(number); Serial.print(' '); }"


def a(*names: str) -> list[str]:
    """The `header/name` of these functions of arlodrive.h."""
    return [f"arlodrive.h/{name}" for name in names]


def controller(answers: Mapping[str, Sequence[str]]) -> DeviceUse:
    """The controller on its line."""
    return DeviceUse("answering_line", {"line": "D8"}, {"answers": {"verb 1": ["verbose"], **answers}})


def commands(trace: PinTrace) -> list[str]:
    """What the controller was told."""
    assert [event for event in trace.device_events if event.what == "framing"] == []
    return [str(event.value) for event in trace.device_events if event.what == "command"]


WIRED = {"arlodrive.line": "8"}


def arlo(uno: Uno) -> Uno:
    """The bench with the drive's line at D8."""
    return replace(uno, ports=WIRED)


@proves(*a("drive_open", "dhb10_com", "drive_getTicks", "drive_getSpeed", "drive_clearTicks"))
def the_controller_is_asked_and_answers(uno: Uno) -> None:
    program = f"""{SAY}
int32_t left = -1, right = -1; int l = 5, r = 6;
void setup() {{ Serial.begin(115200); Serial.print(drive_open()); say(millis()); Serial.print(dhb10_com("go 3 -4\\r"));
  Serial.print(drive_getTicks(&left, &right)); say(left); say(right); Serial.print(drive_getSpeed(&l, &r)); say(l); say(r);
  Serial.print(drive_clearTicks()); say(dhb10_com("\\r") == 0); uint32_t begun = millis(); Serial.print(dhb10_com("what\\r"));
  say(millis() - begun); }}
void loop() {{}}
"""
    used = a("drive_open", "dhb10_com", "drive_getTicks", "drive_getSpeed", "drive_clearTicks")
    answers = {"go 3 -4": [""], "dist": ["64 -123"], "spd": ["32 -33"], "rst": ["reset"]}
    trace = arlo(uno).run(program, used, 2500, [controller(answers)])
    assert commands(trace) == ["", "verb 1", "go 3 -4", "dist", "spd", "rst", "", "what"]
    told = trace.text.replace("\r", "|")
    assert told.startswith("verbose|5")
    rest = told.split(" ", 1)
    assert int(rest[0].split("|")[1]) == pytest.approx(510 + 10, abs=6)
    assert rest[1].startswith("|64 -123|64 -123 32 -33|32 -33 reset|1 Error, no reply from DHB-10!\n")
    assert int(rest[1].split()[-1]) == pytest.approx(1004, abs=4)


@proves(*a("drive_speed", "drive_setMaxSpeed", "drive_feedback", "drive_speedBlocking", "drive_open"))
def speeds_are_said_when_they_change(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); Serial.print(drive_speed(24, 48)); say(drive_speed(24, 48) == 0); drive_speed(300, -300);
  drive_setMaxSpeed(60); drive_speed(100, 7); drive_feedback(0); drive_speed(9, 8); drive_speed(9, 8); drive_feedback(1);
  drive_speed(0, 0); drive_speedBlocking(1); uint32_t begun = millis(); drive_speed(32, 40); say((millis() - begun) / 100);
  drive_feedback(0); drive_feedback(1); drive_speed(32, 40); drive_speedBlocking(0); drive_speed(1, 2); }}
void loop() {{}}
"""
    used = a("drive_speed", "drive_setMaxSpeed", "drive_feedback", "drive_speedBlocking")
    plain = ("gospd 24 48", "gospd 200 -200", "gospd 60 7", "go 9 8", "gospd 0 0", "gospd 32 40", "gospd 1 2")
    answers = {**{each: ["ok"] for each in plain}, "spd": ["0 0", "10 12", "20 30", "32 40"]}
    trace = arlo(uno).run(program, used, 2500, [controller(answers)])
    told = commands(trace)[2:]
    first = ["gospd 24 48", "gospd 200 -200", "gospd 60 7", "go 9 8", "go 9 8", "gospd 0 0"]
    assert told[:6] == first
    assert told[6:8] == ["spd", "gospd 32 40"]
    assert told[8:13] == ["spd"] * 5  # one as the speed changes, then 20 30 and three times there
    assert told[13:] == ["spd"] * 5 + ["gospd 1 2"]
    assert trace.text.replace("\r", "|").startswith("ok|1 1")


@proves(*a("drive_goto", "drive_gotoDoneDelay"))
def distances_are_driven_until_the_wheels_rest(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); drive_gotoDoneDelay(3); Serial.print(drive_goto(64, -32)); uint32_t begun = millis();
  drive_goto(100, 100); say((millis() - begun) / 10); }}
void loop() {{}}
"""
    ticks = ["10 10", "30 0", "50 -10", "74 -22", "74 -22"]
    trace = arlo(uno).run(
        program, a("drive_goto", "drive_gotoDoneDelay"), 2000,
        [controller({"dist": ticks, "move 64 -32 200": ["ok"], "move 100 100 200": ["ok"]})],
    )  # fmt: skip
    told = commands(trace)[2:]
    assert told == ["dist", "move 64 -32 200", *["dist"] * 5, "dist", "move 100 100 200", *["dist"] * 3]
    assert int(trace.text.split("\r")[-1]) == pytest.approx(13, abs=2)  # 20 ms, then three times 20 ms at rest and the texts


@proves(*a("drive_rampStep", "drive_ramp", "drive_setRampStep", "drive_servoPins", "drive_close"))
def ramps_are_made_by_the_controller_or_in_steps(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); drive_setRampStep(40); uint32_t begun = millis(); drive_ramp(20, 40);
  drive_rampStep(30, 40); say((millis() - begun) / 10); drive_speed(0, 0); drive_feedback(0); drive_ramp(4, -3);
  drive_feedback(1); drive_servoPins(9, 10); drive_close(); }}
void loop() {{}}
"""
    used = a(
        "drive_ramp", "drive_rampStep", "drive_setRampStep", "drive_servoPins", "drive_close", "drive_speed", "drive_feedback"
    )
    known = ("acc 10", "acc 512", "gospd 20 40", "gospd 0 0", "go 2 -2", "go 4 -3")
    answers = {**{each: ["ok"] for each in known}, "spd": ["0 0"]}
    second = DeviceUse("answering_line", {"line": "D9"}, {"answers": {"verb 1": ["verbose"], **answers}})
    trace = arlo(uno).run(program, used, 5000, [controller(answers), second])
    told = commands(trace)[2:]
    assert told[:8] == ["acc 10", "gospd 20 40", "acc 512", "gospd 0 0", "acc 10", "go 2 -2", "go 4 -3", "spd"]
    assert int(trace.text) == pytest.approx(5, abs=2)
    assert told[8:11] == ["acc 512", "gospd 0 0", "spd"]
    assert told.count("verb 1") == 1
    assert (trace.levels("D8")[-1][1], trace.levels("D9")[-1][1]) == ("z", "z")
    assert told[-4:] == ["spd"] * 4


@proves(*a("dhb10_terminal"))
def a_person_can_talk_to_the_controller(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); dhb10_terminal(SIDE_TERM); Serial.print("back"); }
void loop() {}
"""
    typing = DeviceUse("typing", {}, {"points": [[700, "spd\r"], [900, "exit\r"]]})
    trace = arlo(uno).run(program, a("dhb10_terminal", "SIDE_TERM"), 1000, [controller({"spd": ["1 2", ""]}), typing])
    assert commands(trace)[2:] == ["spd", "exit"]
    assert trace.text.replace("\r", "").split("\n") == [
        "Arlo Command Mode",
        "Ready",
        "> spd",
        "1 2\\r",
        "exit",
        "Exit command mode.",
        "back",
    ]
