"""Inputs that can be made as large as one likes, one for each way in which an input grows, with the commands that read them.

`tests/test_growth.py` holds small ones to a cost that grows with the input alone; `tests/fuzz/growth.py` measures large ones.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.running import run

Words = list[str | Path]


@dataclass(frozen=True)
class Growing:
    """A family of inputs.

    Attributes:
        name: what grows.
        make: writes an input of a size into a folder, and gives the words of the command line that read it.
        size: the size at which it is measured; the quick test takes less.
    """

    name: str
    make: Callable[[Path, int], Words]
    size: int


# --- programs

Lines = Callable[[int], Iterable[str]]
_HEAD = '#include "simpletools.h"\n'
_MAIN = "int main(void) { while (1) { pause(10); } }\n"


def program(folder: Path, text: str) -> Path:
    """A program of one file."""
    path = folder / "program.c"
    path.write_text(_HEAD + text)
    return path


def _same_function(n: int) -> str:
    return "void again(int x) { high(x); }\n" * n + _MAIN


def _deep(n: int) -> str:
    return "int main(void) {" + "if (get_state(1)) {" * n + "high(1);" + "}" * n + "}\n"


PROGRAMS: dict[str, tuple[Callable[[int], str], int]] = {
    "globals": (lambda n: "".join(f"int g{i} = {i};\n" for i in range(n)) + _MAIN, 5000),
    "globals that are ports": (
        lambda n: (
            "".join(f"const int p{i} = {i % 28};\n" for i in range(n))
            + "int main(void) { while (1) {"
            + "".join(f"high(p{i});\n" for i in range(n))
            + "} }\n"
        ),
        1500,
    ),
    "globals of another file": (lambda n: "".join(f"extern int g{i};\n" for i in range(n)) + _MAIN, 5000),
    "functions": (lambda n: "".join(f"void f{i}(int x) {{ high(x); }}\n" for i in range(n)) + _MAIN, 3000),
    "functions that call the next": (
        lambda n: (
            "void f0(void) { high(1); }\n"
            + "".join(f"void f{i}(void) {{ f{i - 1}(); }}\n" for i in range(1, n))
            + f"int main(void) {{ while (1) f{n - 1}(); }}\n"
        ),
        3000,
    ),
    "functions that call one another": (
        lambda n: (
            "".join(f"void f{i}(int x);\n" for i in range(n))
            + "".join(
                f"void f{i}(int x) {{ if (x) f{(i + 1) % n}(x - 1); else f{(i * 7 + 3) % n}(x); high({i % 28}); }}\n"
                for i in range(n)
            )
            + "int main(void) { f0(9); }\n"
        ),
        1200,
    ),
    "arrays of a named size": (
        lambda n: (
            "".join(f"enum {{ E{i} = {i + 1} }};\n" for i in range(n))
            + "".join(f"int a{i}[E{i}] = {{1}};\n" for i in range(n))
            + _MAIN
        ),
        2000,
    ),
    "enumerations in structures": (lambda n: "".join(f"struct s{i} {{ enum {{ A{i} }} m; }};\n" for i in range(n)) + _MAIN, 2500),
    "parameters that are arrays": (
        lambda n: "void f(int n, " + ", ".join(f"int p{i}[n]" for i in range(n)) + ") { high(n); }\n" + _MAIN,
        4000,
    ),
    "definitions of one function": (_same_function, 12_000),
    "definitions of one variable": (lambda n: "int again = 1;\n" * n + _MAIN, 6000),
    "declarations of one variable": (lambda n: "extern int again;\n" * n + _MAIN, 6000),
    "tentative definitions of one variable": (lambda n: "int again;\n" * n + _MAIN, 6000),
    "definitions of one structure": (lambda n: "struct again { int a; };\n" * n + _MAIN, 6000),
    "definitions of one type": (lambda n: "typedef int again;\n" * n + _MAIN, 6000),
    "definitions of one enumeration": (lambda n: "enum again { A, B };\n" * n + _MAIN, 6000),
    "definitions of one macro": (lambda n: "".join(f"#define AGAIN {i}\n" for i in range(n)) + _MAIN, 6000),
    "definitions of one local variable": (lambda n: "int main(void) {" + "int again = 1;\n" * n + "}\n", 6000),
    "definitions of one label": (lambda n: "int main(void) {" + "again: high(1);\n" * n + "}\n", 6000),
    "one case again": (lambda n: "int main(void) { switch (get_state(1)) {" + "case 1: high(1);\n" * n + "} }\n", 6000),
    "uses of one unknown name": (lambda n: "int main(void) {" + "nowhere = 1; nowhere2(3);\n" * n + "}\n", 4000),
    "members of one name": (lambda n: "struct s {" + "int again;\n" * n + "};\n" + _MAIN, 6000),
    "parameters": (lambda n: "void f(" + ", ".join(f"int p{i}" for i in range(n)) + ") { high(p0); }\n" + _MAIN, 4000),
    "arguments": (lambda n: "int main(void) { f(" + ", ".join("1" for i in range(n)) + "); }\n", 8000),
    "text literals side by side": (lambda n: "char *t = " + '"a" ' * n + ";\n" + _MAIN, 10_000),
    "pointers": (lambda n: "int " + "*" * n + "p;\n" + _MAIN, 10_000),
    "dimensions": (lambda n: "int p" + "[2]" * n + ";\n" + _MAIN, 4000),
    "declarations of one function": (lambda n: "int again(int x);\n" * n + _MAIN, 12_000),
    "functions that nobody knows": (
        lambda n: "int main(void) {" + "".join(f"unknown{i}({i});\n" for i in range(n)) + "}\n",
        3000,
    ),
    "calls": (lambda n: "int main(void) {" + "high(1); pause(5);\n" * n + "}\n", 4000),
    "calls in one line": (lambda n: "int main(void) {" + "high(1); " * n + "}\n", 8000),
    "local variables": (lambda n: "int main(void) {" + "".join(f"int v{i} = {i}; v{i}++;\n" for i in range(n)) + "}\n", 4000),
    "variables of loops beside conditions": (
        lambda n: (
            "int x, y; int main(void) { while (1) {"
            + "for (int i = 0; i < 3; i++) high(i);\nif (x > y) low(4);\nx = x + 1; pause(10);\n" * n
            + "} }\n"
        ),
        1200,
    ),
    "statements within statements": (_deep, 4000),
    "else after else": (
        lambda n: (
            "int main(void) { int x = get_state(1); if (x) high(1);\n"
            + "".join(f"else if (x == {i}) high({i % 28});\n" for i in range(n))
            + "}\n"
        ),
        4000,
    ),
    "cases": (
        lambda n: (
            "int main(void) { switch (get_state(1)) {" + "".join(f"case {i}: high(1); break;\n" for i in range(n)) + "} }\n"
        ),
        4000,
    ),
    "operators": (lambda n: "int x = " + "1 + " * n + "1;\n" + _MAIN, 20_000),
    "macros": (lambda n: "".join(f"#define M{i} {i}\n" for i in range(n)) + _MAIN, 8000),
    "macros of macros": (
        lambda n: "#define M0 1\n" + "".join(f"#define M{i} (M{i - 1})\n" for i in range(1, n)) + f"int x = M{n - 1};\n" + _MAIN,
        3000,
    ),
    "ports given to macros": (
        lambda n: (
            "#define ON(p) high(p); pause(10); low(p)\nint main(void) {" + "".join(f"ON({i % 20});\n" for i in range(n)) + "}\n"
        ),
        4000,
    ),
    "uses of macros": (lambda n: "#define ON high(1);\nint main(void) {" + "ON\n" * n + "}\n", 4000),
    "conditions": (lambda n: "#ifdef NOTHING\nint x;\n#endif\n" * n + _MAIN, 8000),
    "conditions within conditions": (lambda n: "#ifndef NOTHING\n" * n + "int x;\n" + "#endif\n" * n + _MAIN, 8000),
    "elements of an array": (lambda n: "int a[] = {" + "1, " * n + "};\n" + _MAIN, 20_000),
    "members": (lambda n: "struct s {" + "".join(f"int m{i};\n" for i in range(n)) + "};\n" + _MAIN, 5000),
    "enumerators": (lambda n: "enum e {" + "".join(f"E{i},\n" for i in range(n)) + "};\n" + _MAIN, 8000),
    "types of types": (
        lambda n: "typedef int t0;\n" + "".join(f"typedef t{i - 1} t{i};\n" for i in range(1, n)) + f"t{n - 1} x;\n" + _MAIN,
        4000,
    ),
    "comments": (lambda n: "// a comment\n" * n + _MAIN, 40_000),
    "a comment that is not closed": (lambda n: "/* * / " * n + _MAIN, 20_000),
    "a text": (lambda n: 'char *t = "' + "ab\\n" * n + '";\n' + _MAIN, 40_000),
    "texts": (lambda n: "".join(f'char *t{i} = "text %d";\n' for i in range(n)) + _MAIN, 4000),
    "quotes that are not closed": (lambda n: "'\n" * n + _MAIN, 10_000),
    "backslashes": (lambda n: "#define M \\\n" * n + "1\n" + _MAIN, 20_000),
    "brackets": (lambda n: "int x = " + "(" * n + "1" + ")" * n + ";\n" + _MAIN, 20_000),
    "brackets that are not closed": (lambda n: "int x = " + "(" * n + ";\n" + _MAIN, 20_000),
    "braces that are not opened": (lambda n: "}\n" * n + _MAIN, 10_000),
    "cores": (
        lambda n: (
            "".join(f"void c{i}(void *p) {{ high({i % 28}); }}\n" for i in range(n))
            + "int main(void) {"
            + "".join(f"cog_run(c{i}, 10);\n" for i in range(n))
            + "}\n"
        ),
        1000,
    ),
    "formats": (lambda n: "int main(void) {" + "".join(f'print("%d %s", {i}, "x");\n' for i in range(n)) + "}\n", 3000),
    "labels": (lambda n: "int main(void) {" + "".join(f"l{i}: high(1); goto l{i};\n" for i in range(n)) + "}\n", 3000),
    "terms": (lambda n: "int main(void) { int x = 3" + "+0" * n + "; high(x); }\n", 24_000),
    "commas within brackets": (lambda n: "int main(void) { int x; x = (3" + ",0" * n + "); high(x); }\n", 45_000),
    "loops within loops": (lambda n: "int main(void) {" + "for (;;)" * n + "high(3); }\n", 11_000),
    "labels before one statement": (lambda n: "int main(void) {" + "".join(f"l{i}:" for i in range(n)) + " high(3); }\n", 6000),
    "structures within structures": (
        lambda n: (
            "struct s0 { int a; };\n"
            + "".join(f"struct s{i} {{ struct s{i - 1} a, b; }};\n" for i in range(1, n))
            + f"struct s{n - 1} x;\n"
            + _MAIN
        ),
        60,
    ),
    "spaces behind defined": (lambda n: "#if 1 || defined" + " " * n + "\n#endif\n" + _MAIN, 95_000),
    "operators in a condition": (lambda n: "#if " + "!" * n + "1\n#endif\n" + _MAIN, 95_000),
    "brackets in a condition": (lambda n: "#if " + "(" * n + "1" + ")" * n + "\n#endif\n" + _MAIN, 45_000),
    "functions that hand a port on": (
        lambda n: (
            "void f0(int p) { high(p); }\n"
            + "".join(f"void f{i}(int p) {{ f{i - 1}(p); }}\n" for i in range(1, n))
            + f"int main(void) {{ while (1) f{n - 1}(3); }}\n"
        ),
        2700,
    ),
    "enumerators of enumerators": (
        lambda n: "enum e { E0," + "".join(f"E{i} = E{i - 1} + 1," for i in range(1, n)) + "};\nint main(void) { high(E3); }\n",
        4500,
    ),
    "ports in an array": (
        lambda n: "int a[] = {" + "3, " * n + f"}};\nint main(void) {{ for (int i = 0; i < {n}; i++) high(a[i]); }}\n",
        8000,
    ),
    "lists within lists": (lambda n: "struct s { int a; } x = " + "{" * n + "1" + "}" * n + ";\n" + _MAIN, 45_000),
    "variables of variables": (
        lambda n: (
            "int main(void) { int c0 = 3;" + "".join(f"int c{i} = c{i - 1};" for i in range(1, n)) + f"high(c{n - 1}); }}\n"
        ),
        2000,
    ),
    "values of one variable": (
        lambda n: "int main(void) { int u;\n" + "u = input(2); freqout(4, 5, u);\n" * n + "}\n",
        3000,
    ),
    "values that go round": (
        lambda n: (
            "int main(void) { int x = 3, y;\n"
            + "x = y; y = x;\n" * n
            + "".join(f"int z{i}; z{i} = x; pause(z{i});\n" for i in range(n))
            + "}\n"
        ),
        1500,
    ),
    "masks of masks": (
        lambda n: (
            "int main(void) { int x0 = input(3) & 7;\n"
            + "".join(f"int x{i}; x{i} = x{i - 1} | x{i - 1}; x{i} = x{i - 1};\n" for i in range(1, n))
            + f"OUTA |= x{n - 1}; OUTA &= ~x{n - 1}; OUTA |= 1 << x{n - 1}; }}\n"
        ),
        1700,
    ),
    "masks that go round": (
        lambda n: (
            f"int main(void) {{ int x{n - 1}, x0 = 3; x0 = x{n - 1};\n"
            + "".join(f"int x{i}; x{i} = x{i - 1} ? x{i - 1} : x{i - 1}; x{i} = x{i - 1};\n" for i in range(1, n - 1))
            + f"x{n - 1} = x{n - 2}; OUTA |= x{n - 1}; OUTA &= ~x{n - 1}; pause(x{n - 1}); }}\n"
        ),
        1500,
    ),
    "products": (
        lambda n: "int f(int x) {" + "".join(f"x = x * {i} + (x << 3);\n" for i in range(n)) + " return x; }\n" + _MAIN,
        3000,
    ),
}


def _analyse(text: Callable[[int], str]) -> Callable[[Path, int], Words]:
    return lambda folder, n: ["analyse", program(folder, text(n))]


def _migrate(text: Callable[[int], str]) -> Callable[[Path, int], Words]:
    return lambda folder, n: ["migrate", program(folder, text(n)), "-o", folder / "out"]


def _stored(text: Callable[[int], str], folder: Path, n: int) -> Path:
    """The output folder of a migrated program; what this costs is not measured."""
    with pytest.MonkeyPatch.context() as changed:
        changed.setenv("ROBOSMI_HOME", str(folder / "home"))
        outcome = run("migrate", program(folder, text(n)), "-o", folder / "out")
    assert outcome.code in (0, 1), outcome.err
    return folder / "out"


def _generate(text: Callable[[int], str]) -> Callable[[Path, int], Words]:
    return lambda folder, n: ["generate", _stored(text, folder, n) / "models" / "plan.xmi", "-o", folder / "again"]


def _compile(text: Callable[[int], str]) -> Callable[[Path, int], Words]:
    return lambda folder, n: ["compile", _stored(text, folder, n)]


STORED = ("calls", "functions", "globals that are ports", "local variables", "elements of an array", "values of one variable")
"""Programs whose stored plans are generated from, and compiled."""


def _headers(folder: Path, n: int) -> Words:
    for number in range(n):
        (folder / f"h{number}.h").write_text(f"#ifndef H{number}\n#define H{number}\nint in{number}(void);\n#endif\n")
    return ["migrate", program(folder, "".join(f'#include "h{i}.h"\n' for i in range(n)) + _MAIN), "-o", folder / "out"]


def _headers_of_headers(folder: Path, n: int) -> Words:
    for number in range(n):
        (folder / f"h{number}.h").write_text(f'#ifndef H{number}\n#define H{number}\n#include "h{number + 1}.h"\n#endif\n')
    (folder / f"h{n}.h").write_text("int last(void);\n")
    return ["analyse", program(folder, '#include "h0.h"\n' + _MAIN)]


def _sources(folder: Path, n: int) -> Words:
    for number in range(n):
        (folder / f"s{number}.c").write_text(f"{_HEAD}int g{number};\nvoid f{number}(void) {{ high(1); }}\n")
    return ["analyse", program(folder, _MAIN), *(folder / f"s{i}.c" for i in range(n))]


# --- drawings


def _instance(part: str, index: int, title: str, wired: Iterable[tuple[str, str, int]]) -> str:
    """A part with its connections: own connector, other connector, other part."""
    connected = "".join(
        f'<connector connectorId="{own}" layer="breadboard"><connects><connect connectorId="{other}" modelIndex="{number}" '
        'layer="breadboard"/></connects></connector>'
        for own, other, number in wired
    )
    return (
        f'<instance moduleIdRef="{part}" modelIndex="{index}" path=""><title>{title}</title><views><breadboardView '
        f'layer="breadboard"><geometry z="1" x="0" y="0"/><connectors>{connected}</connectors>'
        "</breadboardView></views></instance>\n"
    )


def drawing(folder: Path, parts: Iterable[str]) -> Path:
    """A drawing with a Uno, whose pin 8 (connector60) is wired to the part 2."""
    uno = _instance("arduino_Uno_Rev3(fix)", 1, "Uno", [("connector60", "connector0", 2)])
    path = folder / "drawing.fz"
    path.write_text(f'<module fritzingVersion="0.9.6b"><instances>{uno}{"".join(parts)}</instances></module>')
    return path


def _row(n: int, part: str = "ResistorModuleID", title: str = "R{}") -> Iterable[str]:
    """Parts one after the other behind the board, and a lamp at the end."""
    for i in range(n):
        yield _instance(
            part,
            2 + i,
            title.format(i),
            [
                ("connector0", "connector1" if i else "connector60", 1 + i),
                ("connector1", "connector0", 3 + i),
            ],
        )
    yield _instance("5mmColorLEDModuleID", 2 + n, "Lamp", [("connector0", "connector1", 1 + n)])


def _wide(n: int, part: str, title: str) -> Iterable[str]:
    """Parts that are all on one net, each wired to the one before."""
    for i in range(n):
        yield _instance(part, 2 + i, title.format(i), [("connector0", "connector0" if i else "connector60", 1 + i)])


def _alone(n: int) -> Iterable[str]:
    return (_instance("5mmColorLEDModuleID", 2 + i, f"Lamp{i}", []) for i in range(n))


def _boards(n: int) -> Iterable[str]:
    return (_instance("arduino_Uno_Rev3(fix)", 2 + i, f"Board{i}", [("connector0", "connector0", 1 + i)]) for i in range(n))


def _buses(n: int) -> Iterable[str]:
    """Parts with a bus on the board's I2C pins, A4 and A5."""
    for i in range(n):
        yield _instance(
            "8x8-bicolor-led-matrix-ht16k33",
            2 + i,
            f"Matrix{i}",
            [
                ("connector0", "connector0" if i else "connector60", 1 + i),
                ("connector1", "connector1", 1 + i),
            ],
        )


