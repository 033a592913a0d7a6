"""Labelled programs against `robosmi analyse --json`: precision and recall of each field, and the programs with nothing wrong.

A line of `labels/programs.jsonl` is a program with what a reader found in it. Calls of functions that the program declares in a
header of its own and defines elsewhere count as calls of the user or as unknown ones, so neither is judged.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Hashable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path, PurePosixPath
from typing import Any

from tests.evaluation.sources import LABELS, read_lines

Items = Counter[Hashable]
NOT_JUDGED = {"pin_uses.origin"}
"""Fields that are counted, but do not make a program wrong."""


NAMED_ONCE = ("globals", "macros", "types", "standard_calls", "platform_symbols", "platform_types")
"""Fields whose items are names, each counted once."""


def labelled_programs(path: Path = LABELS / "programs.jsonl") -> list[dict[str, Any]]:
    """The labels, by identifier."""
    return read_lines(path)


def expected(label: Mapping[str, Any]) -> dict[str, Items]:
    """The items of each field as they were labelled."""
    calls, main = label["platform_calls"], label["main"] or {}
    known = {name for name, *_ in calls}
    in_macros = set(label["in_macros"]) - known
    fields: dict[str, Items] = {
        "includes": _once(map(tuple, label["includes"])),
        "platform_calls": _once(known | in_macros),
        "platform_calls.count": _once([(name, count) for name, count, *_ in calls] + [(name, 0) for name in in_macros]),
        "platform_calls.lines": _once((name, line) for name, _, lines, _ in calls for line in lines),
        "platform_calls.header": _once((name, header) for name, _, _, header in calls if header is not None),
        "platform_calls.in_macro": _once(in_macros),
        "unknown_calls": _once(label["unknown_calls"].items()),
        "user_calls": _once(label["user_calls"].items()),
        "main": _once([label["main"] is not None]),
        "main.loop": _once([(main.get("loop_kind"), main.get("loop_line"))]),
        "main.statements": _once([tuple(main["statements"])] if main.get("statements") else []),
        "main.hoisted_locals": _once(main.get("hoisted", ())),
        "main.loop_exits": _once([bool(main.get("exits"))]),
        "cogs": Counter(map(tuple, label["cogs"])),
    }
    for name in ("functions", "prototypes"):
        fields[name] = Counter(label[name])
    fields |= {name: _once(label[name]) for name in NAMED_ONCE}
    if "pin_uses" in label:
        fields["pin_uses"] = _once(tuple(use[:4]) for use in label["pin_uses"])
        fields["pin_uses.origin"] = _once(map(tuple, label["pin_uses"]))
    return fields


def answered(label: Mapping[str, Any], unit: Mapping[str, Any]) -> dict[str, Items]:
    """The items of each field that a unit of the command's document has; a field that it lacks is left out."""
    made: dict[str, Items] = {}
    headers = {name: header for name, _, _, header in label["platform_calls"]}
    makers: dict[str, Callable[[], Items]] = {
        "includes": lambda: _once((i["name"], i["form"], i["line"], i["kind"]) for i in unit["includes"]),
        "platform_calls": lambda: _once(c["name"] for c in unit["platform_calls"]),
        "platform_calls.count": lambda: Counter((c["name"], c["count"]) for c in unit["platform_calls"]),
        "platform_calls.lines": lambda: _once((c["name"], n) for c in unit["platform_calls"] for n in c["lines"] if c["count"]),
        "platform_calls.header": lambda: _once(
            (c["name"], _same_header(headers.get(c["name"]), c["header"]))
            for c in unit["platform_calls"]
            if c["count"] and headers.get(c["name"], "") is not None
        ),
        "platform_calls.in_macro": lambda: _once(c["name"] for c in unit["platform_calls"] if not c["count"] and c["in_macro"]),
        "unknown_calls": lambda: _once((c["name"], c["count"]) for c in unit["unknown_calls"]),
        "user_calls": lambda: _once((c["name"], c["count"]) for c in unit["user_calls"]),
        "cogs": lambda: Counter((c["via"], c["function"], c["line"]) for c in unit["cogs"]),
        "pin_uses": lambda: _once(_pin_use(use) for use in unit["pin_uses"]),
        "pin_uses.origin": lambda: _once((*_pin_use(use), use["origin"]) for use in unit["pin_uses"]),
        **_main(unit),
    }
    makers |= {name: partial(_named, unit, name) for name in ("functions", "prototypes")}
    makers |= {name: partial(_named_once, unit, name) for name in NAMED_ONCE}
    for name, make in makers.items():
        try:
            made[name] = make()
        except (KeyError, TypeError):
            continue  # the field is not as the contract says: no answer
    return made


