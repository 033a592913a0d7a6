"""The language server: what the content's editor says of the open texts, in the terms of the protocol.

A text is examined when the typing pauses. One thread has the texts and answers all questions about them in their order, so that
the conversation goes on meanwhile.
"""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from lsprotocol import types as lsp
from pygls.lsp.server import LanguageServer
from pygls.uris import from_fs_path, to_fs_path

from robosmi import __version__, inputs
from robosmi.cli.main import as_error, as_finding
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.plugins import content

if TYPE_CHECKING:
    from robosmi.cli.answers import EditedTexts

A = TypeVar("A")
T = TypeVar("T")
PAUSE_S = 0.2
"""How long the typing rests before a text is examined."""
_LEVELS = {
    Severity.error: lsp.DiagnosticSeverity.Error,
    Severity.warning: lsp.DiagnosticSeverity.Warning,
    Severity.info: lsp.DiagnosticSeverity.Information,
}


def make_server() -> LanguageServer:
    """The server, ready to be started."""
    server = LanguageServer("robosmi", __version__, text_document_sync_kind=lsp.TextDocumentSyncKind.Full)
    service = _Service(server, content("chain", "editor")())
    server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)(_function(service.opened))
    server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)(_function(service.changed))
    server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)(_function(service.closed))
    options = lsp.CompletionOptions(trigger_characters=['"', "[", ","])
    server.feature(lsp.TEXT_DOCUMENT_COMPLETION, options)(_function(service.complete))
    kinds = lsp.CodeActionOptions(code_action_kinds=[lsp.CodeActionKind.QuickFix])
    server.feature(lsp.TEXT_DOCUMENT_CODE_ACTION, kinds)(_function(service.actions))
    return server


def _function(method: Callable[[A], Awaitable[T]]) -> Callable[[A], Awaitable[T]]:
    """A method as pygls takes it, which marks what it is given."""

    async def answer(about: A) -> T:
        return await method(about)

    return answer


class _Service:
    """Answers one editor.

    Attributes:
        waiting: the texts that are about to be examined.
        shown: the files that findings about a text are shown at.
    """

    def __init__(self, server: LanguageServer, editor: EditedTexts) -> None:
        self.server, self.editor = server, editor
        self.waiting = dict[Path, asyncio.Task[None]]()
        self.shown = dict[Path, set[Path]]()
        self.worker = ThreadPoolExecutor(1)

    async def opened(self, about: lsp.DidOpenTextDocumentParams) -> None:
        """Examine a text."""
        self._take(about.text_document.uri)

    async def changed(self, about: lsp.DidChangeTextDocumentParams) -> None:
        """Examine a text once the typing pauses."""
        self._take(about.text_document.uri)

    async def closed(self, about: lsp.DidCloseTextDocumentParams) -> None:
        """Forget a text; what is in its file counts again."""
        if (path := _path(about.text_document.uri)) is not None:
            if (task := self.waiting.pop(path, None)) is not None:
                task.cancel()
            self.worker.submit(self.editor.texts.pop, path, None)
            self._publish(path, [])

    async def complete(self, about: lsp.CompletionParams) -> lsp.CompletionList:
        """What may stand at a place."""
        uri, at = about.text_document.uri, about.position
        path, document = _path(uri), self.server.workspace.get_text_document(uri)
        if path is None:
            return lsp.CompletionList(False, [])
        line = document.lines[at.line] if at.line < len(document.lines) else ""
        column = document.position_codec.position_from_client_units([line], lsp.Position(0, at.character)).character
        start, found = await self._asked(lambda: self.editor.suggestions(path, at.line, column)) or (column, [])
        units = document.position_codec.client_num_units
        # an editor ends a quoted word itself
        end = column + len(line[column:].rstrip("\r\n")) if line[column:].strip() in ('"', "'", "]") else column
        span = lsp.Range(lsp.Position(at.line, units(line[:start])), lsp.Position(at.line, units(line[:end])))
        items = [
            lsp.CompletionItem(
                each.text, detail=each.detail or None, text_edit=lsp.TextEdit(span, each.text), filter_text=each.text,
                sort_text=f"{number:05}",
            )
            for number, each in enumerate(found)
        ]  # fmt: skip
        return lsp.CompletionList(False, items)

    async def actions(self, about: lsp.CodeActionParams) -> list[lsp.CodeAction]:
        """The choices that can be made here, each as a change of the project file."""
        path = _path(about.text_document.uri)
        if path is None:
            return []
        found = await self._asked(lambda: self.editor.answers(path, about.range.start.line)) or []
        lines = self.server.workspace.get_text_document(about.text_document.uri).source.count("\n") + 1
        whole = lsp.Range(lsp.Position(0, 0), lsp.Position(lines, 0))
        return [
            lsp.CodeAction(
                each.title, kind=lsp.CodeActionKind.QuickFix, is_preferred=each.best,
                edit=lsp.WorkspaceEdit({about.text_document.uri: [lsp.TextEdit(whole, each.text)]}),
            )
            for each in found
        ]  # fmt: skip

    def _take(self, uri: str) -> None:
        path = _path(uri)
        if path is None:
            return
        document = self.server.workspace.get_text_document(uri)
        self.worker.submit(self.editor.texts.update, {path: document.source})
        if (task := self.waiting.get(path)) is not None:
            task.cancel()
        self.waiting[path] = asyncio.create_task(self._examine(path, document.version))

    async def _examine(self, path: Path, version: int | None) -> None:
        await asyncio.sleep(PAUSE_S)
        done = await self._asked(lambda: self.editor.examine(path))
        if done is not None:
            self._publish(path, [*map(as_finding, done.errors), *done.findings], version)

    async def _asked(self, question: Callable[[], T]) -> T | None:
        """The editor's answer; None where it fails, which the log says: a server that ended would answer nothing more."""
        try:
            return await asyncio.get_running_loop().run_in_executor(self.worker, question)
        except Exception as error:
            self.server.window_log_message(lsp.LogMessageParams(lsp.MessageType.Error, as_error(error).message))
            return None

    def _publish(self, path: Path, findings: Sequence[Finding], version: int | None = None) -> None:
        """Show findings at their files, and take back those shown before; the examined text comes last."""
        by_file: dict[Path, list[Finding]] = {}
        for finding in findings:
            by_file.setdefault(_file(finding, path), []).append(finding)
        for file in [*sorted({*self.shown.get(path, ()), *by_file} - {path}), path]:
            lines = self._lines(file)
            told = [_diagnostic(finding, file, lines) for finding in by_file.get(file, [])]
            about = lsp.PublishDiagnosticsParams(str(from_fs_path(str(file))), told, version if file == path else None)
            self.server.text_document_publish_diagnostics(about)
        self.shown[path] = {*by_file}

    def _lines(self, file: Path) -> list[str]:
        try:
            return (self.editor.texts.get(file) or inputs.read_text(file, inputs.SOURCE)).splitlines()
        except (OSError, ValueError):  # a drawing is no text
            return []


