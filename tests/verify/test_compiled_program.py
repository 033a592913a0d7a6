"""What `compile` leaves: whole or nothing, and read by Clang as the compiler reads it."""

from __future__ import annotations

import hashlib
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from clang import cindex

from robosmi.errors import SourceError, StoppedError
from robosmi.verify.toolchains.compiled_program import compile_into, folder_of, read_record
from robosmi.verify.toolchains.sketch import find_sketch
from tests.running import run, tree
from tests.tools import require_tools

CASES = Path(__file__).parent / "cases"
ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def out(tmp_path: Path) -> Path:
    """An output folder with a sketch."""
    require_tools("avr-gcc", "avr-g++", "avr-size", "arduino-core-avr")
    return Path(shutil.copytree(CASES / "blink", tmp_path / "out"))


def whole(build: Path) -> bool:
    """Whether a folder holds a program with its record and the database, and nothing else; or nothing at all."""
    names = {path.name for path in build.iterdir()} if build.is_dir() else set()
    if not names:
        return False
    assert names == {"blink.elf", "blink.hex", "blink.build.json", "compile_commands.json"}
    record = json.loads((build / "blink.build.json").read_text())
    assert record["program"] == hashlib.sha256((build / "blink.hex").read_bytes()).hexdigest()
    assert (build / "blink.elf").read_bytes()[:4] == b"\x7fELF"
    assert json.loads((build / "compile_commands.json").read_text())
    return True


def test_the_command_leaves_program_record_and_database(out: Path) -> None:
    outcome = run("compile", out, "--json")
    assert outcome.code == 0
    kinds = {entry["kind"]: Path(entry["path"]) for entry in outcome.document["artifacts"]}
    assert kinds == {
        "elf": out / "build" / "blink.elf", "hex": out / "build" / "blink.hex",
        "compilation database": out / "build" / "compile_commands.json",
    }  # fmt: skip
    assert whole(out / "build")
    before = tree(out)
    assert run("compile", out).code == 0
    assert {name for name, content in tree(out).items() if before[name] != content} <= {"build/blink.elf"}
    other = out.parent / "a new" / "place"
    assert run("compile", out, "-o", other, "--board", "mega").code == 0
    assert whole(other)
    sketch, _ = find_sketch(out)
    record = read_record(other, sketch)
    assert record is not None
    assert (record.board, record.fits, record.stand_ins) == ("mega", True, ())


def test_what_does_not_compile_leaves_the_database_and_an_older_program(out: Path) -> None:
    compile_into(out)
    program = (out / "build" / "blink.hex").read_bytes()
    (out / "blink" / "blink.ino").write_text("void setup() { nothing(); }\nvoid loop() {}\n")
    outcome = run("compile", out, "--json")
    assert outcome.code == 6
    assert [entry["kind"] for entry in outcome.document["artifacts"]] == ["compilation database"]
    assert (out / "build" / "blink.hex").read_bytes() == program
    assert run("upload", out, "--port", "/dev/null").code == 3


@pytest.mark.parametrize("case", ["too_much_flash", "too_much_ram"])
def test_too_big_for_the_board_leaves_its_sizes_and_nothing_that_could_be_sent(case: str, tmp_path: Path) -> None:
    """The next run says in MIGRATION.md that it does not fit."""
    require_tools("avr-gcc", "avr-g++", "avr-size", "arduino-core-avr")
    out = Path(shutil.copytree(CASES / case, tmp_path / "out"))
    assert run("compile", out).code == 1
    assert not list((out / "build").glob("*.hex"))
    sketch, _ = find_sketch(out)
    record = read_record(out / "build", sketch)
    assert record is not None
    assert not record.fits
    assert any(record.sizes[f"{kind}_bytes"] > record.sizes[f"{kind}_limit"] for kind in ("flash", "ram"))
    assert run("upload", out, "--port", "/dev/null").code == 3


@pytest.mark.parametrize("case", ["blink", "plain_c", "tabs", "servo", "wire"])
def test_clang_reads_each_entry_of_the_database_without_an_error(case: str, tmp_path: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "avr-size", "arduino-core-avr")
    out = Path(shutil.copytree(CASES / case, tmp_path / "out"))
    compile_into(out)
    (sketch,) = (path for path in out.iterdir() if path.name != "build")
    commands = list(cindex.CompilationDatabase.fromDirectory(str(out / "build")).getAllCompileCommands())
    sources = {path.name for path in sketch.rglob("*") if path.suffix in (".ino", ".c", ".cpp")}
    assert {Path(command.filename).name for command in commands} == sources
    for command in commands:
        assert command.directory == str(sketch.resolve())
        os.chdir(command.directory)
        unit = cindex.Index.create().parse(None, args=list(command.arguments)[1:])
        assert [str(d) for d in unit.diagnostics if d.severity >= cindex.Diagnostic.Error] == []
        assert Path(unit.spelling).name in sources


