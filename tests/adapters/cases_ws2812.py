"""ws2812.h: chains of coloured lights. Semantics of the library's sources (libws2812, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from itertools import pairwise

import pytest

from tests.adapters.bench import Uno, proves


def w(*names: str) -> list[str]:
    """The `header/name` of these functions of ws2812.h."""
    return [f"ws2812.h/ws2812{name}" for name in names]


SENDING = [*w("_start", "b_start", "_open", "b_open", "_set", "_stop"), "ws2812.h/ws_start"]


@proves(*SENDING)
def lights_get_their_colours_bit_by_bit(uno: Uno) -> None:
    program = """
uint32_t colors[3] = {COLOR_ORANGE, COLOR(1, 2, 3), COLOR_BLACK};
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
void setup() { Serial.begin(115200); ws2812 *one = ws2812_open(), *two = ws2812b_open(), three; ws2812_set(one, 6, colors, 2);
  ws2812_set(two, 6, colors, 1); ws2812_set(two, 6, colors, 1); delay(2); say(ws2812_start(one)); say(ws2812b_start(two));
  say(ws_start(&three, 50, 350, 800, 700, 600, TYPE_RGB)); ws2812_set(&three, 7, colors + 1, 1); ws2812_stop(one);
  ws2812_set(one, 6, colors, 1); ws2812_set(two, 255, colors, 1); }
void loop() {}
"""
    constants = [f"ws2812.h/{name}" for name in ("COLOR_ORANGE", "COLOR_BLACK", "COLOR", "TYPE_RGB", "ws2812")]
    trace = uno.run(program, [*SENDING, *constants], 15)
    pulses = trace.pulses("D6")
    assert len(pulses) == 4 * 24

    def sent(bits: list[tuple[float, float]]) -> int:
        return int("".join("1" if width > 0.6 else "0" for _, width in bits), 2)

    assert [sent(pulses[at : at + 24]) for at in range(0, 96, 24)] == [0x60FF00, 0x020103, 0x60FF00, 0x60FF00]
    assert sent(trace.pulses("D7")) == 0x010203
    assert {round(width, 3) for _, width in pulses} == {0.375, 0.812}
    apart = [late[0] - early[0] for early, late in pairwise(pulses)]
    assert apart[:7] == pytest.approx([1.25] * 7)
    assert max(apart[:47]) < 6
    assert pulses[72][0] - pulses[71][0] >= 300
    assert all(int(each) >= 0 for each in trace.text.split())


@proves(*w("_wheel", "_wheel_dim"))
def a_wheel_of_colours_is_calculated(uno: Uno) -> None:
    program = """
void say(uint32_t number) { Serial.print(number, HEX); Serial.print(' '); }
void setup() { Serial.begin(115200); int places[] = {0, 10, 84, 85, 100, 169, 170, 200, 255};
  for (int pos : places) { say(ws2812_wheel(pos)); say(ws2812_wheel_dim(pos, 64)); } }
void loop() {}
"""
    told = [int(each, 16) for each in uno.run(program, w("_wheel", "_wheel_dim"), 40).text.split()]

    def color(*parts: int, brightness: int) -> int:
        return int("".join(f"{part * brightness // 255:02x}" for part in parts), 16)

    expected: list[int] = []
    for pos in (0, 10, 84, 85, 100, 169, 170, 200, 255):
        up = pos % 85 * 3 if pos < 255 else 255
        parts = [(255 - up, up, 0), (0, 255 - up, up), (up, 0, 255 - up)][min(pos // 85, 2)]
        expected += [color(*parts, brightness=255), color(*parts, brightness=64)]
    assert told == expected


@proves(*w("_close"))
def a_closed_driver_gives_its_memory_back(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); bool same = true; ws2812 *first = ws2812_open(); ws2812_close(first);
  for (int turn = 0; turn < 5; turn++) { ws2812 *next = ws2812_open(); same = same && next == first; ws2812_close(next); }
  Serial.print(same); }
void loop() {}
"""
    assert uno.run(program, [*w("_open", "_close"), "ws2812.h/ws2812"], 10).text == "1"