def _main(unit: Mapping[str, Any]) -> dict[str, Callable[[], Items]]:
    """How the fields of `main` are read; a program without an endless loop has neither statements nor hoisted locals."""
    if "main" not in unit:
        return {}
    main = unit["main"]
    if main is None:
        main = {"loop_kind": None, "loop_line": None, "hoisted_locals": [], "loop_exits": []}
    loop = main.get("loop_line") is not None
    return {
        "main": lambda: _once([unit["main"] is not None]),
        "main.loop": lambda: _once([(main["loop_kind"], main["loop_line"])]),
        "main.statements": lambda: _once([(main["statements_before"], main["statements_after"])] if loop else []),
        "main.hoisted_locals": lambda: _once(
            (x if isinstance(x, str) else x["name"] for x in main["hoisted_locals"]) if loop else ()
        ),
        "main.loop_exits": lambda: _once([bool(main["loop_exits"])]),
    }


def _pin_use(use: Mapping[str, Any]) -> tuple[Any, ...]:
    return use["function"], use["pin"], use["direction"], use["line"]


def _same_header(wanted: str | None, got: str | None) -> str | None:
    """The wanted header where one of both names is the end of the other's path."""
    if wanted and got and (f"/{got}".endswith(f"/{wanted}") or f"/{wanted}".endswith(f"/{got}")):
        return wanted
    return got


def _named(unit: Mapping[str, Any], name: str) -> Items:
    return Counter(item["name"] for item in unit[name])


def _named_once(unit: Mapping[str, Any], name: str) -> Items:
    return _once(_named(unit, name))


def _once(items: Iterable[Hashable]) -> Items:
    return Counter(set(items))


@dataclass
class Field:
    """The counts of a field over all programs."""

    right: int = 0
    extra: int = 0
    missed: int = 0

    @property
    def precision(self) -> float:
        """The share of the answers that are right."""
        return self.right / (self.right + self.extra) if self.right + self.extra else float(not self.missed)

    @property
    def recall(self) -> float:
        """The share of the labelled items that were answered."""
        return self.right / (self.right + self.missed) if self.right + self.missed else 1.0


@dataclass
class Score:
    """The counts over programs.

    Attributes:
        fields: by name.
        wrong: identifier of a program -> its fields that are not right.
        programs: how many were judged.
    """

    fields: dict[str, Field] = field(default_factory=dict)
    wrong: dict[str, list[str]] = field(default_factory=dict)
    programs: int = 0

    @property
    def right(self) -> int:
        """How many programs have nothing wrong."""
        return self.programs - len(self.wrong)

    def add(self, label: Mapping[str, Any], units: Iterable[Mapping[str, Any]]) -> None:
        """Judge what the command said of one program."""
        self.programs += 1
        listed = list(units)
        name = PurePosixPath(label["path"]).name
        mine = [u for u in listed if str(u.get("path", "")).replace("\\", "/").endswith(name)]
        answers = answered(label, (mine or listed or [{}])[0])
        free = {
            "unknown_calls": {*label["declared_elsewhere"]},
            "standard_calls": {*label["standard_in_macros"]},
            "user_calls": {*label["macro_calls"], *label["declared_elsewhere"]},
        }
        for field_name, items in expected(label).items():
            wanted = _judged(items, free.get(field_name, ()))
            got = _judged(answers.get(field_name, Counter()), free.get(field_name, ()))
            counts, both = self.fields.setdefault(field_name, Field()), (wanted & got).total()
            counts.right += both
            counts.extra += got.total() - both
            counts.missed += wanted.total() - both
            if (field_name not in answers or wanted != got) and field_name not in NOT_JUDGED:
                self.wrong.setdefault(label["id"], []).append(field_name)


def _judged(items: Items, free: Collection[str]) -> Items:
    return Counter({item: n for item, n in items.items() if (item[0] if isinstance(item, tuple) else item) not in free})
