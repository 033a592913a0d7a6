"""simpletext.h: text. Semantics of the library's sources (libsimpletext, Simple-Libraries 1cc167c10).

What is printed was worked out with the library's own formatter, in single precision and with unsigned characters.
"""

from __future__ import annotations

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

SINGLE = ("Str", "StrLen", "Dec", "DecLen", "Bin", "BinLen", "Hex", "HexLen", "Float", "FloatPrecision", "Line")
CONTROLS = (
    "HOME", "CRSRXY", "CRSRLF", "CRSRRT", "CRSRUP", "CRSRDN", "BEEP", "BKSP", "TAB", "NL", "CLREOL", "CLRDN", "CR", "CRSRX",
    "CRSRY", "CLS",
)  # fmt: skip


def t(*names: str) -> list[str]:
    """The `header/name` of these names of simpletext.h."""
    return [f"simpletext.h/{name}" for name in names]


def typed(text: str, at_ms: float = 5) -> DeviceUse:
    """A person types a text."""
    return DeviceUse("typing", {}, {"points": [[at_ms, text]]})


@proves(*t("print", "printi", "sprint", "sprinti", "dprint", "dprinti", "dport_ptr", "simpleterm_pointer"))
def formats_are_those_of_the_library(uno: Uno) -> None:
    program = r"""
void setup() {
  const char *text = "str"; volatile uint8_t small = 7; unsigned char bytes[] = "ab"; char plain = (char)200;
  print("[%d][%5d][%05d][%u][%x][%b][%c][%s][%f][%.2f][%6.1f][%%]\n", 70000, -42, 42, small, 48879, 10, 'Q', text, 3.14159,
  -2.5, 9.96);
  print("[%05d][%3d][%08x][%8b][%012b][%10s][%ld][%-5d][%q][%u][%d]\n", -42, 12345, 0xBEEF, 5, 10, bytes, -1,
  (int32_t)0x80000000);
  dprint(simpleterm_pointer(), "[%f][%f][%f][%f][%.0f][%.3f]\n", 0.1, -0.02, 123456.78, 1234567.0, 2.5, 1e-3);
  char line[80];
  int32_t length = sprint(line, "[%9.2f][%.9f][%f][%10f]", -3.14159, 1.0 / 3, 16777216.0f, 0.999999);
  print("%s %d\n", line, length);
  print("%d\n", print("%f %f %f %f %f %.4f %.3f 50%", 25.5, 98.6, 0.007, 1e-7, 3.3e9, 2.7182818, 12.3456));
  print("%d %d %u %x\n", plain, 38000U, (uint32_t)-1, 0xDEADBEEF);
  length = sprinti(line, "%d%f%s", 5, "x"); printi("%s %d %x%f\n", line, length, 255, 1);
  dprinti(simpleterm_pointer(), "%05d%f|", -7); dprint(dport_ptr, "%cA%cB", 2, 0);
}
void loop() {}
"""
    trace = uno.run(
        program, t("print", "printi", "sprint", "sprinti", "dprint", "dprinti", "dport_ptr", "simpleterm_pointer"), 120
    )
    assert trace.text.split("\n") == [
        "[70000][-  42][00042][7][beef][1010][Q][str][3.141590][-2.50][   0.0][%]",
        "[-0042][12345][0000beef][     101][000000001010][ab][d][5d][][4294967295][-2147483648]",
        "[0.100000][-0.020000][123456.781250][1234567.000000][3][0.001]",
        "[    -3.14][0.333333][16777216.000000][  0.999999] 50",
        "25.500000 98.599998 0.007000 0.000000 3300000000.000000 2.7183 12.346 5072",
        "200 38000 4294967295 deadbeef",
        "5x 2 ff",
        "-0007|\x02A",
    ]


