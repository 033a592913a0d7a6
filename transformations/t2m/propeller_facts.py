"""Makes `platform_repo/propeller/api.json` and `pins.json` from the collected facts about the Propeller's headers.

Input: a folder with `api_db.json` (what every header declares) and `pin_parameters.json` (which parameters are pins).
Output is compact and deterministic: sorted names, one header or function a line. What the facts mean for a migration is
written by hand in `meanings.toml`. Run: `python -m robosmi.transformations.t2m.propeller_facts FOLDER`.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TypedDict, cast

from robosmi import inputs, resources
from robosmi.base.data_text import Json, json_of, json_written
from robosmi.transformations.knowledge.api_data import FunctionPins
from robosmi.transformations.knowledge.platforms.api_spelling import tidy

PLATFORM = "propeller"


class _Function(TypedDict):
    ret: str
    sig: str


class _Header(TypedDict):
    """A header as it was collected; `macros` tells of each macro whether it is function-like or object-like."""

    kind: str
    source: str
    includes: list[str]
    functions: dict[str, _Function]
    macros: dict[str, str]
    vars: dict[str, str]
    consts: list[str]
    types: dict[str, str]


def api_facts(database: dict[str, _Header]) -> dict[str, dict[str, dict[str, Json]]]:
    """The content of `api.json`: headers by name, in the order of their names.

    Functions are `name: [return type, parameters]`, macros `name: 1 when function-like, else 0`.
    """
    headers: dict[str, dict[str, Json]] = {}
    for name in sorted(database):
        header = database[name]
        entry: dict[str, Json] = {"kind": header["kind"], "source": header["source"], "includes": header["includes"]}
        entry["functions"] = {
            f: [tidy(x["ret"]), tidy(x["sig"])] for f, x in sorted(header["functions"].items(), key=lambda item: item[0])
        }
        entry["macros"] = {m: int(kind == "function-like") for m, kind in sorted(header["macros"].items())}
        entry["vars"] = {v: tidy(kind) for v, kind in sorted(header["vars"].items())}
        entry["consts"] = sorted(header["consts"])
        entry["types"] = dict(sorted(header["types"].items()))
        headers[name] = {key: value for key, value in entry.items() if value}
    return {"headers": headers}


_NOT_COLLECTED = {
    ("servo360_setRampStep", "servo360.h"): ("p", "out"),
}
"""(function, header) -> name and direction of its first parameter, a pin, for functions missing in the collected facts."""


def pin_facts(parameters: dict[str, list[FunctionPins]]) -> dict[str, list[dict[str, Json]]]:
    """The content of `pins.json`: one entry per function and group of headers; notes are left out."""
    there = {(entry["function"], header) for entry in parameters["functions"] for header in entry["headers"]}
    more: list[FunctionPins] = [
        {"function": function, "headers": [header], "parameters": [{"index": 0, "name": name, "direction": direction}]}
        for (function, header), (name, direction) in _NOT_COLLECTED.items()
        if (function, header) not in there
    ]
    functions = []
    for entry in sorted([*parameters["functions"], *more], key=lambda x: (x["function"], x["headers"])):
        functions.append({key: cast("Json", value) for key, value in entry.items() if key != "note" and value})
    return {"functions": functions}


def write(folder: Path, target: Path) -> list[Path]:
    """Write both files.

    Args:
        folder: holds `api_db.json` and `pin_parameters.json`.
        target: the platform's folder.
    """

    def line(value: Json) -> str:
        return json_written(value, ensure_ascii=True, separators=(",", ":"))

    def read(name: str) -> Json:
        return json_of(inputs.read_text(folder / name, inputs.DATA))

    api = api_facts(cast("dict[str, _Header]", read("api_db.json")))
    rows = ",\n".join(f"{line(name)}:{line(header)}" for name, header in api["headers"].items())
    (target / "api.json").write_text('{"headers":{\n' + rows + "\n}}\n", encoding="utf-8")
    pins = pin_facts(cast("dict[str, list[FunctionPins]]", read("pin_parameters.json")))
    rows = ",\n".join(line(entry) for entry in pins["functions"])
    (target / "pins.json").write_text('{"functions":[\n' + rows + "\n]}\n", encoding="utf-8")
    return [target / "api.json", target / "pins.json"]


def main(arguments: list[str]) -> int:
    """The command line; exit code 2 without a folder."""
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    for path in write(Path(arguments[0]), resources.built_in("platform_repo") / PLATFORM):
        print(path)
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
