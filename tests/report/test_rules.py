"""The rules' data, and what `explain` prints of it. That each rule of the code is in it is a test of the structure."""

from __future__ import annotations

import ast
import re
from functools import cache
from pathlib import Path

import pytest

import robosmi
from robosmi.diagnostics import Finding, Severity
from robosmi.errors import PlatformDataError, UsageError
from robosmi.plugins import content
from robosmi.query import Q
from robosmi.report.rules import FindingRule, finding_rules, page, plain_text, rule_called, sentence
from robosmi.transformations.chains.stages.models import MigrationModels
from robosmi.transformations.queries.plans.plan import as_findings
from tests.running import run
from tests.source_imports import modules, nodes_of_module

ROOT = Path(__file__).resolve().parents[2]
RULES = finding_rules(ROOT)
PROGRAMS = [rule for rule in RULES.values() if rule.code is not None]
MIGRATED = {"RS312", "RS337", "RS345"}
"""Rules that only the whole way has, and not the making of a plan."""
CHECKED = {"RS712"}
"""Rules that only `check` of the stored program has."""


def findings_of(rule: str, program: Path, out: Path) -> list[Finding]:
    """The findings about an example, from the command that has the rule."""
    if rule < "RS200":
        return list(content("chain", "analyse")([program]).findings)
    if rule in MIGRATED | CHECKED:
        made = robosmi.migrate([program], out)
        return list(content("chain", "check")(out / "models" / "code.xmi", None).findings if rule in CHECKED else made.findings)
    models: MigrationModels = content("chain", "plan")([program], widths="keep")
    return list(as_findings(Q(models.plan.findings), models.places))


@pytest.mark.parametrize("rule", PROGRAMS, ids=lambda rule: rule.id)
def test_the_program_of_an_example_gives_the_finding_that_is_printed(rule: FindingRule, tmp_path: Path) -> None:
    program = tmp_path / "robot.c"
    program.write_text(rule.code or "")
    messages = [f.message for f in findings_of(rule.id, program, tmp_path / "out") if f.rule == rule.id]
    assert rule.says in messages


@cache
def texts() -> tuple[frozenset[str], list[list[str]]]:
    """The texts of the code that may be messages: whole ones, and the parts between which something is put in."""
    whole, parted = set[str](), list[list[str]]()
    for node in (node for path in modules("robosmi", "transformations") for node in nodes_of_module(path)):
        if isinstance(node, ast.JoinedStr):
            parted.append([str(v.value) if isinstance(v, ast.Constant) else "" for v in node.values])
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and 10 < len(node.value) < 200:
            whole.add(node.value)
    return frozenset(whole), [parts for parts in parted if sum(map(len, parts)) >= 10]


def is_of_code(message: str) -> bool:
    """Whether the code has a text that may become this message."""
    whole, parted = texts()
    return message in whole or any(
        re.fullmatch("".join(re.escape(part) or ".*" for part in parts), message)
        for parts in parted
        if all(part in message for part in parts)
    )


FOREIGN = {"RS346", "RS530", "RS801", "RS802", "RS804", "RS901"}
"""Rules whose messages are those of the platform's data, a user's transformation, a compiler, a linker, and Python's reader of
arguments."""


def test_the_message_of_an_example_that_is_no_program_is_one_of_the_code() -> None:
    told = {r.id: r.says for r in RULES.values() if r.says and r.code is None and r.id not in FOREIGN}
    assert len(told) > 50
    assert [rule for rule, says in told.items() if not is_of_code(says)] == []


def test_names_are_words_and_unique() -> None:
    names = [rule.name for rule in RULES.values()]
    assert len(names) == len({name.lower() for name in names})
    assert [name for name in names if not re.fullmatch(r"([A-Z][a-z0-9]*)+", name)] == []


@pytest.mark.parametrize("word", ["RS311", "rs311", "311", "NumberTooWide", "number-too-wide", "number_too_wide"])
def test_a_rule_is_found_by_its_id_and_by_its_name(word: str) -> None:
    assert rule_called(word, RULES).id == "RS311"


