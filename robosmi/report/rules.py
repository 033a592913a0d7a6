"""What is known of each rule that a finding can have: its meaning, an example, what to do. For `explain`, SARIF and the manual.

Rules are data, `platform_repo/rules/*.toml`: a table for each rule, named by its id. A project, a plug-in or the user may add
files of their own; of two entries of a rule the first in the search order of `robosmi.resources` counts. What makes a finding
is not known here.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from robosmi import inputs, resources
from robosmi.base.data_text import toml_of
from robosmi.diagnostics import Location, Severity
from robosmi.errors import PlatformDataError, UsageError, did_you_mean
from robosmi.plugins import registry

if TYPE_CHECKING:
    from robosmi.validate import EVL

FOLDER = "rules"
"""Where in a folder of platform data the files of rules are."""
_TEXTS = ("name", "meaning", "do", "example")
_KEYS = {*_TEXTS, "severity", "says", "exit_code"}
_LONGEST = 100
"""Characters that a name of a rule may have where one is looked for."""
_FENCE = re.compile(r"^```\w*\n(.*?)^```$", re.MULTILINE | re.DOTALL)


class FindingRule(Struct, frozen=True):
    """One rule that a finding can have.

    Attributes:
        id: how findings name it (`RS311`).
        name: a word for it, in the form `NumberTooWide`.
        section: the title of the file that it stands in.
        severities: the levels that its findings have, the usual one first.
        meaning: what a finding of it says; Markdown of one line.
        do: what to do about it; Markdown of one line.
        example: what leads to such a finding; Markdown.
        says: the message of the finding that the example gives, or None.
        exit_code: of the rules of errors that stop a command, the exit code of the command; else None.
    """

    id: str
    name: str
    section: str
    severities: tuple[Severity, ...]
    meaning: str
    do: str
    example: str
    says: str | None = None
    exit_code: int | None = None

    @property
    def code(self) -> str | None:
        """The program of an example that is one, else None."""
        found = _FENCE.search(self.example)
        return found[1] if found else None

    def to_json(self) -> dict[str, Any]:
        """Everything, as `explain --json` gives it."""
        return {
            "id": self.id,
            "name": self.name,
            "section": self.section,
            "severity": [level.name for level in self.severities],
            "meaning": self.meaning,
            "do": self.do,
            "example": self.example,
            "says": self.says,
            "exit_code": self.exit_code,
        }


def finding_rules(project: Path | None = None) -> dict[str, FindingRule]:
    """All rules by their ids, sorted by them.

    Args:
        project: the project folder (see `robosmi.resources`); the current folder if None.

    Raises:
        PlatformDataError: a file of rules is damaged.
    """
    return _of_folders(resources.folders("platform_repo", project))


def built_in_rules() -> dict[str, FindingRule]:
    """The rules of the package itself, without those of projects and plug-ins, by their ids, sorted by them."""
    return _of_folders([resources.built_in("platform_repo")])


def _of_folders(folders: Iterable[Path]) -> dict[str, FindingRule]:
    found: dict[str, FindingRule] = {}
    for folder in folders:
        for path in sorted((folder / FOLDER).glob("*.toml")):
            for rule in _of_file(path):
                found.setdefault(rule.id, rule)
    return dict(sorted(found.items()))


def rule_called(word: str, rules: dict[str, FindingRule]) -> FindingRule:
    """The rule of an id (`RS311`, `311`) or a name (`NumberTooWide`, `number-too-wide`); upper and lower case are alike.

    Args:
        word: what the user wrote.
        rules: all rules, by their ids.

    Raises:
        UsageError: no rule is called so; the error names those that come nearest.
    """
    if len(word) > _LONGEST:
        message = f"unknown rule '{word[:_LONGEST]}...' ({len(word)} characters)"
        raise UsageError(message, fix="list all rules: robosmi explain")
    wanted = _plain(word)
    known = {_plain(rule.id): rule for rule in rules.values()} | {_plain(rule.name): rule for rule in rules.values()}
    if rule := known.get(wanted) or known.get(f"rs{wanted}"):
        return rule
    if (offered := _without_page(wanted)) is not None:
        raise UsageError(offered, fix="read its message; its plug-in can add a page in rules/*.toml of its data folder")
    near = [f"{known[n].id} ({known[n].name})" for n in difflib.get_close_matches(wanted, known, n=3, cutoff=0.6)]
    near = list(dict.fromkeys(near)) or [f"{r.id} ({r.name})" for r in rules.values() if wanted and wanted in _plain(r.name)][:3]
    meant = f"; similar: {', '.join(near)}" if near else ""
    raise UsageError(f"unknown rule '{word}'{meant}", fix="list all rules: robosmi explain")


def _without_page(wanted: str) -> str | None:
    """What is said of a plug-in's constraint of that id, which no file of rules describes; None if there is none."""
    for metamodel in registry().names("constraints"):
        offered: list[tuple[EVL, str]] = registry().all("constraints", metamodel)
        for made, owner in offered:
            for constraint in made.declared() if owner else ():
                if _plain(constraint.id) == wanted:
                    return f"'{constraint.id}' is the constraint {constraint.name} of {owner}, which has no page"
    return None


