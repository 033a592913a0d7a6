"""What programs measure at each device: the physical side that the device plays, on every engine."""

from __future__ import annotations

import pytest
from msgspec.structs import replace

from robosmi.base.data_text import Json, as_list, as_number, as_whole
from robosmi.transformations.verification.devices.feedback_servo import FeedbackServo
from robosmi.transformations.verification.devices.servo_pulses import MotionTolerance, PulseDriven, Waypoints
from robosmi.transformations.verification.devices.wheel import Wheel
from robosmi.verify.bench import Bench
from robosmi.verify.simulation import DeviceUse, simulate
from tests.transformations.verification.conftest import Run


def test_rangers_answer_with_the_distance_of_the_time(job_of: Run, engine: str) -> None:
    devices = [
        DeviceUse("ranger", {"signal": "D7"}, {"points": [[0, 20], [100, 150], [300, None]]}),
        DeviceUse("two_pin_ranger", {"trigger": "D6", "echo": "D5"}, {"points": [[0, 3], [100, 200]]}),
    ]
    trace = simulate(job_of("rangers", 450, devices), engine)
    read = [tuple(map(int, line.split())) for line in trace.text.splitlines()]
    assert read[0] == (20, 3)
    assert (150, 200) in [(round(one, -1), round(two, -1)) for one, two in read]  # pulseIn reads half a percent too little
    assert read[-1][0] == 0
    assert next(event.value for event in trace.device_events if event.device == 0) == 20


def test_a_capacitor_decays_and_a_pull_up_holds_it(job_of: Run, engine: str) -> None:
    trace = simulate(job_of("capacitor", 30, [DeviceUse("capacitor", {"pin": "D4"}, {"points": [[0, 1800]]})]), engine)
    assert trace.text.splitlines() == ["18", "1"]


@pytest.mark.parametrize(
    ("humidity", "celsius", "read"),
    [(65.2, 35.1, "2 140 1 95 238"), (40.0, -10.1, "1 144 128 101 118"), (0.0, 0.0, "0 0 0 0 0")],
)
def test_a_dht22_sends_its_bits(humidity: float, celsius: float, read: str, job_of: Run, engine: str) -> None:
    """The first two frames are those of the data sheet of the AM2302."""
    settings = {"humidity": [[0, humidity]], "celsius": [[0, celsius]]}
    trace = simulate(job_of("sensors", 60, [DeviceUse("dht22", {"signal": "D2"}, settings)]), engine)
    assert trace.text.splitlines()[0] == read


def test_the_bus_is_answered_at_the_addresses_that_are_there(job_of: Run, engine: str) -> None:
    devices = [
        DeviceUse("eeprom", {}, {"content": [1] * 0x0102}),
        DeviceUse("registers", {}, {"address": 0x19, "content": [10, 11, 12, 13, 14]}),
    ]
    trace = simulate(job_of("bus", 60, devices), engine)
    assert trace.text.splitlines() == ["0", "1", " 1 77 78", " 13 14", "1"]
    assert [event.value for event in trace.device_events] == [[0x0102, 77], [0x0103, 78]]


def test_a_key_joins_its_row_and_column(job_of: Run, engine: str) -> None:
    pins = {"row0": "D4", "row1": "D5", "column0": "D6", "column1": "D7"}
    points = [[0, None], [50, [0, 1]], [110, [1, 0]], [170, None]]
    trace = simulate(job_of("matrix", 220, [DeviceUse("keypad", pins, {"points": points})]), engine)
    keys = trace.text.split()
    assert list(dict.fromkeys(keys)) == ["01", "10"]
    assert len(keys) >= 4


def test_of_brief_pins_only_the_first_changes_are_recorded(job_of: Run, engine: str) -> None:
    pins = {"row0": "D4", "row1": "D5", "column0": "D6", "column1": "D7"}
    asked = job_of("matrix", 220, [DeviceUse("keypad", pins, {"points": [[50, [0, 1]], [110, [1, 0]], [170, None]]})])
    whole, brief = simulate(asked, engine), simulate(replace(asked, brief=(*pins.values(), "D13")), engine)
    assert whole.console == brief.console
    assert len(whole.changes) > 3 * len(brief.changes)
    told = [(change.pin, change.level) for change in brief.changes]
    assert set(told) == {(change.pin, change.level) for change in whole.changes}
    assert len(told) == len(set(told))


