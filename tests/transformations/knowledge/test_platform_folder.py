"""A folder's declarations by name: those of all headers in their order, and a builtin of the compiler before all."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from robosmi import resources
from robosmi.transformations.knowledge.api_facts import ApiEntry
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.platform_folder import FolderFacts

HEADERS = {
    "a.h": {
        "kind": "platform",
        "functions": {"go": ["int", "(int pin)"], "both": ["void", "()"], "__builtin_x": ["long", "(int)"]},
        "macros": {"both": True, "LIMIT": False},
        "vars": {"count": "int"},
        "consts": ["ON"],
        "types": {"motor": "struct"},
        "registers": ["R1"],
    },
    "b.h": {"kind": "standard", "functions": {"go": ["char *", "(void)"]}, "consts": ["ON"]},
}


@pytest.fixture
def facts(tmp_path: Path) -> FolderFacts:
    (tmp_path / "platform.toml").write_text('name = "p"\n[parser.builtins]\n__builtin_x = "double"\n', encoding="utf-8")
    (tmp_path / "api.json").write_text(json.dumps({"headers": HEADERS}), encoding="utf-8")
    return FolderFacts(tmp_path)


def test_a_name_has_all_its_declarations_in_the_order_of_headers_and_kinds(facts: FolderFacts) -> None:
    assert list(facts.entries["go"]) == [
        ApiEntry("a.h", "function", "int", "(int pin)"),
        ApiEntry("b.h", "function", "char *", "(void)"),
    ]
    assert list(facts.entries["both"]) == [ApiEntry("a.h", "function", "void", "()"), ApiEntry("a.h", "function_macro")]
    assert list(facts.entries["LIMIT"]) == [ApiEntry("a.h", "macro")]
    assert list(facts.entries["count"]) == [ApiEntry("a.h", "variable", "int")]
    assert list(facts.entries["ON"]) == [ApiEntry("a.h", "constant"), ApiEntry("b.h", "constant")]
    assert list(facts.entries["motor"]) == [ApiEntry("a.h", "type", "struct")]


def test_a_builtin_of_the_compiler_hides_what_headers_say(facts: FolderFacts) -> None:
    assert list(facts.entries["__builtin_x"]) == [ApiEntry("", "function", "double", "()")]


def test_an_unknown_name_has_none(facts: FolderFacts) -> None:
    assert facts.entries.get("nothing", ()) == ()
    assert "nothing" not in facts.entries
    assert set(facts.entries) == {"go", "both", "__builtin_x", "LIMIT", "count", "ON", "motor"}
    assert facts.registers == {"R1"}


def test_a_folder_that_adds_to_a_platform_does_not_hide_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "platform_repo" / "propeller").mkdir(parents=True)
    monkeypatch.setenv("ROBOSMI_PATH", str(tmp_path))
    assert ApiIndex.load("propeller").origin == str(resources.built_in("platform_repo") / "propeller")
