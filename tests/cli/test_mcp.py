"""The MCP server, asked by the package's own client: the commands' documents, the root folder, a judge of adapters' bodies."""

from __future__ import annotations

import asyncio
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from mcp import Client
from mcp.client.stdio import StdioServerParameters, stdio_client
from mcp_types import jsonrpc_message_adapter
from pydantic import ValidationError

from robosmi.cli import confined, landlock
from robosmi.cli.mcp_commands import Commands
from robosmi.cli.mcp_tools import Tools, answer_to, make_server
from robosmi.cli.root_folder import RootFolder
from robosmi.cli.supervised import GRACE_S
from robosmi.errors import SourceError, UsageError
from tests.running import check_document, run
from tests.tools import require_engine, require_tools

ROBOT = Path(__file__).parent / "mcp_robot"
SECRET = "the_secret_of_another_folder"
Call = Callable[..., Awaitable[dict[str, Any]]]


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """A root folder with a robot; beside the folder is a secret file."""
    (tmp_path / "outside").mkdir()
    (tmp_path / "outside" / "secret.h").write_text(f"int {SECRET};\n#error {SECRET}\n")
    return Path(shutil.copytree(ROBOT, tmp_path / "root"))


@pytest.fixture
def commands(root: Path) -> Iterator[Commands]:
    """Runs commands in the root folder, confined where the kernel can."""
    with Commands(RootFolder(root), 120, confined=bool(landlock.version())) as made:
        yield made


def ask(commands: Commands, conversation: Callable[[Call], Awaitable[None]]) -> None:
    """Run a conversation between a client in this process and the server."""

    async def talk() -> None:
        async with Client(make_server(commands)) as client:

            async def call(name: str, /, **arguments: Any) -> dict[str, Any]:
                answer = await client.call_tool(name, arguments)
                assert not answer.is_error, answer.content
                document = answer.structured_content
                assert document is not None
                check_document(document)
                return dict(document)

            await conversation(call)

    asyncio.run(talk())


def test_the_tools_are_the_commands_with_their_arguments(commands: Commands) -> None:
    async def talk() -> None:
        async with Client(make_server(commands)) as client:
            tools = {tool.name: tool for tool in (await client.list_tools()).tools}
            assert set(tools) == {
                "analyse", "hardware", "recommend", "migrate", "plan_show", "choose", "generate", "compile", "verify", "explain",
            }  # fmt: skip
            assert {"files", "hardware", "target", "out"} <= set(tools["migrate"].input_schema["properties"])
            assert set(tools["generate"].input_schema["required"]) == {"plan", "out"}
            assert set(tools["explain"].input_schema["properties"]) == {"rule"}
            assert "native code" in (tools["verify"].description or "")
            assert "120 s" in (tools["verify"].description or "")
            assert tools["analyse"].annotations is not None
            assert tools["analyse"].annotations.read_only_hint is True

    asyncio.run(talk())


