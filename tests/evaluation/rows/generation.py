"""Rows D to F: the generated program, the work that is left, its size and its cost (paper 3.4, 5.3)."""

from __future__ import annotations

import re
import statistics
import time
from collections import Counter
from contextlib import suppress

import robosmi
from robosmi.api import MigratedSketch
from robosmi.errors import SourceError
from robosmi.metamodels import migration
from robosmi.plugins import content
from tests.adapters.cost import BOUND, costs
from tests.corpus.migrate_corpus import programs
from tests.evaluation.studies import PROGRAMS, STUDIES, migrated, text_of
from tests.evaluation.table import DIFFERS, EXCEEDED, Got, Missing, Setting, row

TODO = "TODO: complete method"
PAPER_GROWTH, POINTS = 1.40, 0.15
STEPS, COLOURED = {"code", "hardware", "libraries", "generation"}, {"code", "hardware", "libraries"}
"""The steps by which the paper colours Listing 3."""
EXAMPLES = {"high": "oneToOne", "freqout": "oneToMany", "dht22_getHumidity": "manyToOne", "drive_speed": "semantic"}
"""The paper's own examples of correspondence (5.3, RQ2)."""


@row(
    "D1",
    "RQ1",
    "Listing 3 in the paper's own mode",
    "3.4, Listing 3",
    "8 TODO bodies, 5 port constants, setup and loop, selected includes",
    "Listing 1 with --adapters placeholders",
)
def listing_3(_: Setting) -> Got:
    made = migrated("Listing 1", "placeholders")
    text, adapters = text_of(made, ".ino"), text_of(made, "adapters.h")
    bodies, ports = adapters.count(TODO), len(re.findall(r"^const int \w+P\d+ = \d+;", text, re.MULTILINE))
    begins = all(f"void {name}()" in text for name in ("setup", "loop"))
    servo = "#include <Servo.h>" in text and "Servo" in text_of(made, "sketch.yaml")
    shown = f"{bodies} TODO bodies, {ports} port constants, {'' if begins else 'no '}setup and loop"
    shown += f", Servo.h {'included' if servo else 'missing'}"
    return Got(shown, (bodies, ports, begins, servo) == (8, 5, True, True))


@row(
    "D2",
    "RQ1",
    "colours say which step a generated line comes from",
    "Listing 3",
    "three colours: the program, the drawing, the libraries; none for the template",
    "the report of Listing 1 in placeholder mode",
)
def steps(_: Setting) -> Got:
    document = str(content("chain", "page")(migrated("Listing 1", "placeholders").output, None).document(live=False, nonce=""))
    lines = Counter(re.findall(r'data-why="[^"]*\((code|hardware|libraries|generation)\)"', document))
    coloured = set(re.findall(r'\[data-why\$="\((\w+)\)"\]', document))
    shown = ", ".join(f"{count} {name}" for name, count in sorted(lines.items()))
    return Got(f"lines: {shown}; with a colour: {', '.join(sorted(coloured))}", lines.keys() == STEPS and coloured == COLOURED)


@row(
    "D3",
    "RQ1",
    "the generated code is fully compilable",
    "3",
    "both case studies and Listing 1, placeholders and filled",
    "compile (avr-gcc)",
    quick=False,
)
def compiles(_: Setting) -> Got:
    said = {
        (name, how): robosmi.compile_sketch(migrated(name, how).output) for name in PROGRAMS for how in ("placeholders", "filled")
    }
    failed = [f"{name}, {how}" for (name, how), report in said.items() if not report.ok]
    return Got(f"{len(said) - len(failed)} of {len(said)}" + (f"; not {failed}" if failed else ""), not failed)


@row(
    "D4",
    "RQ1",
    "constants of Listing 3",
    "3.4, Listing 3",
    "leftQTI = 10, QTI_T = 100",
    "Listing 1 in placeholder mode",
    verdict=DIFFERS,
    reason="leftQTI is bound to the port constant, which is 10; the source has QTI_T = 50, which Listing 3 changes",
)
def constants(_: Setting) -> Got:
    text = text_of(migrated("Listing 1", "placeholders"), ".ino")
    found = {name: re.search(rf"{name}\s*=\s*(\w+)", text) for name in ("leftQTI", "HIH40302ReadP1", "QTI_T")}
    values = {name: match[1] if match else "" for name, match in found.items()}
    shown = ", ".join(f"{name} = {value}" for name, value in values.items())
    return Got(shown, values == {"leftQTI": "HIH40302ReadP1", "HIH40302ReadP1": "10", "QTI_T": "50"})


