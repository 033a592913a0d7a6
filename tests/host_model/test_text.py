"""simpletext.h, serial.h and stdio.h: text out and in, as the sources do it (libsimpletext, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

import pytest

from robosmi.base.data_text import as_whole
from robosmi.verify.simulation import DeviceUse
from tests.host_model.bench import ended, run, said
from tests.tools import require_tools


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "objcopy")


def told(statements: str, typed: str = "", headers: str = "") -> str:
    """The output of a main with these statements, when this is typed."""
    uses = [DeviceUse("typing", {}, {"points": [[0, typed]]})] if typed else []
    includes = "".join(f"#include <{name}>\n" for name in ("simpletools.h", *headers.split()))
    found = run(f"{includes}int main() {{ {statements} }}", 3000, uses)
    assert (found.status, found.cause) == ("finished", "")
    return found.trace.text


@pytest.mark.parametrize(
    ("call", "text"),
    [
        ('print("%d %u %x %b %c %s %%", -7, -1, 255, 5, 65, "ab")', "-7 4294967295 ff 101 A ab %"),  # dosprint.c
        ('print("%5d|%05d|%5d", 42, 42, -42)', "   42|00042|-  42"),  # the sign is written before the padding
        ('print("%8b|%08b|%4x|%10s|", 5, 5, 255, "ab")', "     101|00000101|  ff|ab|"),  # %s takes no width
        ('print("%ld %d", 5, 6)', "d 5"),  # an unknown letter prints nothing and takes no value
        ('print("%f %.2f %.0f %5.1f", 1.5, 3.14159, 2.5, -0.25)', "1.500000 3.14 3  -0.3"),  # floatToString.c
        ('print("%f %f %f", 0.1, 1234567.0, 100.0)', "0.100000 1234567.000000 100.000000"),
        ('print("%f %f", 1.0 / 0, -1.0 / 0)', "inf -inf"),
        ('print("%d%c%d", 1, HOME, 2)', "1\x012"),
        ('print("a\\nb\\rc")', "a\rb\rc"),  # both end characters go out as the end sequence
        ('printi("%d %f", 3, 1.5)', "3 "),
        ("putDec(-5); putChar(' '); putHex(255); putChar(' '); putBin(5); putChar(' '); putFloat(1.5)", "-5 ff 101 1.500000"),
        ('putStr("ab"); putln("cd"); putLine("ef"); putDecLen(7, 3); putHexLen(10, 2); putBinLen(2, 4); putStrLen("xy", '
            '3)', "abcd\ref\r0070a0010 xy"),
        ('putStrWithNpcVals("a\\n")', "a[10]\r[0]"),
        ("term_cmd(CRSRXY, 4, 2); term_cmd(CLS); term_cmd(CRSRX, 9)", "\x02\x04\x02\x10\x0e\x09"),
        ('char b[20]; int n = sprint(b, "%d:%s", 5, "xy"); print("%s %d", b, n)', "5:xy 4"),
        ('char b[20]; print("%s", float2string(12.345, b, 6, 2))', " 12.35"),
        ('writeDec(simpleterm_pointer(), 12); dprint(simpleterm_pointer(), " %d", 3)', "12 3"),
        ('printf("%5.2f|%-4d|%s|%ld|%c\\n", 3.14159, 5, "ab", 7L, 65); puts("x"); putchar(66)', " 3.14|5   |ab|7|A\nx\nB"),
        ('char b[20]; sprintf(b, "%03d %g", 7, 0.5); print("%s", b)', "007 0.5"),
        ('volatile float n = 0; n /= n; printf("%d %lld %5.1f|%-6G|%*.2f %f", 1, 2LL, n, -n, 4, -n, -1.0 / 0)',
            "1 2   nan|NAN   | nan -inf"),
    ],
)  # fmt: skip
def test_text_goes_out(call: str, text: str) -> None:
    assert told(f"{call};") == text


@pytest.mark.parametrize(
    ("call", "value"),
    [
        ('strcmp("ab", "ab")', 0),
        ('strcmp("m", "A")', 44),  # the difference of two characters, and one only where a text ends
        ('strcmp("ab", "abc")', -1),
        ('strcmp("abc", "ab")', 1),
        ('strcmp("a", "\\xe9")', 97 - 0xE9),
        ('strncmp("abz", "abc", 2)', 0),
        ('strncmp("abz", "abc", 3)', 23),
        ('strcasecmp("aB", "Ab")', 0),
        ('strncasecmp("aBd", "AbA", 3)', 3),
        ('memcmp("\\0d", "\\0a", 2)', 3),
    ],
)
def test_comparisons_of_texts_have_the_values_of_the_sources_library(call: str, value: int) -> None:
    """As propgcc's lib/string has them."""
    assert told(f'print("%d", {call});', headers="string.h") == str(value)


