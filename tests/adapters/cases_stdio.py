"""stdio.h: printf, scanf and single characters. Semantics of the library's sources (propgcc b280e7a77, lib/stdio) and of C99."""

from __future__ import annotations

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves


def c(*names: str) -> list[str]:
    """The `header/name` of these functions of stdio.h."""
    return [f"stdio.h/{name}" for name in names]


@proves(*c("printf", "sprintf", "snprintf", "putchar", "puts"))
def texts_and_numbers_are_printed(uno: Uno) -> None:
    program = r"""
void setup() {
  char text[64]; int32_t count;
  c_printf("[%d][%5d][%-5d|][%05d][%+d][% d][%.3d][%8.3d][%u][%ld][%hd][%hhu]\n", 70000, -42, 42, -42, 7, 7, 5, -5, -1,
    123456L, 70000, 300);
  c_printf("[%x][%X][%#x][%#o][%08lx][%c][%3c][%-3c|][%s][%6s][%-6s|][%.2s][%%][%*d][%.*f]\n", 48879, 0xBEEF, 255, 8,
    0xBEEFL, 'Q', 'a', 'b',
    "str", "ab", "cd", "efgh", 4, 7, 2, 2.5);
  c_printf("[%f][%.2f][%8.3f][%-8.1f|][%08.2f][%+.1f][%.0f][%#.0f][%f][%f]\n", 3.5, -2.126, 9.9996, 0.25, -1.5, 2.0, 2.6,
    3.0, 123456.0, 0.0);
  c_printf("[%e][%.2E][%g][%g][%g][%.3g][%G]\n", 1500.0, 0.000125, 0.5, 1e-7, 100000.0, 1234567.0, 1e10);
  count = c_sprintf(text, "%d-%s-%.1f", 5, "x", 9.96); c_printf("%s %d\n", text, count);
  count = c_snprintf(text, 6, "%d", 12345678L); c_printf("%s %d\n", text, count);
  count = c_puts("line") * 100 + c_puts("") * 10 + (c_putchar('k') == 'k'); c_putchar('\r'); c_printf("%d", count);
}
void loop() {}
"""
    trace = uno.run(program, c("printf", "sprintf", "snprintf", "putchar", "puts"), 120)
    assert trace.text.split("\n") == [
        "[70000][  -42][42   |][-0042][+7][ 7][005][    -005][4294967295][123456][4464][44]",
        "[beef][BEEF][0xff][010][0000beef][Q][  a][b  |][str][    ab][cd    |][ef][%][   7][2.50]",
        "[3.500000][-2.13][  10.000][0.3     |][-0001.50][+2.0][3][3.][123456.000000][0.000000]",
        "[1.500000e+03][1.25E-04][0.5][1e-07][100000][1.23e+06][1E+10]",
        "5-x-10.0 8",
        "12345 8",
        "line",
        "k",
        "501",
    ]


@proves(*c("scanf", "sscanf", "getchar", "gets"))
def texts_and_numbers_are_read(uno: Uno) -> None:
    program = r"""
void setup() {
  int32_t a = 0, b = 0; int small = 0; short half = 0; float f = 0; char s[16], u[16]; int32_t r;
  r = c_sscanf("12 -70000 ff 2.5e1 word", "%d %d %x %f %s", &small, &a, &b, &f, s); c_printf("%d %d %d %d %.2f %s\n", r,
    small, a, b, f, s);
  r = c_sscanf("x=123456,abc;z", "x=%3d%hd,%[a-c];%c", &a, &half, s, u); c_printf("%d %d %d %s %c\n", r, a, half, s, u[0]);
  r = c_sscanf("5 apples 0x1F 017", "%*d %[^ ] %i %i", s, &a, &b); c_printf("%d %s %d %d\n", r, s, a, b);
  c_printf("%d %d\n", c_sscanf("", "%d", &a), c_sscanf("q", "%d", &a));
  r = c_scanf("%d %f", &a, &f); c_printf("%d %d %.1f\n", r, a, f);
  c_printf("%c", c_getchar()); c_printf("%d|", c_getchar()); c_printf("%s|", c_gets(s)); c_printf("%s", s);
}
void loop() {}
"""
    typing = DeviceUse("typing", {}, {"points": [[30, "-99999 .5\nA\rnext line\n"]]})
    trace = uno.run(program, c("scanf", "sscanf", "getchar", "gets", "printf"), 100, [typing])
    assert trace.text.split("\n") == [
        "5 12 -70000 255 25.00 word", "4 123 456 abc z", "3 apples 31 15", "-1 0", "2 -99999 0.5", "A10|next line|next line",
    ]  # fmt: skip