def test_a_remote_control_is_heard(job_of: Run, engine: str) -> None:
    points = [[10, [21, 1]], [200, [106, 30]]]
    trace = simulate(job_of("infrared", 400, [DeviceUse("sony_remote", {"signal": "D10"}, {"points": points})]), engine)
    assert trace.text.split() == ["21/1"] * 3 + ["106/30"] * 3


def test_a_wheel_turns_as_its_pulses_say(job_of: Run, engine: str) -> None:
    devices = [DeviceUse("wheel", {"servo": "D9", "encoder": "A0"}, {})]
    trace = simulate(job_of("wheels", 1400, devices), engine)
    ticks = trace.device_events[-1].value
    assert trace.text.split() == [str(ticks)]
    width = trace.pulses("D9")[20][1]
    assert ticks == pytest.approx((width - 1500) * 0.64 * 1.05, abs=2)  # for 1 s, and the 50 ms until it stands


class Quiet(Bench):
    """A bench on which no time passes and no level changes."""

    cycle = 0

    def wake_at(self, cycle: int) -> None:
        """Ignore the request."""

    def set_level(self, pin: str, level: int | None) -> None:
        """Ignore the level."""

    def set_voltage(self, pin: str, millivolts: float) -> None:
        """Ignore the voltage."""

    def send(self, data: bytes) -> None:
        """Ignore the data."""


class Watched(Quiet):
    """A bench that records the levels of one pin."""

    def __init__(self) -> None:
        super().__init__(["D9", "A0"], 16_000_000)
        self.levels: list[int | None] = []

    def set_level(self, pin: str, level: int | None) -> None:
        """Record the level."""
        self.levels.append(level)


def test_a_wheel_that_turns_round_behind_a_tick_meets_it_again() -> None:
    bench = Watched()
    wheel = Wheel(bench, 0, {"servo": "D9", "encoder": "A0"}, {"starts_at": 0.9})
    wheel.start()
    for width, steps in ((1600.0, 3), (1400.0, 3), (1400.0, 12), (1600.0, 15)):  # 64 ticks/s for so many ms
        wheel.pulse(width)
        for _ in range(steps):
            wheel._turn()
    assert bench.levels == [0, 1, 0, 1]
    wheel.ended()
    assert bench.events[-1].value == 3


def test_a_feedback_servo_tells_its_angle(job_of: Run, engine: str) -> None:
    devices = [DeviceUse("feedback_servo", {"servo": "D9", "feedback": "D2"}, {"degrees": 90.0})]
    trace = simulate(job_of("feedback", 800, devices), engine)
    before, after = (971 - int(each) for each in trace.text.split())
    pulses = trace.pulses("D9")
    turning = (pulses[-1][0] - pulses[0][0]) / 1e6 + 0.05  # seconds until it stands
    beyond = sum(width for _, width in pulses) / len(pulses) - 1520
    degrees = trace.device_events[-1].value
    assert before / 942 * 360 == pytest.approx(90, abs=2)
    assert after / 942 * 360 == pytest.approx(degrees, abs=2)
    assert degrees == pytest.approx(90 + beyond * 4.88 * turning, abs=2)


@pytest.mark.parametrize(
    ("way", "marks"),
    [
        ([90.0, 88.0, 91.0, 87.5, 90.0], []),  # it trembles where it is held
        ([90.0, 80.0, 82.0, 80.5], [82, "82 barely"]),  # over a mark and nearly back again
        ([60.0, 83.0, 60.0, 40.0], [82, "82 barely", 82, "82 barely", 52]),  # another run may turn back before the mark
        ([60.0, 92.0, 60.0, 40.0], [82, 82, 52]),
        ([0.0, 60.0, 0.0], [22, 52, 52, 22]),
        ([0.0, -75.0], [-8, -38, -68]),  # several at once
    ],
)
def test_a_servo_notes_the_marks_that_it_passes(way: list[float], marks: list[int | str]) -> None:
    servo = FeedbackServo(Quiet(["D9", "D2"], 16_000_000), 0, {"servo": "D9", "feedback": "D2"}, {})
    PulseDriven.start(servo)
    for place in way:
        servo.moved_to(place)
    told = [event.value if event.what == "at" else f"{event.value} {event.what}" for event in servo.bench.events]
    assert told == marks


