r"""The MCP server: robosmi's commands as tools for an assistant, whose paths all lie below one folder.

The arguments of a tool are those of the command; its answer is the command's JSON document with `exit_code`. How commands are run
and confined is in `mcp_commands`.

Each line on standard input gets an answer. The protocol's package drops a line that it cannot read, so that its sender waits for
ever: text with half of a character (an escape such as \ud800 alone), a request of another form, no JSON at all. Here
such a line is answered with an error of JSON-RPC.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import TracebackType
from typing import Any, Protocol

from anyio import EndOfStream
from mcp.server import MCPServer
from mcp.server.stdio import stdio_server
from mcp.shared.message import SessionMessage
from mcp_types import INVALID_REQUEST, PARSE_ERROR, ErrorData, JSONRPCError, JSONRPCNotification, ToolAnnotations
from pydantic import ValidationError

from robosmi import __version__
from robosmi.base.data_text import Json, json_of
from robosmi.cli.mcp_commands import Commands, usage_error
from robosmi.errors import RobosmiError, UsageError

INSTRUCTIONS = """\
RoboSMi moves a robot's C program to another board by models. All paths are below the root folder, relative to it.

1. analyse: what the program uses of its platform. hardware: which pin of the drawing drives what.
2. migrate: generates OUT with the sketch, the plan and a list of remaining work; result.plan.choices[] are open decisions.
3. choose (or migrate with bind and library): settle a decision by its id and the value of one of its options. plan_show: the
   plan.
4. Write bodies of adapters in OUT/NAME/adapters.h, where a TODO stands; then generate, which preserves and counts them.
5. compile: build for the board and report the size. verify: compare with the original and report the first difference.