@pytest.fixture(autouse=True)
def same_folder() -> Iterator[None]:
    """Put the current folder back."""
    before = Path.cwd()
    yield
    os.chdir(before)


@pytest.mark.parametrize("after_s", [0.1, 0.4, 0.7, 1.0, 1.3, 1.6])
def test_a_killed_run_leaves_all_or_nothing(after_s: float, out: Path) -> None:
    done = subprocess.Popen(
        [sys.executable, "-m", "robosmi", "compile", str(out), "-o", str(out / "kept")], cwd=ROOT, start_new_session=True,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    time.sleep(after_s)
    os.killpg(done.pid, signal.SIGKILL)
    done.wait()
    if (out / "kept").exists():
        assert whole(out / "kept")
    compile_into(out, into=out / "kept")
    assert whole(out / "kept")
    assert sorted(path.name for path in out.iterdir()) == ["blink", "kept"]


SMALL_DISK = """
mount -t tmpfs -o size=200k none "$1/kept" || exit 99
cp -r "$1/before/." "$1/kept"
dd if=/dev/zero of="$1/kept/filler" bs=1k 2>"$1/dd"
"$2" -m robosmi compile "$1" -o "$1/kept" --board mega
code=$?
rm "$1/kept/filler"
mkdir "$1/after"
cp -r "$1/kept/." "$1/after"
exit $code
"""


@pytest.mark.parametrize("before", [False, True])
def test_a_full_disk_leaves_what_was_there(before: bool, out: Path) -> None:
    require_tools("unshare")
    (out / "kept").mkdir()
    (out / "before").mkdir()
    if before:
        compile_into(out, "nano", into=out / "before")
    done = subprocess.run(
        ["unshare", "-rm", "sh", "-c", SMALL_DISK, "sh", str(out), sys.executable],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    if done.returncode in (1, 99) and ("unshare" in done.stderr or "mount" in done.stderr):
        pytest.skip(f"no file system of one's own here: {done.stderr}")
    assert done.returncode == 3, done.stdout + done.stderr
    assert "No space left on device" in done.stderr
    assert tree(out / "after") == tree(out / "before")


def test_where_the_compiler_may_write_no_long_file_the_program_is_not_blamed(out: Path) -> None:
    def little_space() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000))

    command = [sys.executable, "-m", "robosmi", "compile", str(out)]
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}  # Python stores cut ones without a word
    done = subprocess.run(
        command, cwd=ROOT, env=environment, capture_output=True, text=True, preexec_fn=little_space, check=False
    )
    assert done.returncode == 3
    assert f"error: {tempfile.gettempdir()}: 'avr-g" in done.stderr
    assert ": the system ended it: File size limit exceeded" in done.stderr
    assert "(ulimit -f)" in done.stderr
    assert not list(out.glob("build/*"))


FULL_TEMPORARY = """
mkdir "$1/small"
mount -t tmpfs -o size="$3"k none "$1/small" || exit 99
mkdir "$1/small/tmp"
dd if=/dev/zero of="$1/small/filler" bs=1k count="$4" 2>"$1/dd"
TMPDIR="$1/small/tmp" "$2" -m robosmi compile "$1"
"""


