"""What several commands share: options, pairs `NAME=VALUE`, the project file's place, models stored where the user wants them."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import StoppedError, UsageError
from robosmi.files.files import ANOTHER_NAME, refuse_link

if TYPE_CHECKING:
    from robosmi.cli.options import Options
    from robosmi.model.elements.ecore import EObject


def add_source_options(parser: Options) -> None:
    """The options that say how a program is read."""
    parser.add_argument("files", nargs="+", metavar="FILE", type=Path, help="source file(s) of one program")
    parser.add_argument("--source-platform", metavar="NAME", help="platform that the program is written for")
    parser.add_argument(
        "-I", dest="include_dirs", action="append", default=[], metavar="DIR", type=Path, help="folder with headers"
    )
    parser.add_argument("-D", dest="defines", action="append", default=[], metavar="NAME", help="define a macro")


def add_source_board(parser: Options) -> None:
    """The option that names the board that a program runs on today."""
    parser.add_argument("--from", dest="source_board", metavar="NAME", help="board that the program runs on today")


def output_folder(text: str) -> Path:
    """The output folder that an option names; an empty text, as of an unset variable, would mean the current folder.

    Raises:
        UsageError: it is empty, or no path.
    """
    if not text.strip() or "\0" in text:
        raise UsageError("the name of the output folder is empty", fix="give a folder: -o OUT (or -o . for the current one)")
    return Path(text)


def command_line(command: str, *words: str | Path) -> str:
    """A command of `robosmi` as the user types it in a POSIX shell."""
    return shlex.join(["robosmi", command, *map(str, words)])


def pairs(texts: list[str], option: str) -> dict[str, str]:
    """`NAME=VALUE` texts as a dict.

    Raises:
        UsageError: a text has no `=`, or a name comes twice with different values.
    """
    result: dict[str, str] = {}
    for text in texts:
        name, equals, value = text.partition("=")
        if not equals or not name.strip() or not value.strip():
            raise UsageError(f"{option} {text}: not of the form NAME=VALUE", fix=f'write {option} "NAME=VALUE"')
        if result.setdefault(name.strip(), value.strip()) != value.strip():
            raise UsageError(f"{option} gives '{name.strip()}' two values", fix="give only one of them")
    return result


HEAD = 2048
"""The number of bytes that identify a file's kind."""


def check_replaced(path: Path | None, mark: bytes, what: str) -> None:
    """Make sure that a result is not written over a file of another kind, such as what it was made from, nor over a link.

    Args:
        path: where the result is to go; None for nowhere.
        mark: what stands at the beginning of every file of its kind.
        what: its kind, for the message.

    Raises:
        StoppedError: there is a file of another kind, or a link.
    """
    try:
        if path is None:
            return
        refuse_link(path)
        with inputs.open_file(path) as stream:
            head = stream.read(HEAD)
    except OSError:  # it is not there, or writing it will say what is wrong
        return
    if head.strip() and mark not in head:
        raise StoppedError(f"a file exists there that is not a {what}", location=Location(str(path)), fix=ANOTHER_NAME)


def check_model_replaced(path: Path) -> None:
    """Make sure that a model is not written over a file that is no model in the form of its name; see `check_replaced`."""
    from robosmi.model.xmi.text_forms import is_json, is_yaml

    check_replaced(path, b"eClass" if is_json(path) or is_yaml(path) else b"http://www.omg.org/", "model")


def write_model(root: EObject, path: Path) -> dict[str, str]:
    """Store a model where the user wants it; the artifact's entry of the report."""
    from robosmi.model import save_model

    check_model_replaced(path)
    save_model(root, path)
    return {"path": str(path), "kind": "model"}
