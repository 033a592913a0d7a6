"""Random C programs from a grammar: what GNU C of 1999 has, the rare and the ugly included, with what must be found in them.

`program(seed)` gives text, names and comments; the same seed gives the same program. Whether a program is valid is GCC's to say
(`valid_c`): the grammar knows no types, so that some are not.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field

_UNARY = ("-", "~", "!", "+", "(char)", "(unsigned long long)", "(int)(float)", "__extension__ ", "sizeof ", "__alignof__ ")
_BINARY = ("+", "-", "*", "&", "|", "^", "<<", ">>", "<", ">=", "==", "!=", "&&", "||", "% 7 +", "? 1 :", "?:", ",")
_LITERALS = (
    "0",
    "1",
    "42u",
    "0x7fUL",
    "077LL",
    "0b101",
    "'a'",
    "'\\''",
    "'\\x41'",
    "L'b'",
    "'ab'",
    "'\\e'",
    "4294967296",
    "0xFFFFFFFFFFFFFFFFull",
    "123456789012345678901234567890",
    "(int)1.5e3f",
    "(int)0x1p4",
    "(int)1e4L",
    "(int)__real__ 2.0i",
    "(int)__imag__(1.0 + 3i)",
    '"abc"[1]',
    '("a" "b\\n" "\\x01")[0]',
    '(int)sizeof "\f\v"',
    '(int)L"w"[0]',
    "__LINE__",
    "(int)sizeof __func__",
    "'\\0'",
    "(int)sizeof(struct { int a : 3; })",
    "__builtin_offsetof(struct pair, b)",
    "(int)1e400",
    "0xe +1",
    "1 ?: 2",
)
_ATTRIBUTES = (
    "",
    "",
    "__attribute__((unused)) ",
    "static ",
    "inline static ",
    "__attribute__((noinline, used)) ",
    "extern ",
    "const ",
)
_COMMENTS = (
    "plain",
    "form\ffeed",
    "\v\x01\x1b[1m",
    "??/ ??= trigraph",
    "don't",
    '"',
    "umlaut ü",
    "* star *",
    "\x7f",
    "a\tb",
    "// again",
    "\x85",
)
_TOP = (
    "typedef struct pair {0}_t;",
    "struct {0} {{ int a; unsigned b : 3, : 0, c : 5; union {{ int d; char e[4]; }}; int zero[0]; }};",
    "struct {0} {{ int n; int flexible[]; }};",
    "struct __attribute__((packed)) {0} {{ char a; int b; }} __attribute__((aligned(8)));",
    "union {0} {{ int a; float b; struct {{ char x, y; }} c; }};",
    "enum {0} {{ {0}_A, {0}_B = 5, {0}_C = {0}_B << 2, }};",
    "enum {{ {0}_X = -1 }};",
    "typedef int {0}_f(int, ...), *{0}_p, {0}_a[3];",
    "typedef int {0}_v __attribute__((vector_size(16)));",
    "typedef __typeof__(int *) {0}_q;",
    '_Static_assert(sizeof(int) == 4, "four");',
    'asm(".set {0}_symbol, 1");',
    "#pragma {0} whatever",
    '#ident "{0}"',
    '#if 0\n#error "never" {0} don\'t\n#include <nowhere/at/all.h>\nint lost {0}(\n#endif',
    "#if defined(__GNUC__) && \\\n    !defined {0}_NOT\n#define {0}_YES 1\n#elif 1 / 0\n#error no\n#else\n??\n#endif",
    "#ifndef {0}_GUARD\n#define {0}_GUARD\n#endif",
    '#line 77 "{0}.y"',
    "#define {0}_H <stddef.h>\n#include {0}_H",
    "#",
    ";",
    "extern int {0}_external[], *{0}_pointer;",
    "int {0}_prototype(int (*)(void), char [static 2], int [*], ...);",
    "static int {0}_forward();",
    "int (*{0}_chooser(int a))(int) {{ return 0; }}",
    "#if 1\nint {0}_head(int x)\n#else\nint {0}_head(char *x)\n#endif\n{{ return 0; }}",
    "int {0}_cut(\n#ifdef NEVER\nchar a,\n#endif\nint b) {{\n"
    "#if defined(A) || !defined(B)\nif (b) {{\n#else\n{{\n#endif\nhigh(b); }}\nreturn 0; }}",
    "struct {0} {{\n#ifdef A\nint a;\n#elif defined(B)\n#else\nchar b;\n#endif\n}};",
    "enum {{ {0}_1,\n#if 0\n{0}_2,\n#endif\n{0}_3 }};",
    "#define {0}_LIST(X) X({0}_a) X({0}_b)\n#define {0}_ITEM(n) static int n;\n{0}_LIST({0}_ITEM)\n#undef {0}_ITEM",
    "#define high(p) high((p) + 0)",
    "#define int int",
    "#define while(c) for (; (c); )",
    "#define inline __inline\n#define register",
    "#define {0}_open {{\n#define {0}_close }}\nint {0}_braces(void) {0}_open return 0; {0}_close",
    '#pragma push_macro("{0}")\n#define {0} 1\n#pragma pop_macro("{0}")',
    "#if 0\n#if 1\n#else\n#endif\n#elif 0\n#elif 1\nint {0}_elif;\n#else\n#error no\n#endif",
)
_GLOBALS = (
    "int {0};",
    "int {0}, *{0}_2, {0}_3[4];",
    "volatile unsigned long long {0} = 1ULL << 40;",
    "int {0}[] = {{ [2] = 3, 4, [0 ... 1] = 9 }};",
    "struct pair {0} = {{ .b = 1, .a = 2 }};",
    "struct pair {0} = {{ b: 1, a: 2 }};",
    'char {0}[] = "text" "more\\\n of it\\f";',
    "int (*{0})(int) = 0;",
    "int (*{0}[3])(int, char *);",
    'static const char *const {0}[] = {{ "a", "\\001", 0 }};',
    "double _Complex {0} = 1.0 + 2.0i;",
    "_Bool {0} = 1;",
    "struct {{ int x; }} {0};",
    'int {0} __attribute__((section(".data.x")));',
    "int $dollar_{0} = 1, {0};",
    "int \\u00e9t\\u00e9_{0}, {0};",
    "__thread int {0};",
    "long double {0} = 1.0L;",
    "int {0}<:2:> = <% 1, 2 %>;",
    "struct pair {0}[2] = {{ [1].a = 5, {{ 1 }} }};",
    "int *{0} = (int[]) {{ 1, 2 }};",
    "typeof(1 + 1) {0};",
    "short unsigned int long_{0}, {0};",
)
_MACROS = (
    "#define {0} 1",
    "#define {0} (1 + \\\n   2)",
    "#define {0}(x) ((x) * 2)",
    "#define {0}(x, ...) (0, ## __VA_ARGS__, (x))",
    "#define {0}(rest...) (0, ## rest)",
    "#define {0}",
    "#define {0} 3 /* {0} it's\f */",
    "#\tdefine\v{0}\f4",
    "%:define {0}(a) %:a",
    "#define {0}(a, b) a ## b",
    "#define {0} do {{ }} while (0)",
    '#define {0} "\x01\f"',
    "# /* {0} gap */ define {0} {{",
    "#define {0}() 5",
)


@dataclass
class Program:
    """A program and what is in it.

    Attributes:
        text: its bytes.
        functions: names of the functions that it defines at file scope.
        globals, macros: names of these.
        comments: its comments with their delimiters, in order; None if the text was changed so that they are not known.
    """

    text: bytes = b""
    functions: list[str] = field(default_factory=list)
    globals: list[str] = field(default_factory=list)
    macros: list[str] = field(default_factory=list)
    comments: list[str] | None = field(default_factory=list)


class _Grammar:
    def __init__(self, chance: random.Random) -> None:
        self.chance = chance
        self.made = Program()
        self.number = 0
        self.callable: list[tuple[str, int]] = []
        self.scope: list[str] = []

    def name(self, stem: str) -> str:
        self.number += 1
        return f"{stem}{self.number}"

    def pick(self, *choices: str) -> str:
        return self.chance.choice(choices)

    # --- expressions, all of them whole numbers

    def expression(self, depth: int = 3) -> str:
        kind = self.chance.randrange(14) if depth else self.chance.randrange(3)
        inner = depth - 1
        if kind < 2 or (kind == 2 and not self.scope):
            return self.chance.choice(_LITERALS)
        if kind == 2:
            return self.chance.choice(self.scope)
        if kind == 3:
            return f"({self.chance.choice(_UNARY)}({self.expression(inner)}))"
        if kind in (4, 5):
            return f"(({self.expression(inner)}) {self.chance.choice(_BINARY)} ({self.expression(inner)}))"
        if kind == 6 and self.callable:
            name, count = self.chance.choice(self.callable)
            return f"{self.pick('', '(int)', '')}{name}({', '.join(f'({self.expression(inner)})' for _ in range(count))})"
        if kind == 7 and self.scope:
            return f"({self.chance.choice(self.scope)} {self.pick('=', '+=', '|=', '<<=')} {self.expression(inner)})"
        if kind == 8:
            local = self.name("se")
            return f"({{ int {local} = {self.expression(inner)}; {local} + 1; }})"
        if kind == 9:
            return f"((int[]) {{ {self.expression(inner)}, [3] = 1 }}){self.pick('[1]', '<:2:>')}"
        if kind == 10:
            return f"_Generic(({self.expression(inner)}), int: 1, char *: 2, default: 3)"
        if kind == 11:
            return f"__builtin_choose_expr(1, ({self.expression(inner)}), 0)"
        if kind == 12:
            return f"((struct pair) {{ .a = {self.expression(inner)} }}).{self.pick('a', 'b')}"
        return f"{self.pick('pause', 'high', 'get_$value', 'set_direction')}({self.expression(inner)})"

    # --- statements

    def comment(self) -> str:
        words = f"{self.name('no')} {self.chance.choice(_COMMENTS)}"
        if self.made.comments is None:
            return ""
        end = self.pick("", "\n", " \\ ")
        text = f"// {words}" if self.chance.random() < 0.5 else f"/* {words}{end} */"
        self.made.comments.append(text)
        return f" {text}\n"

    def block(self, depth: int) -> str:
        known = len(self.scope)
        text = ";\n" + "\n".join(self.statement(depth) for _ in range(self.chance.randrange(1, 4)))
        del self.scope[known:]
        return f"{self.pick('{', '{', '<%')}\n{text}\n{self.pick('}', '%>')}"

    def statement(self, depth: int) -> str:
        kind = self.chance.randrange(26) if depth else self.chance.randrange(6)
        value = self.expression()
        local = self.name("v")
        if kind < 2:
            self.scope.append(local)
            kind_of = self.pick("int", "register int", "volatile long", "static int", "__auto_type", "auto int", "typeof(int)")
            return f"{kind_of} {local} = 0;"
        if kind == 2:
            return self.comment()
        if kind == 3:
            return f"{value};"
        if kind == 4 and self.callable:
            name, count = self.chance.choice(self.callable)
            return f"{name}({', '.join('1' for _ in range(count))});"
        if kind in (4, 5):
            return self.pick(
                ";",
                'asm volatile("nop" ::: "memory");',
                f'__asm__("" : : "r"({value}));',
                "__builtin_trap();",
                f"(void)({value});",
            )
        body = self.block(depth - 1)
        label = self.name("l")
        return (
            lambda: f"if ({value}) {body}",
            lambda: f"if ({value}) {body} else {self.block(depth - 1)}",
            lambda: f"while ({value}) {body}",
            lambda: f"do {body} while ({value});",
            lambda: f"for (int {local} = 0; {local} < 3; {local}++) {body}",
            lambda: f"for (;;) {{ {body} break; }}",
            lambda: f"switch ({value}) {{ case 1 ... 5: {body} break; case 'x': default: ; }}",
            lambda: f"switch ({value}) case 3: {body}",
            lambda: f"{{ __label__ {label}; goto {label}; {label}: {body} }}",
            lambda: f"{{ void *{local}[] = {{ &&{label} }}; goto *{local}[0]; {label}: ; }}",
            lambda: f"int {local}(int nested) {{ return nested + ({value}); }} {local}(1);",
            lambda: f"int {local}[({value}) & 3]; {local}[0] = 1;",
            lambda: f"struct {{ int m : 2; char n[0]; }} {local}; {local}.m = {value};",
            lambda: f"{label}: __attribute__((unused)); {body}",
            lambda: (
                f"#if {self.pick('0', '1', 'defined X')}\n{body}\n#else\n{body if self.made.comments is None else ';'}\n#endif"
            ),
            lambda: f"enum {{ {local} = 3 }}; typedef int t{local}; t{local} z{local} = {local};",
            lambda: f"for (int i{local} = 0, j{local} = 1; i{local} < j{local}; i{local}++, --j{local}) continue;",
            lambda: f"extern int e{local}(void); int (*p{local})(void) = e{local}; (*p{local})(); p{local}();",
            lambda: f"if (0) {{ return{self.pick(' 1', '')}; }}",
            lambda: f'_Static_assert(1, ""); __extension__ long long {local} = 1; (void){local};',
            lambda: f"if (\n#if 1\n({value})\n#else\n0 +\n#endif\n) {body}",
            lambda: f"#ifdef NEVER\nif ({value}) {{\n#else\nif (!({value})) {{\n#endif\n;\n}}",
            lambda: f"high(\n#if {self.pick('0', '1')}\n1\n#else\n2\n#endif\n);",
            lambda: f"switch ({value}) {{\n#if 0\ncase 1:\n#else\ncase 2:\n#endif\ndefault: {body} }}",
        )[self.chance.randrange(24)]()

    # --- the file

    def function(self, name: str, returns: str = "int") -> str:
        count = self.chance.randrange(4)
        parameters = [self.name("p") for _ in range(count)]
        self.scope = [*parameters]
        if self.chance.random() < 0.2 and parameters:
            head = f"{returns} {name}({', '.join(parameters)})\n" + "".join(f"int {p};\n" for p in parameters)
        else:
            listed = ", ".join(f"{self.pick('int', 'register int', 'unsigned short')} {p}" for p in parameters)
            head = f"{self.chance.choice(_ATTRIBUTES)}{returns} {name}({listed or self.pick('void', '')})"
        body = "\n".join(self.statement(3) for _ in range(self.chance.randrange(1, 6)))
        self.callable.append((name, count))
        self.made.functions.append(name)
        return f"{head} {{\n{body}\nreturn 0;\n}}"

    def file(self) -> Program:
        made, chance = self.made, self.chance
        if chance.random() < 0.25:
            made.comments = None
        parts = ["struct pair { int a, b; };"]
        for _ in range(chance.randrange(2, 12)):
            kind = chance.randrange(5)
            if kind == 0:
                parts.append(chance.choice(_TOP).format(self.name("top")))
            elif kind == 1:
                name = self.name("g")
                made.globals.append(name)
                parts.append(chance.choice(_GLOBALS).format(name))
            elif kind == 2:
                name = self.name("M")
                made.macros.append(name)
                form = chance.choice(_MACROS)
                if "/*" in form and made.comments is not None:
                    made.comments.append(form[form.index("/*") : form.index("*/") + 2].format(name))
                parts.append(form.format(name))
            elif kind == 3:
                parts.append(self.comment())
            else:
                parts.append(self.function(self.name("f")))
        if chance.random() < 0.9:
            self.scope = []
            made.functions.append("main")
            first = "\n".join(self.statement(2) for _ in range(chance.randrange(4)))
            loop = f"while ({self.pick('1', '1', 'pause(1)')}) {self.block(2)}" if chance.random() < 0.7 else ""
            parts.append(
                f"{self.pick('int', 'void', '')} main({self.pick('void', '', 'int argc, char **argv')})\n{{\n{first}\n{loop}\n}}"
            )
        text = "\n".join(parts) + self.pick("\n", "", "\n\n")
        if made.comments is not None:  # some were made for statements that were not taken
            made.comments = sorted((c for c in made.comments if c in text), key=text.index)
        made.text = self.spoiled(text)
        return made

    def spoiled(self, text: str) -> bytes:
        """The text with other line ends, spaces, broken words, and bytes that are no UTF-8."""
        chance = self.chance
        if self.made.comments is None and chance.random() < 0.5:  # a line may be continued anywhere, in words too
            places = sorted((chance.randrange(len(text)) for _ in range(5)), reverse=True)
            for place in places:
                if text[place - 1].isalnum() and text[place].isalnum():
                    text = f"{text[:place]}\\\n{text[place:]}"
        if chance.random() < 0.2:
            text = text.replace(";\n", ";\f\n").replace(", ", ",\v")
        if self.made.comments is None and chance.random() < 0.3:
            text = text.replace("\n", "\r\n")
        data = text.encode()
        if self.made.comments is None:
            odd = chance.choice(
                (
                    b"",
                    b"/* \xff\xfe caf\xe9 */",
                    b"/* nul \0 */",
                    b"\0\n",
                    b"// \xed\xa0\x80 half",
                    b"\n\n/* long " + b"x" * 70_000 + b" */",
                )
            )
            data = (b"\xef\xbb\xbf" if chance.random() < 0.2 else b"") + data + (b"\n" + odd if odd else b"")
        return data


def program(seed: int) -> Program:
    """The program of a seed."""
    return _Grammar(random.Random(seed)).file()
