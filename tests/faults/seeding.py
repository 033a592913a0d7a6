"""The faults that can be seeded in a migrated program, by kind: the places, and the text that such a mistake would leave.

Each fault exceeds the tolerances of a verdict: a constant is at least half as large again, a wait lasts half as long again, a
unit is off by a thousand, a number that is known not to fit loses its upper bits. `campaign` drops faults that are never
executed, or that give the same machine code.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from itertools import combinations

from tests.faults.edits import Edit, Edits
from tests.faults.shown_faults import SHOWN

_HIDDEN = re.compile(
    r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])*'|^[ \t]*#(?!define)[^\n]*", re.DOTALL | re.MULTILINE
)


@dataclass(frozen=True)
class Fault:
    """A mistake in one file.

    Attributes:
        file: the file's name in the sketch's folder.
        kind: the kind of mistake.
        edits: the replacements, by place.
        was, now: the changed part of the text, before and after.
        line: line of the first change, from 1.
        lines: the lines of which at least one has to be executed for the fault to matter.
        place: the number of this place among those of the file with the same text, from 1.
    """

    file: str
    kind: str
    edits: tuple[Edit, ...]
    was: str
    now: str
    line: int
    lines: tuple[int, ...]
    place: int = 1

    @property
    def name(self) -> str:
        """The name of the fault, which does not depend on line numbers."""
        return f"{self.file}: {self.was} -> {self.now}" + (f" (place {self.place})" if self.place > 1 else "")

    def put_into(self, text: str) -> str:
        """The text with the fault."""
        for edit in sorted(self.edits, key=lambda each: -each.begin):
            text = text[: edit.begin] + edit.text + text[edit.end :]
        return text


def faults(name: str, text: str) -> list[Fault]:
    """All faults of a file.

    Args:
        name: the file's name in the sketch's folder.
        text: the file.
    """
    code = _HIDDEN.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)
    found: dict[str, Fault] = {}  # by what becomes of the file: two kinds may mean the same
    kinds: dict[str, Callable[[str], Edits]] = {kind: partial(made, text) for kind, made in SHOWN.items()}
    for kind, made in {**kinds, **_KINDS}.items():
        for edits in made(code):
            edits = tuple(sorted(edits, key=lambda each: each.begin))
            if fault := _fault(name, text, kind, edits):
                found.setdefault(fault.put_into(text), fault)
    places: dict[str, list[int]] = {}
    for fault in found.values():
        places.setdefault(fault.name, []).append(fault.edits[0].begin)
    return [replace(each, place=1 + sorted(places[each.name]).index(each.edits[0].begin)) for each in found.values()]


def _fault(name: str, text: str, kind: str, edits: tuple[Edit, ...]) -> Fault | None:
    begin = text.rfind("\n", 0, edits[0].begin) + 1
    end = text.find("\n", edits[-1].end)
    end = len(text) if end < 0 else end
    if end - begin > 200:  # two places far apart: only their lines are told
        was = " / ".join(_line(text, edit.begin) for edit in edits)
        now = " / ".join(edit.text for edit in edits)
    else:
        shifted = tuple(Edit(e.begin - begin, e.end - begin, e.text) for e in edits)
        was, now = text[begin:end], Fault(name, kind, shifted, "", "", 0, ()).put_into(text[begin:end])
    was, now = (" ".join(each.split()) for each in (was, now))
    lines = tuple(text.count("\n", 0, edit.begin) + 1 for edit in edits)
    return Fault(name, kind, edits, was, now, lines[0], lines) if was != now else None


def _line(text: str, at: int) -> str:
    return text[text.rfind("\n", 0, at) + 1 : text.find("\n", at)].strip()


def _replaced(pattern: str, other: Callable[[re.Match[str]], str | None] | str) -> Callable[[str], Edits]:
    """A function that replaces each match of a pattern by a text, or by the result of a function (None for no fault)."""

    def made(code: str) -> Edits:
        for found in re.finditer(pattern, code, re.MULTILINE):
            text = found.expand(other) if isinstance(other, str) else other(found)
            if text is not None:
                yield (Edit(found.start(), found.end(), text),)

    return made


def _all(*kinds: Callable[[str], Edits]) -> Callable[[str], Edits]:
    def made(code: str) -> Edits:
        for each in kinds:
            yield from each(code)

    return made


def _swapped(pattern: str) -> Callable[[str], Edits]:
    """A function that exchanges each two different matches of a pattern's group."""

    def made(code: str) -> Edits:
        places = [(m.start(1), m.end(1), m[1]) for m in re.finditer(pattern, code, re.MULTILINE)]
        for one, other in combinations(places, 2):
            if one[2] != other[2]:
                yield (Edit(one[0], one[1], other[2]), Edit(other[0], other[1], one[2]))

    return made