A body is right only when verify reports no-difference-found. explain describes a finding's rule. Findings
have a place, a cause (message) and what to do (fix); exit_code 0 is done, 1 findings, 2 arguments, 3 input, 4 a missing tool,
5 stopped, 6 does not compile or differs.
"""
READS = ToolAnnotations(read_only_hint=True, open_world_hint=False)
WRITES = ToolAnnotations(read_only_hint=False, destructive_hint=False, idempotent_hint=True, open_world_hint=False)

Document = dict[str, Any]


class Tools:
    """The tools, as methods with the types and texts that an assistant is shown.

    Args:
        commands: runs the commands.
    """

    def __init__(self, commands: Commands) -> None:
        self._commands = commands
        self._path = commands.root.relative

    async def analyse(
        self, files: list[str], source_platform: str | None = None, include_dirs: list[str] | None = None,
        defines: list[str] | None = None,
    ) -> Document:  # fmt: skip
        """List what a C program uses of its platform: calls, pins, code on other cores, undeclared functions.

        files: the sources of one program. include_dirs: folders with headers. defines: macros, NAME or NAME=VALUE.
        """
        return await self._run("analyse", lambda: self._source(files, source_platform, include_dirs, defines))

    async def hardware(self, sketch: str) -> Document:
        """List which pin of the drawn board drives which component, and electrical errors in the wiring.

        sketch: a drawing or a pin table.
        """
        return await self._run("hardware", lambda: [self._path(sketch)])

    async def recommend(self, sketch: str | None = None, components: str | None = None, ranker: str | None = None) -> Document:
        """Recommend libraries for each component, with reasons; give a drawing or a JSON file of components."""
        return await self._run(
            "recommend",
            lambda: [
                *([self._path(sketch)] if sketch is not None else []),
                *_option("--components", self._path(components) if components is not None else None),
                *_option("--ranker", ranker),
            ],
        )

    async def migrate(
        self, files: list[str], out: str, hardware: str | None = None, target: str | None = None,
        source_platform: str | None = None, include_dirs: list[str] | None = None, defines: list[str] | None = None,
        library: list[str] | None = None, bind: list[str] | None = None, adapters: str | None = None, widths: str | None = None,
        bench: bool = False, dry_run: bool = False, strict: bool = False, source_board: str | None = None,
    ) -> Document:  # fmt: skip
        """Move a program to the board of a drawing: generates the folder out with sketch, plan and remaining tasks.

        hardware: the drawing or pin table. library: COMPONENT=LIBRARY. bind: NAME=PIN, for a port of the source. adapters:
        filled or placeholders. widths: fix or keep. source_board: that a sketch runs on today.
        Edits in out that you made are kept, or it stops. Nothing is asked; decisions that nobody has made stay open
        (result.plan.choices).
        """
        return await self._run(
            "migrate",
            lambda: [
                *self._source(files, source_platform, include_dirs, defines), "-o", self._path(out), "--yes",
                *_option("--hardware", self._path(hardware) if hardware is not None else None), *_option("--target", target),
                *_option("--from", source_board),
                *_options("--library", library), *_options("--bind", bind), *_option("--adapters", adapters),
                *_option("--widths", widths), *_flags(bench=bench, dry_run=dry_run, strict=strict),
            ],
        )  # fmt: skip

    async def plan_show(self, plan: str) -> Document:
        """Show the stored plan of a migration (OUT/models/plan.xmi): choices, bindings, tasks. Writes nothing."""
        return await self._run("generate", lambda: [self._path(plan), "-o", self._out_of(plan), "--dry-run"])

    async def choose(self, out: str, answers: dict[str, str], why: str = "") -> Document:
        """Change decisions of a migration and update the sketch.

        answers: id of a choice (result.plan.choices[].id) to the value of one of its options, to `none` for a port that is not
        wired, or to an empty text to open it again. why: the reason, kept with the decision.
        """
        words = [f"{choice}={value}" for choice, value in answers.items() if value]
        again = [choice for choice, value in answers.items() if not value]
        return await self._run(
            "choose",
            lambda: [
                self._path(out), *_no_options(words), *_options("--reopen", again), *_option("--why", why or None),
            ],
        )  # fmt: skip

    async def generate(self, plan: str, out: str, bench: bool = False, dry_run: bool = False, strict: bool = False) -> Document:
        """Generate the sketch from a stored plan, edited or not, and the models next to it."""
        return await self._run(
            "generate",
            lambda: [self._path(plan), "-o", self._path(out), *_flags(bench=bench, dry_run=dry_run, strict=strict)],
        )

    async def compile(self, out: str, board: str | None = None) -> Document:
        """Compile a generated sketch with the target's toolchain; report errors, flash and RAM, and whether it fits the board."""
        return await self._run("compile", lambda: [self._path(out), *_option("--board", board)])

    async def verify(
        self, out: str, scenarios: list[str] | None = None, engine: str | None = None, seed: int = 1
    ) -> Document:  # fmt: skip
        """Run the original and the migrated program under the same scenarios, and compare pins and texts.

        The answer has a verdict, and a first_difference with its time, channel and call of the source.
        scenarios: files; without any, stored and generated ones, which takes minutes.
        """
        more = [word for path in scenarios or () for word in ("--scenario", path)]
        return await self._run(
            "verify",
            lambda: [
                self._path(out), *(self._path(w) if w != "--scenario" else w for w in more), *_option("--engine", engine),
                f"--seed={seed}",
            ],
        )  # fmt: skip

    async def explain(self, rule: str) -> Document:
        """Explain a rule (RS311, or its name), with an example and what to do."""
        return await self._run("explain", lambda: _no_options([rule]))

    def _source(
        self, files: Sequence[str], source_platform: str | None, include_dirs: Sequence[str] | None,
        defines: Sequence[str] | None,
    ) -> list[str]:  # fmt: skip
        if not files:
            raise UsageError("no source files are given", fix="give the program's source files")
        folders = [word for path in include_dirs or () for word in ("-I", self._path(path))]
        macros = [f"-D{macro}" for macro in defines or ()]
        return [*(self._path(file) for file in files), *_option("--source-platform", source_platform), *folders, *macros]

    def _out_of(self, plan: str) -> str:
        """The output folder of a stored plan, two above it."""
        place = self._path(plan).split("/")
        return "/".join(place[:-2]) or "."

    async def _run(self, command: str, words: Callable[[], list[str]]) -> Document:
        try:
            found = words()
        except RobosmiError as error:
            return usage_error(command, error)
        return await self._commands.run(command, found)


def make_server(commands: Commands) -> Server:
    """The server with all its tools.

    Args:
        commands: runs the commands.
    """
    held = (
        "confined to the root folder by the kernel (Landlock), without TCP" if commands.confined else "NOT confined by the kernel"
    )
    native = (
        f"Runs native code: the original is compiled for this machine and run with the server's account, {held}; "
        f"a call ends after {commands.limit_s:g} s."
    )
    server = Server(
        "robosmi", title="RoboSMi", version=__version__, instructions=f"{INSTRUCTIONS}\nverify. {native}\n", log_level="WARNING"
    )
    tools = Tools(commands)
    for tool, about in (
        (tools.analyse, READS), (tools.hardware, READS), (tools.recommend, READS), (tools.plan_show, READS),
        (tools.explain, READS), (tools.migrate, WRITES), (tools.choose, WRITES), (tools.generate, WRITES),
        (tools.compile, WRITES),
    ):  # fmt: skip
        server.tool(annotations=about)(tool)
    server.tool(annotations=WRITES, description=f"{tools.verify.__doc__}\n\n{native}")(tools.verify)
    return server