@proves("simpletools.h/sd_mount", *c("fopen", "fclose", "fseek", "ftell", "rewind", "fprintf"))
def files_are_on_a_card(uno: Uno) -> None:
    """The library SD is a stand-in with a card in RAM; the target's own functions read and write the streams."""
    program = r"""
void setup() {
  char text[40];
  c_printf("%d", fopen("a.txt", "w") == 0); c_printf("%d", sd_mount(12, 13, 4, 10) != 0);
  c_printf("%d|", sd_mount(MISO, SCK, MOSI, 10));
  FILE *fp = fopen("a.txt", "w"); fwrite("Testing 1 2 3...\n", 1, 17, fp);
  c_printf("%d,", c_fprintf(fp, "%d %.2f\n", 70000, 2.5));
  c_printf("%d,%d|", c_fclose(fp), c_fclose(fp));
  fp = fopen("a.txt", "r"); fread(text, 1, 7, fp); text[7] = 0; c_printf("%s,%d|", text, c_ftell(fp));
  c_printf("%d,", c_fseek(fp, 17, SEEK_SET)); fgets(text, sizeof text, fp); c_printf("%s", text);
  c_printf("%d", fgetc(fp) == EOF); c_printf("%d,", feof(fp) != 0); c_rewind(fp); c_printf("%c,", fgetc(fp));
  c_printf("%d,", c_fseek(fp, -2, SEEK_CUR)); c_printf("%d,", c_fseek(fp, -3, SEEK_END)); c_printf("%c|", fgetc(fp));
  c_fclose(fp);
  fp = fopen("a.txt", "a"); fputs("end", fp); c_printf("%d", c_fflush(fp)); c_fclose(fp);
  fp = fopen("a.txt", "r+"); fputc('R', fp); c_fseek(fp, 0, SEEK_END); c_printf("%d,%d|", c_ftell(fp), c_ftell(0)); c_rewind(fp);
  fgets(text, sizeof text, fp); c_printf("%s", text); FILE *other = fopen("b.txt", "w"); c_printf("%d", fopen("c.txt", "w") == 0);
  c_fclose(other); c_fprintf(stdout, "%s", "out"); c_printf("%d", fopen("none.txt", "r") == 0);
}
void loop() {}
"""
    names = c("fopen", "fclose", "fseek", "ftell", "rewind", "fprintf", "fflush", "printf")
    trace = uno.run(program, ["simpletools.h/sd_mount", *names], 120)
    assert trace.text.split("|") == [
        "110", "11,-1,0", "Testing,7", "0,70000 2.50\n11,T,-1,0,5", "031,-1", "Resting 1 2 3...\n1out1",
    ]  # fmt: skip


@proves(*c("fflush"))
def what_is_flushed_is_on_the_card(uno: Uno) -> None:
    program = r"""
void setup() { Serial.begin(115200); sd_mount(MISO, SCK, MOSI, 10); FILE *writing = fopen("a.txt", "w"); fputs("abc", writing);
  FILE *reading = fopen("a.txt", "r"); Serial.print(fgetc(reading)); Serial.print(c_fflush(writing)); clearerr(reading);
  Serial.print((char)fgetc(reading)); }
void loop() {}
"""
    trace = uno.run(program, ["simpletools.h/sd_mount", *c("fopen", "fflush")], 60)
    assert trace.text == "-1" + "0" + "a"


