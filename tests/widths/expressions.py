"""Programs of random expressions over all of C's integer types, for the comparison with a 32-bit machine.

Each case is a function; what it changes is local, so that cases do not depend on each other.
"""

from __future__ import annotations

import random
from collections.abc import Callable

HEAD = """\
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <ctype.h>
#include <limits.h>
#include <stdarg.h>
#define K 300
#define BIG 70000
#define AREA (K * 50)
#define SCALE(x) ((x) * 77)
#define WORD(h, l) (((h) << 8) | (l))
#define LARGER(a, b) ((a) > (b) ? (a) : (b))
#define SQUARE(x) ((x) * (x))
#define NEGATED(x) (-(x))
#define BIT(n) (1 << (n))
#define LOW(x) ((x) & 0xFF)
#define TWICE_WORD(h) (WORD(h, 3) + WORD(h, 4))
enum plain { E1 = 3, E2 = 40000 };
enum small { S1, S2 = 7 };
enum mixed { M1 = -5, M2 = 30000 };
typedef unsigned int word_t;
typedef short small_t;
typedef int (*unary_t)(int);
struct record { unsigned f : 9; int g : 7; unsigned wide : 20; unsigned flags : 16; char c; short s; unsigned char b; int i; };
struct record st = { 400, -20, 70000, 65535, 90, -300, 200, 100000 };
const int limit = 50000;
short as[4] = { 300, -2, 32767, -32768 };
unsigned char ab[4] = { 0x90, 0x10, 0xFF, 0x7F };
int ai[4] = { 70000, -70000, 3, -1 };
char text[8] = "70000";
enum small e0 = S2;
enum mixed m0 = M1;
word_t t0 = 65000;
small_t y0 = -7;
small_t twice(small_t v) { return v * 2; }
unsigned wide(unsigned v) { return v + 1; }
char narrow(int v) { return v; }
int plus(int v) { return v + 40000; }
unary_t chosen = plus;
int sum(int n, ...) {
  va_list list;
  int total = 0;
  va_start(list, n);
  while (n-- > 0) total += va_arg(list, int);
  va_end(list);
  return total;
}
"""
TYPES = {
    "char": ("c", 0, 255), "signed char": ("d", -128, 127), "unsigned char": ("b", 0, 255), "short": ("s", -32768, 32767),
    "unsigned short": ("w", 0, 65535), "int": ("i", -90000, 90000), "unsigned": ("u", 0, 90000), "long": ("l", -90000, 90000),
}  # fmt: skip
_NAMES = [f"{name}{n}" for name, _, _ in TYPES.values() for n in range(3)] + [
    "st.f", "st.g", "st.wide", "st.flags", "st.c", "st.s", "st.b", "st.i", "e0", "m0", "t0", "y0", "limit",
]  # fmt: skip
_CONSTANTS = [
    "0", "1", "2", "7", "100", "255", "300", "32767", "40000", "65535", "0x1", "0x7F", "0xFF", "0x7FFF", "0x8000", "0xFFFF",
    "017", "0b101", "5u", "1000u", "70000L", "'A'", "'\\xC8'", "'\\377'", "K", "BIG", "AREA", "E1", "E2", "S2", "M1", "M2",
    "sizeof(int)", "sizeof(short)", "sizeof(as)", "INT_MAX", "strlen(text)", "atoi(text)",
]  # fmt: skip
_DIVISORS = ["3", "7", "300", "40000", "9u", "-5", "(b0 | 1)", "(w1 | 1)", "(s1 | 1)", "(c0 | 1)", "sizeof(int)"]
_RETURNED = ["int", "int", "long", "unsigned", "short", "unsigned short", "word_t"]


