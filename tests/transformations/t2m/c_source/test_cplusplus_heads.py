"""What stands in the heads of C++'s loops and branches, handlers, and calls of objects; clang's own tree is the judge."""

from __future__ import annotations

from pathlib import Path

import pytest
from clang import cindex

from robosmi.metamodels import ccode
from robosmi.query import all_of_kind
from robosmi.transformations.t2m.c_source import read_program

HEADS = Path(__file__).parent / "cplusplus" / "heads.cpp"
TEXT = HEADS.read_text(encoding="utf-8")
Where = tuple[int, int]


@pytest.fixture(scope="module")
def program() -> ccode.Program:
    """The program with such heads."""
    return read_program(HEADS)[0]


def text(element: ccode.Located | None) -> str:
    """What the file has at an element's place."""
    return "" if element is None else TEXT[int(element.startOffset) : int(element.endOffset)]


def test_the_clauses_of_loops(program: ccode.Program) -> None:
    found = [
        (text(f.initial), text(f.declaration), text(f.range), text(f.condition), text(f.step))
        for f in all_of_kind(program, ccode.For)
    ]
    assert found == [
        ("", "int v", "values", "", ""),
        ("", "const auto &v", "values", "", ""),
        ("", "auto &row", "matrix", "", ""),
        ("", "int cell", "row", "", ""),
        ("int n = get();", "int v", "values", "", ""),
        ("int i = 0;", "int k = get()", "", "k", "i++"),
        ("int i = 0;", "", "", "i < 3", "i++"),
    ]
    (loop,) = all_of_kind(program, ccode.While)
    assert (text(loop.declaration), text(loop.body)) == ("int w = get()", "low(w);")
    assert [bool(loop.endless) for loop in all_of_kind(program, ccode.Loop)] == [False] * 8


def test_the_clauses_of_branches(program: ccode.Program) -> None:
    found = [
        (text(i.initial), text(i.declaration), text(i.thenBranch), text(i.elseBranch)) for i in all_of_kind(program, ccode.If)
    ]
    assert found == [
        ("int q = get();", "", "low(q);", ""),
        ("a = get();", "", "{ high(a); }", "low(a);"),
        ("", "int q = get()", "low(q);", "high(q);"),
        ("", "", "high(1);", ""),
        (";", "", "high(a);", ""),
    ]
    switches = [(text(s.initial), text(s.declaration)) for s in all_of_kind(program, ccode.Switch)]
    assert switches == [("int s = get();", ""), ("", "int s = get()")]


def test_names_of_heads_mean_what_the_heads_declare(program: ccode.Program) -> None:
    own = {"s", "n"}  # declared in a clause that the parser does not give
    for name in all_of_kind(program, ccode.NameReference):
        assert name.target is not None or str(name.name) in own, text(name)
        assert name.target is None or name.target.name == name.name


def test_what_the_parser_does_not_give_is_text_and_said() -> None:
    program, findings = read_program(HEADS)
    assert [text(u) for u in all_of_kind(program, ccode.UnknownStatement)] == ["int n = get();", "int s = get();"]
    said = [(f.rule, f.location.line) for f in findings if f.location is not None and "head" in f.message]
    assert said == [("RS107", 13), ("RS107", 25)]
    assert [str(u.name) for u in program.units[0].unresolved] == ["get", "get"]


def test_handlers_and_calls_of_objects(program: ccode.Program) -> None:
    functions = {str(f.name): f for f in all_of_kind(program, ccode.Function)}
    handlers = [b for b in all_of_kind(functions["thrown"], ccode.Block) if text(b).startswith("catch")]
    assert [[text(s) for s in handler.statements] for handler in handlers] == [["int e", "{ low(e); }"]]
    assert functions["tried"].definition
    body = functions["tried"].body
    assert body is not None
    assert [text(s) for s in body.statements] == ["{ high(a); return 1; }", "{ return 2; }"]
    calls = {text(c): c for c in all_of_kind(functions["called"], ccode.Call)}
    assert {call: [text(a) for a in c.arguments] for call, c in calls.items()} == {
        "f(3)": ["3"],
        "sum(get())": ["get()"],
        "get()": [],
    }
    assert text(calls["f(3)"].calleeExpression) == "f"


def test_clang_says_the_same(program: ccode.Program) -> None:
    unit = cindex.Index.create().parse(str(HEADS), args=["-std=gnu++20", "-fcxx-exceptions"])
    assert not [d for d in unit.diagnostics if d.severity >= cindex.Diagnostic.Error]
    ranges: dict[Where, list[Where]] = {}
    heads: dict[Where, list[Where]] = {}

    def where(cursor: cindex.Cursor) -> Where:
        return cursor.extent.start.offset, cursor.extent.end.offset

    for cursor in unit.cursor.walk_preorder():
        parts = list(cursor.get_children())
        if cursor.kind is cindex.CursorKind.CXX_FOR_RANGE_STMT:
            ranges[where(cursor)] = [where(part) for part in parts if part.kind.is_expression()][:1]
        elif cursor.kind is cindex.CursorKind.IF_STMT:
            heads[where(cursor)] = [where(part) for part in parts if part.kind.is_expression() or part.kind.is_statement()]

    def place(element: ccode.Located) -> Where:
        return int(element.startOffset), int(element.endOffset)

    loops = [loop for loop in all_of_kind(program, ccode.For) if loop.range is not None]
    assert len(loops) == len(ranges) == 5
    for loop in loops:
        start, _ = place(loop)
        assert loop.range is not None
        assert [place(loop.range)] == next(r for at, r in ranges.items() if at[0] == start)
    for branch in all_of_kind(program, ccode.If):
        of_clang = next(parts for at, parts in heads.items() if at[0] == int(branch.startOffset))
        ours = [p for p in (branch.initial, branch.condition, branch.thenBranch, branch.elseBranch) if p is not None]
        assert [int(p.startOffset) for p in ours] == [start for start, _ in of_clang]


def test_a_structured_binding_is_text(tmp_path: Path) -> None:
    source = tmp_path / "pair.cpp"
    source.write_text("struct P { int a, b; };\nvoid f(P p) { auto [c, d] = p; c = d; }\n")
    program, findings = read_program(source)
    assert [str(u.text) for u in all_of_kind(program, ccode.UnknownStatement)] == ["auto [c, d] = p;"]
    assert "RS107" in {f.rule for f in findings}