DRAWINGS: dict[str, tuple[Callable[[int], Iterable[str]], int]] = {
    "resistors in a row": (_row, 9900),
    "wires in a row": (lambda n: _row(n, "WireModuleID", "Wire{}"), 9900),
    "lamps on one net": (lambda n: _wide(n, "5mmColorLEDModuleID", "Lamp{}"), 3000),
    "resistors on one net": (lambda n: _wide(n, "ResistorModuleID", "R{}"), 3000),
    "parts of one title": (lambda n: _wide(n, "5mmColorLEDModuleID", "Lamp"), 2000),
    "parts that are not wired": (_alone, 3000),
    "boards": (_boards, 200),
    "parts on one bus": (_buses, 500),
}


def _drawn(parts: Callable[[int], Iterable[str]], command: str) -> Callable[[Path, int], Words]:
    def make(folder: Path, n: int) -> Words:
        path = drawing(folder, parts(n))
        if command == "svg":
            return ["hardware", path, "--svg", folder / "picture.svg"]
        if command == "migrate":
            return ["migrate", program(folder, _MAIN), "--hardware", path, "-o", folder / "out"]
        return [command, path]

    return make


# --- what else is read


def _xml(folder: Path, n: int) -> Words:
    path = folder / "books.xml"
    path.write_text("<library>" + "".join(f'<book id="b{i}" next="b{i + 1}">t{i}</book>' for i in range(n)) + "</library>")
    return ["query", path, "t_book.all.size()"]