def _option(name: str, value: str | None) -> list[str]:
    return [f"{name}={value}"] if value is not None else []


def _options(name: str, values: Sequence[str] | None) -> list[str]:
    return [f"{name}={value}" for value in values or ()]


def _flags(**asked: bool) -> list[str]:
    return [f"--{name.replace('_', '-')}" for name, wanted in asked.items() if wanted]


def _no_options(words: list[str]) -> list[str]:
    """The words, if none of them is an option of the command.

    Raises:
        UsageError: one begins like an option.
    """
    if odd := next((word for word in words if word.startswith("-") or not word), None):
        raise UsageError(f"'{odd[:60]}' is neither a rule nor a choice", fix="give a name")
    return words


# ---- messages that cannot be read

Item = SessionMessage | Exception


class Incoming(Protocol):
    """What messages are read from: each, or the error of a line that is none."""

    async def receive(self) -> Item:
        """The next one; EndOfStream behind the last."""

    async def aclose(self) -> None:
        """Read no more."""


class Outgoing(Protocol):
    """The end of a stream that takes the messages for the client."""

    async def send(self, item: SessionMessage, /) -> None:
        """Send one."""


class Server(MCPServer):
    """A server that leaves no line on standard input without an answer."""

    async def run_stdio_async(self) -> None:
        """Serve until standard input ends."""
        async with stdio_server() as (incoming, outgoing):
            options = self._lowlevel_server.create_initialization_options()
            await self._lowlevel_server.run(Answered(incoming, outgoing), outgoing, options)


class Answered:
    """The messages that are read, without the lines that are none: those are answered.

    Args:
        incoming: the messages.
        outgoing: where answers go.
    """

    def __init__(self, incoming: Incoming, outgoing: Outgoing) -> None:
        self._incoming, self._outgoing = incoming, outgoing

    async def receive(self) -> Item:
        """The next message; EndOfStream behind the last."""
        while True:
            item = await self._incoming.receive()
            if isinstance(item, SessionMessage) and not _is_lost_request(item):
                return item
            answer = answer_to(item) if isinstance(item, Exception) else _NO_IDENTITY
            await self._outgoing.send(SessionMessage(answer))

    async def aclose(self) -> None:
        """Read no more."""
        await self._incoming.aclose()

    def __aiter__(self) -> Answered:
        return self

    async def __anext__(self) -> Item:
        try:
            return await self.receive()
        except EndOfStream:
            raise StopAsyncIteration from None

    async def __aenter__(self) -> Answered:
        return self

    async def __aexit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        await self.aclose()


_NO_IDENTITY = JSONRPCError(
    jsonrpc="2.0",
    id=None,
    error=ErrorData(code=INVALID_REQUEST, message="the request's id is not usable: give a text or a whole number"),
)


def _is_lost_request(item: SessionMessage) -> bool:
    """Whether a message is a request that the package took for a notification, as its id is neither a text nor a whole number."""
    message = item.message
    return isinstance(message, JSONRPCNotification) and not message.method.startswith("notifications/")


def answer_to(error: Exception) -> JSONRPCError:
    """The answer to a line that is no message, under the identity of its request where it has one.

    Args:
        error: why it is none.
    """
    faults = error.errors(include_url=False) if isinstance(error, ValidationError) else []
    given = next((fault for fault in faults if fault["type"] == "json_invalid"), None)
    if given is None:  # a part that the message as a whole lacks is reported with the whole message
        request = next((fault["input"] for fault in faults if fault["type"] == "missing" and len(fault["loc"]) == 2), None)
        said = ErrorData(code=INVALID_REQUEST, message="the message is not JSON-RPC 2.0: give jsonrpc, id, method and params")
        return JSONRPCError(jsonrpc="2.0", id=_identity(request), error=said)
    why = str(given["msg"]).removeprefix("Invalid JSON: ")
    try:
        request = json_of(str(given["input"]))
    except (ValueError, RecursionError):
        said = ErrorData(code=PARSE_ERROR, message=f"the line is not JSON ({why}): send one message per line, in UTF-8")
        return JSONRPCError(jsonrpc="2.0", id=None, error=said)
    advice = "remove surrogates (\\ud800 to \\udfff without its other half)"
    said = ErrorData(code=PARSE_ERROR, message=f"the line has an escape that is not a character ({why}): {advice}")
    return JSONRPCError(jsonrpc="2.0", id=_identity(request), error=said)


def _identity(request: Json) -> int | str | None:
    """The identity of a request, where it has one that can be sent."""
    found = request.get("id") if isinstance(request, dict) else None
    if isinstance(found, str):
        return found if found.isascii() else None
    return found if isinstance(found, int) and not isinstance(found, bool) else None
