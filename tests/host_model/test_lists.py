"""The host model covers what has an adapter, and its headers name what the platform's do."""

from __future__ import annotations

import tomllib
from functools import cache
from pathlib import Path

import pytest

from robosmi.transformations.knowledge.adapters.adapter_files import read_adapter_file
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.verification.originals import original_program, stand_in_headers
from robosmi.verify.original_run import run_original
from tests.host_model.bench import ROOT, built, model
from tests.tiers import sample
from tests.tools import require_tools

ADAPTERS = ROOT / "platform_repo" / "arduino" / "adapters" / "propeller"
NOT_MODELLED = {
    "simpletools.h/sd_mount": "files on SD cards are not modelled",
    **dict.fromkeys((f"stdio.h/{name}" for name in ("fopen", "fclose", "fseek", "ftell", "rewind", "remove")), "files are "
        "not modelled"),
    **dict.fromkeys(("dirent.h/opendir", "dirent.h/readdir", "dirent.h/closedir", "sys/stat.h/mkdir", "sys/unistd.h/rmdir"),
        "folders are not modelled"),
}  # fmt: skip
"""Functions with an adapter and without a model -> the reason; a run that reaches one ends with its name."""


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "objcopy")


@cache
def with_adapters() -> dict[str, set[str]]:
    """Header -> functions of the source platform that have an adapter with a body."""
    found: dict[str, set[str]] = {}
    for path in sorted(ADAPTERS.rglob("*.cpp")):
        for piece in read_adapter_file(path):
            if piece.kind == "adapter" and "TODO" not in piece.text:
                found.setdefault(piece.header, set()).add(piece.name)
    return found


@pytest.mark.parametrize("header", sample(sorted(with_adapters()), 12))
def test_what_has_an_adapter_has_a_model(header: str) -> None:
    names = sorted(name for name in with_adapters()[header] if f"{header}/{name}" not in NOT_MODELLED)
    assert (ROOT / "platform_repo" / "propeller" / "host" / "include" / header).is_file() or (
        ROOT / "platform_repo" / "propeller" / "include" / header
    ).is_file()
    macros = "".join(f"#ifdef {name}\n#define {name}_IS_MACRO 1\n#endif\n" for name in names)
    used = "".join(f"#ifndef {name}_IS_MACRO\n  sink = (void *){name};\n#endif\n" for name in names)
    text = f"#include <{header}>\n{macros}void *volatile sink;\nint main() {{\n{used}}}\n"
    with built(text) as program:
        assert program.unmodelled == ()


def test_reasons_name_what_has_an_adapter() -> None:
    known = {f"{header}/{name}" for header, names in with_adapters().items() for name in names}
    assert sorted({*NOT_MODELLED} - known) == []


@cache
def api() -> ApiIndex:
    """What the headers of the source platform declare."""
    return ApiIndex.load("propeller")


@pytest.mark.parametrize("header", sorted(path.name for path in (ROOT / "platform_repo/propeller/host/include").glob("*.h")))
def test_headers_declare_no_name_that_the_platforms_header_has_not(header: str) -> None:
    """A misspelt function, or one too many, would be a program's own name taken away."""
    index = api()
    if index.raw_kind(header) is None:
        assert header in ("host.h", "terminal_codes.h")
        return
    known = {name for each in index.closure([header]) for name in index.declared(each)}
    known |= tomllib.loads((ROOT / "platform_repo" / "propeller" / "platform.toml").read_text())["parser"]["builtins"].keys()
    functions = with_adapters().get(header, set())
    assert sorted(functions - known) == []


def test_headers_without_a_model_stand_in(tmp_path: Path) -> None:
    source, folder = tmp_path / "program.c", tmp_path / "built"
    folder.mkdir()
    (tmp_path / "own.h").write_text("#include <wifi.h>\n")
    source.write_text(
        '#include "simpletools.h"\n#include "own.h"\n#include "vgatext.h"\nint main() { high(3); if (input(4)) return CHECK; '
        "vgatext_open(16); low(3); }\n"
    )
    assert {"wifi.h", "vgatext.h"} <= {*stand_in_headers([source], model())}
    program = original_program([source], model(), folder)
    assert program.unmodelled == ("vgatext_open",)
    found = run_original(program, 10_000)
    assert (found.status, found.cause) == ("unmodelled", "vgatext_open")
    assert [level for _, level in found.trace.levels("P3")] == [1]


@pytest.mark.parametrize("drives", ["", '#include "abdrive.h"\n'])
def test_a_function_of_a_header_without_a_model_may_have_the_name_of_a_modelled_one(drives: str, tmp_path: Path) -> None:
    """Both headers declare drive_pins, with two parameters and with four."""
    source = tmp_path / "program.c"
    source.write_text(f'#include "servodiffdrive.h"\n{drives}int main() {{ high(3); drive_pins(14, 15); low(3); }}\n')
    found = run_original(original_program([source], model(), tmp_path), 10_000)
    assert (found.status, found.cause) == ("unmodelled", "drive_pins")
    assert [level for _, level in found.trace.levels("P3")] == [1]


def test_constants_without_a_value_end_the_run(tmp_path: Path) -> None:
    source = tmp_path / "program.c"
    source.write_text('#include "simpletools.h"\n#include "wifi.h"\nint main() { high(3); int n = CHECK; }\n')
    found = run_original(original_program([source], model(), tmp_path), 10_000)
    assert (found.status, found.cause) == ("unmodelled", "CHECK")
