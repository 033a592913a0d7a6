"""Compare the pins that random programs use on this computer with those that their migrated sketches use.

Usage: python -m tests.fuzz.pins [--cases N] [--seed N] [--keep DIR]. Run by hand (`make fuzz`). Each port of a program is
bound to a pin whose number no port has, so that a number that stays shows. A sketch that differs although RoboSMi calls it ready
is a silent wrong pin, and so is a port that no list has, at a line that no finding names. Programs without a meaning in C, and
those that use ports that the chip lacks, are left out and counted.
"""

from __future__ import annotations

import argparse
import collections
import re
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

import robosmi
from robosmi.diagnostics import Finding, Severity
from robosmi.errors import RobosmiError
from tests.fuzz.pin_programs import program

_LOG = r"""
#pragma once
#include <stdint.h>
#include <stdio.h>
#ifdef __cplusplus
extern "C"
#endif
__attribute__((noreturn)) void _exit(int);
static inline int port(int number);
static uint32_t registers[2], known[2];
static int logged, asked;
static inline int written(const char *name, int pin, int line) {
  printf("%s %d %d\n", name, pin, line);
  if (++logged >= 60) { fflush(stdout); _exit(0); }
  return 0;
}
static inline void compare(void) {
  for (int each = 0; each < 2; each++)
    for (int bit = 0; bit < 32; bit++)
      if ((registers[each] & ~known[each]) >> bit & 1) {
        known[each] |= 1UL << bit;
        written(each ? "OUTA" : "DIRA", port(bit), 0);
      }
}
static inline uint32_t *accessed(int each) { compare(); return &registers[each]; }
#define DIRA (*accessed(0))
#define OUTA (*accessed(1))
static inline int reached(const char *name, int pin, int line) { compare(); return written(name, pin, line); }
static inline int pause(int time) {
  (void)time;
  compare();
  if (++asked >= 200) { fflush(stdout); _exit(0); }
  return 0;
}
static inline int set_outputs(int end, int start, uint32_t bits) {
  for (int each = start; each <= end; each++) reached("set_outputs", port(each), 0);
  return bits;
}
"""
_FUNCTIONS = {
    "high": "", "low": "", "toggle": "", "input": "", "set_output": ", int a", "set_direction": ", int a", "pulse_out": ", int a",
    "freqout": ", int a, int b",
}  # fmt: skip
_PORTS = re.compile(r"^const uint8_t port_pins\[.*?\};|^inline int32_t port\(int32_t number\) \{.*?^\}", re.M | re.S)
_FLAGS = ("-w", "-O1", "-I.")
_CPP = ("-x", "c++", "-std=gnu++17", "-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics", "-nostdinc++")
_STRICT = ("-funsigned-char", "-fsanitize=undefined", "-fsanitize-undefined-trap-on-error", "-Werror=sequence-point")
_NO_PIN = "RS330"  # of a port that the program has and does not reach

Log = list[tuple[str, int, int]]
"""Function, pin and line of each call."""


class Comparison(NamedTuple):
    """What became of one program.

    Attributes:
        verdict: same, silent, told (it differs and is not ready), unsure (the same, and not ready), or why it was left out.
        why: the rules that it is not ready for, and the first difference.
    """

    verdict: str
    why: str = ""


def _stub(line: str) -> str:
    """The functions of pins, each of which writes a line; `line` is a first parameter, or nothing."""
    return "".join(
        f"static inline int {name}({line}int32_t pin{more}) "
        f'{{ reached("{name}", pin, {"line" if line else 0}); return logged * 7 % 5 & 1; }}\n'
        for name, more in _FUNCTIONS.items()
    )