@pytest.mark.parametrize(("size_k", "taken_k"), [(300, 296), (300, 290), (300, 276), (300, 240)])
def test_a_full_folder_for_temporary_files_is_no_fault_of_the_program(size_k: int, taken_k: int, out: Path) -> None:
    require_tools("unshare")
    done = subprocess.run(
        ["unshare", "-rm", "sh", "-c", FULL_TEMPORARY, "sh", str(out), sys.executable, str(size_k), str(taken_k)],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    if done.returncode in (1, 99) and ("unshare" in done.stderr or "mount" in done.stderr):
        pytest.skip(f"no file system of one's own here: {done.stderr}")
    assert done.returncode == 3, done.stdout + done.stderr
    assert f"error: {out / 'small' / 'tmp'}: " in done.stderr
    assert "No space left on device" in done.stderr
    assert "set TMPDIR to a folder with more" in done.stderr
    assert "variant" not in done.stderr


def test_a_place_that_cannot_be_written(out: Path) -> None:
    (out / "file").write_text("mine")
    with pytest.raises(SourceError, match="is a file"):
        compile_into(out, into=out / "file")
    assert (out / "file").read_text() == "mine"
    compile_into(out)
    (out / "build" / "blink.hex").chmod(0o444)
    with pytest.raises(StoppedError, match="read-only"):
        compile_into(out, "mega")
    record = json.loads((out / "build" / "blink.build.json").read_text())
    assert record["board"] == "uno"


def test_the_folder_of_a_sketch_is_the_output_folder_s_wherever_it_is_named(tmp_path: Path) -> None:
    require_tools("avr-g++")
    (tmp_path / "out" / "blink").mkdir(parents=True)
    (tmp_path / "out" / "blink" / "blink.ino").write_text("void setup() {}\nvoid loop() {}\n")
    sketch, _ = find_sketch(tmp_path / "out")
    assert folder_of(tmp_path / "out", sketch) == tmp_path / "out" / "build"
    assert folder_of(tmp_path / "out" / "blink", sketch) == tmp_path / "out" / "blink" / "build"
    (tmp_path / "out" / ".robosmi.json").write_text("{}")
    assert folder_of(tmp_path / "out" / "blink", sketch) == tmp_path / "out" / "build"


@pytest.mark.parametrize("name", ["blink.elf", "blink.hex", "compile_commands.json", "blink.build.json"])
def test_a_file_that_no_compile_has_made_is_not_written_over(name: str, out: Path, tmp_path: Path) -> None:
    into = tmp_path / "mine"
    into.mkdir()
    (into / name).write_text("[]" if name != "blink.build.json" else "notes")
    outcome = run("compile", out, "-o", into)
    if name == "blink.build.json":  # a damaged record is one of ours
        assert outcome.code == 0
        return
    assert outcome.code == 5
    assert "a file here is not from compiling this sketch" in outcome.err
    assert [path.name for path in into.iterdir()] == [name]


def test_what_an_earlier_compile_has_left_is_written_over(out: Path, tmp_path: Path) -> None:
    sketch = out / "blink" / "blink.ino"
    text = sketch.read_text()
    sketch.write_text(text + "\nbroken")
    assert run("compile", out, "-o", tmp_path / "mine").code == 6
    sketch.write_text(text)
    assert run("compile", out, "-o", tmp_path / "mine").code == 0
    assert run("compile", out, "-o", tmp_path / "mine").code == 0


@pytest.fixture
def made(tmp_path: Path) -> Path:
    """An output folder that a run has made, as its record says; no compiler is needed to refuse what is in it."""
    folder = Path(shutil.copytree(CASES / "blink", tmp_path / "p" / "out"))
    (folder / ".robosmi.json").write_text('{"files": {}}')
    return folder


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
@pytest.mark.parametrize("named", ["", "blink", "blink/blink.ino"])
@pytest.mark.parametrize(
    "linked", ["build", "blink", "blink/blink.ino", "blink/adapters.h", "blink/sketch.yaml", "blink/src", "build/blink.elf"]
)
def test_what_a_run_has_made_is_compiled_only_where_no_link_leads_out(
    linked: str, named: str, made: Path, tmp_path: Path
) -> None:
    secret = tmp_path / "secret"
    place = made / linked
    if place.exists():
        place.rename(secret)
    elif linked in ("build", "blink/src"):
        secret.mkdir()
    else:
        secret.write_text("a key\n")
    place.parent.mkdir(exist_ok=True)
    place.symlink_to(secret)
    before = tree(tmp_path)
    outcome = run("compile", made / named)
    assert outcome.code == 3
    assert f"'{linked}' is outside the output folder" in outcome.err
    assert "key" not in outcome.err
    assert tree(tmp_path) == before


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
def test_a_link_in_a_linked_folder_counts_too_and_loops_end(made: Path, tmp_path: Path) -> None:
    (tmp_path / "key.h").write_text("a key\n")
    (made / "mine").mkdir()
    (made / "mine" / "again").symlink_to(made)
    (made / "blink" / "src").symlink_to("../mine")
    sketch, _ = find_sketch(made)
    assert folder_of(made, sketch) == made / "build"
    (made / "mine" / "key.h").symlink_to(tmp_path / "key.h")
    with pytest.raises(SourceError, match=r"'blink/src/key\.h' is outside the output folder"):
        find_sketch(made)


@pytest.mark.skipif(os.name == "nt", reason="links need rights there")
def test_a_sketch_of_a_person_s_own_may_have_links(out: Path, tmp_path: Path) -> None:
    (out / "blink" / "blink.ino").rename(tmp_path / "shared.ino")
    (out / "blink" / "blink.ino").symlink_to(tmp_path / "shared.ino")
    (tmp_path / "programs").mkdir()
    (out / "build").symlink_to(tmp_path / "programs")
    assert run("compile", out).code == 0
    assert whole(tmp_path / "programs")