def _table(folder: Path, n: int) -> Words:
    path = folder / "books.csv"
    path.write_text("title,year\n" + "".join(f"t{i},{i}\n" for i in range(n)))
    return ["query", path, "books.all.select(lambda b: b.title == 't1').size()"]


def _pins(row: Callable[[int], str], command: str) -> Callable[[Path, int], Words]:
    """Rows of a pin table."""

    def make(folder: Path, n: int) -> Words:
        path = folder / "pins.csv"
        path.write_text("pin,part,title,connector,driver,through\n" + "".join(f"{row(i)}\n" for i in range(n)))
        if command == "migrate":
            return [
                "migrate",
                program(folder, _MAIN + "void f(int x) { high(x); low(3); }\n"),
                "--hardware",
                path,
                "-o",
                folder / "out",
            ]
        return [command, path]

    return make


PIN_TABLES: dict[str, tuple[Callable[[int], str], int]] = {
    "equal rows": (lambda i: "D9,Red LED,A,a,,R1", 5900),
    "rows with a connector each": (lambda i: f"D9,Red LED,A,a{i},,R1", 4500),
    "rows with a pin each": (lambda i: f"X{i},Red LED,A,a,,", 4500),
    "rows with a part each": (lambda i: "D9,Red LED,,,,", 1900),
    "rows with a driver each": (lambda i: f"X{i},L293D,M{i},in,true,", 1900),
    "rows with a resistor each": (lambda i: f"D9,Red LED,A,a,,R{i}", 1900),
    "rows with a chain of resistors each": (lambda i: f"D9,Red LED,A,a,,{f'R{i};' * 99}", 19),
}


