"""The compiler's own macros, which are the platform's, are left out only where nothing can mean them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.metamodels import ccode
from robosmi.query import all_of_kind
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.t2m.c_source import read_program
from robosmi.transformations.t2m.c_source.parsing import clang
from robosmi.transformations.t2m.c_source.parsing.invocation import arguments
from robosmi.transformations.t2m.c_source.parsing.translation_unit import own_macros

MEANT = {
    "a condition": ("#ifdef __GNUC__\nint seen;\n#endif\n", []),
    "a condition's value": ("#if defined(NOWHERE) || __SIZEOF_POINTER__ == 4\nint seen;\n#endif\n", []),
    "the body of a macro": ("#define MOST __INT_MAX__\n#if MOST > 100\nint seen;\n#endif\n", []),
    "a name that is made": ("#define MADE(x) __##x##_MAX__\n#if MADE(INT) > 100\nint seen;\n#endif\n", []),
    "a definition from outside": ("#if LIMIT > 100\nint seen;\n#endif\n", ["LIMIT=__INT_MAX__"]),
    "a standard header": ("#include <stddef.h>\nsize_t seen;\n", []),
    "the declaration of a standard name": ("size_t seen;\n", []),
}
NOT_MEANT = {
    "a program": '#include "simpletools.h"\nint seen;\nint main() { printf("%d", seen); high(3); }\n',
    "places": "const char *seen = __FILE__; int line = __LINE__;\n",
    "the version of C": "#if defined(__propeller__)\nint seen;\n#endif\n",
    "a text and a comment": 'char *seen = "__GNUC__"; // __INT_MAX__\n',
}


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> list[list[str]]:
    """The arguments of each call of the parser for a program."""
    made: list[list[str]] = []
    parse = clang.parse

    def noted(path: str, given: Any, *rest: Any, **options: Any) -> int | None:
        if path.endswith("program.c"):
            made.append(list(given))
        return parse(path, given, *rest, **options)

    monkeypatch.setattr(clang, "parse", noted)
    return made


def names(path: Path, defines: list[str]) -> set[str]:
    """What the program declares."""
    program, findings = read_program(path, defines=defines)
    assert not [finding for finding in findings if finding.rule == "RS101"]
    return {str(variable.name) for variable in all_of_kind(program, ccode.Variable)}


@pytest.mark.parametrize("name", MEANT)
def test_they_are_there_where_they_may_be_meant(name: str, tmp_path: Path, calls: list[list[str]]) -> None:
    text, defines = MEANT[name]
    (tmp_path / "program.c").write_text(text)
    assert "seen" in names(tmp_path / "program.c", defines)
    assert "-D__GNUC__=4" in calls[-1]


@pytest.mark.parametrize("name", NOT_MEANT)
def test_they_are_left_out_where_nothing_means_them(name: str, tmp_path: Path, calls: list[list[str]]) -> None:
    (tmp_path / "program.c").write_text(NOT_MEANT[name])
    assert "seen" in names(tmp_path / "program.c", [])
    assert not any(word.startswith("-D__GNUC__") for given in calls for word in given)


def test_headers_beside_a_program_may_mean_them(tmp_path: Path, calls: list[list[str]]) -> None:
    (tmp_path / "own.h").write_text("#ifdef __GNUC__\nint seen;\n#endif\n")
    (tmp_path / "program.c").write_text('#include "own.h"\nint main() { return seen; }\n')
    program, findings = read_program(tmp_path / "program.c")
    assert not findings
    assert [str(reference.name) for reference in all_of_kind(program, ccode.NameReference)] == ["seen"]
    assert all("-D__GNUC__=4" in given for given in calls)


FOREIGN = "__linux__ linux __unix__ unix __i386__ i386 __x86_64__ __riscv __clang__ __llvm__ __SSE2__ __APPLE__ _WIN32 __LP64__"
LATER = "__has_include __has_include_next __has_attribute __has_builtin __has_feature __has_extension __has_cpp_attribute"
"""Macros of later compilers than propgcc's."""
OWN = {"__GNUC__": 4, "__GNUC_MINOR__": 6, "__SIZEOF_POINTER__": 4, "__SIZEOF_LONG_DOUBLE__": 8, "__CHAR_UNSIGNED__": 1}


def test_a_program_sees_the_macros_of_its_compiler_and_of_no_machine(tmp_path: Path) -> None:
    lines = [f"#ifdef {name}\nint wrong_{name};\n#endif" for name in (FOREIGN + " " + LATER).split()]
    lines += [f"#if {name} != {value}\nint wrong_{name};\n#endif" for name, value in OWN.items()]
    (tmp_path / "program.c").write_text("\n".join((*lines, "int linux, unix, i386;\n")))
    assert names(tmp_path / "program.c", []) == {"linux", "unix", "i386"}


def test_the_parser_says_itself_which_they_are() -> None:
    words = arguments(ApiIndex.load("propeller"), "C", [], ["MINE=1"])
    found = own_macros(tuple(word for word in words if word != "-undef"))
    assert {"__GNUC__", "__INT_MAX__", "__STDC__"} <= found
    assert "MINE" not in found
    assert len(found) > 100


def test_the_predefined_macros_are_those_of_the_language() -> None:
    in_c, in_cpp = (own_macros(tuple(arguments(ApiIndex.load("propeller"), language, [], []))) for language in ("C", "C++"))
    assert "__cplusplus" in in_cpp
    assert "__cplusplus" not in in_c
    assert "__STDC__" in in_c