@proves(
    *t(
        *(f"put{each}" for each in SINGLE),
        *(f"write{each}" for each in SINGLE),
        "putln",
        "putChar",
        "putByte",
        "writeChar",
        "writeByte",
    )
)
def single_items_are_written(uno: Uno) -> None:
    def calls(begin: str, device: str) -> str:
        arguments = {
            "Str": '"a\\rb"', "StrLen": '"abc", 5', "Dec": "-70000", "DecLen": "-42, 4", "Bin": "10", "BinLen": "5, 6",
            "Hex": "-1",
            "HexLen": "255, 4", "Float": "2.5", "FloatPrecision": "-1.25, 7, 1", "Line": '"end"',
        }  # fmt: skip
        return " ".join(f"{begin}{each}({device}{said}); putByte('|');" for each, said in arguments.items())

    program = f"""
void setup() {{ {calls("put", "")} {calls("write", "dport_ptr, ")}
  print("%d ", putStr("12")); print("%d ", putStrLen("a b c", 4)); print("%d ", putLine("x")); print("%d ", putln("yz"));
  print("%d ", writeStr(dport_ptr, "123")); print("%d ", writeStrLen(dport_ptr, "abcdef", 3));
  print("%d ", writeLine(dport_ptr, "w"));
  putChar('\\n'); putChar('\\r'); putByte('\\r'); writeChar(dport_ptr, '\\r'); writeChar(dport_ptr, 'k');
  writeByte(dport_ptr, '\\r'); }}
void loop() {{}}
"""
    names = [*(f"put{each}" for each in SINGLE), *(f"write{each}" for each in SINGLE)]
    trace = uno.run(program, t(*names, "putln", "putChar", "putByte", "writeChar", "writeByte", "print", "dport_ptr"), 80)
    shared = ["a\nb", "  abc", "-70000"]
    assert trace.text.split("|")[:-1] == [
        *shared, "-0042", "1010", "000101", "ffffffff", "00ff", "2.500000", "   -1.3", "end\n",
        *shared, "-  42", "1010", "   101", "ffffffff", "  ff", "2.500000", "   -1.3", "end\n",
    ]  # fmt: skip
    tail = trace.text.split("|")[-1]
    assert tail == "122    a b 4 x\n1 yz\n2 1233 abc6 w\n1 \n\n\r\nk\r"


@proves(
    *t("putStrWithNpcVals", "printNumber", "float2string", "string2float", "set_endChars", "set_endCharSequence", *CONTROLS, "LF")
)
def line_ends_and_numbers_can_be_had_apart(uno: Uno) -> None:
    program = rf"""
void setup() {{ char text[24], *end;
  print("%d|", putStrWithNpcVals("a\tb\n~\x7f\xC8")); print("%d|", printNumber(dport_ptr, 70000, 16, 7, '_'));
  print("%s|", float2string(-1234.567, text, 12, 2)); float read = string2float("x = -12.5e3", &end); print("%f%s|", read, end);
  print("{"%c" * len(CONTROLS)}|", {", ".join(CONTROLS)}); print("%d|", sizeof(HOME) + LF);
  set_endCharSequence(dport_ptr, '<', '>'); putChar('\r'); set_endChars(dport_ptr, 'x', 'y'); print("\nxyz\r"); }}
void loop() {{}}
"""
    names = (
        "putStrWithNpcVals",
        "printNumber",
        "float2string",
        "string2float",
        "set_endChars",
        "set_endCharSequence",
        "print",
        "putChar",
        "dport_ptr",
    )
    trace = uno.run(program, t(*names, *CONTROLS, "LF"), 60)
    controls = bytes(range(1, 17)).decode().replace("\r", "\n")
    expected = f"a[9]b[10]\n~[127][200][0]7|__111707|    -1234.57|-12.500000e3|{controls}|14|<>\n<><>z\r"
    assert [each.byte for each in trace.console] == list(expected.encode())


@proves(*t("sscan", "sscani", "sscanAfterStr", "scan", "scani", "dscan", "dscani"))
def texts_are_scanned_as_in_the_library(uno: Uno) -> None:
    program = r"""
void setup() {
  int32_t a = -5, b = -5, c = -5, d = -5; int small = -5; float f = -5, g = -5; char s[20] = "????", u[20] = "????"; int32_t r;
  r = sscan("12 -34 ff 101 hello", "%d %d %x %b %s", &a, &b, &c, &d, s); print("%d %d %d %d %d %s\n", r, a, b, c, d, s);
  r = sscan("x=7, y=-2.75z", "x=%d, y=%f%c", &small, &f, u); print("%d %d %f %c\n", r, small, f, u[0]);
  r = sscan("1234", "%2d%2d", &a, &b); print("%d %d %d\n", r, a, b);
  r = sscan("abc 5 0.1 1.25", "%d %f %f", &a, &f, &g); print("%d %d %f %f\n", r, a, f, g);
  r = sscan("5. none", "%f %f", &f, &g); print("%d %f %f\n", r, f, g);
  r = sscani("50% 9", "%d%% %u", &a, &b); print("%d %d %d\n", r, a, b);
  r = sscan("abcdef 77", "%3s%s%d", s, u, &a); print("%d %s %s %d\n", r, s, u, a);
  r = sscan("1.0_1 -2147483648 FFFFFFFF", "%b %d %x", &a, &b, &c); print("%d %d %d %x\n", r, a, b, c);
  r = sscan("-7 +8", "%u %d", &a, &b); print("%d %d\n", r, sscan("none", "%d", &a));
  r = sscanAfterStr("t=1 v=70000", "v=", "%d", &a); print("%d %d %d\n", r, a, sscanAfterStr("abc", "x", "%d", &a));
  r = sscani("1 2.5", "%d %f", &a, &f); print("%d %d %f\n", r, a, f);
  r = scan("%d %f", &a, &f); print("%d %d %f\n", r, a, f); r = scani("%d%c", &small, s); print("%d %d %c\n", r, small, s[0]);
  r = dscan(dport_ptr, "%f", &f); print("%d %f\n", r, f); r = dscani(dport_ptr, "%x", &a); print("%d %d\n", r, a);
}
void loop() {}
"""
    names = ("sscan", "sscani", "sscanAfterStr", "scan", "scani", "dscan", "dscani", "print", "dport_ptr")
    trace = uno.run(program, t(*names), 120, [typed("-70000 2.5\n12x\r0.5\nfF\n", 30)])
    assert trace.text.split("\n")[:-1] == [
        "5 12 -34 255 5 hello", "3 7 -2.750000 z", "2 12 23", "3 5 0.100000 1.250000", "2 5.000000 0.000000",
        "2 50 9", "3 abc def 77", "3 5 -2147483648 ffffffff", "0 0", "1 70000 0", "1 1 5.000000",
        "2 -70000 2.500000", "2 12 x", "1 0.500000", "1 255",
    ]  # fmt: skip


