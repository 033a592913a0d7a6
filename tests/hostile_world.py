"""Runs commands as processes in a damaged environment: streams, folders, names, settings, damaged inputs.

`wrong` checks a run against the contract: one of its exit codes, never 70, no Python traceback, a cause where the command
failed, and one document with --json. `tests/cli/test_hostile_world.py` tries some environments, `tests/fuzz/environments.py`
every command in every one.
"""

from __future__ import annotations

import json
import os
import resource
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
EXAMPLE = ROOT / "docs" / "examples" / "line_follower"
CODES = frozenset([0, 1, 2, 3, 4, 5, 6, 130])
SECONDS, PATIENCE = 10.0, 300
"""Limits: processor seconds for an input under 100 kB, and seconds on the clock before a run is ended."""


def commands(place: Path) -> dict[str, list[str]]:
    """Each command with inputs that it can read, below a folder made by `copied`."""
    program, drawing = str(place / "in" / "line_follower.c"), str(place / "in" / "line_following_robot.fzz")
    return {
        "analyse": ["analyse", program, "-o", str(place / "code.xmi")],
        "hardware": ["hardware", drawing, "--svg", str(place / "a.svg")],
        "recommend": ["recommend", drawing],
        "migrate": ["migrate", program, "-o", str(place / "new")],
        "generate": ["generate", str(place / "out" / "models" / "plan.xmi"), "-o", str(place / "again")],
        "check": ["check", str(place / "out" / "models" / "plan.xmi")],
        "compile": ["compile", str(place / "out")],
        "history list": ["history", "list"],
        "history import": ["history", "import", str(place / "history.csv")],
        "libraries": ["libraries", "import", str(place / "libraries")],
        "run": ["run", str(place / "chain.toml")],
        "query": ["query", str(place / "books.csv"), "books.all.size()"],
        "parts": ["parts", "import", str(place / "parts")],
        "platform": ["platform", "import", str(place / "headers"), "--name", "mine"],
        "metamodels": ["metamodels", "generate", str(ROOT / "metamodels" / "trace.ecore"), "-o", str(place / "py")],
        "doctor": ["doctor"],
        "help": ["migrate", "--help"],
    }


def prepared(place: Path) -> None:
    """Fill a folder with inputs for all commands."""
    shutil.copytree(EXAMPLE, place / "in", ignore=shutil.ignore_patterns("out"))
    (place / "history.csv").write_text("part_id,title,library,count,last_used\np,t,Servo,1,2026-01-01\n")
    (place / "books.csv").write_text("title,year\nx,1\n")
    (place / "chain.toml").write_text('[[step]]\nname = "load"\nload = "books.csv"\n')
    (place / "libraries" / "Mine" / "src").mkdir(parents=True)
    (place / "libraries" / "Mine" / "library.properties").write_text("name=Mine\nversion=1.0\n")
    (place / "libraries" / "Mine" / "src" / "Mine.h").write_text("class Mine { public: void begin(); };\n")
    (place / "parts").mkdir()
    for part in (ROOT / "tests" / "transformations" / "t2m" / "fritzing" / "fixtures").glob("my_*.fzp"):
        shutil.copy(part, place / "parts")
    (place / "headers").mkdir()
    (place / "headers" / "mine.h").write_text("void turn(int pin);\n")
    done = run(["migrate", str(place / "in" / "line_follower.c"), "-o", str(place / "out")], World("plain"), place)
    assert done.code in (0, 1), done.err


@dataclass(frozen=True)
class World:
    """A damaged environment of a process.

    Attributes:
        name: what is damaged.
        shell: how a POSIX shell runs the command `"$@"`.
        changes: environment variables, None where one is to be missing; `{place}` in one is the prepared folder.
        before: a function that changes the prepared folder first.
    """

    name: str
    shell: str = '"$@"'
    changes: Mapping[str, str | None] = field(default_factory=dict)
    before: Callable[[Path], object] = lambda place: None


@dataclass(frozen=True)
class Done:
    """How a run ended, and the seconds of processor time that it took."""

    code: int
    out: str
    err: str
    seconds: float = 0.0


