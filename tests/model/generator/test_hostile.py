"""Metamodels of strangers: names, documentation and default values are texts, in generated and in dynamic packages."""

from __future__ import annotations

import ast
import unicodedata
from pathlib import Path

import pytest

from robosmi.errors import ModelError
from robosmi.generate.packages import generate_packages
from robosmi.model import Metamodel
from robosmi.model.ecore.source_text import docstring, string
from robosmi.model.elements.python_names import python_name
from robosmi.model.generator.codegen import render
from tests.fuzz.metamodels import CANARY, check, faults

HEAD = (
    '<ecore:EPackage xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
    'xmlns:ecore="http://www.eclipse.org/emf/2002/Ecore" name="p" nsURI="http://p" nsPrefix="p">'
)


@pytest.mark.parametrize("seed", range(1, 9))
def test_a_package_of_hostile_texts_is_inert(seed: int, tmp_path: Path) -> None:
    assert check(seed, tmp_path) in ("inert", "refused")


@pytest.mark.parametrize(
    "text",
    ['"', '""', '"""', '""""', 'a"""', 'a\\"""', '"""a', '\\"', "\\", 'a\n"""', '"""\nimport os\n"""', '"\n"', "'''", "\x85"],
)
def test_a_docstring_ends_where_its_text_does(text: str) -> None:
    module = ast.parse(docstring(text, ""))
    assert len(module.body) == 1
    assert "".join((ast.get_docstring(module, clean=False) or "").split()) == "".join(text.split())


@pytest.mark.parametrize("text", ["\u202e", "\ufeff", "\x85", "\x7f", "\u2028", "'\"\u202e", '"\u202e'])
def test_what_turns_or_hides_text_is_an_escape_in_generated_code(text: str) -> None:
    assert text not in string(text)
    assert ast.literal_eval(string(text)) == text
    assert text not in docstring(f"a{text}b", "")


def test_every_letter_gives_a_name_that_python_takes() -> None:
    """All of the first plane and what lies above in steps; the letters of regular expressions are not those of identifiers."""
    letters = [chr(code) for code in [*range(0x20, 0xD800), *range(0xE000, 0x10000), *range(0x10000, 0x30000, 7)]]
    bad = [letter for letter in letters for name in (letter, f"a{letter}") if not python_name(name).isidentifier()]
    assert not bad, [unicodedata.name(letter, repr(letter)) for letter in bad[:5]]


def test_a_default_value_of_thousands_of_digits_is_left_out(tmp_path: Path) -> None:
    path = tmp_path / "p.ecore"
    kind = "ecore:EDataType http://www.eclipse.org/emf/2002/Ecore#//EInt"
    path.write_text(
        f'{HEAD}<eClassifiers xsi:type="ecore:EClass" name="C"><eStructuralFeatures xsi:type="ecore:EAttribute" name="a" '
        f'eType="{kind}" defaultValueLiteral="{"9" * 5000}"/></eClassifiers></ecore:EPackage>'
    )
    assert [finding.rule for finding in render([path]).findings] == ["RS603"]


def test_a_package_whose_name_no_folder_can_have_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "p.ecore"
    path.write_text(HEAD.replace('name="p"', f'name="{"p" * 5000}"') + "</ecore:EPackage>")
    with pytest.raises(ModelError, match="more than 200 bytes"):
        generate_packages([path], tmp_path / "out")


def test_a_type_that_is_named_like_a_member_is_the_type_of_an_operation(tmp_path: Path) -> None:
    path = tmp_path / "p.ecore"
    path.write_text(
        f'{HEAD}<eClassifiers xsi:type="ecore:EClass" name="C"><eStructuralFeatures xsi:type="ecore:EReference" name="C" '
        'eType="#//C"/><eOperations name="f" eType="#//C"><eParameters name="x" eType="#//C"/></eOperations></eClassifiers>'
        "</ecore:EPackage>"
    )
    assert faults(render([path]).files, tmp_path / "made") == []


@pytest.mark.parametrize(
    ("operation", "parameter"),
    [
        ("f", f"a=open(&quot;{CANARY}&quot;, &quot;w&quot;), b"),
        (f"f(a=open('{CANARY}', 'w')): pass&#10;def g", "x"),
        ("if", "class"),
    ],
)
def test_an_operation_of_a_dynamic_metamodel_is_no_code(
    operation: str, parameter: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "p.ecore"
    kind = "ecore:EDataType http://www.eclipse.org/emf/2002/Ecore#//EString"
    path.write_text(
        f'{HEAD}<eClassifiers xsi:type="ecore:EClass" name="C"><eOperations name="{operation}"><eParameters name="{parameter}" '
        f'eType="{kind}"/></eOperations></eClassifiers></ecore:EPackage>'
    )
    assert Metamodel.load(path).names() == ["C"]
    assert not (tmp_path / CANARY).exists()