def _components(folder: Path, n: int) -> Words:
    path = folder / "components.json"
    path.write_text(json.dumps([{"id": f"c{i}", "title": f"Servo {i}"} for i in range(n)]))
    return ["recommend", "--components", path]


def _settings(folder: Path, n: int) -> Words:
    path = program(folder, _MAIN)
    accepted = "".join(f'[[accept]]\nrule = "RS108"\nelement = "e{i}"\nreason = "r"\n' for i in range(n))
    (folder / "robosmi.toml").write_text(accepted + "[bind]\n" + "".join(f'p{i} = "none"\n' for i in range(n)))
    return ["analyse", path]


def _history(folder: Path, n: int) -> Words:
    path = folder / "history.csv"
    path.write_text("part_id,title,library,count,last_used\n" + "".join(f"p{i},t,l{i},1,2026-01-01\n" for i in range(n)))
    return ["history", "import", path]


def _metamodel(folder: Path, n: int) -> Words:
    path = folder / "grown.ecore"
    classes = "".join(
        f'<eClassifiers xsi:type="ecore:EClass" name="C{i}" eSuperTypes="{f"#//C{i - 1}" if i % 50 else ""}">'
        f'<eStructuralFeatures xsi:type="ecore:EReference" name="r{i}" eType="#//C{(i * 7) % n}"/></eClassifiers>'
        for i in range(n)
    )
    path.write_text(
        '<ecore:EPackage xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" '
        'xmlns:ecore="http://www.eclipse.org/emf/2002/Ecore" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
        'name="grown" nsURI="http://grown" nsPrefix="g">'
        f"{classes}</ecore:EPackage>"
    )
    return ["metamodels", "generate", path, "-o", folder / "generated"]