def told_marks(leeway: float, *way: tuple[float, float]) -> list[Json]:
    """What is told of marks 16 apart on a way: for each part the place at its end and the speed, after a long rest at 0.

    `leeway` is how far apart two correct programs may be beyond a quarter of that distance.
    """
    told: list[Json] = []
    marks = Waypoints(16.0, lambda what, mark: told.append(mark if what == "at" else [what, mark]))
    marks.leeway = leeway
    stood(marks, 0.0, 0.0, 0.5)
    now, place = 500.0, 0.0
    for end, speed in way:
        for _ in range(round(abs(end - place) / speed * 1000)):
            now, place = now + 1, place + speed / 1000 * (1 if end > place else -1)
            marks.moved(place, 1000 * now)
    return told


@pytest.mark.parametrize(
    ("leeway", "way", "told"),
    [
        (0.0, [(33, 64), (0, 64)], [12, 28, 28, 12]),  # marks are at 11.52 and 27.52
        (2.0, [(33, 64), (0, 64)], [12, 28, ["barely", 28], 28, ["barely", 28], 12]),
        (8.0, [(33, 64), (10, 64)], [12, ["barely", 12], 28, ["barely", 28], 28, ["barely", 28], 12]),
        (18.0, [(33, 64), (10, 64)], [12, ["barely", 12], 28, ["barely", 28], 28, ["barely", 28], 12, ["barely", 12]]),
    ],
)
def test_the_leeway_of_two_programs_says_which_marks_are_barely_reached(
    leeway: float, way: list[tuple[float, float]], told: list[Json]
) -> None:
    assert told_marks(leeway, *way) == told


def test_a_mark_that_is_passed_slowly_has_a_vague_time() -> None:
    """A quarter of the distance, and a sixteenth before it is known, takes 560 ms, and at the highest speed 80 ms."""
    first, second, slowly, *_ = told_marks(0.0, (21, 64), (48, 8))
    assert (first, second) == (12, 28)
    what, (mark, vague_us) = as_list(slowly)[0], as_list(as_list(slowly)[1])
    assert (what, mark) == ("slowly", 28)
    assert as_number(vague_us) == pytest.approx(480_000, rel=0.05)


def distance_after(timed: bool, *steps: float | str) -> float:
    """The leeway after a device is driven at these speeds, or has got such an aim."""
    leeway = MotionTolerance(timed)
    for step in steps:
        if isinstance(step, str):
            leeway.aimed(step)
        else:
            leeway.driven(step)
    return leeway.distance


FRAME_S, LATE_S = 0.021, 0.024


@pytest.mark.parametrize(
    ("timed", "steps", "distance"),
    [
        (True, [64.0], 64 * FRAME_S + 64 * LATE_S),  # as far as it goes in a frame, at whichever end, and while it is late
        (True, [32.0, 64.0, 48.0, 64.0, 0.0], 80 * FRAME_S + 64 * LATE_S),
        (True, [64.0, -32.0], 96 * FRAME_S + 64 * LATE_S),  # where it turns back it was as fast as before
        (True, [64.0, 0.0, 32.0, 0.0, 32.0], 128 * FRAME_S + 32 * LATE_S),  # how late it is does not add up
        (True, [64.0, 0.0] * 18, 64 * FRAME_S * 9 + 64 * LATE_S),  # three standard deviations of 18 motions, not their sum
        (False, [64.0, -64.0, 0.0], 0.0),
        (True, ["way", 64.0, 0.0], 0.0),
        (False, ["time", 64.0, "way", 32.0, 0.0], 64 * FRAME_S + 64 * LATE_S),
        (True, ["time", 64.0, 0.0, "way", 64.0, 0.0, "time", 32.0, 0.0], 96 * FRAME_S + 64 * LATE_S),
        (True, ["time", 64.0, 0.0, "place", 64.0, 0.0], 0.0),  # the place is the same wherever that began
    ],
)
def test_each_motion_for_a_time_adds_to_the_leeway(timed: bool, steps: list[float | str], distance: float) -> None:
    assert distance_after(timed, *steps) == pytest.approx(distance)


def stood(marks: Waypoints, place: float, begin_s: float, end_s: float) -> None:
    """Keep a device at a place from one time to another."""
    for number in range(round(begin_s * 100), round(end_s * 100)):
        marks.moved(place, number * 10_000.0)