def run(words: list[str], world: World, place: Path) -> Done:
    """Run a command in a world; the code is 124 where it did not end."""
    environment: dict[str, str | None] = {**os.environ, "ROBOSMI_HOME": str(place / "home"), **world.changes}
    environment.pop("ROBOSMI_DEBUG", None)
    world.before(place)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(
            ["bash", "-c", world.shell, "bash", sys.executable, "-m", "robosmi", *words],
            capture_output=True,
            text=True,
            errors="replace",
            timeout=PATIENCE,
            cwd=place,
            stdin=subprocess.DEVNULL,
            env={name: value.replace("{place}", str(place)) for name, value in environment.items() if value is not None},
        )
    except subprocess.TimeoutExpired:
        return Done(124, "", "")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Done(done.returncode, done.stdout, done.stderr, seconds)


def wrong(done: Done, *, as_json: bool = False, told: bool = True) -> str:
    """How a run violates the contract, or an empty text.

    Args:
        done: the run.
        as_json: whether it was asked for one document, on a standard output that can be read.
        told: whether standard error can be read, so that a failure must give its cause there.
    """
    if done.code == 124:
        return "it does not end"
    if done.seconds > SECONDS:
        return f"it takes {done.seconds:.1f} s of processor time"
    if done.code not in CODES:
        return f"exit code {done.code}"
    for sign in ("Traceback", "bug of robosmi", "Exception ignored", "Fatal Python"):
        if sign in done.out + done.err:
            return f"it says '{sign}'"
    if told and 2 <= done.code <= 5 and "error: " not in done.err + done.out:
        return f"exit code {done.code} without a cause"
    if as_json:
        try:
            json.loads(done.out)
        except ValueError:
            return "its output is no JSON document"
    return ""


BAD_TEXTS: dict[str, bytes] = {
    "empty": b"",
    "zeros": bytes(300),
    "binary": bytes(range(256)) * 4,
    "brackets": b"[" * 100_000,
    "braces": b"{" * 50_000,
    "toml brackets": b"a = " + b"[" * 50_000,
    "json objects": b'{"a":' * 50_000,
    "elements": b"<a>" * 30_000,
    "json digits": b'{"a": ' + b"9" * 10_000 + b"}",
    "toml digits": b"a = " + b"9" * 10_000,
    "dots": b"a" + b".a" * 30_000 + b" = 1",
    "half a character": b'{"a": "\\ud800"}',
    "entities": b'<!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>',
    "a C integer": b"int x = "
    + b"9" * 10_000
    + b"; int y["
    + b"9" * 10_000
    + b"]; int main(void) { high("
    + b"9" * 10_000
    + b"); }",
    "a C exponent": b"double x = 1e999999999; int main(void) { pause(1e400); x = 1 << 999999999; }",
    "XMI digits": b'<a:A xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:a="http://robosmi.org/trace/1" x="'
    + b"9" * 10_000
    + b'"/>',
    "number": b"17",
    "text": b'"text"',
    "null": b"null",
    "list": b"[1, 2]",
}


SETTINGS: tuple[str, ...] = (
    "accept = 5",
    "accept = [5]",
    'accept = "x"',
    "[accept]\nx = 1",
    "[[accept]]\nrule = 1",
    "migrate = 5",
    "[migrate]\ntarget = 5",
    "[migrate]\nhardware = 5",
    "[migrate]\nhardware = []",
    'migrate = "x"',
    "libraries = 5",
    "[libraries]\nx = 5",
    "[bind]\nx = [1]",
    "bind = [1]",
    "roles = true",
    "[roles]\nx = 1.5",
    "severity = 1",
    "[severity]\nRS108 = 5",
    "[severity]\nRS108 = []",
    "[severity]\nRS108 = 2026-01-01",
    "x = 1",
    "[migrate.target]\nx = 1",
    f"accept = {'9' * 10_000}",
    "accept = " + "[" * 20_000,
    '[migrate]\nhardware = "\\u0000"',
    '[migrate]\nhardware = "."',
    '[migrate]\nhardware = "/dev/zero"',
    '[migrate]\ntarget = ""',
    '[migrate]\nsource_platform = "../../x"',
    '[migrate]\nsource_platform = "\\u0000"',
    '[migrate]\ntarget = "' + "x" * 5000 + '"',
    "accept = inf",
    "accept = nan",
)
"""Project files with a value of a kind that means nothing."""

