"""Run a port of a case on the models that the case names, and write the results under the names of the expected files.

A case is a folder in `cases` with an input.json; its port is the module of the same name in `ports`, whose function `port`
takes the models and returns an EVL, ETL or Flock object. `compare.py` judges the folder that is written. Nothing in this module
depends on a case.
"""

from __future__ import annotations

import contextlib
import importlib
import io
import json
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robosmi.errors import RobosmiError
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.query import ModelView
from robosmi.query.rules.rule_language import place_in_model
from robosmi.transform import ETL, Flock
from robosmi.validate import EVL

HERE = Path(__file__).parent
CASES = HERE / "cases"


@dataclass
class Verdict:
    """The verdict of compare.py on a case: its last line, and the differences that it lists before."""

    line: str
    differences: str

    @property
    def equal(self) -> bool:
        """Whether there is no difference and nothing was left out of the comparison."""
        return self.line == "EQUAL"


def names(kind: str) -> list[str]:
    """The names of the cases of a kind."""
    return sorted(path.parent.name for path in (CASES / kind).glob("*/input.json"))


def load(spec: dict[str, Any], case: Path) -> ModelView:
    """Load a model of a case."""
    metamodel = Metamodel.load(*(case / path for path in spec["metamodels"]))
    if spec.get("mode") == "new":
        return ModelView(EmfModel((), metamodel, spec["name"]))
    return ModelView(EmfModel.load(case / spec["file"], metamodel, spec["name"]))


def run(kind: str, name: str, out: Path, port: Callable[..., Any] | None = None) -> None:
    """Run the port of a case, or another function that takes the case's models, and write its results."""
    case = CASES / kind / name
    spec = json.loads((case / "input.json").read_text(encoding="utf-8"))
    models = [load(one, case) for one in spec["models"]]
    printed, error = io.StringIO(), None
    module = (port or importlib.import_module(f"tests.epsilon.ports.{kind}.{name}").port)(*models)
    with contextlib.redirect_stdout(printed):
        try:
            module.run(fix=spec.get("fix")) if isinstance(module, EVL) else module.run()
        except RobosmiError as raised:
            error = str(raised)
    out.mkdir(parents=True, exist_ok=True)
    if error is None:
        for one, model in zip(spec["models"], models, strict=True):
            if one.get("mode", "ro") != "ro":
                model.save(out / (one["file"] if one["mode"] == "new" else one["save_as"]))
    results = {**RESULTS[type(module)](module, models), "printed": printed.getvalue().split("\n"), "error": error}
    file = "expected_trace.json" if kind == "etl" else "expected.json"
    (out / file).write_text(json.dumps(results, indent=1), encoding="utf-8")


def of_evl(v: EVL, models: list[Any]) -> dict[str, Any]:
    """The findings with their fixes, as JSON."""
    if v.result is None:
        return {"unsatisfied": [], "fixed": []}
    report: Any = v.result.to_json()
    for entry, found in zip(report["unsatisfied"], v.unsatisfied, strict=True):
        del entry["severity"]
        if found.default_message:
            entry["message"] = f"Invariant {found.name} failed for <element>"
    return dict(report)


def of_etl(t: ETL, models: list[Any]) -> dict[str, Any]:
    """The trace, as JSON."""
    return {
        "trace": [
            {
                "rule": link.rule,
                "source": place_in_model(link.source, models),
                "targets": [place_in_model(target, models) for target in link.targets],
            }
            for link in t.trace
        ]
    }


def of_flock(f: Flock, models: list[Any]) -> dict[str, Any]:
    """The warnings, as JSON."""
    return {"migration_warnings": f.warnings}


RESULTS: dict[type, Any] = {EVL: of_evl, ETL: of_etl, Flock: of_flock}


def judge(kind: str, name: str, out: Path, *options: str) -> Verdict:
    """Let compare.py judge what `run` has written.

    Raises:
        ValueError: it cannot compare the files.
    """
    command = [sys.executable, str(HERE / "compare.py"), "case", str(CASES / kind / name), str(out), *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode == 2:
        raise ValueError(done.stderr)
    *differences, line = done.stdout.strip().split("\n")
    return Verdict(line, "\n".join(differences))


def main() -> int:
    """`python -m tests.epsilon.running [KIND[/NAME]]`: run all cases, or some, and print how many are equal."""
    import tempfile

    wanted = sys.argv[1] if len(sys.argv) > 1 else ""
    good = total = 0
    with tempfile.TemporaryDirectory() as folder:
        for kind in ("evl", "etl", "flock"):
            for name in names(kind):
                if not f"{kind}/{name}".startswith(wanted):
                    continue
                out = Path(folder) / kind / name
                run(kind, name, out)
                verdict = judge(kind, name, out, "--strict")
                good, total = good + verdict.equal, total + 1
                if not verdict.equal:
                    print(f"{kind}/{name}: {verdict.line}\n{verdict.differences}")
    print(f"{good} of {total} equal, all messages and orders included")
    return 0 if good == total else 1


if __name__ == "__main__":
    sys.exit(main())