@pytest.mark.parametrize("first", [12.0, 11.0])
def test_a_mark_near_which_a_device_stands_is_one_that_it_barely_comes_to(first: float) -> None:
    """Marks are at 11.52 and 27.52: the first one is passed before the device stands, or when it goes on."""
    told: list[tuple[str, Json]] = []
    marks = Waypoints(16.0, lambda what, mark: told.append((what, mark)))
    stood(marks, 0.0, 0.0, 0.5)
    stood(marks, first, 0.5, 2.0)
    stood(marks, 20.0, 2.0, 2.01)
    stood(marks, 40.0, 2.01, 2.02)
    assert told == [("at", 12), ("barely", 12), ("at", 28)]


def test_a_slow_device_passes_its_marks_all_the_same() -> None:
    told: list[tuple[str, Json]] = []
    marks = Waypoints(16.0, lambda what, mark: told.append((what, mark)))
    for number in range(10_000):  # ten ticks a second
        marks.moved(number * 0.01, number * 1000.0)
    assert [what for what, _ in told] == ["at"] * 6


class Clocked(Quiet):
    """A bench whose time jumps from one action to the next, and which records rising edges of a pin."""

    def __init__(self, pins: list[str], clock_hz: int) -> None:
        super().__init__(pins, clock_hz)
        self.rises: dict[str, list[float]] = {pin: [] for pin in pins}

    def set_level(self, pin: str, level: int | None) -> None:
        """Record a rising edge."""
        if level == 1:
            self.rises[pin].append(self.now)


def test_the_signals_of_two_servos_are_not_in_step() -> None:
    bench = Clocked(["D2", "D3", "D9", "D10"], 16_000_000)
    bench.connect(
        [
            DeviceUse("feedback_servo", {"servo": "D9", "feedback": "D2"}),
            DeviceUse("feedback_servo", {"servo": "D10", "feedback": "D3"}),
        ]
    )
    while bench.now < 500_000 and (later := bench.wake()) is not None:
        bench.cycle = later
    first, second = bench.rises["D2"], bench.rises["D3"]
    apart = [min(abs(rise - other) for other in second) for rise in first[1:]]
    together = [at for at, distance in enumerate(apart) if distance < 10]
    assert 0 < len(together) < len(apart) / 25


def test_serial_registers_are_written_and_read(job_of: Run, engine: str) -> None:
    pins = {"select": "D5", "clock": "D6", "data_in": "D7", "data_out": "D8"}
    devices = [DeviceUse("serial_registers", pins, {"content": [1, 2, 0x53, 0xA7, 5]})]
    trace = simulate(job_of("serial_registers", 100, devices), engine)
    assert trace.text.split() == ["83", "83", "167", "77"]  # one, two with the bit for going on, one that was written
    assert [event.value for event in trace.device_events] == [[9, 77]]


def test_serial_registers_may_have_two_pages(job_of: Run, engine: str) -> None:
    pins = {"select": "D5", "clock": "D6", "data_in": "D7", "data_out": "D8"}
    content = [1, 2, 0x53, *[0] * 127, 0x54, 0xA8]
    trace = simulate(
        job_of("serial_registers", 100, [DeviceUse("serial_registers", pins, {"content": content, "page": 50})]), engine
    )
    assert trace.text.split() == ["84", "84", "168", "77"]  # the page register is 0: all but itself are in the upper page
    assert [event.value for event in trace.device_events] == [[128 + 9, 77]]


def test_a_line_that_answers_takes_commands_from_the_same_pin(job_of: Run, engine: str) -> None:
    settings = {"baud": 9600, "answers": {"dist": ["12", "34"]}}
    trace = simulate(job_of("answering_line", 200, [DeviceUse("answering_line", {"line": "D8"}, settings)]), engine)
    assert trace.text.split() == ["12", "34", "34", "?"]
    assert [event.value for event in trace.device_events] == ["dist", "dist", "dist", "what"]


def test_a_serial_line_carries_bytes_both_ways(job_of: Run, engine: str) -> None:
    pins = {"receive": "D10", "transmit": "D11"}
    trace = simulate(
        job_of("serial_line", 100, [DeviceUse("serial_line", pins, {"points": [[20, "a"], [40, "b"], [60, "z"]]})]), engine
    )
    noted = [(event.what, chr(as_whole(event.value))) for event in trace.device_events]
    assert [each for each in noted if each[0] == "byte"] == [("byte", "A"), ("byte", "B"), ("byte", "Z")]
