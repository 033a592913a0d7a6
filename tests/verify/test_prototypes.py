"""Prototypes of functions that a sketch uses above their definition, as Arduino's builder makes them."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.verify.toolchains.sketch import with_prototypes
from tests.running import run


@pytest.mark.parametrize(
    ("text", "added"),
    [
        ("void setup() { foo(); }\nvoid foo() { }\n", "void foo(); "),
        (
            "int n;\nvoid setup() { n = bar(1, &n); }\nstatic long  *bar(int a,\n  int *b) { return 0; }\n",
            "static long *bar(int a, int *b); ",
        ),
        ("void setup() { attachInterrupt(0, tick, RISING); }\nvoid tick() { n++; }\n", "void tick(); "),
        ("void setup() { each(go); }\nvoid each(void (*f)(int)) { f(1); }\n", "void each(void (*f)(int)); "),
        ("void setup() { }\nint a = foo(1);\nint foo(int n) { return n; }\n", "int foo(int n); "),
        ("struct A { int n; }; int *foo();\nvoid setup() { foo(); }\nint *foo() { return 0; }\n", ""),
        ("void foo();\nvoid setup() { foo(); }\nvoid foo() { }\n", ""),
        ("void foo() { }\nvoid setup() { foo(); }\n", ""),
        ('void setup() { /* foo */ log("foo"); }\nvoid foo() { }\n', ""),
        ("void setup() { foo(1); }\ntemplate <class T> void foo(T t) { }\n", ""),
        ("void setup() { foo(); }\nvoid A::foo() { }\n", ""),
        ("void setup() { foo(); }\nvoid foo(int a = 3) { }\n", ""),
        ('void setup() { foo(); }\nextern "C" void foo() { }\n', ""),
        ("ISR(TIMER2_OVF_vect) { n++; }\nvoid setup() { }\n", ""),
        ("struct A { void f() { g(); } };\nint a[] = { 1 };\nvoid setup() { g(); }\nvoid g() { }\n", "void g(); "),
    ],
)
def test_functions_that_stand_below_their_use(text: str, added: str) -> None:
    made = with_prototypes(text)
    assert made.count("\n") == text.count("\n")
    assert made.replace(added, "", 1) == text if added else made == text
    assert not added or made.index(added) <= made.index("{") or made.index(added) == text.index("void setup")


@pytest.mark.processes
def test_a_sketch_with_a_function_below_its_use_compiles(tmp_path: Path) -> None:
    (tmp_path / "plain").mkdir()
    (tmp_path / "plain" / "plain.ino").write_text(
        "void setup() { foo(); }\nvoid loop() { part(); }\nvoid foo() { digitalWrite(13, HIGH); }\n"
    )
    (tmp_path / "plain" / "more.ino").write_text("void part() { foo(); }\n")
    done = run("compile", tmp_path / "plain", "--json")
    assert (done.code, done.result["ok"]) == (0, True)
    (tmp_path / "plain" / "more.ino").write_text("void part() {\n  foo();\n  none();\n}\n")
    wrong = run("compile", tmp_path / "plain", "--json")
    assert [f["location"]["line"] for f in wrong.document["findings"] if f["rule"] == "RS801"][:1] == [3]
