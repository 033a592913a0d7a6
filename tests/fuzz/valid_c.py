"""Valid C stays valid to us: random programs that GCC takes are read, stored, and moved, and nothing of them is lost.

Usage: python -m tests.fuzz.valid_c [--programs N] [--seed N] [--only-read]. By hand (`make fuzz`); the test run has a few
(`tests/transformations/t2m/c_source/test_valid_c.py`). The judge is `gcc -m32 -std=gnu99 -fsyntax-only`, which needs Debian's
gcc-multilib. A program that is refused, crashes, takes too long, loses a function, global, macro or comment, or whose model
changes on its way through XMI is kept beside the reason.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import re
import subprocess
import sys
import tempfile
import traceback
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from tests.fuzz.c_programs import Program, program
from tests.fuzz.costs import Costs, TooLong

JUDGE = ("gcc", "-m32", "-std=gnu99", "-fsyntax-only", "-w")
_INDENTATION = re.compile(r"\n[ \t]+")  # which a comment of several lines in main may change


def judge_is_there() -> bool:
    """Whether GCC is installed and compiles for 32 bits."""
    with tempfile.TemporaryDirectory() as scratch:
        path = Path(scratch) / "a.c"
        path.write_text("#include <stddef.h>\nint main(void) { return 0; }\n")
        with contextlib.suppress(OSError):
            return subprocess.run([*JUDGE, path], capture_output=True, check=False).returncode == 0
    return False


def accepted(path: Path) -> bool:
    """Whether GCC takes a program."""
    return subprocess.run([*JUDGE, path], capture_output=True, check=False).returncode == 0


def faults(made: Program, path: Path, *, move: bool = True) -> list[str]:
    """What is lost of a program that GCC took.

    Args:
        made: the program.
        path: the file it lies in. Its folder takes the model and the output.
        move: whether to move it to the target as well.

    Raises:
        Exception: it is refused, or crashes.
    """
    import robosmi
    from robosmi.metamodels import ccode
    from robosmi.model import load_model, save_model
    from robosmi.model.xmi.xmi_writer import to_xmi
    from robosmi.transformations.t2m.c_source import read_program

    model, _ = read_program(path)
    unit = model.units[0]
    found = [
        *_missing(
            "functions",
            made.functions,
            (d.name for d in unit.declarations if isinstance(d, ccode.Function) and d.body is not None),
        ),
        *_missing("globals", made.globals, (d.name for d in unit.declarations if isinstance(d, ccode.Variable))),
        *_missing("macros", made.macros, (m.name for m in unit.macros)),
    ]
    if made.comments is not None and [c.text for c in unit.comments] != made.comments:
        found.append(f"comments are {[c.text for c in unit.comments]}, not {made.comments}")
    if int(unit.callsInText) != int(unit.callsInModel) + len(unit.unresolved):
        found.append(f"{unit.callsInText} calls in the text, {unit.callsInModel} in the model, {len(unit.unresolved)} unresolved")
    stored = path.with_suffix(".xmi")
    save_model(model, stored)
    if to_xmi({stored.name: load_model(stored)})[stored.name] != stored.read_bytes():
        found.append("the model changes on its way through XMI")
    if move and "main" in made.functions:  # what has no main is analysed, and moved together with what has one
        output = path.with_name("out")
        with contextlib.redirect_stderr(io.StringIO()):
            robosmi.migrate([path], output)
        sketch = "\n".join(
            p.read_bytes().decode() for p in sorted((output / path.stem).rglob("*")) if p.suffix in (".ino", ".h", ".cpp", ".c")
        )
        joined = sketch.replace("\\\r\n", "").replace("\\\n", "")
        found += [
            f"the function {name} is not in the sketch"
            for name in made.functions
            if name != "main" and not re.search(rf"\b{name}\s*\(", joined)
        ]
        plain = _INDENTATION.sub("\n", sketch)
        found += [
            f"the comment {text!r} is not in the sketch"
            for text in made.comments or ()
            if _INDENTATION.sub("\n", text) not in plain
        ]
    return found


def _missing(what: str, wanted: list[str], there: Iterable[str]) -> list[str]:
    lost = sorted((Counter(wanted) - Counter(there)).elements())
    return [f"{what} lost: {', '.join(lost)}"] if lost else []


def check(made: Program, *, move: bool = True, costs: Costs | None = None) -> str:
    """The result for a program: "not C" if GCC refuses it, "kept" if all is well, else what is wrong."""
    with tempfile.TemporaryDirectory() as scratch:
        path = Path(scratch) / "input.c"
        path.write_bytes(made.text)
        if not accepted(path):
            return "not C"
        try:
            with (costs or Costs()).input():
                found = faults(made, path, move=move)
        except (Exception, TooLong):
            return traceback.format_exc()
        return "\n".join(found) or "kept"


def main() -> int:
    """The command line; the exit code is 1 when anything was lost."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--programs", type=int, default=5_000)
    parser.add_argument("--seed", type=int, default=1, help="of the first program")
    parser.add_argument("--only-read", action="store_true", help="do not move them, which takes most of the time")
    parser.add_argument("--keep", type=Path, default=Path("out") / "fuzz", help="where programs with a fault are kept")
    arguments = parser.parse_args()
    if not judge_is_there():
        print("valid C: not run: gcc with 32 bits is missing (Debian: gcc-multilib)", file=sys.stderr)
        return 1
    states, costs = Counter[str](), Costs()
    for seed in range(arguments.seed, arguments.seed + arguments.programs):
        made = program(seed)
        said = check(made, move=not arguments.only_read, costs=costs)
        states[said if said in ("kept", "not C") else "failed"] += 1
        if said not in ("kept", "not C"):
            arguments.keep.mkdir(parents=True, exist_ok=True)
            (arguments.keep / f"valid-{seed}.c").write_bytes(made.text)
            (arguments.keep / f"valid-{seed}.txt").write_text(said, encoding="utf-8", errors="backslashreplace")
            print(f"{seed}: {said.strip().splitlines()[-1][:200]}", file=sys.stderr)
    print(f"valid C: {states.total()} programs: {dict(states)}; {costs}")
    return int(states["failed"] > 0 or costs.over())


if __name__ == "__main__":
    sys.exit(main())