_WAITS = r"(?:pause|delay|delayMicroseconds|waitcnt|drive_wait_frames|drive_wait_rest|yield)"
_STATEMENT = r"^([ \t]+)({name}\([^;{{}}]*\));"
_NUMBER = re.compile(r"\d+")


def _larger(found: re.Match[str]) -> str:
    """A number that is half as large again at least: beyond every tolerance, for a width, a time and a number of polls."""
    value = int(_NUMBER.match(found[0])[0])  # type: ignore[index]
    suffix = found[0][len(str(value)) :]
    return f"{value * 2 + 1 if value < 10 else value + (value + 1) // 2}{suffix}"


def _smaller(found: re.Match[str]) -> str | None:
    value = int(_NUMBER.match(found[0])[0])  # type: ignore[index]
    return f"{value // 2}{found[0][len(str(value)) :]}" if value >= 2 else None


_LITERAL = r"(?<![\w.])\d+(?:UL|U|L)?(?![\w.])"
_CALL = r"(?:\w+(?:\.|->))*\w+"


def _longer_wait(found: re.Match[str]) -> str:
    return f"{found[1]}({_larger(re.match(r'.*', found[2]))})"  # type: ignore[arg-type]


def _lost_state(code: str) -> Edits:
    """A variable loses the value that it keeps between rounds of the loop or calls: it is initialised again each time."""
    for found in re.finditer(r"^[ \t]+static (?!const)(?=[^;()]*;)", code, re.MULTILINE):
        yield (Edit(found.start(), found.end(), found[0].replace("static ", "")),)
    loop = re.search(r"^void loop\(\) \{\n", code, re.MULTILINE)
    if loop is None:
        return
    for found in re.finditer(r"^(?:u?int\w*_t|long|int|bool|char|float) (\w+) = ([^;]+);", code, re.MULTILINE):
        yield (Edit(loop.end(), loop.end(), f"  {found[1]} = {found[2]};\n"),)
    setup = re.search(r"^void setup\(\) \{\n(.*?)^\}", code, re.MULTILINE | re.DOTALL)
    for found in re.finditer(r"^[ \t]+[^\n]*;", setup[1], re.MULTILINE) if setup else ():
        begin = setup.start(1) + found.start() if setup else 0
        yield (Edit(begin, begin + len(found[0]), ""), Edit(loop.end(), loop.end(), f"  {found[0].strip()}\n"))


def _too_narrow(code: str) -> Edits:
    """A variable of clock counts, or of numbers beyond them, gets a type that is too narrow."""
    for found in re.finditer(r"\b(u?)int32_t( \w+ = [^;]*\b(?:CNT|micros\(\)|millis\(\))[^;]*;)", code):
        yield (Edit(found.start(), found.end(), f"{found[1]}int16_t{found[2]}"),)
    for found in re.finditer(r"\(int32_t\)(\((?:CNT|micros\(\)|millis\(\)))", code):
        yield (Edit(found.start(), found.end(), f"(int16_t){found[1]}"),)
    for found in re.finditer(r"\(uint32_t\)(micros\(\)|millis\(\)|time|msTime)", code):
        yield (Edit(found.start(), found.end(), f"(uint16_t){found[1]}" if found[1].endswith(")") else f"(uint8_t){found[1]}"),)
    for found in re.finditer(r"\b(u?)int(?:32|16)_t( \w+ *= *(\d+)L?;)", code):
        if int(found[3]) > 127:
            yield (Edit(found.start(), found.end(), f"int8_t{found[2]}"),)
    for found in re.finditer(r"\b(u?)int32_t( (?:target|frequency|humidity|temperature|change\b)[^;(){}]*[;,)])", code):
        yield (Edit(found.start(), found.end(), f"{found[1]}int16_t{found[2]}" if "256" in found[2] else f"int8_t{found[2]}"),)
    for found in re.finditer(r"(?<![\w.])(256|80)U?L(?!\w)", code):
        yield (Edit(found.start(), found.end(), f"{found[1]}"),)


