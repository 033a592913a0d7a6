"""What a library's header declares: cases of headers with what is expected of each, damaged ones, and real stand-ins."""

from __future__ import annotations

import json
import random
import time
from pathlib import Path

import pytest
from hypothesis import example, given, strategies as st

from robosmi import resources
from robosmi.transformations.knowledge.libraries.library_ranking import library_api
from robosmi.transformations.knowledge.platforms.api_spelling import literal, spelled
from robosmi.transformations.t2m.library_declarations import declarations
from robosmi.transformations.t2m.library_index import header_api
from tests.tiers import examples

CASES = Path(__file__).parent / "library_declarations"


@pytest.mark.parametrize("case", sorted(path.stem for path in CASES.glob("*.h")))
def test_what_a_header_declares(case: str) -> None:
    expected = json.loads((CASES / f"{case}.json").read_text(encoding="utf-8"))
    assert declarations((CASES / f"{case}.h").read_bytes()) == expected


@pytest.mark.parametrize("case", sorted(path.stem for path in CASES.glob("*.h")))
def test_what_is_read_is_in_the_one_spelling(case: str) -> None:
    read = {"header": "x.h", "main": "x.h"} | declarations((CASES / f"{case}.h").read_bytes())
    api = header_api(read)
    assert [[m.name, m.parameters, m.returns] for c in api.classes for m in c.methods] == [
        method[:3] for declared in read["classes"] for method in declared["methods"]
    ]
    assert [c.bases for c in api.classes] == [tuple(c["bases"]) for c in read["classes"]]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("(const char * ssid,uint8_t & key,int a=-1)", "(const char *ssid, uint8_t &key, int a=-1)"),
        ("(void (* callback)(uint8_t,uint16_t) , char sep=',')", "(void (*callback)(uint8_t, uint16_t), char sep=',')"),
        ("const  unsigned   char *", "const unsigned char *"),
        ("std :: map<int,char *> &", "std::map<int, char *> &"),
        ("operator [] ", "operator[]"),
        ("operator bool", "operator bool"),
        ("(char *=NULL)", "(char *=NULL)"),
        ("(RedBlackNode<T> * & root) const", "(RedBlackNode<T> *&root) const"),
        ("", ""),
    ],
)
def test_one_spelling(text: str, expected: str) -> None:
    assert spelled(text) == expected
    assert spelled(expected) == expected


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0x40", "0x40"), ("( 12 )", "( 12 )"), ("-1", "-1"), ("0b101", "0b101"), ("1.5f", "1.5f"), (".5", ".5"), ("3UL", "3UL"),
        ('"a  b"', '"a  b"'), ("((uint8_t)   5)", "((uint8_t) 5)"), ("A0", "A0"), ("NULL", "NULL"), ("'x'", "'x'"),
        ("1 + 2", None), ("OTHER", None), ("f(1)", None), ("", None), ("(1)(2)", None), ("(" * 5000, None),
    ],
)  # fmt: skip
def test_which_values_are_literals(text: str, value: str | None) -> None:
    assert literal(text) == value


PIECES = [
    *"{}()[]<>;:,=~*&#\n\r\"'\\ ", "class ", "struct ", "enum ", "public:", "private:", "template", "operator", "namespace ",
    'extern "C"', "typedef ", "friend ", "X", "void ", "::", "->", "\n#if 1\n", "\n#else\n", "\n#endif\n", "\n#define A 1\n",
    "const ", "/*", "*/", "//", "\xe9", "\0",
]  # fmt: skip
REPEATED = [
    "(", "{", "<", "class ", "class A {", "#if X\n", "a < ", "public: ", "enum {", "template <", "A(x) ", "void f(), ",
    "operator ", "struct A { void f(); ",
]  # fmt: skip


@given(st.lists(st.sampled_from(PIECES), max_size=60))
@example(["operator ", ")"])
@examples(400)
def test_no_text_stops_the_reading(pieces: list[str]) -> None:
    read = declarations("".join(pieces).encode())
    header_api({"header": "x.h", "main": "x.h"} | read)


def test_a_header_that_is_cut_anywhere_gives_what_stands_before() -> None:
    data = (CASES / "plain.h").read_bytes()
    whole = {m[0] for c in declarations(data)["classes"] for m in c["methods"]}
    chance = random.Random(1)
    for _ in range(60):
        cut = declarations(data[: chance.randrange(len(data))])
        assert {m[0] for c in cut["classes"] for m in c["methods"]} <= whole
    half = declarations(data[: data.index(b"virtual void pure")])
    assert [c["name"] for c in half["classes"]] == ["Plain"]


@pytest.mark.parametrize("piece", REPEATED)
def test_a_huge_header_is_read_in_time_that_its_size_explains(piece: str) -> None:
    times = []
    for count in (5_000, 20_000):
        start = time.process_time()
        declarations((piece * count).encode())
        times.append(time.process_time() - start)
    assert times[1] < max(12 * times[0], 0.5), "four times the text may not take sixteen times the time"


@pytest.mark.parametrize(
    ("folder", "library", "name"), [("Servo", "Servo", "Servo"), ("DHT_sensor_library", "DHT sensor library", "DHT")]
)
def test_a_stand_in_declares_what_the_library_does(folder: str, library: str, name: str) -> None:
    """Two independent sources: the header of the stand-in, read here, and the facts about the real library."""
    path = resources.built_in("platform_repo") / f"arduino/stand_ins/{folder}/{name}.h"
    api = header_api({"header": path.name, "main": path.name} | declarations(path.read_bytes()))
    ours = next(each for each in api.classes if each.name == name)
    real = library_api(library).class_named(name)
    assert real is not None
    assert {method.name for method in ours.methods} <= {method.name for method in real.methods}
    assert len(ours.methods) >= 4
