"""Reading adapter files, and the closure of what pieces need."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.errors import PlatformDataError
from robosmi.transformations.knowledge.adapters.adapter_files import adapter_file, read_adapter_file
from robosmi.transformations.knowledge.adapters.adapter_records import (
    AdapterPin,
    ArgumentRange,
    ConventionalPort,
    InterruptStack,
    PortTable,
)
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces

WHOLE = """//# header drive.h
// Read from a library.

//# helper wheel
//#   include: <Servo.h> <math.h>
//#   timer: Timer1
static Servo wheel;

//# adapter drive
//#   for: void drive(int left, int pin)
//#   kind: semantic
//#   needs: wheel tools.h/low
//#   pin: pin pwm out signed servo
//#   port: drive_left = drive.left 12 digital out servo
//#   setup: wheel.attach(9);
//#   library: Adafruit NeoPixel
//#   table: port_pins 4
//#   symmetric: left pin
//#   fidelity: one frame
//#   fidelity: late
//#   range: left -128..128 or 999 beside servo.h/frames away from RX: it stands
//#   range: pin ..13: nothing moves
//#   limit: no ramp
//#   limit: no encoder
//#   stack: 40 31
//#   interrupt: TIMER1_COMPA_vect 21
//#   interrupt: TIMER0_COMPA_vect 51 23
//#   mcu: atmega328p
void drive(int32_t left, int32_t pin) {
  wheel.write(left + port_pins[0] + drive_left);
}
"""
LOW = "//# header a.h\n//# adapter low\n//#   for: void low(int pin, int us)\n//#   kind: oneToOne\n"
TOOLS = """//# header tools.h
//# adapter low
//#   for: void low(int pin)
//#   kind: oneToOne
void low(int32_t pin) { digitalWrite(pin, 0); }
"""


def read(tmp_path: Path, *texts: str) -> AdapterPieces:
    """The pieces of texts, each in a file of its own."""
    paths = [tmp_path / f"file{number}.cpp" for number in range(len(texts))]
    for path, text in zip(paths, texts, strict=True):
        path.write_text(text)
    return AdapterPieces([piece for path in paths for piece in read_adapter_file(path)])


def test_a_file_is_read_with_everything_that_it_declares(tmp_path: Path) -> None:
    wheel, drive, low = read(tmp_path, WHOLE, TOOLS)
    assert (wheel.kind, wheel.includes, wheel.timers) == ("helper", ["<Servo.h>", "<math.h>"], ["Timer1"])
    assert wheel.text == "static Servo wheel;"
    assert drive.signatures == ["void drive(int left, int pin)"]
    assert (drive.relation, drive.needs, drive.setup) == ("semantic", ["wheel", "tools.h/low"], ["wheel.attach(9);"])
    assert drive.pins == [AdapterPin("pin", "pwm", "out", True, "servo")]
    assert drive.ports == [ConventionalPort("drive_left", "drive.left", 12, "digital", "out", "servo")]
    assert (drive.libraries, drive.mcus) == (["Adafruit NeoPixel"], ["atmega328p"])
    assert (drive.fidelity, drive.limits) == ("one frame late", ["no ramp", "no encoder"])
    assert drive.ranges == [
        ArgumentRange("left", 0, -128, 128, [999], "servo.h/frames", "RX", "it stands"),
        ArgumentRange("pin", 1, None, 13, [], "", "", "nothing moves"),
    ]
    assert (drive.tables, drive.symmetric) == ([PortTable("port_pins", 4)], ["left", "pin"])
    assert (drive.stack, drive.stack_once, low.stack, low.stack_once) == (40, 31, -1, -1)
    assert drive.interrupts == [InterruptStack("TIMER1_COMPA_vect", 21, -1), InterruptStack("TIMER0_COMPA_vect", 51, 23)]
    assert drive.location.line == 9
    assert drive.text.startswith("void drive(")
    assert (low.header, low.name) == ("tools.h", "low")


def test_what_a_program_needs_stands_in_order(tmp_path: Path) -> None:
    known = read(tmp_path, WHOLE, TOOLS)
    needed = known.needed([("drive.h", "drive"), ("drive.h", "fly"), ("drive.h", "drive")], "atmega328p")
    assert [piece.name for piece in needed.pieces] == ["wheel", "low", "drive"]
    assert needed.unserved == {("drive.h", "fly"): "no adapter exists"}


def test_a_variant_for_another_microcontroller_does_not_serve(tmp_path: Path) -> None:
    known = read(tmp_path, WHOLE, TOOLS)
    unserved = known.needed([("drive.h", "drive")], "atmega2560").unserved
    assert unserved == {("drive.h", "drive"): "the atmega2560 has no 'drive'"}


def test_a_variant_counts_before_one_for_all(tmp_path: Path) -> None:
    low = "//# adapter low\n//#   for: void low(int pin)\n//#   kind: oneToOne\n"
    other = f"{low}//#   mcu: atmega2560 atmega1280\nvoid low(int32_t) {{ two(); }}\n"
    known = read(tmp_path, f"//# header tools.h\n{low}void low(int32_t) {{ one(); }}\n{other}")
    texts = [known.needed([("tools.h", "low")], mcu).pieces[0].text[20:26] for mcu in ("atmega328p", "atmega2560", "atmega1280")]
    assert texts == ["one();", "two();", "two();"]


ON_TWO = """\
//# header tools.h
//# adapter low
//#   for: void low(int pin)
//#   kind: oneToOne
//#   fidelity: exact
//#   limit: none of a kind
//#   limit avr: 5 V
//#   limit rp2040 samd: 3.3 V
//#   limit other: not measured
//#   range avr: pin 0..19: nothing happens
void low(int32_t pin) { (void)pin; }
"""


@pytest.mark.parametrize(
    ("architecture", "limits", "ranges"),
    [
        ("avr", ["none of a kind", "5 V"], 1),
        ("rp2040", ["none of a kind", "3.3 V"], 0),
        ("samd", ["none of a kind", "3.3 V"], 0),
        ("esp32", ["none of a kind", "not measured"], 0),
    ],
)
def test_a_key_may_be_for_some_architectures(architecture: str, limits: list[str], ranges: int, tmp_path: Path) -> None:
    known = AdapterPieces(read(tmp_path, ON_TWO), architecture=architecture)
    (piece,) = known.needed([("tools.h", "low")], "any").pieces
    assert (piece.limits, len(piece.ranges), piece.fidelity) == (limits, ranges, "exact")


def test_a_variant_for_an_architecture_counts_before_one_for_all_and_behind_one_for_a_microcontroller(tmp_path: Path) -> None:
    texts = ["//# header tools.h", "//# helper Io", "int one;", "//# helper Io", "//#   architecture: avr", "int two;"]
    texts += ["//# helper Io", "//#   mcu: atmega2560", "int three;"]
    pieces = list(read(tmp_path, "\n".join(texts)))

    def chosen(architecture: str, mcu: str) -> str:
        return AdapterPieces(pieces, architecture=architecture).needed([("tools.h", "Io")], mcu).pieces[0].text

    assert [chosen("", "x"), chosen("avr", "x"), chosen("rp2040", "x")] == ["int one;", "int two;", "int one;"]
    assert chosen("avr", "atmega2560") == "int three;"


def test_what_an_architecture_lacks_is_not_served_there(tmp_path: Path) -> None:
    layer = "//# header hal\n//# architecture avr\n//# helper Io\nint io;\n"
    tools = (
        "//# header tools.h\n//# helper low\n//#   needs: hal/Io\nint low;\n//# helper high\n//#   needs: tools.h/Io\nint high;\n"
    )
    pieces = list(read(tmp_path, layer, tools))
    wanted = [("tools.h", "low"), ("tools.h", "high")]  # the second one names the piece by the header that it once stood in
    assert [p.name for p in AdapterPieces(pieces, architecture="avr").needed(wanted, "m").pieces] == ["Io", "low", "high"]
    assert AdapterPieces(pieces, architecture="arm").needed(wanted, "m").unserved[wanted[0]] == "the m has no 'Io'"


@pytest.mark.parametrize(
    ("text", "line", "said"),
    [
        ("int x;\n", 1, "text before the first piece"),
        ("//# helper x\nint x;\n", 1, "the source platform's header is missing"),
        ("//# header a.h\n//# helpr x\nint x;\n", 2, "unknown kind of piece 'helpr'"),
        ("//# header a.h\n//# helper\nint x;\n", 2, "write"),
        ("//# header a.h\n//# helper x\n", 2, "'x' has no text"),
        ("//# header a.h\n//# helper x\n//#   nees: y\nint x;\n", 3, "is not a marker"),
        ("//# header a.h\n//# helper x\n//#   needs:\nint x;\n", 3, "is not a marker"),
        ("//# header a.h\n//# helper x\nint x;\n//#   needs: y\n", 4, "outside the head"),
        ("//# header a.h\n//# adapter x\n//#   kind: oneToOne\nint x;\n", 2, "has no function"),
        ("//# header a.h\n//# adapter x\n//#   for: int x()\nint x;\n", 2, "has no kind"),
        ("//# header a.h\n//# adapter x\n//#   kind: one\nint x;\n", 3, "unknown value 'one'"),
        ("//# header a.h\n//# helper x\n//#   pin: p digital\nint x;\n", 3, "is not a pin"),
        ("//# header a.h\n//# helper x\n//#   pin: p quantum in\nint x;\n", 3, "unknown value 'quantum'"),
        ("//# header a.h\n//# helper x\n//#   port: left 12 digital out\nint x;\n", 3, "is not a port"),
        ("//# header a.h\n//# helper x\n//#   table: pins\nint x;\n", 3, "is not a table"),
        ("//# header a.h\n//# helper x\n//#   stack: few\nint x;\n", 3, "is not a number of bytes"),
        ("//# header a.h\n//# helper x\n//#   ram: 4 2\nint x;\n", 3, "is not a number of bytes"),
        ("//# header a.h\n//# helper x\n//#   interrupt: TIMER1 20\nint x;\n", 3, "not an interrupt"),
        ("//# header a.h\n//# helper x\nint x;\n//# helper x\nint y;\n", 4, "'x' occurs twice"),
        ("//# header a.h\n//# helper x\nint x;\n//# header b.h\n", 4, "a second header"),
        ("//# header a.h\n//# helper x\n//#   ram avr: 4\nint x;\n", 3, "is not a marker"),
        ("//# header a.h\n//# architecture avr\n//# helper x\n//#   limit samd: y\nint x;\n", 4, "for one architecture already"),
        (
            f"{LOW}//#   pin: pinn digital out\nvoid low(int32_t pin, int32_t us) {{}}\n",
            5,
            "no parameter 'pinn' (did you mean 'pin'?)",
        ),
        (f"{LOW}//#   range: us 5 to 9: no\nvoid low(int32_t pin, int32_t us) {{}}\n", 5, "'us 5 to 9: no' is not a range"),
        (f"{LOW}//#   range: us none or 3: no\nvoid low(int32_t pin, int32_t us) {{}}\n", 5, "is not a range"),
        (f"{LOW}//#   range: us ..: no\nvoid low(int32_t pin, int32_t us) {{}}\n", 5, "is not a range"),
        (f"{LOW}//#   range: ms 5..9: no\nvoid low(int32_t pin, int32_t us) {{}}\n", 5, "'low' has no parameter 'ms'"),
        (f"{LOW}//#   symmetric: pin ms\nvoid low(int32_t pin, int32_t us) {{}}\n", 5, "'low' has no parameter 'ms'"),
        (f"{LOW}void high(int32_t pin, int32_t us) {{}}\n", 2, "has no 'low'"),
        (f"{LOW}//#   name: c_low\nvoid low(int32_t pin, int32_t us) {{ c_low(); }}\n", 5, "does not define a function 'c_low'"),
        (f"{LOW}void low(int32_t pin) {{}}\n", 3, "takes 1 parameter, 'void low(int pin, int us)' has 2"),
        (
            "//# header a.h\n//# adapter x\n//#   for: int y(int)\n//#   kind: oneToOne\nint x(int) {}\n",
            3,
            "not a signature of 'x'",
        ),
        (f"{LOW}//#   vector: TIMER2_OVF_vect\nvoid low(int32_t pin, int32_t us) {{}}\n", 5, "no ISR(TIMER2_OVF_vect)"),
        ("//# header a.h\n//# helper x\nint x;\nISR(INT0_vect) {}\n", 2, "handles INT0_vect"),
        ("//# header a.h\n//# helper x\n//#   port: left = a.left 12 digital out\nint x;\n", 3, "does not use the port 'left'"),
        ("//# header a.h\n//# helper x\n//#   table: pins 4\nint x;\n", 3, "does not use the table 'pins'"),
        (f"{LOW}\nvoid low(int32_t pin, int32_t us) {{\n  if (pin {{}}\n}}\n", 7, "'(' is never closed"),
        (f"{LOW}void low(int32_t pin, int32_t us) {{\n  us]++;\n}}\n", 5, "'{' is never closed"),
        (f"{LOW}void low(int32_t pin, int32_t us) {{\n}}\n}}\n", 7, "'}' has no opening bracket"),
        ("//# header a.h\n//# constant OFF\n#define ON 1\n", 2, "has no 'OFF'"),
    ],
)
def test_a_mistake_is_an_error_with_its_line(text: str, line: int, said: str, tmp_path: Path) -> None:
    with pytest.raises(PlatformDataError) as caught:
        read(tmp_path, text)
    assert said in str(caught.value)
    assert caught.value.location is not None
    assert caught.value.location.line == line
    assert caught.value.fix


@pytest.mark.parametrize(("needs", "said"), [("y", "'x' needs 'y'"), ("x", "adapters need each other: x -> x")])
def test_needs_that_cannot_be_met_are_errors(needs: str, said: str, tmp_path: Path) -> None:
    known = read(tmp_path, f"//# header a.h\n//# helper x\n//#   needs: {needs}\nint x;\n")
    with pytest.raises(PlatformDataError, match=said):
        known.needed([("a.h", "x")], "atmega328p")


def test_a_header_that_cannot_be_served_says_why(tmp_path: Path) -> None:
    path = tmp_path / "sound.cpp"
    file = adapter_file(path, "//# header sound.h\n// Read from a library.\n//# unsupported there is no memory for samples\n")
    assert (file.header, file.pieces, file.unsupported) == ("sound.h", [], "there is no memory for samples")


def test_a_missing_file_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(PlatformDataError, match="cannot be read"):
        read_adapter_file(tmp_path / "gone.cpp")
