"""Run the port of an EGL or EGX case step by step, and write the folders and JSON files that the case expects.

A step is a run of the script (or of another one, to another file, on other models), or a change that a user makes to the files
between two runs. Each run has its own `Gen`, as each run of the engine has its own module. Nothing in this module depends on a
case.
"""

from __future__ import annotations

import contextlib
import importlib
import io
import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

from robosmi.errors import RobosmiError
from tests.epsilon.running import CASES, load

Port = Callable[..., Any]


def run_steps(name: str, out: Path, port: Port | None = None) -> None:
    """Perform all steps of a case.

    Args:
        name: name of the case, a folder in cases/egl.
        out: the folder for `stepN` and `stepN.json`.
        port: replaces the case's own port.
    """
    case = CASES / "egl" / name
    spec = json.loads((case / "input.json").read_text(encoding="utf-8"))
    work = out / "work"
    if (case / "before").is_dir():
        shutil.copytree(case / "before", work)
    work.mkdir(parents=True, exist_ok=True)
    number = 0
    for step in spec["steps"]:
        if "run" in step:
            number += 1
            result = run_script(case, spec, step, work, port or importlib.import_module(f"tests.epsilon.ports.egl.{name}").port)
            (out / f"step{number}.json").write_text(json.dumps(result, indent=1), encoding="utf-8")
            shutil.copytree(work, out / f"step{number}")
        else:
            edit(work, step)
    shutil.rmtree(work)


def run_script(case: Path, spec: dict[str, Any], step: dict[str, Any], folder: Path, port: Port) -> dict[str, Any]:
    """Run the script once; returns what it printed, its messages about the files, and its error."""
    models = [load(one | {"file": step.get("models", {}).get(one["name"], one["file"])}, case) for one in spec["models"]]
    script = step["run"] if isinstance(step["run"], str) else spec["script"]
    g = port(folder, *models, script, step.get("target", spec.get("target")))
    printed, error, messages = io.StringIO(), None, []
    with contextlib.redirect_stdout(printed):
        try:
            messages = g.run().messages
        except RobosmiError as raised:
            error = str(raised)
    return {"messages": messages, "printed": printed.getvalue().split("\n"), "error": error}


def edit(folder: Path, step: dict[str, Any]) -> None:
    """Change the files as a user does between two runs."""
    if "delete" in step:
        (folder / step["delete"]).unlink()
        return
    change = step.get("edit") or step["write"]
    file = folder / change["file"]
    if "write" in step:
        file.write_bytes(change["text"].encode())
        return
    text = file.read_text(encoding="utf-8")
    assert change["from"] in text
    file.write_text(text.replace(change["from"], change["to"]), encoding="utf-8")
