"""Faults of what a program shows and does besides: texts, counters, console speed, pins, pulses, thresholds.

Each is a function of a file's text and of its code, which is the text with comments, strings and directives blanked. The sizes
exceed the tolerances of a verdict: a width is 13 % off where 1 % is allowed; a threshold is 15 % off, or three times its value
where the program counts polls, which may differ by half and twice.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from tests.faults.edits import Edit, Edits

Seeded = Callable[[str, str], Edits]
_PRINTS = re.compile(r"\b(?:print|printf|printi|sprint|sprinti|sprintf|dprint|writeStr|putStr)\(")
_TEXT = re.compile(r'"(?:\\.|[^"\\\n])*"')
_SPEEDS = (9600, 57600, 230400)
_PINS = (2, 5, 6, 13, 15)
"""Pins of the target that a fault may drive if the program does not name them."""
_COUNTER = re.compile(r"^([ \t]*(?:static )?(?:u?int\w*_t|long|int|char) (\w+) = )(\d+)(?=;)", re.MULTILINE)
_SCALED = re.compile(r"(?<=[\w)\]]) ?(?:<|>|<=|>=) (\d+)(?=L?\s*(?:[);?]|&&|\|\|))")
_BORDER = re.compile(r"^(const int32_t (\w+)\s*= )(\d+)(?=;)", re.MULTILINE)
_WIDTH = re.compile(r"\b(pulse_out\([^,;]*, |writeMicroseconds\(|servo_us\([^,;]*, [^,;]*, |slot->start\(|servo_set\([^,;]*, )")


def _closing(code: str, opened: int) -> int:
    """The offset of the parenthesis that closes the one just before `opened`."""
    depth = 1
    for at in range(opened, len(code)):
        depth += (code[at] == "(") - (code[at] == ")")
        if not depth:
            return at
    return len(code)


def _arguments(code: str, opened: int) -> list[tuple[int, int]]:
    """Start and end offset of each argument of a call."""
    end, depth = _closing(code, opened), 0
    cuts = [opened]
    for at in range(opened, end):
        depth += (code[at] in "([{") - (code[at] in ")]}")
        if code[at] == "," and not depth:
            cuts.append(at + 1)
    return [(begin, stop - 1) for begin, stop in zip(cuts, [*cuts[1:], end + 1], strict=True)]


def number_in_text(text: str, code: str) -> Edits:
    """A digit of a printed text is changed or added, or a number is printed with another width or base."""
    for call in _PRINTS.finditer(code):
        for literal in _TEXT.finditer(text, call.end(), _closing(code, call.end())):
            for found in re.finditer(r"(?<![%\\.\d])\d+(?!\w)|%d|(?<!\\)[A-Za-z](?= |=)", literal[0]):
                begin, end = literal.start() + found.start(), literal.start() + found.end()
                for other in _other_text(found[0]):
                    yield (Edit(begin, end, other),)


def _other_text(was: str) -> Iterator[str]:
    if was == "%d":
        yield from ("%6d", "%x")
    elif was.isdigit():
        yield str(int(was) + 1)
    else:
        yield f"{was}2"


def offset_of_number(text: str, code: str) -> Edits:
    """A printed number is always 1 or 10 too large or too small."""
    for call in _PRINTS.finditer(code):
        for begin, end in _arguments(code, call.end()):
            argument = text[begin:end].strip()
            if re.fullmatch(r"\w+", argument) and not argument.isdigit() and _is_number(argument, code):
                for more in (" + 1", " - 1", " + 10"):
                    yield (Edit(end, end, more),)


def _is_number(name: str, code: str) -> bool:
    return bool(re.search(rf"\b(?:int\w*_t|long|int) {name}\b(?!\[)", code))


def start_value(text: str, code: str) -> Edits:
    """A counter starts at another value: one more, or many more."""
    for found in _COUNTER.finditer(code):
        if re.search(rf"\b{found[2]}(?:\+\+|--| [+-]= )", code):
            for more in (1, 30):
                yield (Edit(found.end(1), found.end(), str(int(found[3]) + more)),)


def console_speed(text: str, code: str) -> Edits:
    """The console has another baud rate."""
    for found in re.finditer(r"\bSerial\.begin\((\d+)\)", code):
        for speed in _SPEEDS:
            yield (Edit(found.start(1), found.end(1), str(speed)),)


def foreign_pin(text: str, code: str) -> Edits:
    """A pin is driven that the program does not use or only reads, once at the start or in each round."""
    named = {int(number) for number in re.findall(r"^const int(?:32_t)? \w+ = (\d+);", code, re.MULTILINE)}
    named |= {int(number) for number in re.findall(r"\b(?:high|low|input|get_state|set_\w+|pulse_out|ping\w*)\((\d+)", code)}
    reads = re.findall(r"^const int (\w*Receiver\w*Read\w*) = ", code, re.MULTILINE)
    reads += re.findall(r"\binput\((\d+)\)", code)
    for function in re.finditer(r"^void (?:setup|loop)\(\) \{\n", code, re.MULTILINE):
        for pin in [*(str(each) for each in _PINS if each not in named), *reads]:
            for level in ("HIGH", "LOW"):
                driven = f"  pinMode({pin}, OUTPUT);\n  digitalWrite({pin}, {level});\n"
                yield (Edit(function.end(), function.end(), driven),)


def pulse_width(text: str, code: str) -> Edits:
    """A pulse is 13 % longer, or shorter."""
    for found in _WIDTH.finditer(code):
        end = _closing(code, code.index("(", found.start()) + 1)
        width = text[found.end() : end]
        if re.search(r"\b\w+ \w+$", width):
            continue  # where the function is written
        for part in (113, 87):
            yield (Edit(found.end(), end, f"({width}) * {part}L / 100"),)


def lost_direction(text: str, code: str) -> Edits:
    """A change of a pin's direction is dropped or reversed."""
    for found in re.finditer(r"^[ \t]+((?:set_directions?|pinMode|io\.drive)\([^;{}]*\));", code, re.MULTILINE):
        yield (Edit(found.start(1), found.end(1), ""),)
    for found in re.finditer(r"\b(set_direction\(\w+, )(0b)?([01])(?=\))", code):
        yield (Edit(found.start(3), found.end(3), str(1 - int(found[3]))),)


