"""Regular expressions of modules that the command keeps from one run to the next: the same patterns, and never others."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from robosmi.cli import kept_patterns

CODE = """
import sys
sys.path.insert(0, sys.argv[1])
from robosmi.cli.kept_patterns import keep_patterns
keep_patterns()
from re import _parser
parsed, parse = [], _parser.parse
def counted(text, *options):
    parsed.append(text)
    return parse(text, *options)
_parser.parse = counted
import words
print(words.WORD.findall("one Two 3"), words.WORD.flags, words.WORD.groupindex, words.found(), len(parsed), sep="|", end="")
_parser.parse = parse
"""
MODULE = r"""
import re
WORD = re.compile(r"(?P<first>[A-Z])(?P<rest>[a-z]+)", re.IGNORECASE)
class Words:
    LETTER = re.compile(rb"\w")
def made(letters):
    return re.compile(f"[{letters}]+")
MADE = made("a-f")
def found():
    return re.compile("[0-9]").findall("one Two 3")
"""
SAID = "[('o', 'ne'), ('T', 'wo')]|34|{'first': 1, 'rest': 2}|['3']|"
FRESH, ONE_FRESH, AGAIN = "7", "3", "1"
"""Numbers of patterns that are compiled: twice for each one of a module that is to be cached, once in the function."""

TEXTS = [
    ("a|b(?P<c>d)?", 0),
    (r"(?i)straße|\u0130[\w-]{2,5}?", 0),
    (r"(?x) a  # b", re.MULTILINE),
    (rb"[^\x00-\x7f]+(?=a)(?<!b)", re.DOTALL),
    ("[\ud800\U0001f600-\U0001f64fа-яё]*+(?>a+)", re.IGNORECASE),
]
"""Patterns with features of the engine's codes: group names, inline flags, sets beyond 16 bits, look-ahead, look-behind."""


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """A folder with a module that has four patterns: one is made by a function at import, and one by a function later."""
    (tmp_path / "words.py").write_text(MODULE, encoding="utf-8")
    return tmp_path


def said(home: Path) -> str:
    environment = {**os.environ, "XDG_CACHE_HOME": str(home / "cache"), "PYTHONDONTWRITEBYTECODE": "1"}
    command = [sys.executable, "-c", CODE, str(home)]
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout


def kept(home: Path) -> Path:
    return home / "cache" / "robosmi" / f"{kept_patterns.NAME}-{sys.implementation.cache_tag}"


@pytest.mark.parametrize(("text", "flags"), TEXTS)
def test_a_code_makes_the_pattern_that_it_was_made_of(text: str | bytes, flags: int) -> None:
    made = kept_patterns._pattern_of(text, kept_patterns._code_of(text, flags))
    assert made == re.compile(text, flags)
    assert made.groupindex == re.compile(text, flags).groupindex


def test_the_second_run_compiles_what_functions_ask_for_alone(home: Path) -> None:
    assert said(home) == SAID + FRESH
    assert said(home) == SAID + AGAIN


def test_another_text_is_another_pattern(home: Path) -> None:
    assert said(home) == SAID + FRESH
    (home / "words.py").write_text(MODULE.replace("[A-Z]", "[a-z]"), encoding="utf-8")
    assert said(home) == SAID + ONE_FRESH


def spoilt(data: bytes) -> bytes:
    return data[:-9] + bytes([data[-9] ^ 1]) + data[-8:]


def of_another_build(data: bytes) -> bytes:
    build = sys.version.partition(" ")[0].encode()
    return data.replace(build, build.replace(b"3", b"2"), 1)


def cut(data: bytes) -> bytes:
    return data[: len(data) // 2]


def emptied(data: bytes) -> bytes:
    return b""


@pytest.mark.parametrize("change", [spoilt, of_another_build, cut, emptied])
def test_what_is_not_whole_or_of_another_python_is_made_again(home: Path, change: object) -> None:
    assert callable(change)
    said(home)
    whole = kept(home).read_bytes()
    kept(home).write_bytes(change(whole))
    assert said(home) == SAID + FRESH
    assert said(home) == SAID + AGAIN


@pytest.mark.skipif(sys.platform == "win32", reason="permissions as POSIX has them")
def test_a_file_that_others_can_write_is_passed_over(home: Path) -> None:
    said(home)
    kept(home).chmod(0o666)
    assert said(home) == SAID + FRESH


def test_where_nothing_can_be_kept_patterns_are_compiled(home: Path) -> None:
    (home / "cache").write_text("in the way", encoding="utf-8")
    assert said(home) == SAID + FRESH
    assert said(home) == SAID + FRESH


def test_a_migration_compiles_no_pattern_of_a_module_again(tmp_path: Path) -> None:
    code = (
        "import sys\nfrom robosmi.cli.kept_patterns import keep_patterns\nkeep_patterns()\n"
        "from re import _parser\nmade, parse = [], _parser.parse\n"
        "def counted(text, *options):\n    made.append(text)\n    return parse(text, *options)\n"
        "_parser.parse = counted\nimport robosmi.transformations.chains.migrate\n"
        "print(len(made))\n_parser.parse = parse\n"
    )
    environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path)}
    first, second = (
        int(subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True).stdout)
        for _ in range(2)
    )
    assert first > 100
    assert second <= 20, "of functions alone"
