"""What a corpus run costs beside the analyses that it is made of, and what its page costs.

The programs are those of `c_source`, repeated, each with a line of its own: PROGRAMS of them are analysed. Ratios are to analyses
and bare parses of every SAMPLE-th of the same programs in one process, in the same minute. What the first START programs take,
with the start of the workers, counts once; each further program takes the mean of those after START. So is the time of MANY
analyses computed: that a program costs the same early and late is a figure of its own. Ratios by the clock show what else the
machine does, the ratio of processor times does not. Memory is that of the run's own process from program START on.

MANY programs stand for a large corpus where nothing is analysed: their rows are copies of analysed ones, which the run itself
stores. The second run, the page and the browser are measured on them.
"""

from __future__ import annotations

import gc
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Generator, Iterator, Sequence
from datetime import datetime
from pathlib import Path
from typing import NamedTuple

from msgspec.structs import replace

from robosmi.corpus.backends import backend_of
from robosmi.corpus.digests import digest_of
from robosmi.corpus.jobs import ProgramJob, ProgramResult, ProgramWork
from robosmi.corpus.memory import descendants, resident
from robosmi.corpus.running import CorpusRun
from robosmi.corpus.settings import cores, options_of
from robosmi.corpus.spec import read_spec
from robosmi.corpus.store import Store
from robosmi.plugins import content
from tests.bench import c_source
from tests.bench.figures import Figure, not_measured

PROGRAMS, MANY, SAMPLE = 1000, 10_000, 4
START = PROGRAMS // 5
"""The program from which on the memory of the run is looked at."""
MB = 1 << 20
FILTER = """
const done = arguments[0], words = document.getElementById("words"), start = performance.now();
words.value = "pause";
words.dispatchEvent(new Event("input"));
requestAnimationFrame(() => setTimeout(() => done(performance.now() - start)));
"""
LOADED = "const t = performance.getEntriesByType('navigation')[0]; return t.domComplete - t.startTime"


