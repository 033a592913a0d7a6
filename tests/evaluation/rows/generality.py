"""Rows G to I: other languages and programs (paper 5.3, RQ4), extensions, and what nobody can reproduce."""

from __future__ import annotations

import json
import random
from collections import Counter
from functools import cache
from pathlib import Path

import robosmi
from robosmi.errors import RobosmiError, SourceError
from robosmi.metamodels import migration
from robosmi.plugins import content
from robosmi.transformations.m2t.first_screen import written
from robosmi.transformations.queries.plans.port_pins import PIN_RULE
from robosmi.transformations.queries.reports.work import Work
from tests.corpus.migrate_corpus import programs
from tests.corpus.test_pin_tables import TABLES, meant
from tests.evaluation.sources import ROOT
from tests.evaluation.studies import EXAMPLES, migrated
from tests.evaluation.table import EXCEEDED, Got, Missing, Setting, never, row

CPLUSPLUS = ROOT / "tests" / "chains" / "cpp_pins"
SAMPLE = 30


@row(
    "G1",
    "RQ4",
    "migration from C to C",
    "5.3, RQ4",
    "Listing 1 and the line follower on avr-c compile, every call with a body",
    "migrate --target avr-c, compile (avr-gcc)",
    quick=False,
)
def c_to_c(_: Setting) -> Got:
    said, right = [], True
    for name in ("Listing 1", "line follower"):
        made = migrated(name, target="avr-c")
        total, bodies = _calls(made.models.plan)
        ok = robosmi.compile_sketch(made.output).ok
        said.append(f"{name}: {bodies} of {total} calls, {'compiles' if ok else 'does not compile'}")
        right = right and ok and bodies == total
    return Got("; ".join(said), right)


def _calls(plan: migration.MigrationPlan) -> tuple[int, int]:
    """The calls of functions of the platform, and those with a body."""
    return sum(len(u.calls) for u in plan.adapterUses), sum(len(u.calls) for u in plan.adapterUses if u.adapter is not None)


@row(
    "G2",
    "RQ4",
    "migration from C to C for real programs",
    "5.3, RQ4",
    ">= .9 of the calls that a plain AVR can serve have a body",
    f"{SAMPLE} programs of the corpus drawn by seed 1, --target avr-c; not served: badge, Wi-Fi, speech, displays",
    quick=False,
)
def real_c_to_c(setting: Setting) -> Got:
    chosen = random.Random(1).sample(programs(setting.corpus), SAMPLE)
    return _bodies(chosen, "avr-c", 0.9)


@row(
    "G3",
    "RQ4",
    "migration from C to C++ for real programs",
    "5.3, RQ4",
    ">= .98 of the calls that the target can serve have a body",
    "all programs of the corpus, without a drawing",
    verdict=EXCEEDED,
    quick=False,
)
def real_c_to_cplusplus(setting: Setting) -> Got:
    return _bodies(programs(setting.corpus), "uno", 0.98)


def _bodies(chosen: list[tuple[Path, ...]], target: str, least: float) -> Got:
    made = [plan for files in chosen if (plan := _planned(files, target)) is not None]
    uses = [use for plan in made for use in plan.adapterUses if use.function is not None]
    served = [use for use in uses if use.status is not migration.AdapterStatus.unsupported]
    calls, bodies = (sum(len(u.calls) for u in them) for them in (served, [u for u in served if u.adapter is not None]))
    share = bodies / calls if calls else 0.0
    return Got(f"{bodies} of {calls} calls in {len(made)} of {len(chosen)} programs: {share:.3f}", share >= least)


@cache
def _planned(files: tuple[Path, ...], target: str) -> migration.MigrationPlan | None:
    """The plan of a program; None if it is none."""
    try:
        return robosmi.plan_migration(list(files), target=target).plan
    except RobosmiError:
        return None


@row(
    "G4",
    "RQ4",
    "migration from C++ to C++",
    "5.3, RQ4",
    "0 programs in which a pin is silently wrong",
    "50 C++ programs that give a pin to constructors, methods, lambdas ...; each sketch on the simulator, or a finding",
    verdict=EXCEEDED,
    quick=False,
)
def cplusplus(setting: Setting) -> Got:
    moved, told, silent = 0, 0, []
    for case in sorted(CPLUSPLUS.iterdir()):
        files = sorted(case.glob("*.cpp")) if case.is_dir() else [case]
        out = setting.scratch / case.name
        made = robosmi.migrate(files, out, bind={"P8": "D12"})
        events = content("chain", "simulate")(out, seconds=1).result["events"]
        if {event["pin"] for event in events if event.get("level") == 1} - {"D0", "D1"} == {"D12"}:
            moved += 1
        elif any(f.rule in (PIN_RULE, "RS326", "RS327") for f in made.models.plan.findings):
            told += 1
        else:
            silent.append(case.name)
    shown = f": {', '.join(silent)}" if silent else ""
    return Got(f"{moved} drive the target's pin, {told} have a finding, {len(silent)} are silent{shown}", not silent)


@row("G5", "RQ4", "migration from C++ to C is left to a person", "5.3, RQ4", "refused with the reason", "a C++ program to avr-c")
def cplusplus_to_c(setting: Setting) -> Got:
    try:
        robosmi.migrate([CPLUSPLUS / "method.cpp"], setting.scratch / "refused", target="avr-c")
    except SourceError as error:
        return Got(f"refused: {str(error).splitlines()[0].rpartition(': ')[2]}", "takes C alone" in str(error))
    return Got("migrated", within=False)


