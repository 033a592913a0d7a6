"""Faults put into migrated programs, and how many of them `verify` notices: `python -m tests.cli.verification_mutants`.

For each case study the program is migrated, and verified; then one seeded fault at a time is put into the sketch or its adapters
(a constant, a comparison, a level, a pin, a width, a call or statement left out), and it is compared under the stored scenarios.
Faults that do not compile do not count. What was noticed and what was not is kept in `verification_mutants.json` with the places
of the survivors, so that equivalent ones can be listed by hand. A hundred faults take some ten minutes; tests have a few.
"""

from __future__ import annotations

import json
import random
import re
import shutil
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import robosmi
from robosmi.transformations.chains.models import load_models
from robosmi.transformations.chains.verify import FOLDER, Case, _original, _Target, verify
from robosmi.transformations.verification.judging import judged
from robosmi.transformations.verification.original_side import run_source, run_varied
from robosmi.transformations.verification.port_devices import bound_ports
from robosmi.verify.scenario import read_scenario
from robosmi.verify.toolchain import compile_sketch

ROOT = Path(__file__).resolve().parents[2]
KEPT = Path(__file__).with_suffix(".json")
STUDIES = ("line_follower", "environmental_monitoring")
_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\])*\"|#[^\n]*", re.DOTALL)


@dataclass(frozen=True)
class Fault:
    """A change of one place of one file."""

    file: str
    begin: int
    end: int
    text: str
    kind: str


_NUMBER = re.compile(r"(?<![\w.])\d+(?:L|U|UL)?(?![\w.])")
_SWAPS = {
    "comparison": {"<": ">=", ">": "<=", "==": "!=", "!=": "==", "<=": ">", ">=": "<"},
    "logic": {"&&": "||", "||": "&&"},
    "level": {"HIGH": "LOW", "LOW": "HIGH", "high(": "low(", "low(": "high("},
    "sign": {" + ": " - ", " - ": " + "},
    "scale": {" * ": " / ", " / ": " * "},
    "width": {"int32_t": "int16_t", "uint32_t": "uint16_t"},
    "unit": {"delay(": "delayMicroseconds(", "delayMicroseconds(": "delay(", "millis()": "micros()"},
}


def faults(folder: Path, files: list[Path]) -> Iterator[Fault]:
    """All faults of the files."""
    for file in files:
        text = file.read_text()
        code = _COMMENT.sub(lambda found: " " * len(found[0]), text)
        name = file.relative_to(folder).as_posix()
        for found in _NUMBER.finditer(code):
            number = re.sub(r"\D", "", found[0])
            suffix = found[0][len(number) :]
            value = int(number)
            changed = value * 2 + 1 if value < 10 else round(value * 1.2)
            yield Fault(name, found.start(), found.end(), f"{changed}{suffix}", "constant")
        for kind, swaps in _SWAPS.items():
            for old, new in swaps.items():
                for at in (m.start() for m in re.finditer(rf"(?<![\w<>=!&|+\-]){re.escape(old)}(?![<>=&|+])", code)):
                    yield Fault(name, at, at + len(old), new, kind)
        for found in re.finditer(r"^[ \t]+\w[\w.]*\([^;{}]*\);|^[ \t]+\w+(?:\+\+|--| [-+*/|&]?= [^;{}]*);", code, re.MULTILINE):
            yield Fault(name, found.start(), found.end(), "", "left out")


def study(name: str, wanted: int, seed: int) -> dict[str, object]:
    """The faults of one case study, and which of them were noticed."""
    with tempfile.TemporaryDirectory() as place:
        work = Path(place)
        shutil.copytree(ROOT / "docs" / "examples" / name, work / "input")
        out = work / "out"
        robosmi.migrate([work / "input" / f"{name}.c"], out, history=str(work / "history.sqlite"))
        right = verify(out).verdict
        print(name, right.sentence(), flush=True)
        models = load_models(out / "models" / "plan.xmi")
        ports = bound_ports(models.plan)
        (work / "source").mkdir()
        program = _original(models, out / "models", work / "source")
        cases: list[Case] = []
        for path in sorted((out / "models" / FOLDER).glob("*.toml")):
            scenario = read_scenario(path, "stored")
            cases.append((scenario, run_varied(program, ports, scenario, run_source(program, ports, scenario))))
        sketch = out / name
        chance = random.Random(seed)
        listed = list(faults(sketch, [sketch / f"{name}.ino", sketch / "adapters.h"]))
        chance.shuffle(listed)
        survivors, noticed, tried, kinds = [], 0, 0, {}  # type: list[dict[str, str]], int, int, dict[str, list[int]]
        for fault in listed:
            if tried == wanted:
                break
            file = sketch / fault.file
            text = file.read_text()
            file.write_text(text[: fault.begin] + fault.text + text[fault.end :])
            try:
                with tempfile.TemporaryDirectory() as built:
                    report = compile_sketch(out, keep=Path(built))
                    if not report.ok:
                        continue
                    side = _Target(models, report, ports, None)
                    verdicts = []
                    for scenario, runs in cases:
                        (trace,) = side.run([scenario])
                        verdicts.append(judged(scenario, runs, trace, ports).verdict)
                        if verdicts[-1] == "different":
                            break
            except robosmi_errors() as error:
                verdicts = [f"error: {error}"]
            finally:
                file.write_text(text)
            tried += 1
            seen = any(v == "different" or v.startswith("error") for v in verdicts)
            noticed += seen
            kinds.setdefault(fault.kind, []).append(int(seen))
            if not seen:
                line = text.count("\n", 0, fault.begin) + 1
                old = text[fault.begin : fault.end].strip()
                survivors.append({"place": f"{fault.file}:{line}", "was": old, "is": fault.text, "kind": fault.kind})
            print(f"{name} {tried}: {'noticed' if seen else 'SURVIVES'} {fault.kind} {fault.file} {fault.text!r}", flush=True)
        return {
            "verdict": right.sentence(), "faults": tried, "noticed": noticed,
            "by_kind": {kind: f"{sum(n)} of {len(n)}" for kind, n in sorted(kinds.items())}, "survivors": survivors,
        }  # fmt: skip


def robosmi_errors() -> type[Exception]:
    """What a fault may end in, such as a simulator that crashes: it is noticed."""
    from robosmi.errors import RobosmiError

    return RobosmiError


def main() -> None:
    """Run all case studies: `verification_mutants [COUNT] [SEED] [NAME...]`."""
    wanted = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    kept = json.loads(KEPT.read_text()) if KEPT.is_file() else {}
    for name in sys.argv[3:] or STUDIES:
        kept[name] = study(name, wanted, seed)
        KEPT.write_text(json.dumps(kept, indent=1) + "\n")


if __name__ == "__main__":
    main()
