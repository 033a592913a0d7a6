"""Serves a page on this machine for one person: on 127.0.0.1 only, under an address that contains a random word.

It uses the standard library's server. Every request has to name this host, and every change has to come from the page itself;
only the page and its actions are served, no files. The page is passed in as a `Content`.
"""

from __future__ import annotations

import secrets
import socket
import time
from collections.abc import Mapping
from contextlib import suppress
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Lock
from typing import Any, Protocol

from robosmi.base.data_text import json_of, json_written
from robosmi.errors import RobosmiError, UsageError
from robosmi.quoting import html

HOST = "127.0.0.1"
MOST = 64 * 1024
"""Limit on the bytes of a request."""
LONGEST = 20
"""Limit on the digits of a request's content length, since Python converts only a few thousand."""
PATIENCE = 10.0
"""Seconds that a connection may take to send its request."""
MOST_WAITING = 64
"""Limit on the connections whose request is not complete; beyond it the oldest of them end."""
ACTIONS, WATCH = ("choose", "undo", "tick", "accept"), "watch"
"""What a page may ask for: the actions on what it shows, and a run of it."""
_POLICY = (
    "default-src 'none'; script-src 'nonce-{nonce}'; style-src 'nonce-{nonce}'; img-src data:; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)


class Content(Protocol):
    """What a page shows and does."""

    def now(self) -> str:
        """The word for the stored state that a request names to say what it has seen."""

    def state(self) -> dict[str, Any]:
        """Words that identify the current state and change with it."""

    def document(self, *, live: bool, nonce: str) -> str:
        """The page as HTML."""

    def act(self, what: str, about: Mapping[str, Any]) -> dict[str, Any]:
        """Do what the page asks for; its answer as JSON values."""

    def watch(self, about: Mapping[str, Any]) -> dict[str, Any]:
        """Run what the page shows side by side, which may take long; the page can do everything else meanwhile."""


class PageServer(ThreadingHTTPServer):
    """The server of one page.

    Args:
        content: what it shows and does; asked by one request at a time, but for `watch`.
        port: the port, 0 for any that is free.

    Raises:
        UsageError: the port is in use, or may not be used.
    """

    daemon_threads, request_queue_size = True, 2 * MOST_WAITING
    allow_reuse_address = True

    def __init__(self, content: Content, port: int = 0) -> None:
        self.content, self.token, self.turn = content, secrets.token_urlsafe(24), Lock()
        self._waiting, self._counted = dict[socket.socket, float](), Lock()
        if not 0 <= port <= 65535:
            raise UsageError(f"{port} is not a port", fix="give --port 1024 to 65535, or omit it to use any free port")
        try:
            if port and _answers(port):
                raise OSError("another program uses it")
            super().__init__((HOST, port), _Handler)
        except (OSError, OverflowError) as error:
            fix = "give another --port, or omit it to use any free port"
            raise UsageError(
                f"port {port} cannot be used: {(isinstance(error, OSError) and error.strerror) or error}", fix=fix
            ) from error

    @property
    def url(self) -> str:
        """The address of the page."""
        return f"http://{HOST}:{self.server_address[1]}/{self.token}/"

    @property
    def names(self) -> frozenset[str]:
        """How a request may call this host."""
        return frozenset(f"{name}:{self.server_address[1]}" for name in (HOST, "localhost"))

    def process_request(self, request: Any, client_address: Any) -> None:
        """Serve a connection in a thread of its own."""
        self.wait_for(request)
        super().process_request(request, client_address)

    def wait_for(self, connection: socket.socket) -> None:
        """A connection may send its next request; the time of a new one runs from when it came."""
        with self._counted:
            self._waiting.setdefault(connection, time.monotonic() + PATIENCE)

    def have(self, connection: socket.socket) -> None:
        """A connection has sent its request, or has ended."""
        with self._counted:
            self._waiting.pop(connection, None)

    def service_actions(self) -> None:
        """End the connections that take too long, even if every single byte comes soon, and the oldest of too many."""
        with self._counted:
            waiting = sorted(self._waiting.items(), key=lambda each: each[1])
            for number, (connection, until) in enumerate(waiting, MOST_WAITING - len(waiting)):
                if number < 0 or until < time.monotonic():
                    del self._waiting[connection]
                    with suppress(OSError):  # it has just ended by itself
                        connection.shutdown(socket.SHUT_RDWR)

    def shutdown_request(self, request: Any) -> None:
        """End a connection."""
        self.have(request)
        super().shutdown_request(request)

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A browser that goes away in the middle of an answer is no error."""


def _answers(port: int) -> bool:
    """Whether a program listens on a port already; on some systems a second one could bind it, too."""
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
        probe.settimeout(0.5)
        return probe.connect_ex((HOST, port)) == 0


class _Handler(BaseHTTPRequestHandler):
    """One connection."""

    server: PageServer
    protocol_version = "HTTP/1.1"
    timeout = PATIENCE
    server_version, sys_version = "robosmi", ""

    def handle_one_request(self) -> None:
        """Read a request, and answer it."""
        self.server.wait_for(self.connection)
        super().handle_one_request()

    def do_GET(self) -> None:
        """The page, or its state."""
        self.server.have(self.connection)
        path = self._path()
        if path == "":
            nonce = secrets.token_urlsafe(16)
            try:
                with self.server.turn:
                    text = self.server.content.document(live=True, nonce=nonce)
            except RobosmiError as error:
                self._reply(HTTPStatus.CONFLICT, f"<!DOCTYPE html><title>robosmi</title><p>{html(str(error))}</p>", "text/html")
            else:
                self._reply(HTTPStatus.OK, text, "text/html", nonce)
        elif path == "state":
            self._json(HTTPStatus.OK, self.server.content.state())
        elif path is not None:
            self._json(HTTPStatus.NOT_FOUND, _refused("page not found"))

    def do_POST(self) -> None:
        """Something that the page asks for."""
        path = self._path()
        if path is None:
            return
        origin, kind = self.headers.get("Origin", ""), self.headers.get("Content-Type", "").partition(";")[0].strip().lower()
        length = self.headers.get("Content-Length", "")
        if origin not in {f"http://{name}" for name in self.server.names}:
            self._json(HTTPStatus.FORBIDDEN, _refused("the request is not from this page"))
        elif kind != "application/json" or not length.isdecimal() or len(length) > LONGEST or int(length) > MOST:
            self._json(HTTPStatus.BAD_REQUEST, _refused("the request is malformed"))
        else:
            try:
                about = json_of(self.rfile.read(int(length)))
            except (ValueError, RecursionError):
                about = None
            self.server.have(self.connection)
            if not isinstance(about, dict) or path not in (*ACTIONS, WATCH):
                self._json(HTTPStatus.BAD_REQUEST, _refused("the request is malformed"))
                return
            if path == WATCH:
                answer = self.server.content.watch(about)
            else:
                with self.server.turn:
                    answer = self.server.content.act(path, about)
            self._json(HTTPStatus.OK, answer)

    def _path(self) -> str | None:
        """The requested path below the random word; None if the request was refused."""
        if self.headers.get("Host", "") not in self.server.names:
            self._json(HTTPStatus.FORBIDDEN, _refused("this server answers only to its own host name"))
            return None
        word, slash, path = self.path.lstrip("/").partition("/")
        if not slash or not secrets.compare_digest(word.encode(), self.server.token.encode()):
            self._json(HTTPStatus.FORBIDDEN, _refused("wrong address: use the address that robosmi open printed"))
            return None
        return path

    def _json(self, status: HTTPStatus, value: dict[str, Any]) -> None:
        self._reply(status, json_written(value), "application/json")

    def _reply(self, status: HTTPStatus, text: str, kind: str, nonce: str = "none") -> None:
        data = text.encode("utf-8", "replace")
        if status >= HTTPStatus.BAD_REQUEST:
            self.close_connection = True  # what else was sent is not read
        self.send_response(status)
        for name, value in (
            ("Content-Type", f"{kind}; charset=utf-8"), ("Content-Length", str(len(data))), ("Cache-Control", "no-store"),
            ("Content-Security-Policy", _POLICY.format(nonce=nonce)), ("X-Content-Type-Options", "nosniff"),
            ("Referrer-Policy", "no-referrer"), ("X-Frame-Options", "DENY"), ("Cross-Origin-Resource-Policy", "same-origin"),
            ("Cross-Origin-Opener-Policy", "same-origin"),
        ):  # fmt: skip
            self.send_header(name, value)
        if self.close_connection:
            self.send_header("Connection", "close")
        self.end_headers()
        self.wfile.write(data)

    def log_message(self, format: str, *args: Any) -> None:
        """Log nothing, because the address is a secret."""


def _refused(message: str) -> dict[str, Any]:
    return {"state": "refused", "message": f"Refused: {message}."}