@pytest.mark.parametrize(("word", "near"), [("RS998", "RS908"), ("NumbrTooWide", "RS311"), ("serial", "RS243"), ("", "")])
def test_an_unknown_rule_is_an_error_with_near_names(word: str, near: str) -> None:
    with pytest.raises(UsageError) as caught:
        rule_called(word, RULES)
    assert near in caught.value.message
    assert caught.value.fix


def test_explain_prints_the_page() -> None:
    outcome = run("explain", "RS311", "ShortCircuit")
    assert outcome.code == 0
    for part in ("RS311 NumberTooWide (warning)", "speed = 40000;", "what to do", "RS230 ShortCircuit (error)"):
        assert part in outcome.out
    assert "`" not in outcome.out


def test_explain_as_json_has_the_rule_and_its_page() -> None:
    (rule,) = run("explain", "RS901", "--json").result["rules"]
    assert (rule["id"], rule["severity"], rule["exit_code"]) == ("RS901", ["error"], 2)
    assert rule["page"].startswith("# RS901 WrongUsage")
    assert len(run("explain", "--json").result["rules"]) == len(RULES)


def test_explain_of_an_unknown_rule_is_wrong_usage() -> None:
    outcome = run("explain", "short-circus")
    assert outcome.code == 2
    assert "RS230 (ShortCircuit)" in outcome.err


def test_a_name_that_no_rule_can_have_is_refused_shortly() -> None:
    outcome = run("explain", "number-too-wide" * 7000)
    assert outcome.code == 2
    assert "(105000 characters)" in outcome.err
    assert len(outcome.err) < 400


def test_a_project_describes_rules_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own = tmp_path / ".robosmi" / "platform_repo" / "rules"
    own.mkdir(parents=True)
    (own / "own.toml").write_text(
        'title = "House rules"\n[HR1]\nname = "NoBlue"\nseverity = ["info"]\n'
        'meaning = "it is blue"\ndo = "paint it"\nexample = "a blue robot"\n'
    )
    monkeypatch.chdir(tmp_path)
    outcome = run("explain", "no-blue")
    assert "HR1 NoBlue (info)" in outcome.out
    assert finding_rules(tmp_path)["HR1"].severities == (Severity.info,)


@pytest.mark.parametrize(
    ("text", "cause"),
    [
        ("[X1]\nname = 3\n", "'X1.name' must be a non-empty text"),
        ("X1 = 3\n", "'X1' must be a table"),
        ("title = 3\n", "'title' must be a text"),
        ("[X1\n", "cannot be read"),
        ('[X1]\nname="A"\nmeaning="a"\ndo="a"\nexample="a"\nseverity="info"\n', "'X1.severity' must be a list"),
        ('[X1]\nname="A"\nmeaning="a"\ndo="a"\nexample="a"\nseverity=["bad"]\n', "'X1.severity' must be a list"),
        ('[X1]\nname="A"\nmeaning="a"\ndo="a"\nexample="a"\nseverity=["info"]\nsay=""\n', "'X1.say' is not a key"),
        ('[X1]\nname="A"\nmeaning="a"\ndo="a"\nexample="a"\nseverity=["info"]\nsays=1\n', "'X1.says' must be a text"),
    ],
)
def test_a_damaged_file_of_rules_is_an_error_with_its_place(text: str, cause: str, tmp_path: Path) -> None:
    own = tmp_path / ".robosmi" / "platform_repo" / "rules"
    own.mkdir(parents=True)
    (own / "own.toml").write_text(text)
    with pytest.raises(PlatformDataError, match=re.escape(cause)) as caught:
        finding_rules(tmp_path)
    assert caught.value.location is not None
    assert caught.value.location.path == str(own / "own.toml")


def test_texts_become_sentences() -> None:
    assert sentence("take the wire away") == "Take the wire away."
    assert sentence("`int` is wider") == "`int` is wider."
    assert plain_text("see [widths](../method/widths.md) and `int`") == "see widths and int"
    assert page(RULES["RS311"]).count("```") == 2