EXPRESSIONS: tuple[str, ...] = (
    "call(books.all.first(), 'eClass')",
    'call(books, "eClass")',
    "Lazy(1)",
    "Lazy()",
    "Lazy(lambda: 1)",
    "Lazy([1, 2])",
    "Lazy(lambda x: x).size()",
    "Lazy",
    "Q",
    "Q(5)",
    "Q()",
    "Map",
    "Map(5)",
    "Tuple(5)",
    "Long('x')",
    "call",
    "call(1)",
    "call(1, 2)",
    "call(None, 'x')",
    "call(books.all, 'select')",
    "call(books.all.first(), '__class__')",
    "call_built_in(1, 'x')",
    "ext(1)",
    "ext(books)",
    "ext(1).x.y",
    "1/0",
    "'x' * 10 ** 12",
    "10 ** 10 ** 3",
    "[" * 100_000,
    "(" * 100_000,
    "-" * 100_000 + "1",
    "not " * 20_000 + "1",
    "1" + "+1" * 50_000,
    "9" * 10_000,
    "lambda: 1",
    "lambda x: x",
    "(lambda f: f(f))(lambda f: f(f))",
    "books",
    "books.all",
    "books.name",
    "books.element",
    "books.all_contents",
    "books.owns(5)",
    "books.id_of(5)",
    "books.element('x')",
    "all_instances",
    "equal",
    "as_string(Lazy)",
    "{1: 2}",
    "{[]: 1}",
    "{*[1]}",
    "f'{1:>1000000000}'",
    "f'{books}'",
    "None",
    "...",
    "b'x'",
    "1j",
    "float",
    "",
    " ",
    "\\",
    "a b",
    "x := 1",
    "books.all.select(1)",
    "books.all.select(lambda: 1)",
    "books.all.sortBy(lambda b: None)",
    "books.all.first().nothing",
    "\x00",
    "\ud800",
)


def worlds() -> Iterator[World]:
    """All damaged environments, as far as this system has them."""
    yield World("plain")
    yield World("no standard input", '"$@" <&-')
    yield World("no standard output", '"$@" >&-')
    yield World("no standard error", '"$@" 2>&-')
    yield World("no streams at all", '"$@" <&- >&- 2>&-')
    if os.path.exists("/dev/full"):
        yield World("full output", '"$@" >/dev/full')
        yield World("full errors", '"$@" 2>/dev/full')
        yield World("full output and errors", '"$@" >/dev/full 2>&1')
    yield World("output read by nobody", '"$@" > >(exit 0); exit $?')
    yield World("no home", changes={"HOME": None, "ROBOSMI_HOME": None, "XDG_DATA_HOME": "/nonexistent", "XDG_CACHE_HOME": None})
    yield World("home that is a file", changes={"HOME": "/dev/null", "ROBOSMI_HOME": "/dev/null", "XDG_CACHE_HOME": "/dev/null"})
    yield World("no folder for passing files", changes={"TMPDIR": "/nonexistent", "TMP": None, "TEMP": None})
    yield World("C locale", changes={"LC_ALL": "C", "LANG": "C"})
    yield World("ASCII", changes={"LC_ALL": "POSIX", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"})
    yield World("nearly no environment", 'env -i PATH="$PATH" HOME="$HOME" ROBOSMI_HOME="$ROBOSMI_HOME" "$@"')
    yield World("current folder removed", 'mkdir gone; cd gone; rmdir ../gone; "$@"')
    yield World("few open files", 'ulimit -n 24; "$@"')
    yield World("small files only", "trap '' XFSZ; ulimit -f 4; \"$@\"")
    yield World("little memory", 'ulimit -v 180000; "$@"')
    yield World("strange search path", changes={"ROBOSMI_PATH": "/dev/null:\udcff:/proc/self/mem:" + "x" * 300})
