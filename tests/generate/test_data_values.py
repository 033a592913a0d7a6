"""Values in YAML, TOML and CSV are whole, or the template is refused; in HTML and SVG they are text.

The judges are PyYAML, tomllib, Python's reader of CSV, and lxml.
"""

from __future__ import annotations

import csv
import io
import re
import tomllib
from typing import Any

import pytest
import yaml
from hypothesis import given
from lxml import etree, html

from robosmi import quoting
from robosmi.errors import RuleError
from robosmi.generate import Gen
from tests.quoting import judges
from tests.tiers import examples


def made(language: str, text: str, **values: str) -> str:
    """Render a template."""
    return str(Gen(templates={"t": f'{{% quoting "{language}" %}}\n{text}'}).text("t", **values))


REFUSED = [
    ("yaml", "a: v{{ x }}\n"),
    ("yaml", "a: {{ x }} b\n"),
    ("yaml", "a: {{ x }}{{ y }}\n"),
    ("yaml", "a: {{ x }}, {{ y }}\n"),
    ("yaml", "a: [b {{ x }}]\n"),
    ("yaml", "a: '{{ x }}'\n"),
    ("yaml", 'a: "b\n  {{ x }}"\n'),
    ("yaml", "a: 1\n  {{ x }}\n"),
    ("yaml", "- {{ x }}|\n"),
    ("toml", "a = v{{ x }}\n"),
    ("toml", "a = {{ x }}v\n"),
    ("toml", "a = '{{ x }}'\n"),
    ("toml", 'a = """\n{{ x }}\n"""\n'),
    ("toml", "a = '''\n{{ x }}\n'''\n"),
    ("csv", "{{ x }} ({{ y }})\n"),
    ("csv", "a{{ x }}\n"),
    ("csv", "{{ x }}b\n"),
    ("csv", '"{{ x }}"\n'),
    ("html", '<meta http-equiv="refresh" content="{{ x }}">'),
    ("html", '<meta content="{{ x }}" name="a">'),
    ("html", '<meta name="a" http-equiv="refresh" content="{{ x }}">'),
    ("html", '<meta http-equiv="refresh" name="a" content="{{ x }}">'),
    ("html", '<meta name="a" content="{{ x }}" http-equiv="refresh">'),
]


@pytest.mark.parametrize(("language", "text"), REFUSED)
def test_a_value_that_is_not_whole_is_refused_with_its_line(language: str, text: str) -> None:
    with pytest.raises(RuleError) as caught:
        made(language, text, x="", y="")
    assert caught.value.location is not None
    assert caught.value.location.line == 2 + text.partition("{{")[0].count("\n")


YAML: list[tuple[str, Any]] = [
    ("a: {{ x }}\nb: {{ y }}\n", {"a": "X", "b": "Y"}),
    ("{{ x }}: {{ y }}\n", {"X": "Y"}),
    ("a: 1\n{{ x }}: {{ y }} # {{ x }}\n", {"a": 1, "X": "Y"}),
    ("a:\n  {{ x }}: 1\n  b: {{ y }}\n", {"a": {"X": 1, "b": "Y"}}),
    ("- {{ x }}\n- - {{ y }}\n", ["X", ["Y"]]),
    ("a: [{{ x }}, {{ y }}]\n", {"a": ["X", "Y"]}),
    ("a: [\n  {{ x }},\n  {{ y }}\n]\nb: {{ x }}\n", {"a": ["X", "Y"], "b": "X"}),
    ("a: {b: {{ x }}, c: {{ y }}}\n", {"a": {"b": "X", "c": "Y"}}),
    ("a: |\n  {{ x }}\n  t {{ y }}\nb: {{ x }}\n", {"a": "LINE X\nt LINE Y\n", "b": "X"}),
    ("- k: |-\n    t {{ x }}\n  n: {{ y }}\n", [{"k": "t LINE X", "n": "Y"}]),
    ("- |\n  t\n   {{ x }}\n- {{ y }}\n", ["t\n LINE X\n", "Y"]),
    ("a: |2\n   {{ x }}\nb: {{ y }}\n", {"a": " LINE X\n", "b": "Y"}),
    ("a: |\nb: {{ x }}\n", {"a": "", "b": "X"}),
]


def filled(wanted: Any, x: str, y: str) -> Any:
    """The value with the texts in it; what is a line of a block is shown as one line."""
    if isinstance(wanted, dict):
        return {filled(key, x, y): filled(value, x, y) for key, value in wanted.items()}
    if isinstance(wanted, list):
        return [filled(one, x, y) for one in wanted]
    if wanted in ("X", "Y"):
        return whole(x if wanted == "X" else y)
    if not isinstance(wanted, str):
        return wanted
    return wanted.replace("LINE X", quoting.yaml_line(x)).replace("LINE Y", quoting.yaml_line(y))


def whole(text: str) -> str:
    """A text whose unpaired surrogates are written as escapes: no file can contain them."""
    return text.encode("utf-16", "surrogatepass").decode("utf-16", "replace")