READERS = ("Dec", "Bin", "Hex", "Float", "Str", "Char", "Byte")


@proves(*t(*(f"get{each}" for each in READERS), *(f"read{each}" for each in READERS), "terminal_setEcho", "terminal_checkEcho"))
def lines_and_characters_are_read(uno: Uno) -> None:
    program = r"""
void setup() { char line[12];
  print("%d %d %d %f|", getDec(), 1, 2, 0.5); int32_t value = getBin(); print("%d|", value); print("%x|", getHex());
  print("%f|", getFloat());
  print("%s|", getStr(line, 9)); print("%c|", getChar()); print("%d|", getByte());
  print("%d|", readDec(dport_ptr)); print("%d|", readBin(dport_ptr)); print("%d|", readHex(dport_ptr));
  print("%f|", readFloat(dport_ptr));
  print("%s|", readStr(dport_ptr, line, 3)); print("%c|", readChar(dport_ptr)); print("%d|", readByte(dport_ptr));
  print("%d|", terminal_checkEcho(dport_ptr)); terminal_setEcho(dport_ptr, 1); print("%d|", terminal_checkEcho(dport_ptr));
  getStr(line, 9); print("%s|%d", line, getDec());
}
void loop() {}
"""
    names = (*(f"get{each}" for each in READERS), *(f"read{each}" for each in READERS), "terminal_setEcho", "terminal_checkEcho")
    typing = [
        (5, "-70000\r1011\nbeef\n"),
        (15, "-2.5\rhello you\nq\xc8"),
        (30, "x42\n\n"),
        (45, "1F\n.25\nabcd\nz"),
        (60, "\n1\b\b23\x7f4\n9\n"),
    ]
    trace = uno.run(program, t(*names, "print", "dport_ptr"), 110, [typed(text, at) for at, text in typing])
    read = bytes(each.byte for each in trace.console)
    alone = b"-70000 1 2 0.500000|11|beef|-2.500000|hello you|\n|113|" + b"42|0|31|0.250000|abc|d|10|0|1|"
    assert read == alone + b"z\n1\b \b23\b \b4\nz|24"  # with its echo


@proves(*t("simpleterm_close", "simpleterm_open", "simpleterm_reopen", "simpleterm_set"))
def the_terminal_is_closed_and_opened(uno: Uno) -> None:
    program = r"""
void setup() { print("a%d", simpleterm_open() == simpleterm_pointer()); terminal *was = simpleterm_pointer();
  simpleterm_close(); print("hidden"); high(8); Serial.print(simpleterm_pointer() == 0);
  print("b%d", simpleterm_open() == was); low(8);
  simpleterm_set(0); print("hidden"); simpleterm_set(was); print("c");
  simpleterm_reopen(5, 6, 0, 9600); print("hidden");
  terminal *slow = simpleterm_reopen(0, 1, ECHO_RX_TO_TX, 57600); print("d%d", terminal_checkEcho(slow)); Serial.flush(); }
void loop() {}
"""
    names = ("simpleterm_close", "simpleterm_open", "simpleterm_reopen", "simpleterm_set", "simpleterm_pointer", "print")
    uses = [*t(*names, "terminal", "ECHO_RX_TO_TX", "terminal_checkEcho"), "simpletools.h/high", "simpletools.h/low"]
    trace = uno.run(program, uses, 1100)
    assert trace.text == "a1" + "1" + "b1" + "c" + "d1"
    assert trace.pulses("D8")[0][1] > 1_000_000
    gaps = [late.at_us - early.at_us for early, late in zip(trace.console, trace.console[1:], strict=False)]
    assert gaps[-1] > 150  # a byte of 57,600 baud


