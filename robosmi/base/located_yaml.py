"""Reads YAML as JSON with the line of every value: block and flow collections, quoted and plain scalars, comments.

What is no JSON in another dress is refused: anchors and aliases, whose expansion may be of any size, tags, several documents,
keys that are no texts or come twice. Plain scalars are those of YAML's JSON schema: `true`, `false`, `null`, `~` and numbers; all
others are texts, so that `no`, `12:30` and dates stay what they are.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from robosmi.base.located_json import FEWER_LEVELS, MOST_LEVELS, LocatedJson, LocatedList, LocatedObject, NumberText
from robosmi.errors import MissingToolError

if TYPE_CHECKING:
    from yaml.events import Event, ScalarEvent

_WORDS = {"true": True, "false": False, "null": None, "~": None, "": None}
_NUMBER = re.compile(r"-?(?:0|[1-9][0-9]*)(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?")


class YamlError(ValueError):
    """A text that is no YAML, or not of this part of it; `line` is where, `fix` what to do."""

    def __init__(self, text: str, line: int, fix: str = "correct the file") -> None:
        super().__init__(text)
        self.line = line
        self.fix = fix


def located_yaml(data: bytes) -> LocatedJson:
    """The value of a text in YAML.

    Raises:
        YamlError: it is no UTF-8, no YAML, has what is refused, or is nested more than `MOST_LEVELS` deep.
        MissingToolError: PyYAML is not installed.
    """
    try:
        import yaml
    except ModuleNotFoundError as error:
        raise MissingToolError("YAML needs the package PyYAML", fix="install it: pip install 'robosmi[yaml]'") from error
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise YamlError("the text is no UTF-8", data.count(b"\n", 0, error.start) + 1) from None
    builder = _Builder()
    try:
        for event in yaml.parse(text, getattr(yaml, "CSafeLoader", yaml.SafeLoader)):
            builder.take(event)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line, text = mark.line + 1 if mark is not None else 1, error.problem or "it cannot be read"
        if "nesting" in text:  # libyaml has a limit of its own
            raise YamlError(f"the text is nested too deep ({text})", line, FEWER_LEVELS) from None
        raise YamlError(text, line) from None
    except yaml.reader.ReaderError as error:
        place = error.position if isinstance(error.position, int) else 0
        code = error.character if isinstance(error.character, int) else ord(error.character)
        raise YamlError(f"the character U+{code:04X} is not allowed", text.count("\n", 0, place) + 1) from None
    return builder.value()


class _Builder:
    """Builds the value of the events of one text, with a stack of its own."""

    def __init__(self) -> None:
        self.whole = LocatedList(1)
        self.around: list[LocatedObject | LocatedList] = [self.whole]
        self.keys: list[str | None] = [None]
        self.documents = 0

    def value(self) -> LocatedJson:
        """The one value of the text."""
        if not self.documents:
            raise YamlError("the text is empty", 1)
        return self.whole[0]

    def take(self, event: Event) -> None:
        """Add what an event says."""
        from yaml import events

        line = event.start_mark.line + 1 if event.start_mark is not None else 1
        if isinstance(event, events.DocumentStartEvent):
            self.documents += 1
            if self.documents > 1:
                raise YamlError("a second document begins, and a file has one", line)
        elif isinstance(event, events.AliasEvent):
            raise YamlError(f"'*{event.anchor}' is an alias, which is not supported", line)
        elif isinstance(event, events.NodeEvent):
            if event.anchor is not None:
                raise YamlError(f"'&{event.anchor}' is an anchor, which is not supported", line)
            if (tag := getattr(event, "tag", None)) is not None:
                raise YamlError(f"'{tag}' is a tag, which is not supported", line)
            self.node(event, line)
        elif isinstance(event, events.CollectionEndEvent):
            self.around.pop()
            self.keys.pop()

    def node(self, event: Event, line: int) -> None:
        """Add a value, or note a key."""
        from yaml import events

        inside = self.around[-1]
        if isinstance(inside, LocatedObject) and self.keys[-1] is None:
            if not isinstance(event, events.ScalarEvent):
                raise YamlError("a key is a list or an object, and keys are texts", line)
            if event.value in inside:
                raise YamlError(f"the key '{event.value}' stands twice, first in line {inside.lines[event.value]}", line)
            inside.lines[event.value] = line
            self.keys[-1] = event.value
            return
        value = _scalar(event) if isinstance(event, events.ScalarEvent) else None
        if not isinstance(event, events.ScalarEvent):
            value = LocatedObject(line) if isinstance(event, events.MappingStartEvent) else LocatedList(line)
        key = self.keys[-1]
        if isinstance(inside, LocatedObject) and key is not None:
            inside[key], self.keys[-1] = value, None
        elif isinstance(inside, LocatedList):
            inside.append(value)
        if isinstance(value, (LocatedObject, LocatedList)):
            self.around.append(value)
            self.keys.append(None)
            if len(self.around) > MOST_LEVELS + 1:
                raise YamlError(f"the text is nested more than {MOST_LEVELS} levels deep", line, FEWER_LEVELS)


def _scalar(event: ScalarEvent) -> LocatedJson:
    """The value of a scalar."""
    text: str = event.value
    if event.style or not event.implicit[0]:
        return text
    if text in _WORDS:
        return _WORDS[text]
    return NumberText(text) if _NUMBER.fullmatch(text) else text