OTHERS: dict[str, tuple[Callable[[Path, int], Words], int]] = {
    "headers: migrate": (_headers, 400),
    "headers of headers: analyse": (_headers_of_headers, 400),
    "source files: analyse": (_sources, 399),
    "elements: query": (_xml, 40_000),
    "rows: query": (_table, 40_000),
    "components: recommend": (_components, 300),
    "lines of robosmi.toml: analyse": (_settings, 2000),
    "entries: history import": (_history, 5000),
    "classes: metamodels generate": (_metamodel, 300),
}

FAMILIES: tuple[Growing, ...] = (
    *(Growing(f"{name}: analyse", _analyse(text), n) for name, (text, n) in PROGRAMS.items()),
    *(Growing(f"{name}: migrate", _migrate(text), n) for name, (text, n) in PROGRAMS.items()),
    *(Growing(f"{name}: generate", _generate(PROGRAMS[name][0]), PROGRAMS[name][1]) for name in STORED),
    *(Growing(f"{name}: compile", _compile(PROGRAMS[name][0]), PROGRAMS[name][1]) for name in STORED),
    *(
        Growing(f"{name}: {command}", _drawn(parts, command), n)
        for name, (parts, n) in DRAWINGS.items()
        for command in ("svg", "check", "recommend", "migrate")
    ),
    *(
        Growing(f"{name}: {command}", _pins(row, command), n)
        for name, (row, n) in PIN_TABLES.items()
        for command in ("hardware", "check", "recommend", "migrate")
    ),
    *(Growing(name, make, n) for name, (make, n) in OTHERS.items()),
)