def _path(uri: str) -> Path | None:
    found = to_fs_path(uri) if uri.startswith("file:") else None
    return Path(found) if found else None


def _file(finding: Finding, text: Path) -> Path:
    """The file at which a finding is shown: its own, else the one whose text it was found by."""
    own = Path(finding.location.path).absolute() if finding.location is not None else text
    return own if own.is_file() else text


def _diagnostic(finding: Finding, file: Path, lines: Sequence[str]) -> lsp.Diagnostic:
    place, advice = finding.location, f"\n{finding.fix}" if finding.fix else ""
    message, words = finding.message, finding.message.split("'")[1::2]
    if place is not None and Path(place.path).absolute() != file:  # of a file that is missing
        words = [Path(place.path).name]
        message, place = f"{words[0]}: {message}", None
    span, level = _range(place, _quoted(words, lines), lines), _LEVELS[finding.severity]
    return lsp.Diagnostic(span, f"{message}{advice}", severity=level, code=finding.rule, source="robosmi")


def _range(place: Location | None, otherwise: int, lines: Sequence[str]) -> lsp.Range:
    """A place in lines, whose columns count bytes; a line where it has none."""
    number = place.line - 1 if place is not None and place.line else otherwise
    line = lines[number] if number < len(lines) else ""
    first, last = len(line) - len(line.lstrip()), len(line.encode())
    if place is not None and place.column:
        first = place.column - 1
        last = place.end_column - 1 if place.end_column and place.end_line in (None, place.line) else last
    return lsp.Range(
        lsp.Position(number, _units(line, first)), lsp.Position(number, max(_units(line, first), _units(line, last)))
    )


def _units(line: str, column: int) -> int:
    """A column in bytes as one in units of UTF-16."""
    return len(line.encode()[:column].decode("utf-8", "ignore").encode("utf-16-le")) // 2


def _quoted(words: Sequence[str], lines: Sequence[str]) -> int:
    """The first line that has one of the words; the first of all where none has."""
    return next((number for word in words if word for number, line in enumerate(lines) if word in line), 0)
