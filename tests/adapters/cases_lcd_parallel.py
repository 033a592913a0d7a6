"""lcdParallel.h: displays of characters on four or eight wires. Semantics of the library's source (1cc167c10)."""

from __future__ import annotations

from itertools import pairwise

from robosmi.verify.simulation import PinTrace
from tests.adapters.bench import Uno, proves

SELECT, ENABLE = "D2", "D3"
FOUR = ["D4", "D5", "D6", "D7"]
EIGHT = [*FOUR, "D8", "D9", "D10", "D11"]


def lcd(*names: str) -> list[str]:
    """The `header/name` of these adapters."""
    return [f"lcdParallel.h/lcdParallel_{name}" for name in names]


def taken(trace: PinTrace, wires: list[str]) -> list[tuple[float, int, int]]:
    """What the display reads at each falling edge of enable: time in us, level of the register select, value on the wires."""
    lines, found, risen = dict.fromkeys([SELECT, ENABLE, *wires], 0), list[tuple[float, int, int]](), 0.0
    for change in trace.changes:
        if change.pin not in lines:
            continue
        level = 1 if change.level == 1 else 0
        if change.pin == ENABLE and level and not lines[ENABLE]:
            risen = change.at_us
        if change.pin == ENABLE and lines[ENABLE] and not level:
            assert change.at_us - risen >= 0.5
            found.append((change.at_us, lines[SELECT], sum(lines[wire] << bit for bit, wire in enumerate(wires))))
        lines[change.pin] = level
    return found


def bytes_of(halves: list[tuple[float, int, int]]) -> list[tuple[int, int]]:
    """The register select and the byte of each pair of half bytes."""
    pairs = zip(halves[::2], halves[1::2], strict=True)
    assert all(high[1] == low[1] for high, low in zip(halves[::2], halves[1::2], strict=True))
    return [(high[1], high[2] << 4 | low[2]) for high, low in pairs]


SHOWN = lcd("init", "init8", "print", "setCursor", "writeChar", "send", "write", "createChar", "clear", "home", "display")


@proves(*SHOWN)
def a_display_is_set_up_and_shows_texts(uno: Uno) -> None:
    program = """
void setup() { uint8_t smile[8] = {17, 17, 0, 4, 0, 17, 14, 31}; lcdParallel *lcd = lcdParallel_init(16, 2, 8, 2, 3, 4, 5, 6, 7);
  Serial.begin(115200); Serial.print(lcdParallel_print(lcd, "%d %s\\n%.1f", -7, "cm", 2.5f)); lcdParallel_setCursor(lcd, 3, 1);
  lcdParallel_writeChar(lcd, 0xA5); lcdParallel_setCursor(lcd, 1, 9); lcdParallel_createChar(lcd, 9, smile);
  uint32_t begun = micros(); lcdParallel_clear(lcd); uint32_t cleared = micros(); lcdParallel_home(lcd);
  Serial.print(cleared - begun > 2000 && micros() - cleared > 2000); lcdParallel_send(lcd, 0x12, 1);
  lcdParallel_write(lcd, 0x5A, 4); }
void loop() {}
"""
    trace = uno.run(program, SHOWN, 120)
    halves = taken(trace, FOUR)
    assert [value for _, _, value in halves[:4]] == [3, 3, 3, 2]
    waits = [(after - before) / 1000 for (before, *_), (after, *_) in pairwise(halves)]
    assert halves[0][0] >= 50_000
    assert waits[0] >= 4.5
    assert waits[1] >= 4.5
    assert waits[2] >= 0.15
    assert min(waits) >= 0.1
    sent = bytes_of(halves[4:-1])
    assert sent[:4] == [(0, 0x28), (0, 0x0C), (0, 0x01), (0, 0x06)]
    assert bytes(value for select, value in sent[4:13] if select) == b"-7 cm\n2.5"
    assert sent[13:17] == [(0, 0xC3), (1, 0xA5), (0, 0xC1), (0, 0x48)]
    assert sent[17:25] == [(1, line) for line in (17, 17, 0, 4, 0, 17, 14, 31)]
    assert sent[25:] == [(0, 1), (0, 2), (1, 0x12)]
    assert halves[-1][1:] == (1, 0x0A)
    assert trace.text == "91"


CHANGED = lcd(
    "init8", "noDisplay", "display", "cursor", "noCursor", "blink", "noBlink", "rightToLeft", "leftToRight", "autoscroll",
    "noAutoscroll", "scrollDisplayLeft", "scrollDisplayRight",
)  # fmt: skip


@proves(*CHANGED)
def a_display_on_eight_wires_is_changed(uno: Uno) -> None:
    program = """
void setup() { lcdParallel *lcd = lcdParallel_init8(20, 1, 10, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11); lcdParallel_noDisplay(lcd);
  lcdParallel_cursor(lcd); lcdParallel_blink(lcd); lcdParallel_display(lcd); lcdParallel_noCursor(lcd); lcdParallel_noBlink(lcd);
  lcdParallel_rightToLeft(lcd); lcdParallel_autoscroll(lcd); lcdParallel_leftToRight(lcd); lcdParallel_noAutoscroll(lcd);
  lcdParallel_scrollDisplayLeft(lcd); lcdParallel_scrollDisplayRight(lcd); }
void loop() {}
"""
    sent = taken(uno.run(program, CHANGED, 100), EIGHT)
    assert [select for _, select, _ in sent] == [0] * len(sent)
    assert [value for _, _, value in sent[:7]] == [0x34, 0x34, 0x34, 0x34, 0x0C, 0x01, 0x06]
    assert sent[1][0] - sent[0][0] >= 4500
    assert sent[2][0] - sent[1][0] >= 150
    told = [value for _, _, value in sent[7:]]
    assert told == [0x08, 0x0A, 0x0B, 0x0F, 0x0D, 0x0C, 0x04, 0x05, 0x07, 0x06, 0x18, 0x1C]
