"""What users write into a generated program: bodies of placeholders, and ticks in the list of tasks.

Only texts are compared: the present one and the one that is newly generated. What follows from it is decided in
`chains.stages.completion`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from msgspec import Struct

from robosmi.transformations.knowledge.lexer import Token, tokens

TODO = "TODO: complete method"
"""The comment that marks a body that is still to be written."""
VALUE_TODO = "TODO: complete symbol"
"""The comment that marks a placeholder whose value is still to be given."""
_NOT_SUPPORTED = "not supported"
_NOTHING = re.compile(r"\{ (?:\( void \) \w+ ; )*(?:return [^;]*; )?\}\Z")
"""The code of a body that does nothing."""
AS_BYTES = "surrogateescape"
"""The error handler that carries bytes that are no UTF-8 through these texts."""
_TASK = re.compile(r"- \[(?P<tick>[ xX])\] (?P<said>.*`(?P<rule>RS\d+)`(?s:.*))")
_CODE = re.compile(r"(?<!\\)`[^`]*`")
"""A code span in a line of a report: what to type, or a line of the source."""
_QUOTED = re.compile(r"'([^']*)'")


class Body(Struct, frozen=True):
    """A function that is defined in a text.

    Attributes:
        name: its name.
        first, last: the lines of its definition with the comments right above it, from 0; the last is not among them.
        text: these lines.
        code: its tokens without comments.
    """

    name: str
    first: int
    last: int
    text: str
    code: tuple[str, ...]

    @property
    def open(self) -> bool:
        """Whether the body is still to be written: it says so, or does nothing and says that this is not supported."""
        return TODO in self.text or (_NOT_SUPPORTED in self.text.lower() and _NOTHING.search(" ".join(self.code)) is not None)


def bodies(text: str) -> dict[str, Body]:
    """The functions that a text defines at file scope, by name; of two with one name the first."""
    found: dict[str, Body] = {}
    lines = text.split("\n")
    run = list(_on(token for token in tokens(text.encode("utf-8", AS_BYTES)) if token[0] != "comment"))
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line.encode("utf-8", AS_BYTES)) + 1)
    depth, begin = 0, 0
    for at, (kind, _, _, said) in enumerate(run):
        if kind == "directive" and depth == 0:
            begin = at + 1
        if kind != "punct" or said not in "{};":
            continue
        depth += (said == "{") - (said == "}")
        if said == "{" and depth == 1 and (name := _named(run[begin:at])):
            end = _end(run, at)
            first, last = _line(starts, run[begin][1]), _line(starts, run[end][1]) + 1
            while first and lines[first - 1].startswith("//"):
                first -= 1
            body = Body(name, first, last, "\n".join(lines[first:last]), tuple(t for *_, t in run[begin : end + 1]))
            found.setdefault(name, body)
        if depth == 0:
            begin = at + 1
    return found


def _on(found: Iterable[Token]) -> Iterator[Token]:
    """The tokens outside of `#if 0` blocks."""
    off = 0
    for token in found:
        if token[0] == "directive" and (off or re.match(r"#\s*if\s+0\b", token[3])):
            off += bool(re.match(r"#\s*if", token[3])) - bool(re.match(r"#\s*endif", token[3]))
        elif not off:
            yield token


def _named(head: list[Token]) -> str:
    """The name of the function that tokens before a `{` are the head of; empty if they are none."""
    texts = [text for *_, text in head]
    if "(" not in texts or "=" in texts or texts[-1] != ")":
        return ""
    at = texts.index("(")
    return texts[at - 1] if at and head[at - 1][0] == "name" else ""


def _end(run: list[Token], at: int) -> int:
    depth = 0
    for number in range(at, len(run)):
        depth += (run[number][3] == "{") - (run[number][3] == "}")
        if depth == 0:
            return number
    return len(run) - 1


def _line(starts: list[int], offset: int) -> int:
    return next(number for number in range(len(starts) - 1, -1, -1) if starts[number] <= offset)


def written(there: str, made: str, last: str = "") -> dict[str, Body]:
    """The functions that a user has written: placeholders in the generated text that are none any more in the present one.

    A body without the placeholder's comment counts as written, even if it does nothing.

    Args:
        there: the present text.
        made: the newly generated text.
        last: the text that was generated before; a function that is still as it was there is not the user's.
    """
    if there == last:
        return {}
    own, before = bodies(there), bodies(last)
    return {
        name: own[name]
        for name, body in bodies(made).items()
        if body.open and name in own and not own[name].open
        and (name not in before or before[name].open or own[name].code != before[name].code)
    }  # fmt: skip


def open_bodies(texts: Iterable[str]) -> dict[str, bool]:
    """Name of each function that the texts define -> whether its body is still to be written wherever it is defined."""
    found: dict[str, bool] = {}
    for text in texts:
        for body in bodies(text).values():
            found[body.name] = body.open and found.get(body.name, True)
    return found


class Tick(Struct, frozen=True):
    """A task in a report.

    Attributes:
        line: its line in the text, from 0.
        key: identifies the task whatever its place and counts are: the rule and the first name in its message.
        done: whether it is ticked.
    """

    line: int
    key: tuple[str, ...]
    done: bool


def ticks(report: str) -> list[Tick]:
    """The tasks in a report."""
    found = []
    for number, line in enumerate(report.split("\n")):
        if (task := _TASK.fullmatch(line)) is not None:
            said = _CODE.sub("", task["said"].rsplit("`", 2)[0])
            found.append(Tick(number, task_key(task["rule"], said), task["tick"] != " "))
    return found


def task_key(rule: str, message: str) -> tuple[str, ...]:
    """The key of a task whatever its place and counts are: the rule and the first name in its message, quoted or not."""
    plain = message.replace("\\", "")
    names = _QUOTED.findall(plain)
    return (rule, names[0]) if names else (rule, re.sub(r"\d+", "", plain.partition(" (")[0]).strip())


def with_ticks(report: str, done: set[tuple[str, ...]]) -> str:
    """A report with ticks at exactly the tasks with these keys."""
    lines = report.split("\n")
    for tick in ticks(report):
        lines[tick.line] = f"- [{'x' if tick.key in done else ' '}] {lines[tick.line][6:]}"
    return "\n".join(lines)
