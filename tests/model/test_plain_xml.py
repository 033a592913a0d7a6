"""Plain XML as a model: the names of Epsilon's driver, changes, references, text, encodings, and files that mean harm."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import ModelError, RobosmiError, SourceError
from robosmi.model.elements.show import tree
from robosmi.model.plain_xml import XmlModel
from robosmi.query import ModelView, Q

CASE = Path(__file__).parent / "drivers" / "cases" / "xml" / "shelf.xml"


@pytest.fixture
def shelf() -> ModelView:
    """The document of the case."""
    return ModelView(XmlModel.load(CASE))


def test_attributes_are_read_as_texts_numbers_and_booleans(shelf: ModelView) -> None:
    gears, levers, zap = shelf.t_book.all
    assert (gears.a_title, gears.s_title, gears.i_pages, gears.b_lent) == ("Gears", "Gears", 120, True)
    assert (levers.d_price, levers.f_price, levers.b_lent) == (2.5, 2.5, False)
    assert (zap.a_price, zap.d_price, zap.i_price) == ("", None, None)
    with pytest.raises(ModelError, match="'Gears' is no whole number"):
        _ = gears.i_title


def test_children_text_and_parents(shelf: ModelView) -> None:
    root = shelf.t_shelf.all.first()
    assert [x.tagName for x in root.children] == ["authors", "book", "book", "niche"]
    assert root.e_authors.c_author[1].text == "Ben"
    assert root.e_nothing is None
    assert root.c_nothing == []
    gears = root.c_book[0]
    assert gears.text == "A good one."
    assert gears.e_b.parentNode is gears
    assert gears.eContainer() is root
    assert root.parentNode is None
    assert gears.line == 8
    assert shelf.Element.all.size() == 9
    assert Q(root.c_book).a_title == ["Gears", "Levers"]
    assert shelf.t_book.all.c_b.flatten().text == ["good"]


def test_references_are_bound_to_attributes() -> None:
    model = XmlModel.load(CASE)
    model.bind("book", "author", "author", "id")
    assert model.t_book.all[0].x_author.text == "Ada"
    model = XmlModel.load(CASE)
    model.bind("book", "author", "author", "id", many=True)
    assert [[a.text for a in b.x_author] for b in model.t_book.all] == [["Ada"], ["Ben"], ["Ada", "Ben"]]
    with pytest.raises(ModelError, match="bind"):
        _ = model.t_author.all[0].x_id


def test_attributes_and_text_are_changed_and_saved(tmp_path: Path) -> None:
    model = XmlModel.load(CASE)
    gears = model.t_book.all[0]
    gears.a_title = 'G & "<x>"'
    gears.i_pages = 7
    gears.b_lent = False
    gears.d_price = 1.5
    gears.a_author = None
    gears.text = "new"
    made = model.t_note(a_by="me", text="hello")
    gears.appendChild(made)
    model.save(tmp_path / "out.xml")
    again = XmlModel.load(tmp_path / "out.xml").t_book.all[0]
    assert (again.a_title, again.i_pages, again.b_lent, again.d_price, again.a_author) == ('G & "<x>"', 7, False, 1.5, "")
    assert again.text == "newhello"
    assert again.e_note.a_by == "me"
    assert (tmp_path / "out.xml").read_text().startswith('<?xml version="1.0" encoding="UTF-8"?>\n<!-- two books -->\n<shelf')


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("i_pages", "7", "does not take '7'"),
        ("i_pages", True, "does not take True"),
        ("b_lent", 1, "does not take 1"),
        ("d_price", "x", "does not take 'x'"),
        ("a_title", "\0", "cannot hold U\\+0000"),
        ("text", "\ud800", "cannot hold U\\+D800"),
        ("children", [], "cannot be set"),
        ("e_b", None, "cannot be set"),
        ("line", 3, "cannot be set"),
        ("title", "x", "did you mean 'a_title'"),
    ],
)
def test_a_value_that_does_not_fit_is_refused(name: str, value: Any, said: str) -> None:
    book = XmlModel.load(CASE).t_book.all[0]
    before = (book.a_title, book.i_pages, book.text)
    with pytest.raises(ModelError, match=said):
        setattr(book, name, value)
    assert (book.a_title, book.i_pages, book.text) == before


def test_elements_move_and_the_text_behind_them_stays() -> None:
    model = XmlModel.parse(b"<a>1<b>2<c/>3</b>4<d>5</d>6</a>")
    a, b, c, d = model.all_contents()
    d.appendChild(c)
    assert (a.text, b.text, d.text) == ("123456", "23", "5")
    assert [x.tagName for x in model.all_contents()] == ["a", "b", "d", "c"]
    model.delete(b)
    assert a.text == "1456"
    assert [x.tagName for x in model.all_contents()] == ["a", "d", "c"]
    for child, parent in ((d, c), (a, d), (d, d), (b, a)):
        with pytest.raises(ModelError):
            parent.appendChild(child)
    with pytest.raises(ModelError, match="the root"):
        model.delete(a)


def test_namespaces_are_local_names_and_new_elements_are_in_the_roots(tmp_path: Path) -> None:
    text = b'<r xmlns="u:1" xmlns:p="u:2" p:x="1"><p:item p:id="7"/><item id="8"/></r>'
    model = XmlModel.parse(text)
    assert [(x.tagName, x.namespaceURI, x.i_id) for x in model.t_item.all] == [("p:item", "u:2", 7), ("item", "u:1", 8)]
    assert model.t_r.all[0].a_x == "1"
    assert [model.element(model.id_of(x)) for x in model.all_contents()] == list(model.all_contents())
    model.t_r.all[0].appendChild(model.t_item(a_id="9"))
    model.save(tmp_path / "out.xml")
    assert b'<item id="8"/><item id="9"/></r>' in (tmp_path / "out.xml").read_bytes()


@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "iso-8859-1", "windows-1252"])
def test_other_encodings_are_read_and_kept(encoding: str, tmp_path: Path) -> None:
    file = tmp_path / "x.xml"
    file.write_bytes(f'<?xml version="1.0" encoding="{encoding}"?>\n<a b="é"><c>ü</c></a>\n'.encode(encoding))
    model = XmlModel.load(file)
    assert (model.t_a.all[0].a_b, model.t_c.all[0].text) == ("é", "ü")
    model.t_a.all[0].a_b = "ä"
    model.save()
    assert XmlModel.load(file).t_a.all[0].a_b == "ä"


@pytest.mark.parametrize("line_end", ["\n", "\r\n"])
def test_the_layout_of_a_file_stays(line_end: str) -> None:
    text = """<?xml version='1.0' encoding="ISO-8859-1" standalone='yes'?>
