"""What the original is compiled from: the files that its plan has recorded, and the macros of its own compiler."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from robosmi.errors import VerificationError
from robosmi.transformations.verification.originals import original_program
from robosmi.verify.original_build import used_files
from robosmi.verify.original_run import run_original
from tests.host_model.bench import model, said
from tests.tools import require_tools

FOREIGN = "__linux__ linux __gnu_linux__ __unix__ unix __i386__ i386 __x86_64__ __k8__ __SSE2__ __APPLE__ _WIN32 __LP64__ __pic__"
LATER = "__has_include __has_include_next __has_attribute __has_builtin __has_c_attribute __has_cpp_attribute"
"""Macros of later compilers; with the first one a program would ask which files this machine has."""
OWN = {
    "__GNUC__": 4, "__GNUC_MINOR__": 6, "__SIZEOF_POINTER__": 4, "__SIZEOF_LONG_DOUBLE__": 8, "__SIZEOF_DOUBLE__": 4,
    "__CHAR_UNSIGNED__": 1, "__PROPELLER_CMM__": 1, "__propeller__": 1, "__FLT_MANT_DIG__": 24, "__BIGGEST_ALIGNMENT__": 4,
}  # fmt: skip


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "objcopy")


def test_the_original_sees_the_macros_of_its_compiler_and_of_no_machine() -> None:
    lines = [f'#ifdef {name}\nprint("{name}\\n");\n#endif' for name in (FOREIGN + " " + LATER).split()]
    lines += [f'#if {name} != {value}\nprint("{name}\\n");\n#endif' for name, value in OWN.items()]
    assert said("int linux = 1, unix = 2, i386 = 3;\n" + "\n".join(lines) + '\nprint("%d", linux + unix + i386);') == ["6"]


def test_a_precompiled_header_beside_the_program_is_not_read(tmp_path: Path) -> None:
    source, folder = tmp_path / "source", tmp_path / "built"
    source.mkdir()
    folder.mkdir()
    (source / "program.c").write_text('#include "simpletools.h"\nint main() { high(3); pause(VALUE); low(3); }\n')
    (source / "simpletools.h").write_text("#define VALUE 200\nvoid high(int pin); void low(int pin); void pause(int ms, ...);\n")
    first, changed = tmp_path / "predefined.h", tmp_path / "changed.h"
    first.write_text(model().predefined_text)
    changed.write_text((source / "simpletools.h").read_text().replace("200", "100"))
    flags = [word for name in ("machine", "program", "hooks") for word in model().compiler.texts(name)]
    for more in ([], ["-include", str(first)]):
        made = source / "simpletools.h.gch" / ("with" if more else "without")
        made.parent.mkdir(exist_ok=True)
        subprocess.run(["gcc", *flags, *more, "-x", "c-header", str(changed), "-o", str(made)], check=True, cwd=folder)
        plain = tmp_path / "plain.s"  # the compiler itself would take it
        subprocess.run(["gcc", *flags, "-S", str(source / "program.c"), "-o", str(plain)], check=True, cwd=tmp_path)
        assert "$100" in plain.read_text()
    run = run_original(original_program([source / "program.c"], model(), folder), 1e6)
    assert [round(at_us / 1000) for at_us, level in run.trace.levels("P3") if level == 0] == [200]


@pytest.mark.parametrize("name", ["program.s", "program.S", "program.i", "program.o", "program.h", "program.gch", "@program"])
def test_whatever_its_name_a_source_is_read_as_c(tmp_path: Path, name: str) -> None:
    source, folder = tmp_path / name, tmp_path / "built"
    source.write_text("void high(int pin);\n#define PIN 3\nint main() { high(PIN); return 0; }\n")
    folder.mkdir()
    assert run_original(original_program([source], model(), folder), 1e5).trace.levels("P3")
    source.write_text(".globl main\nmain: ret\n")
    with pytest.raises(VerificationError, match="does not compile"):
        original_program([source], model(), folder)


def test_a_file_that_is_not_recorded_is_refused(tmp_path: Path) -> None:
    source, other, folder = tmp_path / "own" / "program.c", tmp_path / "other.h", tmp_path / "built"
    source.parent.mkdir()
    folder.mkdir()
    other.write_text("#define MS 100\n")
    for named in (str(other), "../other.h"):
        source.write_text(f'#include "{named}"\nvoid pause(int ms, ...);\nint main() {{ pause(MS); }}\n')
        original_program([source], model(), folder, only=[source, other])
        with pytest.raises(VerificationError, match=r"does not store a file that the original includes: .*other\.h"):
            original_program([source], model(), folder, only=[source])


def test_the_rule_of_a_compiler_is_read_with_all_its_signs(tmp_path: Path) -> None:
    rule = "a.o: a\\ b.c \\\n  c\\#d.h $$e.h /x/y.h\n"
    assert [path.as_posix() for path in used_files(rule, tmp_path)] == [
        *(f"{tmp_path}/{name}" for name in ("a b.c", "c#d.h", "$e.h")), "/x/y.h"
    ]  # fmt: skip
