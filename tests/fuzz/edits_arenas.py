"""What `tests.fuzz.edits` regenerates: sketches of programs and drawings that change, and files of templates with regions."""

from __future__ import annotations

import random
import re
import shutil
import tempfile
import zipfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, Protocol

import robosmi
from robosmi.diagnostics import Finding
from robosmi.errors import RobosmiError
from robosmi.generate import Gen

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = [
    ROOT / "tests" / "transformations" / "m2m" / "programs" / "whole_main.c",
    ROOT / "tests" / "transformations" / "m2m" / "programs" / "port_in_parts.c",
    ROOT / "tests" / "transformations" / "m2m" / "programs" / "every_verdict" / "every_verdict.c",
    ROOT / "tests" / "transformations" / "queries" / "programs" / "main_loop.c",
]
_NUMBER = re.compile(r"(?<![\w.])\d+(?![\w.])")
_CALL = re.compile(r"^[ \t]+\w+\(.*\);")


class Arena(Protocol):
    """Something that is generated again and again."""

    name: str

    def make(self, folder: Path) -> list[Finding]:
        """Generate into a folder."""

    def fresh(self) -> dict[str, bytes]:
        """The texts that are made now, by their paths, from a run into an empty folder."""

    def change(self, chance: random.Random) -> None:
        """Change what is generated from."""


class Sketch:
    """The sketch of a program, with a drawing or without."""

    def __init__(self, folder: Path, program: Path, drawing: Path | None = None) -> None:
        folder.mkdir(parents=True)
        self.name = program.name
        self.source = Path(shutil.copy(program, folder))
        self.drawing = Path(shutil.copy(drawing, folder)) if drawing is not None else None
        self.helper = folder / "helper.c"

    def make(self, folder: Path) -> list[Finding]:
        files = [self.source, self.helper] if self.helper.exists() else [self.source]
        history = str(self.source.parent / "history.sqlite")
        return list(robosmi.migrate(files, folder, hardware=self.drawing, history=history).findings)

    def fresh(self) -> dict[str, bytes]:
        with tempfile.TemporaryDirectory() as empty:
            self.make(Path(empty) / "out")
            return _texts(Path(empty) / "out")

    def change(self, chance: random.Random) -> None:
        """Another text of the program or another drawing, which can still be migrated."""
        files = [path for path in (self.source, self.helper, self.drawing) if path is not None]
        before = {path: path.read_bytes() if path.exists() else None for path in files}
        for _ in range(chance.choice((1, 1, 3))):
            self._change(chance)
        try:
            self.fresh()
        except RobosmiError:
            for path, data in before.items():
                path.unlink(missing_ok=True) if data is None else path.write_bytes(data)

    def _change(self, chance: random.Random) -> None:
        kind = chance.randrange(8)
        if kind == 0 and self.drawing is not None:
            _change_drawing(self.drawing, chance)
        elif kind == 1:
            if self.helper.exists():
                self.helper.unlink()
            else:
                self.helper.write_text(f"int helper(int a) {{\n  pause({chance.randrange(99)});\n  return a;\n}}\n")
        else:
            lines = self.source.read_text(encoding="utf-8", errors="surrogateescape").split("\n")
            _change_program(lines, kind, chance)
            self.source.write_text("\n".join(lines), encoding="utf-8", errors="surrogateescape")


def _change_program(lines: list[str], kind: int, chance: random.Random) -> None:
    calls = [n for n, line in enumerate(lines) if _CALL.match(line)]
    place = chance.choice(calls) if calls else None
    if kind == 2 and place is not None:
        name = chance.choice(("high", "low", "toggle", "pause", "input", "print_number", "blink_it", "servo_angle"))
        indent = lines[place][: len(lines[place]) - len(lines[place].lstrip())]
        lines.insert(place, f"{indent}{name}({chance.randrange(30)}{', 90' if name == 'servo_angle' else ''});")
    elif kind == 3 and len(calls) > 2 and place is not None:
        lines[place] = ""
    elif kind == 4:
        numbers = [n for n in calls if _NUMBER.search(lines[n])]
        if numbers:
            place = chance.choice(numbers)
            lines[place] = _NUMBER.sub(lambda found: str(int(found[0]) + 1), lines[place], count=1)
    elif kind == 5:
        lines.insert(0, f"// {chance.randrange(1000)}")
    elif kind == 6:
        includes = [n for n, line in enumerate(lines) if line.startswith("#include")]
        if includes:
            number = chance.randrange(1000)
            lines.insert(includes[-1] + 1, f"int extra_{number}(int a) {{\n  toggle(a);\n  return a + {number};\n}}")
    elif place is not None:
        lines[place] += f"  // {chance.randrange(1000)}"


