"""soundimpact.h, colormath.h, stacktest.h, and exit and rand of stdlib.h.

Semantics of the libraries' sources (Simple-Libraries 1cc167c10, propgcc b280e7a77).
"""

from __future__ import annotations

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves
from tests.adapters.cases_cogs import cogs

SOUNDS = [f"soundimpact.h/soundImpact_{name}" for name in ("run", "end", "getCount")]


@proves(*SOUNDS)
def sounds_are_counted_until_the_end(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
void setup() { Serial.begin(115200); delay(20); int32_t *process = soundImpact_run(7); delay(30); say(soundImpact_getCount());
  say(soundImpact_getCount()); delay(30); say(soundImpact_getCount()); soundImpact_end(process); soundImpact_end(process);
  delay(30); say(soundImpact_getCount()); soundImpact_end((int32_t *)0); process = soundImpact_run(7); delay(20);
  say(soundImpact_getCount()); }
void loop() {}
"""
    points: list[list[float]] = [
        [0, 0],
        *([at + part, 1 - 2 * part] for at in (10, 25, 30, 40, 60, 90, 120) for part in (0, 0.5)),
    ]
    levels = [[at, int(level == 1)] for at, level in points]
    trace = uno.run(program, SOUNDS, 160, [DeviceUse("levels", {"pin": "D7"}, {"points": levels})])
    assert trace.text.split() == ["3", "0", "1", "0", "1"]


@proves("colormath.h/remapColor888to565")
def colours_lose_their_lowest_bits(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); Serial.print(remapColor888to565(0xFF0000), HEX); Serial.print(' ');
  Serial.print(remapColor888to565(0x12345678), HEX); }
void loop() {}
"""
    expected = 0x34 >> 3 << 11 | 0x56 >> 2 << 5 | 0x78 >> 3
    assert uno.run(program, ["colormath.h/remapColor888to565"], 20).text == f"F800 {expected:X}"


STACKS = [f"stacktest.h/{name}" for name in ("cog_runStackTest", "cog_endStackTest", "cogstart_stackTest", "cogstop_stackTest")]


@proves(*STACKS)
def cogs_tell_how_much_stack_they_used(uno: Uno) -> None:
    program = """
static int32_t memory[64]; volatile uint8_t sum;
void little(void *) { for (;;) delay(1); }
void much(void *par) { volatile uint8_t room[100]; for (uint8_t at = 0; at < 100; at++) room[at] = at;
  sum = room[50] + (par != 0); for (;;) delay(1); }
void setup() { Serial.begin(115200);
  int32_t *cog = cog_runStackTest(little, 50); delay(60); int32_t small = cog_endStackTest(cog);
  cog = cog_runStackTest(much, 50); delay(60); int32_t large = cog_endStackTest(cog); Serial.print(small > 3 && small < 24);
  Serial.print(large - small >= 24 && large - small < 32); Serial.print(cog_endStackTest(cog));
  int32_t number = cogstart_stackTest(much, memory, memory, sizeof memory); delay(60); Serial.print(number); Serial.print(sum);
  Serial.print(cogstop_stackTest(number, memory) == large); Serial.print(cogstop_stackTest(9, memory)); }
void loop() {}
"""
    assert cogs(uno, program, STACKS, 250, slots=1) == "11" + "0" + "1" + "51" + "1" + "0"


@proves("stdlib.h/exit")
def what_a_program_has_begun_goes_on_when_it_exits(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); tone(9, 500); Serial.print("a text that is still on its way when the program ends");
  c_exit(3); Serial.print("gone on"); }
void loop() { Serial.print("again"); }
"""
    trace = uno.run(program, ["stdlib.h/exit"], 60)
    assert trace.text == "a text that is still on its way when the program ends"
    assert trace.state == "running"
    assert [wave.hz for wave in trace.waves if wave.pin == "D9"][-1:] == [500.0] or len(trace.pulses("D9")) > 20


RANDOM = ["stdlib.h/rand", "stdlib.h/srand"]


@proves(*RANDOM)
def random_numbers_are_those_of_the_library(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); for (int turn = 0; turn < 4; turn++) { Serial.print(c_rand()); Serial.print(' '); }
  c_srand(4000000000UL); for (int turn = 0; turn < 3; turn++) { Serial.print(c_rand()); Serial.print(' '); } }
void loop() {}
"""
    expected = []
    for state, count in ((0, 4), (4_000_000_000, 3)):
        for _ in range(count):
            state = (state * 1_103_515_245 + 12_345) % 2**32
            expected.append(state >> 16 & 0x7FFF)
    assert [int(number) for number in uno.run(program, RANDOM, 30).text.split()] == expected
