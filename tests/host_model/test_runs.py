"""Building and running originals: what becomes of a program, its types, limits, coverage, and that runs repeat."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import tempfile
from pathlib import Path
from threading import Timer

import pytest

from robosmi.errors import MissingToolError, UsageError, VerificationError
from robosmi.verify import original_run
from robosmi.verify.host_original import with_place
from robosmi.verify.original import Variation
from robosmi.verify.original_build import build_original
from robosmi.verify.original_coverage import coverage, reached
from robosmi.verify.original_run import run_original
from robosmi.verify.simulation import DeviceUse
from tests.host_model.bench import built, model, run, said
from tests.tools import require_tools

BLINK = "#include <simpletools.h>\nint main() { while (1) { high(26); pause(100); low(26); pause(100); } }"

NOTHING = "uses a number below 4096 as an address, as a pointer to nothing does (on the board, the clock frequency is at 0)"


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "gcov", "objcopy")


def test_programs_have_the_types_of_the_platform() -> None:
    words = said(
        'char c = 200; float f = 1.0 / 3; double d = 1.0 / 3; print("%d %d %d %d %d %d %d\\n", sizeof(int), sizeof(long), '
        "sizeof(void *), "
        'sizeof(double), sizeof(long long), c, (int)(d * 1000000000)); print("%d", 2147483647 + 1 < 0);'
    )
    assert words == ["4", "4", "4", "4", "8", "200", "333333344", "1"]


def test_a_program_runs_to_the_horizon() -> None:
    found = run(BLINK, 1000)
    assert (found.status, found.cause, found.trace.state, found.trace.simulated_us) == ("running", "", "running", 1e6)
    assert [width for _, width in found.trace.pulses("P26")] == pytest.approx([100_000] * 5, rel=0.001)
    assert found.trace.engine.startswith("host model of the Propeller P8X32A, gcc")


def test_names_that_only_this_machine_has_are_the_program_s() -> None:
    names = ("alarm", "access", "unlink", "fork", "nice", "select", "sync", "link")
    program = "#include <simpletools.h>\n" + "".join(f"void {name}(void *par) {{ high(26); }}\n" for name in names)
    assert run(program + "int main() { alarm(0); pause(10); low(26); }", 100).trace.pulses("P26")


def test_files_are_called_by_their_names_without_a_folder(tmp_path: Path) -> None:
    source, folder = tmp_path / "where.c", tmp_path / "built"
    folder.mkdir()
    (tmp_path / "own.h").write_text("static const char *header(void) { return __FILE__; }\n")
    source.write_text(
        '#include <simpletools.h>\n#include "own.h"\nint main() { print("%s %s\\n", __FILE__, header()); high(26); pause(10); }\n'
    )
    assert run_original(build_original([source], model(), folder), 100_000).trace.text.split() == ["where.c", "own.h"]


def test_a_name_that_the_platform_has_is_told_with_its_line() -> None:
    program = "#include <simpletools.h>\nvoid rmdir(void *par) {}\nint main() { rmdir(0); }"
    with pytest.raises(VerificationError, match="conflicting types for 'rmdir'") as caught:
        run(program, 100)
    assert caught.value.location is not None
    assert caught.value.location.line == 2
    assert "rename it" in (caught.value.fix or "")


def test_a_program_ends_when_main_and_its_cogs_have_ended() -> None:
    blink = "void blink(void *p) { high(3); pause(300); low(3); }"
    found = run(f"#include <simpletools.h>\n{blink}\nint main() {{ cog_run(blink, 50); high(4); pause(50); return 0; }}")
    assert (found.status, found.trace.state) == ("finished", "done")
    assert found.trace.simulated_us == pytest.approx(300_000, abs=500)
    assert found.trace.levels("P4")[-1][1] == 1  # the start-up code puts the cog of main to sleep, which keeps its outputs
    at, level = found.trace.levels("P3")[-1]
    assert at == pytest.approx(300_000, abs=500)
    assert level == "z"  # a cog that has stopped lets go of its pins


@pytest.mark.parametrize(
    ("text", "status", "cause"),
    [
        ("badge_setup();", "unmodelled", "badge_setup"),
        ('system("true");', "unmodelled", "system"),
        ("fork();", "unmodelled", "fork"),
        ('fopen("x", "w");', "unmodelled", "fopen"),
        ("CTRA = 20 << 26;", "unmodelled", "CTRA in a logic mode"),
        ("clkset(0, 12000000);", "unmodelled", "clkset"),
        ("clkset(CLKMODE | 0x80, CLKFREQ);", "unmodelled", "clkset"),
        ("*(volatile int *)0 = 1;", "crashed", NOTHING),
        ("*(volatile int *)0x10000 = 1;", "crashed", "reaches for memory that is not there"),
        ("volatile int zero = 0; print(\"%d\", 7 / zero);", "crashed", "divides by zero"),
        ("((volatile int *)__builtin_frame_address(0))[1] = 0x10000;", "crashed",
            "goes on where no code is, as after a value was put beyond the end of a local array"),
        ("abort();", "crashed", "calls abort"),
    ],
)  # fmt: skip
def test_what_ends_a_run_is_told(text: str, status: str, cause: str) -> None:
    act = f"__attribute__((noinline)) void act(void) {{ {text} }}"
    found = run(f"#include <simpletools.h>\n{act}\nint main() {{ high(5); act(); low(5); pause(10); }}")
    assert (found.status, found.cause, found.trace.state) == (status, cause, "crashed")
    assert [level for _, level in found.trace.levels("P5")] == [1]


@pytest.mark.parametrize("text", ['print("%s", 0);', "*(volatile int *)0 = 1;", "cog_end((int *)0);"])
def test_the_line_of_a_crash_is_told(text: str) -> None:
    with built(f"#include <simpletools.h>\nint main() {{\n  pause(1);\n  {text}\n  pause(1);\n}}") as program:
        found = with_place(program, run_original(program, 10_000))
    assert found.cause.endswith(" (program.c:4)")


def test_a_call_of_the_operating_system_is_told() -> None:
    found = run('int main() { __asm__ volatile("int $0x80" : : "a"(20)); return 0; }')
    assert found.status == "crashed"
    assert "it calls the operating system" in found.cause


def test_functions_without_a_model_are_told_before_the_run() -> None:
    with built("#include <simpletools.h>\nvoid other(void);\nint main() { if (input(3)) other(); high(5); }") as program:
        assert program.unmodelled == ("other",)
        assert run_original(program, 1000).status == "finished"  # it is not reached


def test_a_recursion_without_end_is_told() -> None:
    found = run("int deep(int n) { return deep(n + 1) + n; }\nint main() { return deep(0); }")
    assert found.status == "recursion"


def test_no_system_call_gets_through() -> None:
    found = run('int main() { __asm__ volatile("int $0x80" :: "a"(20)); for (;;); }')  # getpid
    assert found.status == "crashed"


def test_constructors_of_the_program_run_in_its_limits() -> None:
    text = (
        'void first(void) __attribute__((constructor));\nvoid first(void) { __asm__ volatile("int $0x80" :: "a"(20)); '
        "}\nint main() { }"
    )
    assert run(text).status == "crashed"
    assert run("#include <simpletools.h>\nint n;\n__attribute__((constructor)) void first(void) { n = 5; }\n"
               'int main() { print("%d", n); }').trace.text == "5"  # fmt: skip


@pytest.mark.parametrize("loop", ["while (1);", "for (;;) {}", "volatile int n; while (1) n++;"])
def test_a_main_that_never_yields_lets_its_cogs_run(loop: str) -> None:
    blink = "void blink(void *p) { while (1) { high(3); pause(100); low(3); pause(100); } }"
    found = run(f"#include <simpletools.h>\n{blink}\nint main() {{ cog_run(blink, 50); {loop} }}", 1000)
    assert found.status == "running"
    assert len(found.trace.pulses("P3")) == 5


def test_time_is_limited() -> None:
    found = run("int main() { volatile int n; while (1) n++; }", 1e12, limit_s=0.5)
    assert found.status == "time limit"


def test_other_work_on_the_machine_ends_no_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """The process stands still for longer than its limit of processor time, as if others had the cores."""

    class Paused(subprocess.Popen[bytes]):
        def __init__(self, *args: object, **options: object) -> None:
            super().__init__(*args, **options)  # type: ignore[call-overload]
            os.kill(self.pid, signal.SIGSTOP)
            Timer(1.3, os.kill, (self.pid, signal.SIGCONT)).start()

    with built(BLINK) as program:
        monkeypatch.setattr("robosmi.verify.original_run.subprocess.Popen", Paused)
        assert run_original(program, 20_000, limit_s=1.0).status == "running"


def test_output_is_limited(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(original_run, "_MOST_RECORDS", 10_000)
    found = run("#include <simpletools.h>\nint main() { while (1) { high(1); low(1); } }", 1e9)
    assert found.status == "output limit"


def test_runs_repeat_and_vary_with_their_seed() -> None:
    text = (
        "#include <simpletools.h>\nvolatile int flag;\nvoid other(void *p) { pause(7); flag = 1; while (1) toggle(4); }\n"
        'int main() { cog_run(other, 50); while (!flag); for (int i = 0; i < 5; i++) print("%d ", random(1, 1000)); high(5); }'
    )
    with built(text) as program:
        plain, again = (run_original(program, 20_000) for _ in range(2))
        assert plain == again
        noise = Variation(seed=4, noise=0.2)
        varied, same = (run_original(program, 20_000, variation=noise) for _ in range(2))
        assert varied == same
        assert varied.trace.changes != plain.trace.changes
        assert varied.trace.text != plain.trace.text
        assert run_original(program, 20_000, variation=Variation(seed=5, noise=0.2)).trace.text != varied.trace.text
        late = run_original(program, 20_000, variation=Variation(late_us=500)).trace
        assert 0 < late.levels("P5")[0][0] - plain.trace.levels("P5")[0][0] <= 501
        fast, slow = (
            len(run_original(program, 20_000, variation=Variation(block_factor=factor, call_factor=factor)).trace.levels("P4"))
            for factor in (0.5, 2)
        )
        assert fast == pytest.approx(4 * slow, rel=0.05)


def test_a_clock_that_is_ahead_is_seen_in_another_poll() -> None:
    text = (
        "#include <simpletools.h>\n#include <time.h>\n"
        "int main() { pause(20); int until = time(NULL) + 2; high(5); while (time(NULL) < until) pause(50); low(5); }"
    )
    with built(text) as program:
        lasts = []
        for ahead_us in (0.0, 45_000.0):
            (up, _), (down, _) = run_original(program, 3_000_000, variation=Variation(clock_us=ahead_us)).trace.levels("P5")[:2]
            lasts.append((down - up) / 1000)
    assert lasts == pytest.approx([2000, 1950], abs=2)


def test_coverage_is_that_of_the_users_lines_and_branches() -> None:
    text = (
        "#include <simpletools.h>\nint main() {\n  while (1) {\n    if (input(3) == 1)\n      high(5);\n    else\n      "
        "low(5);\n    pause(10);\n  }\n}\n"
    )
    with built(text) as program:
        quiet = run_original(program, 100_000)
        pressed = run_original(program, 100_000, [DeviceUse("levels", {"pin": "P3"}, {"points": [[0, 0], [50, 1]]})])
        half = coverage(program, [quiet.counts])
        assert half.branch_percent == 50
        assert [place[1:] for place in half.missed_branches] == [(4, 0)]
        assert {line: count > 0 for (_, line), count in half.lines.items()}[5] is False
        whole = coverage(program, [quiet.counts, pressed.counts])
        assert (whole.line_percent, whole.branch_percent) == (100, 100)
        assert reached(program, quiet.counts) < reached(program, pressed.counts)
        assert coverage(program, []).line_percent == 0


def test_a_program_that_does_not_compile_is_told_with_its_place(tmp_path: Path) -> None:
    source, folder = tmp_path / "wrong.c", tmp_path / "built"
    folder.mkdir()
    for text, told, line in [
        ("int main() {\n  nothing = 1;\n}\n", "nothing", 2),
        ('#include "own.h"\nint main() {}\n', "own.h", 1),
    ]:
        source.write_text(text)
        with pytest.raises(VerificationError) as error:
            build_original([source], model(), folder)
        assert told in error.value.message
        assert error.value.location is not None
        assert (error.value.location.path, error.value.location.line) == (str(source), line)
        assert error.value.exit_code == 6


def test_files_are_linked_as_on_the_platform(tmp_path: Path) -> None:
    one, two, folder = tmp_path / "one.c", tmp_path / "two.c", tmp_path / "built"
    folder.mkdir()
    (tmp_path / "more").mkdir()
    (tmp_path / "more" / "own.h").write_text("extern int shared;\nvoid high(int pin);\n")
    one.write_text('#include "own.h"\nint main() { high(3); return 0; }\n')
    two.write_text(
        '#include "own.h"\nint print(const char *text, ...);\nint shared;\nvoid high(int pin) { print("own %d", pin); }\n'
    )
    program = build_original([one, two], model(), folder, [tmp_path / "more"])
    assert run_original(program, 10_000).trace.text == "own 3"  # the program's function goes before the library's
    two.write_text("int main() { return 1; }\n")
    with pytest.raises(VerificationError, match="defines main more than once"):
        build_original([one, two], model(), folder, [tmp_path / "more"])
    two.write_text("int shared;")
    with pytest.raises(VerificationError, match="no main function"):
        build_original([two], model(), folder)


def test_a_missing_compiler_is_told_with_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = tmp_path / "blink.c"
    source.write_text(BLINK)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(MissingToolError, match="gcc") as error:
        build_original([source], model(), tmp_path)
    assert error.value.exit_code == 4
    assert "gcc-multilib" in str(error.value)


def test_a_compiler_without_the_word_size_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("ld", "nm", "objcopy", "gcov", "ar", "addr2line"):
        (tmp_path / name).symlink_to("/bin/true")
    compiler = tmp_path / "gcc"
    compiler.write_text(
        "#!/bin/sh\n"
        'case " $* " in\n'
        '  " --version ") echo gcc 99.1 ;;\n'
        "  *' -m32 '*) echo 'fatal error: bits/libc-header-start.h' >&2; exit 1 ;;\n"
        f'  *) PATH={os.environ["PATH"]} exec {shutil.which("gcc")} "$@" ;;\n'  # the launcher is built for this machine
        "esac\n"
    )
    compiler.chmod(0o755)
    source, folder = tmp_path / "blink.c", tmp_path / "built"
    source.write_text(BLINK)
    folder.mkdir()
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(MissingToolError, match=r"gcc 99.1 cannot build such programs here \(-m32\)"):
        build_original([source], model(), folder)


def test_devices_that_are_used_wrongly_are_told() -> None:
    with built(BLINK) as program:
        for use in (
            DeviceUse("levels", {"pin": "P32"}, {"points": []}),
            DeviceUse("nothing"),
            DeviceUse("voltages", {"pin": "P3"}, {"points": [[0, 1000]]}),
        ):
            with pytest.raises(UsageError):
                run_original(program, 1000, [use])


def test_nothing_is_left_behind(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    before = _children()
    run("int main() { volatile int n; while (1) n++; }", 1e12, limit_s=0.2)
    run('int main() { __asm__ volatile("int $0x80" :: "a"(20)); for (;;); }')
    run(BLINK, 10)
    assert list(tmp_path.iterdir()) == []
    assert _children() == before


def _children() -> str:
    return subprocess.run(
        ["ps", "-o", "comm=", "--ppid", str(os.getpid())], capture_output=True, text=True, check=False
    ).stdout.replace("ps\n", "")