def test_a_character_takes_ten_bits_at_115200_baud() -> None:
    trace = run('#include <simpletools.h>\nint main() { print("%s", "0123456789"); high(3); }').trace
    assert [byte.at_us for byte in trace.console] == pytest.approx([(turn + 1) * 86.75 for turn in range(10)], abs=15)
    assert trace.levels("P3")[0][0] == pytest.approx(10 * 86.75, abs=60)


def test_print_beyond_its_buffer_ends_the_run() -> None:
    assert (
        run('#include <simpletools.h>\nint main() { char t[300]; memset(t, 65, 299); t[299] = 0; print("%s", t); }').status
        == "crashed"
    )


@pytest.mark.parametrize(
    ("statements", "typed", "text"),
    [
        ('int c = getChar(); print("%d", c)', "A", "65"),
        ('char s[10]; getStr(s, 9); print("<%s>", s)', "hello\r", "<hello>"),
        ('char s[4]; getStr(s, 3); print("<%s>", s)', "hello\r", "<hel>"),
        ('int a, b; int n = scan("%d %x", &a, &b); print("%d %d %d", n, a, b)', "12 ff\r", "2 12 255"),
        ('print("%d ", getDec()); print("%d ", getHex()); print("%d ", getBin()); print("%f", '
            'getFloat())', "-42\r1f\r101\r-2.5\r", "-42 31 5 -2.500000"),
        ('float f; char w[9]; sscan("x 1.25 word", "x %f %s", &f, w); print("%f %s", f, w)', "", "1.250000 word"),
        ('float f = 7, g = 7; int n = sscan("5. none", "%f %f", &f, &g); print("%d %f %f", n, f, g)', "", "2 5.000000 0.000000"),
        ('int n; sscanAfterStr("a=5,b=17", "b=", "%d", &n); print("%d", n)', "", "17"),
        ('terminal_setEcho(simpleterm_pointer(), 1); char s[10]; getStr(s, 9); print("<%s>", s)', "abx\bc\r", "abx\b \bc\r<abc>"),
        ('int a; float f; double d; scanf("%d %f %lf", &a, &f, &d); printf("%d %.2f %.2f", a, f, '
            'd)', "7 1.5 2.25\r", "7 1.50 2.25"),
        ('char s[20]; fgets(s, 20, stdin); printf("<%s>", s); printf("%d", getchar())', "line\nA", "<line\n>65"),
    ],
)  # fmt: skip
def test_text_comes_in(statements: str, typed: str, text: str) -> None:
    assert told(f"{statements};", typed) == text


def test_reading_blocks_until_something_is_typed() -> None:
    use = DeviceUse("typing", {}, {"points": [[250, "x"]]})
    trace = run("#include <simpletools.h>\nint main() { getChar(); high(3); while (1) pause(10); }", 500, [use]).trace
    assert trace.levels("P3")[0][0] == pytest.approx(250_000, abs=100)


def test_a_serial_line_at_pins_sends_and_receives() -> None:  # serial_rxtx.c
    use = DeviceUse("serial_line", {"receive": "P8", "transmit": "P9"}, {"baud": 9600, "points": [[100, "K"]]})
    text = (
        '#include <simpletools.h>\nint main() { serial *s = serial_open(8, 9, 0, 9600); dprint(s, "hi%d", 5); '
        'print("%d", serial_rxChar(s)); }'
    )
    found = run(text, 500, [use])
    assert found.trace.text == "75"
    assert bytes(as_whole(event.value) for event in found.trace.device_events if event.what == "byte") == b"hi5"


def test_memory_is_that_of_the_chip() -> None:
    assert said(
        'char *p = malloc(40000); char *q = malloc(1000); free(q); char *r = malloc(900); print("%d %d", p == 0, q == r);'
    ) == ["1", "1"]
    assert run("#include <stdlib.h>\nint main() { int n; free(&n); }").status == "crashed"


def test_random_numbers_are_those_of_the_library() -> None:  # lib/stdlib/rand.c
    body = 'print("%d ", rand()); print("%d ", rand()); srand(4000000000u); print("%d %x", rand(), RAND_MAX);'
    states = [(state * 1_103_515_245 + 12_345) % 2**32 for state in (12_345, 4_000_000_000)]
    assert said(body) == ["0", *(str(state >> 16 & 0x7FFF) for state in states), "7fff"]


def test_each_core_has_random_numbers_of_its_own() -> None:
    text = (
        "#include <simpletools.h>\nvolatile int theirs, seeded;\n"
        "void other(void *p) { theirs = rand(); srand(0); seeded = rand(); while (1); }\n"
        'int main() { int first = rand(); cog_run(other, 50); pause(10); print("%d %d %d", first, seeded, rand()); }'
    )
    second = (12_345 * 1_103_515_245 + 12_345) % 2**32 >> 16 & 0x7FFF
    assert run(text, 100).trace.text == f"0 0 {second}"


def test_the_number_of_an_error_is_printed() -> None:  # perror in lib/string/strerror.c, whose words are its own
    text = ended('#include <stdio.h>\n#include <errno.h>\nint main() { errno = 5; perror("say"); perror(0); }', 100).text
    assert text == "say: error 5\nerror 5\n"
