"""Texts made to break a C reader: each is read or refused, in bounded time and memory, and none takes the process along."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, strategies as st

from robosmi.errors import RobosmiError, SourceError, TooLargeError
from robosmi.metamodels import ccode
from robosmi.query import all_contents, all_of_kind
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.t2m.c_source import read_program
from robosmi.transformations.t2m.c_source.expressions import MOST_CALLS
from robosmi.transformations.t2m.c_source.parsing import clang
from robosmi.transformations.t2m.c_source.parsing.bounds import cuts
from robosmi.transformations.t2m.c_source.parsing.headers import Folders, reached
from robosmi.transformations.t2m.c_source.parsing.tree import MOST_CURSORS
from robosmi.transformations.t2m.c_source.reader import MOST_FILES
from tests.tiers import examples
from tests.transformations.t2m.c_source.hostile import CASES, NO_TAIL, REFUSED, SECONDS

ROOT = Path(__file__).resolve().parents[4]


@pytest.fixture(scope="module")
def rows(tmp_path_factory: pytest.TempPathFactory) -> dict[str, dict[str, Any]]:
    """The result of each case; the reading process has bounded memory."""
    folder = tmp_path_factory.mktemp("hostile")
    command = [sys.executable, "-m", "tests.transformations.t2m.c_source.hostile", str(folder)]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, env=environment, timeout=20 * SECONDS)
    found = {row["name"]: row for row in map(json.loads, done.stdout.splitlines())}
    assert done.returncode == 0, (list(found)[-1:], done.stderr[-2000:])
    return found


@pytest.mark.parametrize("name", CASES)
def test_it_is_read_or_refused(name: str, rows: dict[str, dict[str, Any]]) -> None:
    row = rows[name]
    assert row["seconds"] < SECONDS
    if name in REFUSED:
        assert row["state"] == "refused"
        assert REFUSED[name] in row["message"]
        assert row["fix"]
        return
    assert row["state"] == "read"
    assert row["text"] == row["model"] + row["lost"]
    if name not in NO_TAIL:
        assert "tail" in row["functions"], "what stands behind the trap is read"


def test_what_is_cut_is_a_finding_and_its_calls_are_listed(tmp_path: Path) -> None:
    path = tmp_path / "deep.c"
    path.write_text(f"int f(int a)\n{{\n  return {'low(' * 300}a{')' * 300};\n}}\nint main() {{ high(1); }}\n")
    program, findings = read_program(path)
    unit = program.units[0]
    assert {f.rule for f in findings} == {"RS102", "RS104"}
    assert all(f.location is not None and f.location.line == 3 for f in findings if f.rule == "RS104")
    assert int(unit.callsInText) == 301
    assert len(unit.unresolved) == 301 - int(unit.callsInModel) > 100
    unknown = [e for e in all_contents(program) if isinstance(e, ccode.UnknownExpression)]
    assert any("low(low(" in str(e.text) for e in unknown)


def test_programs_of_persons_are_never_cut() -> None:
    paths = sorted([*(ROOT / "docs" / "examples").rglob("*.c"), *(ROOT / "tests").rglob("*.c")])
    assert len(paths) > 20
    for path in paths:
        data = path.read_bytes()
        assert cuts(str(path), data, tokens(data)) == [], path


def test_long_lists_are_no_nesting(tmp_path: Path) -> None:
    path = tmp_path / "table.c"
    rows = ",\n".join("{" + ", ".join(str(i) for i in range(50)) + "}" for _ in range(200))
    path.write_text(
        f"const int table[200][50] = {{\n{rows}\n}};\nenum {{ {', '.join(f'N{i}' for i in range(3000))} }};\nint x;\n"
    )
    program, findings = read_program(path)
    assert findings == []
    assert sum(1 for _ in all_of_kind(program, ccode.IntegerLiteral)) == 10_000


@pytest.mark.parametrize("name", ["deep.h", "größe.h", "two words.h"])
def test_a_header_is_looked_through_whatever_its_name(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(f"int deep(int a) {{ return {'!' * 20_000}a; }}\n")
    text = f'#include "{name}"\n'.encode()
    for path, folders in ((tmp_path / "program.c", []), (Path("elsewhere.c"), [str(tmp_path)])):
        found = reached(str(path), text, Folders(folders)).headers
        assert [header.path for header in found] == [str(tmp_path / name)]
        assert found[0].text is not None
        assert len(found[0].text) < 1000


def test_a_header_beside_the_file_is_no_trap_either(tmp_path: Path) -> None:
    (tmp_path / "deep.h").write_text(f"int deep(int a) {{ return {'!' * 100_000}a; }}\nint shallow(void);\n")
    (tmp_path / "ring.h").write_text('#include "ring.h"\n#include "deep.h"\n')
    path = tmp_path / "main.c"
    path.write_text('#include "ring.h"\n#include "main.c"\nint main() { shallow(); high(1); }\n')
    program, _ = read_program(path)
    assert {str(c.calleeName) for c in all_of_kind(program, ccode.Call)} == {"shallow", "high"}


def declared(path: Path, *folders: Path) -> str:
    """The declarations that the reader finds in a file, in a process of its own, which may crash or hang."""
    script = (
        "import sys; from robosmi.transformations.t2m.c_source import read_program;"
        "program, _ = read_program(sys.argv[1], include_dirs=sys.argv[2:]);"
        "print([str(d.name) for d in program.units[0].declarations])"
    )
    command = [sys.executable, "-c", script, str(path), *map(str, folders)]
    return subprocess.run(command, capture_output=True, text=True, cwd=ROOT, timeout=SECONDS, check=True).stdout


TWICE = '#include "ring.h"\n#include "ring.h"\n'
RINGS = {
    "a header that includes itself twice": ({"ring.h": f"int ring;\n{TWICE}"}, '#include "ring.h"\n'),
    "a guard that guards nothing": ({"ring.h": f"#ifndef RING\n{TWICE}int ring;\n#endif\n"}, '#include "ring.h"\n'),
    "a guard that is taken away": (
        {"ring.h": f"#ifndef RING\n#define RING\n#undef RING\n{TWICE}int ring;\n#endif\n"},
        '#include "ring.h"\n',
    ),
    "two headers that include each other": (
        {"ring.h": 'int ring;\n#include "other.h"\n#include "other.h"\n', "other.h": f"int other;\n{TWICE}"},
        '#include "ring.h"\n',
    ),
    "headers that double": (
        {f"d{i}.h": f'#include "d{i + 1}.h"\n#include "d{i + 1}.h"\n' for i in range(40)} | {"d40.h": "int ring;\n"},
        '#include "d0.h"\n',
    ),
    "ways that are spelled anew": (
        {"in/ring.h": '#include "../in/ring.h"\n#include "../in/ring.h"\nint ring;\n'},
        '#include "in/ring.h"\n',
    ),
    "a text that includes itself twice": ({}, '#include "main.c"\n#include "main.c"\n'),
    "a text that a header includes": ({"ring.h": '#include "main.c"\n#include "main.c"\n'}, '#include "ring.h"\n'),
}


@pytest.mark.parametrize("name", RINGS)
def test_includes_that_grow_without_bound_are_cut(name: str, tmp_path: Path) -> None:
    files, includes = RINGS[name]
    for file, text in files.items():
        (tmp_path / file).parent.mkdir(exist_ok=True)
        (tmp_path / file).write_text(text)
    (tmp_path / "main.c").write_text(f"{includes}int tail(void) {{ return high(2); }}\n")
    assert declared(tmp_path / "main.c") == "['tail']\n"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
@pytest.mark.parametrize("where", ["beside", "in a folder"])
def test_a_header_that_is_a_pipe_or_a_device_is_empty(where: str, tmp_path: Path) -> None:
    folder = tmp_path if where == "beside" else tmp_path / "include"
    folder.mkdir(exist_ok=True)
    os.mkfifo(folder / "pipe.h")
    (folder / "zero.h").symlink_to("/dev/zero")
    (tmp_path / "main.c").write_text('#include "pipe.h"\n#include "zero.h"\nint tail(void) { return high(2); }\n')
    assert declared(tmp_path / "main.c", *([folder] if folder != tmp_path else [])) == "['tail']\n"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
@pytest.mark.parametrize(
    "include",
    [
        '#define H "pipe.h"\n#include H\n',
        "#define S(x) #x\n#include S(pipe.h)\n",
        '#define H "inner/pipe.h"\n#include H\n',
        '#\\\ninclude "pipe.h"\n',
        '#inc\\\nlude "pipe.h"\n',
        '#include "ordinary.h"\n#include NAMED\n',
    ],
)
def test_a_pipe_that_no_include_names_plainly_is_empty(include: str, tmp_path: Path) -> None:
    (tmp_path / "inner").mkdir()
    os.mkfifo(tmp_path / "pipe.h")
    os.mkfifo(tmp_path / "inner" / "pipe.h")
    (tmp_path / "ordinary.h").write_text('#define NAMED "inner/pipe.h"\n')
    (tmp_path / "main.c").write_text(f"{include}int tail(void) {{ return high(2); }}\n")
    assert declared(tmp_path / "main.c") == "['tail']\n"


def test_headers_that_are_included_often_are_no_trap(tmp_path: Path) -> None:
    (tmp_path / "pin.def").write_text("PIN(1)\n")
    (tmp_path / "guarded.h").write_text('#ifndef G\n#define G\n#include "guarded.h"\n#include "guarded.h"\n#endif\n')
    (tmp_path / "once.h").write_text('#pragma once\n#include "once.h"\n#include "once.h"\n')
    text = ('#include "pin.def"\n' * 500 + '#include "guarded.h"\n#include "once.h"\n' * 50).encode()
    found = reached(str(tmp_path / "main.c"), text, Folders([]))
    assert sorted(Path(header.path).name for header in found.headers) == ["guarded.h", "once.h", "pin.def"]
    assert all(header.text is None for header in found.headers)
    assert not found.itself


def test_more_files_than_memory_is_for_are_refused(tmp_path: Path) -> None:
    for number in range(MOST_FILES + 1):
        (tmp_path / f"s{number}.c").write_text(f"int g{number};\n")
    with pytest.raises(TooLargeError, match=f"{MOST_FILES + 1} source files.* {MOST_FILES}") as raised:
        read_program(tmp_path)
    assert raised.value.fix
    with pytest.raises(SourceError, match="source files, "):
        read_program(sorted(tmp_path.iterdir()))


@pytest.mark.parametrize(
    ("data", "rules"),
    [
        (b"int main() { high(1); }\r\n", set()),
        (b"\xef\xbb\xbfint main() { high(1); }\n", set()),
        ("int main() { high(1); }\n".encode("utf-16"), {"RS105"}),
        ("int main() { high(1); }\n".encode("utf-16-le"), {"RS105"}),
        ("int main() { high(1); }\n".encode("utf-16-be"), {"RS105"}),
        (b"/* \xe9 */ int main() { high(1); }\n", {"RS105"}),
        (b"int main() { high(1); } // \x80\x93\n", {"RS105"}),
        (b"\xef\xbb\xbfint main() { high(1); } // \xe9\x80\n", {"RS105"}),
        (b"#error no\nint main() { high(1); }\n", {"RS101"}),
        (b"int main() { high(1); }\x1a", {"RS101"}),
        (b"int main()\r{ high(1); }\r", set()),
        (b"#if\n#endif x\n#else\nint main() { high(1); }\n", {"RS101", "RS106"}),
        (b'#include "main.c"\n#include ""\n#include <\n#include\nint main() { high(1); }\n', None),
    ],
)
def test_forms_of_text(tmp_path: Path, data: bytes, rules: set[str] | None) -> None:
    path = tmp_path / "main.c"
    path.write_bytes(data)
    program, findings = read_program(path)
    assert [str(c.calleeName) for c in all_of_kind(program, ccode.Call)] == ["high"]
    assert rules is None or {f.rule for f in findings} <= rules | {"RS103"}
    assert rules is None or rules <= {f.rule for f in findings}


@pytest.mark.parametrize("data", [b"\x7fELF\1\1\1\0\0", b"MZ\x90\0\3\0", b"int a;\0\1", b"\xff\xfe\0"])
def test_bytes_of_a_compiled_program_are_a_clear_error(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "main.c"
    path.write_bytes(data)
    with pytest.raises(SourceError) as caught:
        read_program(path)
    assert caught.value.fix


@pytest.mark.parametrize(
    ("data", "calls"),
    [
        (b"int main() { high(1);\0 low(2); }\n", ["high", "low"]),
        (b"int\0main() { high\0(1); }\0", ["high"]),
        (b"#define A\0 1\nint main() { high(A); /* caf\xe9 */ }\0\n", ["high"]),
        (b"\0" * 100, []),
        (b"", []),
        (b"\xef\xbb\xbf", []),
        (b"// nothing yet\n/* at all */", []),
    ],
)
def test_what_a_compiler_takes_of_zero_bytes_and_empty_files_is_read(tmp_path: Path, data: bytes, calls: list[str]) -> None:
    """GCC warns of NUL outside of comments and literals, and takes it as a blank; nothing but comments is a program, too."""
    path = tmp_path / "main.c"
    path.write_bytes(data)
    program, _ = read_program(path)
    assert [str(c.calleeName) for c in all_of_kind(program, ccode.Call)] == calls


def test_include_folders_that_cannot_be_used(tmp_path: Path) -> None:
    closed = tmp_path / "closed"
    closed.mkdir()
    (closed / "mine.h").write_text("int mine(void);\n")
    (tmp_path / "ring").symlink_to(tmp_path / "ring")
    (tmp_path / "loop").mkdir()
    (tmp_path / "loop" / "loop").symlink_to(tmp_path / "loop")
    (tmp_path / "file").write_text("")
    path = tmp_path / "main.c"
    path.write_text('#include "mine.h"\n#include "loop/loop/loop/gone.h"\nint main() { mine(); }\n')
    closed.chmod(0)
    try:
        folders = [closed, tmp_path / "ring", tmp_path / "loop", tmp_path / "file", tmp_path / "none"]
        program, findings = read_program(path, include_dirs=folders)
    finally:
        closed.chmod(0o700)
    assert [str(c.calleeName) for c in all_of_kind(program, ccode.Call)] == ["mine"]
    assert "RS103" in {f.rule for f in findings}


WORDS = (
    *"(){}[];,<>=+-*&!~?:.#\"'\\\n",
    *("int", "void", "if", "else", "while", "for", "return", "struct", "typedef", "case", "do", "x", "y", "high", "1", "0x"),
    *("'a'", '"s"', "//", "/*", "*/", "#define F(x) x x\n", "#if 1\n", "#else\n", "#endif\n", '#include "main.c"\n', "\xe9"),
)


@examples(150)
@given(st.lists(st.sampled_from(WORDS), min_size=1, max_size=60))
def test_any_text_is_read_or_refused(tmp_path_factory: pytest.TempPathFactory, parts: list[str]) -> None:
    path = tmp_path_factory.getbasetemp() / "main.c"
    data = " ".join(parts).encode("latin-1")
    path.write_bytes(data)
    try:
        program, _ = read_program(path)
    except RobosmiError:
        return
    unit = program.units[0]
    assert int(unit.callsInText) == int(unit.callsInModel) + len(unit.unresolved)
    for element in all_contents(unit):
        if isinstance(element, ccode.Located):
            assert 0 <= int(element.startOffset) <= int(element.endOffset) <= len(data)


def test_what_the_parser_misses_where_too_much_was_cut_is_no_fault_of_the_text(tmp_path: Path) -> None:
    path = tmp_path / "sum.c"
    path.write_text(f"#define D(x) (x)+(x)\nint a = {'D(' * 40}1{')' * 40};\nint main() {{ return a; }}\n")
    assert "RS104" in {f.rule for f in read_program(path)[1]}
    assert "RS101" not in {f.rule for f in read_program(path)[1]}
    path.write_text(path.read_text().replace("return a;", "return a b;"))
    assert [f.location.line for f in read_program(path)[1] if f.rule == "RS101" and f.location is not None] == [3]


def test_a_small_file_has_no_more_cursors_than_people_write(tmp_path: Path) -> None:
    once, program = 150, tmp_path / "p.c"
    fits = MOST_CURSORS // (3 * once) - 2
    uses = "MANY\n" * fits
    table = "1," * 10_000  # its elements do not count
    program.write_text(f"#define MANY {'x = 1; ' * once}\nint x, t[] = {{{table}}};\nint main(void) {{\n{uses}}}\n")
    assert read_program(program, platform="propeller")[0].units[0].declarations
    program.write_text(program.read_text().replace("MANY\n}", "MANY\n" * 4 + "}"))
    with pytest.raises(TooLargeError, match=f"more than {MOST_CURSORS:,} declarations, statements and expressions") as raised:
        read_program(program, platform="propeller")
    assert raised.value.location is not None
    assert abs((raised.value.location.line or 0) - 3 - fits) < 4


def test_a_text_counts_three_times(tmp_path: Path) -> None:
    program = tmp_path / "p.c"
    texts = '"",' * (MOST_CURSORS // 3)
    program.write_text(f"const char *t[] = {{{texts}}};\nint main(void) {{ return *t[1]; }}\n")
    with pytest.raises(TooLargeError, match=f"more than {MOST_CURSORS:,} declarations"):
        read_program(program, platform="propeller")


def test_a_file_makes_no_more_calls_than_any_board_can_hold(tmp_path: Path) -> None:
    once, program = 20, tmp_path / "p.c"
    uses = "FLASH\n" * (MOST_CALLS // once)
    program.write_text(f"void f(void);\n#define FLASH {'f(); ' * once}\nint main(void) {{\n{uses}}}\n")
    read, _ = read_program(program, platform="propeller")
    assert len(list(all_of_kind(read, ccode.Call))) == MOST_CALLS
    program.write_text(program.read_text().replace("int main(void) {", "int main(void) { f();"))
    with pytest.raises(TooLargeError, match=f"more than {MOST_CALLS:,} calls") as raised:
        read_program(program, platform="propeller")
    assert raised.value.location is not None
    assert raised.value.location.line == 3 + MOST_CALLS // once


@pytest.mark.parametrize(
    "text",
    [
        "int x[] = {[500000000] = 1};",
        "int x[] = {[0 ... 40000000] = 1};",
        "int x[999999999] = {1, [0x1fffffff] = 1};",
        "#define N 500000000\n#define M N\nint x[] = {[M] = 1};",
        "int x[] = {[1000 * 1000 * 2] = 1};",
        "int x[] = {[1 << 29] = 1};",
        "int x[][2000] = {[0 ... 1999][0 ... 1999] = 1};",
        "int x[][2000] = {[0 ... 1999] = {[0 ... 1999] = 1}};",
        "int x[][900000] = {[0][899999] = 1, [1][899999] = 1};",
        "struct { int a[900000]; } x[] = {{.a[899999] = 1}, {.a[899999] = 1}};",
        "int x[] = {[900000] = 1}, y[] = {[900000] = 1};",
        "enum size { A, N = 30000000, B };\nchar x[] = {[0 ... N - 1] = 1};",
        "enum { M = 3000 };\nenum { N = M * M };\nchar x[10][N] = {[0 ... 9] = {[N] = 1}};",
    ],
)
def test_an_initialiser_that_no_board_has_memory_for_is_refused_before_it_is_parsed(text: str) -> None:
    data = text.encode()
    with pytest.raises(TooLargeError, match="1,000,000 elements") as raised:
        cuts("a.c", data, tokens(data))
    assert raised.value.location is not None
    assert raised.value.fix


def test_usual_initialisers_are_within_the_limit() -> None:
    table = ", ".join(f"[{number}] = {number}" for number in range(3000))
    data = f"int x[] = {{{table}}}, y[32][8] = {{[0 ... 31] = {{[0 ... 7] = 1}}}}; int z = x[5000000];".encode()
    assert cuts("a.c", data, tokens(data)) == []


def test_the_parser_takes_no_more_memory_than_its_limit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(clang.library(), "spare", clang.MOST_MEMORY)
    path = tmp_path / "a.c"
    before = clang.library().spare
    path.write_text("struct s { char x[30000000]; };\nint x[] = {[sizeof(struct s)] = 1};\n")
    with pytest.raises(SourceError, match="gave up"):
        read_program(path)
    assert clang.library().spare > before - (400 << 20)
    path.write_text("int x[] = {[5] = 1};\n")
    assert read_program(path)[0].units


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux enforces the limit")
def test_parses_of_several_threads_leave_limit_and_standard_error_as_they_were(monkeypatch: pytest.MonkeyPatch) -> None:
    import resource

    within = [threading.Event(), threading.Event()]
    turn = iter(range(2))

    def parse(*_: object) -> int:
        number = next(turn)
        within[number].set()
        within[1 - number].wait(0.3)  # overlap if the other one may
        if number == 1:
            time.sleep(0.1)  # and end after it
        return 1

    monkeypatch.setattr(clang.library(), "parseTranslationUnit2", parse)
    before = resource.getrlimit(resource.RLIMIT_DATA), os.fstat(2)[:3]
    with ThreadPoolExecutor(2) as threads:
        assert list(threads.map(lambda name: clang.parse(name, [], []), ["/a.c", "/b.c"])) == [None, None]
    after = resource.getrlimit(resource.RLIMIT_DATA), os.fstat(2)[:3]
    try:
        assert after == before
    finally:
        resource.setrlimit(resource.RLIMIT_DATA, before[0])