@cache
def _machine() -> tuple[str, ...]:
    """The option for the source's 32 bits, where the compiler has that."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "empty.c").write_text("#include <stdio.h>\nint main(void) { return 0; }\n")
        done = subprocess.run(["gcc", "-m32", "empty.c"], cwd=folder, capture_output=True, check=False)
    return ("-m32",) if not done.returncode else ()


def _log(folder: Path, file: str, *flags: str) -> Log | None:
    """What a program writes; nothing if it cannot be compiled or ends by a signal."""
    made = folder / "program"
    built = subprocess.run(
        ["gcc", *_FLAGS, *_machine(), *flags, file, "-o", made], cwd=folder, capture_output=True, text=True, check=False
    )
    if built.returncode:
        (folder / "errors.txt").write_text(built.stderr)
        return None
    try:
        run = subprocess.run([made], capture_output=True, text=True, timeout=5, check=False)
    except subprocess.TimeoutExpired:
        return None
    lines = (line.split() for line in run.stdout.splitlines())
    return [(name, int(pin), int(line)) for name, pin, line in lines] if not run.returncode else None


def truth(source: Path) -> Log | None:
    """The ports that a program uses on this computer, in order; nothing if it has no meaning."""
    own = "static inline int port(int number) { return number; }\n"
    own += "__attribute__((destructor)) static void end(void) { compare(); }\n"
    lines = "".join(f"#define {name}(...) {name}(__LINE__, __VA_ARGS__)\n" for name in _FUNCTIONS)
    folder = source.parent / "truth"  # the migration takes the headers beside a program for its own
    folder.mkdir()
    (folder / "simpletools.h").write_text(_LOG + own + _stub("int line, ") + lines)
    (folder / source.name).write_text(source.read_text())
    return _log(folder, source.name, *(_CPP if source.suffix == ".cpp" else ("-std=gnu99",)), *_STRICT)


def sketch_log(sketch: Path, folder: Path) -> Log | None:
    """The pins that a sketch uses on this computer, in order; nothing if it cannot be compiled or ends by a signal."""
    ports = [found[0] for found in _PORTS.finditer((sketch / "adapters.h").read_text())]
    ports = ports if len(ports) == 2 else ["inline int port(int number) { return number + 1000; }"]
    analogue = "".join(f"static const uint8_t A{pin - 54} = {pin};\n" for pin in range(54, 70))
    folder.mkdir()
    (folder / "Arduino.h").write_text("#pragma once\n#include <stdint.h>\n#include <stddef.h>\n" + analogue)
    log = _LOG.replace("static inline int port(int number);", "\n".join(ports))
    (folder / "adapters.h").write_text(log + _stub(""))
    text = next(sketch.glob("*.ino")).read_text()
    end = "\nint main() { setup(); for (int pass = 0; pass < 300; pass++) { loop(); compare(); } }\n"
    (folder / "sketch.cpp").write_text(text + end)
    return _log(folder, "sketch.cpp", *_CPP, "-fpermissive", "-fsigned-char")


def compared(text: str, ending: str, folder: Path) -> Comparison:
    """Migrate a program and compare the sketch with it.

    Args:
        text: the program.
        ending: of its file.
        folder: an empty folder.
    """
    source = folder / f"program{ending}"
    source.write_text(text)
    wanted = truth(source)
    if not wanted or any(not 0 <= port < 28 for _, port, _ in wanted):
        return Comparison("without meaning")
    bind = {f"P{port}": _name(pin_of(port)) for _, port, _ in wanted}
    try:
        made = robosmi.migrate([source], folder / "out", target="mega", bind=bind)
    except RobosmiError as error:
        return Comparison("silent" if "is no port" in error.message else "refused", error.message)
    listed = {int(b.sourcePin) for b in made.models.plan.portBindings if b.sourcePin >= 0}
    rules = {finding.rule for finding in (*made.findings, *made.tasks()) if finding.severity >= Severity.warning} - {_NO_PIN}
    told = " ".join(sorted(rules))
    opened = _open_lines(made.findings)
    missing = [each for each in wanted if each[1] not in listed and opened is not None and each[2] and each[2] not in opened]
    if missing:
        return Comparison("silent", f"no list has the port of {missing[0]}")
    found = sketch_log(made.sketch, folder / "host")
    if found is None:
        return Comparison("told" if "RS504" in told else "not compiled", told)
    for (function, port, line), (there, pin, _) in zip(wanted, found, strict=False):
        if (function, pin_of(port)) != (there, pin):
            what = f"line {line}: {there}({pin}) instead of {function}({port} -> {pin_of(port)})"
            return Comparison("told" if told else "silent", f"{told} {what}")
    if len(wanted) != len(found):
        return Comparison("told" if told else "silent", f"{told} {len(found)} calls instead of {len(wanted)}")
    return Comparison("unsure" if told else "same" if opened == set() else "run time", told)


def _open_lines(findings: Sequence[Finding]) -> set[int] | None:
    """The lines whose ports are known only at run time; nothing if not all are named."""
    lines: set[int] = set()
    for finding in findings:
        if finding.rule == "RS327":
            named = re.search(r"\(lines? ([^)]*)\)", finding.message)
            if named is None or "more" in named[1]:
                return None
            numbers = {int(number) for number in re.findall(r"\d+", named[1])}
            lines |= numbers | {number + 1 for number in numbers}  # a macro and the function that uses it
    return lines


def _name(pin: int) -> str:
    return f"D{pin}" if pin < 54 else f"A{pin - 54}"


def pin_of(port: int) -> int:
    """The pin that a port is bound to: no port's number."""
    return 32 + (port * 11 + 5) % 32


def main() -> int:
    """The command line; 1 if a sketch differs silently."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path, help="folder for the programs to look at")
    arguments = parser.parse_args()
    counts: collections.Counter[str] = collections.Counter()
    rules: collections.Counter[str] = collections.Counter()
    for seed in range(arguments.seed, arguments.seed + arguments.cases):
        text, ending = program(seed)
        with tempfile.TemporaryDirectory() as folder:
            result = compared(text, ending, Path(folder))
        counts[result.verdict] += 1
        if not sum(counts.values()) % 50:
            print(dict(counts), flush=True)
        rules[result.why] += result.verdict == "unsure"
        if result.verdict in ("silent", "refused", "not compiled"):
            print(f"seed {seed}: {result.verdict}: {result.why}", flush=True)
            if arguments.keep is not None:
                (arguments.keep / f"p{seed}{ending}").write_text(text)
    print(", ".join(f"{count} {name}" for name, count in counts.most_common()))
    print("not ready, although the same: " + ", ".join(f"{count} {name}" for name, count in rules.most_common() if count))
    return int(bool(counts["silent"]))


if __name__ == "__main__":
    sys.exit(main())
