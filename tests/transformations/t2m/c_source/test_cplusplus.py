"""C++ sources, sketches, and programs of several files: a folder, or what a build tool says is compiled."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.errors import SourceError
from robosmi.metamodels import ccode
from robosmi.model.elements.structure import feature_names
from robosmi.model.xmi.xmi_writer import to_xmi
from robosmi.query import all_of_kind
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.reports.analysis import analysis
from robosmi.transformations.t2m.c_source import read_program
from robosmi.transformations.t2m.c_source.on_demand import open_program

FOLDER = Path(__file__).parent / "cplusplus"
PROJECT = FOLDER / "project"


@pytest.fixture(scope="module")
def robot() -> ccode.Program:
    """A program with what C++ has beyond C."""
    return read_program(FOLDER / "robot.cpp")[0]


def test_namespaces_classes_methods_and_templates(robot: ccode.Program) -> None:
    unit = robot.units[0]
    names = [(type(d).__name__, str(d.name)) for d in unit.declarations]
    assert names[:3] == [("Function", "low_level"), ("Namespace", "robot"), ("Record", "Buffer")]
    inside = {str(d.name): d for d in unit.declarations[1].declarations}  # type: ignore[attr-defined]
    assert set(inside) == {"clamp", "Base", "Wheel", "Mode"}
    wheel = inside["Wheel"]
    assert isinstance(wheel, ccode.Record)
    assert [str(m.name) for m in wheel.methods] == ["Wheel", "act", "operator[]"]
    assert [str(f.name) for f in wheel.fields] == ["pin_", "list_", "servo_"]
    assert str(wheel.recordKind.name) == "classType"
    assert [str(m.returnType.spelling) for m in wheel.methods if m.returnType is not None] == ["", "void", "int"]
    buffer = unit.declarations[2]
    assert isinstance(buffer, ccode.Record)
    assert str(buffer.recordKind.name) == "structType"


def test_calls_of_cplusplus(robot: ccode.Program) -> None:
    names = {str(call.calleeName) for call in all_of_kind(robot, ccode.Call)}
    assert {"memset", "pinMode", "read_pin", "analogRead", "helper", "later", "act", "clear", "go", "clamp"} <= names
    assert not any(name.startswith("operator") for name in names)
    by_name = {str(call.calleeName): call for call in all_of_kind(robot, ccode.Call)}
    assert by_name["later"].callee is not None
    assert by_name["later"].callee.definition, "called before it is defined"
    words = {str(u.operator) for u in all_of_kind(robot, ccode.Unary)}
    assert {"new", "delete"} <= words
    unit = robot.units[0]
    assert list(unit.unresolved) == []
    assert "high" in names, "what a lambda does is in the model"
    assert int(unit.callsInText) == int(unit.callsInModel)


def test_functions_that_a_class_defines_as_friends(tmp_path: Path) -> None:
    text = """
        class Row;
        class Lamp {
          int pin;
        public:
          Lamp(int p) : pin(p) {}
          friend void on(Lamp &l) { high(l.pin); }
          friend class Row;
          friend void off(Lamp &l);
          template <typename T> friend void twice(T &l) { on(l); on(l); }
        };
        void off(Lamp &l) { low(l.pin); }
        Lamp lamp(8);
        int main() { while (1) { on(lamp); off(lamp); twice(lamp); } }
    """
    (tmp_path / "lamp.cpp").write_text(text)
    program, findings = read_program(tmp_path / "lamp.cpp")
    unit = program.units[0]
    lamp = next(d for d in unit.declarations if isinstance(d, ccode.Record) and d.methods)
    assert [str(m.name) for m in lamp.methods] == ["Lamp", "on", "twice"]
    calls = {str(call.calleeName): call for call in all_of_kind(program, ccode.Call)}
    assert calls["on"].callee is lamp.methods[1]
    assert "high" in calls
    assert int(unit.callsInText) == int(unit.callsInModel)
    assert not [f for f in findings if f.rule == "RS102"]


def test_a_sketch() -> None:
    program, findings = read_program(FOLDER / "sketch.ino", platform="generic")
    unit = analysis(program, findings, ApiIndex.load("generic"))["units"][0]
    assert unit["main"] is None
    assert [f["name"] for f in unit["functions"]] == ["setup", "loop", "blink"]
    assert [c["name"] for c in unit["unknown_calls"]] == ["analogRead", "delay", "digitalWrite", "map"]
    assert [c["name"] for c in unit["user_calls"]] == ["blink"]
    assert unit["coverage"]["unresolved"] == []
    assert [g["type"] for g in unit["globals"]] == ["Servo", "const int"]


def test_compile_commands_say_how_each_file_is_compiled() -> None:
    program, _ = read_program(PROJECT)
    assert [Path(str(u.path)).name for u in program.units] == ["main.cpp", "wheel.cpp", "tick.c"]
    assert [str(u.language) for u in program.units] == ["C++", "C++", "C"]
    assert [str(d) for d in program.defines] == ["FAST", "DELAY=20"]
    step = next(d for d in program.units[0].declarations if d.name == "STEP")
    assert isinstance(step, ccode.Variable)
    assert isinstance(step.initializer, ccode.IntegerLiteral)
    assert int(step.initializer.value) == 2
    calls = {str(c.calleeName): c for c in all_of_kind(program, ccode.Call)}
    assert calls["tick"].callee is not None
    assert calls["tick"].callee.eContainer() is program.units[2]
    assert read_program(PROJECT / "compile_commands.json")[0].units[0].digest == program.units[0].digest


def test_a_folder_is_its_sources(tmp_path: Path) -> None:
    (tmp_path / "b").mkdir()
    (tmp_path / "build").mkdir()
    (tmp_path / "a.c").write_text("int main() { return twice(2); }\n")
    (tmp_path / "b" / "b.c").write_text("int twice(int x) { return 2 * x; }\n")
    (tmp_path / "build" / "made.c").write_text("int made;\n")
    (tmp_path / "b" / "ring").symlink_to(tmp_path)
    (tmp_path / "notes.txt").write_text("no C")
    program, _ = read_program(tmp_path)
    assert [Path(str(u.path)).relative_to(tmp_path).as_posix() for u in program.units] == ["a.c", "b/b.c"]
    assert next(iter(all_of_kind(program, ccode.Call))).callee is not None
    assert len(open_program(tmp_path).program.units) == 2


def test_of_a_folder_what_is_no_source_is_a_finding(tmp_path: Path) -> None:
    (tmp_path / "a.c").write_text("int main() { high(1); }\n")
    (tmp_path / "b.c").write_bytes(b"\0\1\2")
    (tmp_path / "c.c").write_text("This is a letter, and no program.\n")
    (tmp_path / "d.c").write_text("")
    program, findings = read_program(tmp_path)
    assert [Path(str(u.path)).name for u in program.units] == ["a.c", "d.c"]
    left_out = [f for f in findings if f.rule == "RS112"]
    assert [Path(f.location.path).name for f in left_out if f.location] == ["b.c", "c.c"]
    (tmp_path / "a.c").unlink()
    (tmp_path / "d.c").unlink()
    with pytest.raises(SourceError):
        read_program(tmp_path)


@pytest.mark.parametrize("text", ["[", "{}", "[1]", '[{"file": 3}]', '[{"file": "a.s", "command": "as"}]', "[" * 5000])
def test_damaged_compile_commands(tmp_path: Path, text: str) -> None:
    (tmp_path / "compile_commands.json").write_text(text)
    with pytest.raises(SourceError) as caught:
        read_program(tmp_path)
    assert caught.value.fix


@pytest.mark.parametrize(
    "path",
    [FOLDER / "robot.cpp", FOLDER / "heads.cpp", FOLDER / "sketch.ino", PROJECT],
    ids=["robot", "heads", "sketch", "project"],
)
def test_on_demand_gives_the_same_model(path: Path) -> None:
    model = open_program(path)
    for element in list(model.all_contents()):
        for name in feature_names(element.eClass):
            getattr(element, name)
    stored, _ = read_program(path)
    assert to_xmi({"m": model.program}) == to_xmi({"m": stored})
    model.close()