def page(rule: FindingRule) -> str:
    """The rule's page in Markdown."""
    levels = " or ".join(level.name for level in rule.severities)
    exits = f"; the command ends with exit code {rule.exit_code}" if rule.exit_code is not None else ""
    said = f"\n\nRoboSMi says: {rule.says}" if rule.says else ""
    return (
        f"# {rule.id} {rule.name}\n\n{levels}{exits}. {sentence(rule.meaning)}\n\n"
        f"## Example\n\n{rule.example.strip()}{said}\n\n## What to do\n\n{sentence(rule.do)}\n"
    )


def terminal_page(rule: FindingRule) -> Iterator[str]:
    """The lines of the rule's page at a terminal: Markdown's marks are taken out, code is indented."""
    levels = " or ".join(level.name for level in rule.severities)
    exits = f", exit code {rule.exit_code}" if rule.exit_code is not None else ""
    yield f"{rule.id} {rule.name} ({levels}{exits})"
    yield f"  {sentence(plain_text(rule.meaning))}"
    yield "example"
    shown = rule.code
    yield from (f"    {line}" for line in shown.splitlines()) if shown is not None else [f"  {plain_text(rule.example.strip())}"]
    if rule.says:
        yield f"  robosmi says: {rule.says}"
    yield "what to do"
    yield f"  {sentence(plain_text(rule.do))}"


def sentence(text: str) -> str:
    """A text that begins with a capital, unless it begins with code, and ends with a full stop."""
    text = text.strip()
    word = text.split(" ", 1)[0]
    capital = text[:1].upper() if word.isalpha() and word.islower() else text[:1]
    return f"{capital}{text[1:]}{'' if text.endswith(('.', '!', '?', ':')) else '.'}"


def plain_text(markdown: str) -> str:
    """Markdown of rules without its marks: code spans and links."""
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", markdown).replace("`", "").replace("\\|", "|")


def _plain(word: str) -> str:
    return re.sub(r"[\s_-]", "", word).lower()


def _of_file(path: Path) -> Iterator[FindingRule]:
    try:
        values = toml_of(inputs.read_text(path, inputs.SETTINGS))
    except (OSError, ValueError) as error:
        raise _damaged(path, f"the file of rules cannot be read: {error}") from error
    section = values.pop("title", "")
    if not isinstance(section, str):
        raise _damaged(path, "'title' must be a text")
    for rule, entry in values.items():
        if not isinstance(entry, dict):
            raise _damaged(path, f"'{rule}' must be a table with the keys {', '.join(_TEXTS)} and severity")
        yield _of_entry(path, rule, section, entry)


def _of_entry(path: Path, rule: str, section: str, entry: dict[str, Any]) -> FindingRule:
    if wrong := next((key for key in _TEXTS if not isinstance(entry.get(key), str) or not entry[key].strip()), None):
        raise _damaged(path, f"'{rule}.{wrong}' must be a non-empty text")
    if unknown := next((key for key in entry if key not in _KEYS), None):
        raise _damaged(path, f"'{rule}.{unknown}' is not a key of a rule{did_you_mean(unknown, _KEYS)}")
    levels, says, code = entry.get("severity"), entry.get("says"), entry.get("exit_code")
    if not isinstance(levels, list) or not levels or any(level not in Severity.__members__ for level in levels):
        raise _damaged(path, f"'{rule}.severity' must be a list of {', '.join(Severity.__members__)}")
    if not isinstance(says, (str, type(None))) or not isinstance(code, (int, type(None))):
        raise _damaged(path, f"'{rule}.says' must be a text, and '{rule}.exit_code' a whole number")
    return FindingRule(
        rule, entry["name"], section, tuple(Severity[level] for level in levels), entry["meaning"], entry["do"],
        entry["example"].strip("\n"), says, code,
    )  # fmt: skip


def _damaged(path: Path, cause: str) -> PlatformDataError:
    return PlatformDataError(cause, location=Location(str(path)), fix="correct the entry, or remove the file if it is your own")
