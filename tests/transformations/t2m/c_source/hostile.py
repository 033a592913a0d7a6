"""Texts that are made to break a C reader, and the process that reads them: it alone dies where the parser does.

Usage: python -m tests.transformations.t2m.c_source.hostile FOLDER: reads every case, one line of JSON each. The tests start it
with bounded memory, so that a crash, a hang or a flood of memory is a failed test and not a dead test run.
"""

from __future__ import annotations

import json
import resource
import sys
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

DEEP = 10_000
TAIL = "\nint tail(void) { return high(2); }\n"
DOUBLING = "".join(f"#define A{i} A{i - 1} + A{i - 1}\n" for i in range(1, 40))
CHAINED = "".join(f"#define A{i} A{i - 1}\n" for i in range(1, 3000))
CASES: dict[str, Callable[[], str]] = {
    "parentheses": lambda: f"int x = {'(' * DEEP}1{')' * DEEP};{TAIL}",
    "blocks": lambda: f"void f(void) {{{'{' * DEEP}low(1);{'}' * DEEP}}}{TAIL}",
    "sum": lambda: f"int f(int a) {{ return {'a + ' * 10 * DEEP}a; }}{TAIL}",
    "negations": lambda: f"int f(int a) {{ return {'!' * 10 * DEEP}a; }}{TAIL}",
    "dereferences": lambda: f"int f(int a) {{ return {'*' * DEEP}a; }}{TAIL}",
    "conditions": lambda: f"int f(int a) {{ return {'a ? 1 : ' * 10 * DEEP}a; }}{TAIL}",
    "assignments": lambda: f"int f(int a) {{ {'a = ' * DEEP}a; return a; }}{TAIL}",
    "commas": lambda: f"int f(int a) {{ {'a, ' * DEEP}a; return a; }}{TAIL}",
    "casts": lambda: f"int f(int a) {{ return {'(int)' * DEEP}a; }}{TAIL}",
    "sizes": lambda: f"int f(int a) {{ return {'sizeof ' * DEEP}a; }}{TAIL}",
    "else if": lambda: f"int f(int a) {{ {'if (a) low(a); else ' * DEEP}low(1); return a; }}{TAIL}",
    "ifs": lambda: f"int f(int a) {{ {'if (a) ' * DEEP}low(1); return a; }}{TAIL}",
    "loops": lambda: f"int f(int a) {{ {'while (a) ' * DEEP}low(1); return a; }}{TAIL}",
    "cases": lambda: f"int f(int a) {{ switch (a) {{ {' '.join(f'case {i}:' for i in range(DEEP))} low(1); }} return a; }}{TAIL}",
    "calls": lambda: f"int f(int a) {{ return {'low(' * DEEP}a{')' * DEEP}; }}{TAIL}",
    "indices": lambda: f"int f(int *a) {{ return {'a[' * DEEP}0{']' * DEEP}; }}{TAIL}",
    "members": lambda: f"struct s {{ struct s *n; }};\nint f(struct s *a) {{ return a{'->n' * DEEP} != 0; }}{TAIL}",
    "pointers": lambda: f"int {'*' * DEEP}p;{TAIL}",
    "dimensions": lambda: f"int p{'[1]' * DEEP};{TAIL}",
    "records": lambda: f"{'struct a { ' * DEEP}int x; {'} b; ' * DEEP}{TAIL}",
    "initial values": lambda: f"int a[] = {'{' * DEEP}1{'}' * DEEP};{TAIL}",
    "declarators": lambda: f"int {'(*' * DEEP}p{')(void)' * DEEP};{TAIL}",
    "statement expressions": lambda: f"int f(void) {{ return {'({ ' * DEEP}1; {'})' * DEEP}; }}{TAIL}",
    "open braces": lambda: f"int f(void) {{ low(1); {'{' * DEEP}",
    "closing braces": lambda: f"int f(void) {{ low(1); }} {'}' * DEEP}{TAIL}",
    "open parentheses": lambda: f"int f(void) {{ low(1); {'(' * DEEP}",
    "quotes": lambda: f"int f(void) {{ low(1); {chr(34) * (DEEP + 1)}",
    "open comment": lambda: f"int f(void) {{ return low(1); }} /* {'*' * 10 * DEEP}",
    "doubling macros": lambda: f"#define A0 1\n{DOUBLING}int x = A39;\n",
    "doubling arguments": lambda: f"#define F(x) x x\nint f(void) {{ {'F(' * 60}low(1);{')' * 60} }}{TAIL}",
    "chained macros": lambda: f"#define A0 1\n{CHAINED}int x = A2999;{TAIL}",
    "ring of macros": lambda: f"#define A B\n#define B A\nint f(void) {{ int A = 1; return A; }}{TAIL}",
    "conditionals": lambda: "#if 1\n" * DEEP + TAIL + "#endif\n" * DEEP,
    "open conditionals": lambda: "#if 1\n" * 1000 + TAIL,
    "a deep condition": lambda: f"#if {'(' * DEEP}1{')' * DEEP}\n#endif\n{TAIL}",
    "undeclared names": lambda: f"int f(void) {{ {''.join(f'x{i} = {i};' for i in range(5000))} return 0; }}{TAIL}",
    "many errors": lambda: f"int f(void) {{ {'low(1 @ 2);' * 5000} }}{TAIL}",
    "one line": lambda: "int a[] = {" + "1," * 5_000_000 + "};",
    "tokens": lambda: f"int f(void) {{ {';' * 2_100_000} return 0; }}",
    "a long string": lambda: f'char *s = "{"a" * 3_000_000}";{TAIL}',
    "a long name": lambda: f"int {'a' * 3_000_000};{TAIL}",
    "templates.cpp": lambda: f"template<int N> struct F {{ static const int v = F<N - 1>::v; }};\nint x = F<100000>::v;{TAIL}",
    "template arguments.cpp": lambda: f"template<class T> struct V {{ }};\n{'V<' * DEEP}int{'>' * DEEP} x;{TAIL}",
    "namespaces.cpp": lambda: f"{'namespace a { ' * DEEP}int x;{'}' * DEEP}{TAIL}",
    "lambdas.cpp": lambda: f"auto f = {'[] { return ' * DEEP}1; {'};' * DEEP}{TAIL}",
    "constants.cpp": lambda: f"constexpr int f(int n) {{ return n ? f(n - 1) + f(n - 1) : 1; }}\nconstexpr int x = f(50);{TAIL}",
}  # fmt: skip
REFUSED = {"doubling macros": "macros", "one line": "larger than", "tokens": "tokens"}
"""Cases that are refused -> a word of the reason; all others are read, with what follows the trap."""
NO_TAIL = {"open braces", "open parentheses", "quotes", "open comment"}
MEGABYTES, SECONDS = 1500, 60


def main(folder: str) -> int:
    """Read every case."""
    from robosmi.errors import InternalError, RobosmiError
    from robosmi.transformations.t2m.c_source import read_program

    resource.setrlimit(resource.RLIMIT_AS, (MEGABYTES << 20, MEGABYTES << 20))
    for name, make in CASES.items():
        print(json.dumps({"name": name, "state": "started"}), flush=True)
        path = Path(folder) / (name if "." in name else f"{name}.c")
        path.write_text(make())
        start = time.perf_counter()
        row: dict[str, object] = {"name": name}
        try:
            program, findings = read_program(path)
            unit = program.units[0]
            row |= {"state": "read", "text": int(unit.callsInText), "model": int(unit.callsInModel)}
            row["lost"] = len(unit.unresolved)
            row["rules"] = dict(Counter(f.rule for f in findings))
            row["functions"] = [str(d.name) for d in unit.declarations if type(d).__name__ == "Function"]
        except InternalError:
            raise
        except RobosmiError as error:
            row |= {"state": "refused", "message": error.message, "fix": error.fix}
        print(json.dumps(row | {"seconds": time.perf_counter() - start}), flush=True)
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1]))
