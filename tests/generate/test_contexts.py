"""`{% quoting %}`: templates quote what they print for its place; who declares nothing prints as EGL does."""

from __future__ import annotations

from typing import Any

import pytest

from robosmi import resources
from robosmi.errors import RuleError
from robosmi.generate import Gen
from tests.quoting import judges

EVIL = '*/ x";\nint evil; // <b>`|[l](javascript:x)\\'


def made(text: str, **values: Any) -> str:
    """Render a template."""
    return str(Gen(templates={"t": text}).text("t", **values))


def test_a_template_that_declares_nothing_prints_as_egl_does() -> None:
    assert made("// {{ x }}", x="a\nb") == "// a\n   b"
    assert made('{% quoting "nothing" %}\n// {{ x }}', x="a\nb") == "// a\n   b"


def test_each_place_of_c() -> None:
    text = made(
        '{% quoting "c" %}\n#include <{{ x }}>\n#include "{{ x }}"\n// {{ x }}\n/* a {{ x }}{{ x }} */\nint {{ x }}; // {{ x }}\n'
        'const char *s = "{{ x }}";\nint c = \'{{ "a" }}\';\nint last;\n',
        x=EVIL,
    )
    found = [word for word in judges.tokens(text, "x.c", "-std=c99") if word[:1] not in "\"'"]
    wanted = "int xintevilbljavascriptx ; const char * s = ; int c = ; int last ;"
    assert " ".join(found).endswith(wanted)


def test_harmless_texts_are_printed_as_they_are() -> None:
    template = '// {{ x }} {{ "  [" ~ y ~ "]" if y }}\nint {{ x }} = {{ n }}; {{ none }}\n'
    values = {"x": "LED1", "y": "a/b *c", "n": 12, "none": None}
    assert made(f'{{% quoting "c" %}}\n{template}', **values) == made(template, **values)


def test_what_is_said_to_be_safe_is_printed_as_it_is() -> None:
    assert (
        made('{% quoting "c" %}{{ x | safe }}{% print out.print(x | safe) %}', x="int a;\nint b;")
        == "int a;\nint b;int a;\nint b;"
    )
    assert made('{% quoting "c" %}{% print out.print(x) %}', x="int a;\nb") == "intab"


def test_a_text_that_is_quoted_for_another_place_is_quoted_again() -> None:
    assert made('{% quoting "c" %}"{{ x | c_string }}"', x='a"b') == '"a\\"b"'
    assert made('{% quoting "c" %}// {{ x | markdown }}', x="a\\") == "// a\\\\ ."


def test_macros_blocks_and_regions() -> None:
    text = made(
        '{% quoting "c" %}\n{% macro f(a) %}// {{ a }}\n{% endmacro %}\n{{ f(x) }}\n{% protected x, start="/*", end="*/" %}\n'
        "{{ x }}\n{% endprotected %}\n",
        x="a */ b",
    )
    assert text.startswith("// a * / b\n/* protected region a * / b on begin */\nab\n")


@pytest.mark.parametrize(
    ("template", "said"),
    [
        ('{% quoting "cobol" %}', "'cobol' is no language"),
        ('{% quoting "c" %}{% quoting "html" %}', "declares one language"),
        ('{% quoting "html" %}<{{ x }}>', "no value can be printed here"),
        ('{% quoting "markdown" %}[a]({{ x }})', "no value can be printed here"),
        ('{% quoting "html" %}<p onclick="{{ x }}">', "no value can be printed here"),
        ('{% quoting "html" %}<script>{{ x }}</script>', "no value can be printed here"),
        ('{% quoting "yaml" %}a: "{{ x }}"', "no value can be printed here"),
        ('{% quoting "c" %}{% if x %}// {% endif %}{{ x }}', "begins as c_word and ends as c_comment"),
        ('{% quoting "c" %}{{ "// " ~ x }}', "must not begin or end a comment"),
    ],
)
def test_what_cannot_be_quoted_is_an_error_with_its_place(template: str, said: str) -> None:
    with pytest.raises(RuleError, match=said) as caught:
        made(f"\n{template}", x="")
    assert caught.value.location is not None
    assert caught.value.location.line == 2


def test_html_places() -> None:
    text = made(
        '{% quoting "html" %}<a href="{{ u }}" title="{{ x }}">{{ x }}</a><!-- {{ x }} --><p>{{ y | e }}{{ z | safe }}</p>',
        u="javascript:alert(1)", x='"><script>-->', y="<i>", z="<b>",
    )  # fmt: skip
    page = judges.Page(text)
    assert page.tags == [("a", {"href": "about:invalid", "title": '"><script>-->'}), ("p", {}), ("b", {})]
    assert page.text == '"><script>--><i>'


def test_values_of_yaml_toml_and_csv_are_whole() -> None:
    assert made('{% quoting "yaml" %}a: {{ x ~ " (" ~ y ~ ")" }}\n', x="Servo", y="1.0") == "a: Servo (1.0)\n"
    assert made('{% quoting "yaml" %}a: {{ x }}\n', x="b: c") == 'a: "b: c"\n'
    assert made('{% quoting "toml" %}a = {{ x }} # {{ x }}\n', x="b\nc") == 'a = "b\\nc" # b c\n'
    assert made('{% quoting "csv" %}{{ x }},{{ y }}\n', x="=1", y="a,b") == '\'=1,"a,b"\n'


def test_each_of_our_templates_declares_what_it_makes() -> None:
    """But the one for Python packages, which another engine fills with what the generator of packages has quoted, and the page of
    a corpus, which Jinja's own escaping fills."""
    found = sorted(resources.built_in("templates").rglob("*.j2"))
    assert len(found) >= 9
    for path in found:
        if path.parent.name not in ("metamodel", "corpus"):
            assert path.read_text(encoding="utf-8").startswith('{% quoting "'), path