_OTHER = {"<": ">=", ">": "<=", "==": "!=", "!=": "==", "<=": ">", ">=": "<"}
_KINDS: dict[str, Callable[[str], Edits]] = {
    "swapped pins": _all(
        _swapped(r"^const int(?:32_t)? \w+ = (1?\d);"),
        _replaced(r"^(const int(?:32_t)? \w+ = )(1?\d)(?=;)", lambda m: f"{m[1]}{(int(m[2]) - 1) % 6 + 14}"),
        _replaced(r"(\bservo_speed\()(left|right)(Servo)", lambda m: f"{m[1]}{'right' if m[2] == 'left' else 'left'}{m[3]}"),
        _replaced(r"(\bGetQTIState\()(left|right)(QTI)", lambda m: f"{m[1]}{'right' if m[2] == 'left' else 'left'}{m[3]}"),
        _swapped(r"\bobstacleSeen\((\w+), \w+\)"),
        _swapped(r"\bobstacleSeen\(\w+, (\w+)\)"),
    ),
    "wrong unit": _all(
        _replaced(r"\bdelay\(", "delayMicroseconds("),
        _replaced(r"\bdelayMicroseconds\(", "delay("),
        _replaced(r"\bmillis\(\)", "micros()"),
        _replaced(r"\bmicros\(\)", "millis()"),
        _replaced(r"\bpause\((\w+)\)", r"pause(\1 / 1000)"),
        _replaced(r"(?<=\* )80(?=U?L?\b)", "1"),
        _replaced(r"\bpause_unit = 80000L", "pause_unit = 80L"),
        _replaced(r"(?<=\* )256(?=L?\b)", "1"),
    ),
    "mirrored servo": _all(
        _replaced(r"\bspeed \+ 1500\b", "1500 - speed"),
        _replaced(r"\b1500 - beyond : 1500 \+ beyond\b", "1500 + beyond : 1500 - beyond"),
        _replaced(r"\b1500 - beyond\b", "1500 + beyond"),
        _replaced(r"\b1500 \+ beyond\b", "1500 - beyond"),
        _replaced(r"-right\)", "right)"),
        _replaced(r"(servo_speed\(leftServo, )left", r"\1-left"),
        _replaced(r"-\(int32_t\)CRUISE", "(int32_t)CRUISE"),
        _replaced(r"\bdrive\(CRUISE, CRUISE\)", "drive(-CRUISE, CRUISE)"),
    ),
    "16-bit overflow": _too_narrow,
    "missing wait": _all(
        _replaced(rf"^([ \t]+){_WAITS}\([^;{{}}]*\);", r"\1;"),
        _replaced(r"^([ \t]+while \([^;{}]*\)) yield\(\);", r"\1 break;"),
        _replaced(r"\b(pause|drive_wait_frames|delay)\((\d+)\)", _longer_wait),
        _replaced(r"\b(pause|drive_wait_frames|delay)\((\d+)\)", lambda m: f"{m[1]}({int(m[2]) // 2})"),
        _replaced(r"\bpause\(([A-Z_]+)\)", r"pause(\1 * 2)"),
        _replaced(r"\bdelay\(\(uint32_t\)(\w+)\)", r"delay((uint32_t)\1 / 2)"),
        _replaced(r"\bdelay\(\(uint32_t\)(\w+)\)", r"delay((uint32_t)\1 * 2)"),
    ),
    "tone that does not wait": _all(
        _replaced(r"^([ \t]+tone\([^;]*\);)\n[ \t]+delay\([^;]*\);", r"\1"),
        _replaced(r"^([ \t]+)noTone\([^;]*\);", r"\1;"),
        _replaced(r"^([ \t]+)tone\(([^;]*)\);", r"\1;"),
        _replaced(r"\btone\(io\.pin, \(unsigned int\)frequency\)", "tone(io.pin, (unsigned int)frequency, msTime)"),
        _replaced(r"\btone\(io\.pin, \(unsigned int\)frequency\)", "tone(io.pin, (unsigned int)frequency / 2)"),
        _replaced(r"\btone\(io\.pin, \(unsigned int\)frequency\)", "tone(io.pin, (unsigned int)msTime)"),
    ),
    "lost hoisting": _lost_state,
    "wrong constant": _all(_replaced(_LITERAL, _larger), _replaced(_LITERAL, _smaller)),
    "wrong condition": _all(
        _replaced(r"(?<=[\w)\]] )(<|>|==|!=|<=|>=)(?= [\w(-])", lambda m: _OTHER[m[1]]),
        _replaced(r"&&", "||"),
        _replaced(r"\|\|", "&&"),
        _replaced(r"(?<=if \()!(?=\w)", ""),
    ),
    "wrong level": _all(
        _replaced(r"\bhigh\((?=\w)", "low("),
        _replaced(r"\blow\((?=\w)", "high("),
        _replaced(r"\btrue\b", "false"),
        _replaced(r"\bfalse\b", "true"),
    ),
    "wrong sign": _all(_replaced(r" \+ (?=[\w(])", " - "), _replaced(r" - (?=[\w(])", " + ")),
    "left out": _all(
        _replaced(rf"^([ \t]+){_CALL}\([^;{{}}]*\);", r"\1;"),
        _replaced(r"^([ \t]+)(?!return)[\w.>\[\]*-]+(?:\+\+|--| [-+*/|&]?= [^;{}]*);", r"\1;"),
        _replaced(r"^([ \t]+)if \(([^{}\n]*)\) return;", r"\1;"),
    ),
}
KINDS = (*SHOWN, *_KINDS)
