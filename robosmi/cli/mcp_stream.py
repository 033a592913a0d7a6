"""The MCP server's standard streams: a line that the protocol's package cannot read is answered, too.

The package drops such a line without a word, so that its sender waits for ever: text with half of a character (an escape such as
\\ud800 alone), a request of another form, no JSON at all. Here it is answered with an error of JSON-RPC. What the tools are is
said in `mcp_tools`.
"""

from __future__ import annotations

from types import TracebackType
from typing import Protocol

from anyio import EndOfStream
from mcp.server import MCPServer
from mcp.server.stdio import stdio_server
from mcp.shared.message import SessionMessage
from mcp_types import INVALID_REQUEST, PARSE_ERROR, ErrorData, JSONRPCError, JSONRPCNotification
from pydantic import ValidationError

from robosmi.data_text import Json, json_of

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
    error=ErrorData(
        code=INVALID_REQUEST, message="the request has no id that can be answered: give a text or a whole number as its id"
    ),
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
    if given is None:  # a part that the message as a whole lacks is told with the whole message
        request = next((fault["input"] for fault in faults if fault["type"] == "missing" and len(fault["loc"]) == 2), None)
        said = ErrorData(code=INVALID_REQUEST, message="the message is none of JSON-RPC 2.0: give jsonrpc, id, method and params")
        return JSONRPCError(jsonrpc="2.0", id=_identity(request), error=said)
    why = str(given["msg"]).removeprefix("Invalid JSON: ")
    try:
        request = json_of(str(given["input"]))
    except (ValueError, RecursionError):
        said = ErrorData(code=PARSE_ERROR, message=f"the line is no JSON ({why}): send one message a line, in UTF-8")
        return JSONRPCError(jsonrpc="2.0", id=None, error=said)
    advice = "leave out halves of characters (\\ud800 to \\udfff without its other half)"
    said = ErrorData(code=PARSE_ERROR, message=f"the line has an escape that is no character ({why}): {advice}")
    return JSONRPCError(jsonrpc="2.0", id=_identity(request), error=said)


def _identity(request: Json) -> int | str | None:
    """The identity of a request, where it has one that can be sent."""
    found = request.get("id") if isinstance(request, dict) else None
    if isinstance(found, str):
        return found if found.isascii() else None
    return found if isinstance(found, int) and not isinstance(found, bool) else None