@row(
    "G6",
    "RQ4",
    "other models and metamodels than robots",
    "5.3, RQ4",
    "a library's catalogue becomes a website",
    "the chain of docs/examples/library_catalogue",
    verdict=EXCEEDED,
)
def other_domain(setting: Setting) -> Got:
    import shutil

    from robosmi.chain import read_chain

    folder = setting.scratch / "catalogue"
    shutil.copytree(EXAMPLES / "library_catalogue", folder, ignore=shutil.ignore_patterns("build", "out", ".robosmi"))
    done = read_chain(folder / "chain.toml").run()
    pages = sorted((folder / "out").rglob("*.html"))
    return Got(f"{len(done.steps)} steps, {len(pages)} pages", bool(pages))


@row(
    "H1",
    "RQ2",
    "real programs: verdict on every element, calls with a body",
    "extension",
    "188 of 310 programs with every adapter complete, .98 of the servable calls with a body",
    "all programs of the corpus, without a drawing",
    tolerance="half of the programs",
    verdict=EXCEEDED,
    quick=False,
)
def real_programs(setting: Setting) -> Got:
    listed = programs(setting.corpus)
    plans = [plan for files in listed if (plan := _planned(files, "uno")) is not None]
    actions = Counter(str(d.action.name) for plan in plans for d in plan.dispositions)
    done = (migration.AdapterStatus.filled, migration.AdapterStatus.care)
    complete = sum(all(use.status in done for use in plan.adapterUses) for plan in plans)
    shares = ", ".join(f"{name} {count / actions.total():.1%}" for name, count in actions.most_common())
    return Got(f"{complete} of {len(listed)} programs complete; {shares}", complete >= 0.5 * len(listed))


@row(
    "H2",
    "RQ2",
    "real programs with hardware",
    "extension",
    ".69 of the calls work, nothing to write in 47 of 60",
    "60 pin tables for programs of the corpus",
    tolerance=".65, 45",
    verdict=EXCEEDED,
    quick=False,
)
def with_hardware(setting: Setting) -> Got:
    total, working, nothing, ran = 0, 0, 0, 0
    for table in TABLES:
        program = setting.corpus / meant(table)[0]
        if program.is_file():
            work = Work(robosmi.plan_migration([program], hardware=table).plan)
            ran += 1
            total += work.calls["total"]
            working += work.working
            nothing += written(work) == "nothing"
    if not ran:
        raise Missing(f"'{setting.corpus}' has none of the tables' programs", "run: make corpus")
    return Got(
        f"{working} of {total} calls work, nothing to write in {nothing} of {ran}",
        working >= 0.65 * total and nothing >= 0.75 * ran,
    )


@row(
    "H3",
    "RQ2",
    "sketches of real programs compile",
    "3",
    ">= .97 of the programs",
    "all programs of the corpus, compile (avr-gcc)",
    tolerance=".95",
    verdict=EXCEEDED,
    quick=False,
)
def real_programs_compile(setting: Setting) -> Got:
    compiled, tried = 0, 0
    for number, files in enumerate(programs(setting.corpus)):
        if _planned(files, "uno") is not None:
            out = setting.scratch / f"compiled{number}"
            robosmi.migrate(list(files), out)
            tried += 1
            compiled += robosmi.compile_sketch(out).ok
    return Got(f"{compiled} of {tried}", compiled >= 0.95 * tried)


@row(
    "H4",
    "RQ2",
    "real programs behave like their originals",
    "extension",
    "no verdict 'different' without its cause",
    "kept verdicts (docs/method/verified-programs.md; hours: python -m tests.corpus.verify_corpus --budget 8)",
    verdict=EXCEEDED,
)
def real_programs_verified(_: Setting) -> Got:
    table = (ROOT / "docs" / "method" / "verified-programs.md").read_text()
    uno = table.partition("\n## ")[0]  # further sections are about other boards
    rows = [[cell.strip() for cell in line.split(" | ")] for line in uno.splitlines() if ".c | " in line]
    verdicts = Counter(cells[1] for cells in rows)
    untold = [cells[0] for cells in rows if cells[1] == "different" and not cells[-1].rstrip(" |")]
    return Got(", ".join(f"{count} {name}" for name, count in verdicts.most_common()), bool(rows) and not untold)


@row(
    "H5",
    "RQ2",
    "verify notices faults",
    "extension",
    ">= .95 of the planted faults",
    "kept results of tests/faults/kept (make faults measures them again: hours)",
    verdict=EXCEEDED,
)
def faults_noticed(_: Setting) -> Got:
    kept = {p.stem: json.loads(p.read_text()) for p in sorted((ROOT / "tests" / "faults" / "kept").glob("*.json"))}
    return Got(
        "; ".join(f"{name} {k['noticed']} of {k['faults_that_count']}" for name, k in kept.items()),
        all(k["noticed"] >= 0.95 * k["faults_that_count"] for k in kept.values()),
    )


never(
    "I1",
    "programs, sketches and sizes of the paper's case studies",
    "5.2",
    "they are not in the text; ours are re-creations from its figures, Listing 1 and prose",
)
never("I2", "ranks among the authors' 247 libraries", "5.3", "the collection is not published")
never(
    "I3", "no perceptible difference on real robots", "5.3, RQ3", "nobody has the robots here; E3 compares simulated pins instead"
)
never("I4", "results of the original Eclipse plug-in", "4", "its repository could not be fetched")
