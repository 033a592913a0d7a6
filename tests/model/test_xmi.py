"""XMI in and out: what is written is read again, by us and by pyecore; what is damaged is refused with all its places."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from pyecore import ecore
from pyecore.resources import URI, ResourceSet

import robosmi
from robosmi.errors import InternalError, ModelError, SourceError
from robosmi.files.commit import update
from robosmi.files.files import write_atomic
from robosmi.metamodels import ccode, hardware, migration, platform, trace
from robosmi.model.ecore.metamodels import built_in
from robosmi.model.xmi.xmi_reader import read_models, resolve
from robosmi.model.xmi.xmi_writer import to_xmi
from tests.model.kitchen import classes, kitchen, saved

TEXTS = [
    "",
    "plain",
    " spaces  around ",
    "tab\tline\nfeed\rreturn\r\nboth",
    "<tag attr=\"a\" other='b'>&amp;</tag>",
    "]]> and <![CDATA[",
    "Grüße, 温度 µs 🤖",
    "\x7f\x85\u2028",
]


def round_trip(root: Any, folder: Path) -> Any:
    """What is read of a model that was just written."""
    robosmi.save_model(root, folder / "model.xmi")
    return robosmi.load_model(folder / "model.xmi")


@pytest.mark.parametrize("text", TEXTS)
def test_every_text_survives_as_attribute_and_as_element(text: str, tmp_path: Path) -> None:
    root = ccode.Program(
        name=text, units=[ccode.SourceUnit(path="a.c", macros=[ccode.Macro(name="M", body=text, parameters=[text, "b", text])])]
    )
    again = round_trip(root, tmp_path)
    assert again.name == text
    assert again.units[0].macros[0].body == text
    assert list(again.units[0].macros[0].parameters) == [text, "b", text]


@pytest.mark.parametrize(
    "value", [0.0, 1.0, -2.5, 0.1, 1e-3, 9.99e-4, 1e7, 123456.789, 1e300, 5e-324, float("inf"), float("-inf")]
)
def test_every_number_survives(value: float, tmp_path: Path) -> None:
    assert round_trip(migration.Option(label="x", score=value), tmp_path).score == value


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.1, "0.1"), (1e7, "1.0E7"), (1.5e-4, "1.5E-4"), (100.0, "100.0"), (float("inf"), "Infinity"), (1e22, "1.0E22"),
        (5e-324, "4.9E-324"), (2e-323, "2.0E-323"),
    ],
)  # fmt: skip
def test_numbers_are_written_as_java_prints_them(value: float, text: str) -> None:
    assert f'score="{text}"'.encode() in to_xmi({"a.xmi": migration.Option(label="x", score=value)})["a.xmi"]


def test_the_smallest_number_of_32_bits_is_written_as_java_prints_it(tmp_path: Path) -> None:
    root = SimpleNamespace(**classes(kitchen()))
    saved(root.Root(name="r", items=[root.Item(name="i", f=1.4e-45)]), tmp_path / "a.xmi")
    assert 'f="1.4E-45"' in (tmp_path / "a.xmi").read_text(encoding="utf-8")


@pytest.mark.parametrize("value", [0, -1, 2**31 - 1, 2**62])
def test_every_integer_survives(value: int, tmp_path: Path) -> None:
    assert round_trip(ccode.IntegerLiteral(text="x", value=value), tmp_path).value == value


def test_values_that_equal_the_default_are_left_out() -> None:
    text = to_xmi({"a.xmi": ccode.Function(name="f", line=0, definition=False, storage=ccode.Storage.unspecified)})["a.xmi"]
    assert b"line=" not in text
    assert b"definition=" not in text
    assert b"storage=" not in text


def test_references_between_files_are_relative_and_found_again(tmp_path: Path) -> None:
    function = ccode.Function(name="f")
    program = ccode.Program(units=[ccode.SourceUnit(path="a.c", declarations=[function])])
    links = trace.Trace(links=[trace.TraceLink(rule="r", sources=[function], targets=[function, program])])
    models = {"my code.xmi": program, "trace.xmi": links}
    for name, data in to_xmi(models).items():
        (tmp_path / name).write_bytes(data)
    assert 'href="my%20code.xmi#//@units.0/@declarations.0"' in (tmp_path / "trace.xmi").read_text()
    found = read_models(tmp_path / "trace.xmi", built_in())
    assert [path.name for path in found] == ["trace.xmi", "my code.xmi"]
    link = found[tmp_path / "trace.xmi"].links[0]
    assert link.sources[0] is found[tmp_path / "my code.xmi"].units[0].declarations[0]
    assert [type(t).__name__ for t in link.targets] == ["Function", "Program"]


def test_references_within_a_file_and_opposites_survive(tmp_path: Path) -> None:
    pins = [hardware.Connector(connectorId=f"c{n}") for n in range(3)]
    root = hardware.Circuit(
        path="a.fz",
        components=[hardware.Component(elementId="1", title="x", connectors=pins)],
        nets=[hardware.Net(name="N", connectors=pins[::-1])],
    )
    again = round_trip(root, tmp_path)
    assert [c.connectorId for c in again.nets[0].connectors] == ["c2", "c1", "c0"]
    assert all(c.net is again.nets[0] for c in again.components[0].connectors)


def test_what_was_read_is_written_again_byte_for_byte(examples: Path, tmp_path: Path) -> None:
    robosmi.migrate([examples / "line_follower" / "line_follower.c"], tmp_path / "out")
    folder = tmp_path / "out" / "models"
    roots = {path.name: root for path, root in read_models(folder / "plan.xmi", built_in()).items()}
    assert set(roots) == {"plan.xmi", "code.xmi", "hardware.xmi", "platform.xmi"}
    for name, data in to_xmi(roots).items():
        assert data == (folder / name).read_bytes(), name


def test_pyecores_own_resource_reads_what_we_write(examples: Path, tmp_path: Path) -> None:
    code = robosmi.load_code(examples / "line_follower" / "line_follower.c")
    robosmi.save_model(code, tmp_path / "code.xmi")
    resources = ResourceSet()
    for package in (ccode, hardware, migration, platform, trace):
        resources.metamodel_registry[package.nsURI] = package
    read = resources.get_resource(URI(str(tmp_path / "code.xmi"))).contents[0]
    ours = [(type(e).__name__, getattr(e, "name", None), getattr(e, "line", None)) for e in (code, *code.eAllContents())]
    theirs = [(type(e).__name__, getattr(e, "name", None), getattr(e, "line", None)) for e in (read, *read.eAllContents())]
    assert len(ours) > 100
    assert ours == theirs
    calls = {d.name: len(d.calls) for d in read.units[0].declarations if isinstance(d, ccode.Function)}
    assert calls == {d.name: len(d.calls) for d in code.units[0].declarations if isinstance(d, ccode.Function)}


def test_a_reference_without_a_place_is_refused_and_the_old_file_stays(tmp_path: Path) -> None:
    target = tmp_path / "trace.xmi"
    target.write_text("old")
    function = ccode.Function(name="lost")
    with pytest.raises(ModelError, match=r"TraceLink.*sources refers to <Function name='lost'.* in none of the models") as caught:
        robosmi.save_model(trace.Trace(links=[trace.TraceLink(rule="r", sources=[function])]), target)
    assert caught.value.fix
    assert target.read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["trace.xmi"]


def test_a_metamodel_with_a_character_that_xml_cannot_hold_is_refused_by_name(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match=r"holds U\+000C at 1"):
        robosmi.save_model(ecore.EPackage(name="a\fb", nsURI="http://a", nsPrefix="a"), tmp_path / "a.ecore")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "iso-8859-1", "us-ascii"])
def test_characters_that_xml_cannot_hold_come_back_from_any_encoding(encoding: str, tmp_path: Path) -> None:
    texts = ["a\fb\0", "\u241b000C", "\u241b", "\ud800"]
    robosmi.save_model(ccode.Macro(name="\x0b", parameters=texts), tmp_path / "a.xmi")
    written = (tmp_path / "a.xmi").read_text(encoding="utf-8").replace('"UTF-8"', f'"{encoding}"')
    (tmp_path / "b.xmi").write_bytes(written.encode(encoding, "xmlcharrefreplace"))
    again = robosmi.load_model(tmp_path / "b.xmi")
    assert (again.name, list(again.parameters)) == ("\x0b", texts)


# --- reading what others wrote

HEAD = (
    '<ccode:Program xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
    'xmlns:ccode="http://robosmi.org/ccode/1"'
)


def read(text: str, folder: Path) -> Any:
    """The root of a file with this text."""
    (folder / "a.xmi").write_text(text, encoding="utf-8")
    return robosmi.load_model(folder / "a.xmi")


def test_comments_and_instructions_are_passed_over(tmp_path: Path) -> None:
    root = read(f'<?tool x?><!-- a -->{HEAD}><!-- b --><units path="a.c"><!-- c --></units><?tool y?></ccode:Program>', tmp_path)
    assert [unit.path for unit in root.units] == ["a.c"]


def test_any_prefix_will_do(tmp_path: Path) -> None:
    root = read(HEAD.replace("ccode:", "c:").replace("xmlns:ccode", "xmlns:c") + ' name="p"/>', tmp_path)
    assert (type(root).__name__, root.name) == ("Program", "p")


def test_both_forms_of_many_valued_attributes_are_read(tmp_path: Path) -> None:
    units = (
        '<units path="a.c"><macros name="A" parameters="x y"/>'
        '<macros name="B"><parameters>x</parameters><parameters>y</parameters></macros></units>'
    )
    macros = read(f"{HEAD}>{units}</ccode:Program>", tmp_path).units[0].macros
    assert [list(macro.parameters) for macro in macros] == [["x", "y"], ["x", "y"]]


def test_both_forms_of_references_are_read(tmp_path: Path) -> None:
    calls = (
        '<statements xsi:type="ccode:ExpressionStatement">'
        '<expression xsi:type="ccode:Call" calleeName="f" callee="//@units.0/@declarations.0"/></statements>'
        '<statements xsi:type="ccode:ExpressionStatement"><expression xsi:type="ccode:Call" calleeName="f">'
        '<callee href="#//@units.0/@declarations.0"/></expression></statements>'
    )
    text = (
        f'{HEAD}><units path="a.c"><declarations xsi:type="ccode:Function" name="f"/>'
        '<declarations xsi:type="ccode:Function" name="main">'
        f"<body>{calls}</body></declarations></units></ccode:Program>"
    )
    assert len(read(text, tmp_path).units[0].declarations[0].calls) == 2


@pytest.mark.parametrize(
    ("text", "said", "line"),
    [
        ("", "the file is empty", 1),
        ("plain text", "not well-formed", 1),
        (f"{HEAD}>\n<units>\n</ccode:Program>", "not well-formed", 3),
        (f"<!DOCTYPE p>\n{HEAD}/>", "DOCTYPE is refused", 1),
        (f'<!DOCTYPE p [<!ENTITY e SYSTEM "file:///etc/passwd">]>\n{HEAD} name="&e;"/>', "DOCTYPE is refused", 1),
        ("<other/>", "belongs to no metamodel known here", 1),
        ('<xmi:XMI xmlns:xmi="http://www.omg.org/XMI"/>', "no root", 1),
        (HEAD.replace("Program", "Progam") + "/>", "'Progam'", 1),
    ],
)
def test_a_file_that_is_no_model_is_refused_with_its_line(text: str, said: str, line: int, tmp_path: Path) -> None:
    with pytest.raises(SourceError) as caught:
        read(text, tmp_path)
    assert said in caught.value.message
    assert caught.value.location is not None
    assert (Path(caught.value.location.path).name, caught.value.location.line) == ("a.xmi", line)


def test_all_problems_of_a_file_are_told_with_their_lines(tmp_path: Path) -> None:
    text = "\n".join(
        [
            f'{HEAD} nmae="p">',
            '  <units path="a.c" callsInText="many">',
            '    <declarations xsi:type="ccode:Funktion" name="f"/>',
            '    <declarations name="f"/>',
            '    <declarations xsi:type="ccode:Function" name="f" storage="static"/>',
            '    <declarations xsi:type="ccode:Function" name="f" definition="yes"/>',
            "    <macros/>",
            "    <includs/>",
            "  </units>",
            "</ccode:Program>",
        ]
    )
    with pytest.raises(ModelError) as caught:
        read(text, tmp_path)
    said = caught.value.message
    assert "in 8 place(s)" in said
    for line, problem in [
        (1, "Program has no feature 'nmae' (did you mean 'name'?)"),
        (2, "SourceUnit.callsInText: 'many' is no whole number"),
        (3, "'ccode:Funktion' is no class of a metamodel known here"),
        (4, "Declaration is abstract: the element needs an xsi:type"),
        (5, "Function.storage: 'static' is no literal of Storage"),
        (6, "Function.definition: 'yes' is neither true nor false"),
        (7, "Macro has no 'name', which it needs"),
        (8, "SourceUnit has no feature 'includs' (did you mean 'includes'?)"),
    ]:
        assert f"a.xmi:{line}: {problem}" in said


def test_problems_beyond_the_twentieth_are_counted(tmp_path: Path) -> None:
    text = HEAD + ">" + "".join(f'<units path="a.c" bad{n}="1"/>' for n in range(25)) + "</ccode:Program>"
    with pytest.raises(ModelError, match=r"in 25 place\(s\)[\s\S]*and 5 more"):
        read(text, tmp_path)


@pytest.mark.parametrize(
    ("link", "said"),
    [
        ("//@units.7", "leads to nothing"),
        ("//@nothing.0", "leads to nothing"),
        ("//@units.0", "does not take"),
        ("//@units.x", "leads to nothing"),
    ],
)
def test_a_reference_that_leads_nowhere_is_refused(link: str, said: str, tmp_path: Path) -> None:
    text = (
        f'{HEAD}><units path="a.c"><declarations xsi:type="ccode:Function" name="main"><body>'
        '<statements xsi:type="ccode:ExpressionStatement">'
        f'<expression xsi:type="ccode:Call" calleeName="f" callee="{link}"/></statements>'
        "</body></declarations></units></ccode:Program>"
    )
    with pytest.raises(ModelError, match=said):
        read(text, tmp_path)


def test_a_missing_second_file_is_told_with_the_place_that_names_it(tmp_path: Path) -> None:
    text = (
        '<trace:Trace xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
        'xmlns:ccode="http://robosmi.org/ccode/1" xmlns:trace="http://robosmi.org/trace/1">\n<links rule="r">\n'
        '<sources xsi:type="ccode:Program" href="gone.xmi#/"/></links></trace:Trace>'
    )
    with pytest.raises(SourceError, match=r"a\.xmi:3: the model 'gone\.xmi' cannot be read"):
        read(text, tmp_path)


def test_a_fragment_path_is_followed_from_the_root() -> None:
    program = ccode.Program(
        units=[ccode.SourceUnit(path="a.c"), ccode.SourceUnit(path="b.c", declarations=[ccode.Function(name="f")])]
    )
    assert resolve(program, "/") is program
    assert resolve(program, "//@units.1/@declarations.0").name == "f"
    assert resolve(program, "//@units.2") is None
    assert resolve(program, "//units.0") is None


# --- files


def test_a_file_is_replaced_whole_or_not_at_all(tmp_path: Path) -> None:
    write_atomic(tmp_path / "new" / "a.txt", b"one")
    write_atomic(tmp_path / "new" / "a.txt", b"two")
    assert [(p.name, p.read_bytes()) for p in (tmp_path / "new").iterdir()] == [("a.txt", b"two")]


def test_a_folder_is_filled_and_cleared_of_what_is_obsolete(tmp_path: Path) -> None:
    update(tmp_path / "out", {"a/b.txt": b"1", "c.txt": b"2"})
    (tmp_path / "out" / "mine.txt").write_bytes(b"3")
    update(tmp_path / "out", {"a/b.txt": b"4"}, frozenset({"c.txt"}))
    assert {str(p.relative_to(tmp_path / "out")): p.read_bytes() for p in (tmp_path / "out").rglob("*") if p.is_file()} == {
        "a/b.txt": b"4", "mine.txt": b"3",
    }  # fmt: skip
    assert [p.name for p in tmp_path.iterdir()] == ["out"]


def test_nothing_is_written_outside_of_the_folder(tmp_path: Path) -> None:
    for name in ("../evil.txt", "/tmp/evil.txt", "a/../../evil.txt", ""):
        with pytest.raises(InternalError, match="outside"):
            update(tmp_path / "out", {"fine.txt": b"1", name: b"2"})
    assert list(tmp_path.iterdir()) == []
