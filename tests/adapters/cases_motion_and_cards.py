"""mx2125.h, mma7455.h and rfidser.h: accelerometers and a reader of cards. Semantics of the libraries' sources (1cc167c10)."""

from __future__ import annotations

from robosmi.verify.simulation import DeviceUse, PinTrace
from tests.adapters.bench import Uno, proves


def pulses(width_us: float, until_ms: float) -> list[list[float]]:
    """What an axis of the MX2125 sends: a pulse every 10 ms."""
    points = list[list[float]]([[0, 0]])
    for number in range(int(until_ms / 10)):
        points += [[number * 10 + 1, 1], [number * 10 + 1 + width_us / 1000, 0]]
    return points


@proves("mx2125.h/mx_accel", "mx2125.h/mx_tilt", "mx2125.h/mx_rotate")
def pulses_of_an_accelerometer_are_angles(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
void setup() { Serial.begin(115200); say(mx_accel(6)); say(mx_accel(7)); say(mx_tilt(6)); say(mx_tilt(7)); say(mx_rotate(6, 7));
  say(mx_rotate(7, 6)); }
void loop() {}
"""
    names = ["mx2125.h/mx_accel", "mx2125.h/mx_tilt", "mx2125.h/mx_rotate"]
    axes = [DeviceUse("levels", {"pin": f"D{pin}"}, {"points": pulses(us, 200)}) for pin, us in ((6, 5625), (7, 4200))]
    told = [int(each) for each in uno.run(program, names, 220, axes).text.split()]
    assert abs(told[0] - 625) <= 2
    assert abs(told[1] + 800) <= 2
    assert told[2] in (29, 30)  # asin(0.5), cut
    assert told[3] == -39  # asin(-0.64) = -39.8
    assert told[4] in (308, 309)  # 360 - 51.99
    assert told[5] in (141, 142)


MOTION = [
    f"mma7455.h/MMA7455_{name}"
    for name in (
        "init", "writeByte", "readByte", "gRange", "setMode", "getMode", "getxyz10", "getxyz8", "setOffsetX", "setOffsetY",
        "setOffsetZ",
    )
]  # fmt: skip


def commands(trace: PinTrace) -> list[list[int]]:
    """What stood on the data line (D5) at each rising edge of the clock (D6), for each time that the sensor was enabled (D7)."""
    lines, found = {"D5": 0, "D6": 0, "D7": 1}, list[list[int]]()
    for change in trace.changes:
        if change.pin not in lines:
            continue
        level = 1 if change.level in (1, "p") else 0
        if change.pin == "D7" and lines["D7"] and not level:
            found.append([])
        if change.pin == "D6" and level and not lines["D6"] and found and not lines["D7"]:
            found[-1].append(lines["D5"])
        lines[change.pin] = level
    return found


def number(bits: list[int]) -> int:
    """Bits, highest first, as a number."""
    return int("".join(map(str, bits)), 2)


@proves(*MOTION)
def an_accelerometer_is_set_and_read_on_three_wires(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
int16_t x, y, z;
signed char a, b, c;
void setup() { Serial.begin(115200); MMA7455_init(5, 6, 7); MMA7455_writeByte(0x18, 0xA5);
  MMA7455_setOffsetX(-2);
  MMA7455_setOffsetY(0x123); MMA7455_setOffsetZ(7); say(MMA7455_readByte(0x0F)); say(MMA7455_getMode());
  MMA7455_getxyz10(&x, &y, &z); say(x); say(y); say(z); MMA7455_getxyz8(&a, &b, &c); say(a); say(b); say(c);
  MMA7455_gRange(2); MMA7455_setMode(2); delay(50);
  x = 5; say(MMA7455_readByte(0x0F)); MMA7455_setMode(2); MMA7455_gRange(4); say(MMA7455_getMode()); }
void loop() {}
"""
    trace = uno.run(program, MOTION, 120, [DeviceUse("levels", {"pin": "D5"}, {"points": [[0, 1], [40, 0]]})])
    assert trace.text.split() == ["255", "3", "-1", "-1", "-1", "-1", "-1", "-1", "0", "0"]
    begun = [at for at, level in trace.levels("D7") if level == 0]  # of each command
    of_y = [begun[read] / 1000 for read in (12, 14, 17, 18)]  # where the reading of the second axis begins and ends, twice
    points = [[0, 1], *([at - 0.005, number % 2] for number, at in enumerate(of_y))]
    again = uno.run(program, MOTION, 120, [DeviceUse("levels", {"pin": "D5"}, {"points": points})])
    assert again.text.split()[2:8] == ["-1", "0", "-1", "-1", "0", "-1"]
    sent = [(number(bits[:8]) >> 1, number(bits[8:])) for bits in commands(trace) if bits[0]]
    assert sent[:8] == [
        (0x56, 0x61), (0x58, 0xA5), (0x50, 0xFE), (0x51, 0xFF), (0x52, 0x23), (0x53, 1), (0x54, 7), (0x55, 0),
    ]  # fmt: skip
    assert sent[8:] == [(0x56, 0xF7), (0x56, 0xFE), (0x56, 2), (0x56, 8)]
    asked = [number(bits[:8]) for bits in commands(trace) if not bits[0]]
    assert asked[:2] == [0x0F << 1, 0x16 << 1]
    assert asked[2:11] == [address << 1 for address in range(9)]


CARDS = [f"rfidser.h/{name}" for name in ("rfid_open", "rfid_get", "rfid_enable", "rfid_disable", "rfid_reset", "rfidser_close")]


@proves(*CARDS)
def cards_are_read(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
void setup() { Serial.begin(115200); uint32_t begun = millis(); rfidser *reader = rfid_open(10, 8); say(millis() - begun);
  rfid_disable(reader); delay(5); rfid_enable(reader); delay(5); rfid_reset(reader);
  Serial.println(rfid_get(reader, 1000)); begun = millis(); Serial.println(rfid_get(reader, 100)); say(millis() - begun);
  Serial.println(rfid_get(reader, 1000)); rfidser_close(reader); delay(1); pinMode(10, OUTPUT); digitalWrite(10, LOW); }
void loop() {}
"""
    points = [[600, "\n0F0184F20B\r"], [900, "\n0F0184F20C\r"]]
    reader = DeviceUse("serial_line", {"receive": "D10"}, {"baud": 2400, "points": points})
    trace = uno.run(program, CARDS, 1000, [reader])
    first, second, third = trace.text.splitlines()[:3]
    assert 499 <= int(first.split()[0]) <= 502
    assert (first.split()[1], second) == ("0F0184F20B", "timed out")
    assert 100 <= int(third.split()[0]) <= 103
    assert third.split()[1] == "0F0184F20C"
    lit = [(round(at / 1000), level) for at, level in trace.levels("D8") if level in (0, 1)]
    assert [level for _, level in lit] == [1, 0, 1, 0, 1, 0]
    assert lit[3][0] - lit[2][0] == 5
    assert [level for _, level in trace.levels("D10")][-2:] == ["z", 0]