@pytest.mark.processes
def test_an_answer_is_the_commands_document(commands: Commands, root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(root)
    expected = run("analyse", "blink.c", "--json")

    async def talk(call: Call) -> None:
        answer = await call("analyse", files=["blink.c"])
        assert answer["result"] == expected.result
        assert answer["exit_code"] == expected.code == 0
        missing = await call("analyse", files=["gone.c"])
        assert (missing["exit_code"], missing["ok"], missing["findings"][0]["rule"]) == (3, False, "RS902")
        page = await call("explain", rule="number-too-wide")
        assert page["result"]["rules"][0]["id"] == "RS311"

    ask(commands, talk)


@pytest.mark.parametrize(
    "path",
    [
        "../outside/secret.h",
        "{outside}/secret.h",
        "/etc/passwd",
        "link.c",
        "folder/secret.h",
        "a/../../outside/secret.h",
        "",
        "a\0b",
    ],
)
def test_a_path_out_of_the_root_folder_is_refused(path: str, root: Path, commands: Commands) -> None:
    outside = root.parent / "outside"
    (root / "link.c").symlink_to(outside / "secret.h")
    (root / "folder").symlink_to(outside)

    async def talk(call: Call) -> None:
        named = path.format(outside=outside)
        for name, arguments in (
            ("analyse", {"files": [named]}),
            ("analyse", {"files": ["blink.c"], "include_dirs": [named]}),
            ("hardware", {"sketch": named}),
            ("migrate", {"files": ["blink.c"], "out": named}),
            ("migrate", {"files": ["blink.c"], "out": "out", "hardware": named}),
            ("generate", {"plan": "out/models/plan.xmi", "out": named}),
            ("compile", {"out": named}),
            ("verify", {"out": "out", "scenarios": [named]}),
            ("choose", {"out": named, "answers": {"port:P26": "none"}}),
        ):
            answer = await call(name, **arguments)
            assert (answer["exit_code"], answer["findings"][0]["rule"]) == (2, "RS901"), name
            assert answer["result"] is None

    ask(commands, talk)
    assert sorted(p.name for p in outside.iterdir()) == ["secret.h"]


def test_paths_inside_are_taken_however_they_are_written(root: Path) -> None:
    folder = RootFolder(root)
    assert folder.relative("blink.c") == folder.relative(str(root / "blink.c")) == folder.relative("a/../blink.c") == "blink.c"
    assert folder.relative(".") == "."
    assert folder.relative("-o.c") == "./-o.c"
    (root / "inner.c").symlink_to("blink.c")
    with pytest.raises(UsageError, match="link"):
        folder.relative("inner.c")
    with pytest.raises(SourceError):
        RootFolder(root / "gone")
    with pytest.raises(SourceError):
        RootFolder(root / "blink.c")


@pytest.mark.processes
def test_words_are_no_options(commands: Commands) -> None:
    async def talk(call: Call) -> None:
        for name, arguments in (
            ("explain", {"rule": "--sarif=x.sarif"}),
            ("choose", {"out": "out", "answers": {"--source": "x"}}),
            ("migrate", {"files": [], "out": "out"}),
        ):
            assert (await call(name, **arguments))["exit_code"] == 2
        answer = await call("migrate", files=["blink.c"], out="out", target="--json")
        assert answer["exit_code"] == 2

    ask(commands, talk)


def test_arguments_that_nobody_means_are_refused_shortly(commands: Commands) -> None:
    async def talk(call: Call) -> None:
        long = "x" * 2_000_000
        for name, arguments in (
            ("explain", {"rule": long}), ("explain", {"rule": f"-{long}"}), ("choose", {"out": "out", "answers": {long: "D9"}}),
            ("choose", {"out": "out", "answers": {"eye": "D9"}, "why": long}), ("analyse", {"files": [long]}),
            ("migrate", {"files": ["blink.c"], "out": "out", "bind": [f"eye={long}"]}),
        ):  # fmt: skip
            answer = await call(name, **arguments)
            assert answer["exit_code"] == 2
            assert len(str(answer)) < 1000

    ask(commands, talk)


@pytest.mark.processes
def test_words_that_no_program_can_be_given_are_refused(commands: Commands) -> None:
    async def talk(call: Call) -> None:
        for name, arguments in (
            ("explain", {"rule": "RS1\0"}), ("analyse", {"files": ["blink.c"], "defines": ["A=\0"]}),
            ("choose", {"out": "out", "answers": {"eye": "D\0"}}), ("analyse", {"files": ["blink\0.c"]}),
            ("analyse", {"files": ["blink.c"], "defines": ["A" * 4000] * 1000}),
            ("analyse", {"files": ["blink.c"], "defines": ["A"] * 300_000}),
        ):  # fmt: skip
            answer = await call(name, **arguments)
            assert (answer["exit_code"], answer["findings"][0]["rule"]) == (2, "RS901")
            assert len(str(answer)) < 1000
        assert (await call("analyse", files=["blink.c"], defines=["A" * 400] * 100))["exit_code"] == 0

    ask(commands, talk)


@pytest.mark.parametrize("arguments", [{"rule": "RS\ud800"}, {"rule": "-\ud800"}, {"rule": "\udfff" * 5000}])
def test_half_a_character_is_refused_in_a_text_that_can_be_sent(arguments: dict[str, str], commands: Commands) -> None:
    answer = asyncio.run(Tools(commands).explain(**arguments))
    assert (answer["exit_code"], answer["findings"][0]["rule"]) == (2, "RS901")
    assert str(answer).encode()
    answer = asyncio.run(Tools(commands).hardware(arguments["rule"]))
    assert (answer["exit_code"], answer["findings"][0]["rule"]) == (2, "RS901")
    assert str(answer).encode()


def compiled_thief(commands: Commands) -> str:
    """The whole output of compiling a sketch that includes the secret file."""
    root = commands.root.path
    (root / "thief").mkdir()
    (root / "thief" / "thief.ino").write_text(f'#include "{root.parent}/outside/secret.h"\nvoid setup() {{}}\nvoid loop() {{}}\n')
    said: list[str] = []

    async def talk(call: Call) -> None:
        answer = await call("compile", out="thief", board="uno")
        assert answer["exit_code"] == 6, answer
        said.append(str(answer))

    ask(commands, talk)
    return said[0]


def test_what_compilers_read_is_held_to_the_root_folder(commands: Commands) -> None:
    require_landlock()
    require_tools("avr-gcc", "arduino-core-avr")
    said = compiled_thief(commands)
    assert "secret.h" in said
    assert SECRET not in said


def test_a_compiler_that_nothing_holds_tells_the_secret(root: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    with Commands(RootFolder(root), 120, confined=False) as free:
        assert SECRET in compiled_thief(free)


@pytest.mark.processes
def test_a_command_that_takes_too_long_is_ended(root: Path) -> None:
    async def talk(call: Call) -> None:
        answer = await call("analyse", files=["blink.c"])
        assert answer["exit_code"] == 3
        assert "exceeded 0.05 s" in answer["findings"][0]["message"]

    with Commands(RootFolder(root), 0.05, confined=False) as hasty:
        ask(hasty, talk)


def test_a_wrong_body_is_refused_with_its_first_difference_and_a_right_one_passes(commands: Commands, root: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr", "gcc-32-bits")
    require_engine("simavr")
    bodies = {
        "high": "pinMode(pin, OUTPUT);\n  digitalWrite(pin, HIGH);",
        "low": "pinMode(pin, OUTPUT);\n  digitalWrite(pin, LOW);",
    }

    def write(name: str, body: str) -> None:
        file = root / "out" / "blink" / "adapters.h"
        head, declared, rest = file.read_text().partition(f"void {name}(")
        end = rest.index("\n}\n")
        opened = rest.index("{\n") + 2
        file.write_text(f"{head}{declared}{rest[:opened]}  {body}{rest[end:]}")

    async def talk(call: Call) -> None:
        made = await call(
            "migrate", files=["blink.c"], out="out", hardware="wiring.csv", bind=["P26=D13"], adapters="placeholders"
        )
        assert [task["rule"] for task in made["tasks"] if task["rule"] == "RS501"] == ["RS501"] * 3
        shown = await call("plan_show", plan="out/models/plan.xmi")
        assert shown["result"]["plan"]["call_sites"]["todo"] == 4
        write("high", bodies["high"])
        write("pause", "delay(time);")
        write("low", bodies["high"])  # wrong: the lamp never goes out
        await call("generate", plan="out/models/plan.xmi", out="out")
        wrong = await call("verify", out="out", scenarios=["short.toml"])
        assert (wrong["ok"], wrong["exit_code"], wrong["result"]["verdict"]) == (False, 6, "different")
        first = wrong["result"]["first_difference"]
        assert first["channel"] == "lamp (P26)"
        assert (first["call"]["function"], first["call"]["line"]) == ("low", 8)
        write("low", bodies["low"])
        right = await call("verify", out="out", scenarios=["short.toml"])
        assert (right["ok"], right["exit_code"], right["result"]["verdict"]) == (True, 0, "no-difference-found")
        again = await call(
            "migrate", files=["blink.c"], out="out", hardware="wiring.csv", bind=["P26=D13"], adapters="placeholders"
        )
        assert (
            again["result"]["plan"]["work"]["write"]["open"] == 0 if "open" in again["result"]["plan"]["work"]["write"] else True
        )
        assert bodies["low"] in (root / "out" / "blink" / "adapters.h").read_text()

    ask(commands, talk)


@pytest.mark.processes
def test_a_decision_is_made_and_opened_again(commands: Commands, root: Path) -> None:
    async def talk(call: Call) -> None:
        made = await call("migrate", files=["blink.c"], out="out", hardware="wiring.csv")
        (port,) = [choice for choice in made["result"]["plan"]["choices"] if choice["kind"] == "port"]
        chosen = await call("choose", out="out", answers={port["id"]: "none"}, why="the lamp is gone")
        assert (chosen["ok"], chosen["exit_code"]) == (True, 0), chosen
        (port,) = chosen["result"]["choices"]
        assert port["chosen"] == "none"
        assert "the lamp is gone" in port["why"]
        opened = await call("choose", out="out", answers={port["id"]: ""})
        (port,) = opened["result"]["choices"]
        assert port["chosen"] is None

    ask(commands, talk)


@pytest.mark.processes
def test_a_client_starts_the_command_and_talks_over_its_streams(root: Path, tmp_path: Path) -> None:
    confined = [] if landlock.version() else ["--unconfined"]
    server = StdioServerParameters(
        command=sys.executable, args=["-m", "robosmi", "mcp", "--root", str(root), *confined],
        env={**os.environ, "ROBOSMI_HOME": str(tmp_path / "home")}, cwd=Path(__file__).parents[2],
    )  # fmt: skip

    async def talk() -> None:
        async with Client(stdio_client(server)) as client:
            assert len((await client.list_tools()).tools) == 10
            answer = await client.call_tool("explain", {"rule": "RS230"})
            assert answer.structured_content is not None
            assert answer.structured_content["result"]["rules"][0]["name"] == "ShortCircuit"
            assert not (tmp_path / "home").exists()

    asyncio.run(talk())


@pytest.mark.parametrize(
    ("line", "identity", "said"),
    [
        (
            r'{"jsonrpc":"2.0","id":7,"method":"tools/call","params":{"name":"explain","arguments":{"rule":"RS\ud800"}}}',
            7,
            "other half",
        ),
        (r'{"jsonrpc":"2.0","id":"a","method":"tools/call","params":{"name":"\udfff"}}', "a", "other half"),
        (r'{"jsonrpc":"2.0","id":8,"method":5}', 8, "JSON-RPC"),
        (r'{"jsonrpc":"2.0","id":true,"method":5}', None, "JSON-RPC"),
        ("[1, 2]", None, "JSON-RPC"),
        ("no JSON", None, "not JSON"),
        ("[" * 20_000, None, "not JSON"),
    ],
)
def test_a_line_that_is_no_message_is_answered(line: str, identity: int | str | None, said: str) -> None:
    with pytest.raises(ValidationError) as found:
        jsonrpc_message_adapter.validate_json(line, by_name=False)
    answer = answer_to(found.value)
    assert (answer.id, said in answer.error.message) == (identity, True), answer
    assert answer.model_dump_json()


def test_a_started_server_goes_on_after_lines_that_are_no_messages(root: Path, tmp_path: Path) -> None:
    def line(identity: int, method: str, **params: Any) -> str:
        return json.dumps({"jsonrpc": "2.0", "id": identity, "method": method, "params": params})

    asked = [
        line(1, "initialize", protocolVersion="2025-06-18", capabilities={}, clientInfo={"name": "test", "version": "1"}),
        '{"jsonrpc": "2.0", "method": "notifications/initialized"}',
        line(2, "tools/call", name="explain", arguments={"rule": "RS\ud800"}),
        "no JSON", line(3, "tools/list"),
        *(f'{{"jsonrpc": "2.0", "id": {identity}, "method": "ping"}}' for identity in ("1.5", "true", "[1]", "null", "NaN")),
    ]  # fmt: skip
    confined = [] if landlock.version() else ["--unconfined"]
    command = [sys.executable, "-m", "robosmi", "mcp", "--root", str(root), *confined]
    with subprocess.Popen(
        command,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "ROBOSMI_HOME": str(tmp_path / "home")},
    ) as server:
        assert server.stdin is not None
        assert server.stdout is not None
        server.stdin.write("\n".join(asked) + "\n")
        server.stdin.flush()
        answers = [json.loads(server.stdout.readline()) for _ in range(9)]
        server.stdin.close()
        assert server.wait(20) == 0
    told = {answer["id"]: answer for answer in answers}
    assert set(told) == {1, 2, None, 3}
    assert [answer["id"] for answer in answers].count(None) == 6
    assert "surrogates" in told[2]["error"]["message"]
    assert len(told[3]["result"]["tools"]) == 10


def require_landlock() -> None:
    """Skip the running test on a kernel without Landlock."""
    if not landlock.version():
        pytest.skip("the kernel has no Landlock")


def test_landlock_holds_a_process_and_what_it_starts(tmp_path: Path) -> None:
    require_landlock()
    (tmp_path / "in").mkdir()
    (tmp_path / "out.txt").write_text(SECRET)
    program = """
import os, subprocess, sys
from pathlib import Path
from robosmi.cli import landlock
inside, outside = Path(sys.argv[1]), Path(sys.argv[2])
system = [(Path(name), landlock.RUN) for name in ("/usr", "/lib", "/lib64", "/bin")]
landlock.restrict([(inside, landlock.WRITE), *system])
(inside / "a.txt").write_text("a")
acts = [outside.read_text, lambda: outside.with_name("new.txt").write_text("a"), lambda: os.symlink("/etc", inside / "etc")]
for act in acts:
    try:
        act()
    except PermissionError:
        print("refused")
done = subprocess.run(["/bin/cat", outside], stderr=subprocess.STDOUT, stdout=subprocess.PIPE, text=True)
print(done.stdout)
"""
    words = [sys.executable, "-c", program, str(tmp_path / "in"), str(tmp_path / "out.txt")]
    done = subprocess.run(words, capture_output=True, text=True, cwd=Path(__file__).parents[2], check=False)
    assert done.stdout.count("refused") == 3, done.stderr
    assert "Permission denied" in done.stdout
    assert SECRET not in done.stdout
    assert (tmp_path / "in" / "a.txt").read_text() == "a"


CONFINED = """
import ctypes, os, socket, sys
from robosmi.cli import confined, landlock
landlock.restrict([])
confined.deny_sockets()
acts = {kind.name: lambda kind=kind: socket.socket(kind, socket.SOCK_DGRAM) for kind in socket.AddressFamily if kind}
keys = ctypes.CDLL(None, use_errno=True)

def add_key():
    if keys.syscall({"x86_64": 248, "aarch64": 217}[os.uname().machine], b"user", b"robosmi", b"x", 1, -3) < 0:
        raise OSError(ctypes.get_errno(), "add_key")

acts["key"] = add_key
acts["signal"] = lambda: os.kill(os.getppid(), 0)
for name, act in acts.items():
    try:
        act()
        print("done", name)
    except PermissionError:
        print("refused", name)
"""


def test_a_confined_process_makes_no_socket_and_signals_nobody() -> None:
    require_landlock()
    if not confined.can_deny_sockets():
        pytest.skip("no filter of system calls is known for this machine")
    root = Path(__file__).parents[2]
    done = subprocess.run([sys.executable, "-c", CONFINED], capture_output=True, text=True, cwd=root, check=False)
    said = done.stdout.splitlines()
    assert {"refused AF_UNIX", "refused AF_INET", "refused AF_NETLINK", "refused key"} <= {*said}, done.stderr
    assert [each for each in said if each.startswith("done")] == ([] if landlock.version() >= 6 else ["done signal"])


def test_a_program_of_another_word_size_makes_no_socket_either(tmp_path: Path) -> None:
    require_tools("gcc")
    if not confined.can_deny_sockets():
        pytest.skip("no filter of system calls is known for this machine")
    source = tmp_path / "makes_a_socket.c"
    source.write_text("#include <sys/socket.h>\nint main(void) { return socket(1, 1, 0) < 0 ? 7 : 8; }\n")
    if subprocess.run(["gcc", "-m32", "-static", str(source), "-o", str(tmp_path / "a")], check=False).returncode:
        pytest.skip("the compiler makes no programs of 32 bits")
    program = "import os, sys\nfrom robosmi.cli import confined\nconfined.deny_sockets()\nos.execv(sys.argv[1], sys.argv[1:])"
    words = [sys.executable, "-c", program, str(tmp_path / "a")]
    assert subprocess.run([str(tmp_path / "a")], check=False).returncode == 8
    assert subprocess.run(words, cwd=Path(__file__).parents[2], check=False).returncode == 7


DETACHED = r"""
import os, signal, sys, time
from robosmi.cli.supervised import supervised

def work():
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            signal.signal(signal.SIGTERM, signal.SIG_IGN)
            with open("/proc/self/comm", "wb") as name:
                name.write(b") \xff\x80 (")
            print(os.getpid(), flush=True)
            time.sleep(600)
        os._exit(0)
    time.sleep(float(sys.argv[1]))
    return 7

sys.exit(supervised(work))
"""


def is_running(number: int) -> bool:
    """Whether a process is there and no zombie."""
    state = Path(f"/proc/{number}/stat")
    return state.exists() and state.read_text(errors="replace").rpartition(") ")[2][0] != "Z"


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="Linux knows reapers")
@pytest.mark.parametrize("asked", [False, True])
def test_what_detaches_ends_with_its_command(asked: bool) -> None:
    words = [sys.executable, "-c", DETACHED, "600" if asked else "0.2"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True, cwd=Path(__file__).parents[2]) as process:
        assert process.stdout is not None
        detached = int(process.stdout.readline())
        assert is_running(detached)
        if asked:
            process.terminate()
        assert process.wait(30) == (128 + signal.SIGTERM if asked else 7)
        assert not is_running(detached)


CHAIN = """
import os, sys, time
from robosmi.cli.supervised import supervised

def work():
    if os.fork() == 0:
        end = time.monotonic() + 60
        while time.monotonic() < end:
            if sys.argv[1] == "leaves":
                os.setsid()
            if os.fork():
                os._exit(0)
        os._exit(0)
    return 7

sys.exit(supervised(work))
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="Linux knows reapers")
@pytest.mark.parametrize("group", ["stays", "leaves"])
def test_a_chain_of_processes_that_each_start_the_next_ends_with_its_command(group: str) -> None:
    words = [sys.executable, "-c", CHAIN, group]
    with subprocess.Popen(words, stdout=subprocess.PIPE, cwd=Path(__file__).parents[2]) as process:
        assert process.stdout is not None
        try:
            assert process.wait(GRACE_S) == 7
        finally:
            process.kill()
        began = time.monotonic()
        assert process.stdout.read() == b""  # until the last that holds it has ended
        assert time.monotonic() - began < 1


WRITES_DATA = """
import sys
from pathlib import Path
from robosmi.cli import confined, landlock
root, own, data = map(Path, sys.argv[1:])
landlock.restrict(confined.allowed(root, own, data))
for place in (root, own, data / "runs", data, data / "trusted", data / "templates", data.parent, data.parent / "other-call"):
    try:
        place.mkdir(exist_ok=True)
        (place / "a").write_text("a")
        print(place.name)
    except PermissionError:
        pass
"""


def test_a_call_writes_neither_into_the_data_nor_into_another_call(tmp_path: Path) -> None:
    require_landlock()
    for place in ("root", "own", "data/runs", "other-call"):
        (tmp_path / place).mkdir(parents=True)
    words = [sys.executable, "-c", WRITES_DATA, *(str(tmp_path / name) for name in ("root", "own", "data"))]
    done = subprocess.run(words, capture_output=True, text=True, cwd=Path(__file__).parents[2], check=False)
    assert done.stdout.split() == ["root", "own", "runs"], done.stderr


def test_what_a_compiler_leaves_in_the_data_goes_with_its_call(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    own = tmp_path / "own"
    own.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(own))

    async def talk(call: Call) -> None:
        assert (await call("migrate", files=["blink.c"], out="out"))["exit_code"] == 0
        (data,) = own.glob("*/data/runs")
        before = {path.name: path.read_bytes() for path in data.iterdir()}
        assert before
        for name in ("compile", "verify"):
            await call(name, out="out")
            assert {path.name: path.read_bytes() for path in data.iterdir()} == before, name

    with Commands(RootFolder(root), 120, confined=bool(landlock.version())) as commands:
        ask(commands, talk)


def test_an_original_reaches_nothing_through_the_server(root: Path, tmp_path: Path, commands: Commands) -> None:
    require_landlock()
    require_tools("avr-gcc", "arduino-core-avr", "gcc-32-bits")
    require_engine("simavr")
    outside = root.parent / "outside"
    text = (Path(__file__).parent / "mcp_attack" / "sock.c").read_text()
    for word, meant in (("OUTSIDE", str(outside)), ("ROOT", str(root)), ("SERVER", str(os.getpid()))):
        text = text.replace(word, meant)
    (root / "sock.c").write_text(text)

    async def talk(call: Call) -> None:
        made = await call("migrate", files=["sock.c"], out="out", hardware="wiring.csv", bind=["P26=D13"])
        assert made["exit_code"] in (0, 1), made
        found = await call("verify", out="out", scenarios=["short.toml"])
        assert found["exit_code"] in (1, 6), found

    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind(str(outside / "sock"))
        listening.listen()
        listening.setblocking(False)
        ask(commands, talk)
        with pytest.raises(BlockingIOError):
            listening.accept()
    assert not (outside / "written").exists()
    assert not (root / "written").exists()


@pytest.mark.processes
def test_no_call_finds_what_another_has_cached(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own = tmp_path / "own"
    own.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(own))

    async def talk(call: Call) -> None:
        assert (await call("migrate", files=["blink.c"], out="out"))["exit_code"] == 0
        left = [path.relative_to(own).parts for path in own.rglob("*") if path.is_file()]
        assert all(parts[1] == "data" for parts in left), left

    with Commands(RootFolder(root), 120, confined=bool(landlock.version())) as commands:
        ask(commands, talk)


def test_the_command_says_what_is_missing(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert run("mcp").code == 2
    assert run("mcp", "--root", root / "gone").code == 3
    assert run("mcp", "--root", root, "--json").code == 2
    assert run("mcp", "--root", root, "--limit", "0").code == 2
    monkeypatch.setattr(landlock, "version", lambda: 0)
    outcome = run("mcp", "--root", root)
    assert outcome.code == 4
    assert "--unconfined" in outcome.err
    monkeypatch.setitem(sys.modules, "mcp.server", None)
    outcome = run("mcp", "--root", root)
    assert outcome.code == 4
    assert "robosmi[mcp]" in outcome.err