<!-- head --><?pi x?>
<!DOCTYPE r>
<r b="2" a="1" c="x&#10;y">
  <!-- in -->
  <a/>
  <![CDATA[raw <x>]]>\t<n:c xmlns:n="u" n:q="1&gt;2">\xe4&#8364;</n:c>
</r>
<!-- tail -->
"""
    data = text.replace("\n", line_end).encode("latin-1")
    assert XmlModel.parse(data).to_bytes() == data
    odd = data.replace(b' a="1"', b"   a='1'").replace(b"<a/>", b"<a ></a>")  # only what is inside of a tag changes
    model = XmlModel.parse(odd)
    assert model.to_bytes() == data
    model.t_a.all[0].a_n = "1"
    assert model.to_bytes() == data.replace(b"<a/>", b'<a n="1"/>')


BOMB = (
    b"<!DOCTYPE a ["
    + b"".join(b'<!ENTITY e%d "%s">' % (i, b"&e%d;" % (i - 1) * 10 if i else b"x" * 100) for i in range(12))
    + b"]>"
)


@pytest.mark.parametrize(
    "content",
    [
        BOMB + b"<a>&e11;</a>",
        BOMB + b'<a b="&e11;"/>',
        b'<!DOCTYPE a [<!ENTITY f SYSTEM "file:///etc/passwd">]><a>&f;</a>',
        b'<?xml version="1.0" encoding="windows-1252"?>' + BOMB + b'<a b="&e11;"/>',
        (b"\xff\xfe" + (BOMB + b'<a b="&e11;"/>').decode().encode("utf-16-le")),
        b"<a>&unknown;</a>",
        b"<a></b>",
        b"<a/><b/>",
        b'<?xml version="1.0" encoding="no-such"?><a/>',
    ],
)
def test_files_that_mean_harm_are_refused_at_once(content: bytes, tmp_path: Path) -> None:
    file = tmp_path / "x.xml"
    file.write_bytes(content)
    with pytest.raises(SourceError) as caught:
        XmlModel.load(file)
    assert caught.value.location is not None
    assert caught.value.location.path == str(file)


def test_a_doctype_that_declares_nothing_is_kept(tmp_path: Path) -> None:
    text = '<!DOCTYPE a PUBLIC "-//X" "http://localhost/none.dtd">\n<a><b/></a>\n'
    (tmp_path / "x.xml").write_text(text)
    model = XmlModel.load(tmp_path / "x.xml")
    model.save()
    assert (tmp_path / "x.xml").read_text() == text


def test_files_of_2048_levels_are_read(tmp_path: Path) -> None:
    depth = 2_048
    model = XmlModel.parse(b"<a>" * depth + b"x" + b"</a>" * depth)
    deepest = model.t_a.all[-1]
    assert len(model.t_a.all) == depth
    assert model.t_a.all[0].text == "x"
    assert model.owns(deepest)
    assert len(tree(model, limit=depth).splitlines()) == depth
    model.save(tmp_path / "deep.xml")
    assert len(XmlModel.load(tmp_path / "deep.xml").t_a.all) == depth
    model.delete(model.t_a.all[1])
    assert len(model.t_a.all) == 1


@pytest.mark.parametrize(("head", "most"), [("", 2_048), ('<?xml version="1.0" encoding="UTF-32"?>', 256)])
def test_files_of_more_levels_are_refused_with_the_line(head: str, most: int, tmp_path: Path) -> None:
    file = tmp_path / "deep.xml"
    file.write_bytes((head + "<a>\n" * 20_000 + "</a>" * 20_000).encode("utf-32" if head else "utf-8"))
    with pytest.raises(SourceError, match=f"elements are nested more than {most} levels deep") as refused:
        XmlModel.load(file)
    assert str(refused.value.location) == f"{file}:{most + 1}"
    assert refused.value.fix == "nest the elements of the file less deeply"


def test_two_documents_never_mix() -> None:
    first, second = XmlModel.load(CASE), XmlModel.load(CASE)
    assert first.find_type("t_book") is not second.find_type("t_book")
    assert not first.t_book.has(second.t_book.all[0])
    with pytest.raises(RobosmiError):
        first.t_shelf.all[0].appendChild(second.t_book.all[0])
