"""Chains in TOML: a table `[[step]]` for each step, whose kind is the key with its action (docs/reference/chains.md)."""

from __future__ import annotations

import hashlib
import importlib
import importlib.util
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from robosmi import inputs
from robosmi.base.data_text import toml_of
from robosmi.chain.chain import Chain
from robosmi.chain.steps import KINDS
from robosmi.diagnostics import Location
from robosmi.errors import RuleError, SourceError, did_you_mean
from robosmi.files.files import read_input

if TYPE_CHECKING:
    from robosmi.base.functions import Function


_KEYS: dict[str, dict[str, bool]] = {
    "load": {"file": True, "metamodel": False, "driver": False, "lenient": False},
    "validate": {"models": True, "stop_at": False},
    "transform": {"models": True, "makes": True, "metamodel": False, "file": False, "trace": False, "driver": False},
    "migrate": {"models": True, "makes": True, "metamodel": True, "file": False},
    "generate": {"models": True, "folder": True, "templates": False},
}
"""Key of each kind -> whether it must be there."""
_FLAGS = ("lenient",)
_LISTS = ("models", "metamodel", "reads")


def read_chain(path: str | Path) -> Chain:
    """A chain from a TOML file.

    Args:
        path: the file; paths in it are relative to its folder.

    Raises:
        SourceError: it cannot be read, is no TOML, or has a step or key that means nothing.
        RuleError: the code of a function cannot be imported.
    """
    file = Path(path)
    text = read_input(file, "chain", inputs.SETTINGS)
    try:
        data = toml_of(text.decode("utf-8"))
    except ValueError as error:
        raise SourceError(f"the chain is no TOML: {error}", location=Location(str(file)), fix="correct it (TOML 1.0)") from error
    place = Location(str(file))
    for key in data:
        if key != "step":
            raise _wrong(place, f"'{key}' is no table of a chain", "write each step as [[step]]")
    steps = data.get("step")
    if not isinstance(steps, list) or not steps or not all(isinstance(step, dict) for step in steps):
        raise _wrong(place, "the chain has no steps", "write each step as [[step]]")
    chain = Chain(file.parent, file.stem, place)
    for number, step in enumerate(steps, 1):
        _add(chain, dict(step), number, file.parent.resolve(), place)
    return chain


def _add(chain: Chain, step: dict[str, Any], number: int, folder: Path, place: Location) -> None:
    kinds = [key for key in step if key in KINDS]
    if len(kinds) != 1:
        known_keys = {*KINDS, "name", "reads", *(key for keys in _KEYS.values() for key in keys)}
        odd = next((f"; '{key}' is no key{did_you_mean(key, known_keys)}" for key in step if key not in known_keys), "")
        problem = f"has no action{odd}" if not kinds else f"has two actions: {' and '.join(kinds)}"
        raise _wrong(place, f"step {number} {problem}", f"give it one of the keys {', '.join(KINDS)}")
    kind = kinds[0]
    known = {**_KEYS[kind], "name": False, "reads": False}
    target = _text(place, number, kind, step.pop(kind))
    for key, value in step.items():
        if key not in known:
            raise _wrong(place, f"'{key}' is no key of {kind}{did_you_mean(key, known)}", f"use one of: {', '.join(known)}")
        if key in _FLAGS:
            if not isinstance(value, bool):
                raise _wrong(place, f"'{key}' of step {number} is neither true nor false", f"write {key} = true")
        elif not (
            isinstance(value, str) or (key in _LISTS and isinstance(value, list) and all(isinstance(v, str) for v in value))
        ):
            raise _wrong(place, f"'{key}' of step {number} is no text", f'write {key} = "VALUE"')
    for key, needed in known.items():
        if needed and key not in step:
            raise _wrong(place, f"step {number} ({kind} = '{target}') has no '{key}'", f'add {key} = "..."')
    title = step.pop("name", "")
    if kind == "load":
        if ":" in (driver := step.get("driver", "")):
            step["driver"] = function(driver, folder, place)
            code = driver.rpartition(":")[0]
            step["reads"] = [*_listed(step.get("reads", ())), *([code] if code.endswith(".py") else [])]
        chain.load(target, step=title, **step)
        return
    getattr(chain, kind)(function(target, folder, place), step=title, **step)


def _listed(names: str | Iterable[str]) -> list[str]:
    return [names] if isinstance(names, str) else list(names)


def _text(place: Location, number: int, key: str, value: Any) -> str:
    if not isinstance(value, str) or not value:
        raise _wrong(place, f"'{key}' of step {number} is no text", f'write {key} = "VALUE"')
    return value


def function(target: str, folder: Path, place: Location) -> Function:
    """The function that a text names: `rules.py:pages` (relative to a folder) or `package.module:pages`.

    Raises:
        SourceError: the text is none, or there is no such file, module or function.
        RuleError: the code raises when it is imported.
    """
    module_name, _, name = target.rpartition(":")
    if not module_name or not name.isidentifier():
        raise _wrong(place, f"'{target}' names no function", "write FILE.py:FUNCTION or package.module:FUNCTION")
    module = _module_of_file(folder / module_name, place) if module_name.endswith(".py") else _imported(module_name, place)
    found = getattr(module, name, None)
    if not callable(found):
        known = [key for key, value in vars(module).items() if callable(value) and not key.startswith("_")]
        raise _wrong(place, f"{module_name} has no function '{name}'{did_you_mean(name, known)}", "correct the name")
    return found  # type: ignore[no-any-return]


def _imported(name: str, place: Location) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise _wrong(place, f"the module '{name}' cannot be imported: {error}", "install it, or correct its name") from error


def _module_of_file(path: Path, place: Location) -> Any:
    if not path.is_file():
        raise _wrong(place, f"there is no file '{path}'", "correct the path, relative to the chain's folder")
    name = f"robosmi_chain_{hashlib.sha256(str(path).encode()).hexdigest()[:12]}"
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    before = list(sys.path)
    sys.path.insert(0, str(path.parent))  # its folder's files may be imported
    try:
        spec.loader.exec_module(module)
    except SyntaxError as error:
        where = Location(error.filename or str(path), error.lineno)
        raise RuleError(f"the code does not parse: {error.msg}", location=where, fix="correct it") from error
    except (Exception, SystemExit) as error:
        step = error.__traceback__
        line = None
        while step is not None:
            line = step.tb_lineno if step.tb_frame.f_code.co_filename == str(path) else line
            step = step.tb_next
        where = Location(str(path), line)
        raise RuleError(
            f"the code cannot be imported: {type(error).__name__}: {error}", location=where, fix="correct it"
        ) from error
    finally:
        sys.path[:] = before
    return module


def _wrong(place: Location, message: str, fix: str) -> SourceError:
    return SourceError(message, location=place, fix=f"{fix}; nothing was done")