@proves("simpletools.h/term_cmd")
def terminal_commands_go_with_their_numbers(uno: Uno) -> None:
    program = """
void setup() { term_cmd(CLS); term_cmd(CRSRXY, 3, 13); term_cmd(CRSRX, 7); term_cmd(CRSRY, 9, 1); term_cmd(HOME, 5); }
void loop() {}
"""
    trace = uno.run(program, ["simpletools.h/term_cmd", *t("CLS", "CRSRXY", "CRSRX", "CRSRY", "HOME")], 20)
    assert [each.byte for each in trace.console] == [16, 2, 3, 13, 14, 7, 15, 9, 1]


@proves("simpletext.h/getStopCOGID", "simpletext.h/setStopCOGID")
def numbers_of_cogs_are_kept_one_higher(uno: Uno) -> None:
    program = (
        "void setup() { Serial.begin(115200); Serial.print(getStopCOGID(5)); Serial.print(setStopCOGID(7)); }\nvoid loop() {}\n"
    )
    assert uno.run(program, ["simpletext.h/getStopCOGID", "simpletext.h/setStopCOGID"], 20).text == "48"


@proves("simpletext.h/_dosprnt", "simpletext.h/_intsprnt")
def values_of_a_list_are_put_into_a_text(uno: Uno) -> None:
    program = """
char text[60];
int32_t real(const char *format, ...) {
  va_list l; va_start(l, format); int32_t n = _dosprnt(format, l, text); va_end(l); return n; }
int32_t whole(const char *format, ...) {
  va_list l; va_start(l, format); int32_t n = _intsprnt(format, l, text); va_end(l); return n; }
void setup() { Serial.begin(115200); int32_t n = real("%d %c %s %1.2f %x %b %%", -70000L, 'x' + 0L, "abc", 2.5, 255L, 5L);
  Serial.print(text); Serial.print(n); n = whole("|%03d%s", 7L, "!"); Serial.print(text); Serial.print(n); }
void loop() {}
"""
    first = "-70000 x abc 2.50 ff 101 %"
    trace = uno.run(program, ["simpletext.h/_dosprnt", "simpletext.h/_intsprnt"], 40)
    assert trace.text == f"{first}{len(first)}|007!5"


@proves("simpletext.h/_scanf_getl", "simpletext.h/_scanf_getf")
def numbers_are_found_in_a_text(uno: Uno) -> None:
    program = """
void say(const char *rest, int32_t number) { Serial.print(rest ? rest : "none"); Serial.print(' '); Serial.print(number);
  Serial.print('|'); }
int32_t n; float real;
void find(const char *text, int32_t base, uint32_t width, int32_t isSigned) {
  const char *rest = _scanf_getl(text, &n, base, width, isSigned);
  say(rest, n); }
void setup() { Serial.begin(115200); find("at -123,4", 10, 11, 1); find("z7Fg", 16, 11, 0); find("x1_01 2", 2, 11, 0);
  find("98765", 10, 3, 0); find("-5", 10, 9, 0); const char *rest = _scanf_getf("2.5V", &real); say(rest, (int32_t)(real * 10)); }
void loop() {}
"""
    trace = uno.run(program, ["simpletext.h/_scanf_getl", "simpletext.h/_scanf_getf"], 40)
    assert trace.text.split("|")[:-1] == [",4 -123", "g 127", " 2 5", "765 987", "none 987", "V 25"]


@proves(*t("print", "putStr", "putDec", "putChar", "writeChar"))
def the_program_goes_on_when_its_text_is_sent(uno: Uno) -> None:
    program = """
void setup() {
  uint32_t begun[6];
  delay(5);
  begun[0] = micros(); print("%s", "forty characters that take three ms....."); begun[1] = micros();
  putStr("twenty characters..."); begun[2] = micros(); putDec(-1234567); begun[3] = micros(); putChar('c');
  begun[4] = micros(); writeChar(simpleterm_pointer(), 'w'); begun[5] = micros();
  putLine("");
  for (uint8_t each = 0; each < 5; each++) { putDec(begun[each + 1] - begun[each]); putChar(' '); }
}
void loop() {}
"""
    used = t("print", "putStr", "putDec", "putChar", "writeChar", "putLine", "simpleterm_pointer")
    took = [int(each) for each in uno.run(program, used, 40).text.splitlines()[1].split()]
    for us, characters in zip(took, (40, 20, 8, 1, 1), strict=True):
        assert 85 * characters <= us < 110 * characters + 200
