"""simpletools.h: arithmetic. Semantics of the library's sources (libsimpletools, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from tests.adapters.bench import Uno, proves


def s(*names: str) -> list[str]:
    """The `header/name` of these functions of simpletools.h."""
    return [f"simpletools.h/{name}" for name in names]


def mapped(value: int, low: int, high: int, to_low: int, to_high: int) -> int:
    """The result of mapInt.c: the product is rounded by half of the divisor, with the sign of the quotient, and truncated."""
    product, divisor = (value - low) * (to_high - to_low), high - low
    half = int(divisor / 2)
    return int((product + (-half if product * divisor < 0 else half)) / divisor) + to_low


@proves(*s("mapInt", "mapFloat", "constrainInt", "constrainFloat", "endianSwap"))
def values_are_mapped_constrained_and_swapped(uno: Uno) -> None:
    rows = [
        (3, 0, 9, 0, 100),
        (-7, 0, 9, 0, 100),
        (2, 0, 4, 0, 100_000),
        (5, 10, 0, 0, 3),
        (1, 0, 2, 0, 1),
        (1, 0, 2, 0, -1),
        (7, 9, 0, -5, 70_000),
    ]
    calls = "".join(f"Serial.println(mapInt({', '.join(map(str, row))}));\n" for row in rows)
    program = f"""
void setup() {{ Serial.begin(115200); {calls}
  Serial.println(mapFloat(2.5, 1, 3, 10, 20)); Serial.println(mapFloat(0, 4, 2, 1, 2));
  for (int32_t value = -100000; value <= 100000; value += 100000) Serial.println(constrainInt(value, -70000, 70000));
  Serial.println(constrainInt(50, 10, 1)); Serial.println(constrainFloat(2.5, 1.5, 2));
  Serial.println(constrainFloat(-1, 7, 0.25));
  int32_t from = 0x12345678, to = 0; endianSwap(&to, &from, 4); Serial.println(to, HEX); endianSwap(&to, &from, 2);
  Serial.print(to, HEX);
}} void loop() {{}}
"""
    trace = uno.run(program, s("mapInt", "mapFloat", "constrainInt", "constrainFloat", "endianSwap"), 60)
    expected = [str(mapped(*row)) for row in rows]
    expected += ["17.50", "3.00", "-70000", "0", "70000", "10", "2.00", "0.25", "78563412", "78567856"]
    assert trace.text.split("\r\n") == expected


@proves(*s("random"))
def random_numbers_reach_both_limits(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); for (int turn = 0; turn < 200;
  turn++) { Serial.print(random_between(turn & 1 ? -2 : 3, turn & 1 ? 3 : -2)); Serial.print(' '); }
  for (int turn = 0; turn < 50; turn++) { Serial.print(random_between(100000, 100001)); Serial.print(' '); } } void loop() {}
"""
    numbers = list(map(int, uno.run(program, s("random"), 120).text.split()))
    assert set(numbers[:200]) == {-2, -1, 0, 1, 2, 3}
    assert set(numbers[200:]) == {100_000, 100_001}


@proves(
    *s(
        "MSBPRE",
        "LSBPRE",
        "MSBPOST",
        "LSBPOST",
        "LSBFIRST",
        "MSBFIRST",
        "PI",
        "EEPROM_ADDR",
        "CTR_NCO",
        "CTR_PLL",
        "DUTY_SE",
        "NCO_PWM_1",
        "ms",
        "us",
    )
)
def constants_have_their_values(uno: Uno) -> None:
    names = (
        "MSBPRE",
        "LSBPRE",
        "MSBPOST",
        "LSBPOST",
        "LSBFIRST",
        "MSBFIRST",
        "EEPROM_ADDR",
        "CTR_NCO",
        "CTR_PLL",
        "DUTY_SE",
        "NCO_PWM_1",
        "ms",
        "us",
    )
    shown = "".join(f"Serial.print((int32_t){name}); Serial.print(' '); " for name in names)
    trace = uno.run(f"void setup() {{ Serial.begin(115200); {shown}Serial.print(PI, 5); }} void loop() {{}}", s(*names, "PI"), 20)
    values = (0, 1, 2, 3, 0, 1, 0x50, 0b100 << 26, 0b10 << 26, 0b110 << 26, 0b100 << 26, 80_000, 80)
    assert trace.text.split() == [*map(str, values), "3.14159"]