@proves(*c("fputs", "fputc", "putc", "fgets", "fgetc", "getc", "perror"))
def the_terminal_is_a_file_too(uno: Uno) -> None:
    program = r"""
char text[20];
void setup() { Serial.begin(115200); stdin = stdout = stderr = console_file();
  c_printf("%d%d", c_fputs("x", 0), c_fputc('x', 0)); c_fputs("|put,", stdout); c_fputc('a', stdout); c_putc('b', stderr);
  c_printf("|%d%d", c_fgets(text, 20, 0) == 0, c_fgetc(0)); c_printf("|%d%d", c_fprintf(0, "lost"), c_fflush(stdout));
  c_fprintf(stderr, "%d told|", 70000L); c_fgets(text, 8, stdin); c_printf("|%s|", text);
  c_printf("%c", c_fgetc(stdin)); c_printf("%c|", c_getc(stdin)); errno = 5; perror("say"); perror(0); }
void loop() {}
"""
    typing = DeviceUse("typing", {}, {"points": [[30, "one\ntwo"]]})
    names = c("fputs", "fputc", "putc", "fgets", "fgetc", "getc", "perror", "printf", "fprintf", "fflush")
    trace = uno.run(program, names, 100, [typing])
    assert trace.text.split("|") == ["-1-1", "put,ab", "1-1", "-1070000 told", "", "one\n", "tw", "say: error 5\nerror 5\n"]


@proves(*c("vsnprintf", "vsprintf", "vprintf"))
def values_of_a_list_are_printed(uno: Uno) -> None:
    program = r"""
char text[80];
int32_t in(const char *format, ...) {
  va_list l; va_start(l, format); int32_t n = c_vsprintf(text, format, l); va_end(l); return n; }
int32_t cut(const char *format, ...) {
  va_list l; va_start(l, format); int32_t n = c_vsnprintf(text, 5, format, l); va_end(l); return n; }
int32_t out(const char *format, ...) { va_list l; va_start(l, format); int32_t n = c_vprintf(format, l); va_end(l); return n; }
void setup() {
  Serial.begin(115200); int32_t n = in("%ld %d %c %s %5.2f %u %% %*d", 70000L, -3L, 120L, "abc", 2.5, 65535UL, 3L, 7L);
  Serial.print(text); Serial.print('|'); Serial.print(n); Serial.print('|'); n = cut("%s%d", "abc", 123L); Serial.print(text);
  Serial.print(n); Serial.print('|'); n = out("%lu,%x", 4000000000UL, 255L); Serial.print('|'); Serial.print(n); }
void loop() {}
"""
    trace = uno.run(program, c("vsnprintf", "vsprintf", "vprintf"), 60)
    first = "70000 -3 x abc  2.50 65535 %   7"
    assert trace.text.split("|") == [first, str(len(first)), "abc16", "4000000000,ff", "13"]


@proves("simpletools.h/sd_mount", *c("remove", "vfprintf"))
def files_are_removed_and_written_from_lists(uno: Uno) -> None:
    program = r"""
char text[20];
int32_t to(FILE *file, const char *format, ...) {
  va_list l; va_start(l, format); int32_t n = c_vfprintf(file, format, l); va_end(l); return n; }
void setup() { Serial.begin(115200); sd_mount(MISO, SCK, MOSI, 10); FILE *file = fopen("a.txt", "w");
  Serial.print(to(file, "%ld!", 70000L));
  c_fclose(file); file = fopen("a.txt", "r"); fgets(text, 20, file); c_fclose(file); Serial.print(text); to(stdout, "%s", "out");
  Serial.print(to(0, "lost"));
  Serial.print(c_remove("a.txt")); Serial.print(c_remove("a.txt")); Serial.print(fopen("a.txt", "r") == 0); }
void loop() {}
"""
    names = c("fopen", "fclose", "remove", "vfprintf")
    assert uno.run(program, ["simpletools.h/sd_mount", *names], 100).text == "670000!out-10-11"
