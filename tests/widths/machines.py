"""The results of functions `case_NAME(void)` of a C program on a 32-bit machine with unsigned char, and in its sketch.

The former is the truth (gcc for 32 bits), the latter is measured: the sketch is compiled for an Uno and simulated. A case
without a meaning in C on the source (signed overflow, division by zero) has no value.
"""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import robosmi
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import simulate
from robosmi.verify.toolchains.toolchain import compile_sketch

_CASE = re.compile(r"\bcase_(\w+)\s*\(void\)")
_END = "void setup() {\n}\n"
SANITIZED = "-fsanitize=signed-integer-overflow,integer-divide-by-zero,shift-exponent,bounds"


def names(program: Path) -> list[str]:
    """The names of a program's cases."""
    return list(dict.fromkeys(_CASE.findall(program.read_text())))


def truth(program: Path, folder: Path) -> dict[str, int]:
    """The result of each case on a 32-bit machine; cases that end with a signal are left out."""
    cases = names(program)
    called = "\n".join(f"static long called_{name}(void) {{ return case_{name}(); }}" for name in cases)
    calls = "\n".join(f'  one("{name}", called_{name});' for name in cases)
    text = re.sub(r"int main\(void\) \{\}", "", program.read_text())
    runner = (
        "#include <sys/wait.h>\n#include <unistd.h>\n#include <stdio.h>\n"
        "static void one(const char *name, long (*f)(void)) {\n"
        '  fflush(stdout);\n  if (fork() == 0) { long v = f(); printf("%s %ld\\n", name, v); fflush(stdout); _exit(0); }\n'
        "  int how; wait(&how);\n}\n"
    )
    source = folder / "truth.c"
    source.write_text(f"{text}\n{called}\n{runner}int main(void) {{\n{calls}\n  return 0;\n}}\n")
    flags = ["-m32", "-funsigned-char", "-w", "-O0", "-std=gnu99", SANITIZED, "-fsanitize-undefined-trap-on-error"]
    subprocess.run(["gcc", *flags, str(source), "-o", str(folder / "truth"), "-lm"], check=True)
    said = subprocess.run([str(folder / "truth")], capture_output=True, text=True, check=True).stdout
    return {name: int(value) for name, value in (line.split() for line in said.splitlines())}


def measured(program: Path, folder: Path, widths: str = "fix") -> dict[str, int]:
    """The result of each case in the migrated sketch of the program.

    Raises:
        AssertionError: the sketch does not compile, or does not come to its end.
    """
    out = folder / f"out-{widths}"
    made = robosmi.migrate([program], out, widths=widths)
    sketch = next(made.sketch.glob("*.ino"))
    text = sketch.read_text()
    assert _END in text
    lines = "".join(f'  Serial.print(F("{n} ")); Serial.println((int32_t)case_{n}());\n' for n in names(program))
    bench = folder / f"bench-{widths}" / "bench"
    shutil.copytree(made.sketch, bench)
    (bench / sketch.name).unlink()
    printing = f'void setup() {{\n  Serial.begin(115200);\n{lines}  Serial.println(F("end"));\n}}\n'
    (bench / "bench.ino").write_text(text.replace(_END, printing))
    report = compile_sketch(bench, "uno", keep=folder)
    assert report.ok, [d.message for d in report.diagnostics][:5]
    assert report.elf is not None
    assert report.hex is not None
    for seconds in (2, 20):
        seen = simulate(job(report.elf, report.hex, load_board("uno"), seconds * 1e6), "simavr").text
        if seen.endswith("end\r\n"):
            break
    assert seen.endswith("end\r\n"), seen[-200:]
    return {name: int(value) for name, value in (line.split() for line in seen.splitlines()[:-1])}