def _kinds(study: str) -> dict[str, str]:
    uses = migrated(study).models.plan.adapterUses
    return {str(use.name): str(use.adapter.adapterKind.name) for use in uses if use.adapter is not None}


@row(
    "E1",
    "RQ2",
    "correspondence one-to-one, one-to-many, many-to-one, semantic",
    "5.3, RQ2",
    "high 1:1, freqout 1:n, humidity n:1, drive_speed semantic",
    "kinds of the adapters of both case studies",
    tolerance="freqout and drive_speed",
    verdict=DIFFERS,
    reason="high also sets the direction, as the original does (1:n); dht22_read keeps the reading, and the getters are 1:1",
)
def correspondence(_: Setting) -> Got:
    kinds = _kinds("line follower") | _kinds("monitoring")
    same = {name for name, kind in EXAMPLES.items() if kinds.get(name) == kind}
    return Got(", ".join(f"{name} {kinds.get(name)}" for name in EXAMPLES), same >= {"freqout", "drive_speed"})


@row(
    "E2",
    "RQ2",
    "the manual code that remains",
    "5.3, RQ2",
    "the paper leaves every body to a person",
    "TODO bodies, and bodies to write with the built-in adapters",
    verdict=EXCEEDED,
)
def work_left(_: Setting) -> Got:
    empty = [text_of(migrated(study, "placeholders"), "adapters.h").count(TODO) for study in STUDIES]
    todo = [
        sum(use.status is migration.AdapterStatus.todo for use in migrated(study).models.plan.adapterUses) for study in STUDIES
    ]
    return Got(
        f"{empty[0]} and {empty[1]} in the paper's mode; {todo[0]} and {todo[1]} with the built-in adapters",
        todo == [0, 0] and min(empty) > 0,
    )


@row(
    "E3",
    "RQ2",
    "the migrated applications are functionally equivalent",
    "5.3, RQ2",
    "no difference found, >= 95 % of the branches",
    "verify of both case studies: original on this machine, sketch on a simulator",
    verdict=EXCEEDED,
    quick=False,
)
def equivalent(_: Setting) -> Got:
    said = []
    for study in STUDIES:
        found = content("chain", "verify")(migrated(study).output)
        coverage = found.result["source_coverage"]
        said.append((found.result["verdict"], len(found.result["scenarios"]), coverage["branches_pct"]))
    text = "; ".join(f"{study}: {v} in {n} scenarios, branches {b:.0f} %" for study, (v, n, b) in zip(STUDIES, said, strict=True))
    return Got(text, all(v == "no-difference-found" and b >= 95 for v, _n, b in said))


def _growth(study: str, adapters: str, made: MigratedSketch) -> tuple[float, float]:
    source = len(PROGRAMS[study].read_bytes())
    main = len(text_of(made, ".ino").encode())
    return main / source, (main + len(text_of(made, "adapters.h").encode())) / source


@row(
    "F1",
    "RQ3",
    "the generated program is 40 % larger",
    "5.3, RQ3",
    "+40 % on average",
    "bytes of the sketch without bodies over the source's; with adapters.h in brackets",
    tolerance="15 points for the sketch",
)
def generated_size(_: Setting) -> Got:
    sizes = [_growth(study, "placeholders", migrated(study, "placeholders")) for study in STUDIES]
    mean = sum(size for size, _whole in sizes) / len(sizes)
    text = "; ".join(f"{study} {size - 1:+.0%} ({whole - 1:+.0%})" for study, (size, whole) in zip(STUDIES, sizes, strict=True))
    return Got(f"{mean - 1:+.0%} on average: {text}", abs(mean - PAPER_GROWTH) <= POINTS)