class Programs:
    """Generates programs.

    Args:
        seed: seed of the random numbers.
    """

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)

    def program(self, cases: int) -> str:
        """A program with so many cases, named `case_x0` and on."""
        lines = [HEAD]
        for kind, (name, least, most) in TYPES.items():
            lines += [f"{kind} {name}{n} = {self._random.randint(least, most)};" for n in range(3)]
        lines += [self._case(f"x{number}") for number in range(cases)]
        return "\n".join([*lines, "int main(void) {}", ""])

    def _case(self, name: str) -> str:
        kind = self._random.choice(_RETURNED)
        body = self._random.choices([self._returned, self._compound, self._switch, self._loop, self._declared], [12, 5, 1, 1, 2])[
            0
        ]()
        return f"{kind} case_{name}(void) {{ {body} }}"

    def _returned(self) -> str:
        return f"return {self.expression(self._random.randint(2, 4))};"

    def _compound(self) -> str:
        kind = self._random.choice(list(TYPES))
        operator = self._random.choice(["+=", "-=", "*=", "|=", "&=", "^=", "/=", "%=", "<<=", ">>="])
        right = str(self._random.randrange(20)) if operator in ("<<=", ">>=") else self.expression(2)
        if operator in ("<<=", ">>=") and self._random.random() < 0.4:
            right = f"({self.expression(1)}) & 15"
        if operator in ("/=", "%="):
            right = self._random.choice(["3", "7", "300", "9u", "-5", "(b0 | 1)", "(s1 | 1)"])
        step = self._random.choice(["", "v++; ", "--v; "])
        return f"{kind} v = {self.expression(2)}; v {operator} {right}; {step}return v;"

    def _switch(self) -> str:
        values = self._random.sample(["200", "0x8000", "65535", "-1", "40000", "3", "E1 + 4"], 3)
        rest = "".join(f" case {value}: return {number};" for number, value in enumerate(values))
        return f"switch ({self.expression(1)}) {{{rest} }} return 9;"

    def _loop(self) -> str:
        kind = self._random.choice(["int", "short", "unsigned char", "char"])
        body = self.expression(2).replace("c0", "n")
        return f"int r = 0; {kind} n; for (n = 0; n < {self._random.randrange(3, 40)}; n++) r ^= {body}; return r;"

    def _declared(self) -> str:
        kind, other = self._random.choice(list(TYPES)), self._random.choice(list(TYPES))
        return (
            f"{kind} v[3] = {{ ({kind})({self.expression(2)}), ({kind})({self.expression(1)}) }}; "
            f"{other} k = ({other}){self.leaf()}; return v[k & 1] {self._random.choice(['+', '-', '*', '&', '<', '=='])} k;"
        )

    def leaf(self) -> str:
        """An expression without operators."""
        chance = self._random.random()
        if chance < 0.66:
            return self._random.choice(_NAMES)
        return self._random.choice(_CONSTANTS)

    def expression(self, depth: int) -> str:
        """A random expression."""
        if depth <= 0 or self._random.random() < 0.1:
            return self.leaf()
        kinds: list[tuple[Callable[[int], str], int]] = [
            (self._binary, 24), (self._compared, 12), (self._unary, 8), (self._shifted, 12), (self._divided, 8),
            (self._chosen, 6), (self._macro, 10), (self._indexed, 6), (self._cast, 7), (self._called, 8), (self._assigned, 2),
        ]  # fmt: skip
        made = self._random.choices([k for k, _ in kinds], [w for _, w in kinds])[0]
        return made(depth - 1)

    def _binary(self, depth: int) -> str:
        return f"({self.expression(depth)} {self._random.choice('+-*&|^')} {self.expression(depth)})"

    def _compared(self, depth: int) -> str:
        operator = self._random.choice(["<", ">", "<=", ">=", "==", "!=", "&&", "||"])
        return f"({self.expression(depth)} {operator} {self.expression(depth)})"

    def _unary(self, depth: int) -> str:
        return f"{self._random.choice('-~!+')}({self.expression(depth)})"

    def _shifted(self, depth: int) -> str:
        count = self._random.choice([str(self._random.randrange(20)), f"({self.expression(0)} & 15)"])
        return f"({self.expression(depth)} {self._random.choice(['<<', '>>'])} {count})"

    def _divided(self, depth: int) -> str:
        by = self._random.choice(
            ["3", "7", "300", "40000", "9u", "-5", "(b0 | 1)", "(w1 | 1)", "(s1 | 1)", "(c0 | 1)", "sizeof(int)"]
        )
        return f"({self.expression(depth)} {self._random.choice('/%')} {by})"

    def _chosen(self, depth: int) -> str:
        return f"({self.expression(depth)} ? {self.expression(depth)} : {self.expression(depth)})"

    def _macro(self, depth: int) -> str:
        name = self._random.choice(["SCALE", "SQUARE", "NEGATED", "LOW", "WORD", "LARGER", "BIT", "TWICE_WORD"])
        if name == "BIT":
            return f"BIT({self._random.randrange(31)})"
        if name in ("WORD", "LARGER"):
            return f"{name}({self.expression(depth)}, {self.expression(0)})"
        return f"{name}({self.expression(depth)})"

    def _indexed(self, depth: int) -> str:
        array = self._random.choice(["as", "ab", "ai", "text", '"\\310zy"'])
        if self._random.random() < 0.3:
            return f"*({array} + ({self.expression(depth)} & 3))"
        return f"{array}[({self.expression(depth)}) & 3]"

    def _cast(self, depth: int) -> str:
        kind = self._random.choice([*TYPES, "word_t", "small_t", "int16_t", "uint8_t", "uint16_t", "size_t", "unsigned long"])
        return f"(({kind}){self.expression(depth)})"

    def _called(self, depth: int) -> str:
        name = self._random.choice(["twice", "wide", "narrow", "plus", "chosen", "abs", "sum", "toupper", "labs", "difference"])
        inner = self.expression(depth)
        if name == "sum":
            return f"sum(3, {inner}, {self.leaf()}, {self.leaf()})"
        if name == "toupper":
            return f"toupper(({inner}) & 0x7F)"
        if name == "difference":
            return f"(&as[({inner}) & 3] - as)"
        return f"{name}({inner})"

    def _assigned(self, depth: int) -> str:
        return f"(({self.expression(depth)}), {self.expression(depth)})"