def _change_drawing(path: Path, chance: random.Random) -> None:
    """Another title of a component, or a component less."""
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    name = next(name for name in members if name.endswith(".fz"))
    text = members[name].decode()
    instances = list(re.finditer(r"<instance .*?</instance>", text, re.DOTALL))
    one = chance.choice(instances)
    part = one[0]
    if chance.random() < 0.5:
        part = re.sub(r"<title>([^<]*)</title>", rf"<title>\g<1>{chance.randrange(9)}</title>", part, count=1)
    elif "Wire" not in part and "Arduino" not in part:
        part = ""
    members[name] = (text[: one.start()] + part + text[one.end() :]).encode()
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for member, data in members.items():
            archive.writestr(member, data)


PAGE = """\
/* {{ title }} */
#include <first.h>
{% for e in elements %}

void {{ e.name }}(int a) {
{{ out.start_preserve("//", "", e.id, e.on) }}
  // default of {{ e.name }}
  return;
{{ out.stop_preserve() }}
}
{% endfor %}

void loop() {
{% for e in elements %}
  {{ e.name }}({{ loop.index }});
{% endfor %}
}
"""
PLAIN = "# {{ title }}\n{% for e in elements %}\n\n## {{ e.name }}\n\n  TODO {{ e.id }}\n  more\n{% endfor %}\n"
ALIKE = "// {{ title }}\n{% for e in elements %}\n\nvoid {{ e.name }}() {\n  begin();\n  // TODO\n  end();\n}\n{% endfor %}\n"


class Pages:
    """Files of templates with regions and without, made from elements that come, go, and change names and order."""

    def __init__(self, folder: Path, chance: random.Random) -> None:
        self.name = "templates"
        self.title = "first"
        self.count = 0
        self.pages: dict[str, list[dict[str, Any]]] = {"one.txt": [], "two.txt": []}
        for _ in range(4):
            self._add(chance)

    def _add(self, chance: random.Random) -> None:
        self.count += 1
        page = self.pages[chance.choice(sorted(self.pages))]
        new = {"id": f"r{self.count}", "name": f"name_{self.count}", "on": chance.random() < 0.8}
        page.insert(chance.randrange(len(page) + 1), new)

    def _gen(self, folder: Path, *, keep: bool) -> Gen:
        g = Gen(folder, {"page": PAGE, "plain": PLAIN, "alike": ALIKE}, keep=keep)
        for name, elements in self.pages.items():
            for template, target in (("page", name), ("plain", f"{name}.md"), ("alike", f"{name}.c")):
                rule = g.rule(template=template, target=target, name=target)
                rule(partial(self._values, elements))
        return g

    def _values(self, elements: list[dict[str, Any]]) -> dict[str, Any]:
        return {"title": self.title, "elements": elements}

    def make(self, folder: Path) -> list[Finding]:
        return self._gen(folder, keep=True).run().findings

    def fresh(self) -> dict[str, bytes]:
        with tempfile.TemporaryDirectory() as empty:
            made = self._gen(Path(empty), keep=False).make()
        return {file.name: (file.after or "").encode() for file in made.files}

    def change(self, chance: random.Random) -> None:
        """An element more or less, another name or order, another title, a page more or less."""
        page = self.pages[chance.choice(sorted(self.pages))]
        kind = chance.randrange(7)
        if kind == 0 or not page:
            self._add(chance)
        elif kind == 1:
            page.pop(chance.randrange(len(page)))
        elif kind == 2:
            chance.choice(page)["name"] = f"other_{chance.randrange(1000)}"
        elif kind == 3:
            chance.shuffle(page)
        elif kind == 4:
            self.title = f"title {chance.randrange(1000)}"
        elif kind == 5 and "three.txt" in self.pages:
            del self.pages["three.txt"]
        else:
            self.pages.setdefault("three.txt", []).append({"id": f"t{chance.randrange(99999)}", "name": "third", "on": True})


def _texts(folder: Path) -> dict[str, bytes]:
    found = {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    return {name: data for name, data in found.items() if not name.startswith((".robosmi", "models/"))}


def _example(name: str) -> Callable[[Path, random.Random], Arena]:
    place = ROOT / "docs" / "examples" / name
    return lambda folder, chance: Sketch(folder, place / f"{name}.c", next(place.glob("*.fzz")))


def _program(path: Path) -> Callable[[Path, random.Random], Arena]:
    return lambda folder, chance: Sketch(folder, path)


ARENAS: list[Callable[[Path, random.Random], Arena]] = [
    _example("line_follower"), Pages, _program(PROGRAMS[0]), _program(PROGRAMS[1]), Pages,
    _example("environmental_monitoring"), Pages, _program(PROGRAMS[2]), _program(PROGRAMS[3]), Pages,
]  # fmt: skip
"""Functions that create the arenas, each from a folder for its inputs."""