def figures() -> Iterator[Figure]:
    """Times, memory and ratios of corpus runs."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.environ["ROBOSMI_HOME"] = str(folder / "home")
        spec = written(folder / "some", PROGRAMS)
        yield from pool(spec, folder / "pool")
        yield from cluster(spec, folder)
        many = written(folder / "many", MANY)
        copied(many, folder / "large")
        yield from second_run(many, folder / "large")
        yield from page(folder / "large", folder / "page")


def written(folder: Path, count: int) -> Path:
    """So many programs, each with a line of its own; their specification."""
    texts = [path.read_bytes() for path in c_source.corpus()]
    (folder / "programs").mkdir(parents=True)
    for number in range(count):
        text = texts[number % len(texts)]
        (folder / "programs" / f"p{number:05}.c").write_bytes(text + f"\nint repetition_{number} = {number};\n".encode())
    spec = folder / "corpus.toml"
    spec.write_text('[[programs]]\nglob = "programs/*.c"\n', encoding="utf-8")
    return spec


def command(*words: str | Path) -> list[str]:
    """The command line of `robosmi corpus`."""
    return [sys.executable, "-m", "robosmi", "corpus", *map(str, words)]


class Sample(NamedTuple):
    """A run at a moment: the memory of its own process, in bytes, and the processor time of this and all that it has started."""

    moment: float
    memory: int
    used: float


def pool(spec: Path, out: Path) -> Iterator[Figure]:
    """A run in worker processes, against the same analyses in this process."""
    started = time.time()
    with subprocess.Popen(command("run", spec, "-o", out, "--fail-on", "never"), stdout=subprocess.DEVNULL) as running:
        samples = list(watched(running))
    with Store(out / "corpus.sqlite") as store:
        ends = sorted(datetime.fromisoformat(row[0]).timestamp() for row in store.query("SELECT finished FROM programs").rows)
    parse_wall, analyse_wall, analyse_used = alone(spec)
    later = [sample for sample in samples if sample.moment >= ends[START]]
    used = (later[-1].used - later[0].used) / (PROGRAMS - START)
    yield Figure("corpus run, a program more to one in one process, processor time", used / analyse_used, "x", 1.3)
    wall = (ends[-1] - ends[START]) / (PROGRAMS - START)
    many = ends[START] - started + wall * (MANY - START)
    note = f"from {PROGRAMS} programs in {ends[-1] - started:.0f} s, {cores()} workers"
    yield Figure(f"corpus run of {MANY}, to one process / cores", many * cores() / (analyse_wall * MANY), "x", 1.3, note=note)
    yield Figure(f"corpus run of {MANY}, to bare parses / cores", many * cores() / (parse_wall * MANY), "x")
    middle = START + (PROGRAMS - START) // 2
    early, late = ends[middle] - ends[START], ends[-1] - ends[middle]
    yield Figure(
        "corpus run, a late program to an early one", late / early * (middle - START) / (PROGRAMS - 1 - middle), "x", 1.3
    )
    yield Figure("corpus run, memory of the parent, greatest", max(sample.memory for sample in samples) / MB, "MB", 300)
    growth = 100 * (max(sample.memory for sample in later) / later[0].memory - 1)
    yield Figure(f"corpus run, growth of that from program {START} on", growth, "%", 10)


def watched(process: subprocess.Popen[bytes]) -> Iterator[Sample]:
    """A run, looked at again and again until it ends."""
    while process.poll() is None:
        used = used_by([process.pid])
        if size := resident(process.pid):
            yield Sample(time.time(), size, used)
        time.sleep(0.1)


def used_by(processes: Sequence[int]) -> float:
    """Processor time of processes and of all that they have started."""
    return sum(processor_seconds(each) for process in processes for each in (process, *descendants(process)))


def used_by_ended() -> float:
    """Processor time of the processes that this one has started and that have ended."""
    found = resource.getrusage(resource.RUSAGE_CHILDREN)
    return found.ru_utime + found.ru_stime


def processor_seconds(process: int) -> float:
    """Processor time of a process and of those that it has started and that have ended (proc(5), `stat`)."""
    try:
        fields = Path(f"/proc/{process}/stat").read_text(encoding="ascii").rpartition(")")[2].split()
    except OSError:
        return 0.0
    return sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")


def alone(spec: Path) -> tuple[float, float, float]:
    """Seconds of a bare parse and of an analysis, and processor seconds of an analysis: the mean of some of the programs."""
    analyse = content("chain", "corpus_analyse")
    paths = sorted((spec.parent / "programs").iterdir())
    for path in paths[: len(c_source.corpus()) : SAMPLE]:  # what is loaded once is loaded
        analysed(analyse, path)
    gc.collect()
    gc.freeze()
    gc.set_threshold(200_000, 20, 20)  # as commands and workers do
    parsing = analysing = used = 0.0
    chosen = paths[::SAMPLE]
    for path in chosen:
        start = time.perf_counter()
        c_source.bare(path, ())
        parsed, processor = time.perf_counter(), time.process_time()
        analysed(analyse, path)
        parsing += parsed - start
        analysing += time.perf_counter() - parsed
        used += time.process_time() - processor
    return parsing / len(chosen), analysing / len(chosen), used / len(chosen)


def analysed(analyse: object, path: Path) -> None:
    """Analyse a program as a run does; one that cannot be analysed costs what it costs."""
    assert callable(analyse)
    try:
        analyse(ProgramWork(path.name, str(path)))
    except Exception:
        return


def cluster(spec: Path, folder: Path) -> Iterator[Figure]:
    """The same run on a cluster of Dask on this machine."""
    try:
        import distributed  # noqa: F401
    except ImportError:
        yield not_measured("corpus run on Dask", "install robosmi[cluster]")
        return
    from tests.corpus_runs.clusters import cluster as running

    seconds, used = {}, {}
    with running(folder, workers=cores(), PYTHONPATH="") as (place, workers, scheduler):
        of_dask = [scheduler.pid, *(worker.pid for worker in workers)]
        for name, words in (("dask", ["--scheduler", place]), ("pool", [])):
            start, before = time.perf_counter(), used_by_ended() + used_by(of_dask)
            line = command("run", spec, "-o", folder / f"on_{name}", "--fail-on", "never", *words)
            subprocess.run(line, check=True, stdout=subprocess.DEVNULL)
            seconds[name], used[name] = time.perf_counter() - start, used_by_ended() + used_by(of_dask) - before
    note = f"{PROGRAMS} programs, by the clock {seconds['dask'] / seconds['pool']:.2f} x"
    yield Figure("corpus run on Dask, to worker processes, processor time", used["dask"] / used["pool"], "x", 1.5, note=note)


def copied(spec: Path, out: Path) -> None:
    """Run a large corpus whose results are copies: its first programs are analysed, the others get their rows."""
    count = len(c_source.corpus())
    read = read_spec(spec)
    options = options_of(read)
    small = spec.with_name("first.toml")
    small.write_text('[[programs]]\nglob = "programs/p00[0-4]*.c"\n', encoding="utf-8")
    first = CorpusRun(read_spec(small), out.with_name("first"), options)
    results = {result.id: result for result in first.results(backend_of(options))}
    files = content("chain", "corpus_files")

    def copies(jobs: Iterator[ProgramJob], steps: Sequence[str]) -> Generator[ProgramResult, None, None]:
        for job in jobs:
            number = int(Path(job.work.path).stem[1:])
            model = results[f"programs/p{number % count:05}.c"]
            yield replace(model, id=job.work.id, files={path: digest_of(path) for path in files(job.work)})

    for _ in CorpusRun(read, out, options).results(copies):
        pass


def second_run(spec: Path, out: Path) -> Iterator[Figure]:
    """A run in which nothing has changed."""
    start, before = time.perf_counter(), used_by_ended()
    line = command("run", spec, "-o", out, "--fail-on", "never", "--json")
    done = subprocess.run(line, check=True, capture_output=True, text=True)
    clock, used = time.perf_counter() - start, used_by_ended() - before
    assert f'"unchanged": {MANY}' in done.stdout
    what = f"corpus run, {MANY} programs of which none has changed, processor time"
    yield Figure(what, used, "s", 5, note=f"by the clock {clock:.1f} s")


def page(out: Path, into: Path) -> Iterator[Figure]:
    """The page of a large corpus, made and used."""
    start = time.perf_counter()
    subprocess.run(command("report", out, "-o", into), check=True, stdout=subprocess.DEVNULL)
    seconds = time.perf_counter() - start
    size = (into / "index.html").stat().st_size / MB
    yield Figure(f"corpus report, {MANY} programs", seconds, "s", 10, note=f"{size:.1f} MB")
    if not (shutil.which("chromium") and shutil.which("chromedriver")):
        yield not_measured("corpus report in a browser", "apt-get install chromium chromium-driver")
        return
    from tests.page.browsers import chromium

    with chromium() as driver:
        driver.get((into / "index.html").as_uri())
        yield Figure("corpus report, opened in a browser", float(driver.execute_script(LOADED)) / 1000, "s", 1)
        yield Figure("corpus report, first filter", float(driver.execute_async_script(FILTER)) / 1000, "s", 1)
