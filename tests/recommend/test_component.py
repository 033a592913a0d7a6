"""Components from JSON: what is read, and what is said about a wrong one."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from robosmi.errors import SourceError
from robosmi.recommend.component import ComponentQuery, read_components


def test_everything_is_read() -> None:
    given = {
        "id": 4,
        "title": "T",
        "label": None,
        "family": "f",
        "tags": ["a"],
        "properties": {"pins": 3},
        "connectors": ["SDA"],
        "x": 1,
    }
    query = ComponentQuery.from_json(given)
    assert query == ComponentQuery("4", "T", family="f", tags=("a",), properties={"pins": "3"}, connectors=("SDA",))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ([], "the component is not an object but a list"),
        ({"id": "1"}, "the component has no 'title'"),
        ({"title": "T"}, "the component has no 'id'"),
        ({"id": "1", "title": 3}, "'title' of the component is a number, not a text"),
        ({"id": True, "title": "T"}, "'id' of the component is true or false, not a text"),
        ({"id": "1", "title": "T\ud800"}, "'title' of the component contains a lone surrogate"),
        ({"id": "1", "title": "T", "tags": "a"}, "'tags' of the component is a text, not a list of texts"),
        ({"id": "1", "title": "T", "connectors": [1]}, "'connectors' of the component is a list, not a list of texts"),
        (
            {"id": "1", "title": "T", "properties": {"a": []}},
            "'properties' of the component is an object, not an object of texts",
        ),
    ],
)
def test_wrong_values(given: object, message: str) -> None:
    with pytest.raises(SourceError) as caught:
        ComponentQuery.from_json(given)
    assert caught.value.message == message
    assert caught.value.fix


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        ('[{"id": "1",}]', ":1:", "is not JSON"),
        ("{}", "", "is not a list of components but an object"),
        ('[{"id": "1", "title": "a"}, 5]', "", "component 2 is not an object but a number"),
        ('[{"id": "1", "title": "a"}, {"id": 1, "title": "b"}]', "", "components 1 and 2 have the same id '1'"),
    ],
)
def test_wrong_files(tmp_path: Path, text: str, place: str, message: str) -> None:
    path = tmp_path / "components.json"
    path.write_text(text)
    with pytest.raises(SourceError) as caught:
        read_components(path)
    assert message in caught.value.message
    assert str(caught.value).startswith(f"{path}{place}")


def test_files(tmp_path: Path) -> None:
    path = tmp_path / "components.json"
    path.write_text(json.dumps([{"id": "b", "title": "B"}, {"id": "a", "title": ""}]))
    assert [query.id for query in read_components(path)] == ["b", "a"]
    path.write_bytes(b"\xff\xfe[")
    with pytest.raises(SourceError, match="UTF-8"):
        read_components(path)
    with pytest.raises(SourceError, match="cannot be read"):
        read_components(tmp_path / "absent.json")