def moved_border(text: str, code: str) -> Edits:
    """A threshold of a condition is 15 % off, or three times as large or small."""
    if not re.search(r"^void loop\(\)", code, re.MULTILINE):
        return
    for found in _SCALED.finditer(code):
        yield from _moved(found.start(1), found.end(1), int(found[1]))
    for found in _BORDER.finditer(code):
        if re.search(rf"(?:<|>|<=|>=) (?:\d+ \* )?{found[2]}\b", code):
            yield from _moved(found.start(3), found.end(3), int(found[3]))


def _moved(begin: int, end: int, value: int) -> Edits:
    if value > 1:
        by = max(1, round(0.15 * value))
        for other in (value + by, value - by, 3 * value, value // 3):
            yield (Edit(begin, end, str(other)),)


def pull_up(text: str, code: str) -> Edits:
    """A pin that is read gains or loses a pull-up."""
    for found in re.finditer(r"\bput\(out, (false)\)", code):
        yield (Edit(found.start(1), found.end(1), "true"),)
    for found in re.finditer(r"\bINPUT_PULLUP\b", code):
        yield (Edit(found.start(), found.end(), "INPUT"),)


SHOWN: dict[str, Seeded] = {
    "number in a text": number_in_text,
    "offset of a number": offset_of_number,
    "start value": start_value,
    "console's speed": console_speed,
    "foreign pin": foreign_pin,
    "pulse width": pulse_width,
    "lost direction": lost_direction,
    "moved border": moved_border,
    "pull-up": pull_up,
}
