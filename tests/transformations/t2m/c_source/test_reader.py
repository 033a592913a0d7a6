"""The C reader on small programs: what must be kept, what the elements say, stable places."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from robosmi.metamodels import ccode
from robosmi.query import all_contents, all_of_kind
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries import code
from robosmi.transformations.t2m.c_source import read_program
from robosmi.transformations.t2m.c_source.on_demand import open_program

HERE = Path(__file__).parent


def calls(program: Any) -> list[str]:
    return [str(c.calleeName) for c in all_of_kind(program, ccode.Call)]


def named(program: Any, kind: Any, name: str) -> Any:
    return next(e for e in all_contents(program) if isinstance(e, kind) and e.name == name)


@pytest.mark.parametrize("path", sorted((HERE / "vanishing").glob("*.c")), ids=lambda p: p.stem)
def test_no_call_vanishes(path: Path) -> None:
    expected = re.search(r"expect: (.*?) \*/", path.read_text())
    program, findings = read_program(path)
    unit = program.units[0]
    assert expected
    assert sorted(calls(program)) == sorted(expected[1].split())
    assert unit.callsInText == unit.callsInModel
    assert not [f for f in findings if f.rule in ("RS101", "RS102")]


def test_listing_of_the_paper() -> None:
    program, findings = read_program(HERE / "listing1.c")
    assert findings == []
    unit = program.units[0]
    assert (unit.callsInText, unit.callsInModel) == (15, 15)
    wait = next(c for c in all_of_kind(program, ccode.Call) if c.calleeName == "waitcnt")
    assert [type(a).__name__ for a in wait.arguments] == ["NameReference"]
    assert isinstance(wait.arguments[0], ccode.NameReference)
    assert wait.arguments[0].target is named(program, ccode.Variable, "waitTime")
    assert named(program, ccode.Function, "GetQTIState").signature == "long GetQTIState(int comPort)"
    assert named(program, ccode.Function, "drive_speed").signature == "void drive_speed(int, int)"
    assert [len(f.calls) for f in program.externals if isinstance(f, ccode.Function) and f.name == "waitcnt"] == [2]
    assert named(program, ccode.Variable, "LED").comment == "//LED port"


def test_every_element_covers_its_text() -> None:
    program, _ = read_program(HERE / "forms.c")
    data = (HERE / "forms.c").read_bytes()
    for element in all_contents(program.units[0]):
        if isinstance(element, ccode.Located):
            assert 0 <= element.startOffset <= element.endOffset <= len(data)
            assert element.line == data[: element.startOffset].count(b"\n") + 1
            container = element.eContainer()
            if isinstance(container, ccode.Located):
                assert container.startOffset <= element.startOffset
        if isinstance(element, ccode.NameReference):
            assert data[element.startOffset : element.endOffset].decode() == element.name
            assert element.target is not None, element.name
    assert not all_of_kind(program, ccode.UnknownExpression)
    assert not all_of_kind(program, ccode.UnknownStatement)


def test_declarators_and_types() -> None:
    program, _ = read_program(HERE / "forms.c")

    def use(name: str) -> tuple[Any, ...]:
        t = named(program, ccode.Variable, name).valueType
        return t.spelling, t.bits, bool(t.signed), t.pointerDepth, str(t.arrayDims or "")

    assert use("counter") == ("unsigned long", 32, False, 0, "")
    assert use("names") == ("const char *", 32, False, 1, "[3]")
    assert use("b") == ("int *", 32, False, 1, "")
    assert use("grid") == ("int", 32, True, 0, "[4][2]")
    assert use("speed") == ("volatile double", 32, True, 0, "")
    assert use("handler") == ("int (*)(int, char *)", 32, False, 1, "")
    assert [bool(named(program, ccode.Variable, n).shared) for n in ("counter", "a", "b")] == [False, True, True]
    assert named(program, ccode.Variable, "counter").storage is ccode.Storage.staticStorage
    assert named(program, ccode.Variable, "counter").comment == "/* how many */"
    assert named(program, ccode.Variable, "names").comment == "// the names"
    assert named(program, ccode.Field, "flags").bitWidth == 3
    assert named(program, ccode.Field, "flags").valueType.signed is False
    assert [(x.name, x.value) for x in named(program, ccode.Enumeration, "mode").literals] == [
        ("OFF_MODE", 0),
        ("SLOW", 4),
        ("FAST", 5),
    ]
    assert named(program, ccode.Parameter, "p").valueType.declaration is named(program, ccode.Typedef, "point_t")
    assert named(program, ccode.Record, "either").recordKind is ccode.RecordKind.unionType
    prototype, definition = [f for f in all_of_kind(program, ccode.Function) if f.name == "next"]
    assert prototype.variadic
    assert (bool(prototype.definition), bool(definition.definition)) == (False, True)


def test_statements_and_operators() -> None:
    program, _ = read_program(HERE / "forms.c")
    first, second = all_of_kind(program, ccode.For)
    assert (first.initial is not None, bool(first.endless)) == (True, False)
    assert (second.initial, second.condition, second.step, second.endless) == (None, None, None, True)
    assert all_of_kind(program, ccode.Goto)[0].labelName == all_of_kind(program, ccode.Label)[0].name == "out"
    operators = {str(u.operator) for u in all_of_kind(program, ccode.Unary)}
    assert operators == {"++", "-", "&", "~", "!", "*"}
    assert all(u.postfix for u in all_of_kind(program, ccode.Unary) if u.operator == "++")
    assert {str(b.operator) for b in all_of_kind(program, ccode.Binary)} >= {"<", ">", ",", "&&", "&", "!="}
    assert {str(a.operator) for a in all_of_kind(program, ccode.Assignment)} >= {"=", "+=", "-="}
    assert [c.calleeName or "" for c in all_of_kind(program, ccode.Call) if c.calleeExpression is not None] == [""]
    assert {str(s.measured.spelling) for s in all_of_kind(program, ccode.SizeOf) if s.measured is not None} == {"point_t"}


def test_standard_headers_give_signatures() -> None:
    program, _ = read_program(HERE / "standard.c")
    printf = named(program, ccode.Function, "printf")
    assert printf.linkage is ccode.Linkage.declaredInHeader
    assert (printf.header, printf.signature) == ("stdio.h", "int printf(const char *format, ...)")
    assert named(program, ccode.ExternalSymbol, "NULL").header == "stddef.h"
    assert named(program, ccode.ExternalSymbol, "uint16_t").header == "stdint.h"


def test_macros() -> None:
    program, _ = read_program(HERE / "vanishing" / "macro_bodies.c")
    on, alias, *inputs = all_of_kind(program, ccode.Call)
    assert (on.calleeName, on.viaMacro, alias.viaMacro) == ("high", True, True)
    assert [bool(c.viaMacro) for c in inputs] == [False, True]
    assert [str(m.name) for m in program.units[0].macros if m.functionLike] == ["ON", "TWICE"]
    assert {str(u.name): u.macro is not None for u in program.units[0].macroUses} == dict.fromkeys(
        ["ON", "HIGH_ALIAS", "LED", "NOTHING", "TWICE"], True
    )


@pytest.mark.parametrize(("name", "encoding"), [("bom_crlf.c", "UTF-8"), ("latin1.c", "ISO-8859-1")])
def test_encodings_keep_byte_offsets(name: str, encoding: str) -> None:
    program, findings = read_program(HERE / name)
    data = (HERE / name).read_bytes()
    assert program.units[0].encoding == encoding
    assert [f.rule for f in findings] == ([] if encoding == "UTF-8" else ["RS105"])
    for call in all_of_kind(program, ccode.Call):
        assert data[call.startOffset :].startswith(str(call.calleeName).encode())
    text = next(str(s.text) for s in all_of_kind(program, ccode.StringLiteral))
    assert text in ('"ü\\n"', '"°C"')


def test_names_and_texts_are_as_they_are_written_in_any_language() -> None:
    program, findings = read_program(HERE / "umlauts.c")
    unit = program.units[0]
    assert [str(i.header) for i in unit.includes] == ["größenwahn.h"]
    assert {str(m.name): (list(m.parameters), str(m.body)) for m in unit.macros} == {
        "MASS": ([], '"Länge in µm"'),
        "größe": ([], "3"),
        "fläche": (["länge"], "((länge) * größe)"),
    }
    assert all(use.macro is not None for use in unit.macroUses)
    names = {str(d.name) for d in unit.declarations}
    assert {"fühler", "fühler_t", "zustände", "häufig"} <= names
    assert {str(d.name) for d in program.externals} >= {"müll", "ungültig", "größe_t"}
    assert {f.message.split()[2] for f in findings if f.rule == "RS103"} == {"größenwahn.h"}
    assert unit.callsInText == unit.callsInModel


def test_a_function_within_a_function_is_told_as_what_it_is(tmp_path: Path) -> None:
    path = tmp_path / "nested.c"
    path.write_text("int main(void) { int twice(int x) { return 2 * x; } return twice(1); }\n")
    _, findings = read_program(path)
    (finding,) = [f for f in findings if f.rule == "RS101"]
    assert "nested function" in finding.message
    assert finding.fix == "move it before the function that contains it"


def test_a_macro_of_a_file_in_latin1_is_read_in_latin1() -> None:
    program, _ = read_program(HERE / "latin1_macro.c")
    unit = program.units[0]
    assert [str(m.body) for m in unit.macros] == ['"20 °C"']
    assert [str(c.text) for c in unit.comments] == ["/* Wärme */"]


def test_reading_twice_gives_the_same() -> None:
    def shape(path: Path) -> list[str]:
        return [repr(e) for e in all_contents(read_program(path)[0])]

    assert shape(HERE / "forms.c") == shape(HERE / "forms.c")


def test_units_are_linked_with_each_other(tmp_path: Path) -> None:
    (tmp_path / "main.c").write_text("int main() { blink(3); hidden(1); }\n")
    (tmp_path / "blink.c").write_text("void blink(int pin) { high(pin); }\nstatic void hidden(int x) { }\n")
    program, _ = read_program([tmp_path / "main.c", tmp_path / "blink.c"])
    blink, hidden = all_of_kind(program.units[0], ccode.Call)
    assert blink.callee is named(program.units[1], ccode.Function, "blink")
    assert hidden.callee is not None
    assert hidden.callee.linkage is ccode.Linkage.inferred


def test_a_prototype_stands_for_the_definition_in_another_unit(tmp_path: Path) -> None:
    (tmp_path / "main.c").write_text(
        "void blink(int pin);\nvoid hidden(int x);\nint main() { blink(3); hidden(1); void (*p)(int) = blink; }\n"
    )
    (tmp_path / "blink.c").write_text("void blink(int pin) { high(pin); }\nstatic void hidden(int x) { }\n")
    paths = [tmp_path / "main.c", tmp_path / "blink.c"]
    program, _ = read_program(paths)
    blink, hidden = all_of_kind(program.units[0], ccode.Call)
    assert blink.callee is named(program.units[1], ccode.Function, "blink")
    assert hidden.callee is named(program.units[0], ccode.Function, "hidden"), "what is static elsewhere is another"
    reference = next(r for r in all_of_kind(program.units[0], ccode.NameReference) if r.name == "blink")
    assert reference.target is blink.callee
    model = open_program(paths)
    on_demand = next(call for call in all_of_kind(model, ccode.Call) if call.calleeName == "blink")
    assert on_demand.callee is not None
    assert on_demand.callee.definition
    unknown = [function.name for view in code.views(program, ApiIndex.load("propeller")) for function in view.unknown()]
    assert unknown == ["hidden"]
