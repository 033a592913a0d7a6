"""spi_adc.h: converters on four wires. Semantics of the library's source (1cc167c10)."""

from __future__ import annotations

import pytest

from robosmi.verify.simulation import DeviceUse, PinTrace
from tests.adapters.bench import Uno, proves

READ = [f"spi_adc.h/{name}" for name in ("MCP3202_getVolts", "MCP3002_getVolts", "spi_adc")]


def selected(trace: PinTrace) -> list[list[tuple[float, int]]]:
    """For each selection (D7): the times (ms) of the clock's (D6) rising edges, and the level sent to the converter (D4)."""
    lines, found = {"D4": 0, "D6": 0, "D7": 1}, list[list[tuple[float, int]]]()
    for change in trace.changes:
        if change.pin not in lines:
            continue
        level = 1 if change.level == 1 else 0
        if change.pin == "D7" and lines["D7"] and not level:
            found.append([])
        if change.pin == "D6" and level and found:
            found[-1].append((change.at_us / 1000, lines["D4"]))
        lines[change.pin] = level
    return [bits for bits in found if bits]


@proves(*READ)
def voltages_of_converters_on_four_wires_are_read(uno: Uno) -> None:
    program = """
float said[4];
void setup() { Serial.begin(115200); delay(2); said[0] = MCP3202_getVolts(0, 4, 5, 6, 7, 4.096); delay(5);
  said[1] = MCP3002_getVolts(0, 4, 5, 6, 7, 5); delay(5); said[2] = spi_adc(3, 4, 5, 6, 7, 8, 3);
  said[3] = spi_adc(0, 4, 5, 6, 7, -1, 3); for (float volts : said) { Serial.print(volts, 4); Serial.print(' '); } }
void loop() {}
"""
    points: list[list[float]] = [[0, 0]]
    for _ in range(3):  # the levels come at times that are known from the run before, and change what is computed then
        trace = uno.run(program, READ, 60, [DeviceUse("levels", {"pin": "D5"}, {"points": points})])
        asked = selected(trace)
        rises = [[at for at, _ in bits] for bits in asked]
        points = [[0, 0], [rises[0][4] + 0.001, 1], [rises[0][7] + 0.001, 0], [rises[1][13] + 0.001, 1]]
    assert [[bit for _, bit in bits[:4]] for bits in asked] == [[1, 1, 0, 1], [1, 1, 0, 1], [1, 1, 1, 1]]
    assert [len(bits) for bits in asked] == [17, 15, 8]  # four out, the value, and one more while it is not selected
    error, told = trace.text.splitlines()[0], trace.text.splitlines()[1].split()
    assert error == "Error! Float Vref = -1.000000, should not be <= 0"
    assert float(told[0]) == pytest.approx(0xE00 / 1000)
    assert float(told[1]) == pytest.approx(5 / 1024, abs=1e-4)
    assert float(told[2]) == 7
    assert float(told[3]) == pytest.approx(-99.99)