@row(
    "F2",
    "RQ3",
    "the completed program is 90 % larger",
    "5.3, RQ3",
    "+90 %",
    "bytes of the sketch with adapters.h over the source's",
    tolerance="reported",
    verdict=DIFFERS,
    reason="adapters.h has the bodies of the original's libraries, which nobody has to write: servos in the background, widths",
)
def completed_size(_: Setting) -> Got:
    sizes = [_growth(study, "filled", migrated(study)) for study in STUDIES]
    return Got(
        "; ".join(f"{study}: sketch x {s:.1f}, with adapters.h x {w:.1f}" for study, (s, w) in zip(STUDIES, sizes, strict=True)),
        all(w < 20 for _s, w in sizes),
    )


def _lines(text: str, *, code: bool) -> int:
    """Lines, or those that are neither empty nor of comments alone."""
    if code:
        text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    return sum(not code or bool(re.sub(r"//.*", "", line).strip()) for line in text.splitlines())


@row(
    "F3",
    "RQ3",
    "the generated program has at most 3L lines",
    "5.3, RQ3",
    "<= 3",
    "lines of the sketch with placeholders over the source's; with adapters.h in brackets",
    tolerance="the sketch alone",
)
def bound(_: Setting) -> Got:
    said, ratios = [], []
    for name, path in PROGRAMS.items():
        raw, full, code = _times(migrated(name, "placeholders"), path.read_text())
        said.append(f"{name} {raw:.2f} ({full:.2f}, code lines {code:.2f})")
        ratios.append(raw)
    return Got("; ".join(said), max(ratios) <= 3)


def _times(made: MigratedSketch, source: str) -> tuple[float, float, float]:
    """How many times the source's lines a sketch has: its main file; with adapters.h; with it, in lines of code."""
    main = text_of(made, ".ino")
    whole = main + text_of(made, "adapters.h")
    raw, full, code = (_lines(t, code=c) / _lines(source, code=c) for t, c in ((main, False), (whole, False), (whole, True)))
    return raw, full, code


@row(
    "F3c",
    "RQ3",
    "real programs: the generated program has at most 3L lines",
    "5.3, RQ3",
    "<= 3",
    "all programs of one file of the corpus, with placeholders: sketch; with adapters.h; both in lines of code",
    tolerance="the sketch alone, in all",
    quick=False,
)
def bound_in_corpus(setting: Setting) -> Got:
    found: list[tuple[float, float, float]] = []
    for files in programs(setting.corpus):
        if len(files) > 1:
            continue
        with suppress(SourceError):
            made = robosmi.migrate(files, setting.scratch / f"lines{len(found)}", adapters="placeholders")
            found.append(_times(made, files[0].read_text(errors="replace")))
    if not found:
        raise Missing(f"'{setting.corpus}' has no program of one file", "run: make corpus")
    within = [f"{sum(r <= 3 for r in ratios)} (at most {max(ratios):.2f})" for ratios in zip(*found, strict=True)]
    return Got(
        f"of {len(found)} programs {within[0]}; with adapters.h {within[1]}; lines of code {within[2]}", max(found)[0] <= 3
    )


@row(
    "F4",
    "RQ3",
    "the cost of the adapters' calls is negligible",
    "5.3, RQ3",
    "at most 1.2 times the plain Arduino call where the pin is known",
    "cycles on the simulated Uno: most used functions of the utility libraries, and those of one pin (tests/adapters/cost.py)",
    quick=False,
)
def call_cost(_: Setting) -> Got:
    ratios = {name: each.ratio for name, each in costs().items()}
    most = max(ratios, key=lambda name: ratios[name])
    return Got(
        f"{len(ratios)} calls: median {statistics.median(ratios.values()):.2f} times, at most {ratios[most]:.2f} ({most})",
        ratios[most] <= BOUND,
    )


@row(
    "F5",
    "RQ3",
    "the time of the tool",
    "extension",
    "a warm migration of the line follower below 1 s",
    "time of the processor, best of 3",
    verdict=EXCEEDED,
    quick=False,
)
def tool_time(setting: Setting) -> Got:
    times = []
    for number in range(3):
        start = time.process_time()
        robosmi.migrate([PROGRAMS["line follower"]], setting.scratch / f"timed{number}")
        times.append(time.process_time() - start)
    return Got(f"{min(times) * 1000:.0f} ms", min(times) < 1)
