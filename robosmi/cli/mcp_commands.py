"""Commands that the MCP server runs: each in a process of its own, confined to the root folder, with a limit of time.

The answer is the command's JSON document. Where a command gives none, since it was stopped or cannot be started, the document
is made here, in the same form.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Any

import anyio
import anyio.abc

from robosmi.base.data_text import as_table, json_of
from robosmi.cli.root_folder import LONGEST, RootFolder, is_text
from robosmi.cli.supervised import GRACE_S
from robosmi.diagnostics import Finding, Severity
from robosmi.errors import RobosmiError
from robosmi.report.document import SCHEMA

_KEPT = ("PATH", "LANG", "LC_ALL", "SYSTEMROOT", "ROBOSMI_NPM")
"""The variables of the server's environment that a command gets."""
_GRACE_S = GRACE_S + 3
"""Seconds that a process has to end in order: its supervisor kills what it runs before."""
_RECORDING = frozenset({"migrate", "generate", "choose"})
"""Commands that change a folder of results, whose records the next call relies on."""
_WORD = 9
"""Bytes that the system takes for a word beside its text."""


class Commands:
    """Runs commands in a root folder.

    A context manager: at its end the temporary data goes.

    Args:
        root: the folder.
        limit_s: seconds after which a command is ended.
        confined: whether the kernel holds the commands to the folder (see `confined`); else only named paths are looked at.

    Attributes:
        root: the folder.
        limit_s: as given.
        confined: as given.
    """

    def __init__(self, root: RootFolder, limit_s: float, *, confined: bool) -> None:
        self.root = root
        self.limit_s = limit_s
        self.confined = confined
        self._own = tempfile.TemporaryDirectory(prefix="robosmi-mcp-")
        self._data = Path(self._own.name) / "data"
        (self._data / "runs").mkdir(parents=True)

    async def run(self, command: str, words: list[str]) -> dict[str, Any]:
        """Run one command; the document that it prints with `--json`, with its `exit_code`.

        Args:
            command: its name.
            words: its options and arguments.
        """
        if too_long := next((word for word in words if len(word) > LONGEST), None):
            message = f"an argument has {len(too_long)} characters: '{too_long[:60]}...'"
            return refusal(command, "RS901", 2, message, f"give at most {LONGEST} characters")
        if any(not is_text(word) for word in words):
            return refusal(command, "RS901", 2, "an argument is not a text", "remove NUL and surrogates (U+D800 to U+DFFF)")
        if (size := sum(len(word.encode()) + _WORD for word in words)) > (most := os.sysconf("SC_ARG_MAX") // 2):
            return refusal(command, "RS901", 2, f"the arguments have {size} bytes in total", f"give at most {most} bytes")
        with tempfile.TemporaryDirectory(dir=self._own.name, prefix="call-") as temporary:
            data = self._data
            if command not in _RECORDING:  # so that no compiler or program that it starts changes the records
                data = _copied(self._data, Path(temporary) / "data")
            program = ["robosmi.cli.confined", str(self.root.path), temporary, str(data)] if self.confined else ["robosmi"]
            process = await anyio.open_process(
                [sys.executable, "-P", "-m", *program, command, "--json", *words], cwd=self.root.path, stdin=subprocess.DEVNULL,
                env=self._environment(data, temporary), start_new_session=True,
            )  # fmt: skip
            said, complained = bytearray(), bytearray()
            try:
                with anyio.move_on_after(self.limit_s) as in_time:
                    async with anyio.create_task_group() as both:
                        both.start_soon(_collect, process.stdout, said)
                        both.start_soon(_collect, process.stderr, complained)
                    await process.wait()
            finally:
                with anyio.CancelScope(shield=True):
                    await _end(process)
        if in_time.cancelled_caught:
            message = f"{command} exceeded {self.limit_s:g} s and was stopped; no file is half-written"
            return refusal(command, "RS902", 3, message, "give it less work, or start the server with a longer --limit")
        try:
            document = as_table(json_of(bytes(said)))
            return {**document, "exit_code": process.returncode}
        except (ValueError, TypeError):
            last = (complained.decode(errors="replace").strip().splitlines() or ["no message"])[-1]
            return refusal(command, "RS970", 70, f"{command} printed no JSON document: {last}", "report this bug")

    def _environment(self, data: Path, temporary: str) -> dict[str, str]:
        """No data of the person's is in it: neither earlier choices nor what was imported, trusted or named by ROBOSMI_PATH.

        The cache, which holds programs and code, and the history belong to the call alone, so that no call uses what an earlier
        one has left.
        """
        import robosmi

        kept = {name: os.environ[name] for name in _KEPT if name in os.environ}
        package = str(Path(robosmi.__file__).resolve().parents[1])
        return kept | {
            "HOME": temporary, "ROBOSMI_HOME": str(data), "ROBOSMI_HISTORY": f"{temporary}/history.sqlite",
            "XDG_CACHE_HOME": f"{temporary}/cache", "TMPDIR": temporary, "PYTHONPATH": package,
            "PYTHONUTF8": "1", "NO_COLOR": "1",
        }  # fmt: skip

    def __enter__(self) -> Commands:
        return self

    def __exit__(self, *_: object) -> None:
        self._own.cleanup()


def _copied(data: Path, to: Path) -> Path:
    (to / "runs").mkdir(parents=True)
    for record in (data / "runs").iterdir():
        with suppress(FileNotFoundError):  # another call has just put its record in place
            shutil.copyfile(record, to / "runs" / record.name)
    return to


async def _collect(stream: anyio.abc.ByteReceiveStream | None, into: bytearray) -> None:
    if stream is not None:
        async for piece in stream:
            into += piece


async def _end(process: anyio.abc.Process) -> None:
    """End a process as Ctrl-C does, so that it ends what it has started and puts its files in order; else by force."""
    if process.returncode is None:
        process.send_signal(signal.SIGTERM)
        with anyio.move_on_after(_GRACE_S):
            await process.wait()
    if process.returncode is None:
        process.kill()
        await process.wait()
    for stream in (process.stdout, process.stderr):
        if stream is not None:
            await stream.aclose()


def usage_error(command: str, error: RobosmiError) -> dict[str, Any]:
    """The document for arguments that are refused before the command runs."""
    return refusal(command, "RS901", error.exit_code, error.message, error.fix)


def refusal(command: str, rule: str, exit_code: int, message: str, fix: str | None) -> dict[str, Any]:
    """A document of the contract's form for a command that did not run to its end."""
    shown = message.encode("utf-8", "backslashreplace").decode()  # half of a character cannot be sent
    finding = Finding(rule, Severity.error, shown, fix=fix)
    return {
        "schema": SCHEMA, "command": command, "ok": False, "result": None, "findings": [finding.to_json()], "tasks": [],
        "artifacts": [], "timings": {"total_s": 0.0}, "exit_code": exit_code,
    }  # fmt: skip