@examples(120)
@given(judges.texts(), judges.texts())
def test_any_text_is_a_value_of_yaml(x: str, y: str) -> None:
    for text, wanted in YAML:
        if "|" in text and not (quoting.yaml_line(x).strip() and quoting.yaml_line(y).strip()):
            continue  # a block whose lines are empty has other line ends, and no other value
        if "{{ x }}:" in text and len(x) > 150:
            continue
        made_text = made("yaml", text, x=x, y=y)
        found = yaml.safe_load(made_text)
        expected = filled(wanted, x, y)
        if "|" in text:
            found, expected = _stripped(found), _stripped(expected)
        assert found == expected, made_text


def _stripped(value: Any) -> Any:
    """Without blanks at ends of lines, which a template's engine may take away."""
    if isinstance(value, dict):
        return {key: _stripped(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_stripped(one) for one in value]
    return "\n".join(line.rstrip() for line in value.split("\n")) if isinstance(value, str) else value


TOML: list[tuple[str, Any]] = [
    ("a = {{ x }} # {{ y }}\nb = {{ y }}\n", {"a": "X", "b": "Y"}),
    ("a = [{{ x }}, {{ y }}]\n", {"a": ["X", "Y"]}),
    ("a = [\n  {{ x }},\n  {{ y }}\n]\nb = {{ x }}\n", {"a": ["X", "Y"], "b": "X"}),
    ("a = { b = {{ x }}, c = {{ y }} }\n", {"a": {"b": "X", "c": "Y"}}),
    ("[{{ x }}]\n{{ y }} = 1\n", {"X": {"Y": 1}}),
    ("a.{{ x }} = {{ y }}\n", {"a": {"X": "Y"}}),
    ("a = '''\nit's\n'''\nb = {{ x }}\n", {"a": "it's\n", "b": "X"}),
]


@examples(120)
@given(judges.texts(), judges.texts())
def test_any_text_is_a_value_of_toml(x: str, y: str) -> None:
    for text, wanted in TOML:
        assert tomllib.loads(made("toml", text, x=x, y=y)) == filled(wanted, x, y)


@examples(120)
@given(judges.texts(), judges.texts())
def test_any_text_is_a_cell_of_csv(x: str, y: str) -> None:
    text = made("csv", "{{ x }},{{ y }}\n{{ y }};b\n", x=x, y=y)
    rows = list(csv.reader(io.StringIO(text, newline="")))
    assert [quoting.csv_text(cell) for cell in rows[0]] == [x, y]


PAGE = """<html><head><meta name="description" content="{{ x }}"><title>{{ y }}</title></head>
<body><p id="a" title="{{ x }}">{{ y }}</p><a href="{{ x }}">b</a><img src="{{ y }}" alt='{{ x }}'>
<!-- {{ x }} --><i>end</i></body></html>
"""
PICTURE = """<svg xmlns="http://www.w3.org/2000/svg"><title>{{ x }}</title><!-- {{ y }} -->
<text x="1" data-name="{{ y }}">{{ x }}</text><a href="{{ x }}"><rect id='{{ y }}'/></a></svg>
"""


def shape(root: Any) -> list[tuple[str, list[str]]]:
    """The elements in order, comments too, with the names of their attributes."""
    return [(e.tag, sorted(e.attrib)) if isinstance(e.tag, str) else ("a comment", []) for e in root.iter()]


def seen(text: str | None) -> str:
    """A text without blanks and line breaks, and with what XML cannot hold as U+FFFD."""
    fit = re.sub("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]", "\ufffd", text or "")
    return re.sub(r"\s", "", fit)


@examples(120)
@given(judges.texts(), judges.texts())
def test_any_text_is_text_of_html_for_lxml(x: str, y: str) -> None:
    plain = html.document_fromstring(made("html", PAGE, x="a", y="b"))
    root: Any = html.document_fromstring(made("html", PAGE, x=x, y=y))
    assert shape(root) == shape(plain)
    runs = ("javascript:", "data:", "vbscript:")
    assert not any(address.strip().lower().startswith(runs) for *_, address, _ in root.iterlinks())
    (paragraph,) = root.iter("p")
    assert (seen(paragraph.get("title")), seen(paragraph.text)) == (seen(x), seen(y))


@examples(120)
@given(judges.texts(), judges.texts())
def test_any_text_is_text_of_svg_for_lxml(x: str, y: str) -> None:
    parser = etree.XMLParser(resolve_entities=False, no_network=True)
    plain = etree.fromstring(made("svg", PICTURE, x="a", y="b").encode(), parser)
    root = etree.fromstring(made("svg", PICTURE, x=x, y=y).encode(), parser)
    assert shape(root) == shape(plain)
    (text,) = root.iter("{http://www.w3.org/2000/svg}text")
    assert (seen(text.text), seen(text.get("data-name"))) == (seen(x), seen(y))
