"""Values beside the template's own characters: refused with the line, or quoted so that nothing comes of it."""

from __future__ import annotations

import pytest
from hypothesis import given, strategies as st

from robosmi.errors import RuleError
from robosmi.generate import Gen
from tests.quoting import judges
from tests.tiers import examples


def made(text: str, **values: str) -> str:
    """Render a template."""
    return str(Gen(templates={"t": text}).text("t", **values))


@pytest.mark.parametrize(
    ("language", "template"),
    [
        ("c", "/* *{{ x }}/ evil(); */"),
        ("c", "// a {{ x }}?/"),
        ("c", "// a \\{{ x }}\nint a;"),
        ("c", '"dir\\{{ x }}"'),
        ("c", "'\\{{ x }}'"),
        ("c", '"\\x4{{ x }}"'),
        ("c", '"a{{ x }}?/"'),
        ("c", '"??{{ x }}"'),
        ("c", 'R"({{ x }})"'),
        ("c", 'u8R"a({{ x }})a"'),
        ("c", '{{ x }}"abc"'),
        ("c", "/{{ x }}/ evil"),
        ("dot", 'a [label="\\{{ x }}"]'),
        ("html", '<a href="{{ x }}:{{ y }}">'),
        ("html", '<a href="javascript:{{ x }}">'),
        ("html", '<meta http-equiv="refresh" content="0;url={{ x }}">'),
        ("html", '<img srcset="{{ x }}">'),
        ("svg", '<animate attributeName="href" to="{{ x }}"/>'),
        ("html", "<p>&{{ x }};</p>"),
        ("html", "<!-- -{{ x }}-> -->"),
    ],
)
def test_a_place_that_cannot_be_quoted_is_refused_with_its_line(language: str, template: str) -> None:
    with pytest.raises(RuleError) as caught:
        made(f'{{% quoting "{language}" %}}\n{template}\n', x="", y="")
    assert caught.value.location is not None
    assert caught.value.location.line == 2


def test_values_that_meet_in_comments_and_strings_stay_text() -> None:
    code = made('{% quoting "c" %}/* {{ x }}/{{ y }} */ int a;', x="*", y=" evil();")
    assert judges.tokens(code) == ["int", "a", ";"]
    code = made('{% quoting "c" %}char *s = "?{{ x }}";', x='?/"; evil(); //')
    assert code_of(code) == "char * s = ;"


def code_of(text: str) -> str:
    """The tokens of C, without strings and comments."""
    return " ".join(token for token in judges.tokens(text, "x.c", "-std=c99") if token[0] not in "\"'")


_PIECES = st.text("*/?\\ \"'a-0", max_size=3)


@examples(150)
@given(_PIECES, _PIECES, _PIECES, st.text('*/?\\"a', max_size=4), st.text('*/?\\"a', max_size=4))
def test_whatever_stands_around_values_in_c(before: str, between: str, behind: str, x: str, y: str) -> None:
    """Values in a comment or string leave the tokens as they are, or the template is refused."""
    places = (
        ("/* ", " */ int end;", "int end ;"),
        ("// ", "\nint end;", "int end ;"),
        ('char *s = "', '"; int end;', "char * s = ; int end ;"),
    )
    for opens, closes, wanted in places:
        own = f"{opens}{before}v{between}v{behind}{closes}"
        if code_of(own) != wanted:
            continue
        text = f'{{% quoting "c" %}}{opens}{before}{{{{ x }}}}{between}{{{{ y }}}}{behind}{closes}'
        try:
            code = made(text, x=x, y=y)
        except RuleError:
            continue
        assert code_of(code) == wanted, code
